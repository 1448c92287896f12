// Made-up scans for the tests: a periodic surface of known height, the normal map and the displacement that it has, and files of
// it as libraries publish them.
#pragma once

#include <QImage>
#include <cmath>
#include <opencv2/core.hpp>

#include "rendering/images/image_io.h"
#include "rendering/scans/import_scans.h"
#include "tests/rendering/fabric_files.h"
#include "tests/rendering/signals/oblique_waves.h"

namespace scan_folders {

namespace fs = std::filesystem;

/// Tangent normals in RGB; depth CV_8U or CV_16U.
inline cv::Mat normalMapOf(const rendering::signals::Slopes& slopes, int depth, bool greenUp)
{
    const double largest = depth == CV_8U ? 255 : 65535;
    cv::Mat normals(slopes.x.size(), CV_64FC3);
    for (int y = 0; y < normals.rows; ++y)
        for (int x = 0; x < normals.cols; ++x) {
            const double p = slopes.x.at<float>(y, x), q = slopes.y.at<float>(y, x), length = std::sqrt(1 + p * p + q * q);
            const double green = (greenUp ? q : -q) / length;
            normals.at<cv::Vec3d>(y, x) = {(1 - p / length) / 2 * largest, (1 + green) / 2 * largest,
                                           (1 + 1 / length) / 2 * largest};
        }
    cv::Mat stored;
    normals.convertTo(stored, CV_MAKETYPE(depth, 3));
    return stored;
}

/// Height from 0 to the largest value of the depth.
inline cv::Mat displacementOf(const cv::Mat& heightMm, int depth)
{
    double lowest = 0, highest = 0;
    cv::minMaxLoc(heightMm, &lowest, &highest);
    const double factor = (depth == CV_8U ? 255 : 65535) / (highest - lowest);
    cv::Mat stored;
    heightMm.convertTo(stored, depth, factor, -lowest * factor);
    return stored;
}

inline cv::Mat plainColour(cv::Size size, const cv::Scalar& rgb = {150, 120, 90}) { return cv::Mat(size, CV_8UC3, rgb); }

inline void writeJpeg(const fs::path& file, const cv::Mat& image)
{
    fs::create_directories(file.parent_path());
    const QImage::Format format = image.channels() == 3 ? QImage::Format_RGB888 : QImage::Format_Grayscale8;
    const QImage view(image.data, image.cols, image.rows, qsizetype(image.step[0]), format);
    QVERIFY(view.save(QString::fromStdString(file.string()), "JPG", 95));
}

inline void writePicture(const fs::path& file, const cv::Mat& image)
{
    fs::create_directories(file.parent_path());
    rendering::writePng(file, image);
}

inline cv::Mat decodeByQt(const fs::path& file)
{
    const QImage image = QImage(QString::fromStdString(file.string())).convertToFormat(QImage::Format_RGB888);
    if (image.isNull()) throw protocols::badInput({"the image cannot be read", file.string(), "an image", "export it again"});
    return cv::Mat(image.height(), image.width(), CV_8UC3, const_cast<uchar*>(image.constBits()), size_t(image.bytesPerLine()))
        .clone();
}

/// Pearson correlation of two maps of one size.
inline double correlation(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat first, second;
    a.convertTo(first, CV_64F);
    b.convertTo(second, CV_64F);
    first -= cv::mean(first);
    second -= cv::mean(second);
    return first.dot(second) / std::sqrt(first.dot(first) * second.dot(second));
}

}  // namespace scan_folders
