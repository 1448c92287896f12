#include "study/looking/plot.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>
#include <optional>

#include "protocols/files/svg_drawing.h"

namespace study::looking {

namespace {

double across(const QRectF& inside, const PlotAxis& axis, double value)
{
    return inside.left() + (value - axis.low) / (axis.high - axis.low) * inside.width();
}

double up(const QRectF& inside, const PlotAxis& axis, double value)
{
    return inside.bottom() - (value - axis.low) / (axis.high - axis.low) * inside.height();
}

double stepOf(const std::vector<double>& ticks)
{
    return ticks.size() > 1 ? ticks[1] - ticks[0] : std::abs(ticks.empty() ? 1 : ticks[0]);
}

QString labelOf(const PlotAxis& axis, double tick, double step)
{
    return axis.isLogarithmic ? QString::number(std::pow(10, tick), 'g', 2) : tickText(tick, step);
}

std::vector<double> ticksOf(const PlotAxis& axis, int wanted)
{
    if (!axis.isLogarithmic) return ticksBetween(axis.low, axis.high, wanted);
    const double step = std::max(1.0, std::ceil((axis.high - axis.low) / std::max(1, wanted)));
    std::vector<double> decades;
    for (int i = 0; i < protocols::mostTicks && std::ceil(axis.low) + i * step <= axis.high; ++i)
        decades.push_back(std::ceil(axis.low) + i * step);
    return decades;
}

/// Horizontal grid lines with their labels on the left.
void drawRows(QPainter& painter, const QRectF& inside, double left, double labelWidth, const PlotAxis& y,
              const std::vector<double>& ticks, const SheetStyle& style)
{
    const double height = QFontMetricsF(painter.font()).height();
    for (const double tick : ticks) {
        const double at = up(inside, y, tick);
        painter.setPen(style.line);
        painter.drawLine(QPointF(inside.left(), at), QPointF(inside.right(), at));
        painter.setPen(style.quietText);
        painter.drawText(QRectF(left, at - height / 2, labelWidth, height), Qt::AlignRight | Qt::AlignVCenter,
                         labelOf(y, tick, stepOf(ticks)));
    }
}

/// Horizontal axis with its ticks and the unit at its end. Labels that would touch the unit are left out.
void drawColumns(QPainter& painter, const QRectF& inside, const QRectF& place, const PlotAxis& x, const SheetStyle& style)
{
    const QFontMetricsF metrics(painter.font());
    const QRectF labels(place.left(), inside.bottom() + 2, place.width() - 2, place.bottom() - inside.bottom());
    const double unitBegins = labels.right() - metrics.horizontalAdvance(x.unit) - 6;
    const auto ticks = ticksOf(x, static_cast<int>(inside.width() / (metrics.averageCharWidth() * 9)));
    for (const double tick : ticks) {
        const QString text = labelOf(x, tick, stepOf(ticks));
        const double at = across(inside, x, tick), half = metrics.horizontalAdvance(text) / 2;
        painter.setPen(style.line);
        painter.drawLine(QPointF(at, inside.bottom()), QPointF(at, inside.bottom() + 4));
        painter.setPen(style.quietText);
        if (at + half < unitBegins)
            painter.drawText(QRectF(std::max(at - half, labels.left()), labels.top(), 2 * half + 1, labels.height()),
                             Qt::AlignLeft | Qt::AlignBottom, text);
    }
    painter.setPen(style.quietText);
    painter.drawText(labels, Qt::AlignRight | Qt::AlignBottom, x.unit);
    painter.drawLine(inside.bottomLeft(), inside.bottomRight());
}

struct ValueExtent {
    std::optional<double> low, high;
};

/// Extent of all samples in the pixel column of sample `i`. Moves `i` to the first sample after this column, always by at
/// least one: a place outside the numbers of the axis has the column NaN, which equals no column.
ValueExtent extentOfColumn(const QRectF& inside, const PlotAxis& x, const std::vector<double>& places,
                           const std::vector<double>& values, std::size_t& i)
{
    ValueExtent extent;
    const double column = std::floor(across(inside, x, places[i]));
    do {
        if (std::isfinite(values[i])) {
            extent.low = std::min(extent.low.value_or(values[i]), values[i]);
            extent.high = std::max(extent.high.value_or(values[i]), values[i]);
        }
        ++i;
    } while (i < values.size() && std::floor(across(inside, x, places[i])) == column);
    return extent;
}

}  // namespace

SheetStyle lightSheet()
{
    return {.background = QColor("#f4f3ef"),
            .surface = QColor("#ffffff"),
            .text = QColor("#1d2430"),
            .quietText = QColor("#566070"),
            .line = QColor("#c9cdd4"),
            .accent = QColor("#1f5c99"),
            .attention = QColor("#fff0c9"),
            .onAttention = QColor("#5a4200"),
            .body = QColor("#cfd6df")};
}

SheetStyle darkSheet()
{
    return {.background = QColor("#15181d"),
            .surface = QColor("#1f242c"),
            .text = QColor("#e8eaee"),
            .quietText = QColor("#a9b1bd"),
            .line = QColor("#3d4653"),
            .accent = QColor("#8fb8ee"),
            .attention = QColor("#4a3a12"),
            .onAttention = QColor("#ffe4a3"),
            .body = QColor("#b7c0cc")};
}

QFont fontOf(const SheetStyle& style, double factor, bool isBold)
{
    QFont font;
    font.setPixelSize(std::max(6, static_cast<int>(std::lround(style.fontPx * factor))));
    font.setBold(isBold);
    return font;
}

double roundStep(double most)
{
    const double decade = std::pow(10, std::floor(std::log10(most)));
    for (const double factor : {5.0, 2.0})
        if (factor * decade <= most * (1 + 1e-9)) return factor * decade;
    return decade;
}

std::vector<double> ticksBetween(double low, double high, int wanted)
{
    if (!(high > low)) return {low};
    auto ticks = protocols::multiplesBetween(low, high, roundStep(2 * (high - low) / std::max(1, wanted)));
    if (ticks.empty()) ticks.push_back(low);  // the axis is shorter than the digits of its numbers
    return ticks;
}

QString tickText(double value, double step)
{
    if (std::abs(value) < 1e-9 * step) return QStringLiteral("0");
    const double size = std::max(std::abs(value), step);
    if (size >= 1e6 || step < 1e-6) return QString::number(value, 'g', 3);
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    return QString::number(value, 'f', decimals);
}

QRectF belowCaption(QPainter& painter, const QRectF& place, const QString& caption, const SheetStyle& style)
{
    painter.setFont(fontOf(style, 0.9, true));
    painter.setPen(style.quietText);
    const QFontMetricsF metrics(painter.font());
    const double height = metrics.height() * 1.35;
    painter.drawText(QRectF(place.left(), place.top(), place.width(), height), Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(caption, Qt::ElideRight, place.width()));
    return place.adjusted(0, height, 0, 0);
}

PlotAxis axisAround(const std::vector<double>& values, const QString& unit)
{
    std::optional<double> low, high;
    for (const double value : values)
        if (std::isfinite(value)) {
            low = std::min(low.value_or(value), value);
            high = std::max(high.value_or(value), value);
        }
    if (!low) return {0, 1, unit};
    double room = 0.06 * (*high - *low);
    if (!(room > 1e-9 * std::max(std::abs(*low), std::abs(*high)))) room = *low == 0 ? 1 : std::abs(*low) / 2;
    return {*low - room, *high + room, unit};
}

QRectF drawAxes(QPainter& painter, const QRectF& place, const PlotAxis& x, const PlotAxis& y, const SheetStyle& style)
{
    painter.setFont(fontOf(style, 0.8));
    const QFontMetricsF metrics(painter.font());
    const auto rows = ticksOf(y, static_cast<int>(place.height() / (2.2 * metrics.height())));
    double widest = 0;
    for (const double tick : rows) widest = std::max(widest, metrics.horizontalAdvance(labelOf(y, tick, stepOf(rows))));
    const double above = metrics.height() * 1.75, below = metrics.height() * 1.35;
    const QRectF inside = place.adjusted(widest + 8, above, -2, -below);
    painter.setPen(style.quietText);
    painter.drawText(QRectF(place.left(), place.top(), place.width(), above), Qt::AlignLeft | Qt::AlignTop, y.unit);
    drawRows(painter, inside, place.left(), widest, y, rows, style);
    drawColumns(painter, inside, place, x, style);
    return inside;
}

void drawCurve(QPainter& painter, const QRectF& inside, const PlotAxis& x, const PlotAxis& y, const std::vector<double>& places,
               const std::vector<double>& values, const SheetStyle& style)
{
    painter.save();
    painter.setClipRect(inside.adjusted(-2, -2, 2, 2));
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(style.accent, 1.3));
    std::optional<QPointF> before;
    std::size_t i = 0;
    while (i < values.size()) {
        const std::size_t first = i;
        const ValueExtent extent = extentOfColumn(inside, x, places, values, i);
        const bool isOne = i == first + 1;
        const double at = isOne ? across(inside, x, places[first]) : std::floor(across(inside, x, places[first])) + 0.5;
        if (!extent.low || !std::isfinite(at)) {
            before.reset();  // a gap
            continue;
        }
        const QPointF top(at, up(inside, y, *extent.high)), bottom(at, up(inside, y, *extent.low));
        const bool isTopNearer = before && std::abs(before->y() - top.y()) < std::abs(before->y() - bottom.y());
        if (before)
            painter.drawLine(*before, isTopNearer ? top : bottom);
        else if (isOne && (i == values.size() || !std::isfinite(values[i])))
            painter.drawEllipse(top, 1.5, 1.5);  // a single sample between gaps
        if (!isOne) painter.drawLine(top, bottom);
        before = bottom;
    }
    painter.restore();
}

void drawScaleBar(QPainter& painter, const QRectF& place, double pixelsPerUnit, const QString& unit, const SheetStyle& style)
{
    // A bar shorter than one pixel has no meaning.
    const double shortest = unit == QStringLiteral("pixels") ? 1 : 1e-12;
    const double length = roundStep(std::max(shortest, place.width() * 0.42 / pixelsPerUnit));
    const QString text = QStringLiteral("%1 %2").arg(
        length >= 1e5 || length < 1e-4 ? QString::number(length, 'g', 3) : tickText(length, length), unit);
    const double barWidth = length * pixelsPerUnit, middle = place.center().y();
    painter.fillRect(QRectF(place.left(), middle - 2, barWidth, 4), style.text);
    for (const double end : {place.left(), place.left() + barWidth - 2})
        painter.fillRect(QRectF(end, middle - 6, 2, 12), style.text);
    painter.setFont(fontOf(style, 0.9));
    painter.setPen(style.text);
    painter.drawText(QRectF(place.left() + barWidth + 10, place.top(), place.width(), place.height()),
                     Qt::AlignLeft | Qt::AlignVCenter, text);
}

}  // namespace study::looking
