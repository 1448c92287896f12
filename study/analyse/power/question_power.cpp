#include "study/analyse/power/question_power.h"

#include <array>

#include "stats/claims/claims.h"
#include "study/analyse/power/planned_power.h"

namespace study::analyse {

namespace {

using stats::Generalisation;
constexpr std::array bothGeneralisations{Generalisation::TheseFabrics, Generalisation::FabricsLikeThese};

/// The reason why a claim cannot be tested with this design; empty where it can.
std::string whyUntestable(const stats::StudyDesign& design, Generalisation generalisation)
{
    if (design.participants < 2) return "a test needs at least 2 participants";
    if (generalisation == Generalisation::FabricsLikeThese && design.fabrics < 2)
        return "a claim for fabrics like these needs at least 2 fabrics";
    return {};
}

/// Evaluates a power, or narrowest bounds, at 5 % and at the first step of Holm's correction.
template <class AtAlpha>
CorrectedPower corrected(const stats::StudyDesign& design, const stats::CrossedVariances& variances,
                         Generalisation generalisation, std::size_t family, const AtAlpha& atAlpha)
{
    if (const std::string why = whyUntestable(design, generalisation); !why.empty())
        return {stats::Value::undefined(why), stats::Value::undefined(why)};
    const stats::ExpectedError error = stats::expectedError(design, variances, generalisation);
    const auto size = static_cast<double>(std::max<std::size_t>(family, 1));
    return {atAlpha(error, stats::claimAlpha), atAlpha(error, stats::claimAlpha / size)};
}

stats::StudyDesign designOf(const protocols::Protocol& protocol)
{
    return {static_cast<std::size_t>(protocol.participants), static_cast<std::size_t>(protocol.fabricCount),
            protocol.conditions.size(), 2};
}

std::size_t familySize(const protocols::Protocol& protocol)
{
    const std::size_t conditions = protocol.conditions.size();
    return protocol.planned.empty() ? conditions * (conditions - 1) / 2 : protocol.planned.size();
}

/// The tests take the mean of the answers under the instructions, which share the effects of participant and fabric.
stats::CrossedVariances ofMean(stats::CrossedVariances variances, const protocols::Phase& phase)
{
    variances.residual /= phase.runs();
    return variances;
}

void addRatingClaims(QuestionPower& power, const protocols::Protocol& protocol, const protocols::Phase& phase,
                     const protocols::RatingScale& scale)
{
    const stats::StudyDesign design = designOf(protocol);
    const stats::RatingTruth truth = ratingTruthOf(scale);
    const stats::CrossedVariances variances = ofMean(ofDifference(truth), phase);
    const double length = truth.scaleMax - truth.scaleMin;
    const auto [low, high] = protocol.equivalenceBounds;
    power.ratings = truth;
    if (power.contrasts == 0) return;
    for (const double share : {0.05, 0.1, 0.2})
        for (const Generalisation generalisation : bothGeneralisations)
            power.claims.push_back({ClaimKind::Difference, generalisation, share * length,
                                    corrected(design, variances, generalisation, power.contrasts,
                                              [&](const stats::ExpectedError& error, double alpha) {
                                                  return stats::differencePower(error, share * length, alpha);
                                              })});
    const double middle = (low + high) / 2;
    for (const double effect : {middle, (middle + high) / 2})
        for (const Generalisation generalisation : bothGeneralisations)
            power.claims.push_back({ClaimKind::Equivalence, generalisation, effect,
                                    corrected(design, variances, generalisation, power.contrasts,
                                              [&](const stats::ExpectedError& error, double alpha) {
                                                  return stats::boundsPower(error, low, high, effect, alpha);
                                              })});
    for (const Generalisation generalisation : bothGeneralisations)
        power.narrowest.push_back({generalisation, corrected(design, variances, generalisation, power.contrasts,
                                                             [&](const stats::ExpectedError& error, double alpha) {
                                                                 return stats::narrowestBounds(error, length, alpha);
                                                             })});
}

void addChoiceClaims(QuestionPower& power, const protocols::Protocol& protocol, const protocols::Phase& phase, int alternatives)
{
    const stats::StudyDesign design = designOf(protocol);
    const stats::ChoiceTruth truth;
    const double chance = 1.0 / alternatives;
    power.choices = truth;
    for (const double share : {0.15, 0.25, 0.4})
        for (const Generalisation generalisation : bothGeneralisations) {
            const double excess = share * (1 - chance);
            power.claims.push_back({ClaimKind::AboveChance, generalisation, chance + excess,
                                    corrected(design, ofMean(ofChoices(truth, chance + excess), phase), generalisation,
                                              power.conditions, [&](const stats::ExpectedError& error, double alpha) {
                                                  return stats::abovePower(error, excess, alpha);
                                              })});
        }
    if (power.contrasts == 0) return;
    for (const double difference : {0.1, 0.2, 0.3})
        for (const Generalisation generalisation : bothGeneralisations)
            power.claims.push_back(
                {ClaimKind::Difference, generalisation, difference,
                 corrected(design, ofMean(ofDifference(truth, 0.5 + difference / 2, 0.5 - difference / 2), phase), generalisation,
                           power.contrasts, [&](const stats::ExpectedError& error, double alpha) {
                               return stats::differencePower(error, difference, alpha);
                           })});
}

}  // namespace

std::string nameOf(ClaimKind kind)
{
    switch (kind) {
        case ClaimKind::Difference:
            return "difference";
        case ClaimKind::Equivalence:
            return "equivalence";
        case ClaimKind::AboveChance:
            break;
    }
    return "above_chance";
}

std::vector<QuestionPower> questionPowers(const protocols::Protocol& protocol)
{
    std::vector<QuestionPower> powers;
    for (const protocols::Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions) {
            QuestionPower power{question.id.value, familySize(protocol), protocol.conditions.size(), {}, {}, {}, {}};
            if (const auto* rating = std::get_if<protocols::Rating>(&question.kind))
                addRatingClaims(power, protocol, phase, rating->scale);
            else if (const int alternatives = alternativesOf(question.kind); alternatives > 1)
                addChoiceClaims(power, protocol, phase, alternatives);
            else
                continue;
            powers.push_back(std::move(power));
        }
    return powers;
}

}  // namespace study::analyse
