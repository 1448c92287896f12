#include "stats/tests/forced_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace stats {
namespace {

double density(double x) { return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi); }

double below(double x) { return std::erfc(-x / std::numbers::sqrt2) / 2; }

// The integrands are analytic and decrease as exp(-x^2/2). The trapezoidal rule with this step is therefore exact
// up to rounding. The d' that is searched lies between 0 and the reach.
constexpr double impressionStep = 0.125;
constexpr double impressionReach = 40;

template <typename Integrand>
double integral(double from, double to, Integrand integrand)
{
    double sum = 0;
    const auto points = static_cast<int>((to - from) / impressionStep);
    for (int i = 0; i <= points; ++i) sum += integrand(from + i * impressionStep);
    return sum * impressionStep;
}

/// d/dd' of the probability: (m - 1) times the integral of phi(x - d') phi(x) Phi(x)^(m - 2).
double slopeAt(double dPrime, int alternatives)
{
    const double m = alternatives;
    return (m - 1) * integral(std::min(0.0, dPrime) - 10, std::max(0.0, dPrime) + 10,
                              [&](double x) { return density(x - dPrime) * density(x) * std::pow(below(x), m - 2); });
}

/// The d' at which a wrong choice has this probability, 0 < wrong < 1 - 1/m, by bisection. The probability of a
/// wrong choice keeps its digits where that of a correct choice rounds to 1.
double dPrimeOf(double wrong, int alternatives)
{
    const auto wrongAt = [&](double dPrime) {
        return integral(dPrime - impressionReach / 4, dPrime + impressionReach / 4,
                        [&](double x) { return density(x - dPrime) * -std::expm1((alternatives - 1) * std::log1p(-below(-x))); });
    };
    double low = 0;
    double high = impressionReach;
    for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
        const double middle = (low + high) / 2;
        (wrongAt(middle) > wrong ? low : high) = middle;
    }
    return (low + high) / 2;
}

ChoiceSensitivity undefinedSensitivity(const std::string& why)
{
    ChoiceSensitivity result;
    result.why = why;
    result.proportionCorrect = result.discriminators = result.dPrime = result.seDPrime = Value::undefined(why);
    return result;
}

std::string faultOf(long long correct, long long trials, int alternatives)
{
    if (alternatives < 2) return "a choice needs at least 2 alternatives";
    if (trials <= 0) return "there are no trials";
    if (correct < 0) return "a count cannot be negative";
    if (correct > trials) return "more correct choices than trials";
    return {};
}

}  // namespace

Value dPrimeAt(double proportion, int alternatives)
{
    if (alternatives < 2) return Value::undefined("a choice needs at least 2 alternatives");
    if (!(proportion >= 0 && proportion <= 1)) return Value::undefined("a proportion lies between 0 and 1");
    if (proportion == 1) return std::numeric_limits<double>::infinity();
    return proportion * alternatives <= 1 ? 0.0 : dPrimeOf(1 - proportion, alternatives);
}

ChoiceSensitivity forcedChoice(long long correct, long long trials, int alternatives)
{
    if (const std::string fault = faultOf(correct, trials, alternatives); !fault.empty()) return undefinedSensitivity(fault);
    ChoiceSensitivity result;
    const double m = alternatives;
    const auto n = static_cast<double>(trials);
    const double right = static_cast<double>(correct) / n;
    const double wrong = static_cast<double>(trials - correct) / n;
    result.proportionCorrect = right;
    // Chance is decided in whole numbers, because no double is 1/3: 23 of 69 are at chance.
    const long long excess = correct * alternatives - trials;
    result.discriminators = excess <= 0 ? 0.0 : static_cast<double>(excess) / (n * (m - 1));
    if (correct == trials) {
        result.dPrime = std::numeric_limits<double>::infinity();
        result.seDPrime = Value::undefined("every choice was correct: d' has no upper bound");
        return result;
    }
    result.dPrime = excess <= 0 ? 0.0 : dPrimeOf(wrong, alternatives);
    result.seDPrime = excess < 0 ? Value::undefined("below chance d' is set to 0")
                                 : Value(std::sqrt(right * wrong / n) / slopeAt(*result.dPrime, alternatives));
    return result;
}

}  // namespace stats
