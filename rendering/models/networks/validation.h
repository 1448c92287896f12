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
/// (losses.h) where pairing is weak. Each figure is an object. Its "generated" compares generated with measured signals.
/// Its "measured" compares two measured signals of one fabric; this is the best possible value for weakly paired data.
/// Figures: distance, height_l1_mm, height_ssim, height_correlation, height_radial_spectrum_db, height_sq_ratio,
/// log_ratio_l1, mean_friction_relative_error. The distance is the weighted sum that training minimises; it has no
/// "measured". height_radial_spectrum_db is the mean absolute difference of ring powers. height_sq_ratio is the larger Sq
/// over the smaller, as a geometric mean over fabrics.
nlohmann::ordered_json validationFigures(const TrainingData& data, Generators& generators, const LossWeights& weights, int pairs,
                                         protocols::Random& random);

/// Rows for the training log: photographs of at most six validation fabrics with the generated height and the registered
/// measured height.
std::vector<SampleRow> sampleRows(const TrainingData& data, Generators& generators, std::uint64_t seed);

}  // namespace rendering::models
