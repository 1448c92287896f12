#include "rendering/scans/scan_patches.h"

#include <algorithm>

namespace rendering::scans {

namespace {

constexpr int wantedBands = 3;  // A split by place needs a part each for training, validation and testing.

}  // namespace

int patchSideFor(cv::Size tile, int wantedPx) { return std::min({wantedPx, tile.height / wantedBands - guardPx, tile.width}); }

std::vector<Patch> patchesOf(cv::Size tile, int sidePx)
{
    const int bands = tile.height / (sidePx + guardPx), across = tile.width / sidePx;
    std::vector<Patch> patches;
    for (int band = 0; band < bands; ++band)
        for (int i = 0; i < across; ++i)
            patches.push_back({{i * tile.width / across, band * tile.height / bands, sidePx, sidePx}, band});
    return patches;
}

}  // namespace rendering::scans
