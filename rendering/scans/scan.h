// One scanned fabric in memory: colour, slopes and surface on one grid of square pixels.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rendering/fabrics/recordings/photograph_files.h"
#include "rendering/scans/scan_files.h"
#include "rendering/signals/surface_integration.h"

namespace rendering::scans {

struct Scan {
    cv::Mat colour;           ///< CV_8UC3, RGB (sRGB), without light and shadow
    signals::Slopes slopes;   ///< CV_32FC1; x to the right, y downwards
    cv::Mat surface;          ///< CV_32FC1; mm, or 0 to 1 where `surfaceInMm` is false
    bool surfaceInMm = true;  ///< false: there are no normals, so the amplitude is unknown
    double mmPerPixel = 0;
    bool bordersMeet = true;           ///< left continues right and top continues bottom
    std::vector<std::string> remarks;  ///< what was found: green sign, agreement with the displacement, sizes
};

/// Largest side that is kept, px; larger images are reduced.
inline constexpr int mostScanSidePx = 4096;

/// Slopes that a displacement without normals gets, because its amplitude is unknown: RMS over both directions, mm/mm.
inline constexpr double assumedRmsSlope = 0.15;

/// Reads the files of a fabric whose tile is `tileMm` wide. The surface has the grid of the normals (else of the displacement),
/// or that of the colour where this is coarser. The sign of the green channel comes from the agreement of the slopes and from
/// the displacement; the file name decides only where both leave it open. Throws badInput naming the file: not an image, not a
/// normal map, a narrow strip, another shape than the colour, a displacement that is constant or not finite, a colour of 16 bits
/// that uses few of them (inEightBits()).
Scan readScan(const ScanFiles& files, double tileMm, const fabrics::DecodeOther& decodeOther);

}  // namespace rendering::scans
