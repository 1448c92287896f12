#include "study/looking/map_panels.h"

#include <QFontMetricsF>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "study/looking/relief_picture.h"

namespace study::looking {

namespace {

QString unitText(const std::string& unit) { return QString::fromStdString(unit); }

/// The image resized to `size`. Enlarging repeats the pixels, so that a map of few values keeps its steps.
cv::Mat fitted(const cv::Mat& image, QSize size)
{
    cv::Mat result;
    const bool isSmaller = size.width() < image.cols || size.height() < image.rows;
    cv::resize(image, result, {size.width(), size.height()}, 0, 0, isSmaller ? cv::INTER_AREA : cv::INTER_NEAREST);
    return result;
}

QImage imageOf(const SeenMap& map, const SignalFacts& facts, QSize size, const SheetStyle& style)
{
    if (!map.colours.empty()) {
        const cv::Mat small = fitted(map.colours, size);
        return QImage(small.data, small.cols, small.rows, static_cast<qsizetype>(small.step), QImage::Format_RGB888).copy();
    }
    const Palette palette = map.storedRange ? Palette::Grey : Palette::Colours;
    const double low = map.storedRange ? map.storedRange->lowest : facts.min.value_or(0),
                 high = map.storedRange ? map.storedRange->highest : facts.max.value_or(1);
    return pictureOf(fitted(map.values, size), low, high, palette, style.attention);
}

/// Colour bar beside a map, with the values at its ends.
void drawColourBar(QPainter& painter, const QRectF& place, const SeenMap& map, const SignalFacts& facts, const SheetStyle& style)
{
    painter.setFont(fontOf(style, 0.8));
    const double textHeight = QFontMetricsF(painter.font()).height() * 1.2;
    const QRectF bar = place.adjusted(0, textHeight, -(place.width() - 14), -textHeight);
    for (int step = 0; step < static_cast<int>(bar.height()); ++step) {
        const double fraction = 1 - step / bar.height();
        const int level = static_cast<int>(std::lround(255 * fraction));
        painter.fillRect(QRectF(bar.left(), bar.top() + step, bar.width(), 1),
                         map.storedRange ? QColor(level, level, level) : colourOf(fraction));
    }
    const double low = map.storedRange ? map.storedRange->lowest : facts.min.value_or(0),
                 high = map.storedRange ? map.storedRange->highest : facts.max.value_or(0);
    painter.setPen(style.quietText);
    painter.drawText(QRectF(place.left(), place.top(), place.width(), textHeight), Qt::AlignLeft | Qt::AlignTop,
                     QString::fromStdString(figure(high)));
    painter.drawText(QRectF(place.left(), bar.bottom(), place.width(), textHeight), Qt::AlignLeft | Qt::AlignBottom,
                     QString::fromStdString(figure(low)));
    painter.save();
    painter.translate(bar.right() + textHeight * 0.55, bar.center().y());
    painter.rotate(-90);
    painter.drawText(QRectF(-bar.height() / 2, -textHeight / 2, bar.height(), textHeight), Qt::AlignCenter, unitText(map.unit));
    painter.restore();
}

/// Marks the row of the profile by arrows at both ends, and the part shown as relief by a frame.
void markPlaces(QPainter& painter, const QRectF& picture, const SeenMap& map, const QRect& part, const SheetStyle& style)
{
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(style.accent);
    const double y = picture.top() + (map.values.rows / 2 + 0.5) / map.values.rows * picture.height();
    for (const int side : {-1, 1}) {
        const double x = side < 0 ? picture.left() - 1 : picture.right() + 1;
        painter.drawPolygon(QPolygonF{QPointF(x, y), QPointF(x + side * 8, y - 5), QPointF(x + side * 8, y + 5)});
    }
    const double scaleX = picture.width() / map.values.cols, scaleY = picture.height() / map.values.rows;
    const QRectF framed(picture.left() + part.left() * scaleX, picture.top() + part.top() * scaleY, part.width() * scaleX,
                        part.height() * scaleY);
    const bool isAll = part.width() == map.values.cols && part.height() == map.values.rows;
    painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {QPen(Qt::black, 3), QPen(Qt::white, 1)}) {
        painter.setPen(pen);
        if (!isAll) painter.drawRect(framed);
    }
    painter.restore();
}

/// Length in the map, in mm if the pitch is known, otherwise in pixels.
QString lengthText(double pixels, const std::optional<double>& mmPerPixel)
{
    return mmPerPixel ? QStringLiteral("%1 mm").arg(QString::fromStdString(roughFigure(pixels * *mmPerPixel)))
                      : QStringLiteral("%1 %2")
                            .arg(std::lround(pixels))
                            .arg(pixels == 1 ? QStringLiteral("pixel") : QStringLiteral("pixels"));
}

QString heightWords(const SeenMap& map, const ReliefPicture& relief)
{
    if (relief.pixelsPerUnit == 0) return QStringLiteral("flat");
    const bool isHeight = map.unit == "mm" && map.mmPerPixel;
    if (!isHeight) return map.storedRange ? QStringLiteral("bright is high") : QStringLiteral("large is high");
    const double factor = relief.pixelsPerUnit / (relief.pixelsPerValue / *map.mmPerPixel);
    return QStringLiteral("heights × %1").arg(QString::fromStdString(roughFigure(factor)));
}

}  // namespace

