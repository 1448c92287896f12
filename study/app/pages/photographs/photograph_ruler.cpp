#include "study/app/pages/photographs/photograph_ruler.h"

#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// A line that is seen on light and on dark fabrics.
template <class Draw>
void drawOutlined(QPainter& painter, double thick, const QColor& colour, Draw draw)
{
    painter.setPen(QPen(Qt::black, 2.4 * thick, Qt::SolidLine, Qt::RoundCap));
    draw();
    painter.setPen(QPen(colour, thick, Qt::SolidLine, Qt::RoundCap));
    draw();
}

}  // namespace

PhotographRuler::PhotographRuler(QWidget* parent) : QWidget(parent)
{
    name(*this, "photographRuler", tr("Ruler on the photograph"));
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::CrossCursor);
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    describe();
}

void PhotographRuler::setPhotograph(const QImage& picture, const QSize& sizePx)
{
    m_picture = picture;
    if (sizePx != m_sizePx) {
        m_pointsPx.clear();
        m_crossPx = QPointF(sizePx.width() / 2.0, sizePx.height() / 2.0);
    }
    m_sizePx = sizePx;
    describe();
    updateGeometry();
    update();
}

std::optional<double> PhotographRuler::lengthPx() const
{
    if (m_pointsPx.size() < 2) return std::nullopt;
    return QLineF(m_pointsPx[0], m_pointsPx[1]).length();
}

int PhotographRuler::heightForWidth(int width) const
{
    constexpr int mostLines = 22;
    const int most = fontMetrics().height() * mostLines;
    if (m_sizePx.isEmpty()) return fontMetrics().height() * 6;
    return std::clamp(width * m_sizePx.height() / m_sizePx.width(), fontMetrics().height() * 6, most);
}

QSize PhotographRuler::sizeHint() const
{
    const int width = fontMetrics().height() * 28;
    return {width, heightForWidth(width)};
}

QSize PhotographRuler::minimumSizeHint() const { return {fontMetrics().height() * 8, fontMetrics().height() * 6}; }

QRectF PhotographRuler::shown() const
{
    const QSizeF size = QSizeF(m_sizePx).scaled(QSizeF(this->size()), Qt::KeepAspectRatio);
    return {QPointF(0, (height() - size.height()) / 2), size};
}

QPoint PhotographRuler::placeOf(const QPointF& pointPx) const
{
    const QRectF where = shown();
    return QPointF(where.left() + where.width() * pointPx.x() / m_sizePx.width(),
                   where.top() + where.height() * pointPx.y() / m_sizePx.height())
        .toPoint();
}

void PhotographRuler::paintEvent(QPaintEvent*)
{
    QPainter painter(this);
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    if (m_picture.isNull()) return;
    painter.drawImage(shown(), m_picture);
    const double unit = fontMetrics().height() / 8.0;
    const QColor bright(255, 225, 77);
    if (m_pointsPx.size() == 2)
        drawOutlined(painter, unit, bright, [&] { painter.drawLine(placeOf(m_pointsPx[0]), placeOf(m_pointsPx[1])); });
    painter.setBrush(Qt::NoBrush);
    for (const QPointF& point : m_pointsPx)
        drawOutlined(painter, unit, bright, [&] { painter.drawEllipse(QPointF(placeOf(point)), 4 * unit, 4 * unit); });
    if (!hasFocus()) return;
    const QPointF cross = placeOf(m_crossPx);
    drawOutlined(painter, unit / 2, Qt::white, [&] {
        painter.drawLine(cross - QPointF(8 * unit, 0), cross + QPointF(8 * unit, 0));
        painter.drawLine(cross - QPointF(0, 8 * unit), cross + QPointF(0, 8 * unit));
    });
    painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
    painter.drawRect(shown().adjusted(1, 1, -1, -1));
}

void PhotographRuler::setPoint(const QPointF& pointPx)
{
    if (m_pointsPx.size() == 2) m_pointsPx.clear();
    m_crossPx = pointPx;
    m_pointsPx.push_back(pointPx);
    describe();
    update();
    Q_EMIT pointsChanged();
}

void PhotographRuler::removePoints()
{
    m_pointsPx.clear();
    describe();
    update();
    Q_EMIT pointsChanged();
}

void PhotographRuler::describe()
{
    QString text = tr("No point is marked.");
    if (m_pointsPx.size() == 1) text = tr("One point is marked.");
    if (const auto length = lengthPx()) text = tr("Two points are marked, %1 px apart.").arg(std::lround(*length));
    setAccessibleDescription(text);
}

void PhotographRuler::mousePressEvent(QMouseEvent* event)
{
    const QRectF where = shown();
    if (event->button() != Qt::LeftButton || m_picture.isNull() || !where.contains(event->position()))
        return QWidget::mousePressEvent(event);
    const QPointF inside = event->position() - where.topLeft();
    setPoint({inside.x() / where.width() * m_sizePx.width(), inside.y() / where.height() * m_sizePx.height()});
}

void PhotographRuler::moveCross(int key, bool isFine)
{
    constexpr double coarse = 0.02, fine = 0.001;
    const double step = std::max(1.0, m_sizePx.width() * (isFine ? fine : coarse));
    if (key == Qt::Key_Left) m_crossPx.rx() -= step;
    if (key == Qt::Key_Right) m_crossPx.rx() += step;
    if (key == Qt::Key_Up) m_crossPx.ry() -= step;
    if (key == Qt::Key_Down) m_crossPx.ry() += step;
    m_crossPx.setX(std::clamp(m_crossPx.x(), 0.0, 1.0 * m_sizePx.width()));
    m_crossPx.setY(std::clamp(m_crossPx.y(), 0.0, 1.0 * m_sizePx.height()));
    update();
}

void PhotographRuler::keyPressEvent(QKeyEvent* event)
{
    const bool isArrow = event->key() == Qt::Key_Left || event->key() == Qt::Key_Right || event->key() == Qt::Key_Up ||
                         event->key() == Qt::Key_Down;
    if (m_picture.isNull())
        QWidget::keyPressEvent(event);
    else if (isArrow)
        moveCross(event->key(), event->modifiers().testFlag(Qt::ShiftModifier));
    else if (event->key() == Qt::Key_Space)
        setPoint(m_crossPx);
    else if (event->key() == Qt::Key_Delete || event->key() == Qt::Key_Backspace)
        removePoints();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
