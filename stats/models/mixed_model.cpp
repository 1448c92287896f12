#include "stats/models/mixed_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "stats/models/mixed_model_fit.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

/// Thetas of a system, and which of them are parameters of Satterthwaite's degrees of freedom.
struct VarianceThetas {
    std::vector<double> values;
    std::vector<bool> isFree;
    std::vector<double> scale;  ///< factors that change no degrees of freedom: the derivative of a square at zero would be none
};

/// What Satterthwaite's degrees of freedom need of the variances.
struct VarianceParameters {
    VarianceDerivatives derivatives;
    Matrix directions;  ///< of the free parameters among the relative (co)variances [free x (co)variances]
    Matrix hessian;     ///< of -2 log likelihood in the free parameters, not profiled
};

/// The gradient in the relative (co)variances where it belongs to the Hessian in theta. In a free direction it vanishes: what is
/// left where the fit stops is no curvature, but the distance to the optimum, divided by a small theta. A correlation at 1 holds
/// covariances on a curved border, whose curvature counts.
std::vector<double> gradientAtBorders(const MixedModelSystem& system, const VarianceThetas& thetas, const VarianceDerivatives& d,
                                      double variance)
{
    std::vector<double> gradient(thetas.values.size());
    for (const TermPlace& term : system.terms()) {
        const auto first = thetas.isFree.begin() + static_cast<std::ptrdiff_t>(term.firstTheta);
        if (term.components == 1 || std::all_of(first, first + 3, [](bool isFree) { return isFree; })) continue;
        for (std::size_t k = term.firstTheta; k < term.firstTheta + 3; ++k) gradient[k] = d.traces[k] - d.forms[k] / variance;
    }
    return gradient;
}

VarianceParameters parametersAt(const MixedModelSystem& system, const VarianceThetas& thetas, const VarianceDerivatives& d,
                                double variance)
{
    const std::size_t n = thetas.values.size();
    Matrix inVariances(n, n);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = 0; l < n; ++l) inVariances(k, l) = -d.traceProducts(k, l) + 2 * d.formProducts(k, l) / variance;
    const Matrix hessian = thetaHessian(system, thetas.values, gradientAtBorders(system, thetas, d, variance), inVariances);
    const Matrix jacobian = thetaJacobian(system, thetas.values);
    std::vector<std::size_t> free;
    for (std::size_t i = 0; i < n; ++i)
        if (thetas.isFree[i]) free.push_back(i);
    VarianceParameters result{d, Matrix(free.size(), n), Matrix(free.size(), free.size())};
    for (std::size_t i = 0; i < free.size(); ++i) {
        const double scale = thetas.scale[free[i]];
        for (std::size_t k = 0; k < n; ++k) result.directions(i, k) = scale * jacobian(free[i], k);
        for (std::size_t j = 0; j < free.size(); ++j)
            result.hessian(i, j) = scale * thetas.scale[free[j]] * hessian(free[i], free[j]);
    }
    return result;
}

VarianceParameters varianceParameters(const FittedTerms& fitted, const TermChoice& choice, double variance)
{
    const ThetaFit& fit = fitted.fit;
    const std::vector<double> ones(fit.free.size(), 1);
    if (fitted.tied.empty())
        return parametersAt(*fitted.system, {fit.parts.theta, fit.free, ones}, fit.solution.derivatives, variance);
    std::vector<std::size_t> terms = fitted.kept;
    terms.insert(terms.end(), fitted.tied.begin(), fitted.tied.end());
    std::sort(terms.begin(), terms.end());
    const std::unique_ptr<MixedModelSystem> system = choice.systemOf(terms).system;  // smaller than one that was fitted
    const std::size_t n = system->thetaCount();
    VarianceThetas thetas{std::vector<double>(n, thetaFloor), std::vector<bool>(n, true),
                          std::vector<double>(n, 1 / (2 * thetaFloor))};
    for (std::size_t k = 0; k < fitted.kept.size(); ++k) {
        const auto place = std::find(terms.begin(), terms.end(), fitted.kept[k]) - terms.begin();
        const std::size_t to = system->terms()[static_cast<std::size_t>(place)].firstTheta;
        const TermPlace& from = fitted.system->terms()[k];
        for (std::size_t i = 0; i < (from.components == 1 ? 1U : 3U); ++i) {
            thetas.values[to + i] = fit.parts.theta[from.firstTheta + i];
            thetas.isFree[to + i] = fit.free[from.firstTheta + i];
            thetas.scale[to + i] = 1;
        }
    }
    return parametersAt(*system, thetas, system->solutionAt(thetas.values, choice.reml()).derivatives, variance);
}

