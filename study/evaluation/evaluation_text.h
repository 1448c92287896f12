// An evaluation as text tables.
#pragma once

#include <string>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Tables of friction, height, roughness, identification and equal means. Each has a title with split and pairing and an
/// explanation of every column. The criteria follow at the end, if any apply.
std::string evaluationText(const Evaluation& evaluation);

/// Text of a value, such as "0.4213", "7.9 %", "4.20 dB" or "0.970"; "-" if the value does not exist.
std::string formatted(const stats::Value& value, NumberFormat format);

}  // namespace study::evaluation
