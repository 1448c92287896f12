// Friction images of a data set as one picture: a row for each fabric, with its photograph and a column for each condition.
#pragma once

#include <QImage>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "study/looking/plot.h"

namespace study::photographs {

struct FrictionRow {
    std::string name;
    cv::Mat photograph;           ///< CV_8UC3, RGB
    std::vector<cv::Mat> images;  ///< CV_8UC1, one for each caption
};

/// `style.columnPx` is ignored; `widthPx`: width of the whole picture, px. `rows` must not be empty; a QGuiApplication must
/// exist. Throws badInput for more rows than the largest picture holds.
QImage drawFrictionRows(const std::vector<FrictionRow>& rows, const QStringList& captions, int widthPx,
                        const looking::SheetStyle& style);

}  // namespace study::photographs
