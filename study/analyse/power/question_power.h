// The power of the claims about each question of a planned study, by formula: what a registered plan states beforehand.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "protocols/protocol.h"
#include "stats/power/claim_power.h"

namespace study::analyse {

enum class ClaimKind {
    Difference,   ///< of two conditions, scale points or shares of right choices
    Equivalence,  ///< within the protocol's bounds, for a true difference
    AboveChance,  ///< share of right choices of one condition
};
/// "difference", "equivalence" or "above_chance".
std::string nameOf(ClaimKind kind);

/// The power at 5 % alone, and at the first step of Holm's correction: 5 % divided by the size of the family.
struct CorrectedPower {
    stats::Value alone;
    stats::Value firstStep;
};

struct PowerOfClaim {
    ClaimKind kind = ClaimKind::Difference;
    stats::Generalisation generalisation = stats::Generalisation::TheseFabrics;
    double effect = 0;  ///< true difference, or true share
    CorrectedPower power;
};

/// The narrowest bounds about 0 with a power of 80 %, if there is no difference.
struct NarrowestBounds {
    stats::Generalisation generalisation = stats::Generalisation::TheseFabrics;
    CorrectedPower bounds;
};

struct QuestionPower {
    std::string question;
    std::size_t contrasts = 0;  ///< size of the family: the planned contrasts, or all pairs
    std::size_t conditions = 0;
    std::vector<PowerOfClaim> claims;           ///< by kind and effect, these fabrics first
    std::vector<NarrowestBounds> narrowest;     ///< ratings only
    std::optional<stats::RatingTruth> ratings;  ///< the assumed variances; ratings only
    std::optional<stats::ChoiceTruth> choices;  ///< the assumed SDs; choices only
};

/// Questions with right answers or ratings, in the order of the protocol. A value that does not exist has its reason.
std::vector<QuestionPower> questionPowers(const protocols::Protocol& protocol);

}  // namespace study::analyse
