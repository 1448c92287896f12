#include "study/simulation/simulation_analysis.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "reports/analysis/pair_comparisons.h"
#include "stats/claims/median_time.h"
#include "stats/claims/speed_contrasts.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/multiplicity.h"

namespace study::simulation {

namespace {

using reports::AnswerCells;
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

/// The numbers of one question, sorted for its tests. Those of one cell (condition x fabric) are averaged as in the report.
class QuestionCells {
public:
    QuestionCells(const QuestionPlaces& places, const std::vector<const SimulatedAnswers*>& participants, double perUnit)
        : m_participants(participants),
          m_places(places),
          m_perUnit(perUnit),
          m_isComplete(participants.size(), true),
          m_hasRepetitions(mostAnswers() > 1)
    {
        for (std::size_t c = 0; c < conditions(); ++c) {
            auto& means = m_means.emplace_back();
            for (std::size_t p = 0; p < participants.size(); ++p) {
                const auto values = valuesOf(c, p);
                means.push_back(stats::meanOf(m_places.runs == 1 ? values : cellMeans(c, p)));
                if (values.size() != answersUnder()) m_isComplete[p] = false;
            }
        }
    }

    std::size_t conditions() const { return m_places.conditions; }
    std::size_t fabrics() const { return m_places.fabrics; }
    std::size_t participants() const { return m_participants.size(); }
    /// Answers of a complete participant under a condition.
    std::size_t answersUnder() const { return m_places.fabrics * m_places.runs; }

    std::vector<double> valuesOf(std::size_t condition, std::size_t participant) const
    {
        std::vector<double> values;
        for (std::size_t f = 0; f < fabrics(); ++f) addCell(values, condition, participant, f);
        return values;
    }
    /// Of one cell.
    std::vector<double> valuesOf(std::size_t condition, std::size_t participant, std::size_t fabric) const
    {
        std::vector<double> values;
        addCell(values, condition, participant, fabric);
        return values;
    }
    std::vector<double> secondsOf(std::size_t condition, std::size_t participant) const
    {
        std::vector<double> seconds;
        for (std::size_t f = 0; f < fabrics(); ++f)
            for (std::size_t r = 0; r < m_places.runs; ++r)
                if (const double time = m_participants[participant]->seconds[m_places.at(condition, f, r)]; !std::isnan(time))
                    seconds.push_back(time);
        return seconds;
    }
    std::vector<double> allValues(std::size_t condition) const
    {
        return gathered([&](std::size_t p) { return valuesOf(condition, p); });
    }
    std::vector<double> allSeconds(std::size_t condition) const
    {
        return gathered([&](std::size_t p) { return secondsOf(condition, p); });
    }

    std::vector<double> means(std::size_t condition) const
    {
        std::vector<double> existing;
        for (const Value& mean : m_means[condition])
            if (mean.exists()) existing.push_back(*mean);
        return existing;
    }
    AnswerCells::PairedMeans pairedMeans(std::size_t a, std::size_t b) const
    {
        AnswerCells::PairedMeans paired;
        for (std::size_t p = 0; p < participants(); ++p) {
            if (m_isComplete[p] && fabrics() > 0) {
                paired.a.push_back(*m_means[a][p]);
                paired.b.push_back(*m_means[b][p]);
            } else if (const auto both = commonMeans({a, b}, p); !both.empty()) {
                paired.a.push_back(both[0]);
                paired.b.push_back(both[1]);
            }
        }
        return paired;
    }
    stats::BlockTable completeBlocks() const
    {
        stats::BlockTable table;
        table.conditions = conditions();
        std::vector<std::size_t> all(conditions());
        std::iota(all.begin(), all.end(), std::size_t{0});
        for (std::size_t p = 0; p < participants(); ++p) {
            const auto row = commonMeans(all, p);
            table.values.insert(table.values.end(), row.begin(), row.end());
            table.blocks += row.empty() ? 0 : 1;
        }
        return table;
    }
    /// Blocks of participant, fabric and run that are answered in every condition.
    stats::BlockTable completeSuccesses() const
    {
        stats::BlockTable table;
        table.conditions = conditions();
        for (std::size_t p = 0; p < participants(); ++p)
            for (std::size_t f = 0; f < fabrics(); ++f)
                for (std::size_t r = 0; r < m_places.runs; ++r) addRow(table, [&](std::size_t c) { return valueAt(c, p, f, r); });
        return table;
    }
    std::size_t answered() const
    {
        std::size_t count = 0;
        for (std::size_t c = 0; c < conditions(); ++c) count += allValues(c).size();
        return count;
    }

private:
    std::optional<double> valueAt(std::size_t condition, std::size_t participant, std::size_t fabric, std::size_t run) const
    {
        const auto value = m_participants[participant]->values[m_places.at(condition, fabric, run)];
        if (value == SimulatedAnswers::none) return std::nullopt;
        return value / m_perUnit;
    }
    void addCell(std::vector<double>& values, std::size_t condition, std::size_t participant, std::size_t fabric) const
    {
        for (std::size_t r = 0; r < m_places.runs; ++r)
            if (const auto value = valueAt(condition, participant, fabric, r)) values.push_back(*value);
    }
    /// Means of the fabrics that the participant answered.
    std::vector<double> cellMeans(std::size_t condition, std::size_t participant) const
    {
        std::vector<double> means;
        for (std::size_t f = 0; f < fabrics(); ++f)
            if (const Value mean = stats::meanOf(valuesOf(condition, participant, f)); mean.exists()) means.push_back(*mean);
        return means;
    }
    /// Most answers of one participant in one cell.
    std::size_t mostAnswers() const
    {
        std::size_t most = 0;
        for (std::size_t p = 0; p < participants() && most < m_places.runs; ++p)
            for (std::size_t c = 0; c < conditions(); ++c)
                for (std::size_t f = 0; f < fabrics(); ++f) most = std::max(most, valuesOf(c, p, f).size());
        return most;
    }
    /// The numbers of a fabric under each of these conditions, where all have one: in runs that are answered under all of them.
    /// Where no cell holds several answers, runs need not match.
    std::vector<std::vector<double>> commonValues(const std::vector<std::size_t>& conditions, std::size_t participant,
                                                  std::size_t fabric) const
    {
        std::vector<std::vector<double>> values(conditions.size());
        for (std::size_t r = 0; r < m_places.runs; ++r) {
            const auto isThere = [&](std::size_t c) { return valueAt(c, participant, fabric, r).has_value(); };
            if (m_hasRepetitions && !std::ranges::all_of(conditions, isThere)) continue;
            for (std::size_t i = 0; i < values.size(); ++i)
                if (const auto value = valueAt(conditions[i], participant, fabric, r)) values[i].push_back(*value);
        }
        if (std::ranges::any_of(values, [](const auto& own) { return own.empty(); })) return {};
        return values;
    }
    /// Means over the fabrics that the participant answered under each of these conditions; empty without such a fabric.
    std::vector<double> commonMeans(const std::vector<std::size_t>& conditions, std::size_t participant) const
    {
        std::vector<std::vector<double>> cells(conditions.size());
        for (std::size_t f = 0; f < fabrics(); ++f) {
            const auto values = commonValues(conditions, participant, f);
            for (std::size_t i = 0; i < values.size(); ++i) cells[i].push_back(*stats::meanOf(values[i]));
        }
        std::vector<double> means;
        for (const auto& own : cells)
            if (!own.empty()) means.push_back(*stats::meanOf(own));
        return means;
    }

