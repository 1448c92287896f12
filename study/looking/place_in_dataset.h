// Where a file lies in a data set: DATASET/F01/visual/000.png.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "rendering/fabrics/dataset.h"

namespace study::looking {

struct PlaceInDataset {
    rendering::fabrics::Dataset dataset;
    std::string fabric, signal;  ///< names of the folders
};

/// None for a file outside. Throws badInput where dataset.json cannot be read.
std::optional<PlaceInDataset> placeInDataset(const std::filesystem::path& file);

/// "F01 visual 000.png", or the file's own name.
std::string titleOf(const std::filesystem::path& file, const std::optional<PlaceInDataset>& place);

}  // namespace study::looking
