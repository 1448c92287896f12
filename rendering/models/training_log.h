// What a training run leaves to look at, in a folder: losses.csv and validation.csv (a row a step),
// curves.svg (both drawn), samples-STEP.png (photographs with measured and generated heights). Every
// file is written beside and renamed; a resumed run ends with the folder of an unbroken one.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rendering/models/training_table.h"

namespace rendering::models {

/// A row of samples-STEP.png; both heights share one scale. A height may be empty: "not measured".
struct SampleRow {
    std::string label;          ///< ASCII, e.g. "F03"
    cv::Mat photograph;         ///< CV_8UC3, RGB
    cv::Mat trueHeightMm;       ///< CV_32FC1
    cv::Mat generatedHeightMm;  ///< CV_32FC1
};

class TrainingLog {
public:
    /// A new run takes away what an older one left under these names. With `resumeAtStep` what lies
    /// after that step goes instead. Throws environmentFault, badInput for tables that cannot be read.
    explicit TrainingLog(std::filesystem::path folder, std::optional<int> resumeAtStep = {});

    /// Steps from 1; the whole table is written at each call (milliseconds after thousands of steps). A name
    /// that comes later gets a column that is empty above.
    void losses(int step, std::span<const NamedValue> values);

    /// Draws the curves anew as well.
    void validation(int step, std::span<const NamedValue> values);
    void pictures(int step, std::span<const SampleRow> rows);

    /// Of losses, in order; for the terminal's line.
    std::vector<double> valuesOf(const std::string& name) const { return m_losses.column(name); }

private:
    void writeTables() const;

    std::filesystem::path m_folder;
    TrainingTable m_losses, m_validation;
};

/// CV_8UC3: a row each of label, photograph, measured and generated height with their common scale in mm.
cv::Mat samplePicture(int step, std::span<const SampleRow> rows);

/// One line of U+2581..U+2588, the least and greatest value at its ends, longer rows averaged to
/// `most` characters; what is not finite is a blank.
std::string sparkline(std::span<const double> values, int most = 40);

}  // namespace rendering::models