    template <class Part>
    std::vector<double> gathered(const Part& part) const
    {
        std::vector<double> all;
        for (std::size_t p = 0; p < participants(); ++p) {
            const auto some = part(p);
            all.insert(all.end(), some.begin(), some.end());
        }
        return all;
    }

    template <class NumberUnder>
    void addRow(stats::BlockTable& table, const NumberUnder& numberUnder) const
    {
        const std::size_t before = table.values.size();
        for (std::size_t c = 0; c < conditions(); ++c)
            if (const auto number = numberUnder(c)) table.values.push_back(*number);
        if (table.values.size() == before + conditions() && conditions() > 0)
            ++table.blocks;
        else
            table.values.resize(before);
    }

    const std::vector<const SimulatedAnswers*>& m_participants;
    QuestionPlaces m_places;
    double m_perUnit;
    std::vector<bool> m_isComplete;           ///< whether the participant answered everything
    bool m_hasRepetitions;                    ///< whether some cell holds several answers
    std::vector<std::vector<Value>> m_means;  ///< [condition][participant]
};

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
        under.dPrime = under.dPrimeSe =
            Value::undefined("a simulation in memory keeps right and wrong, not hits and false alarms");
        return under;
    }
    const auto sensitivity = stats::forcedChoice(correct, trials, alternatives);
    under.dPrime = sensitivity.dPrime;
    under.dPrimeSe = sensitivity.seDPrime;
    return under;
}

/// Median time, bits per second and balanced integration score of each condition.
std::vector<reports::ConditionSpeed> speedOf(const QuestionCells& cells, int alternatives)
{
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
        std::vector<stats::ParticipantChoices> choices;
        for (const auto& cell : under[c]) choices.push_back(cell.choices);
        reports::ConditionSpeed speed{times.median, times.mean, stats::meanOf(existing), {}, {}, {}, correct, {}};
        std::vector<std::vector<double>> seconds;
        for (std::size_t p = 0; p < cells.participants(); ++p) seconds.push_back(cells.secondsOf(c, p));
        speed.medianSecondsCi95 =
            times.median.exists() ? stats::medianTimeCi95(seconds) : stats::Interval{times.median, times.median};
        speed.shareCi95 = reports::shareIntervalOf(under[c]);
        if (correct.exists() && times.mean.exists())
            speed.bitsPerSecond = stats::bitsPerSecond(*correct, alternatives, *times.mean);
        speed.bitsPerSecondCi95 = stats::informationRate(choices, alternatives).ci95;
        const auto test = stats::oneSampleTTest(existing);
        speed.scoreCi95 = test.why.empty() ? test.ci : stats::Interval{Value::undefined(test.why), Value::undefined(test.why)};
        speeds.push_back(speed);
    }
    return speeds;
}

reports::ChoiceAnalysis choicesOf(const StudyData& data, const QuestionCells& cells, const reports::RightOrWrong& scoring)
{
    const int alternatives = scoring.alternatives;
    reports::ChoiceAnalysis choices;
    choices.alternatives = alternatives;
    std::vector<Value> p;
    for (std::size_t c = 0; c < cells.conditions(); ++c) {
        choices.conditions.push_back(choicesUnder(cells, c, scoring));
        p.push_back(choices.conditions.back().againstChance.pGreater);
    }
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t c = 0; c < holm.size(); ++c) choices.conditions[c].pHolm = holm[c];
    choices.cochran = stats::cochranTest(cells.completeSuccesses());
    choices.comparisons = comparePairs(data, meansIn(data, cells));
    choices.speed.conditions = speedOf(cells, alternatives);
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
