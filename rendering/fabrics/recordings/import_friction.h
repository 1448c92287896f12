// Import of friction records from every instrument.
#pragma once

#include <string>
#include <vector>

#include "rendering/fabrics/recordings/friction_preparation.h"
#include "rendering/fabrics/recordings/import.h"
#include "rendering/fabrics/recordings/import_stage.h"
#include "rendering/fabrics/recordings/raw_record.h"

namespace rendering::fabrics {

/// Reads and checks all records before it changes the data set; returns one line of report for each. Throws badInput.
std::vector<std::string> importFrictionFiles(const ImportRequest& request, ImportStage& stage);

/// The record as a file of the data set; readFriction() reads it.
std::string frictionCsv(const PreparedRecord& prepared, const std::string& quantity);

/// What dataset.json states of the recording. Where the record states no speed, the one in `known` and its length stay. Throws
/// badInput for a stroke that rounds to 0 mm or exceeds 100 km.
FrictionRecording recordingOf(const RawRecord& record, const PreparedRecord& prepared, FrictionRecording known);

}  // namespace rendering::fabrics
