#include "study/looking/contact_sheet.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "study/looking/relief_picture.h"
#include "study/looking/seen_signal.h"

namespace study::looking {

namespace {

constexpr double margin = 18, gap = 14, nameWidth = 120, picture = 190, below = 48, traceWidth = 330, headHeight = 92,
                 lineHeight = 22;
constexpr double imageWidth = picture * 1.6;  // proportions of the display
constexpr int shownOfImage = 2;               // the sheet shows half of width and height, so that threads are visible

/// A column of the sheet.
struct SheetColumn {
    QString head, under;
    double width = 0;
};

std::vector<SheetColumn> columnsOf(const ContactSheet& sheet)
{
    std::vector<SheetColumn> columns{{QString(), QString(), nameWidth},
                                     {QStringLiteral("Photograph"), QString(), picture},
                                     {QStringLiteral("Measured height"), QString(), picture},
                                     {QStringLiteral("Generated height"), QStringLiteral("same colours"), picture},
                                     {QStringLiteral("Friction over the stroke"), QString(), traceWidth}};
    for (const std::string& name : sheet.frictionColumns)
        columns.push_back({QString::fromStdString(name), QStringLiteral("middle of the friction image"), imageWidth});
    return columns;
}

QColor generatedColour() { return QColor("#b4540a"); }

void drawNote(QPainter& painter, const QRectF& place, const QString& text, const SheetStyle& style)
{
    painter.setPen(QPen(style.line, 1, Qt::DashLine));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(place.adjusted(0.5, 0.5, -0.5, -0.5));
    painter.setFont(fontOf(style));
    painter.setPen(style.quietText);
    painter.drawText(place.adjusted(8, 8, -8, -8), Qt::AlignCenter | Qt::TextWordWrap, text);
}

QImage imageOf(const cv::Mat& values, const PlotAxis& range)
{
    if (values.type() == CV_8UC3)
        return QImage(values.data, values.cols, values.rows, static_cast<qsizetype>(values.step), QImage::Format_RGB888).copy();
    return pictureOf(values, range.low, range.high, Palette::Colours, QColor(Qt::white));
}

/// The middle square of a map. Its side is `sideMm` if the scale of the map is known, otherwise as long as possible.
cv::Mat middleOf(const ContactMap& map, std::optional<double> sideMm)
{
    const int least = std::min(map.values.cols, map.values.rows);
    const int side =
        sideMm && map.mmPerPixel ? std::clamp(static_cast<int>(std::lround(*sideMm / *map.mmPerPixel)), 1, least) : least;
    return map.values({(map.values.cols - side) / 2, (map.values.rows - side) / 2, side, side});
}

/// Side in mm that every map of known scale in the row covers.
std::optional<double> commonSide(const ContactRow& row)
{
    std::optional<double> side;
    for (const ContactMap* map : {&row.photograph, &row.measuredHeight, &row.generatedHeight})
        if (!map->values.empty() && map->mmPerPixel) {
            const double whole = std::min(map->values.cols, map->values.rows) * *map->mmPerPixel;
            side = std::min(side.value_or(whole), whole);
        }
    return side;
}

void drawMap(QPainter& painter, const QRectF& place, const ContactMap& map, std::optional<double> sideMm, const PlotAxis& range,
             const SheetStyle& style)
{
    const cv::Mat shown = middleOf(map, sideMm);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    const QImage image = imageOf(shown, range);
    const QSize target = (place.size() * style.pixelRatio).toSize();
    painter.drawImage(place, image.scaled(target, Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    const QRectF under(place.left(), place.bottom() + 2, place.width(), lineHeight);
    if (map.mmPerPixel)
        drawScaleBar(painter, under, place.width() / (shown.cols * *map.mmPerPixel), QStringLiteral("mm"), style);
    else {
        painter.setFont(fontOf(style, 0.85));
        painter.setPen(style.quietText);
        painter.drawText(under, Qt::AlignLeft | Qt::AlignVCenter, QStringLiteral("scale unknown"));
    }
}

/// Range of both heights of the row, so that equal colours mean equal heights.
PlotAxis commonRange(const ContactRow& row)
{
    std::vector<double> ends;
    for (const ContactMap* map : {&row.measuredHeight, &row.generatedHeight})
        if (!map->values.empty()) {
            double low = 0, high = 0;
            cv::minMaxLoc(map->values, &low, &high);
            ends.insert(ends.end(), {low, high});
        }
    if (ends.empty()) return {};
    const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
    return {*low, *high, QStringLiteral("mm")};
}

/// Colour bar with its ends in mm.
void drawColours(QPainter& painter, const QRectF& place, const PlotAxis& range, const SheetStyle& style)
{
    const QString low = QStringLiteral("%1 mm").arg(range.low, 0, 'f', 2),
                  high = QStringLiteral("%1 mm").arg(range.high, 0, 'f', 2);
    painter.setFont(fontOf(style, 0.85));
    painter.setPen(style.text);
    const QFontMetricsF metrics(painter.font());
    const double lowWidth = metrics.horizontalAdvance(low) + 5, highWidth = metrics.horizontalAdvance(high) + 5;
    painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, low);
    painter.drawText(place, Qt::AlignRight | Qt::AlignVCenter, high);
    const QRectF strip = place.adjusted(lowWidth, 8, -highWidth, -8);
    for (int i = 0; i < 24; ++i)
        painter.fillRect(QRectF(strip.left() + strip.width() * i / 24, strip.top(), strip.width() / 24 + 0.5, strip.height()),
                         colourOf(i / 23.0));
}

void drawHeight(QPainter& painter, const QRectF& place, const ContactMap& map, const char* lack, const ContactRow& row,
                const SheetStyle& style)
{
    if (map.values.empty()) {
        drawNote(painter, place, QString::fromUtf8(lack), style);
        return;
    }
    const PlotAxis range = commonRange(row);
    drawMap(painter, place, map, commonSide(row), range, style);
    drawColours(painter, QRectF(place.left(), place.bottom() + lineHeight + 1, place.width(), lineHeight), range, style);
}

std::vector<double> placesOf(const ContactTrace& trace)
{
    std::vector<double> places(trace.values.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<double>(i) * trace.mmPerSample;
    return places;
}

void drawLegend(QPainter& painter, const QRectF& place, const ContactRow& row, const SheetStyle& style)
{
    painter.setFont(fontOf(style, 0.85));
    const QFontMetricsF metrics(painter.font());
    double left = place.left();
    const auto entry = [&](const QString& text, const QColor& colour) {
        painter.fillRect(QRectF(left, place.center().y() - 1.5, 18, 3), colour);
        painter.setPen(style.text);
        left += 23;
        painter.drawText(QRectF(left, place.top(), place.width(), place.height()), Qt::AlignLeft | Qt::AlignVCenter, text);
        left += metrics.horizontalAdvance(text) + 16;
    };
    const bool isCoefficient = row.measuredQuantity == "mu";
    if (!row.measuredFriction.values.empty())
        entry(isCoefficient ? QStringLiteral("measured") : QStringLiteral("measured: not a coefficient"), style.accent);
    else
        entry(QStringLiteral("not measured"), style.line);
    if (!row.generatedFriction.values.empty()) entry(QStringLiteral("generated"), generatedColour());
}

/// Draws both traces over the same axes. A measured quantity that is not a coefficient is left out if there is a generated trace.
void drawFriction(QPainter& painter, const QRectF& place, const ContactRow& row, const SheetStyle& style)
{
    const ContactTrace &measured = row.measuredFriction, &generated = row.generatedFriction;
    const bool isCoefficient = row.measuredQuantity == "mu";
    const bool drawsMeasured = !measured.values.empty() && (isCoefficient || generated.values.empty());
    if (!drawsMeasured && generated.values.empty()) {
        drawNote(painter, place.adjusted(0, 0, 0, -lineHeight), QStringLiteral("neither measured nor generated"), style);
        return;
    }
    std::vector<double> all = generated.values;
    if (drawsMeasured) all.insert(all.end(), measured.values.begin(), measured.values.end());
    const auto lengthOf = [](const ContactTrace& trace) { return static_cast<double>(trace.values.size()) * trace.mmPerSample; };
    const PlotAxis x{0, std::max({drawsMeasured ? lengthOf(measured) : 0, lengthOf(generated), 1e-9}), QStringLiteral("mm")};
    const PlotAxis y = axisAround(
        all, isCoefficient || !drawsMeasured ? QStringLiteral("coefficient") : QString::fromStdString(row.measuredQuantity));
    const QRectF inside = drawAxes(painter, place.adjusted(0, 0, 0, -2), x, y, style);
    if (drawsMeasured) drawCurve(painter, inside, x, y, placesOf(measured), measured.values, style);
    SheetStyle second = style;
    second.accent = generatedColour();
    drawCurve(painter, inside, x, y, placesOf(generated), generated.values, second);
    drawLegend(painter, QRectF(place.left() + place.width() * 0.3, place.top(), place.width() * 0.7, 18), row, style);
}

void drawFrictionImage(QPainter& painter, const QRectF& place, const cv::Mat& image, const SheetStyle& style)
{
    if (image.empty()) {
        drawNote(painter, place, QStringLiteral("not rendered"), style);
        return;
    }
    const int width = image.cols / shownOfImage, height = image.rows / shownOfImage;
    const cv::Mat middle = image({(image.cols - width) / 2, (image.rows - height) / 2, width, height});
    const QImage shown(middle.data, middle.cols, middle.rows, static_cast<qsizetype>(middle.step), QImage::Format_Grayscale8);
    painter.drawImage(place,
                      shown.scaled((place.size() * style.pixelRatio).toSize(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation));
    painter.setFont(fontOf(style, 0.85));
    painter.setPen(style.quietText);
    painter.drawText(QRectF(place.left(), place.bottom() + 2, place.width(), lineHeight), Qt::AlignLeft | Qt::AlignVCenter,
                     QStringLiteral("%1 × %2 of %3 × %4 px").arg(width).arg(height).arg(image.cols).arg(image.rows));
}

void drawName(QPainter& painter, const QRectF& place, const ContactRow& row, const SheetStyle& style)
{
    painter.setPen(style.text);
    painter.setFont(fontOf(style, 1.15, true));
    painter.drawText(place, Qt::AlignLeft | Qt::AlignTop, QString::fromStdString(row.id));
    const double head = QFontMetricsF(painter.font()).height() + 4;
    painter.setFont(fontOf(style));
    const QString name = QString::fromStdString(row.name);
    painter.drawText(place.adjusted(0, head, 0, 0), Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap, name);
    const double lines = QFontMetricsF(painter.font()).boundingRect(place, Qt::TextWordWrap, name).height();
    painter.setFont(fontOf(style, 0.85));
    painter.setPen(style.onAttention);
    painter.drawText(place.adjusted(0, head + lines + 8, 0, 0), Qt::AlignLeft | Qt::AlignTop | Qt::TextWordWrap,
                     QString::fromStdString(row.remark));
}

void drawHead(QPainter& painter, const ContactSheet& sheet, const std::vector<SheetColumn>& columns, const SheetStyle& style)
{
    painter.setPen(style.text);
    painter.setFont(fontOf(style, 1.4, true));
    painter.drawText(QPointF(margin, margin + 20), QString::fromStdString(sheet.title));
    double left = margin;
    for (const SheetColumn& column : columns) {
        painter.setFont(fontOf(style, 1, true));
        painter.setPen(style.text);
        painter.drawText(QRectF(left, headHeight - 44, column.width, 20), Qt::AlignLeft | Qt::AlignVCenter, column.head);
        painter.setFont(fontOf(style, 0.85));
        painter.setPen(style.quietText);
        painter.drawText(QRectF(left, headHeight - 24, column.width, 18), Qt::AlignLeft | Qt::AlignVCenter, column.under);
        left += column.width + gap;
    }
}

void drawRow(QPainter& painter, double top, const ContactRow& row, const std::vector<SheetColumn>& columns,
             const SheetStyle& style)
{
    double left = margin;
    std::size_t column = 0;
    const auto next = [&] {
        const QRectF place(left, top, columns[column].width, picture);
        left += columns[column++].width + gap;
        return place;
    };
    drawName(painter, next(), row, style);
    const QRectF photograph = next();
    if (row.photograph.values.empty())
        drawNote(painter, photograph, QStringLiteral("no photograph"), style);
    else
        drawMap(painter, photograph, row.photograph, commonSide(row), {}, style);
    drawHeight(painter, next(), row.measuredHeight, "not measured", row, style);
    drawHeight(painter, next(), row.generatedHeight, "not generated", row, style);
    drawFriction(painter, next().adjusted(0, 0, 0, lineHeight), row, style);
    for (const cv::Mat& image : row.frictionImages) drawFrictionImage(painter, next(), image, style);
}

}  // namespace

QImage drawContactSheet(const ContactSheet& sheet, const SheetStyle& style)
{
    assert(!sheet.rows.empty() && "a contact sheet needs at least one row");
    const std::vector<SheetColumn> columns = columnsOf(sheet);
    double width = 2 * margin - gap;
    for (const SheetColumn& column : columns) width += column.width + gap;
    const double rowHeight = picture + below + gap;
    const double height = headHeight + static_cast<double>(sheet.rows.size()) * rowHeight + margin;
    constexpr double largestPx = 32000;
    if (height * style.pixelRatio > largestPx)
        throw protocols::badInput(
            {"the sheet would be " + std::to_string(static_cast<int>(height * style.pixelRatio)) + " px high", "--sheet",
             "at most 32000 px", "name fewer fabrics with --fabric"});
    QImage image((QSizeF(width, height) * style.pixelRatio).toSize(), QImage::Format_RGB32);
    image.setDevicePixelRatio(style.pixelRatio);
    image.fill(style.surface);
    QPainter painter(&image);
    drawHead(painter, sheet, columns, style);
    double top = headHeight;
    for (const ContactRow& row : sheet.rows) {
        assert(row.frictionImages.size() == sheet.frictionColumns.size() && "one friction image for each column");
        drawRow(painter, top, row, columns, style);
        top += rowHeight;
    }
    return image;
}

}  // namespace study::looking
