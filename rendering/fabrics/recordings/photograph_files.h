// Photographs as files: which files of a folder are photographs, their pixels, and a new data set made from them.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rendering/fabrics/recordings/import_sources.h"

namespace rendering::fabrics {

/// Decodes the formats that image_io does not read (import.h).
using DecodeOther = std::function<cv::Mat(const std::filesystem::path&)>;

/// Endings of the image files that are photographs, lower case, with the dot. What Qt reads only with a plugin is not among them.
std::span<const std::string_view> photographEndings();

/// The picture with 8 bits a sample. Throws badInput naming `file` for 16 bits whose brightest value is below 4096: cameras of 10
/// or 12 bits write such files, and a few grey levels would be left. One picture cannot tell their factor from a dark scene, so
/// none is guessed. Pictures of 14 bits pass: black cloth is as dark.
cv::Mat inEightBits(const cv::Mat& picture, const std::filesystem::path& file);

/// CV_8UC3, RGB, at least 16 x 16 pixels. Reads PNG and TIFF itself, other formats by `decodeOther`. Throws badInput naming the
/// file, also as inEightBits().
cv::Mat readPhotographFile(const std::filesystem::path& file, const DecodeOther& decodeOther);

struct NewPhotographSet {
    std::vector<SourceFile>
        photographs;                   ///< in the order of their samples; fabrics get their ids in the order of their first one
    std::optional<double> mmPerPixel;  ///< of every photograph; nullopt: unknown
    std::filesystem::path out;
    DecodeOther decodeOther;
};

/// Writes a new data set, as a whole or not at all. `progress(done, total)` counts photographs; an exception that it throws
/// ends the work. Throws badInput for a photograph that cannot be read and where `out` exists, environmentFault where the disk
/// refuses.
void makePhotographSet(const NewPhotographSet& request, const std::function<void(int, int)>& progress = {});

}  // namespace rendering::fabrics
