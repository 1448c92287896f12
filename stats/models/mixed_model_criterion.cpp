#include "stats/models/mixed_model_criterion.h"

#include <cmath>
#include <numbers>

namespace stats {
namespace {

/// A direction gamma_k: V_k combines components a and b of every level of a term.
struct VarianceDirection {
    const TermPlace* term;
    std::size_t a, b;

    std::size_t column(std::size_t level, std::size_t component) const
    {
        return term->firstColumn + level * term->components + component;
    }
};

std::vector<VarianceDirection> directionsOf(const MixedModelEquations& equations)
{
    std::vector<VarianceDirection> directions;
    for (const TermPlace& term : equations.terms())
        for (std::size_t a = 0; a < term.components; ++a)
            for (std::size_t b = a; b < term.components; ++b) directions.push_back({&term, a, b});
    return directions;
}

/// Calls `visit` with (a, b), and with (b, a) where they differ: V_k is symmetric.
template <typename Visit>
void bothOrders(const VarianceDirection& direction, Visit visit)
{
    visit(direction.a, direction.b);
    if (direction.a != direction.b) visit(direction.b, direction.a);
}

double traceOf(const Matrix& w, const VarianceDirection& k)
{
    double sum = 0;
    bothOrders(k, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < k.term->levels; ++i) sum += w(k.column(i, a), k.column(i, b));
    });
    return sum;
}

double formOf(std::span<const double> score, const VarianceDirection& k)
{
    double sum = 0;
    bothOrders(k, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < k.term->levels; ++i) sum += score[k.column(i, a)] * score[k.column(i, b)];
    });
    return sum;
}

/// Sum of term(column x of k, column y of k, column z of l, column w of l) over all pairs of levels.
template <typename Term>
double sumOverPairs(const VarianceDirection& k, const VarianceDirection& l, Term term)
{
    double sum = 0;
    bothOrders(k, [&](std::size_t x, std::size_t y) {
        bothOrders(l, [&](std::size_t z, std::size_t w) {
            for (std::size_t i = 0; i < k.term->levels; ++i)
                for (std::size_t j = 0; j < l.term->levels; ++j)
                    sum += term(k.column(i, x), k.column(i, y), l.column(j, z), l.column(j, w));
        });
    });
    return sum;
}

/// F V_k F' with F = C X'V^-1 Z.
Matrix covarianceDerivative(const Matrix& f, const VarianceDirection& k)
{
    const std::size_t p = f.rows();
    Matrix result(p, p);
    bothOrders(k, [&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < p; ++i)
            for (std::size_t j = 0; j < p; ++j)
                for (std::size_t level = 0; level < k.term->levels; ++level)
                    result(i, j) += f(i, k.column(level, a)) * f(j, k.column(level, b));
    });
    return result;
}

}  // namespace

double residualDegrees(const MixedModelSystem& system, bool reml)
{
    return static_cast<double>(system.rows() - (reml ? system.fixedCount() : 0));
}

double profiledCriterion(const MixedModelSystem& system, const CriterionParts& parts, bool reml)
{
    const double degrees = residualDegrees(system, reml);
    return parts.logDetRandom + (reml ? parts.logDetFixed : 0) +
           degrees * (1 + std::log(2 * std::numbers::pi * parts.residual / degrees));
}

VarianceDerivatives varianceDerivatives(const MixedModelEquations& equations, const Solved& solved, bool reml)
{
    const auto directions = directionsOf(equations);
    const Matrix& p = solved.projected;
    const Matrix& w = reml ? solved.projected : solved.weighted;
    const auto& q = solved.score;
    VarianceDerivatives result;
    result.traceProducts = result.formProducts = Matrix(directions.size(), directions.size());
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const VarianceDirection& one = directions[k];
        result.traces.push_back(traceOf(w, one));
        result.forms.push_back(formOf(q, one));
        result.fixedCovariance.push_back(covarianceDerivative(solved.fixedOnRandom, one));
        for (std::size_t l = 0; l <= k; ++l) {
            const VarianceDirection& other = directions[l];
            result.traceProducts(k, l) = result.traceProducts(l, k) =
                sumOverPairs(one, other, [&](auto x, auto y, auto z, auto v) { return w(y, z) * w(x, v); });
            result.formProducts(k, l) = result.formProducts(l, k) =
                sumOverPairs(one, other, [&](auto x, auto y, auto z, auto v) { return q[x] * p(y, z) * q[v]; });
        }
    }
    return result;
}

Matrix thetaJacobian(const MixedModelSystem& system, std::span<const double> theta)
{
    Matrix jacobian(theta.size(), theta.size());
    for (const TermPlace& term : system.terms()) {
        const std::size_t i = term.firstTheta;
        jacobian(i, i) = 2 * theta[i];
        if (term.components == 1) continue;
        jacobian(i, i + 1) = theta[i + 1];
        jacobian(i + 1, i + 1) = theta[i];
        jacobian(i + 1, i + 2) = 2 * theta[i + 1];
        jacobian(i + 2, i + 2) = 2 * theta[i + 2];
    }
    return jacobian;
}

Matrix thetaHessian(const MixedModelSystem& system, std::span<const double> theta, std::span<const double> gradient,
                    const Matrix& hessian)
{
    const std::size_t n = theta.size();
    const Matrix jacobian = thetaJacobian(system, theta);
    Matrix result(n, n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) result(i, j) = quadraticForm(jacobian.row(i), hessian, jacobian.row(j));
    for (const TermPlace& term : system.terms()) {
        const std::size_t i = term.firstTheta;
        result(i, i) += 2 * gradient[i];
        if (term.components == 1) continue;
        result(i, i + 1) += gradient[i + 1];
        result(i + 1, i) += gradient[i + 1];
        result(i + 1, i + 1) += 2 * gradient[i + 2];
        result(i + 2, i + 2) += 2 * gradient[i + 2];
    }
    return result;
}

ThetaDerivatives profiledDerivatives(const MixedModelSystem& system, const CriterionParts& parts,
                                     const VarianceDerivatives& derivatives, bool reml)
{
    const std::size_t n = derivatives.traces.size();
    const double variance = parts.residual / residualDegrees(system, reml);
    std::vector<double> gradient(n);
    Matrix hessian(n, n);
    for (std::size_t k = 0; k < n; ++k) {
        gradient[k] = derivatives.traces[k] - derivatives.forms[k] / variance;
        for (std::size_t l = 0; l < n; ++l)
            hessian(k, l) = -derivatives.traceProducts(k, l) + 2 * derivatives.formProducts(k, l) / variance -
                            derivatives.forms[k] * derivatives.forms[l] / (variance * parts.residual);
    }
    return {product(thetaJacobian(system, parts.theta), gradient), thetaHessian(system, parts.theta, gradient, hessian)};
}

}  // namespace stats
