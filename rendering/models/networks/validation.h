// Figures of merit of a pair of generators on the validation part of a data set.
// Included by this folder's torch sources only.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "rendering/models/networks/batches.h"
#include "rendering/models/networks/losses.h"
#include "rendering/models/networks/weights.h"
#include "rendering/models/training_log.h"

namespace rendering::models {

/// Over `pairs` photographs and measured signals drawn as training draws them, fabrics in turn; measured
/// maps are registered (losses.h) where pairing is weak. In each figure's object "generated" compares
/// generated with measured, and "measured" two measured signals of one fabric: what a perfect generator
/// could reach on weakly paired data. Figures: distance (the weighted sum that training minimises, of
/// which there is no "measured"), height_l1_mm, height_ssim, height_correlation,
/// height_radial_spectrum_db (mean absolute difference of ring powers), height_sq_ratio (geometric mean
/// over fabrics of the larger over the smaller), log_ratio_l1, mean_friction_relative_error.
nlohmann::ordered_json validationFigures(const TrainingData& data, Generators& generators, const LossWeights& weights, int pairs,
                                         protocols::Random& random);

/// Photographs of the validation part, a fabric each (six at most), with the generated height and the
/// measured one where it fits best: for the log.
std::vector<SampleRow> sampleRows(const TrainingData& data, Generators& generators, std::uint64_t seed);

}  // namespace rendering::models
