#include "stats/models/laplace_criterion.h"

#include <algorithm>
#include <cmath>

namespace stats {
namespace {

constexpr std::size_t factorsPerLogarithm = 512;  // each between 1 and 2: their product cannot overflow
constexpr int mostPasses = 60;
constexpr double farOut = 200;  // log odds; no likelihood rises out there

}  // namespace

LaplaceCriterion::LaplaceCriterion(std::span<const double> right, const Factor& cells, std::span<const Factor> groups)
    : m_rows(right.size()),
      m_terms(groups.size()),
      m_cells(cells.levels.size()),
      m_right(right.begin(), right.end()),
      m_cellOf(cells.of.begin(), cells.of.end()),
      m_columns(m_rows * m_terms),
      m_probability(m_rows),
      m_rowWeights(m_rows)
{
    for (std::size_t t = 0; t < m_terms; ++t) {
        const std::size_t first = m_termOf.size();
        m_termOf.insert(m_termOf.end(), groups[t].levels.size(), static_cast<std::uint32_t>(t));
        for (std::size_t i = 0; i < m_rows; ++i) m_columns[i * m_terms + t] = static_cast<std::uint32_t>(first + groups[t].of[i]);
    }
    m_mode.assign(m_termOf.size(), 0);
    m_residual.assign(m_termOf.size(), 0);
    m_weights = Matrix(m_termOf.size(), m_termOf.size());
}

std::vector<double> LaplaceCriterion::crudeMeans() const
{
    std::vector<double> right(m_cells, 0.5);
    std::vector<double> all(m_cells, 1);
    for (std::size_t i = 0; i < m_rows; ++i) {
        right[m_cellOf[i]] += m_right[i];
        all[m_cellOf[i]] += 1;
    }
    for (std::size_t c = 0; c < m_cells; ++c) right[c] = std::log(right[c] / (all[c] - right[c]));
    return right;
}

/// Probabilities, Z'(y - p) and Z'WZ (lower triangle) at u. Returns -2 log p(y | u) + u'u.
double LaplaceCriterion::pass(std::span<const double> parameters, std::span<const double> u)
{
    std::vector<double> effect(u.begin(), u.end());
    for (std::size_t j = 0; j < effect.size(); ++j) effect[j] *= sdOf(parameters, j);
    std::fill(m_residual.begin(), m_residual.end(), 0.0);
    m_weights = Matrix(effect.size(), effect.size());
    double logarithms = 0;
    double product = 1;
    for (std::size_t i = 0; i < m_rows; ++i) {
        const std::uint32_t* const columns = m_columns.data() + i * m_terms;
        double eta = parameters[m_terms + m_cellOf[i]];
        for (std::size_t t = 0; t < m_terms; ++t) eta += effect[columns[t]];
        const double small = std::exp(-std::fabs(eta));
        const double p = eta < 0 ? small / (1 + small) : 1 / (1 + small);
        const double w = small / ((1 + small) * (1 + small));
        if ((eta < 0) == (m_right[i] > 0.5)) logarithms += std::fabs(eta);
        product *= 1 + small;
        if (i % factorsPerLogarithm == factorsPerLogarithm - 1) {
            logarithms += std::log(product);
            product = 1;
        }
        m_probability[i] = p;
        m_rowWeights[i] = w;
        for (std::size_t t = 0; t < m_terms; ++t) {
            m_residual[columns[t]] += m_right[i] - p;
            for (std::size_t s = 0; s <= t; ++s) m_weights(columns[t], columns[s]) += w;
        }
    }
    return 2 * (logarithms + std::log(product)) + dot(u, u);
}

/// Lambda'Z'WZ Lambda + I of the last pass.
Matrix LaplaceCriterion::information(std::span<const double> parameters) const
{
    const std::size_t q = m_termOf.size();
    Matrix result(q, q);
    for (std::size_t j = 0; j < q; ++j) {
        for (std::size_t k = 0; k <= j; ++k)
            result(j, k) = result(k, j) = sdOf(parameters, j) * sdOf(parameters, k) * m_weights(j, k);
        result(j, j) += 1;
    }
    return result;
}

/// Newton's method in u, steps halved where they do not go down. The penalised likelihood is concave.
bool LaplaceCriterion::findMode(std::span<const double> parameters, double& penalised)
{
    for (const double parameter : parameters)
        if (!(std::fabs(parameter) < farOut)) return false;
    penalised = pass(parameters, m_mode);
    if (m_mode.empty()) return true;
    for (int passes = 0; passes < mostPasses; ++passes) {
        std::vector<double> slope(m_mode.size());
        for (std::size_t j = 0; j < slope.size(); ++j) slope[j] = sdOf(parameters, j) * m_residual[j] - m_mode[j];
        const auto step = solved(information(parameters), slope);
        if (step.empty()) return false;
        const double expected = dot(step, slope);
        if (expected < 1e-18) return true;
        double fraction = 1;
        std::vector<double> next(m_mode.size());
        double value = HUGE_VAL;
        for (; fraction > 1e-6; fraction /= 2) {
            for (std::size_t j = 0; j < next.size(); ++j) next[j] = m_mode[j] + fraction * step[j];
            value = pass(parameters, next);
            if (value <= penalised + 1e-12 * std::fabs(penalised)) break;
        }
        m_mode = next;
        penalised = value;
        if (expected < 1e-11) return true;  // the step just taken has squared that
    }
    return false;
}

/// By the chain rule: parameters move the log odds of a row directly and through the mode, and these move
/// the weights in the determinant.
std::vector<double> LaplaceCriterion::gradient(std::span<const double> parameters, std::span<const double> u,
                                               const Matrix& inverse, const NewtonStep& step) const
{
    const std::size_t q = m_termOf.size();
    std::vector<double> direct(m_rows);  // change of log |M| with the log odds: leverage x change of the weight
    std::vector<double> pulled(q);
    for (std::size_t i = 0; i < m_rows; ++i) {
        const std::uint32_t* const columns = m_columns.data() + i * m_terms;
        double leverage = 0;
        for (std::size_t t = 0; t < m_terms; ++t)
            for (std::size_t s = 0; s < m_terms; ++s) leverage += parameters[t] * parameters[s] * inverse(columns[t], columns[s]);
        direct[i] = leverage * m_rowWeights[i] * (1 - 2 * m_probability[i]);
        for (std::size_t t = 0; t < m_terms; ++t) pulled[columns[t]] += parameters[t] * direct[i];
    }
    for (std::size_t j = 0; j < q; ++j) pulled[j] += 2 * (u[j] - sdOf(parameters, j) * m_residual[j]);
    const auto answer = product(step.inverse, pulled);

    std::vector<double> result(parameterCount());
    for (std::size_t i = 0; i < m_rows; ++i) {
        const std::uint32_t* const columns = m_columns.data() + i * m_terms;
        double through = 0;
        for (std::size_t t = 0; t < m_terms; ++t) through += parameters[t] * answer[columns[t]];
        const double change = direct[i] - step.weights[i] * through - 2 * (m_right[i] - m_probability[i]);
        result[m_terms + m_cellOf[i]] += change;
        for (std::size_t t = 0; t < m_terms; ++t) result[t] += change * u[columns[t]];
    }
    for (std::size_t j = 0; j < q; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < q; ++k)
            sum += inverse(j, k) * sdOf(parameters, k) * (j < k ? m_weights(k, j) : m_weights(j, k));
        result[m_termOf[j]] += 2 * sum + answer[j] * step.residual[j];
    }
    return result;
}

