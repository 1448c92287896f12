#include "reports/analysis/choice_analysis.h"

#include <algorithm>

#include "reports/cells/chance_level.h"
#include "reports/cells/crossed_answers.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/multiplicity.h"

namespace reports {
namespace {

std::vector<CountCorrect> countsByFabric(const StudyData& data, const std::vector<const StudyResponse*>& responses)
{
    std::vector<CountCorrect> counts;
    for (const std::string& fabric : data.fabrics) {
        std::vector<const StudyResponse*> ofFabric;
        for (const StudyResponse* response : responses)
            if (response->fabric == fabric) ofFabric.push_back(response);
        const std::vector<double> values = valuesOf(ofFabric);
        counts.push_back({correctAmong(values), values.size()});
    }
    return counts;
}

std::size_t placeAmong(const std::vector<std::string>& names, const std::string& name)
{
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Whether a pair was the same follows from what was said, and whether that was right. Undefined where other programs recorded
/// only right and wrong.
stats::MatchSensitivity matchesOf(const StudyData& data, const std::vector<const StudyResponse*>& responses)
{
    std::vector<stats::MatchAnswer> answers;
    for (const StudyResponse* response : responses) {
        const auto* given = std::get_if<ChosenAnswer>(&response->content);
        if (given == nullptr || !given->answer) continue;
        const bool saidSame = *given->answer == "same";
        answers.push_back({placeAmong(data.participants, response->participant), placeAmong(data.fabrics, response->fabric),
                           saidSame == given->correct, saidSame});
    }
    return stats::matchSensitivity(answers);
}

void leaveUntested(stats::BinomialTest& test, const std::string& why)
{
    test.why = why;
    test.pGreater = test.logPGreater = test.pLess = test.pTwoSided = test.logPTwoSided = test.pMidGreater = test.logPMidGreater =
        stats::Value::undefined(why);
}

void leaveUntested(stats::TTest& test, const std::string& why)
{
    test.why = why;
    test.t = test.p = test.logP = test.dZ = test.hedgesGz = stats::Value::undefined(why);
}

ConditionChoices analyseCondition(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                  const std::string& condition, const RightOrWrong& scoring, std::size_t people)
{
    const auto responses = cells.of(question, condition);
    const std::vector<double> values = valuesOf(responses);
    const double chance = 1.0 / scoring.alternatives;
    ConditionChoices choices;
    choices.count = {correctAmong(values), values.size()};
    const auto correct = static_cast<long long>(choices.count.correct);
    const auto trials = static_cast<long long>(choices.count.trials);
    // Multiply before the division: 10 x 27 / 70 is then the nearest double.
    const auto matches = static_cast<double>(people * choices.count.correct);
    choices.matchesPerRendering =
        trials > 0 ? stats::Value(matches / static_cast<double>(trials)) : stats::Value::undefined("there are no trials");
    choices.againstChance = stats::binomialTest(correct, trials, chance);
    choices.participantsAgainstChance = stats::oneSampleTTest(cells.participantMeans(question, condition), {.mu = chance});
    leaveUntested(choices, whyNoChance(scoring, responses));
    if (scoring.isSameDifferent) {
        choices.matches = matchesOf(data, responses);
        choices.dPrime = choices.matches->dPrime.estimate;
        choices.dPrimeSe = choices.matches->seDPrime;
    } else {
        const auto sensitivity = stats::forcedChoice(correct, trials, scoring.alternatives);
        choices.dPrime = sensitivity.dPrime;
        choices.dPrimeSe = sensitivity.seDPrime;
    }
    choices.byFabric = countsByFabric(data, responses);
    return choices;
}

void adjustForConditions(std::vector<ConditionChoices>& conditions)
{
    std::vector<stats::Value> p;
    for (const ConditionChoices& condition : conditions) p.push_back(condition.againstChance.pGreater);
    const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t i = 0; i < conditions.size(); ++i) conditions[i].pHolm = holm[i];
}

void analyseParticipants(ChoiceAnalysis& analysis, const AnswerCells& cells, const std::string& question,
                         const RightOrWrong& scoring)
{
    std::vector<double> shares;
    std::vector<const StudyResponse*> all;
    for (const std::string& participant : cells.participants()) {
        const auto responses = cells.ofParticipant(question, participant);
        all.insert(all.end(), responses.begin(), responses.end());
        const stats::Value share = stats::meanOf(valuesOf(responses));
        analysis.participants.push_back({participant, share});
        if (share.exists()) shares.push_back(*share);
    }
    analysis.participantsAgainstChance = stats::oneSampleTTest(shares, {.mu = 1.0 / analysis.alternatives});
    if (const std::string why = whyNoChance(scoring, all); !why.empty()) leaveUntested(analysis.participantsAgainstChance, why);
}

ChoiceConfusion confusionOf(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    ChoiceConfusion confusion;
    const std::size_t n = data.fabrics.size();
    confusion.chosen.assign(n, std::vector<std::size_t>(n));
    const auto placeOf = [&](const std::string& fabric) {
        return static_cast<std::size_t>(std::find(data.fabrics.begin(), data.fabrics.end(), fabric) - data.fabrics.begin());
    };
    for (const std::string& condition : data.conditions)
        for (const StudyResponse* response : cells.of(question, condition)) {
            const auto* choice = std::get_if<ChosenAnswer>(&response->content);
            if (choice == nullptr) continue;
            if (choice->answer && placeOf(*choice->answer) < n) {
                ++confusion.chosen[placeOf(response->fabric)][placeOf(*choice->answer)];
                confusion.known = true;
            }
            if (choice->slot && ++confusion.slotCounts[*choice->slot] == 1) confusion.slots.push_back(*choice->slot);
        }
    return confusion;
}

/// d' and its intervals become those of hits and false alarms.
void takeMatches(std::vector<ClusteredSensitivity>& sensitivities, const StudyData& data,
                 const std::vector<ConditionChoices>& conditions)
{
    for (ClusteredSensitivity& one : sensitivities) {
        const stats::ClusteredIndex& dPrime = conditions[placeAmong(data.conditions, one.condition)].matches->dPrime;
        one.dPrime = dPrime.estimate;
        one.ci95 = one.generalisation == stats::Generalisation::TheseFabrics ? dPrime.overParticipants : dPrime.overBoth;
    }
}

}  // namespace

int shownChance(const ChoiceAnalysis& choices)
{
    const auto isTested = [](const ConditionChoices& one) { return one.noChance.empty(); };
    return std::ranges::any_of(choices.conditions, isTested) ? choices.alternatives : 0;
}

std::vector<std::string> untestedConditions(const StudyData& data, const ChoiceAnalysis& choices)
{
    std::vector<std::string> names;
    for (std::size_t c = 0; c < choices.conditions.size(); ++c)
        if (!choices.conditions[c].noChance.empty()) names.push_back(data.conditions[c]);
    return names;
}

void leaveUntested(ConditionChoices& choices, const std::string& why)
{
    if (why.empty()) return;
    choices.noChance = why;
    leaveUntested(choices.againstChance, why);
    leaveUntested(choices.participantsAgainstChance, why);
}

DPrimeRule ruleOfDPrime(const ChoiceAnalysis& choices)
{
    const bool isSameDifferent = !choices.conditions.empty() && choices.conditions.front().matches.has_value();
    return isSameDifferent ? DPrimeRule::OfHits : DPrimeRule::OfShare;
}

std::size_t answeringParticipants(const StudyData& data, const ChoiceAnalysis& choices)
{
    if (choices.participants.empty()) return data.participants.size();
    return static_cast<std::size_t>(
        std::ranges::count_if(choices.participants, [](const ParticipantShare& one) { return one.share.exists(); }));
}

ChoiceAnalysis analyseChoices(const StudyData& data, const AnswerCells& cells, const std::string& question,
                              const RightOrWrong& scoring, Depth depth)
{
    const int alternatives = scoring.alternatives;
    ChoiceAnalysis analysis;
    analysis.alternatives = alternatives;
    analyseParticipants(analysis, cells, question, scoring);
    const std::size_t people = answeringParticipants(data, analysis);
    for (const std::string& condition : data.conditions)
        analysis.conditions.push_back(analyseCondition(data, cells, question, condition, scoring, people));
    adjustForConditions(analysis.conditions);
    std::vector<std::string> noChance;
    for (const ConditionChoices& condition : analysis.conditions) noChance.push_back(condition.noChance);
    analysis.cochran = stats::cochranTest(cells.completeSuccesses(question));
    const stats::CrossedStudy answers = crossedAnswers(data, cells, question);
    analysis.model = stats::fitChoices(answers);
    analysis.crossedModel = stats::fitChoices(answers, stats::ChoiceTerms::WithInteractions);
    analysis.linearModel = stats::fitRatings(crossedCells(data, cells, question));
    analysis.confusion = confusionOf(data, cells, question);
    analysis.comparisons = comparePairs(data, cells, question);
    const stats::RepeatedMeasuresAnova anova = stats::repeatedMeasuresAnova(cells.completeBlocks(question).table);
    analysis.claims = claimsOf(data, cells, question, alternatives, anova, analysis.linearModel, depth, noChance);
    analysis.effects = choiceEffects(analysis.claims, anova, answers, analysis.crossedModel);
    analysis.sensitivities = clusteredSensitivities(analysis.claims, alternatives);
    if (scoring.isSameDifferent) takeMatches(analysis.sensitivities, data, analysis.conditions);
    analysis.speed = analyseSpeed(data, cells, question, scoring, analysis.claims);
    analysis.accuracyBySpeed = accuracyBySpeed(data, cells, question);
    analysis.instructions = analyseInstructions(data, question, scoring);
    return analysis;
}

}  // namespace reports
