#include "stats/models/mixed_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "stats/models/mixed_model_fit.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

/// Which random terms have a variance, and the fit of the model with these.
struct Fitted {
    std::vector<std::size_t> kept;
    std::optional<MixedModelEquations> equations;
    ThetaFit fit;
};

bool isZero(const TermPlace& term, const ThetaFit& fit) { return term.components == 1 && !fit.free[term.firstTheta]; }

/// Fits, leaves out the intercepts whose variance is zero, and fits again without them.
Fitted fitWithoutZeros(const MixedModelRows& data, bool reml)
{
    Fitted result;
    for (std::size_t t = 0; t < data.random.size(); ++t) result.kept.push_back(t);
    while (true) {
        std::vector<RandomTerm> terms;
        for (const std::size_t t : result.kept) terms.push_back(data.random[t]);
        result.equations.emplace(data.y, data.fixed, terms);
        result.fit = fitTheta(*result.equations, reml);
        if (!result.fit.why.empty()) return result;
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < result.kept.size(); ++i)
            if (!isZero(result.equations->terms()[i], result.fit)) kept.push_back(result.kept[i]);
        if (kept.size() == result.kept.size()) return result;
        result.kept = std::move(kept);
    }
}

/// Hessian of -2 log likelihood in (free thetas, sigma^2), not profiled, inverted: twice that is the
/// covariance of these parameters. `rows`: the jacobian's rows of the free thetas.
Matrix parameterCovariance(const Fitted& fitted, bool reml, double variance, const std::vector<std::size_t>& rows)
{
    const auto& d = fitted.fit.derivatives;
    const auto& theta = fitted.fit.factorised.theta;
    const std::size_t n = theta.size();
    std::vector<double> gradient(n);
    Matrix hessian(n, n);
    for (std::size_t k = 0; k < n; ++k) {
        gradient[k] = d.traces[k] - d.forms[k] / variance;
        for (std::size_t l = 0; l < n; ++l) hessian(k, l) = -d.traceProducts(k, l) + 2 * d.formProducts(k, l) / variance;
    }
    const Matrix inTheta = thetaHessian(*fitted.equations, theta, gradient, hessian);
    const auto cross = product(thetaJacobian(*fitted.equations, theta), d.forms);
    const std::size_t m = rows.size();
    Matrix whole(m + 1, m + 1);
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < m; ++j) whole(i, j) = inTheta(rows[i], rows[j]);
        whole(i, m) = whole(m, i) = cross[rows[i]] / (variance * variance);
    }
    whole(m, m) = residualDegrees(*fitted.equations, reml) / (variance * variance);
    const Eigen eigen = eigenOf(whole);
    const double largest = *std::max_element(eigen.values.begin(), eigen.values.end());
    Matrix inverse(m + 1, m + 1);
    for (std::size_t k = 0; k <= m; ++k) {
        if (eigen.values[k] <= 1e-12 * largest) continue;  // a direction that the data do not determine
        const auto v = eigen.vectors.row(k);
        for (std::size_t i = 0; i <= m; ++i)
            for (std::size_t j = 0; j <= m; ++j) inverse(i, j) += 2 * v[i] * v[j] / eigen.values[k];
    }
    return inverse;
}

/// Covariance of the estimates with its derivatives in (free thetas, sigma^2); y still scaled.
void putCovariance(MixedModel& model, const Fitted& fitted, bool reml, double variance)
{
    const ThetaFit& fit = fitted.fit;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < fit.free.size(); ++i)
        if (fit.free[i]) rows.push_back(i);
    model.parameterCovariance = parameterCovariance(fitted, reml, variance, rows);
    const Matrix jacobian = thetaJacobian(*fitted.equations, fit.factorised.theta);
    const Matrix& c = fit.solved.fixedCovariance;
    const std::size_t p = c.rows();
    model.covariance = Matrix(p, p);
    model.covarianceDerivatives.assign(rows.size() + 1, Matrix(p, p));
    for (std::size_t i = 0; i < p; ++i)
        for (std::size_t j = 0; j < p; ++j) {
            model.covariance(i, j) = variance * c(i, j);
            model.covarianceDerivatives.back()(i, j) = c(i, j);
            for (std::size_t k = 0; k < rows.size(); ++k)
                for (std::size_t l = 0; l < jacobian.columns(); ++l)
                    model.covarianceDerivatives[k](i, j) +=
                        variance * jacobian(rows[k], l) * fit.derivatives.fixedCovariance[l](i, j);
        }
}

