// A simulated friction rig: a probe of 0.6 mm contact drawn 40 mm across the fabric at 5 mm/s under
// 15 N, normal and tangential force sampled at 60 Hz.
//
// Mean: mu0 = adhesion of the fibre + ploughing, ploughing = 1.1 tanh(0.2 s), s the RMS slope of the surface as a
// fingertip feels it (smoothed over 0.15 mm) -- soft matter must be pushed over what stands out.
// Speed: mu(v) = mu0 (1 + 0.06 ln(v / 5 mm/s)). Place: +-3 % between strokes (normal).
// Texture: the probe averages the relief over its contact; climbing it costs 0.18 of its slope along
// the stroke and standing on it 0.35 per mm of height, both times (0.4 + mu0). Plus coloured noise (AR(1), 1.2 %, 0.15 s).
// Normal force: 15 N that wanders by 0.2 N (AR(1), 0.5 s); both channels have 0.02 N of noise.
#pragma once

#include <vector>

#include "protocols/random.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

struct ForceRecord {
    std::vector<double> timeS, normalN, tangentialN;
};

/// The coefficient before texture and variation, at the rig's speed; samples a fixed patch once.
double meanFriction(const FabricSurface& surface, const FrictionRecording& recording);

/// A stroke along the place's direction, starting there. `mean` is meanFriction().
ForceRecord strokeFabric(const FabricSurface& surface, double mean, const Place& start, const FrictionRecording& recording,
                         protocols::Random& random);

/// The file's text: t_s,normal_n,tangential_n.
std::string toCsv(const ForceRecord& record);

}  // namespace rendering::fabrics
