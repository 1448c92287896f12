#include "stats/models/satterthwaite.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/models/mixed_model.h"

namespace stats {
namespace {

/// The weights of a contrast that differ from 0.
struct Weights {
    std::vector<std::size_t> places;
    std::vector<double> values;
};

Weights nonzeroOf(std::span<const double> weights)
{
    Weights result;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (weights[i] == 0) continue;
        result.places.push_back(i);
        result.values.push_back(weights[i]);
    }
    return result;
}

/// a' matrix a
double formOf(const Weights& a, const Matrix& matrix)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.places.size(); ++i) {
        double row = 0;
        for (std::size_t j = 0; j < a.places.size(); ++j) row += matrix(a.places[i], a.places[j]) * a.values[j];
        sum += a.values[i] * row;
    }
    return sum;
}

/// Satterthwaite's 2 v^2 / var(v), where v is the variance of the contrast and var(v) comes from the delta method.
double degreesOf(const MixedModel& model, const Weights& weights, double variance)
{
    std::vector<double> gradient;
    for (const Matrix& derivative : model.covarianceDerivatives) gradient.push_back(formOf(weights, derivative));
    return 2 * variance * variance / quadraticForm(gradient, model.parameterCovariance, gradient);
}

ContrastTest undefinedContrast(const std::string& why)
{
    const Value none = Value::undefined(why);
    return {none, none, none, none, none, none, {none, none}};
}

ContrastTest testOf(const MixedModel& model, const Weights& weights, double confidence, StudentQuantiles& quantiles)
{
    const double variance = formOf(weights, model.covariance);
    if (!(variance > 0)) return undefinedContrast("the contrast has no weight that differs from 0");
    double estimate = 0;
    for (std::size_t i = 0; i < weights.places.size(); ++i) estimate += weights.values[i] * model.estimates[weights.places[i]];
    const double se = std::sqrt(variance);
    const double df = degreesOf(model, weights, variance);
    const TailProbability p = studentTwoSided(estimate / se, df);
    const double reach = quantiles.at((1 - confidence) / 2, df) * se;
    const auto unscaled = [&](double x) { return std::ldexp(x, model.exponent); };
    return {unscaled(estimate),
            unscaled(se),
            df,
            estimate / se,
            p.p,
            p.logP,
            {unscaled(estimate - reach), unscaled(estimate + reach)}};
}

/// Denominator degrees of freedom of an F that is the mean of squared t variables with these degrees of freedom.
double denominatorDegrees(std::span<const double> degrees)
{
    const auto [least, most] = std::minmax_element(degrees.begin(), degrees.end());
    if (*most - *least < 1e-8) return *least;
    if (*least <= 2) return 2;
    double expectation = 0;
    for (const double df : degrees) expectation += df / (df - 2);
    return 2 * expectation / (expectation - static_cast<double>(degrees.size()));
}

FTest undefinedF(const std::string& why)
{
    const Value none = Value::undefined(why);
    return {why, none, none, none, none, none};
}

}  // namespace

ContrastTest contrastTest(const MixedModel& model, std::span<const double> weights, double confidence)
{
    if (!model.why.empty()) return undefinedContrast(model.why);
    assert(weights.size() == model.estimates.size() && "one weight a fixed effect");
    StudentQuantiles quantiles;
    return testOf(model, nonzeroOf(weights), confidence, quantiles);
}

ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence)
{
    StudentQuantiles quantiles;
    return levelDifference(model, a, b, confidence, quantiles);
}

ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence,
                             StudentQuantiles& quantiles)
{
    if (!model.why.empty()) return undefinedContrast(model.why);
    assert(a < model.estimates.size() && b < model.estimates.size() && "levels of the factor");
    Weights weights;
    const auto add = [&](std::size_t level, double weight) {
        if (level == 0 || a == b) return;
        weights.places.push_back(level);
        weights.values.push_back(weight);
    };
    add(std::min(a, b), a < b ? 1 : -1);
    add(std::max(a, b), a < b ? -1 : 1);
    return testOf(model, weights, confidence, quantiles);
}

FTest effectTest(const MixedModel& model)
{
    if (!model.why.empty()) return undefinedF(model.why);
    const std::size_t p = model.estimates.size();
    if (p < 2) return undefinedF("there is one level only");
    const std::size_t n = p - 1;
    const Matrix& contrasts = model.sequential;
    Matrix covariance(n, n);
    for (std::size_t j = 0; j < n; ++j) {
        const std::vector<double> half = product(model.covariance, contrasts.row(j + 1));
        for (std::size_t i = 0; i < n; ++i) covariance(i, j) = dot(contrasts.row(i + 1), half);
    }
    const Eigen eigen = eigenOf(covariance);
    std::vector<double> degrees;
    double squares = 0;
    for (std::size_t k = 0; k < n; ++k) {
        std::vector<double> weights(p);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < p; ++j) weights[j] += eigen.vectors(k, i) * contrasts(i + 1, j);
        const double estimate = dot(weights, model.estimates);
        squares += estimate * estimate / eigen.values[k];
        degrees.push_back(degreesOf(model, nonzeroOf(weights), eigen.values[k]));
    }
    const auto df1 = static_cast<double>(n);
    const double df2 = denominatorDegrees(degrees);
    const TailProbability tail = fisherUpper(squares / df1, df1, df2);
    return {"", squares / df1, df1, df2, tail.p, tail.logP};
}

}  // namespace stats
