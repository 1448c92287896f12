#include "study/simulation/simulation_analysis.h"

#include <algorithm>
#include <utility>

#include "reports/analysis/pair_comparisons.h"
#include "reports/cells/chance_level.h"
#include "stats/claims/median_time.h"
#include "stats/claims/speed_contrasts.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/multiplicity.h"
#include "study/simulation/question_cells.h"

namespace study::simulation {

namespace {

using reports::StudyAnalysis;
using reports::StudyData;
using stats::Value;

const char* const evidence =
    "Every answer here is simulated. Simulated participants test a design and the software; they are no evidence about people.";
const char* const leftOut =
    "A simulation in memory leaves out what does not grow linearly with the answers, or needs more than their numbers: mixed "
    "models "
    "and the claims that rest on them, Bayes factors, agreement, order effects, confusion of fabrics, conditional accuracy, "
    "speed "
    "contrasts, quality flags, anchors, words and figures. `vis2hap simulate` and `vis2hap report` give them.";
const char* const instructionsLeftOut =
    "The blocks instruct the participant. A simulation in memory averages over the instructions, as the main tables of a report "
    "do. It leaves out what the instructions change: speed and accuracy under each of them, their differences, and late answers.";

reports::PairedMeansOf meansIn(const StudyData& data, const QuestionCells& cells)
{
    return [&](const std::string& a, const std::string& b) {
        const auto placeOf = [&](const std::string& condition) {
            return static_cast<std::size_t>(std::ranges::find(data.conditions, condition) - data.conditions.begin());
        };
        return cells.pairedMeans(placeOf(a), placeOf(b));
    };
}

reports::ConditionRatings ratingsUnder(const QuestionCells& cells, std::size_t condition)
{
    const auto ratings = cells.allValues(condition);
    const auto means = cells.means(condition);
    reports::ConditionRatings under;
    under.ratings = ratings.size();
    under.mean = stats::meanOf(ratings);
    under.sd = stats::describe(ratings).sd;
    under.participants = means.size();
    const bool isComplete = ratings.size() == cells.participants() * cells.answersUnder();
    under.meanOfParticipants = isComplete ? under.mean : stats::meanOf(means);
    under.ci95 = stats::describe(means).ci95;
    if (means.size() < 2) under.ci95.low = under.ci95.high = Value::undefined("needs the means of at least 2 participants");
    return under;
}

reports::RatingAnalysis ratingsOf(const StudyData& data, const QuestionCells& cells, const reports::NumberOnScale& scale)
{
    reports::RatingAnalysis ratings;
    ratings.scale = scale;
    const auto blocks = cells.completeBlocks();
    ratings.anova = stats::repeatedMeasuresAnova(blocks);
    ratings.friedman = stats::friedmanTest(blocks);
    for (std::size_t c = 0; c < cells.conditions(); ++c) {
        ratings.conditions.push_back(ratingsUnder(cells, c));
        ratings.conditions.back().withinHalfWidth = ratings.anova.moreyHalfWidths[c];
    }
    ratings.comparisons = comparePairs(data, meansIn(data, cells));
    ratings.equivalences = testEquivalence(data, meansIn(data, cells), ratings.comparisons);
    return ratings;
}

reports::ConditionChoices choicesUnder(const QuestionCells& cells, std::size_t condition, const reports::RightOrWrong& scoring)
{
    const int alternatives = scoring.alternatives;
    const double chance = 1.0 / alternatives;
    reports::ConditionChoices under;
    for (std::size_t f = 0; f < cells.fabrics(); ++f) {
        reports::CountCorrect count;
        for (std::size_t p = 0; p < cells.participants(); ++p)
            for (const double value : cells.valuesOf(condition, p, f)) {
                ++count.trials;
                count.correct += value == 1;
            }
        under.byFabric.push_back(count);
        under.count.trials += count.trials;
        under.count.correct += count.correct;
    }
    const auto correct = static_cast<long long>(under.count.correct), trials = static_cast<long long>(under.count.trials);
    under.matchesPerRendering =
        trials > 0 ? Value(static_cast<double>(cells.participants() * under.count.correct) / static_cast<double>(trials))
                   : Value::undefined("there are no trials");
    under.againstChance = stats::binomialTest(correct, trials, chance);
    under.participantsAgainstChance = stats::oneSampleTTest(cells.means(condition), {.mu = chance});
    if (scoring.isSameDifferent) {
        std::vector<stats::MatchAnswer> pairs;
        std::vector<reports::PairList> lists;
        for (const auto& list : cells.pairLists(condition)) {
            const auto same = std::ranges::count_if(list, &stats::MatchAnswer::wasSame);
            lists.push_back({same, static_cast<long long>(list.size()) - same});
            pairs.insert(pairs.end(), list.begin(), list.end());
        }
        leaveUntested(under, whyNotHalved(lists));
        under.matches = stats::matchSensitivity(pairs);
        under.dPrime = under.matches->dPrime.estimate;
        under.dPrimeSe = under.matches->seDPrime;
        return under;
    }
    const auto sensitivity = stats::forcedChoice(correct, trials, alternatives);
    under.dPrime = sensitivity.dPrime;
    under.dPrimeSe = sensitivity.seDPrime;
    return under;
}

/// Median time, bits per second and balanced integration score of each condition.
std::vector<reports::ConditionSpeed> speedOf(const QuestionCells& cells, const reports::ChoiceAnalysis& choices)
{
    const int alternatives = choices.alternatives;
    std::vector<stats::ConditionSpeedCells> under(cells.conditions());
    for (std::size_t c = 0; c < cells.conditions(); ++c)
        for (std::size_t p = 0; p < cells.participants(); ++p)
            under[c].push_back(stats::speedCell(cells.valuesOf(c, p), cells.secondsOf(c, p)));
    const auto scores = stats::scoresOf(under);
    std::vector<reports::ConditionSpeed> speeds;
    for (std::size_t c = 0; c < cells.conditions(); ++c) {
        const auto times = stats::responseTimes(cells.allSeconds(c));
        const Value correct = stats::meanOf(cells.allValues(c));
        std::vector<double> existing;
        for (const Value& score : scores[c])
            if (score.exists()) existing.push_back(*score);
        std::vector<stats::ParticipantChoices> chosen;
        for (const auto& cell : under[c]) chosen.push_back(cell.choices);
        reports::ConditionSpeed speed{times.median, times.mean, stats::meanOf(existing), {}, {}, {}, correct, {}};
        std::vector<std::vector<double>> seconds;
        for (std::size_t p = 0; p < cells.participants(); ++p) seconds.push_back(cells.secondsOf(c, p));
        speed.medianSecondsCi95 =
            times.median.exists() ? stats::medianTimeCi95(seconds) : stats::Interval{times.median, times.median};
        speed.shareCi95 = reports::shareIntervalOf(under[c]);
        if (correct.exists() && times.mean.exists())
            speed.bitsPerSecond = stats::bitsPerSecond(*correct, alternatives, *times.mean);
        speed.bitsPerSecondCi95 = stats::informationRate(chosen, alternatives).ci95;
        if (const std::string& why = choices.conditions[c].noChance; !why.empty())
            speed.bitsPerSecond = speed.bitsPerSecondCi95.low = speed.bitsPerSecondCi95.high = Value::undefined(why);
        const auto test = stats::oneSampleTTest(existing);
        speed.scoreCi95 = test.why.empty() ? test.ci : stats::Interval{Value::undefined(test.why), Value::undefined(test.why)};
        speeds.push_back(speed);
    }
    return speeds;
}

reports::ChoiceAnalysis choicesOf(const StudyData& data, const QuestionCells& cells, const reports::RightOrWrong& scoring)
{
    reports::ChoiceAnalysis choices;
    choices.alternatives = scoring.alternatives;
    std::vector<Value> p;
    for (std::size_t c = 0; c < cells.conditions(); ++c) {
        choices.conditions.push_back(choicesUnder(cells, c, scoring));
        p.push_back(choices.conditions.back().againstChance.pGreater);
    }
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t c = 0; c < holm.size(); ++c) choices.conditions[c].pHolm = holm[c];
    choices.cochran = stats::cochranTest(cells.completeSuccesses());
    choices.comparisons = comparePairs(data, meansIn(data, cells));
    choices.speed.conditions = speedOf(cells, choices);
    return choices;
}

StudyData describedStudy(const MemoryStudy& study, const std::vector<SimulatedAnswers>& answers)
{
    StudyData data;
    data.name = study.name + " (simulated participants, in memory)";
    data.protocolSha256 = study.protocolSha256;
    data.blinded = false;
    data.simulated = true;
    data.stamps = {evidence};
    if (!study.protocol.hasUsualBounds) data.boundsFrom = reports::PlanOrigin::Protocol;
    data.equivalenceBounds = study.protocol.equivalenceBounds;
    for (const auto& fabric : study.fabrics) data.fabrics.push_back(fabric.value);
    for (const auto& condition : study.protocol.conditions) data.conditions.push_back(condition.value);
    for (const auto& contrast : contrastsInOrder(study.protocol)) data.planned.emplace_back(contrast.a.value, contrast.b.value);
    for (const auto& phase : study.protocol.phases)
        for (const auto& question : phase.questions) {
            const auto runs = static_cast<std::size_t>(phase.runs());
            data.questions.push_back({question.id.value, question.text, question.kind});
            data.questions.back().answersPerCell = runs;
            data.answersPerCell = std::max(data.answersPerCell, runs);
        }
    for (const SimulatedAnswers& one : answers) {
        (one.hasWithdrawn ? data.withdrawn : data.participants).push_back(simulatedId(one.number).value);
        data.voided += one.hasWithdrawn ? 0 : static_cast<std::size_t>(one.voided);
    }
    data.times = reports::TimesTaken::ToBeginning;
    return data;
}

}  // namespace

