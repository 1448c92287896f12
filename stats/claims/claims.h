// What a report claims of conditions: differences, equivalences, and answers above chance. Every claim is made twice, for
// these fabrics and for fabrics like these, and each family of claims is corrected for its size.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stats/claims/answer_cube.h"
#include "stats/claims/crossed_mean.h"

namespace stats {

/// The level of every claim, and the method of correction.
inline constexpr double claimAlpha = 0.05;

enum class Verdict {
    Different,              ///< the corrected test of the difference rejects
    Equivalent,             ///< the corrected test of equivalence rejects
    DifferentWithinBounds,  ///< both do
    NotDecided,             ///< neither does, or there is no test
};
/// "different", "equivalent", "different_within_bounds" or "not_decided".
std::string_view nameOf(Verdict verdict);

/// Difference of conditions a - b.
struct ContrastClaim {
    std::size_t a = 0;
    std::size_t b = 0;
    CrossedMean mean;
    MeanTest difference;         ///< against 0, two-sided
    Value pAdjusted;             ///< after Holm's correction within the family
    MeanTest equivalence;        ///< two one-sided tests at the bounds; undefined without bounds
    Value pEquivalenceAdjusted;  ///< after Holm's correction within the family
    Verdict verdict = Verdict::NotDecided;
};

using ContrastPair = std::pair<std::size_t, std::size_t>;
using Bounds = std::pair<double, double>;  ///< low < high, unit of the answers

/// Difference a - b. Ratings: differenceOfRatings(). Choices: crossedMean() of the differences; the variance of a choice follows
/// its mean, so the sums say nothing about the residual of the differences. Ratings are treated so, too, where the pair is
/// compared on some of the answers of a cell: the sums then differ with the repetitions that are left. `degrees`: degreesOf() the
/// answers.
CrossedMean differenceOf(const AnswerCube& answers, const ContrastPair& contrast, Generalisation generalisation, Degrees degrees,
                         StudentQuantiles& quantiles);

/// One family of contrasts, in their order. Holm's correction is taken once for the differences, once for the equivalences.
std::vector<ContrastClaim> contrastClaims(const AnswerCube& answers, std::span<const ContrastPair> contrasts,
                                          const std::optional<Bounds>& bounds, Generalisation generalisation);

/// Mean of the choices under a condition against chance.
struct ChanceClaim {
    CrossedMean mean;
    MeanTest above;   ///< one-sided: the mean lies above chance
    Value pAdjusted;  ///< after Holm's correction over the conditions
    bool isAbove = false;
};

/// One family: all conditions. `chance`: 1 / m. `untested`: for each condition the reason why it is not tested; empty where it
/// is. An untested condition is no member of the family, and keeps its mean and interval.
std::vector<ChanceClaim> chanceClaims(const AnswerCube& answers, double chance, Generalisation generalisation,
                                      std::span<const std::string> untested = {});

}  // namespace stats
