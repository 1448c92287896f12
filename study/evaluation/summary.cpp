#include "study/evaluation/summary.h"

#include <cmath>

namespace study::evaluation {

namespace {

Values averages(const std::vector<const Values*>& all)
{
    Values result;
    for (const MeasureRow& row : measureTable()) {
        std::vector<stats::Value> values;
        for (const Values* one : all) values.push_back(at(*one, row.measure));
        at(result, row.measure) = averageOf(row.measure, values);
    }
    return result;
}

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

PredictorResult summarise(const Predictor& predictor, const TestPlan& plan, const std::vector<Values>& ofPairs)
{
    PredictorResult result{predictor, {}, {}, {}, {}};
    for (std::size_t fabric = 0; fabric < plan.fabrics.size(); ++fabric) {
        std::vector<const Values*> own;
        for (std::size_t i = 0; i < plan.pairs.size(); ++i)
            if (plan.pairs[i].fabric == fabric) own.push_back(&ofPairs[i]);
        if (!own.empty()) result.fabrics.push_back({plan.fabrics[fabric].fabric, static_cast<int>(own.size()), averages(own)});
    }
    std::vector<const Values*> all;
    for (const FabricValues& fabric : result.fabrics) all.push_back(&fabric.values);
    result.mean = averages(all);
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
