// Reads a file as a signal for a sheet. The kind of signal follows from file type and place; in a data set, also the pitch.
#pragma once

#include <filesystem>
#include <functional>

#include "study/looking/seen_signal.h"

namespace study::looking {

struct ReadingOptions {
    std::optional<double> mmPerPixel;   ///< overrides the pitch of the data set
    std::optional<double> speedMmPerS;  ///< speed of a stroke whose record has only times
    std::string unit;                   ///< unit of a map if the file does not contain it
    std::string quantity;               ///< column of a record to show; empty: its friction
    /// Decodes other formats such as JPEG to RGB, 8 bits; empty: such files are refused.
    std::function<cv::Mat(const std::filesystem::path&)> decode;
};

/// Reads PNG, PGM, TIFF, TMD and .npy as maps, an array of one row as a trace, and CSV as a trace. Heights at or below -1e9 mm
/// mark missing points. Throws badInput for a file that cannot be read, and for stimuli of a study that is not unblinded
/// (open_study.h).
SeenSignal readSignal(const std::filesystem::path& file, const ReadingOptions& options = {});

/// Signal of a computed height map, mm.
SeenSignal seenHeight(const cv::Mat& heightMm, std::optional<double> mmPerPixel, const std::string& title,
                      const std::string& origin);

}  // namespace study::looking
