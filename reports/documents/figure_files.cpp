#include "reports/documents/figure_files.h"

#include <QBuffer>
#include <QImage>
#include <QPageSize>
#include <QPainter>
#include <QPdfWriter>

#include "protocols/files/whole_file.h"
#include "reports/documents/drawing_painter.h"

namespace reports {
namespace {

constexpr double mmPerInch = 25.4;
constexpr int imageDpi = 300;

QSizeF sizeMm(const std::string& svg, double widthMm)
{
    const QSizeF own = drawingSize(svg);
    return own.isEmpty() ? QSizeF(widthMm, widthMm / 2) : QSizeF(widthMm, widthMm * own.height() / own.width());
}

}  // namespace

void writeFigurePdf(const std::string& svg, const std::string& caption, const std::filesystem::path& file, double widthMm)
{
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    {
        QPdfWriter writer(&buffer);
        const QSizeF size = sizeMm(svg, widthMm);
        writer.setPageSize(QPageSize(size, QPageSize::Millimeter, QString(), QPageSize::ExactMatch));
        writer.setPageMargins({});
        writer.setResolution(1200);
        writer.setTitle(QString::fromStdString(caption));
        QPainter painter(&writer);
        paintDrawing(painter, svg, QRectF(0, 0, writer.width(), writer.height()));
    }
    protocols::writeWholeFile(file, bytes.toStdString(), protocols::Sync::Later);
}

void writeFigurePng(const Figure& figure, const std::filesystem::path& file, double widthMm)
{
    const QSizeF size = sizeMm(figure.svg, widthMm) * (imageDpi / mmPerInch);
    QImage image(size.toSize(), QImage::Format_RGB32);
    image.setDotsPerMeterX(int(imageDpi * 1000 / mmPerInch));
    image.setDotsPerMeterY(int(imageDpi * 1000 / mmPerInch));
    image.fill(Qt::white);
    QPainter painter(&image);
    paintDrawing(painter, figure.svg, QRectF(QPointF(), size));
    painter.end();
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    image.save(&buffer, "PNG");
    protocols::writeWholeFile(file, bytes.toStdString(), protocols::Sync::Later);
}

}  // namespace reports
