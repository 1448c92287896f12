// Import of friction records from every instrument.
#pragma once

#include <string>
#include <vector>

#include "rendering/fabrics/recordings/import.h"
#include "rendering/fabrics/recordings/import_stage.h"

namespace rendering::fabrics {

/// Reads and checks all records before it changes the data set; returns one line of report for each. Throws badInput.
std::vector<std::string> importFrictionFiles(const ImportRequest& request, ImportStage& stage);

}  // namespace rendering::fabrics
