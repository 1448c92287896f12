// Square patches of a scanned tile, in bands along its rows. Patches of different bands share no fabric and keep a guard
// between them, also across the border where bottom and top meet. A split that keeps bands whole leaks no place.
#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace rendering::scans {

inline constexpr int usualPatchPx = 256, leastPatchPx = 32;

/// Pixels between bands: three times the Gaussian of 16 px with which relief is high-passed.
inline constexpr int guardPx = 48;

struct Patch {
    cv::Rect place;
    int band = 0;
};

/// Largest side, at most `wantedPx`, with which three bands fit into the tile; less than leastPatchPx where none does.
int patchSideFor(cv::Size tile, int wantedPx = usualPatchPx);

/// As many bands as fit with their guards, evenly spaced, and in each as many patches as fit side by side.
std::vector<Patch> patchesOf(cv::Size tile, int sidePx);

}  // namespace rendering::scans
