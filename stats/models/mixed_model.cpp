#include "stats/models/mixed_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "stats/models/mixed_model_balanced.h"
#include "stats/models/mixed_model_blocks.h"
#include "stats/models/mixed_model_equations.h"
#include "stats/models/mixed_model_fit.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

/// Beyond this number of random effects a model of incomplete data is fitted by blocks of one factor.
constexpr std::size_t mostDenseEffects = 300;
constexpr std::size_t mostDenseSlopes = 5000;  // random effects where some are slopes, which have no blocks
constexpr double mostWork = 5e9;               // operations of one solution by blocks; a fit takes about ten

std::size_t effectsOf(const std::vector<RandomTerm>& terms)
{
    std::size_t count = 0;
    for (const RandomTerm& term : terms) count += (term.slope.empty() ? 1 : 2) * term.group.levels.size();
    return count;
}

/// The equations of a model, or the reason why it takes too long.
struct ChosenSystem {
    std::string why;
    std::unique_ptr<MixedModelSystem> system;
};

ChosenSystem systemOf(const MixedModelRows& data, const std::optional<BalancedDesign>& balanced,
                      const std::vector<std::size_t>& kept)
{
    if (balanced) return {"", std::make_unique<BalancedEquations>(*balanced, kept)};
    std::vector<RandomTerm> terms;
    for (const std::size_t t : kept) terms.push_back(data.random[t]);
    const std::size_t effects = effectsOf(terms);
    const bool slopes = std::ranges::any_of(terms, [](const RandomTerm& term) { return !term.slope.empty(); });
    if (effects <= mostDenseEffects || (slopes && effects <= mostDenseSlopes))
        return {"", std::make_unique<MixedModelEquations>(data.y, data.fixed, terms)};
    if (!slopes) {
        const RowBlocks blocks = cheapestBlocks(data.fixed, terms);
        if (blocks.work <= mostWork) return {"", std::make_unique<BlockEquations>(data.y, data.fixed, terms, blocks)};
    }
    return {"the data are incomplete, and a model with " + std::to_string(effects) + " random effects then takes too long", {}};
}

/// The fit of the model with those random terms whose variance is not zero.
struct Fitted {
    std::vector<std::size_t> kept;
    std::unique_ptr<MixedModelSystem> system;
    ThetaFit fit;
};

bool isZero(const TermPlace& term, const ThetaFit& fit) { return term.components == 1 && !fit.free[term.firstTheta]; }

/// Fits; leaves out the intercepts whose variance is zero, and fits again without them.
Fitted fitWithoutZeros(const MixedModelRows& data, bool reml)
{
    Fitted result;
    for (std::size_t t = 0; t < data.random.size(); ++t) result.kept.push_back(t);
    const std::optional<BalancedDesign> balanced = balancedDesign(data);
    while (true) {
        ChosenSystem chosen = systemOf(data, balanced, result.kept);
        result.fit.why = chosen.why;
        if (!chosen.system) return result;
        result.system = std::move(chosen.system);
        result.fit = fitTheta(*result.system, reml);
        if (!result.fit.why.empty()) return result;
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < result.kept.size(); ++i)
            if (!isZero(result.system->terms()[i], result.fit)) kept.push_back(result.kept[i]);
        if (kept.size() == result.kept.size()) return result;
        result.kept = std::move(kept);
    }
}

/// Covariance of (free thetas, sigma^2): twice the inverse of the Hessian of -2 log likelihood, not profiled.
/// `rows`: rows of the Jacobian that belong to the free thetas.
Matrix parameterCovariance(const Fitted& fitted, bool reml, double variance, const std::vector<std::size_t>& rows)
{
    const auto& d = fitted.fit.solution.derivatives;
    const auto& theta = fitted.fit.parts.theta;
    const std::size_t n = theta.size();
    std::vector<double> gradient(n);
    Matrix hessian(n, n);
    for (std::size_t k = 0; k < n; ++k) {
        gradient[k] = d.traces[k] - d.forms[k] / variance;
        for (std::size_t l = 0; l < n; ++l) hessian(k, l) = -d.traceProducts(k, l) + 2 * d.formProducts(k, l) / variance;
    }
    const Matrix inTheta = thetaHessian(*fitted.system, theta, gradient, hessian);
    const auto cross = product(thetaJacobian(*fitted.system, theta), d.forms);
    const std::size_t m = rows.size();
    Matrix whole(m + 1, m + 1);
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < m; ++j) whole(i, j) = inTheta(rows[i], rows[j]);
        whole(i, m) = whole(m, i) = cross[rows[i]] / (variance * variance);
    }
    whole(m, m) = residualDegrees(*fitted.system, reml) / (variance * variance);
    const Eigen eigen = eigenOf(whole);
    const double largest = *std::max_element(eigen.values.begin(), eigen.values.end());
    Matrix inverse(m + 1, m + 1);
    for (std::size_t k = 0; k <= m; ++k) {
        if (eigen.values[k] <= 1e-12 * largest) continue;  // the data do not determine this direction
        const auto v = eigen.vectors.row(k);
        for (std::size_t i = 0; i <= m; ++i)
            for (std::size_t j = 0; j <= m; ++j) inverse(i, j) += 2 * v[i] * v[j] / eigen.values[k];
    }
    return inverse;
}

/// Sets the covariance of the estimates and its derivatives in (free thetas, sigma^2); y is still scaled.
void putCovariance(MixedModel& model, const Fitted& fitted, bool reml, double variance)
{
    const ThetaFit& fit = fitted.fit;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < fit.free.size(); ++i)
        if (fit.free[i]) rows.push_back(i);
    model.parameterCovariance = parameterCovariance(fitted, reml, variance, rows);
    const Matrix jacobian = thetaJacobian(*fitted.system, fit.parts.theta);
    const Matrix& c = fit.solution.fixedCovariance;
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
                        variance * jacobian(rows[k], l) * fit.solution.derivatives.fixedCovariance[l](i, j);
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

void putVariances(MixedModel& model, const MixedModelRows& data, const Fitted& fitted, double variance)
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
    const Fitted fitted = ready.why.empty() ? fitWithoutZeros(ready, options.reml) : Fitted{};
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
