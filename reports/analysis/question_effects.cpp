#include "reports/analysis/question_effects.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "reports/text/number_text.h"
#include "stats/tests/forced_choice.h"

namespace reports {
namespace {

/// Mean ratings of each participant [conditions x fabrics]; NaN where there is none.
std::vector<std::vector<double>> ratingsByParticipant(const StudyData& data, const AnswerCells& cells,
                                                      const std::string& question)
{
    std::map<std::string, std::size_t> fabrics;
    for (const std::string& fabric : data.fabrics) fabrics.emplace(fabric, fabrics.size());
    const std::size_t stimuli = data.conditions.size() * fabrics.size();
    std::vector<std::vector<double>> ratings(cells.participants().size(),
                                             std::vector<double>(stimuli, std::numeric_limits<double>::quiet_NaN()));
    for (std::size_t c = 0; c < data.conditions.size(); ++c)
        for (const AnswerCells::CellMean& cell : cells.cellMeans(question, data.conditions[c]))
            ratings[cell.participant][c * fabrics.size() + fabrics.at(cell.first->fabric)] = cell.mean;
    return ratings;
}

bool isMissing(double rating) { return std::isnan(rating); }

/// Rows of stimuli that every rater rated.
stats::BlockTable completeStimuli(const std::vector<std::vector<double>>& raters, std::size_t stimuli)
{
    std::vector<std::vector<double>> rows;
    for (std::size_t s = 0; s < stimuli && !raters.empty(); ++s) {
        std::vector<double> row;
        for (const std::vector<double>& rater : raters) row.push_back(rater[s]);
        if (std::none_of(row.begin(), row.end(), isMissing)) rows.push_back(std::move(row));
    }
    stats::BlockTable table = stats::blockTableOf(rows).table;
    table.conditions = raters.size();
    return table;
}

RaterAgreement agreementOf(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    RaterAgreement agreement;
    std::vector<std::vector<double>> all = ratingsByParticipant(data, cells, question), raters;
    const std::size_t stimuli = data.conditions.size() * data.fabrics.size();
    for (std::size_t p = 0; p < all.size(); ++p)
        if (2 * static_cast<std::size_t>(std::count_if(all[p].begin(), all[p].end(), isMissing)) <= stimuli)
            raters.push_back(std::move(all[p]));
        else
            agreement.leftOut.push_back(cells.participants()[p]);
    const stats::BlockTable table = completeStimuli(raters, stimuli);
    agreement.stimuli = table.blocks;
    agreement.raters = raters.size();
    agreement.icc = stats::intraclassCorrelations(table);
    agreement.ci95 = stats::intraclassIntervals(table);
    // The formula for the mean leaves its range where the raters agree less than chance would make them.
    if (agreement.icc.icc2k.exists() && *agreement.icc.icc2k > 1)
        agreement.icc.icc2k = stats::Value::undefined("the raters agree less than by chance");
    return agreement;
}

stats::JzsBayesFactor factorOf(const stats::ContrastClaim& claim)
{
    if (claim.difference.t.exists())
        return stats::jzsBayesFactor(*claim.difference.t, static_cast<long long>(claim.mean.participants));
    const stats::Value none = stats::Value::undefined(claim.difference.t.why());
    return {claim.difference.t.why(), none, none};
}

void putEvidence(QuestionEffects& effects, const QuestionClaims& claims)
{
    // Each contrast stands there for both generalisations.
    if (claims.contrasts.size() / 2 > mostBayesFactors) {
        effects.noEvidence = "left out for more than " + std::to_string(mostBayesFactors) + " contrasts";
        return;
    }
    for (const ContrastFinding& finding : claims.contrasts)
        if (finding.generalisation == stats::Generalisation::TheseFabrics)
            effects.evidence.push_back({finding.a, finding.b, finding.planned, finding.claim.mean.participants,
                                        finding.claim.difference.t, factorOf(finding.claim)});
    if (effects.evidence.empty()) effects.noEvidence = "there is one condition only";
}

QuestionEffects commonEffects(const QuestionClaims& claims, const stats::RepeatedMeasuresAnova& anova)
{
    QuestionEffects effects;
    putEvidence(effects, claims);
    effects.completeParticipants = anova.blocks;
    effects.partialEtaSquared = anova.partialEtaSquared;
    effects.generalizedEtaSquared = anova.generalizedEtaSquared;
    return effects;
}

}  // namespace

QuestionEffects ratingEffects(const StudyData& data, const AnswerCells& cells, const std::string& question,
                              const QuestionClaims& claims, const stats::RepeatedMeasuresAnova& anova,
                              const stats::CrossedStudy& answers, const stats::RatingModel& model)
{
    QuestionEffects effects = commonEffects(claims, anova);
    effects.agreement = agreementOf(data, cells, question);
    effects.variance = stats::explainedVariance(answers, model);
    effects.leftOut = model.leftOut;
    return effects;
}

QuestionEffects choiceEffects(const QuestionClaims& claims, const stats::RepeatedMeasuresAnova& anova,
                              const stats::CrossedStudy& answers, const stats::ChoiceModel& model)
{
    QuestionEffects effects = commonEffects(claims, anova);
    effects.variance = stats::explainedVariance(answers, model);
    effects.leftOut = model.leftOut;
    return effects;
}

const stats::VarianceComponent* componentOf(const QuestionEffects& effects, const std::string& name)
{
    const auto& components = effects.variance.components;
    const auto found = std::find_if(components.begin(), components.end(), [&](const auto& one) { return one.name == name; });
    return found == components.end() ? nullptr : &*found;
}

std::string fabricSentence(const QuestionEffects& effects, const std::string& unit)
{
    const stats::VarianceComponent* component = componentOf(effects, "fabric:condition");
    if (component == nullptr || !component->share.exists())
        return "How far a difference of two conditions varies from fabric to fabric is not known.";
    if (component->isZero)
        return "No variance of fabric \u00D7 condition was found. With few fabrics this does not show that there is none.";
    return "Fabric \u00D7 condition has " + fixed(100 * *component->share, 0) +
           " % of the variance. A difference of two conditions varies from fabric to fabric with an SD of " +
           fixed(std::numbers::sqrt2 * *component->sd, 2) + " " + unit + ".";
}

std::vector<ClusteredSensitivity> clusteredSensitivities(const QuestionClaims& claims, int alternatives)
{
    const auto dPrimeOf = [&](const stats::Value& share) {
        return share.exists() ? stats::dPrimeAt(std::clamp(*share, 0.0, 1.0), alternatives) : share;
    };
    std::vector<ClusteredSensitivity> all;
    for (const ChanceFinding& finding : claims.aboveChance) {
        const stats::CrossedMean& mean = finding.claim.mean;
        all.push_back({finding.condition,
                       finding.generalisation,
                       mean.estimate,
                       mean.ci95,
                       dPrimeOf(mean.estimate),
                       {dPrimeOf(mean.ci95.low), dPrimeOf(mean.ci95.high)}});
    }
    return all;
}

}  // namespace reports
