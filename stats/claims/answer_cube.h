// The answers to one question, by condition, participant and fabric.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "stats/claims/crossed_mean.h"

namespace stats {

/// What the answers of a study are.
enum class AnswerValues {
    Ratings,
    Choices,  ///< 1: right; 0: wrong
};

/// Answers of participants x fabrics under each condition; NaN is missing. A share of right choices is a mean of 1 and 0. A cell
/// may be the mean of several answers. Where some of them are missing, two conditions are compared on other means.
class AnswerCube {
public:
    AnswerCube(AnswerValues kind, std::size_t conditions, std::size_t participants, std::size_t fabrics);

    double& at(std::size_t condition, std::size_t participant, std::size_t fabric);
    double at(std::size_t condition, std::size_t participant, std::size_t fabric) const;
    AnswerValues kind() const { return m_kind; }
    std::size_t conditions() const { return m_conditions; }
    std::size_t participants() const { return m_participants; }
    std::size_t fabrics() const { return m_fabrics; }

    AnswerCube withoutParticipant(std::size_t participant) const;
    AnswerCube withoutFabric(std::size_t fabric) const;

    /// The answers under a condition.
    CrossedTable tableUnder(std::size_t condition) const;

    /// From now on a and b are compared on these means, which are of the answers that each cell has under both; NaN: of none.
    /// Nothing is kept where they are the means of the cells. A change of a cell does not change them.
    void setComparable(std::size_t a, std::size_t b, CrossedTable ofA, CrossedTable ofB);
    /// Whether some pair of conditions is compared on other means than those of the cells; whether this one is.
    bool comparesOtherMeans() const { return !m_comparable.empty(); }
    bool comparesOtherMeans(std::size_t a, std::size_t b) const { return m_comparable.contains({a, b}); }
    /// The answers under `condition` that are compared with those under `other`.
    CrossedTable comparable(std::size_t condition, std::size_t other) const;
    /// Differences a - b of the participant x fabric cells that have both.
    CrossedTable differences(std::size_t a, std::size_t b) const;

private:
    AnswerValues m_kind;
    std::size_t m_conditions, m_participants, m_fabrics;
    std::vector<double> m_values;
    std::map<std::pair<std::size_t, std::size_t>, CrossedTable> m_comparable;  ///< by condition and the one beside it
};

/// Whether the degrees of freedom of a contrast are limited where its own differences seem not to vary. Seven fabrics say little
/// about that; all conditions together say more. Limited if F tests of participant x condition and of fabric x condition, over
/// all conditions, do not both have p >= .05, and wherever answers are missing. Without any interaction a limit for every pair
/// would cost up to 3.7 points of power after Holm's correction of 36 contrasts (`vis2hap power --planted`).
Degrees degreesOf(const AnswerCube& answers);

}  // namespace stats
