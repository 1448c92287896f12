// Readers of the text files of two instruments.
#pragma once

#include <filesystem>
#include <vector>

#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/raw_record.h"

namespace rendering::fabrics {

/// Reads a file of the PCS (MTM) tribometer; each step of its profile is a record. Throws badInput.
std::vector<RawRecord> readTribometer(const std::filesystem::path& file, const FrictionOptions& options);

/// Reads a LabVIEW measurement file of forces; each segment is a record. Throws badInput.
std::vector<RawRecord> readLabview(const std::filesystem::path& file, const FrictionOptions& options);

}  // namespace rendering::fabrics
