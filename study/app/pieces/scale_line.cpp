#include "study/app/pieces/scale_line.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

#include "protocols/scale_drawing.h"
#include "study/app/pieces/pieces.h"
#include "study/app/state/rating_text.h"

namespace study::app {

using protocols::Tenths;

ScaleLine::ScaleLine(Use use, QWidget* parent) : QWidget(parent), m_use(use)
{
    setType(*this, use == Use::Show ? Type::Words : Type::Lead);
    setFocusPolicy(use == Use::Pick ? Qt::StrongFocus : Qt::NoFocus);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    if (use == Use::Pick) setCursor(Qt::PointingHandCursor);
    describe();
}

void ScaleLine::setScale(const protocols::RatingScale& scale)
{
    m_scale = scale;
    describe();
    update();
}

void ScaleLine::setRating(std::optional<Tenths> rating)
{
    if (rating == m_rating) return;
    m_rating = rating;
    describe();
    update();
}

void ScaleLine::describe()
{
    setAccessibleName(tr("Scale line from %1 to %2").arg(textOf(m_scale.min), textOf(m_scale.max)));
    setAccessibleDescription(m_rating ? textOf(*m_rating) : tr("nothing chosen"));
}

QRectF ScaleLine::line() const
{
    const double margin = std::max(fontMetrics().horizontalAdvance(textOf(m_scale.max)), fontMetrics().height());
    const double top = fontMetrics().height() * 0.45;
    // The words below stand in equal columns, so the ticks stand in their middles.
    const double column = m_scale.labels.empty() ? 0 : width() / 2.0 / static_cast<double>(m_scale.labels.size());
    const double inset = std::max<double>(margin, column);
    return {inset, top, std::max(1.0, width() - 2 * inset), fontMetrics().height() * 1.0};
}

QPoint ScaleLine::pointOf(Tenths rating) const
{
    const double span = m_scale.max.value - m_scale.min.value;
    const QRectF where = line();
    const double x = where.left() + where.width() * (rating.value - m_scale.min.value) / span;
    return QPointF(x, where.center().y()).toPoint();
}

QSize ScaleLine::sizeHint() const
{
    ensurePolished();  // the style sheet sets the font
    return {fontMetrics().height() * 18, static_cast<int>(fontMetrics().height() * 2.9)};
}

QSize ScaleLine::minimumSizeHint() const { return {fontMetrics().height() * 8, sizeHint().height()}; }

void ScaleLine::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF where = line();
    const double thick = std::max(2.0, fontMetrics().height() / 12.0);
    painter.setPen(QPen(palette().color(QPalette::WindowText), thick, Qt::SolidLine, Qt::RoundCap));
    painter.drawLine(QPointF(where.left(), where.center().y()), QPointF(where.right(), where.center().y()));
    const int sections = drawnSections(m_scale);
    for (int border = 0; border <= sections; ++border) {
        const double x = where.left() + where.width() * border / sections;
        const bool isEnd = border == 0 || border == sections;
        const double half = where.height() * (isEnd ? 0.5 : 0.3);
        painter.drawLine(QPointF(x, where.center().y() - half), QPointF(x, where.center().y() + half));
    }
    const double textTop = where.bottom() + fontMetrics().height() * 0.25;
    const double room = where.left();
    const auto drawEnd = [&](double x, Tenths end) {
        painter.drawText(QRectF(x - room, textTop, 2 * room, fontMetrics().height()), Qt::AlignCenter, textOf(end));
    };
    drawEnd(where.left(), m_scale.min);
    drawEnd(where.right(), m_scale.max);
    if (m_rating && *m_rating >= m_scale.min && *m_rating <= m_scale.max) {
        painter.setBrush(palette().color(QPalette::Highlight));
        painter.setPen(QPen(palette().color(QPalette::Window), thick));
        painter.drawEllipse(QPointF(pointOf(*m_rating)), where.height() * 0.4, where.height() * 0.4);
    }
    if (hasFocus()) {
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
        painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 8, 8);
    }
}

void ScaleLine::pick(Tenths rating)
{
    setRating(rating);
    Q_EMIT ratingPicked(rating);
}

void ScaleLine::pickAt(double x)
{
    const QRectF where = line();
    pick(ratingAt((x - where.left()) / where.width(), m_scale));
}

void ScaleLine::mousePressEvent(QMouseEvent* event)
{
    if (m_use == Use::Pick && event->button() == Qt::LeftButton)
        pickAt(event->position().x());
    else
        QWidget::mousePressEvent(event);
}

void ScaleLine::mouseMoveEvent(QMouseEvent* event)
{
    if (m_use == Use::Pick && event->buttons().testFlag(Qt::LeftButton)) pickAt(event->position().x());
}

void ScaleLine::keyPressEvent(QKeyEvent* event)
{
    const int direction = event->key() == Qt::Key_Right ? 1 : event->key() == Qt::Key_Left ? -1 : 0;
    if (m_use != Use::Pick || direction == 0) {
        QWidget::keyPressEvent(event);
        return;
    }
    const int from = m_rating ? m_rating->value : (m_scale.min.value + m_scale.max.value) / 2;
    pick(Tenths{std::clamp(from + direction * m_scale.step.value, m_scale.min.value, m_scale.max.value)});
}

}  // namespace study::app
