#include "study/analyse/analyse_samples.h"

#include <algorithm>
#include <nlohmann/json.hpp>

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

ordered_json speedAccuracy(const AnalysisRequest& request)
{
    const auto seconds = numbersAt(request.inputs, "seconds");
    const auto correct = correctOf(request);
    const long long alternatives = wholeOr(request.options, "alternatives", 3);
    if (alternatives < 2 || alternatives > 1000000) throw RequestFault("alternatives must lie between 2 and 1000000");
    if (seconds.size() != correct.size()) throw RequestFault("seconds and correct differ in length");
    const auto times = stats::responseTimes(seconds);
    if (!times.median.exists()) return degenerate(times.median.why());
    const auto right = std::count(correct.begin(), correct.end(), true);
    const double share = static_cast<double>(right) / static_cast<double>(correct.size());
    const int m = static_cast<int>(alternatives);
    AnswerFields answer;
    answer.putCount("n", times.n).put("median_seconds", times.median).put("log_mean_seconds", times.logMean);
    answer.put("geometric_mean_seconds", times.geometricMean).put("mean_seconds", times.mean).put("proportion", share);
    return answer.put("bits", stats::bitsPerChoice(share, m))
        .put("bits_per_second", stats::bitsPerSecond(share, m, *times.mean))
        .json();
}

ordered_json balancedIntegration(const AnalysisRequest& request)
{
    const auto scores = stats::balancedIntegrationScores(numbersAt(request.inputs, "pc"), numbersAt(request.inputs, "rt"));
    if (scores.empty()) return degenerate("there are no cells");
    if (!scores.front().exists()) return degenerate(scores.front().why());
    return AnswerFields().put("bis", scores).json();
}

}  // namespace

std::vector<NamedAnalysis> analysesOfSamples()
{
    return {
        {"describe", describe, "x", "", "mean, SD, quartiles, confidence interval"},
        {"descriptive", describe, "x", "", "another name of describe"},
        {"conditional_accuracy", conditionalAccuracy, "seconds correct", "[bins]", "accuracy from fast to slow choices"},
        {"speed_accuracy", speedAccuracy, "seconds correct", "[alternatives]", "times, bits per choice, bits per second"},
        {"bis", balancedIntegration, "pc rt", "", "balanced integration scores of cells"},
    };
}

}  // namespace study::analyse
