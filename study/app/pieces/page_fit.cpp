#include "study/app/pieces/page_fit.h"

#include <QApplication>
#include <QBoxLayout>
#include <QEvent>
#include <QGridLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVariant>
#include <algorithm>
#include <cmath>
#include <utility>

#include "study/app/pieces/flow_layout.h"
#include "study/app/state/appearance.h"

namespace study::app {

namespace {

constexpr char usualSpacing[] = "usualSpacing";
constexpr char usualMargins[] = "usualMargins";
constexpr char zoomOfPage[] = "zoomOfPage";
constexpr char scrollsAlways[] = "scrollsAlways";  ///< of a page whose steps never fit: it keeps the usual type
constexpr int marginPx = 28;                       ///< between a control and the border of the area
constexpr int smallestZoom = 60, zoomStep = 5;     ///< percent of the usual type

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

int heightOf(const QLayout& layout, int width)
{
    return layout.hasHeightForWidth() ? layout.totalHeightForWidth(width) : layout.totalMinimumSize().height();
}

}  // namespace

void scaleGaps(QLayout& layout, double scale)
{
    if (const QVariant zoom = layout.property(zoomOfPage); zoom.isValid()) scale *= zoom.toDouble();
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

PageFit::PageFit(QScrollArea& area, QWidget& page) : QObject(&area), m_area(area), m_page(page)
{
    area.installEventFilter(this);
    page.installEventFilter(this);
    limitWidth();
}

PageFit* PageFit::of(const QScrollArea& area) { return area.findChild<PageFit*>({}, Qt::FindDirectChildrenOnly); }

void PageFit::setLargest(int percent)
{
    m_largest = percent;
    refit();
}

bool PageFit::eventFilter(QObject* watched, QEvent* event)
{
    const bool isOfPage = watched == &m_page;
    const QEvent::Type type = event->type();
    if (type == QEvent::Resize && !isOfPage) {
        limitWidth();
        fitLater(Search::FromLargest);
    }
    if (type == QEvent::Show && !isOfPage) fitLater(Search::FromCurrent);
    if (isOfPage && type == QEvent::StyleChange && !m_isZooming) fitLater(Search::FromLargest);
    if (isOfPage && type == QEvent::LayoutRequest && m_page.layout()) {
        scaleGaps(*m_page.layout(), scaleOf(m_area.window()->size()));  // of the rows that the page has built meanwhile
        fitLater(Search::FromCurrent);
    }
    if (type == QEvent::Resize)
        QMetaObject::invokeMethod(
            this, [this] { showFocus(); }, Qt::QueuedConnection);
    return QObject::eventFilter(watched, event);
}

void PageFit::limitWidth()
{
    constexpr int widestPx = 1250;
    m_page.setMaximumWidth(static_cast<int>(widestPx * scaleOf(m_area.window()->size())));
}

void PageFit::showFocus()
{
    QWidget* focus = m_area.window()->focusWidget();
    if (focus && m_area.isVisible() && m_area.isAncestorOf(focus)) m_area.ensureWidgetVisible(focus, 0, marginPx);
}

/// Queued, because a layout must not change while it is computed.
void PageFit::fitLater(Search search)
{
    if (m_due == Search::None && search != Search::None)
        QMetaObject::invokeMethod(
            this, [this] { fit(); }, Qt::QueuedConnection);
    m_due = std::max(m_due, search);
}

void PageFit::fit()
{
    const Search search = std::exchange(m_due, Search::None);
    if (!m_area.isVisible() || m_page.property(scrollsAlways).toBool()) return;
    const double points = QApplication::font().pointSizeF();
    const bool isNew = search == Search::FromLargest || points != m_points;
    m_points = points;
    const bool isEnough = m_scrolls ? showsMainButtons() : isInView();
    if (!isNew && isEnough) return;
    const int first = isNew ? m_largest : m_percent;
    m_scrolls = !takeLargest(first, smallestZoom, &PageFit::isInView);
    if (m_scrolls && !takeLargest(first, smallestZoom, &PageFit::showsMainButtons)) zoom(std::min(m_largest, 100));
    m_scrolls = m_scrolls || scrollsAtUsualSize(first);
    // A bar that was needed once takes width, so lines break earlier, and the area would keep the bar for their sake.
    m_area.setVerticalScrollBarPolicy(m_scrolls ? Qt::ScrollBarAsNeeded : Qt::ScrollBarAlwaysOff);
}

/// Who enlarges the text does not get a smaller one: the page scrolls rather, if its main buttons stay in view.
bool PageFit::scrollsAtUsualSize(int first)
{
    const int fitting = m_percent, usual = static_cast<int>(std::ceil(100 / appliedEnlargement() / zoomStep)) * zoomStep;
    if (usual >= 100 || fitting >= usual) return false;
    if (takeLargest(first, usual, &PageFit::showsMainButtons)) return true;
    zoom(fitting);
    return false;
}

/// Takes the largest type from `smallest` to `first` percent that is enough; returns false if none is.
bool PageFit::takeLargest(int first, int smallest, bool (PageFit::*isEnough)() const)
{
    const auto isEnoughAt = [&](int percent) {
        zoom(percent);
        return (this->*isEnough)();
    };
    if (isEnoughAt(first)) return true;
    if (smallest >= first || !isEnoughAt(smallest)) return false;
    int enough = smallest, tooLarge = first;
    while (tooLarge - enough > zoomStep) {
        const int middle = (enough + tooLarge) / (2 * zoomStep) * zoomStep;
        (isEnoughAt(middle) ? enough : tooLarge) = middle;
    }
    zoom(enough);
    return true;
}

/// Whether the area shows the whole page.
bool PageFit::isInView() const
{
    const QSize room = m_area.maximumViewportSize();
    const QLayout& layout = *m_area.widget()->layout();
    return heightOf(layout, room.width()) <= room.height() && layout.totalMinimumSize().width() <= room.width();
}

/// Whether the area shows the main buttons that can be pressed while it is not scrolled.
bool PageFit::showsMainButtons() const
{
    const QSize room = m_area.maximumViewportSize() - QSize(m_area.verticalScrollBar()->sizeHint().width(), 0);
    QWidget& whole = *m_area.widget();
    if (whole.layout()->totalMinimumSize().width() > room.width()) return false;
    whole.resize(room.width(), std::max(room.height(), heightOf(*whole.layout(), room.width())));
    whole.layout()->activate();
    for (const QWidget* part : whole.findChildren<QWidget*>())
        if (part->layout()) part->layout()->activate();
    const auto buttons = m_page.findChildren<QPushButton*>();
    return std::all_of(buttons.begin(), buttons.end(), [&](const QPushButton* button) {
        const bool isMain = button->property("role").toString() == QLatin1String("main");
        const bool isWanted = isMain && button->isEnabled() && button->isVisible();
        return !isWanted || button->mapTo(&whole, QPoint(0, button->height())).y() <= room.height();
    });
}

void PageFit::zoom(int percent)
{
    const double points = QApplication::font().pointSizeF();
    if (percent == m_percent && points == m_zoomedPoints) return;
    m_percent = percent;
    m_zoomedPoints = points;
    m_isZooming = true;
    const double zoomed = percent / 100.0;
    m_page.setStyleSheet(percent == 100 ? QString() : typeSheetOf(points * zoomed));
    m_page.layout()->setProperty(zoomOfPage, std::min(1.0, zoomed));  // gaps leave their room to larger text
    scaleGaps(*m_page.layout(), scaleOf(m_area.window()->size()));
    // A part keeps the height that it had until it announces another one, which it does only while it is shown.
    for (QWidget* part : m_area.widget()->findChildren<QWidget*>()) {
        part->ensurePolished();
        if (part->layout()) part->layout()->invalidate();
        part->updateGeometry();
    }
    m_area.widget()->layout()->invalidate();
    m_isZooming = false;
}

}  // namespace study::app
