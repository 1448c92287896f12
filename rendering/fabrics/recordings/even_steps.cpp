#include "rendering/fabrics/recordings/even_steps.h"
#include "protocols/files/number_text.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/errors.h"

namespace rendering::fabrics {

TimeBase timeBaseOf(const std::vector<double>& timeS, const std::string& where)
{
    if (timeS.size() < 2) throw protocols::badInput({"has " + std::to_string(timeS.size()) + " rows", where, "at least 2", ""});
    std::vector<double> steps;
    for (std::size_t i = 1; i < timeS.size(); ++i) {
        steps.push_back(timeS[i] - timeS[i - 1]);
        if (!(steps.back() > 0))
            throw protocols::badInput({"time goes from " + protocols::shortest(timeS[i - 1]) + " s to " + protocols::shortest(timeS[i]) + " s",
                                       where + ", row " + std::to_string(i + 1), "rows in order of time",
                                       "cut or sort the record"});
    }
    const auto [smallest, largest] = std::minmax_element(steps.begin(), steps.end());
    TimeBase base;
    base.smallestS = *smallest;
    base.largestS = *largest;
    const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    base.stepS = *middle;
    base.even = base.smallestS > 0.98 * base.stepS && base.largestS < 1.02 * base.stepS;
    return base;
}

std::vector<double> atEvenSteps(const std::vector<double>& timeS, const std::vector<double>& values, double stepS)
{
    const double duration = timeS.back() - timeS.front();
    const auto count = std::size_t(std::floor(duration / stepS * (1 + 1e-12))) + 1;
    std::vector<double> even;
    even.reserve(count);
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = timeS.front() + double(i) * stepS;
        while (left + 2 < timeS.size() && timeS[left + 1] < time) ++left;
        const double blend = std::clamp((time - timeS[left]) / (timeS[left + 1] - timeS[left]), 0.0, 1.0);
        even.push_back(values[left] + blend * (values[left + 1] - values[left]));
    }
    return even;
}

std::vector<double> meansAtEvenSteps(const std::vector<double>& timeS, const std::vector<double>& values, double stepS)
{
    std::vector<double> even = atEvenSteps(timeS, values, stepS);
    std::size_t next = 0;
    for (std::size_t i = 0; i < even.size(); ++i) {
        const double end = timeS.front() + (double(i) + 0.5) * stepS;
        double sum = 0;
        std::size_t count = 0;
        for (; next < timeS.size() && timeS[next] < end; ++next, ++count) sum += values[next];
        if (count > 0) even[i] = sum / double(count);
    }
    return even;
}

}  // namespace rendering::fabrics
