// dataset.json as text: strict reading, with the field named in every fault, and writing.
#pragma once

#include <string>
#include <string_view>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// Reads a data set whose `folder` stays empty. Ids of fabrics obey the rule of protocols/files/id_rule.h. `where` names the file
/// in faults. Throws badInput.
Dataset datasetFromJson(std::string_view text, const std::string& where);

std::string toJson(const Dataset& dataset);

}  // namespace rendering::fabrics
