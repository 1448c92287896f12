// Figures of merit of a pair of generators on the validation part of a data set.
// Included by this folder's torch sources only.
#pragma once

#include "rendering/models/batches.h"
#include "rendering/models/weights.h"

#include <nlohmann/json.hpp>

namespace rendering::models {

/// Over `pairs` photographs and measured signals drawn as training draws them, fabrics in turn. In
/// each figure's object "generated" compares generated with measured, and "measured" two measured
/// signals of one fabric: what a perfect generator could reach on weakly paired data. Figures:
/// height_l1_mm, height_sorted_l1_mm and height_spectrum_l1_mm (losses.h), height_deviation_mm
/// (standard deviation), height_registered_correlation (best over all shifts of the map's middle),
/// log_ratio_l1, mean_friction_relative_error.
nlohmann::ordered_json validationFigures(const TrainingData& data, Generators& generators, int pairs, protocols::Random& random);

}  // namespace rendering::models
