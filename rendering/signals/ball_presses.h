// Presses of a ball of known radius into a GelSight sensor: where the ball was, how wide it touched, what a calibration
// makes of it. Nothing is taken from an annotation: the centres are those with which one model of the light (a
// cubic in the slope whose coefficients go linearly over the frame) explains all the presses at once; the edge of
// contact is where the light has changed most, for there the gel is steepest.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rendering/signals/calibration.h"

namespace rendering::signals {

struct BallPress {
    std::string name;
    cv::Mat frame;  ///< as the background
};

struct BallPresses {
    cv::Mat background;  ///< the untouched sensor, CV_8UC3 or CV_16UC3 (R, G, B)
    std::vector<BallPress> presses;
    double ballRadiusMm = 0;
    double mmPerPixel = 0;
};

struct ContactCircle {
    cv::Point2d centrePx;
    double radiusPx = 0;   ///< of the contact, not of the ball
    double explained = 0;  ///< share of the light's variance around it that the model explains
};

/// The light around a press, found from all the presses: the ball's slope within contactPx, and from there on falling to 1/e over
/// bridgePx. Good for finding centres; its radius is a compromise and not that of the contact.
struct PressModel {
    cv::Mat coefficients;  ///< CV_64FC1 [terms x channels]
    double contactPx = 0;
    double bridgePx = 0;
};

struct LocatedPresses {
    PressModel model;
    double contactPx = 0;                ///< usual radius of contact
    std::vector<ContactCircle> circles;  ///< of BallPresses::presses
};

inline constexpr std::size_t fewestPresses = 5;
inline constexpr double leastExplained = 0.5;  ///< below it no ball is seen

/// Throws badInput for fewer than fewestPresses, frames of another size, a background of another sensor or with swapped channels
/// (seen in the far field), a ball that is not larger than a few pixels, and presses in which no ball is found
/// (all named).
LocatedPresses locate(const BallPresses& presses);
/// The circles of further presses of the same sensor and ball under the model of the first.
std::vector<ContactCircle> locate(const BallPresses& presses, const LocatedPresses& known);

/// The ball's slopes inside its contact (NaN-free; 0 elsewhere), CV_32FC1 each.
Slopes ballSlopes(const BallPresses& presses, const ContactCircle& circle);
/// The ball's height over the edge of its contact, mm; 0 outside. CV_32FC1.
cv::Mat ballHeight(const BallPresses& presses, const ContactCircle& circle);

/// Light to slope from some of the presses: the insides of contact, and the untouched far field as slope 0. `chosen`: indices.
Calibration calibrationFrom(const BallPresses& presses, const std::vector<ContactCircle>& circles,
                            const std::vector<std::size_t>& chosen, MapQuality quality);

struct PressScore {
    std::string name;
    ContactCircle circle;
    double normalErrorDeg = 0;  ///< median over the contact, less its outermost pixel
    double depthErrorMm = 0;    ///< RMS over the contact, above its edge
    double peakMm = 0;          ///< of the height above the edge of contact
    double peakOverGelMm = 0;   ///< of the whole gel above its rest surface: with the bridge
};

struct CalibrationScore {
    std::vector<PressScore> presses;
    double normalErrorDeg = 0;  ///< median over all pixels of all presses
    double depthErrorMm = 0;    ///< mean of the presses' RMS
    double peakMm = 0, lowestPeakMm = 0, highestPeakMm = 0;
    double peakOverGelMm = 0;
    double ballPeakMm = 0;  ///< what the circles say: R - sqrt(R^2 - r^2), mean
};

/// How well a calibration reads presses that it was not made from.
CalibrationScore scoreOf(const Calibration& calibration, const BallPresses& presses, const std::vector<ContactCircle>& circles,
                         const std::vector<std::size_t>& chosen);

/// Each fifth of the presses read by a calibration from the others (leave-one-out below ten).
CalibrationScore crossValidated(const BallPresses& presses, const std::vector<ContactCircle>& circles, MapQuality quality);

}  // namespace rendering::signals
