#include "stats/models/laplace_criterion.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "stats/kernels/matrix.h"

namespace stats {
namespace {

constexpr std::size_t factorsPerLogarithm = 512;  // each between 1 and 2: their product cannot overflow
constexpr int mostPasses = 60;
constexpr double farOut = 200;  // log odds; beyond, no likelihood increases

std::vector<std::size_t> countsOf(const OrderedAnswers& answers)
{
    std::vector<std::size_t> counts(answers.categories);
    for (const std::uint32_t category : answers.category) ++counts[category];
    return counts;
}

/// The threshold above which the share of answers is nearest to one half.
std::size_t medianThreshold(const std::vector<std::size_t>& counts, std::size_t answers)
{
    std::size_t best = 0;
    std::size_t nearest = answers + 1;
    std::size_t below = 0;
    for (std::size_t j = 0; j + 1 < counts.size(); ++j) {
        below += counts[j];
        const std::size_t above = answers - below;
        const std::size_t distance = above > below ? above - below : below - above;
        if (distance < nearest) {
            nearest = distance;
            best = j;
        }
    }
    return best;
}

}  // namespace

LaplaceCriterion::LaplaceCriterion(const OrderedAnswers& answers)
    : m_terms(answers.groups.size()),
      m_cells(answers.cells.levels.size()),
      m_thresholds(answers.categories - 1),
      m_answers(answers.category.size()),
      m_counts(countsOf(answers)),
      m_random(answers.groups, answers.category.size())
{
    m_anchor = medianThreshold(m_counts, m_answers);
    const auto order = m_random.rowsByBlock();
    for (const std::uint32_t answer : order) addAnswer(answers.category[answer], answers.cells.of[answer]);
    m_firstChoice.push_back(static_cast<std::uint32_t>(m_above.size()));
    findPlaces(order);
    m_mode.assign(m_random.count(), 0);
    m_residual.assign(m_random.count(), 0);
    m_weights.assign(m_answers, 0);
    m_probability.assign(m_above.size(), 0);
    m_choiceWeights.assign(m_above.size(), 0);
}

void LaplaceCriterion::addAnswer(std::size_t category, std::size_t cell)
{
    m_cellOf.push_back(static_cast<std::uint32_t>(cell));
    m_firstChoice.push_back(static_cast<std::uint32_t>(m_above.size()));
    if (category > 0) addChoice(true, category - 1);
    if (category < m_thresholds) addChoice(false, category);
}

void LaplaceCriterion::addChoice(bool isAbove, std::size_t threshold)
{
    m_above.push_back(isAbove ? 1 : 0);
    m_thresholdOf.push_back(static_cast<std::uint32_t>(threshold));
}

void LaplaceCriterion::findPlaces(const std::vector<std::uint32_t>& order)
{
    m_columns.reserve(m_answers * m_terms);
    m_places.reserve(m_answers * m_terms * (m_terms + 1) / 2);
    for (const std::uint32_t answer : order) {
        const std::uint32_t* const columns = m_random.of(answer);
        m_columns.insert(m_columns.end(), columns, columns + m_terms);
        for (std::size_t t = 0; t < m_terms; ++t)
            for (std::size_t s = 0; s <= t; ++s)
                m_places.push_back(static_cast<std::uint32_t>(m_random.shape().place(columns[t], columns[s])));
    }
}

std::vector<double> LaplaceCriterion::crudeStart() const
{
    std::vector<double> above(m_cells, 0.5);
    std::vector<double> all(m_cells, 1);
    for (std::size_t i = 0; i < m_answers; ++i) {
        // The first choice of an answer in the lowest category is "not above" the first threshold.
        const std::uint32_t first = m_firstChoice[i];
        if (m_above[first] == 1 && m_thresholdOf[first] >= m_anchor) above[m_cellOf[i]] += 1;
        all[m_cellOf[i]] += 1;
    }
    std::vector<double> start;
    for (std::size_t c = 0; c < m_cells; ++c) start.push_back(std::log(above[c] / (all[c] - above[c])));
    std::vector<double> logOddsAbove;
    double below = 0;
    for (std::size_t j = 0; j < m_thresholds; ++j) {
        below += static_cast<double>(m_counts[j]);
        logOddsAbove.push_back(std::log((static_cast<double>(m_answers) - below) / below));
    }
    for (std::size_t j = 0; j < m_thresholds; ++j)
        if (j != m_anchor) start.push_back(logOddsAbove[m_anchor] - logOddsAbove[j]);
    return start;
}

std::vector<double> LaplaceCriterion::crudeVariances() const
{
    std::vector<double> choices(m_cells + m_thresholds);
    for (const std::uint32_t cell : m_cellOf) choices[cell] += 1;
    for (const std::uint32_t threshold : m_thresholdOf) choices[m_cells + threshold] += 1;
    std::vector<double> variances;
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (i != m_cells + m_anchor) variances.push_back(2.5 / choices[i]);
    return variances;
}

std::vector<double> LaplaceCriterion::thresholdsOf(std::span<const double> parameters) const
{
    std::vector<double> thresholds(m_thresholds);
    for (std::size_t j = 0; j < m_thresholds; ++j)
        if (j != m_anchor) thresholds[j] = parameters[parameterOf(j)];
    return thresholds;
}

/// False where a parameter is far out, or where thresholds are out of order.
bool LaplaceCriterion::isPossible(std::span<const double> parameters) const
{
    const auto thresholds = thresholdsOf(parameters);
    return std::all_of(parameters.begin(), parameters.end(), [](double x) { return std::fabs(x) < farOut; }) &&
           std::adjacent_find(thresholds.begin(), thresholds.end(), std::greater_equal<>()) == thresholds.end();
}

/// -2 log of the factors of the thresholds.
double LaplaceCriterion::thresholdTerm(std::span<const double> parameters) const
{
    const auto thresholds = thresholdsOf(parameters);
    double sum = 0;
    for (std::size_t j = 1; j < m_thresholds; ++j)
        sum -= 2 * static_cast<double>(m_counts[j]) * std::log(-std::expm1(thresholds[j - 1] - thresholds[j]));
    return sum;
}

void LaplaceCriterion::addThresholdGradient(std::span<const double> parameters, std::vector<double>& gradient) const
{
    const auto thresholds = thresholdsOf(parameters);
    for (std::size_t j = 1; j < m_thresholds; ++j) {
        const double slope = -2 * static_cast<double>(m_counts[j]) / std::expm1(thresholds[j] - thresholds[j - 1]);
        if (j != m_anchor) gradient[parameterOf(j)] += slope;
        if (j - 1 != m_anchor) gradient[parameterOf(j - 1)] -= slope;
    }
}

/// Mean and random effects of each answer.
std::vector<double> LaplaceCriterion::linearPredictors(std::span<const double> parameters, std::span<const double> u) const
{
    std::vector<double> effect(u.begin(), u.end());
    for (std::size_t j = 0; j < effect.size(); ++j) effect[j] *= sdOf(parameters, j);
    std::vector<double> eta(m_answers);
    for (std::size_t i = 0; i < m_answers; ++i) {
        eta[i] = parameters[m_terms + m_cellOf[i]];
        for (std::size_t t = 0; t < m_terms; ++t) eta[i] += effect[columnsOf(i)[t]];
    }
    return eta;
}

/// Z' rows.
std::vector<double> LaplaceCriterion::summedByColumn(std::span<const double> rows) const
{
    std::vector<double> sums(m_random.count());
    for (std::size_t i = 0; i < m_answers; ++i)
        for (std::size_t t = 0; t < m_terms; ++t) sums[columnsOf(i)[t]] += rows[i];
    return sums;
}

/// Computes probabilities, weights and Z'(y - p) at u. Returns -2 log p(y | u) + u'u.
double LaplaceCriterion::pass(std::span<const double> parameters, std::span<const double> u)
{
    const auto predictors = linearPredictors(parameters, u);
    const auto thresholds = thresholdsOf(parameters);
    std::vector<double> residual(m_answers);
    double logarithms = 0;
    double product = 1;
    for (std::size_t i = 0; i < m_answers; ++i) {
        m_weights[i] = 0;
        for (std::uint32_t c = m_firstChoice[i]; c < m_firstChoice[i + 1]; ++c) {
            const double eta = predictors[i] - thresholds[m_thresholdOf[c]];
            const double small = std::exp(-std::fabs(eta));
            m_probability[c] = eta < 0 ? small / (1 + small) : 1 / (1 + small);
            m_choiceWeights[c] = small / ((1 + small) * (1 + small));
            m_weights[i] += m_choiceWeights[c];
            residual[i] += m_above[c] - m_probability[c];
            if ((eta < 0) == (m_above[c] > 0.5)) logarithms += std::fabs(eta);
            product *= 1 + small;
            if (c % factorsPerLogarithm == factorsPerLogarithm - 1) {
                logarithms += std::log(product);
                product = 1;
            }
        }
    }
    m_residual = summedByColumn(residual);
    return 2 * (logarithms + std::log(product)) + thresholdTerm(parameters) + dot(u, u);
}

/// Cholesky factor of Lambda'Z'WZ Lambda + I. `weights`: one for each answer.
BorderedFactor LaplaceCriterion::information(std::span<const double> parameters, std::span<const double> weights) const
{
    std::vector<double> products;
    for (std::size_t t = 0; t < m_terms; ++t)
        for (std::size_t s = 0; s <= t; ++s) products.push_back(parameters[t] * parameters[s]);
    std::vector<double> entries(m_random.shape().entries());
    const std::uint32_t* place = m_places.data();
    for (const double weight : weights)
        for (const double product : products) entries[*place++] += weight * product;
    for (std::uint32_t j = 0; j < m_random.count(); ++j) entries[m_random.shape().place(j, j)] += 1;
    return {m_random.shape(), std::move(entries)};
}

/// Newton's method in u; a step that does not lower the value is halved. The penalised likelihood is concave.
bool LaplaceCriterion::findMode(std::span<const double> parameters, double& penalised)
{
    if (!isPossible(parameters)) return false;
    penalised = pass(parameters, m_mode);
    if (m_mode.empty()) return true;
    for (int passes = 0; passes < mostPasses; ++passes) {
        std::vector<double> slope(m_mode.size());
        for (std::size_t j = 0; j < slope.size(); ++j) slope[j] = sdOf(parameters, j) * m_residual[j] - m_mode[j];
        const BorderedFactor factor = information(parameters, m_weights);
        if (!factor.exists()) return false;
        const auto step = factor.solved(slope);
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
        if (expected < 1e-11) return true;  // the step just taken has squared this error
    }
    return false;
}

/// Adds the direct dependence of log |M| on the standard deviations. Returns the leverage of each answer: the derivative of
/// log |M| in its weight.
std::vector<double> LaplaceCriterion::addDeterminantGradient(std::span<const double> parameters,
                                                             const std::vector<double>& inverse,
                                                             std::vector<double>& gradient) const
{
    std::vector<double> leverages(m_answers);
    std::vector<double> halves(m_terms);  // half the derivative of the leverage in each standard deviation
    const std::uint32_t* place = m_places.data();
    for (std::size_t i = 0; i < m_answers; ++i) {
        std::fill(halves.begin(), halves.end(), 0.0);
        for (std::size_t t = 0; t < m_terms; ++t)
            for (std::size_t s = 0; s <= t; ++s) {
                const double entry = inverse[*place++];
                halves[t] += parameters[s] * entry;
                if (s != t) halves[s] += parameters[t] * entry;
            }
        for (std::size_t t = 0; t < m_terms; ++t) {
            leverages[i] += parameters[t] * halves[t];
            gradient[t] += 2 * m_weights[i] * halves[t];
        }
    }
    return leverages;
}

/// Gradient by the chain rule: a parameter changes the log odds of a choice directly and through the mode, and the log
/// odds change the weights in the determinant.
std::vector<double> LaplaceCriterion::gradient(std::span<const double> parameters, std::span<const double> u,
                                               const std::vector<double>& inverse, const NewtonStep& step) const
{
    std::vector<double> result(parameterCount());
    const auto leverages = addDeterminantGradient(parameters, inverse, result);
    const auto weightSlope = [&](std::uint32_t c) { return m_choiceWeights[c] * (1 - 2 * m_probability[c]); };
    std::vector<double> direct(m_answers);
    for (std::size_t i = 0; i < m_answers; ++i)
        for (std::uint32_t c = m_firstChoice[i]; c < m_firstChoice[i + 1]; ++c) direct[i] += leverages[i] * weightSlope(c);
    auto pulled = summedByColumn(direct);
    for (std::size_t j = 0; j < pulled.size(); ++j)
        pulled[j] = sdOf(parameters, j) * pulled[j] + 2 * (u[j] - sdOf(parameters, j) * m_residual[j]);
    const auto answer = step.factor.solved(pulled);

    for (std::size_t i = 0; i < m_answers; ++i) {
        double through = 0;
        for (std::size_t t = 0; t < m_terms; ++t) through += parameters[t] * answer[columnsOf(i)[t]];
        double sum = 0;
        for (std::uint32_t c = m_firstChoice[i]; c < m_firstChoice[i + 1]; ++c) {
            const double change =
                leverages[i] * weightSlope(c) - step.choiceWeights[c] * through - 2 * (m_above[c] - m_probability[c]);
            if (m_thresholdOf[c] != m_anchor) result[parameterOf(m_thresholdOf[c])] -= change;
            sum += change;
        }
        result[m_terms + m_cellOf[i]] += sum;
        for (std::size_t t = 0; t < m_terms; ++t) result[t] += sum * u[columnsOf(i)[t]];
    }
    for (std::size_t j = 0; j < answer.size(); ++j) result[m_random.termOf(j)] += answer[j] * step.residual[j];
    addThresholdGradient(parameters, result);
    return result;
}

/// Adds the determinant of the last pass. Without a step, u is the exact mode.
LaplaceCriterion::At LaplaceCriterion::finished(std::span<const double> parameters, std::span<const double> u, double penalised,
                                                const NewtonStep* step) const
{
    At result;
    const BorderedFactor factor = information(parameters, m_weights);
    if (!factor.exists()) return result;
    result.value = penalised + factor.logDeterminant();
    result.gradient =
        gradient(parameters, u, factor.inverse(), step != nullptr ? *step : NewtonStep{factor, m_choiceWeights, m_residual});
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

void LaplaceCriterion::holdMode(std::span<const double> parameters)
{
    pass(parameters, m_mode);
    m_heldPredictors = linearPredictors(parameters, m_mode);
    m_heldThresholds = thresholdsOf(parameters);
    m_heldProbability = m_probability;
    m_heldChoiceWeights = m_choiceWeights;
    m_heldWeights = m_weights;
}

LaplaceCriterion::At LaplaceCriterion::atOneStep(std::span<const double> parameters)
{
    if (!isPossible(parameters)) return {};
    const BorderedFactor factor = information(parameters, m_heldWeights);
    if (!factor.exists()) return {};
    const auto thresholds = thresholdsOf(parameters);
    // Residuals of the linearised model, first without random effects, then at the resulting u.
    const auto residual = [&](std::span<const double> u) {
        const auto predictors = linearPredictors(parameters, u);
        std::vector<double> working(m_answers);
        for (std::size_t i = 0; i < m_answers; ++i)
            for (std::uint32_t c = m_firstChoice[i]; c < m_firstChoice[i + 1]; ++c) {
                const std::uint32_t j = m_thresholdOf[c];
                const double moved = m_heldPredictors[i] - predictors[i] - m_heldThresholds[j] + thresholds[j];
                working[i] += m_heldChoiceWeights[c] * moved + m_above[c] - m_heldProbability[c];
            }
        return summedByColumn(working);
    };
    auto right = residual(std::vector<double>(m_random.count()));
    for (std::size_t j = 0; j < right.size(); ++j) right[j] *= sdOf(parameters, j);
    const auto u = factor.solved(right);
    const auto linearised = residual(u);
    const double penalised = pass(parameters, u);
    const NewtonStep step{factor, m_heldChoiceWeights, linearised};
    return finished(parameters, u, penalised, &step);
}

}  // namespace stats
