#include "study/evaluation/summary.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/descriptive.h"
#include "stats/tests/binomial.h"

namespace study::evaluation {

namespace {

std::vector<stats::Value> valuesOf(const std::vector<const Values*>& all, Measure measure)
{
    std::vector<stats::Value> values;
    for (const Values* one : all) values.push_back(at(*one, measure));
    return values;
}

Values averages(const std::vector<const Values*>& all)
{
    Values result;
    for (const MeasureRow& row : measureTable()) at(result, row.measure) = averageOf(row.measure, valuesOf(all, row.measure));
    return result;
}

/// Whether the measure is a share of fabrics or pairs.
bool isShare(Measure measure) { return measure == Measure::FrictionCovered || rowOf(measure).section == Section::Identification; }

}  // namespace

stats::Value averageOf(Measure measure, std::span<const stats::Value> values)
{
    const bool geometric = rowOf(measure).averaging == Averaging::Geometric;
    double sum = 0;
    int count = 0;
    std::string why = "there is no test pair";
    for (const stats::Value& value : values) {
        if (value.exists()) {
            sum += geometric ? std::log(*value) : *value;
            ++count;
        } else if (count == 0) {
            why = value.why();
        }
    }
    if (count == 0) return stats::Value::undefined(why);
    return geometric ? std::exp(sum / count) : sum / count;
}

stats::Interval intervalOf(Measure measure, std::span<const stats::Value> values)
{
    const bool geometric = rowOf(measure).averaging == Averaging::Geometric;
    std::vector<double> numbers;
    for (const stats::Value& value : values)
        if (value.exists()) numbers.push_back(geometric ? std::log(*value) : *value);
    const auto isWhole = [](double number) { return number == 0 || number == 1; };
    if (isShare(measure) && numbers.size() > 1 && std::ranges::all_of(numbers, isWhole))
        return stats::wilsonInterval(std::ranges::count(numbers, 1.0), std::ssize(numbers));
    stats::Interval interval = stats::describe(numbers).ci95;
    if (!interval.low.exists()) return interval;
    if (geometric) return {std::exp(*interval.low), std::exp(*interval.high)};
    if (isShare(measure)) return {std::max(0.0, *interval.low), std::min(1.0, *interval.high)};
    return interval;
}

PredictorResult summarise(const Predictor& predictor, const TestPlan& plan, const std::vector<Values>& ofPairs)
{
    PredictorResult result{predictor, {}, {}, {}, {}, {}};
    for (std::size_t fabric = 0; fabric < plan.fabrics.size(); ++fabric) {
        std::vector<const Values*> own;
        for (std::size_t i = 0; i < plan.pairs.size(); ++i)
            if (plan.pairs[i].fabric == fabric) own.push_back(&ofPairs[i]);
        if (!own.empty()) result.fabrics.push_back({plan.fabrics[fabric].fabric, static_cast<int>(own.size()), averages(own)});
    }
    std::vector<const Values*> all;
    for (const FabricValues& fabric : result.fabrics) all.push_back(&fabric.values);
    result.mean = averages(all);
    for (const MeasureRow& row : measureTable())
        result.ci95[static_cast<std::size_t>(row.measure)] = intervalOf(row.measure, valuesOf(all, row.measure));
    return result;
}

MeanComparison compareMeans(const PredictorResult& predictor, const PredictorResult& measured, Measure measure, double fraction)
{
    std::vector<double> generated, truth;
    std::string why = "there is no fabric to compare";
    double sum = 0;
    for (std::size_t i = 0; i < measured.fabrics.size(); ++i) {
        const stats::Value &predictedMean = at(predictor.fabrics[i].values, measure),
                           &measuredMean = at(measured.fabrics[i].values, measure);
        if (!predictedMean.exists() || !measuredMean.exists()) {
            why = predictedMean.exists() ? measuredMean.why() : predictedMean.why();
            continue;
        }
        generated.push_back(*predictedMean);
        truth.push_back(*measuredMean);
        sum += *measuredMean;
    }
    MeanComparison result;
    if (truth.empty()) {
        result.equivalence.why = why;
        result.equivalence.p = result.equivalence.pDifference = result.equivalence.estimate = stats::Value::undefined(why);
        return result;
    }
    result.bound = fraction * sum / static_cast<double>(truth.size());
    result.equivalence = stats::equivalenceTest(stats::TKind::Paired, generated, truth, {-result.bound, result.bound, 0.05});
    return result;
}

}  // namespace study::evaluation
