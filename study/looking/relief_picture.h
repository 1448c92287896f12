// Pictures of a map: in colours, and as a relief viewed obliquely from the front with light from the upper left.
#pragma once

#include <QColor>
#include <QImage>
#include <QRect>
#include <opencv2/core/mat.hpp>

namespace study::looking {

/// Colour from dark blue (0) through green to yellow (1). Lightness grows evenly, and colour-blind people can distinguish it.
QColor colourOf(double fraction);

enum class Palette { Grey, Colours };
/// Picture of the values between `low` and `high`, one pixel each; missing values have the colour `missing`.
QImage pictureOf(const cv::Mat& values, double low, double high, Palette palette, const QColor& missing);

/// Part of a map that a relief of these proportions shows: around the middle, and small enough that threads are visible.
QRect reliefPart(const cv::Mat& values, double widthOverDepth);

struct ReliefPicture {
    QImage picture;             ///< transparent around the relief
    double pixelsPerUnit = 0;   ///< height of one unit of the values, px; 0 for a flat map
    double pixelsPerValue = 0;  ///< width of one value of the map, px
};
/// Draws a relief. Missing values have the lowest height. `values` must not be empty.
ReliefPicture reliefOf(const cv::Mat& values, QSize size, const QColor& body);

}  // namespace study::looking
