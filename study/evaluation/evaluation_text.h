// An evaluation as tables for people.
#pragma once

#include <string>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Tables of friction, height, roughness, identification and equal means, each titled with split and pairing, with a line of
/// explanation a column; at the end what must be reached, where `criteria` says so.
std::string evaluationText(const Evaluation& evaluation);

/// "0.4213", "7.9 %", "4.2 dB", "0.97"; "-" where the value does not exist.
std::string shownValue(const stats::Value& value, Shown shown);

}  // namespace study::evaluation
