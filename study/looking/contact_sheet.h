// Contact sheet: all fabrics of a data set, one row each, with photograph, measured and generated height, measured and generated
// friction, and friction images. Within a row, maps of known scale have one scale and heights have one colour range, so that
// they can be compared by eye.
#pragma once

#include <QImage>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/looking/plot.h"

namespace study::looking {

struct ContactMap {
    cv::Mat values;                    ///< CV_8UC3 (RGB) or CV_32FC1, mm; empty: no map
    std::optional<double> mmPerPixel;  ///< none: unknown, the whole map is shown
};

struct ContactTrace {
    std::vector<double> values;  ///< empty: no trace
    double mmPerSample = 0;
};

struct ContactRow {
    std::string id, name;
    ContactMap photograph, measuredHeight, generatedHeight;
    ContactTrace measuredFriction, generatedFriction;  ///< coefficients
    std::string measuredQuantity = "mu";               ///< only "mu" is drawn on the axis of the coefficient
    std::vector<cv::Mat> frictionImages;               ///< CV_8UC1, one for each column; empty: not rendered
    std::string remark;                                ///< text below the name, such as a warning about the photograph
};

struct ContactSheet {
    std::string title;
    std::vector<std::string> frictionColumns;  ///< headings of the friction images
    std::vector<ContactRow> rows;
};

/// Draws the sheet. A cell without data shows a note instead. `rows` must not be empty; a QGuiApplication must exist. Throws
/// badInput if the sheet exceeds the largest picture size.
QImage drawContactSheet(const ContactSheet& sheet, const SheetStyle& style);

}  // namespace study::looking