/// Covariance of (free parameters, sigma^2): twice the inverse of the Hessian of -2 log likelihood, not profiled. The inverse is
/// that of log sigma^2, which has no unit, as theta: the unit of y must not decide which directions are determined.
Matrix parameterCovariance(const VarianceParameters& parameters, double degrees, double variance)
{
    const std::size_t m = parameters.hessian.rows();
    Matrix whole(m + 1, m + 1);
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < m; ++j) whole(i, j) = parameters.hessian(i, j);
        whole(i, m) = whole(m, i) = dot(parameters.directions.row(i), parameters.derivatives.forms) / variance;
    }
    whole(m, m) = degrees;
    const Eigen eigen = eigenOf(whole);
    const double largest = *std::max_element(eigen.values.begin(), eigen.values.end());
    Matrix inverse(m + 1, m + 1);
    for (std::size_t k = 0; k <= m; ++k) {
        if (eigen.values[k] <= 1e-12 * largest) continue;  // the data do not determine this direction
        const auto v = eigen.vectors.row(k);
        for (std::size_t i = 0; i <= m; ++i)
            for (std::size_t j = 0; j <= m; ++j) inverse(i, j) += 2 * v[i] * v[j] / eigen.values[k];
    }
    for (std::size_t i = 0; i <= m; ++i) {
        inverse(i, m) *= variance;
        inverse(m, i) *= variance;
    }
    return inverse;
}

/// Sets the covariance of the estimates and its derivatives in (free parameters, sigma^2); y is still scaled.
void putCovariance(MixedModel& model, const FittedTerms& fitted, const TermChoice& choice, double variance)
{
    const VarianceParameters parameters = varianceParameters(fitted, choice, variance);
    const Matrix& directions = parameters.directions;
    model.parameterCovariance = parameterCovariance(parameters, residualDegrees(*fitted.system, choice.reml()), variance);
    const Matrix& c = fitted.fit.solution.fixedCovariance;
    const std::size_t p = c.rows();
    model.covariance = Matrix(p, p);
    model.covarianceDerivatives.assign(directions.rows() + 1, Matrix(p, p));
    for (std::size_t i = 0; i < p; ++i)
        for (std::size_t j = 0; j < p; ++j) {
            model.covariance(i, j) = variance * c(i, j);
            model.covarianceDerivatives.back()(i, j) = c(i, j);
            for (std::size_t k = 0; k < directions.rows(); ++k)
                for (std::size_t l = 0; l < directions.columns(); ++l)
                    model.covarianceDerivatives[k](i, j) +=
                        variance * directions(k, l) * parameters.derivatives.fixedCovariance[l](i, j);
        }
}

/// x 2^exponent; undefined beyond the range of double.
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

/// `residual`: residual variance, y scaled. `theta`: empty for a term that was left out.
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

void putVariances(MixedModel& model, const MixedModelRows& data, const FittedTerms& fitted, double variance)
{
    model.residualVariance = unscaled(variance, 2 * data.exponent);
    model.residualSd = unscaled(std::sqrt(variance), data.exponent);
    const auto& theta = fitted.fit.parts.theta;
    for (std::size_t t = 0; t < data.random.size(); ++t) {
        const auto place = std::find(fitted.kept.begin(), fitted.kept.end(), t);
        std::span<const double> own;
        if (place != fitted.kept.end()) {
            const TermPlace& term = fitted.system->terms()[static_cast<std::size_t>(place - fitted.kept.begin())];
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
    const Ties ties = hasLevelOfEqualValues(data) ? Ties::Counted : Ties::LeftOut;
    const std::optional<TermChoice> choice =
        ready.why.empty() ? std::optional<TermChoice>(std::in_place, ready, options.reml, ties) : std::nullopt;
    const FittedTerms fitted = choice ? choice->fitWithoutZeros() : FittedTerms{};
    const std::string& why = ready.why.empty() ? fitted.fit.why : ready.why;
    if (!why.empty()) {
        refuse(model, ready, why);
        return model;
    }
    const double degrees = residualDegrees(*fitted.system, options.reml);
    const double variance = fitted.fit.parts.residual / degrees;
    model.criterion =
        profiledCriterion(*fitted.system, fitted.fit.parts, options.reml) + degrees * 2 * std::numbers::ln2 * ready.exponent;
    model.steps = fitted.fit.steps;
    model.sequential = ready.sequential;
    for (std::size_t i = 0; i < ready.leastSquares.size(); ++i)
        model.estimates.push_back(ready.leastSquares[i] + fitted.fit.solution.fixed[i]);
    model.exponent = ready.exponent;
    putCovariance(model, fitted, *choice, variance);
    putVariances(model, ready, fitted, variance);
    for (std::size_t i = 0; i < model.estimates.size(); ++i) {
        std::vector<double> weights(model.estimates.size());
        weights[i] = 1;
        model.fixed.push_back({ready.fixed.names[i], contrastTest(model, weights, options.confidence)});
    }
    return model;
}

}  // namespace stats
