// Samples of a data set from which the controls of a study may learn: the training part of the model's split, without anything
// that the study shows.
#pragma once

#include <cstdint>
#include <vector>

#include "study/evaluation/test_plan.h"

namespace study::evaluation {

/// The samples of one fabric that a study shows. A signal that the study does not show has no index.
struct ShownSamples {
    protocols::FabricId fabric;
    int photograph = 0;
    std::optional<int> press, stroke;
};

/// Largest number of samples that the controls of a study know of a fabric and signal. It keeps a new study at seconds.
inline constexpr std::size_t mostKnownSamples = 12;

struct KnownSamplesRequest {
    std::vector<ShownSamples> shown;
    bool splitByLocation = true;                ///< as the model's training was split; otherwise by sample
    std::uint64_t splitSeed = 1, drawSeed = 1;  ///< of the model's split, and of the draw among its training part
    std::vector<protocols::FabricId> heldOut;   ///< fabrics that the model was not trained on
};

/// A plan with one pair for each shown fabric. `training` holds the known samples: at most mostKnownSamples of a fabric and
/// signal, drawn by seed. They are not shown, do not overlap a shown sample, are not of its group and have other bytes. In an
/// aligned data set the same indices are drawn for all signals. A stroke without a coefficient of friction, and a press without
/// its known height, are left out. `otherPress` and `otherStroke` are the first known ones of the fabric.
TestPlan planOfStudy(const rendering::fabrics::Dataset& dataset, const KnownSamplesRequest& request);

}  // namespace study::evaluation
