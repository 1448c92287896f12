// What a protocol asks of a lab, before anything is made: the session phase by phase, counts, minutes, the balance that the
// design can reach, and what the study can detect.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/protocol.h"

namespace study::making {

/// Schema vis2hap.session_plan/1. The balance is that of the design of seed 1; another seed reaches one alike. The smallest
/// effects with 80 % power hold under the usual assumptions of `power` (RatingTruth, ChoiceTruth): ratings for the t test of
/// the participants' means, with variances stretched to the scale of each question; choices for the exact test of one condition
/// against chance.
nlohmann::ordered_json sessionPlan(const protocols::Protocol& protocol);

/// Its part "detects", which needs no running order.
nlohmann::ordered_json detectableEffects(const protocols::Protocol& protocol);

/// What a sound protocol leaves in doubt: bounds of equivalence that its study can hardly meet, texts that its own ends of the
/// scale still lack, usual words at the ends of an own question, usual questions that ask for another kind of answer. `study new`
/// prints these lines, too.
std::vector<std::string> remarksOn(const protocols::Protocol& protocol);

/// The same object as lines for people.
std::string textOf(const nlohmann::ordered_json& sessionPlan);

}  // namespace study::making
