// Reader of the text files of a tribometer.
#pragma once

#include <filesystem>
#include <vector>

#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/raw_record.h"

namespace rendering::fabrics {

/// Reads a file of the PCS (MTM) tribometer; each step of its profile is a record. Without named columns and without both
/// forces in N, the coefficient of the instrument is taken. Numbers may have decimal commas where none has a point and not all
/// commas may stand between thousands. Throws badInput, also for a row of numbers after the end of a table.
std::vector<RawRecord> readTribometer(const std::filesystem::path& file, const FrictionOptions& options);

}  // namespace rendering::fabrics
