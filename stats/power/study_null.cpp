#include "stats/power/study_null.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stats/power/logistic_share.h"

namespace stats {
namespace {

std::vector<double> effectsOf(std::size_t count, double sd, Draws& draws)
{
    std::vector<double> effects(count);
    for (double& effect : effects) effect = draws.normal(sd);
    return effects;
}

}  // namespace

FalseClaims simulateStudyNull(const StudyNull& null, const SimulationOptions& options)
{
    assert(!null.contrasts.empty() && "a family has a contrast");
    const AnswerCube& asked = null.asked;
    const bool isChoice = asked.kind() == AnswerValues::Choices;
    const double spread =
        std::sqrt(null.participantSd * null.participantSd + null.fabricSd * null.fabricSd +
                  null.participantConditionSd * null.participantConditionSd + null.fabricConditionSd * null.fabricConditionSd);
    // A share of 0 or 1 has no log odds; half an answer more or less has.
    const double least = 0.5 / static_cast<double>(asked.conditions() * asked.participants() * asked.fabrics() + 1);
    const double intercept = isChoice ? interceptFor(std::clamp(null.centre, least, 1 - least), spread) : 0;
    const auto analysis = [&](Draws& draws, std::span<Value> p) {
        AnswerCube cube = asked;
        const auto people = effectsOf(asked.participants(), null.participantSd, draws),
                   fabrics = effectsOf(asked.fabrics(), null.fabricSd, draws);
        for (std::size_t c = 0; c < asked.conditions(); ++c) {
            const auto ofPeople = effectsOf(asked.participants(), null.participantConditionSd, draws),
                       ofFabrics = effectsOf(asked.fabrics(), null.fabricConditionSd, draws);
            for (std::size_t i = 0; i < asked.participants(); ++i)
                for (std::size_t f = 0; f < asked.fabrics(); ++f) {
                    if (std::isnan(asked.at(c, i, f))) continue;
                    const double effects = people[i] + fabrics[f] + ofPeople[i] + ofFabrics[f];
                    cube.at(c, i, f) =
                        isChoice ? (draws.happens(shareOfLogOdds(intercept + effects)) ? 1.0 : 0.0)
                                 : std::clamp(null.centre + effects + draws.normal(null.residualSd), null.lowest, null.highest);
                }
        }
        const auto claims = contrastClaims(cube, null.contrasts, {}, Generalisation::FabricsLikeThese);
        p[0] = claims.front().difference.p;
        p[1] = Value::undefined("no contrast can be tested");
        for (const ContrastClaim& claim : claims)
            if (claim.pAdjusted.exists() && (!p[1].exists() || *claim.pAdjusted < *p[1])) p[1] = claim.pAdjusted;
    };
    const std::vector<Rejections> rejections = simulateTests(2, analysis, options);
    return {rejections[0], rejections[1]};
}

}  // namespace stats
