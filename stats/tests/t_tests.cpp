#include "stats/tests/t_tests.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "stats/kernels/distributions.h"
#include "stats/tests/contrast.h"

namespace stats {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void refuse(TTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value : {&test.t, &test.df, &test.p, &test.logP, &test.ci.low, &test.ci.high, &test.dZ, &test.hedgesGz,
                         &test.dAvLakens, &test.dAvRms, &test.dS, &test.hedgesGs})
        *value = Value::undefined(why);
    for (Value* value : {&test.estimate, &test.sd, &test.se})
        if (!value->exists()) *value = Value::undefined(why);
}

TailProbability tailOf(double t, double df, Tail tail)
{
    switch (tail) {
        case Tail::TwoSided:
            return studentTwoSided(t, df);
        case Tail::Less:
            return studentUpper(-t, df);
        case Tail::Greater:
            return studentUpper(t, df);
    }
    return {};
}

Interval intervalOf(const Contrast& contrast, const ScaledSamples& scaled, const TOptions& options)
{
    const double outside = 1 - options.confidence;
    const double quantile = studentQuantile(options.tail == Tail::TwoSided ? outside / 2 : outside, contrast.df);
    const double margin = quantile * contrast.se;
    Interval interval{scaled.unscaled(contrast.estimateMinus(margin)), scaled.unscaled(contrast.estimateMinus(-margin))};
    if (options.tail == Tail::Less) interval.low = -infinity;
    if (options.tail == Tail::Greater) interval.high = infinity;
    return interval;
}

Value corrected(const Value& d, double df)
{
    if (df < 2) return Value::undefined("Hedges' correction needs at least 2 degrees of freedom");
    return *d * hedgesCorrection(df);
}

void setPairedEffects(TTest& test, const Contrast& contrast)
{
    const double difference = contrast.estimateMinus(0);
    const double mean = (contrast.sdX + contrast.sdY) / 2;
    const double rms = std::sqrt((contrast.sdX * contrast.sdX + contrast.sdY * contrast.sdY) / 2);
    test.dAvLakens = mean > 0 ? Value(difference / mean) : Value::undefined("neither sample varies");
    test.dAvRms = rms > 0 ? Value(difference / rms) : Value::undefined("neither sample varies");
}

void setEffects(TTest& test, TKind kind, const Contrast& contrast, double scaledMu)
{
    const std::string other = "not an effect size of this test";
    for (Value* value : {&test.dZ, &test.hedgesGz, &test.dAvLakens, &test.dAvRms, &test.dS, &test.hedgesGs})
        *value = Value::undefined(other);
    if (kind == TKind::OneSample || kind == TKind::Paired) {
        test.dZ = contrast.estimateMinus(scaledMu) / contrast.sd;
        test.hedgesGz = corrected(test.dZ, contrast.df);
    }
    if (kind == TKind::Paired) setPairedEffects(test, contrast);
    if (kind == TKind::Student) {
        test.dS = contrast.estimateMinus(0) / contrast.sd;
        test.hedgesGs = corrected(test.dS, contrast.df);
    }
    if (kind == TKind::Welch)
        test.dAvRms = contrast.estimateMinus(0) / std::sqrt((contrast.first.variance() + contrast.second.variance()) / 2);
}

}  // namespace

Value TTest::log10P() const { return logP.exists() ? Value(*logP / std::numbers::ln10) : logP; }

TTest tTest(TKind kind, std::span<const double> x, std::span<const double> y, const TOptions& options)
{
    TTest test;
    test.n = x.size();
    test.nSecond = kind == TKind::Student || kind == TKind::Welch ? y.size() : 0;
    if (const std::string fault = inputFault(kind, x, y); !fault.empty()) {
        refuse(test, fault);
        return test;
    }
    const ScaledSamples scaled({x, secondOf(kind, y)}, {options.mu});
    const double mu = scaled.scaled(options.mu);
    const Contrast contrast = contrastOf(kind, scaled);
    test.estimate = scaled.unscaled(contrast.estimateMinus(0));
    if (contrast.hasSpread) {
        test.sd = kind == TKind::Welch ? Value::undefined("Welch's test pools no SD") : scaled.unscaled(contrast.sd);
        test.se = scaled.unscaled(contrast.se);
    }
    if (!contrast.why.empty()) {
        refuse(test, contrast.why);
        return test;
    }
    test.t = contrast.estimateMinus(mu) / contrast.se;
    test.df = contrast.df;
    const TailProbability tail = tailOf(*test.t, contrast.df, options.tail);
    test.p = tail.p;
    test.logP = tail.logP;
    test.ci = intervalOf(contrast, scaled, options);
    setEffects(test, kind, contrast, mu);
    return test;
}

TTest oneSampleTTest(std::span<const double> x, const TOptions& options) { return tTest(TKind::OneSample, x, {}, options); }

TTest pairedTTest(std::span<const double> x, std::span<const double> y, const TOptions& options)
{
    return tTest(TKind::Paired, x, y, options);
}

TTest studentTTest(std::span<const double> x, std::span<const double> y, const TOptions& options)
{
    return tTest(TKind::Student, x, y, options);
}

TTest welchTTest(std::span<const double> x, std::span<const double> y, const TOptions& options)
{
    return tTest(TKind::Welch, x, y, options);
}

}  // namespace stats
