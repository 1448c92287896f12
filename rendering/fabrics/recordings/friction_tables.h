// Readers of comma-separated friction records.
#pragma once

#include <filesystem>
#include <vector>

#include "rendering/fabrics/recordings/friction_options.h"
#include "rendering/fabrics/recordings/raw_record.h"

namespace rendering::fabrics {

/// Reads forces over time, or a coefficient over time, from columns with the usual names. A column "friction" or "n" is a force
/// only beside a unit of force or where the options name it. A coefficient in percent is divided by 100. Throws badInput.
std::vector<RawRecord> readFrictionCsv(const std::filesystem::path& file, const FrictionOptions& options);

/// Reads the taxel counts of the sliding finger, channel1, channel2 and so on; their sum is the quantity. Throws badInput.
std::vector<RawRecord> readSlide(const std::filesystem::path& file, const FrictionOptions& options);

}  // namespace rendering::fabrics
