// The stated law of friction of drawn fabrics: a steel or skin-like probe of 0.6 mm under 15 N at 5 mm/s.
//
//   mu = (adhesion A (1 - 0.6 sheen) + ploughing 1.5 tanh(0.3 s) + entanglement 0.20 hairiness) * unseen * (F / 15 N)^-0.08
//
// A: coefficient of the fibre, 0.14 for silk to 0.19 for wool. s: RMS slope of the relief, smoothed over 0.15 mm (Gaussian),
// mm/mm: a finger must be pushed over ridges. Hairiness: 0 filament to 1 brushed. `unseen` is the finish: log-normal, 6 %, cut
// at 2.5 standard deviations. It is the spread that no photograph shows.
#pragma once

#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/procedural/stroke_rig.h"

namespace rendering::fabrics {

inline constexpr double unseenFrictionSpread = 0.06;

/// The visible terms of the law at 15 N.
struct FrictionTerms {
    double fibre = 0;   ///< adhesion A (1 - 0.6 sheen) + entanglement 0.20 hairiness
    double relief = 0;  ///< ploughing 1.5 tanh(0.3 s)
    double sum() const { return fibre + relief; }
};

/// Samples a patch of at least twelve threads at a fixed place.
FrictionTerms visibleFriction(const DrawnFabric& fabric);

/// Mean coefficient of friction, from the same patch.
double meanFriction(const DrawnFabric& fabric, double forceN = 15);

/// A stroke of the simulated rig over the fabric, from `start` along its direction; `mean` is meanFriction(). Texture, noise and
/// the variation between places are those of stroke_rig.
ForceRecord strokeDrawn(const DrawnFabric& fabric, double mean, const FabricPlace& start, const FrictionRecording& recording,
                        protocols::Random& random);

/// The law in one line, with its unseen spread.
std::string frictionLaw();

}  // namespace rendering::fabrics
