// The nine input conditions of the paper (section "Baselines of haptic rendering"), as a table, and
// others that must be asked for by name. Which signals must be computed follows from a row's two
// sources (rendering/plan.h); another condition is one more row.
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

/// What keys call the blank glass of a catch trial; no condition, so in no list of conditions.
ConditionId catchTrialId();

/// The nine in the order of the paper, which is the order of every table and file, then the others.
std::span<const Condition> allConditions();

/// Accepts "h_g&f_g" and its file-name spelling "h_g+f_g". Throws badInput naming the known ids.
const Condition& conditionNamed(std::string_view id);

/// "h_g&f_g" -> "h_g+f_g".
std::string fileNameOf(const ConditionId& id);

/// "all" (the nine of the paper), or a comma-separated list of ids. Throws badInput for an unknown or doubled one.
std::vector<ConditionId> conditionList(std::string_view text);

}  // namespace protocols
