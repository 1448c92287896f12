// The friction images of a new study: for its conditions, and for familiarisation with the display.
#pragma once

#include <map>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "study/making/study_material.h"

namespace study::making {

struct StudyImages {
    std::map<protocols::ConditionId, std::map<protocols::FabricId, cv::Mat>> byCondition;  ///< CV_8UC1
    std::string signalsJson = "{}";     ///< generated against measured signals, for the report
    bool reused = false;                ///< read from the request's folder of images, not rendered
    std::vector<std::string> stamps;    ///< sentences that every report must carry
    std::vector<std::string> warnings;  ///< about images and photographs; about images only where these are reused
};

/// Reads the images from `request.images` if they were made from the same material; otherwise renders them and stores them there.
StudyImages imagesFor(const NewStudy& request, const StudyMaterial& material, const database::StudyFacts& facts,
                      const StudyProgress& progress);

/// Fabrics outside the study, each with one friction image.
struct FamiliarisationImages {
    std::vector<std::string> names;
    std::vector<cv::Mat> images;
};

/// Draws the fabrics by seed, at most as many as the protocol asks for. Empty where the data set has no further fabrics.
FamiliarisationImages familiarisationFor(const NewStudy& request, const StudyMaterial& material);

}  // namespace study::making
