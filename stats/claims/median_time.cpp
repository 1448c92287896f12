#include "stats/claims/median_time.h"

#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/tests/speed_accuracy.h"
#include "stats/tests/t_tests.h"

namespace stats {
namespace {

Interval withoutMedianInterval(const std::string& why) { return {Value::undefined(why), Value::undefined(why)}; }

}  // namespace

Interval medianTimeCi95(std::span<const std::vector<double>> seconds)
{
    std::vector<double> all, logMedians;
    for (const std::vector<double>& own : seconds) {
        if (own.empty()) continue;
        all.insert(all.end(), own.begin(), own.end());
        const Value median = responseTimes(own).median;
        if (!median.exists() || !(*median > 0)) return withoutMedianInterval("a median response time is not positive");
        logMedians.push_back(std::log(*median));
    }
    if (all.empty()) return withoutMedianInterval("there are no response times");
    const TTest test = oneSampleTTest(logMedians);
    if (!test.why.empty()) return withoutMedianInterval(test.why);
    const double middle = std::log(*responseTimes(all).median);
    const double reach = studentQuantile(0.025, *test.df) * *test.se;
    return {std::exp(middle - reach), std::exp(middle + reach)};
}

}  // namespace stats
