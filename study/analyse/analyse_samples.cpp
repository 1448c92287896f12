#include "study/analyse/analyse_samples.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "stats/claims/speed_contrasts.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/speed_accuracy.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

ordered_json describe(const AnalysisRequest& request)
{
    const auto x = numbersAt(request.inputs, "x");
    const auto d = stats::describe(x);
    if (!d.mean.exists() && d.mean.decimal().empty()) return degenerate(d.mean.why());
    AnswerFields answer;
    answer.putCount("n", d.n).putCount("n_dropped", d.missing).put("mean", d.mean).put("sd", d.sd).put("variance", d.variance);
    answer.put("autocorr1", d.autocorrelationLag1).put("median", d.median).put("q1", d.q1).put("q3", d.q3);
    return answer.put("min", d.min).put("max", d.max).put("ci", d.ci95).json();
}

std::vector<bool> correctOf(const AnalysisRequest& request)
{
    std::vector<bool> correct;
    for (const double value : numbersAt(request.inputs, "correct")) {
        if (value != 0 && value != 1) throw RequestFault("correct must hold 0 and 1 only");
        correct.push_back(value == 1);
    }
    return correct;
}

ordered_json conditionalAccuracy(const AnalysisRequest& request)
{
    const long long bins = wholeOr(request.options, "bins", 5);
    if (bins < 1 || bins > 1000) throw RequestFault("bins must lie between 1 and 1000");
    const auto accuracy =
        stats::conditionalAccuracy(numbersAt(request.inputs, "seconds"), correctOf(request), static_cast<std::size_t>(bins));
    if (!accuracy.why.empty()) return degenerate(accuracy.why);
    ordered_json rows = ordered_json::array();
    for (const auto& bin : accuracy.bins) {
        AnswerFields row;
        row.putCount("n", bin.n).put("seconds", bin.meanSeconds).put("proportion", bin.proportionCorrect).put("ci", bin.ci95);
        rows.push_back(row.json());
    }
    return {{"bins", rows}};
}

constexpr long long usualAlternatives = 3;  ///< as in the paper

/// A request that does not state the number of alternatives gets an answer that says so.
ordered_json withAssumption(const AnalysisRequest& request, ordered_json answer)
{
    if (!request.options.contains("alternatives"))
        answer["note"] = "choices among " + std::to_string(usualAlternatives) +
                         " alternatives, the default of this program: the option \"alternatives\" states another number";
    return answer;
}

int alternativesOf(const AnalysisRequest& request)
{
    const long long alternatives = wholeOr(request.options, "alternatives", usualAlternatives);
    if (alternatives < 2 || alternatives > 1000000) throw RequestFault("alternatives must lie between 2 and 1000000");
    return static_cast<int>(alternatives);
}

ordered_json speedAccuracy(const AnalysisRequest& request)
{
    const auto seconds = numbersAt(request.inputs, "seconds");
    const auto correct = correctOf(request);
    const int m = alternativesOf(request);
    if (seconds.size() != correct.size()) throw RequestFault("seconds and correct differ in length");
    const auto times = stats::responseTimes(seconds);
    if (!times.median.exists()) return degenerate(times.median.why());
    const auto right = std::count(correct.begin(), correct.end(), true);
    const double share = static_cast<double>(right) / static_cast<double>(correct.size());
    AnswerFields answer;
    answer.putCount("n", times.n).put("median_seconds", times.median).put("log_mean_seconds", times.logMean);
    answer.put("geometric_mean_seconds", times.geometricMean).put("mean_seconds", times.mean).put("proportion", share);
    answer.put("bits", stats::bitsPerChoice(share, m)).put("bits_per_second", stats::bitsPerSecond(share, m, *times.mean));
    return withAssumption(request, answer.json());
}

ordered_json balancedIntegration(const AnalysisRequest& request)
{
    const auto correct = numbersAt(request.inputs, "pc"), seconds = numbersAt(request.inputs, "rt");
    checkSize("cells", static_cast<double>(correct.size()), 1e6);  // about 200 bytes each
    const auto scores = stats::balancedIntegrationScores(correct, seconds);
    if (scores.empty()) return degenerate("there are no cells");
    if (!scores.front().exists()) return degenerate(scores.front().why());
    return AnswerFields().put("bis", scores).json();
}

/// Choices and times as a table of the rows that have a choice.
struct TimedChoices {
    stats::CrossedStudy rows;  ///< values: 1, 0, or NaN where there is no choice
    std::vector<double> seconds;
};

TimedChoices timedChoicesOf(const AnalysisRequest& request)
{
    TimedChoices choices{crossedRowsAt(request.inputs, "correct"), numbersAt(request.inputs, "seconds")};
    if (choices.seconds.size() != choices.rows.values.size()) throw RequestFault("seconds and correct differ in length");
    for (const double value : choices.rows.values)
        if (value != 0 && value != 1 && !std::isnan(value)) throw RequestFault("correct must hold 0, 1 and null only");
    for (const double time : choices.seconds)
        if (std::isinf(time)) throw RequestFault("seconds must hold finite times and null only");
    return choices;
}