/// x 2^exponent, where that is a double.
Value unscaled(double x, int exponent)
{
    const double value = std::ldexp(x, exponent);
    if (!std::isfinite(value) || (value == 0 && x != 0)) return Value::undefined("is beyond the range of double");
    return value;
}

RandomEffect randomEffect(const RandomTerm& term, const std::string& why)
{
    RandomEffect effect;
    effect.name = term.group.name;
    effect.slopeName = term.slopeName;
    effect.variance = effect.sd = Value::undefined(why);
    effect.slopeVariance = effect.slopeSd = effect.correlation =
        Value::undefined(term.slope.empty() ? "the term has intercepts only" : why);
    return effect;
}

/// `residual`: its variance, y scaled; theta empty for a term left out.
RandomEffect randomEffect(const RandomTerm& term, double residual, std::span<const double> theta, int exponent, int slopeExponent)
{
    RandomEffect effect = randomEffect(term, "");
    const double intercept = theta.empty() ? 0 : theta[0];
    effect.variance = unscaled(residual * intercept * intercept, 2 * exponent);
    effect.sd = unscaled(std::sqrt(residual) * intercept, exponent);
    effect.zero = theta.empty();
    if (term.slope.empty()) return effect;
    const double slope = std::hypot(theta[1], theta[2]);
    effect.slopeVariance = unscaled(residual * slope * slope, 2 * (exponent - slopeExponent));
    effect.slopeSd = unscaled(std::sqrt(residual) * slope, exponent - slopeExponent);
    effect.correlation = theta[1] / slope;
    effect.zero = intercept <= thetaFloor || theta[2] <= thetaFloor;
    return effect;
}

void putVariances(MixedModel& model, const MixedModelRows& data, const Fitted& fitted, double variance)
{
    model.residualVariance = unscaled(variance, 2 * data.exponent);
    model.residualSd = unscaled(std::sqrt(variance), data.exponent);
    const auto& theta = fitted.fit.factorised.theta;
    for (std::size_t t = 0; t < data.random.size(); ++t) {
        const auto place = std::find(fitted.kept.begin(), fitted.kept.end(), t);
        std::span<const double> own;
        if (place != fitted.kept.end()) {
            const TermPlace& term = fitted.equations->terms()[static_cast<std::size_t>(place - fitted.kept.begin())];
            own = std::span(theta).subspan(term.firstTheta, term.components == 1 ? 1 : 3);
        }
        model.random.push_back(randomEffect(data.random[t], variance, own, data.exponent, data.slopeExponents[t]));
        model.singular = model.singular || model.random.back().zero;
    }
}

void refuse(MixedModel& model, const MixedModelRows& data, const std::string& why)
{
    model.why = why;
    model.residualVariance = model.residualSd = model.criterion = Value::undefined(why);
    for (const std::string& name : data.fixed.names) model.fixed.push_back({name, contrastTest(model, {})});
    for (const RandomTerm& term : data.random) model.random.push_back(randomEffect(term, why));
}

}  // namespace

MixedModel fitMixedModel(const MixedModelData& data, const MixedModelOptions& options)
{
    const MixedModelRows ready = mixedModelRows(data);
    MixedModel model;
    model.rows = ready.y.size();
    model.missing = ready.missing;
    const Fitted fitted = ready.why.empty() ? fitWithoutZeros(ready, options.reml) : Fitted{};
    const std::string& why = ready.why.empty() ? fitted.fit.why : ready.why;
    if (!why.empty()) {
        refuse(model, ready, why);
        return model;
    }
    const double degrees = residualDegrees(*fitted.equations, options.reml);
    const double variance = fitted.fit.factorised.residual / degrees;
    model.criterion = profiledCriterion(*fitted.equations, fitted.fit.factorised, options.reml) +
                      degrees * 2 * std::numbers::ln2 * ready.exponent;
    model.steps = fitted.fit.steps;
    model.sequential = ready.sequential;
    for (std::size_t i = 0; i < ready.leastSquares.size(); ++i)
        model.estimates.push_back(ready.leastSquares[i] + fitted.fit.solved.fixed[i]);
    model.exponent = ready.exponent;
    putCovariance(model, fitted, options.reml, variance);
    putVariances(model, ready, fitted, variance);
    for (std::size_t i = 0; i < model.estimates.size(); ++i) {
        std::vector<double> weights(model.estimates.size());
        weights[i] = 1;
        model.fixed.push_back({ready.fixed.names[i], contrastTest(model, weights, options.confidence)});
    }
    return model;
}

}  // namespace stats
