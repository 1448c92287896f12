// What a report claims of conditions: differences, equivalences, and answers above chance. Every claim is made twice, for
// these fabrics and for fabrics like these, and each family of claims is corrected for its size.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "stats/claims/crossed_mean.h"

namespace stats {

/// The level of every claim, and the method of correction.
inline constexpr double claimAlpha = 0.05;

/// Answers of participants x fabrics under each condition; NaN is missing. A share of right choices is a mean of 1 and 0.
class AnswerCube {
public:
    AnswerCube(std::size_t conditions, std::size_t participants, std::size_t fabrics);

    double& at(std::size_t condition, std::size_t participant, std::size_t fabric);
    double at(std::size_t condition, std::size_t participant, std::size_t fabric) const;
    std::size_t conditions() const { return m_conditions; }
    std::size_t participants() const { return m_participants; }
    std::size_t fabrics() const { return m_fabrics; }

    AnswerCube withoutParticipant(std::size_t participant) const;
    AnswerCube withoutFabric(std::size_t fabric) const;

    /// The answers under a condition.
    CrossedTable tableUnder(std::size_t condition) const;
    CrossedValues valuesUnder(std::size_t condition) const;
    /// Differences a - b of the participant x fabric cells that have both.
    CrossedTable differences(std::size_t a, std::size_t b) const;

private:
    std::size_t m_conditions, m_participants, m_fabrics;
    std::vector<double> m_values;
};

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

/// One family: all conditions. `chance`: 1 / m.
std::vector<ChanceClaim> chanceClaims(const AnswerCube& answers, double chance, Generalisation generalisation);

}  // namespace stats
