#include "study/app/pieces/tick_box.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "study/app/pieces/pieces.h"

namespace study::app {

TickBox::TickBox(QWidget* parent) : QCheckBox(parent) { setType(*this, Type::Body); }

void TickBox::takeClicksOf(QWidget& caption) { caption.installEventFilter(this); }

bool TickBox::eventFilter(QObject* watched, QEvent* event)
{
    // Pressed on the caption and released on it.
    const auto* caption = qobject_cast<QWidget*>(watched);
    const bool isLeft = event->type() == QEvent::MouseButtonRelease || event->type() == QEvent::MouseButtonPress
                            ? static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton
                            : false;
    if (!caption || caption == this || !isLeft) return QCheckBox::eventFilter(watched, event);
    const bool isInside = caption->rect().contains(static_cast<QMouseEvent*>(event)->position().toPoint());
    if (event->type() == QEvent::MouseButtonRelease && isInside) click();
    return true;
}

QSize TickBox::sizeHint() const
{
    ensurePolished();
    const int side = fontMetrics().height() + 10;
    return {side, side};
}

void TickBox::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QColor accent = palette().color(QPalette::Highlight);
    const double side = std::min(width(), height());
    if (hasFocus()) {
        painter.setPen(QPen(accent, 2));
        painter.drawRoundedRect(QRectF(1, 1, side - 2, side - 2), 6, 6);
    }
    const QRectF box(6, 6, side - 12, side - 12);
    painter.setPen(QPen(isChecked() ? accent : palette().color(QPalette::PlaceholderText), 1.5));
    painter.setBrush(isChecked() ? accent : palette().color(QPalette::Base));
    painter.drawRoundedRect(box, 3, 3);
    if (!isChecked()) return;
    const auto at = [&](double x, double y) { return QPointF(box.x() + x * box.width(), box.y() + y * box.height()); };
    const QColor mark = palette().color(QPalette::HighlightedText);
    painter.setPen(QPen(mark, std::max(2.0, side / 11), Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF{at(0.22, 0.52), at(0.43, 0.73), at(0.79, 0.27)});
}

}  // namespace study::app