void drawPicture(QPainter& painter, const QRectF& place, const SeenMap& map, const SignalFacts& facts, const SheetStyle& style)
{
    const QRectF below = belowCaption(painter, place, QStringLiteral("Picture"), style);
    constexpr double arrows = 10, barHeight = 30;
    const double barWidth = map.colours.empty() ? style.fontPx * 4.6 : 0;
    const QRectF room = below.adjusted(arrows, 0, -arrows - barWidth, -barHeight);
    const double rows = map.values.rows * map.rowPitch;
    const double scale = std::min(room.width() / map.values.cols, room.height() / rows);
    const QSizeF size(std::max(1.0, map.values.cols * scale), std::max(1.0, rows * scale));
    const QRectF picture(QPointF(room.left(), room.top()), size);
    const QSize dots = (size * style.pixelRatio).toSize().expandedTo(QSize(1, 1));
    painter.drawImage(picture, imageOf(map, facts, dots, style));
    markPlaces(painter, picture, map, reliefPart(map.values, map.rowPitch), style);
    if (map.colours.empty())
        drawColourBar(
            painter, QRectF(picture.right() + arrows + 6, room.top(), barWidth - 6, std::max(picture.height(), 9 * style.fontPx)),
            map, facts, style);
    const bool isKnown = map.mmPerPixel.has_value();
    drawScaleBar(painter, QRectF(room.left(), picture.bottom() + 2, room.width(), barHeight),
                 isKnown ? scale / *map.mmPerPixel : scale, isKnown ? QStringLiteral("mm") : QStringLiteral("pixels"), style);
}

void drawRelief(QPainter& painter, const QRectF& place, const SeenMap& map, const SheetStyle& style)
{
    const QRect part = reliefPart(map.values, map.rowPitch);
    cv::Mat values = map.values(cv::Rect(part.left(), part.top(), part.width(), part.height())).clone();
    const int evenRows = std::max(1, static_cast<int>(std::lround(part.height() * map.rowPitch)));
    if (evenRows != part.height())
        cv::resize(values, values, {part.width(), evenRows}, 0, 0, cv::INTER_NEAREST);  // does not spread NaN
    const double captionHeight = style.fontPx * 1.6;
    const QSize size(static_cast<int>(place.width() * style.pixelRatio),
                     static_cast<int>((place.height() - captionHeight) * style.pixelRatio));
    const ReliefPicture relief = reliefOf(values, size, style.body);
    const QRectF below = belowCaption(
        painter, place,
        QStringLiteral("Relief of %1, %2").arg(lengthText(part.width(), map.mmPerPixel), heightWords(map, relief)), style);
    painter.drawImage(QRectF(below.topLeft(), QSizeF(size) / style.pixelRatio), relief.picture);
}

void drawProfile(QPainter& painter, const QRectF& place, const SeenMap& map, const SheetStyle& style)
{
    const QRectF below = belowCaption(painter, place, QStringLiteral("Profile along the middle row"), style);
    const double pitch = map.mmPerPixel.value_or(1);
    std::vector<double> places, values;
    for (int column = 0; column < map.values.cols; ++column) {
        places.push_back(column * pitch);
        values.push_back(map.values.at<float>(map.values.rows / 2, column));
    }
    const PlotAxis x{0, std::max(places.back(), pitch), map.mmPerPixel ? QStringLiteral("mm") : QStringLiteral("pixels")};
    PlotAxis y = axisAround(values, unitText(map.unit));
    if (map.storedRange) y = {map.storedRange->lowest, map.storedRange->highest, unitText(map.unit)};
    drawCurve(painter, drawAxes(painter, below, x, y, style), x, y, places, values, style);
}

}  // namespace study::looking
