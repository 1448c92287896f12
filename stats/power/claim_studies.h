// Studies drawn at random to try the claims of the report: participants and fabrics differ, and both may interact with condition.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "stats/claims/claims.h"
#include "stats/power/simulated_study.h"

namespace stats {

/// Interactions of a simulated study: SDs in scale points (ratings) or log odds (choices).
struct ClaimNull {
    bool isChoice = false;
    double participantSd = 0;  ///< participant x condition
    double fabricSd = 0;       ///< fabric x condition
    bool isUnequal = false;    ///< both SDs are 1.2 under the first condition and 0.3 under the others

    std::string text() const;
    /// SD of a participant's effects under a condition: the same under all conditions and interaction together.
    double participantsSd(std::size_t condition) const;
    /// The same of a fabric's effects.
    double fabricsSd(std::size_t condition) const;
};

/// Ratings, then choices: SDs of 0, 0.5 and 1 in all combinations, then the unequal conditions.
std::vector<ClaimNull> claimNulls();

/// SD of the residual of the simulated ratings, scale points.
inline constexpr double claimResidualSd = 0.92;
/// Share of right choices where contrasts of choices are tried.
inline constexpr double contrastShare = 0.6;

/// An answer that is about to be drawn.
struct DrawnCell {
    std::size_t condition = 0;
    std::size_t participant = 0;
    double effects = 0;   ///< sum of the random effects
    double ofFabric = 0;  ///< effects of the fabric alone: its own and its interaction with condition
};

/// A study without gaps; `answer` turns the effects of each cell into an answer. TheseFabrics: the interactions of fabrics have a
/// mean of zero under each condition, so that conditions do not differ on the fabrics of the study.
AnswerCube drawnStudy(const StudyDesign& design, const ClaimNull& null, Generalisation truth, Draws& draws,
                      const std::function<double(const DrawnCell&)>& answer);

/// All pairs of conditions a < b.
std::vector<ContrastPair> allPairs(std::size_t conditions);

}  // namespace stats
