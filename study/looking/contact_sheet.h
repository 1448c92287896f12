// All fabrics of a data set on one sheet, a row each: photograph, measured and generated height,
// measured and generated friction, friction images. Within a row maps of known scale are shown at one
// scale and heights in one range of colours, so that what should look alike can be compared by eye.
#pragma once

#include <QImage>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "study/looking/plot.h"

namespace study::looking {

struct ContactMap {
    cv::Mat values;                    ///< CV_8UC3 (RGB) or CV_32FC1, mm; empty: there is none
    std::optional<double> mmPerPixel;  ///< unknown: the whole map is shown
};

struct ContactTrace {
    std::vector<double> values;  ///< empty: there is none
    double mmPerSample = 0;
};

struct ContactRow {
    std::string id, name;
    ContactMap photograph, measuredHeight, generatedHeight;
    ContactTrace measuredFriction, generatedFriction;  ///< coefficients
    std::string measuredQuantity = "mu";               ///< another than "mu" is not drawn over a coefficient's axis
    std::vector<cv::Mat> frictionImages;               ///< CV_8UC1, one a column; an empty one: there is none
    std::string remark;                                ///< below the name, e.g. that the photograph is an unfamiliar one
};

struct ContactSheet {
    std::string title;
    std::vector<std::string> frictionColumns;  ///< names over the friction images
    std::vector<ContactRow> rows;
};

/// What cannot be shown is said in its cell. `rows` must not be empty; a QGuiApplication must exist.
/// Throws badInput where the sheet would be larger than a picture can be.
QImage drawContactSheet(const ContactSheet& sheet, const SheetStyle& style);

}  // namespace study::looking
