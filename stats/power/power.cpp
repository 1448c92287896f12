#include "stats/power/power.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stats/kernels/distributions.h"
#include "stats/kernels/noncentral.h"

namespace stats {
namespace {

/// Density of s / sigma, where s^2 is a variance estimate with `df` degrees of freedom.
class DensityOfSd {
public:
    explicit DensityOfSd(double df) : m_df(df), m_logScale((df / 2) * std::log(df / 2) + std::numbers::ln2 - std::lgamma(df / 2))
    {
    }
    double at(double ratio) const
    {
        return ratio > 0 ? std::exp(m_logScale + (m_df - 1) * std::log(ratio) - m_df * ratio * ratio / 2) : 0.0;
    }

private:
    double m_df, m_logScale;
};

/// Integral from 0 to `end` by Simpson's rule.
template <typename Function>
double integral(Function function, double end)
{
    constexpr int panels = 4000;
    const double step = end / panels;
    double sum = function(0.0) + function(end);
    for (int i = 1; i < panels; ++i) sum += (i % 2 == 0 ? 2 : 4) * function(i * step);
    return sum * step / 3;
}

double twoSidedPower(double df, double noncentrality, double alpha)
{
    const double critical = studentQuantile(alpha / 2, df);
    return std::min(1.0,
                    noncentralStudentUpper(critical, df, noncentrality) + noncentralStudentUpper(critical, df, -noncentrality));
}

/// Satterthwaite's degrees of freedom of a condition's mean in balanced data, whose error is a sum of three mean
/// squares: participant x condition + fabric x condition - residual.
double degreesOfMean(const StudyDesign& design, const RatingTruth& truth)
{
    const auto p = static_cast<double>(design.participants);
    const auto f = static_cast<double>(design.fabrics);
    const auto k = static_cast<double>(design.conditions);
    const double first = truth.residual + f * truth.participantCondition;
    const double second = truth.residual + p * truth.fabricCondition;
    const double third = truth.residual;
    const double error = first + second - third;
    return error * error /
           (first * first / ((p - 1) * (k - 1)) + second * second / ((f - 1) * (k - 1)) +
            third * third / (k * (p - 1) * (f - 1)));
}

}  // namespace

double tTestPower(double n, double effect, double alpha) { return twoSidedPower(n - 1, effect * std::sqrt(n), alpha); }

double equivalencePower(const EquivalencePlan& plan, double trueDifference)
{
    const double df = plan.n - 1;
    const double t = studentQuantile(plan.alpha, df);
    const double se = plan.sd / std::sqrt(plan.n);  // the true standard error; the observed one is ratio times it
    const double widest = (plan.high - plan.low) / (2 * t * se);
    const double mostRatio = 1 + 12 / std::sqrt(2 * df);  // beyond, the probability is below 1e-20
    const DensityOfSd density(df);
    const auto inside = [&](double ratio) {
        const double low = (plan.low - trueDifference) / se + t * ratio;
        const double high = (plan.high - trueDifference) / se - t * ratio;
        return low < high ? (normalLower(high) - normalLower(low)) * density.at(ratio) : 0.0;
    };
    return std::clamp(integral(inside, std::min(widest, mostRatio)), 0.0, 1.0);
}

long long BinomialPlan::critical() const
{
    const auto atLeast = [&](long long k) {
        return k <= 0 ? 1 : betaLower(static_cast<double>(k), static_cast<double>(trials - k + 1), chance);
    };
    long long count = 0;
    while (count <= trials && atLeast(count) > alpha) ++count;
    return count;
}

double BinomialPlan::size() const { return binomialPower(*this, chance); }

double binomialPower(const BinomialPlan& plan, double probability)
{
    const long long critical = plan.critical();
    if (critical > plan.trials || probability <= 0) return 0;
    if (probability >= 1) return 1;
    return betaLower(static_cast<double>(critical), static_cast<double>(plan.trials - critical + 1), probability);
}

double repeatedMeasuresPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha)
{
    const auto n = static_cast<double>(design.participants);
    const auto k = static_cast<double>(design.conditions);
    const double error = truth.participantCondition + truth.residual / static_cast<double>(design.fabrics);
    const double df2 = (n - 1) * (k - 1);
    return noncentralFisherUpper(fisherQuantile(alpha, k - 1, df2), k - 1, df2, n * spread / error);
}

double friedmanPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha)
{
    const auto n = static_cast<double>(design.participants);
    const auto k = static_cast<double>(design.conditions);
    const double error = truth.participantCondition + truth.residual / static_cast<double>(design.fabrics);
    const double efficiency = 3 * k / (std::numbers::pi * (k + 1));
    return noncentralChiSquaredUpper(chiSquaredQuantile(alpha, k - 1), k - 1, efficiency * n * spread / error);
}

double ratingModelPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha)
{
    const double df1 = static_cast<double>(design.conditions) - 1;
    const double df2 = degreesOfMean(design, truth);
    return noncentralFisherUpper(fisherQuantile(alpha, df1, df2), df1, df2, spread / truth.varianceOfMean(design));
}

double ratingDifferencePower(const StudyDesign& design, const RatingTruth& truth, double difference, double alpha)
{
    const double df = degreesOfMean(design, truth);
    return twoSidedPower(df, difference / std::sqrt(2 * truth.varianceOfMean(design)), alpha);
}

double choiceModelPower(const StudyDesign& design, double probability, double spread, double alpha)
{
    const auto k = static_cast<double>(design.conditions);
    const double information = static_cast<double>(design.participants * design.fabrics) * probability * (1 - probability);
    return noncentralChiSquaredUpper(chiSquaredQuantile(alpha, k - 1), k - 1, information * spread);
}

std::vector<double> evenlySpaced(std::size_t conditions, double range)
{
    std::vector<double> means(conditions);
    for (std::size_t c = 0; c < conditions && conditions > 1; ++c)
        means[c] = range * (static_cast<double>(c) / static_cast<double>(conditions - 1) - 0.5);
    return means;
}

double sumOfSquares(std::span<const double> deviations)
{
    double sum = 0;
    for (const double x : deviations) sum += x * x;
    return sum;
}

Value smallestDetectable(const std::function<double(double)>& power, double most, double wanted)
{
    if (!(power(most) >= wanted)) return Value::undefined("no effect up to " + std::to_string(most) + " is detected that surely");
    double below = 0;
    double above = most;
    while (above - below > 1e-9 * most) {
        const double middle = (below + above) / 2;
        (power(middle) >= wanted ? above : below) = middle;
    }
    return above;
}

Value participantsNeeded(const std::function<double(double)>& power, std::size_t most, double wanted)
{
    for (std::size_t n = 2; n <= most; ++n)
        if (power(static_cast<double>(n)) >= wanted) return static_cast<double>(n);
    return Value::undefined("more than " + std::to_string(most));
}

}  // namespace stats
