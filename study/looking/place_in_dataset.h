// Place of a file in a data set, such as DATASET/F01/visual/000.png.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "rendering/fabrics/dataset.h"

namespace study::looking {

struct PlaceInDataset {
    rendering::fabrics::Dataset dataset;
    std::string fabric, signal;  ///< names of the folders
    int index = -1;              ///< number of the sample; -1 where the name is no number
};

/// Place of the file; none if it is not in a data set. Throws badInput if dataset.json cannot be read.
std::optional<PlaceInDataset> placeInDataset(const std::filesystem::path& file);

/// "F01 visual 000.png", or the name of the file if it is not in a data set.
std::string titleOf(const std::filesystem::path& file, const std::optional<PlaceInDataset>& place);

}  // namespace study::looking
