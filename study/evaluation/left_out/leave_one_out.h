// Leave-one-out: a model is trained without each fabric in turn and tested on this fabric, so that every figure is one of a
// fabric that its model never saw.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Measures of one source of predictions on the fabric: its means over the test pairs.
struct LeftOutValues {
    std::string id, name;  ///< Predictor::id and name
    Values values;
};

/// One training and its test.
struct LeftOutFabric {
    protocols::FabricId fabric;
    std::string modelSha256;
    int steps = 0;  ///< of the kept weights' training
    int pairs = 0;
    std::vector<LeftOutValues> predictors;  ///< generated, then the controls
};

/// The result on the only fabric that the evaluated model held out.
LeftOutFabric leftOutFabric(const Evaluation& evaluation);

nlohmann::ordered_json leftOutJson(const LeftOutFabric& fabric);
/// Throws badInput, naming `where`, for other JSON than leftOutJson() gives.
LeftOutFabric leftOutFrom(const nlohmann::ordered_json& json, const std::string& where);

/// All fabrics of a data set, in its order. They have the same predictors.
struct LeaveOneOut {
    std::string dataset;
    std::vector<LeftOutFabric> fabrics;
};

/// A row for each fabric, then the means over fabrics of the generated signals and of the controls.
std::string leaveOneOutText(const LeaveOneOut& result);
/// Schema vis2hap.leave_one_out/1.
nlohmann::ordered_json leaveOneOutJson(const LeaveOneOut& result);

}  // namespace study::evaluation
