// Figures of a pair of generators on the validation part of a data set.
// Only the torch sources of this folder include it.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "rendering/models/networks/batches.h"
#include "rendering/models/networks/losses.h"
#include "rendering/models/networks/weights.h"
#include "rendering/models/training_log.h"

namespace rendering::models {

/// Figures over `pairs` photographs and measured signals, drawn as in training, fabrics in turn. Measured maps are registered
/// (losses.h) where pairing is weak. Each figure is an object. Its "generated" compares generated with measured signals; its
/// "measured" compares two measured signals of one fabric, which is the best possible value for weakly paired data. Figures:
/// distance (the weighted sum that training minimises, without "measured"), height_l1_mm, height_ssim, height_correlation,
/// height_radial_spectrum_db (mean absolute difference of ring powers), height_sq_ratio (geometric mean over fabrics of the
/// larger divided by the smaller), log_ratio_l1, mean_friction_relative_error.
nlohmann::ordered_json validationFigures(const TrainingData& data, Generators& generators, const LossWeights& weights, int pairs,
                                         protocols::Random& random);

/// Rows for the training log: photographs of at most six validation fabrics with the generated height and the registered
/// measured height.
std::vector<SampleRow> sampleRows(const TrainingData& data, Generators& generators, std::uint64_t seed);

}  // namespace rendering::models
