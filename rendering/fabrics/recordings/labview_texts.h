// Reader of the measurement files of LabVIEW.
#pragma once

#include <filesystem>
#include <vector>

#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/raw_record.h"

namespace rendering::fabrics {

/// Reads a LabVIEW measurement file of forces; each segment is a record. A blank line or a new header ends it. Stamps that
/// repeat, all equal or of few decimals, are replaced by multiples of Delta_X, and so are the blank ones where the header states
/// "X_Columns No". The unit of a force stands in the name of its column, else in the options, else in the row Y_Unit_Label. Cells
/// end at tabs, or at commas where the header states "Separator,Comma". Throws badInput, also for an unknown unit and for a row
/// of numbers after the end of a segment.
std::vector<RawRecord> readLabview(const std::filesystem::path& file, const FrictionOptions& options);

}  // namespace rendering::fabrics
