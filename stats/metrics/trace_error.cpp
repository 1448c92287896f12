#include "stats/metrics/trace_error.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

std::string faultOf(std::span<const double> generated, std::span<const double> truth)
{
    if (generated.size() != truth.size())
        return "the traces differ in length: " + std::to_string(generated.size()) + " and " + std::to_string(truth.size());
    if (generated.empty()) return "the traces are empty";
    if (std::string fault = nonFiniteFault(generated, "the generated trace"); !fault.empty()) return fault;
    return nonFiniteFault(truth, "the true trace");
}

}  // namespace

TraceError traceError(std::span<const double> generated, std::span<const double> truth)
{
    TraceError error;
    error.n = truth.size();
    error.why = faultOf(generated, truth);
    if (!error.why.empty()) {
        for (Value* value : {&error.mae, &error.meanTruth, &error.maeOverMean, &error.rmse, &error.bias, &error.maxAbs})
            *value = Value::undefined(error.why);
        return error;
    }
    const ScaledSamples scaled({generated, truth});
    const auto g = scaled.sample(0);
    const auto t = scaled.sample(1);
    const auto n = static_cast<double>(t.size());
    ExactSum sum;
    for (std::size_t i = 0; i < t.size(); ++i) sum.add(g[i] - t[i]);
    const double mae = exactSum(t.size(), [&](std::size_t i) { return std::fabs(g[i] - t[i]); }) / n;
    const double squares = exactSum(t.size(), [&](std::size_t i) { return (g[i] - t[i]) * (g[i] - t[i]); });
    const double mean = exactSum(t.size(), [&](std::size_t i) { return t[i]; }) / n;
    double largest = 0;
    for (std::size_t i = 0; i < t.size(); ++i) largest = std::max(largest, std::fabs(g[i] - t[i]));
    error.mae = scaled.unscaled(mae);
    error.meanTruth = scaled.unscaled(mean);
    error.maeOverMean = mean > 0 ? Value(mae / mean) : Value::undefined("the mean of the truth is not positive");
    error.rmse = scaled.unscaled(std::sqrt(squares / n));
    error.bias = scaled.unscaled(sum.total() / n);
    error.maxAbs = scaled.unscaled(largest);
    return error;
}

}  // namespace stats
