// Effects that a teacher plants into a simulated study (`simulate --plant FILE`). The answers to the questions of the file follow
// its numbers, not the touch; all other questions are answered as usual. So a class knows afterwards what was to be found.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "protocols/orders/allocation.h"
#include "protocols/protocol.h"
#include "study/players/simulated_session.h"

namespace study::players {

/// A choice among pieces, or same or different.
struct PlantedChoice {
    double right = 0;                                  ///< probability of a right answer where no effect is planted
    std::map<protocols::ConditionId, double> effects;  ///< added to it
};

/// A rating. Persons and fabrics shift all ratings of the question alike; what is left varies from answer to answer.
struct PlantedRating {
    double mean = 0, personSd = 0.8, fabricSd = 0.4, sd = 1.2;  ///< scale points
    std::map<protocols::ConditionId, double> effects;           ///< added to the mean, scale points
};

struct PlantedEffects {
    std::map<protocols::QuestionId, PlantedChoice> choices;
    std::map<protocols::QuestionId, PlantedRating> ratings;
    std::set<protocols::ParticipantId> careless;  ///< answer without feeling anything: fast, always the same slot and number
};

/// Reads schema vis2hap.plant/1. Throws badInput, naming the place: unknown keys, questions and conditions, a condition that is
/// named twice (as "h&f" and "h+f"), another kind of question, and means or probabilities that effects push outside the scale or
/// 0 to 1. Who takes part is not known here, so `careless` may name anybody.
PlantedEffects plantedEffectsFromJson(std::string_view json, const std::string& where, const protocols::Protocol& protocol);

/// Condition and fabric that a trial shows.
using ShownIn = std::function<const protocols::AllocationKey::Entry&(const protocols::BlindedTrial&)>;

/// The judge of a participant under planted effects. `usual` answers what nothing was planted for; it is called for every
/// question, so that answers without a planted effect are those of a simulation without any. `effects` must outlive the judge.
Judge plantedJudge(const PlantedEffects& effects, const ShownIn& shown, const protocols::ParticipantId& participant,
                   std::uint64_t seed, Judge usual);

}  // namespace study::players
