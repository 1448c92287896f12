// An endless source of training patches: a photograph of a drawn fabric with its height at the same pixels and its friction.
#pragma once

#include "rendering/fabrics/drawn/cloth_camera.h"

namespace rendering::fabrics {

struct DrawnPatch {
    cv::Mat rgb;       ///< CV_8UC3, red first
    cv::Mat heightMm;  ///< CV_32FC1, with the slack of the cloth
    double mmPerPixel = 0.05;
    double periodPx = 8;  ///< spacing of the threads or tufts that show most
    double meanFriction = 0.3;
    double textureSqMm = 0;          ///< standard deviation of the height without the slack
    bool isFlat = false;             ///< the colour of a scan, with the light taken out
    std::optional<double> lightDeg;  ///< lightSide()
    ClothKind kind = ClothKind::Weave;
};

struct PatchOptions {
    int pixels = 128;        ///< 32 to 1024
    double flatShare = 0.3;  ///< share of patches with the light taken out
};

/// Draws the scale of a photograph, mm per pixel: 2 to 40 px a thread, fine ones more often, within 0.008 to 0.5 mm.
double drawPitch(const DrawnFabric& fabric, protocols::Random& random);

/// Patch `index` of the family `seed`, of construction `index` of drawFabric(). Equal arguments give the same patch.
DrawnPatch drawPatch(std::uint64_t seed, std::uint64_t index, const PatchOptions& options = {});

/// Patch `index` of a given fabric, whose friction is known.
DrawnPatch drawPatchOf(const DrawnFabric& fabric, double meanFriction, std::uint64_t seed, std::uint64_t index,
                       const PatchOptions& options = {});

}  // namespace rendering::fabrics
