// Folder with the record of a training run. losses.csv and validation.csv have one row for each step; curves.svg plots
// both. samples-STEP.png shows photographs with measured and generated heights. Every file is written whole or not at all.
// A resumed run ends with the same folder as an uninterrupted one.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rendering/models/training_samples.h"
#include "rendering/models/training_table.h"

namespace rendering::models {

/// MODEL.log: the folder of a training.
std::filesystem::path logOf(const std::filesystem::path& model);

class TrainingLog {
public:
    /// Deletes the files of an earlier run. With `resumeAtStep` deletes only entries after that step. Throws environmentFault,
    /// badInput for tables that cannot be read.
    explicit TrainingLog(std::filesystem::path folder, std::optional<int> resumeAtStep = {});

    /// Adds losses of a step, from 1, and writes the whole table (milliseconds after thousands of steps). A new name gets a
    /// column that is empty in earlier rows.
    void losses(int step, std::span<const NamedValue> values);

    /// Adds validation figures of a step, writes the table and draws the curves.
    void validation(int step, std::span<const NamedValue> values);
    void pictures(int step, std::span<const SampleRow> rows);

    /// Losses under a name, in order of steps.
    std::vector<double> valuesOf(const std::string& name) const { return m_losses.column(name); }

private:
    void writeTables() const;

    std::filesystem::path m_folder;
    TrainingTable m_losses, m_validation;
};

/// One line of the characters U+2581 to U+2588, scaled to the least and greatest value. Longer rows are averaged to `most`
/// characters; values that are not finite give blanks.
std::string sparkline(std::span<const double> values, int most = 40);

}  // namespace rendering::models