/// Adds the determinant of the last pass; without a step the mode is the true one.
LaplaceCriterion::At LaplaceCriterion::finished(std::span<const double> parameters, std::span<const double> u, double penalised,
                                                const NewtonStep* step) const
{
    At result;
    const std::size_t q = m_termOf.size();
    Matrix upper = information(parameters);
    if (factorise(upper) < q) return result;
    result.value = penalised;
    for (std::size_t j = 0; j < q; ++j) result.value += 2 * std::log(upper(j, j));
    const Matrix inverse = inverseFrom(inverseOfTransposed(upper, q), q);
    result.gradient = gradient(parameters, u, inverse, step != nullptr ? *step : NewtonStep{inverse, m_rowWeights, m_residual});
    result.exists = std::isfinite(result.value);
    return result;
}

LaplaceCriterion::At LaplaceCriterion::at(std::span<const double> parameters)
{
    double penalised = 0;
    if (findMode(parameters, penalised)) return finished(parameters, m_mode, penalised, nullptr);
    std::fill(m_mode.begin(), m_mode.end(), 0.0);
    return {};
}

std::vector<double> LaplaceCriterion::logOdds(std::span<const double> parameters, std::span<const double> u) const
{
    std::vector<double> eta(m_rows);
    for (std::size_t i = 0; i < m_rows; ++i) {
        eta[i] = parameters[m_terms + m_cellOf[i]];
        for (std::size_t t = 0; t < m_terms; ++t) eta[i] += parameters[t] * u[m_columns[i * m_terms + t]];
    }
    return eta;
}

void LaplaceCriterion::holdMode(std::span<const double> parameters)
{
    pass(parameters, m_mode);
    m_heldLogOdds = logOdds(parameters, m_mode);
    m_heldProbability = m_probability;
    m_heldRowWeights = m_rowWeights;
    m_heldWeights = m_weights;
}

LaplaceCriterion::At LaplaceCriterion::atOneStep(std::span<const double> parameters)
{
    const std::size_t q = m_termOf.size();
    m_weights = m_heldWeights;
    Matrix upper = information(parameters);
    if (factorise(upper) < q) return {};
    NewtonStep step{inverseFrom(inverseOfTransposed(upper, q), q), m_heldRowWeights, std::vector<double>(q)};
    // Residuals of the linearised model, first without random effects, then at the u that they give.
    const auto residual = [&](std::span<const double> u) {
        const auto eta = logOdds(parameters, u);
        std::vector<double> sums(q);
        for (std::size_t i = 0; i < m_rows; ++i) {
            const double working = m_heldRowWeights[i] * (m_heldLogOdds[i] - eta[i]) + m_right[i] - m_heldProbability[i];
            for (std::size_t t = 0; t < m_terms; ++t) sums[m_columns[i * m_terms + t]] += working;
        }
        return sums;
    };
    auto right = residual(std::vector<double>(q));
    for (std::size_t j = 0; j < q; ++j) right[j] *= sdOf(parameters, j);
    const auto u = product(step.inverse, right);
    step.residual = residual(u);
    const double penalised = pass(parameters, u);
    return finished(parameters, u, penalised, &step);
}

}  // namespace stats
