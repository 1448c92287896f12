// Ready friction images of conditions that a lab adds to its study, and what such an image must be.
#pragma once

#include <filesystem>
#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "protocols/protocol.h"

namespace study::making {

struct OwnImages {
    std::map<protocols::ConditionId, std::map<protocols::FabricId, cv::Mat>> images;  ///< CV_8UC1 [800 x 1280]
    std::map<std::string, std::string> sha256;                                        ///< over the images, by condition
    std::vector<std::string> warnings;
};

/// What the display shows: size, channels and bits.
std::string expectedOwnImage();

/// "800 x 600 pixels, 3 channels of 8 bits" for an image that the display does not show as it is; empty for one that fits.
std::string faultOfOwnImage(const cv::Mat& image);

/// Adds the images of a condition with their hash. Warns of images with one level.
void addOwnImages(OwnImages& own, const protocols::ConditionId& condition, std::map<protocols::FabricId, cv::Mat> images);

/// Reads FOLDER/FABRIC.png (or .tif, .pgm, .npy) for each condition of Protocol::ownImages and each fabric. Relative folders lie
/// in `beside`. Throws badInput for a folder that lacks images (all are named), and for an image of another size or depth.
OwnImages readOwnImages(const protocols::Protocol& protocol, const std::filesystem::path& beside,
                        const std::vector<protocols::FabricId>& fabrics);

}  // namespace study::making
