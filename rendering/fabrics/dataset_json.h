// dataset.json as text: reading it strictly, with the field in every fault, and writing it.
#pragma once

#include <string>
#include <string_view>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// `where` names the file in faults. Throws badInput. The folder of the result is empty.
Dataset datasetFromJson(std::string_view text, const std::string& where);

std::string toJson(const Dataset& dataset);

/// Whether a fabric's id can be the name of its folder: letters, digits, '-' and '_', at most 40.
bool isFolderName(std::string_view id);

}  // namespace rendering::fabrics
