// An evaluation as JSON, schema vis2hap.evaluation/1.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

nlohmann::ordered_json evaluationJson(const Evaluation& evaluation);

}  // namespace study::evaluation
