// Ready friction images of conditions that a lab adds to its study.
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

/// Reads FOLDER/FABRIC.png (or .tif, .pgm, .npy) for each condition of Protocol::ownImages and each fabric. Relative folders lie
/// in `beside`. Throws badInput for a folder that lacks images (all are named), and for an image of another size or depth.
OwnImages readOwnImages(const protocols::Protocol& protocol, const std::filesystem::path& beside,
                        const std::vector<protocols::FabricId>& fabrics);

}  // namespace study::making
