// A simulated friction rig: a probe with 0.6 mm contact strokes the fabric over 40 mm at 5 mm/s under 15 N.
// Normal and tangential force are sampled at 60 Hz.
//
// Mean: mu0 = adhesion of the fibre + ploughing, with ploughing = 1.1 tanh(0.2 s). s is the RMS slope of the surface,
// smoothed over 0.15 mm as a fingertip would feel it. Soft skin must be pushed over the ridges. Speed: mu(v) = mu0 (1 +
// 0.06 ln(v / 5 mm/s)). Place: strokes vary by 3 % (standard deviation, normal). Texture: the probe averages the relief
// over its contact. The coefficient gains (0.4 + mu0) times 0.18 of the slope along the stroke, and (0.4 + mu0) times 0.35
// per mm of height. Coloured noise (AR(1), 1.2 %, 0.15 s) is added. Normal force: 15 N that drifts by 0.2 N (AR(1), 0.5 s).
// Both channels have 0.02 N of noise.
#pragma once

#include <functional>
#include <vector>

#include "protocols/random.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

struct ForceRecord {
    std::vector<double> timeS, normalN, tangentialN;
};

/// Coefficient before texture and variation, at the rig's speed. Samples a fixed patch once.
double meanFriction(const FabricSurface& surface, const FrictionRecording& recording);

/// Simulates a stroke from `start` along its direction; `mean` is meanFriction().
ForceRecord strokeFabric(const FabricSurface& surface, double mean, const FabricPlace& start, const FrictionRecording& recording,
                         protocols::Random& random);

/// Height of a fabric in a window around a place, CV_32FC1, mm.
using ReliefSampler = std::function<cv::Mat(const FabricPlace& centre, cv::Size size, double pitchMm)>;

/// The same stroke over any relief.
ForceRecord strokeRelief(const ReliefSampler& relief, double mean, const FabricPlace& start, const FrictionRecording& recording,
                         protocols::Random& random);

/// Text of the CSV file with the columns t_s,normal_n,tangential_n.
std::string toCsv(const ForceRecord& record);

}  // namespace rendering::fabrics
