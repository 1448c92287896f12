// The nine input conditions of the paper (section "Baselines of haptic rendering") as a table, and further ones that must be
// named. The two sources in a row decide which signals are computed (rendering/composition/plan.h). A new condition is one more
// row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/ids.h"

namespace protocols {

enum class ConditionGroup { Vision, Generated, Measured };
enum class ReliefSource {
    None,
    GreyPhotograph,
    ShapeFromShading,
    GeneratedHeight,
    GreyTactile,
    PhotometricHeight,
    HeightGradient
};
enum class FrictionSource { None, GeneratedTrace, MeasuredTrace };

struct Condition {
    std::string_view id;
    ConditionGroup group;
    ReliefSource relief;
    FrictionSource friction;
    bool ofThePaper = true;  ///< one of the nine that "all" means

    ConditionId conditionId() const { return ConditionId(std::string(id)); }
};

/// The name of the blank glass of a catch trial in the keys. It is no condition and stands in no list of conditions.
ConditionId catchTrialId();

/// The nine in the order of the paper, then the others. Every table and file has this order.
std::span<const Condition> allConditions();

/// Accepts "h_g&f_g" and its file-name spelling "h_g+f_g". Throws badInput naming the known ids.
const Condition& conditionNamed(std::string_view id);

/// "h_g&f_g" -> "h_g+f_g".
std::string fileNameOf(const ConditionId& id);

/// "all" (the nine of the paper), or a comma-separated list of ids. Throws badInput for an unknown or doubled one.
std::vector<ConditionId> conditionList(std::string_view text);

}  // namespace protocols