StudyAnalysis analysisOf(const MemoryStudy& study, const std::vector<SimulatedAnswers>& answers)
{
    StudyAnalysis analysis;
    StudyData data = describedStudy(study, answers);
    std::vector<const SimulatedAnswers*> analysed;
    for (const SimulatedAnswers& one : answers)
        if (!one.hasWithdrawn) analysed.push_back(&one);
    analysis.speed = reports::speedWithoutChoices(data);
    bool hasSpeed = false;
    const auto places = placesOfQuestions(study);
    const auto addCells = [&](const QuestionPlaces& question, const QuestionCells& cells) {
        analysis.completeness.present += cells.answered();
        analysis.completeness.expected += analysed.size() * question.count();
    };
    for (std::size_t q = 0; q < data.questions.size(); ++q) {
        const auto addChoices = [&](const reports::RightOrWrong& choice) {
            const QuestionCells cells(places[q], analysed, 1);
            addCells(places[q], cells);
            auto choices = choicesOf(data, cells, choice);
            if (!std::exchange(hasSpeed, true)) analysis.speed = choices.speed.conditions;
            analysis.questions.push_back({data.questions[q], std::move(choices), {}, {}});
        };
        const auto addRatings = [&](const reports::NumberOnScale& scale) {
            const QuestionCells cells(places[q], analysed, 10);
            addCells(places[q], cells);
            analysis.questions.push_back({data.questions[q], ratingsOf(data, cells, scale), {}, {}});
        };
        std::visit(protocols::Overloaded{addChoices, addRatings, [](const reports::OpenWords&) {}},
                   reports::scoringOf(data.questions[q].kind));
    }
    analysis.designLimits = {evidence, leftOut};
    if (hasInstructions(study.protocol)) analysis.designLimits.emplace_back(instructionsLeftOut);
    analysis.screening.why = "left out of a simulation in memory";
    analysis.data = std::move(data);
    return analysis;
}

}  // namespace study::simulation
