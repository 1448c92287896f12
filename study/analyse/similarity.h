// MAE and SSIM of two images, or MAE of two traces, as the JSON that `vis2hap metrics` prints.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace study::analyse {

/// Schema vis2hap.metrics/1, `b` being the truth. CSV files with one column are traces; all other files are images. SSIM
/// takes the dynamic range from the depth of both unless `range` states it. Throws badInput: a trace beside an image, different
/// sizes; without `range` also images of different depths or of floating-point values.
nlohmann::ordered_json similarityOf(const std::filesystem::path& a, const std::filesystem::path& b, std::optional<double> range);

}  // namespace study::analyse
