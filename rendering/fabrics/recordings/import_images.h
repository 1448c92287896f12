// Import of photographs and GelSight frames.
#pragma once

#include <string>
#include <vector>

#include "rendering/fabrics/recordings/import.h"
#include "rendering/fabrics/recordings/import_stage.h"

namespace rendering::fabrics {

/// Each reads and checks all files before it changes the data set, and returns lines of report. Throws badInput.
std::vector<std::string> importPhotos(const ImportRequest& request, ImportStage& stage);
std::vector<std::string> importGelsight(const ImportRequest& request, ImportStage& stage);

}  // namespace rendering::fabrics
