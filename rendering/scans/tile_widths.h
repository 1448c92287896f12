// Width of the tile of each scanned fabric, mm. No image states it reliably, so it is given by the user or by a file beside
// the scans.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "rendering/scans/scan_files.h"

namespace rendering::scans {

/// Widths that the command line states.
struct TileOptions {
    std::optional<double> allMm;
    std::map<std::string, double> ofFabric;  ///< by name of the fabric
};

struct TileWidth {
    double mm = 0;
    std::string source;  ///< "--tile", "tiles.csv", "scan.json", "the resolution in weave_diff_2k.jpg"
};

/// Widths of the fabrics, in their order. For each the first of these counts: its own option; scan.json in its folder
/// ({"tile_mm": 268.1}); its row of tiles.csv in `folder` or in its own folder (name,width_mm); the option for all; the
/// resolution of a file, if it has a unit, is no usual default, and makes the tile 50 to 1000 mm wide. Throws badInput where
/// nothing states a width, where an option or a row names no fabric, and where a width is not from 1 to 100,000 mm.
std::vector<TileWidth> tileWidths(const std::vector<ScanFiles>& fabrics, const std::filesystem::path& folder,
                                  const TileOptions& options);

}  // namespace rendering::scans
