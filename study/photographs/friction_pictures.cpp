#include "study/photographs/friction_pictures.h"

#include <QFontMetricsF>
#include <QPainter>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"

namespace study::photographs {

namespace {

constexpr double heightOfWidth = 800.0 / 1280;  ///< shape of a friction image

QImage viewOf(const cv::Mat& image)
{
    const auto format = image.channels() == 1 ? QImage::Format_Grayscale8 : QImage::Format_RGB888;
    return QImage(image.data, image.cols, image.rows, static_cast<qsizetype>(image.step), format);
}

/// Fills the cell with the middle of the image.
void drawFilling(QPainter& painter, const QRectF& cell, const cv::Mat& image, double pixelRatio)
{
    if (image.empty()) return;
    const double scale = std::min(image.cols / cell.width(), image.rows / cell.height());
    const cv::Size part(std::clamp(static_cast<int>(cell.width() * scale), 1, image.cols),
                        std::clamp(static_cast<int>(cell.height() * scale), 1, image.rows));
    const cv::Mat middle = image({(image.cols - part.width) / 2, (image.rows - part.height) / 2, part.width, part.height});
    const cv::Size size(std::max(1, static_cast<int>(cell.width() * pixelRatio)),
                        std::max(1, static_cast<int>(cell.height() * pixelRatio)));
    cv::Mat small;
    cv::resize(middle, small, size, 0, 0, cv::INTER_AREA);
    painter.drawImage(cell, viewOf(small));
}

}  // namespace

QImage drawFrictionRows(const std::vector<FrictionRow>& rows, const QStringList& captions, int widthPx,
                        const looking::SheetStyle& style)
{
    constexpr double gap = 12;
    const auto columns = static_cast<double>(captions.size() + 1);
    const double cellWidth = std::max(40.0, (widthPx - gap * (columns + 1)) / columns);
    const double cellHeight = cellWidth * heightOfWidth;
    const QFontMetricsF metrics(looking::fontOf(style));
    const double line = metrics.height() * 1.4;
    const double rowHeight = line + cellHeight + gap;
    const double height = gap + static_cast<double>(rows.size()) * rowHeight;
    constexpr double mostPx = 32000;
    if (height * style.pixelRatio > mostPx)
        throw protocols::badInput({"the picture of " + std::to_string(rows.size()) + " fabrics would be too high",
                                   "friction images", "fewer fabrics", "render them with `vis2hap render`"});
    QImage picture(QSizeF(widthPx * style.pixelRatio, height * style.pixelRatio).toSize(), QImage::Format_RGB32);
    picture.setDevicePixelRatio(style.pixelRatio);
    picture.fill(style.surface);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    double top = gap;
    for (const FrictionRow& row : rows) {
        for (int column = 0; column < static_cast<int>(columns); ++column) {
            const double left = gap + column * (cellWidth + gap);
            const bool isPhotograph = column == 0;
            painter.setFont(looking::fontOf(style, 1, isPhotograph));
            painter.setPen(isPhotograph ? style.text : style.quietText);
            const QString caption = isPhotograph ? QString::fromStdString(row.name) : captions[column - 1];
            painter.drawText(QRectF(left, top, cellWidth, line), Qt::AlignLeft | Qt::AlignVCenter,
                             QFontMetricsF(painter.font()).elidedText(caption, Qt::ElideRight, cellWidth));
            const QRectF cell(left, top + line, cellWidth, cellHeight);
            drawFilling(painter, cell, isPhotograph ? row.photograph : row.images.at(static_cast<std::size_t>(column - 1)),
                        style.pixelRatio);
        }
        top += rowHeight;
    }
    return picture;
}

}  // namespace study::photographs
