// Presses of a ball of known radius into a GelSight sensor. locate() finds the centre of each ball and the radius of its
// contact from the frames alone, without annotations. One model of the light must explain all presses at once; this
// determines the centres. The model is a cubic in the slope whose coefficients vary linearly over the frame. The light
// changes most at the edge of contact, where the gel is steepest; this determines the radii.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

namespace rendering::signals {

struct BallPress {
    std::string name;
    cv::Mat frame;  ///< same size and type as the background
};

struct BallPresses {
    cv::Mat background;  ///< frame of the untouched sensor, CV_8UC3 or CV_16UC3 (R, G, B)
    std::vector<BallPress> presses;
    double ballRadiusMm = 0;
    double mmPerPixel = 0;
};

struct ContactCircle {
    cv::Point2d centrePx;
    double radiusPx = 0;   ///< radius of the contact, not of the ball
    double explained = 0;  ///< share of the variance of the light around it that the model explains
};

/// Light around a press, fitted to all presses. The slope is the ball's within contactPx and decays outside it, to 1/e over
/// bridgePx. This model finds centres; its contactPx is a compromise and not the radius of the contact.
struct PressModel {
    cv::Mat coefficients;  ///< CV_64FC1 [terms x channels]
    double contactPx = 0;
    double bridgePx = 0;
};

struct LocatedPresses {
    PressModel model;
    double contactPx = 0;                ///< common radius of contact
    std::vector<ContactCircle> circles;  ///< one for each of BallPresses::presses
};

inline constexpr std::size_t fewestPresses = 5;
inline constexpr double leastExplained = 0.5;  ///< below this ContactCircle::explained there is no ball

/// Finds all presses. Throws badInput for fewer than fewestPresses, frames of different size, and a ball smaller than a few
/// pixels. Throws badInput, too, for presses without a ball (all are named), and for a background of another sensor or with
/// swapped channels. The background is compared with the frames far from the ball.
LocatedPresses locate(const BallPresses& presses);
/// Finds further presses of the same sensor and ball with the model of `known`. Throws badInput as above.
std::vector<ContactCircle> locate(const BallPresses& presses, const LocatedPresses& known);

}  // namespace rendering::signals
