// Import of scanned materials into a data set: each patch of a fabric as three photographs (under the one lamp, under one of
// four lamps, and its plain colour), and the surface that they show.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rendering/fabrics/recordings/photograph_files.h"
#include "rendering/scans/scan_patches.h"
#include "rendering/scans/tile_widths.h"

namespace rendering::scans {

/// Values of the column `light` of samples.csv.
inline constexpr const char* oneLampName = "one_lamp";
inline constexpr const char* fourLampsName = "four_lamps";
inline constexpr const char* colourName = "colour";

struct ScanImport {
    std::filesystem::path folder, out;
    TileOptions tiles;
    int patchPx = usualPatchPx;  ///< side of every photograph
    fabrics::DecodeOther decodeOther = {};
    std::function<void(int, int)> progress = {};  ///< fabrics done, of how many
};

/// Writes or extends the data set, as a whole or not at all. Returns a report, one line each; images that were left out stand
/// last. A fabric that shows a place twice has one group, so that no split divides it. Throws badInput as scansIn(), tileWidths()
/// and readScan(), and where a fabric is in the data set already or has no room for patches.
std::vector<std::string> importScans(const ScanImport& request);

}  // namespace rendering::scans
