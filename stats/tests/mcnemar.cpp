#include "stats/tests/mcnemar.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "stats/kernels/distributions.h"
#include "stats/tests/binomial.h"

namespace stats {
namespace {

void refuse(McNemarTest& test, const std::string& why)
{
    for (Value* value : {&test.pExact, &test.logPExact, &test.pMid, &test.logPMid, &test.chiSquared, &test.pChiSquared,
                         &test.chiSquaredCorrected, &test.pChiSquaredCorrected})
        *value = Value::undefined(why);
}

}  // namespace

McNemarTest mcnemarTest(long long b, long long c)
{
    McNemarTest test;
    test.b = b;
    test.c = c;
    if (b < 0 || c < 0) {
        test.why = "a count cannot be negative";
        refuse(test, test.why);
        return test;
    }
    if (b + c == 0) {
        refuse(test, "no pair changed");
        test.pExact = 1.0;
        test.logPExact = 0.0;
        return test;
    }
    const BinomialTest larger = binomialTest(std::max(b, c), b + c, 0.5);
    test.pExact = std::min(1.0, 2 * *larger.pGreater);
    test.logPExact = std::min(0.0, *larger.logPGreater + std::numbers::ln2);
    test.pMid = std::min(1.0, 2 * *larger.pMidGreater);
    test.logPMid = std::min(0.0, *larger.logPMidGreater + std::numbers::ln2);
    const auto n = static_cast<double>(b + c);
    const auto distance = static_cast<double>(std::llabs(b - c));
    const double corrected = std::max(0.0, distance - 1);
    test.chiSquared = distance * distance / n;
    test.pChiSquared = chiSquaredUpper(*test.chiSquared, 1).p;
    test.chiSquaredCorrected = corrected * corrected / n;
    test.pChiSquaredCorrected = chiSquaredUpper(*test.chiSquaredCorrected, 1).p;
    return test;
}

}  // namespace stats
