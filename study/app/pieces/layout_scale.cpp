#include "study/app/pieces/layout_scale.h"

#include <QBoxLayout>
#include <QGridLayout>
#include <QScrollArea>
#include <QVariant>
#include <QWidget>
#include <cmath>

#include "study/app/pieces/flow_layout.h"

namespace study::app {

namespace {

constexpr char usualSpacing[] = "usualSpacing";
constexpr char usualMargins[] = "usualMargins";

int scaled(int px, double scale) { return static_cast<int>(std::lround(px * scale)); }

void scaleSpacing(QBoxLayout& box, double scale)
{
    if (!box.property(usualSpacing).isValid()) box.setProperty(usualSpacing, box.spacing());
    const int wanted = scaled(box.property(usualSpacing).toInt(), scale);
    if (box.spacing() != wanted) box.setSpacing(wanted);
}

void scaleSpacing(QGridLayout& grid, double scale)
{
    if (!grid.property(usualSpacing).isValid())
        grid.setProperty(usualSpacing, QSize(grid.horizontalSpacing(), grid.verticalSpacing()));
    const QSize usual = grid.property(usualSpacing).toSize();
    const QSize wanted(scaled(usual.width(), scale), scaled(usual.height(), scale));
    if (wanted == QSize(grid.horizontalSpacing(), grid.verticalSpacing())) return;
    grid.setHorizontalSpacing(wanted.width());
    grid.setVerticalSpacing(wanted.height());
}

void scaleMargins(QLayout& layout, double scale)
{
    if (!layout.property(usualMargins).isValid()) layout.setProperty(usualMargins, QVariant::fromValue(layout.contentsMargins()));
    const auto usual = layout.property(usualMargins).value<QMargins>();
    const QMargins wanted(scaled(usual.left(), scale), scaled(usual.top(), scale), scaled(usual.right(), scale),
                          scaled(usual.bottom(), scale));
    if (layout.contentsMargins() != wanted) layout.setContentsMargins(wanted);
}

/// The layout of the widget, or of the page that it scrolls; null if it has none.
QLayout* layoutIn(QWidget& widget)
{
    const auto* area = qobject_cast<QScrollArea*>(&widget);
    return area && area->widget() ? area->widget()->layout() : widget.layout();
}

}  // namespace

void scaleGaps(QLayout& layout, double scale)
{
    scaleMargins(layout, scale);
    if (auto* box = qobject_cast<QBoxLayout*>(&layout)) scaleSpacing(*box, scale);
    if (auto* grid = qobject_cast<QGridLayout*>(&layout)) scaleSpacing(*grid, scale);
    if (auto* flow = qobject_cast<FlowLayout*>(&layout)) flow->setScale(scale);
    for (int place = 0; place < layout.count(); ++place) {
        QLayoutItem& item = *layout.itemAt(place);
        if (item.layout()) scaleGaps(*item.layout(), scale);
        if (QLayout* inner = item.widget() ? layoutIn(*item.widget()) : nullptr) scaleGaps(*inner, scale);
    }
}

}  // namespace study::app
