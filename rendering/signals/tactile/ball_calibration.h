// Calibration of a GelSight sensor from located ball presses, and its accuracy on other presses.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "rendering/signals/surface_integration.h"
#include "rendering/signals/tactile/calibration.h"
#include "rendering/signals/tactile/press_location.h"
#include "rendering/signals/tactile/slope_map_fit.h"

namespace rendering::signals {

/// Slopes of the ball inside its contact and 0 elsewhere, CV_32FC1 each.
Slopes ballSlopes(const BallPresses& presses, const ContactCircle& circle);
/// Height of the ball above the edge of its contact, mm; 0 outside. CV_32FC1.
cv::Mat ballHeight(const BallPresses& presses, const ContactCircle& circle);

/// Fits the map from light to slope to the presses `chosen` (indices). Its targets are the ball's slopes inside the
/// contacts and 0 far from them, where the gel is untouched. Throws badInput where there are too few pixels.
Calibration calibrationFrom(const BallPresses& presses, const std::vector<ContactCircle>& circles,
                            const std::vector<std::size_t>& chosen, MapQuality quality);

struct PressScore {
    std::string name;
    ContactCircle circle;
    double normalErrorDeg = 0;  ///< median angle between normals over the contact without its outermost pixel
    double depthErrorMm = 0;    ///< RMS over the contact, measured from its edge
    double peakMm = 0;          ///< maximum height above the edge of contact
    double peakOverGelMm = 0;   ///< maximum height of the gel above its rest surface, including the bridge around the contact
};

struct CalibrationScore {
    std::vector<PressScore> presses;
    double normalErrorDeg = 0;  ///< median over all pixels of all presses
    double depthErrorMm = 0;    ///< mean of the presses' RMS errors
    double peakMm = 0, lowestPeakMm = 0, highestPeakMm = 0;
    double peakOverGelMm = 0;
    double ballPeakMm = 0;  ///< peak calculated from the circles: mean of R - sqrt(R^2 - r^2)
};

/// Accuracy of a calibration on presses that were not used to make it.
CalibrationScore scoreOf(const Calibration& calibration, const BallPresses& presses, const std::vector<ContactCircle>& circles,
                         const std::vector<std::size_t>& chosen);

/// Five-fold cross-validation; leave-one-out for fewer than ten presses.
CalibrationScore crossValidated(const BallPresses& presses, const std::vector<ContactCircle>& circles, MapQuality quality);

}  // namespace rendering::signals
