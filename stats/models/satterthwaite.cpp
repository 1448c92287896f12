#include "stats/models/satterthwaite.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "stats/kernels/distributions.h"
#include "stats/models/mixed_model.h"

namespace stats {
namespace {

/// a' matrix a; a has few weights that differ from 0.
double sparseForm(const std::vector<std::size_t>& places, std::span<const double> a, const Matrix& matrix)
{
    double sum = 0;
    for (const std::size_t i : places) {
        double row = 0;
        for (const std::size_t j : places) row += matrix(i, j) * a[j];
        sum += a[i] * row;
    }
    return sum;
}

std::vector<std::size_t> placesOf(std::span<const double> weights)
{
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] != 0) places.push_back(i);
    return places;
}

/// Satterthwaite's 2 v^2 / var(v), where v is the variance of the contrast and var(v) comes from the delta method.
double degreesOf(const MixedModel& model, std::span<const double> weights, double variance)
{
    std::vector<double> gradient;
    const std::vector<std::size_t> places = placesOf(weights);
    for (const Matrix& derivative : model.covarianceDerivatives) gradient.push_back(sparseForm(places, weights, derivative));
    return 2 * variance * variance / quadraticForm(gradient, model.parameterCovariance, gradient);
}

ContrastTest undefinedContrast(const std::string& why)
{
    const Value none = Value::undefined(why);
    return {none, none, none, none, none, none, {none, none}};
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
    const double variance = sparseForm(placesOf(weights), weights, model.covariance);
    if (!(variance > 0)) return undefinedContrast("the contrast has no weight that differs from 0");
    const double estimate = dot(weights, model.estimates);
    const double se = std::sqrt(variance);
    const double df = degreesOf(model, weights, variance);
    const TailProbability p = studentTwoSided(estimate / se, df);
    const double reach = studentQuantile((1 - confidence) / 2, df) * se;
    const auto unscaled = [&](double x) { return std::ldexp(x, model.exponent); };
    return {unscaled(estimate),
            unscaled(se),
            df,
            estimate / se,
            p.p,
            p.logP,
            {unscaled(estimate - reach), unscaled(estimate + reach)}};
}

ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence)
{
    std::vector<double> weights(model.estimates.size());
    if (model.why.empty() && a != 0) weights[a] += 1;
    if (model.why.empty() && b != 0) weights[b] -= 1;
    return contrastTest(model, weights, confidence);
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
        degrees.push_back(degreesOf(model, weights, eigen.values[k]));
    }
    const auto df1 = static_cast<double>(n);
    const double df2 = denominatorDegrees(degrees);
    const TailProbability tail = fisherUpper(squares / df1, df1, df2);
    return {"", squares / df1, df1, df2, tail.p, tail.logP};
}

}  // namespace stats