std::vector<stats::ConditionSpeedCells> speedCellsOf(const TimedChoices& choices)
{
    struct CellRows {
        std::vector<double> correct, seconds;
    };
    const std::size_t conditions = choices.rows.condition.levels.size(), participants = choices.rows.participant.levels.size();
    std::vector<std::vector<CellRows>> rows(conditions, std::vector<CellRows>(participants));
    for (std::size_t row = 0; row < choices.seconds.size(); ++row) {
        if (std::isnan(choices.rows.values[row])) continue;
        CellRows& cell = rows[choices.rows.condition.of[row]][choices.rows.participant.of[row]];
        cell.correct.push_back(choices.rows.values[row]);
        if (!std::isnan(choices.seconds[row])) cell.seconds.push_back(choices.seconds[row]);
    }
    std::vector<stats::ConditionSpeedCells> cells(conditions);
    for (std::size_t c = 0; c < conditions; ++c)
        for (const CellRows& cell : rows[c]) cells[c].push_back(stats::speedCell(cell.correct, cell.seconds));
    return cells;
}

ordered_json differenceJson(const stats::SpeedDifference& difference)
{
    const stats::TTest& test = difference.test;
    if (!test.why.empty()) return degenerate(test.why);
    AnswerFields row;
    row.putCount("n", test.n).put("estimate", test.estimate).put("se", test.se).put("ci", test.ci).put("t", test.t);
    row.put("df", test.df).putProbability("p", test.p, test.logP).put("log_p", test.logP);
    return row.put("p_adjusted", difference.pHolm).json();
}

ordered_json rateJson(const stats::ConditionSpeedCells& cells, const std::vector<stats::Value>& scores, int alternatives)
{
    std::vector<stats::ParticipantChoices> choices;
    for (const stats::SpeedCell& cell : cells) choices.push_back(cell.choices);
    std::vector<double> numbers;
    for (const stats::Value& score : scores)
        if (score.exists()) numbers.push_back(*score);
    const stats::InformationRate rate = stats::informationRate(choices, alternatives);
    const stats::TTest mean = stats::oneSampleTTest(numbers);
    const stats::Value none = stats::Value::undefined(mean.why);
    AnswerFields row;
    row.put("bits_per_second", rate.rate).put("bits_per_second_ci", rate.ci95).put("bis", stats::meanOf(numbers));
    return row.put("bis_ci", mean.why.empty() ? mean.ci : stats::Interval{none, none}).json();
}

constexpr double mostSpeedCells = 2e6;      // conditions x participants: each holds lists and measures, about 300 bytes
constexpr double mostContrastPeople = 1e8;  // contrasts x participants: some seconds

ordered_json speedContrasts(const AnalysisRequest& request)
{
    const int alternatives = alternativesOf(request);
    const TimedChoices choices = timedChoicesOf(request);
    const std::vector<std::string>& names = choices.rows.condition.levels;
    if (names.size() < 2) return degenerate("there is one condition only: nothing to compare");
    const auto pairs = contrastsOf(request.options, names);
    const auto participants = static_cast<double>(choices.rows.participant.levels.size());
    checkSize("conditions x participants", static_cast<double>(names.size()) * participants, mostSpeedCells);
    checkSize("contrasts x participants", static_cast<double>(pairs.size()) * participants, mostContrastPeople);
    const auto cells = speedCellsOf(choices);
    const auto scores = stats::scoresOf(cells);
    const auto tests = stats::speedContrasts(cells, scores, pairs, alternatives);
    ordered_json conditions = ordered_json::object(), contrasts = ordered_json::array();
    for (std::size_t c = 0; c < names.size(); ++c) conditions[names[c]] = rateJson(cells[c], scores[c], alternatives);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        contrasts.push_back({{"a", names[pairs[i].first]},
                             {"b", names[pairs[i].second]},
                             {"bits_per_second", differenceJson(tests[i].bitsPerSecond)},
                             {"bis", differenceJson(tests[i].score)},
                             {"log_seconds", differenceJson(tests[i].logSeconds)}});
    return withAssumption(request, {{"conditions", conditions}, {"contrasts", contrasts}});
}

}  // namespace

std::vector<NamedAnalysis> analysesOfSamples()
{
    return {
        {"describe", describe, "x", "", "mean, SD, quartiles, confidence interval"},
        {"descriptive", describe, "x", "", "another name of describe"},
        {"conditional_accuracy", conditionalAccuracy, "seconds correct", "[bins]", "accuracy from fast to slow choices"},
        {"speed_accuracy", speedAccuracy, "seconds correct", "[alternatives]", "times, bits per choice, bits per second"},
        {"speed_contrasts", speedContrasts, "seconds correct condition participant", "[alternatives] [contrasts]",
         "bits per second, balanced integration score and response time between conditions, over participants"},
        {"bis", balancedIntegration, "pc rt", "", "balanced integration scores of cells"},
    };
}

}  // namespace study::analyse
