// A result as bytes: facts as JSON, then arrays bit by bit.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::cache {

struct PackedResult {
    std::string factsJson = "{}";
    std::vector<cv::Mat> arrays = {};  ///< of any type; may be empty
};

std::string packed(const PackedResult& result);

/// nullopt for bytes that packed() did not make.
std::optional<PackedResult> unpacked(std::string_view bytes);

}  // namespace rendering::cache
