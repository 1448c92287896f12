#include "study/looking/picture_decoder.h"

#include <QImageReader>

#include "protocols/files/errors.h"

namespace study::looking {

cv::Mat decodeByQt(const std::filesystem::path& file)
{
    QImageReader reader(QString::fromStdString(file.string()));
    reader.setAutoTransform(true);
    QImageReader::setAllocationLimit(1024);  // MiB; a camera's largest pictures
    const QImage image = reader.read().convertToFormat(QImage::Format_RGB888);
    if (image.isNull())
        throw protocols::badInput({"no image that can be read (" + reader.errorString().toStdString() + ")", file.string(),
                                   "PNG, JPEG, BMP, GIF, PPM or WebP", "convert it to PNG"});
    const cv::Mat view(image.height(), image.width(), CV_8UC3, const_cast<uchar*>(image.constBits()),
                       static_cast<size_t>(image.bytesPerLine()));
    return view.clone();
}

}  // namespace study::looking
