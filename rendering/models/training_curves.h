// Curves of a training run as SVG.
#pragma once

#include <string>

#include "rendering/models/training_table.h"

namespace rendering::models {

/// One panel for each column, losses first: the mean of neighbouring steps over the band from least to greatest. Logarithmic
/// where positive values span a factor of more than thirty.
std::string curvesSvg(const TrainingTable& losses, const TrainingTable& validation);

}  // namespace rendering::models
