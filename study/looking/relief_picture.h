// Pictures of a map's values: in colours, and as relief seen obliquely from the front, lit from the upper left.
#pragma once

#include <QColor>
#include <QImage>
#include <QRect>
#include <opencv2/core/mat.hpp>

namespace study::looking {

/// Dark blue (0) over green to yellow (1): grows evenly in lightness, and is told apart by colour-blind eyes.
QColor colourOf(double fraction);

/// The values between `low` and `high` as grey or colours, one pixel each; missing ones in `missing`.
enum class Palette { Grey, Colours };
QImage pictureOf(const cv::Mat& values, double low, double high, Palette palette, const QColor& missing);

/// Part of a map that a relief of this shape shows: around the middle, and small enough for threads to be seen.
QRect reliefPart(const cv::Mat& values, double widthOverDepth);

struct Relief {
    QImage picture;             ///< transparent where there is nothing
    double pixelsPerUnit = 0;   ///< so high is one unit of the values drawn; 0 for an even map
    double pixelsPerValue = 0;  ///< so wide is one value of the map
};
/// Missing values lie at the lowest place. `values` must not be empty.
Relief reliefOf(const cv::Mat& values, QSize size, const QColor& body);

}  // namespace study::looking
