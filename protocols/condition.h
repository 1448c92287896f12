// The nine input conditions of the paper (section "Baselines of haptic rendering") as a table, and further ones that must be
// named. The two sources in a row decide which signals are computed (rendering/composition/plan.h). A new condition is one more
// row. An id may end in a quality: "h_g@fast" is the row of h_g at the price "fast"; "h_g" has the usual quality of the study or
// the command.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/ids.h"
#include "protocols/quality.h"

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
    /// True where a signal of the condition is computed at a choice of prices. The others are used as they were recorded, so
    /// that a quality would change nothing.
    bool hasQuality() const;
};

/// The name of the blank glass of a catch trial in the keys. It is no condition and stands in no list of conditions.
ConditionId catchTrialId();

/// The nine in the order of the paper, then the others. Every table and file has this order.
std::span<const Condition> allConditions();

/// The row of a condition, also of one with a quality. Accepts "h_g&f_g" and its file-name spelling "h_g+f_g". Throws badInput
/// where faultOf() finds one.
const Condition& conditionNamed(std::string_view id);

/// The quality of "h_g@fast"; none for "h_g". `id` is known.
std::optional<Quality> qualityOf(const ConditionId& id);

/// The id in its usual spelling: "h_g+f_g@fast" -> "h_g&f_g@fast". Throws badInput where faultOf() finds one.
ConditionId conditionIdFrom(std::string_view text);

/// `row` at a quality: "h_g@fast".
ConditionId withQuality(const Condition& row, Quality quality);

struct ConditionFault {
    std::string what, expected;
};

/// The fault of an id: unknown condition, unknown quality, or a quality of a condition that has none.
std::optional<ConditionFault> faultOf(std::string_view id);

/// Why a lab cannot call a condition of its own so; empty where it can. Such an id begins with an ASCII letter and holds letters,
/// digits, "_" and "-", at most 40 characters. It is no known condition, no masked label ("K3") and not "catch".
std::string faultOfOwnId(std::string_view id);

/// The order of the paper, then the usual quality before fast, balanced and accurate. Both ids are known.
bool comesBefore(const ConditionId& a, const ConditionId& b);

/// "h_g&f_g@fast" -> "h_g+f_g@fast".
std::string fileNameOf(const ConditionId& id);

/// "all" (the nine of the paper), or a comma-separated list of ids. Throws badInput for an unknown or doubled one.
std::vector<ConditionId> conditionList(std::string_view text);

}  // namespace protocols
