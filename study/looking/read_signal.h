// A file as a signal to look at: what it is follows from its kind and place; in a data set its pitch too.
#pragma once

#include <filesystem>
#include <functional>

#include "study/looking/seen_signal.h"

namespace study::looking {

struct ReadingOptions {
    std::optional<double> mmPerPixel;   ///< overrides what the data set says
    std::optional<double> speedMmPerS;  ///< of a stroke whose record holds times only
    std::string unit;                   ///< of a map's values, where the file does not tell
    std::string quantity;               ///< the column of a record to look at; empty: its friction
    /// Reads what this program cannot (JPEG ...) as RGB, 8 bits; empty: such files are refused.
    std::function<cv::Mat(const std::filesystem::path&)> decode;
};

/// PNG, PGM, TIFF, TMD and .npy as maps (an array of one row as a trace), CSV as a trace. Heights at or below -1e9 mm
/// are markers of missing points. Throws badInput for a file that cannot be read and for the stimuli of a study that
/// is not unblinded (open_study.h).
SeenSignal readSignal(const std::filesystem::path& file, const ReadingOptions& options = {});

/// A height map in mm that was computed, not read.
SeenSignal seenHeight(const cv::Mat& heightMm, std::optional<double> mmPerPixel, const std::string& title,
                      const std::string& origin);

}  // namespace study::looking
