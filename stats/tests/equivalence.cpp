#include "stats/tests/equivalence.h"

#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/tests/contrast.h"

namespace stats {
namespace {

void refuse(EquivalenceTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value : {&test.estimate, &test.se, &test.df, &test.tLower, &test.pLower, &test.tUpper, &test.pUpper, &test.p,
                         &test.logP, &test.ci.low, &test.ci.high, &test.tDifference, &test.pDifference, &test.dZ, &test.logPLower,
                         &test.logPUpper, &test.logPDifference})
        if (!value->exists()) *value = Value::undefined(why);
}

std::string optionsFault(const EquivalenceOptions& options)
{
    if (!std::isfinite(options.low) || !std::isfinite(options.high) || !(options.low < options.high))
        return "the bounds must be two numbers, the lower first";
    if (!(options.alpha > 0 && options.alpha < 0.5)) return "alpha must lie between 0 and 0.5";
    return {};
}

}  // namespace

std::string EquivalenceTest::verdict() const
{
    if (!why.empty()) return "undefined: " + why;
    return std::string(different ? "different" : "not different") + (equivalent ? " / equivalent" : " / not shown equivalent");
}

EquivalenceTest equivalenceTest(TKind kind, std::span<const double> x, std::span<const double> y,
                                const EquivalenceOptions& options)
{
    EquivalenceTest test;
    test.n = x.size();
    test.nSecond = kind == TKind::Student || kind == TKind::Welch ? y.size() : 0;
    std::string fault = optionsFault(options);
    if (fault.empty()) fault = inputFault(kind, x, y);
    if (!fault.empty()) {
        refuse(test, fault);
        return test;
    }
    const ScaledSamples scaled({x, secondOf(kind, y)}, {options.low, options.high});
    const Contrast contrast = contrastOf(kind, scaled);
    test.estimate = scaled.unscaled(contrast.estimateMinus(0));
    if (!contrast.why.empty()) {
        refuse(test, contrast.why);
        return test;
    }
    test.se = scaled.unscaled(contrast.se);
    test.df = contrast.df;
    test.tLower = contrast.estimateMinus(scaled.scaled(options.low)) / contrast.se;
    test.tUpper = contrast.estimateMinus(scaled.scaled(options.high)) / contrast.se;
    const TailProbability lower = studentUpper(*test.tLower, contrast.df);
    const TailProbability upper = studentUpper(-*test.tUpper, contrast.df);
    test.pLower = lower.p;
    test.pUpper = upper.p;
    test.logPLower = lower.logP;
    test.logPUpper = upper.logP;
    const TailProbability& larger = lower.logP > upper.logP ? lower : upper;
    test.p = larger.p;
    test.logP = larger.logP;
    const double margin = studentQuantile(options.alpha, contrast.df) * contrast.se;
    test.ci = {scaled.unscaled(contrast.estimateMinus(margin)), scaled.unscaled(contrast.estimateMinus(-margin))};
    test.tDifference = contrast.estimateMinus(0) / contrast.se;
    const TailProbability difference = studentTwoSided(*test.tDifference, contrast.df);
    test.pDifference = difference.p;
    test.logPDifference = difference.logP;
    const bool hasDz = kind == TKind::OneSample || kind == TKind::Paired;
    test.dZ = hasDz ? Value(contrast.estimateMinus(0) / contrast.sd) : Value::undefined("not an effect size of this test");
    test.equivalent = *test.p < options.alpha;
    test.different = *test.pDifference < options.alpha;
    return test;
}

}  // namespace stats
