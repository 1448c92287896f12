#include "stats/models/mixed_model_balanced.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "stats/kernels/exact_sum.h"

namespace stats {
namespace {

constexpr std::size_t unknown = static_cast<std::size_t>(-1);

/// Division of the rows into classes.
struct Partition {
    std::vector<std::size_t> of;  ///< class of each row
    std::size_t classes = 0;
    std::size_t term = unknown;  ///< unknown: the mean or the condition
    bool fixed = false;
};

bool hasEqualClasses(const Partition& one)
{
    std::vector<std::size_t> sizes(one.classes);
    for (const std::size_t c : one.of) ++sizes[c];
    return std::all_of(sizes.begin(), sizes.end(), [&](std::size_t size) { return size == sizes.front(); });
}

/// True where every class of `fine` lies in one class of `coarse`.
bool isNestedIn(const Partition& fine, const Partition& coarse)
{
    if (fine.classes < coarse.classes) return false;
    std::vector<std::size_t> within(fine.classes, unknown);
    for (std::size_t row = 0; row < fine.of.size(); ++row) {
        std::size_t& known = within[fine.of[row]];
        if (known == unknown) known = coarse.of[row];
        if (known != coarse.of[row]) return false;
    }
    return true;
}

/// The pairs of classes that occur, with the number of their rows.
struct ClassPair {
    std::size_t a, b, rows;
};
std::vector<ClassPair> pairsOf(const Partition& a, const Partition& b)
{
    std::vector<std::size_t> keys(a.of.size());
    for (std::size_t row = 0; row < keys.size(); ++row) keys[row] = a.of[row] * b.classes + b.of[row];
    std::sort(keys.begin(), keys.end());
    std::vector<ClassPair> pairs;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (i == 0 || keys[i] != keys[i - 1]) pairs.push_back({keys[i] / b.classes, keys[i] % b.classes, 0});
        ++pairs.back().rows;
    }
    return pairs;
}

/// Root of the set that holds an element; shortens the way to it.
std::size_t rootOf(std::vector<std::size_t>& parents, std::size_t element)
{
    while (parents[element] != element) element = parents[element] = parents[parents[element]];
    return element;
}

/// Number of classes of the finest partition that both are nested in, if every class of one meets every class of the
/// other evenly within it; otherwise 0.
std::size_t classesOfSupremum(const Partition& a, const Partition& b)
{
    const std::vector<ClassPair> pairs = pairsOf(a, b);
    std::vector<std::size_t> parents(a.classes + b.classes);
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    for (const ClassPair& pair : pairs) parents[rootOf(parents, pair.a)] = rootOf(parents, a.classes + pair.b);
    std::vector<std::size_t> ofA(parents.size()), ofB(parents.size()), met(parents.size()), roots;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const std::size_t root = rootOf(parents, i);
        if (root == i) roots.push_back(i);
        ++(i < a.classes ? ofA : ofB)[root];
    }
    for (const ClassPair& pair : pairs) {
        ++met[rootOf(parents, pair.a)];
        if (pair.rows != pairs.front().rows) return 0;
    }
    for (const std::size_t root : roots)
        if (met[root] != ofA[root] * ofB[root]) return 0;
    return roots.size();
}

/// The mean, the condition and the terms, from coarse to fine; nothing where a class is larger than another.
std::optional<std::vector<Partition>> partitionsOf(const MixedModelRows& data)
{
    const std::size_t rows = data.y.size();
    auto condition = codedLevels(data.fixed);
    if (!condition) return {};
    const std::size_t conditions = data.fixed.columns.size();
    std::vector<Partition> all{{std::vector<std::size_t>(rows), 1, unknown, true}};
    if (conditions > 1) all.push_back({std::move(*condition), conditions, unknown, true});
    for (std::size_t t = 0; t < data.random.size(); ++t) {
        if (!data.random[t].slope.empty()) return {};
        all.push_back({data.random[t].group.of, data.random[t].group.levels.size(), t, false});
    }
    if (!std::all_of(all.begin(), all.end(), hasEqualClasses)) return {};
    std::stable_sort(all.begin() + (conditions > 1 ? 2 : 1), all.end(),
                     [](const Partition& a, const Partition& b) { return a.classes < b.classes; });
    return all;
}

/// For each partition, the others in which it is nested. Nothing where two partitions do not cross evenly, or where
/// the classes that they have in common are not a partition of the model.
std::optional<std::vector<std::vector<std::size_t>>> nestings(const std::vector<Partition>& all)
{
    std::vector<std::vector<std::size_t>> coarser(all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < all.size(); ++j)
            if (i != j && isNestedIn(all[i], all[j])) coarser[i].push_back(j);
    const auto isIn = [&](std::size_t i, std::size_t j) { return std::ranges::find(coarser[i], j) != coarser[i].end(); };
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (isIn(i, j) && isIn(j, i)) return {};  // the same partition twice
            if (isIn(i, j) || isIn(j, i)) continue;
            const std::size_t classes = classesOfSupremum(all[i], all[j]);
            const bool isThere = std::ranges::any_of(
                coarser[i], [&](std::size_t common) { return isIn(j, common) && all[common].classes == classes; });
            if (!isThere) return {};
        }
    return coarser;
}

/// Effects of the classes: their means minus the effects of all coarser partitions.
std::vector<double> effectsOf(const std::vector<double>& y, const std::vector<Partition>& all, std::size_t which,
                              const std::vector<std::size_t>& coarser, const std::vector<std::vector<double>>& known)
{
    const Partition& own = all[which];
    std::vector<double> effects(own.classes);
    std::vector<std::size_t> example(own.classes);
    for (std::size_t row = 0; row < y.size(); ++row) {
        effects[own.of[row]] += y[row];
        example[own.of[row]] = row;
    }
    const double size = static_cast<double>(y.size()) / static_cast<double>(own.classes);
    for (std::size_t c = 0; c < own.classes; ++c) {
        effects[c] /= size;
        for (const std::size_t other : coarser) effects[c] -= known[other][all[other].of[example[c]]];
    }
    return effects;
}

double squaresOf(const std::vector<double>& x)
{
    return exactSum(x.size(), [&](std::size_t i) { return x[i] * x[i]; });
}

/// Sums of squares and degrees of freedom of the strata; one for each partition, and the residual.
std::vector<Stratum> strataOf(const std::vector<double>& y, const std::vector<Partition>& all,
                              const std::vector<std::vector<std::size_t>>& coarser)
{
    std::vector<Stratum> strata;
    std::vector<std::vector<double>> effects(all.size());
    std::vector<double> rest = y;
    double degreesLeft = static_cast<double>(y.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
        effects[i] = effectsOf(y, all, i, coarser[i], effects);
        Stratum stratum;
        stratum.fixed = all[i].fixed;
        stratum.squares = squaresOf(effects[i]) * static_cast<double>(y.size()) / static_cast<double>(all[i].classes);
        stratum.degrees = static_cast<double>(all[i].classes);
        for (const std::size_t other : coarser[i]) stratum.degrees -= strata[other].degrees;
        degreesLeft -= stratum.degrees;
        strata.push_back(std::move(stratum));
        for (std::size_t row = 0; row < y.size(); ++row) rest[row] -= effects[i][all[i].of[row]];
    }
    strata.push_back({squaresOf(rest), degreesLeft, false, {}});
    return strata;
}

}  // namespace

std::optional<BalancedDesign> balancedDesign(const MixedModelRows& data)
{
    const auto all = partitionsOf(data);
    if (!all) return {};
    const auto coarser = nestings(*all);
    if (!coarser) return {};
    for (std::size_t i = 0; i < all->size(); ++i) {
        const auto isLater = [&](std::size_t other) { return other > i; };
        // A term coarser than the condition would be a fixed effect as well.
        if (std::ranges::any_of((*coarser)[i], isLater)) return {};
    }
    BalancedDesign design{data.y.size(), data.fixed.columns.size(), {}, strataOf(data.y, *all, *coarser)};
    for (const RandomTerm& term : data.random) design.levels.push_back(term.group.levels.size());
    for (std::size_t s = 0; s < design.strata.size(); ++s) {
        Stratum& stratum = design.strata[s];
        if (!(stratum.degrees > 0)) return {};
        stratum.multiples.assign(data.random.size(), 0);
        for (std::size_t i = 0; i < all->size(); ++i) {
            const bool lies = s < all->size() && (i == s || std::ranges::find((*coarser)[i], s) != (*coarser)[i].end());
            if (lies && (*all)[i].term != unknown)
                stratum.multiples[(*all)[i].term] = static_cast<double>(design.rows) / static_cast<double>((*all)[i].classes);
        }
    }
    return design;
}

BalancedEquations::BalancedEquations(const BalancedDesign& design, std::span<const std::size_t> kept)
    : MixedModelSystem(design.rows, design.conditions), m_conditions(design.conditions), m_strata(design.strata)
{
    std::size_t column = 0;
    for (const std::size_t t : kept) {
        m_terms.push_back({1, design.levels[t], column, m_terms.size()});
        column += design.levels[t];
    }
    for (Stratum& stratum : m_strata) {
        std::vector<double> multiples;
        for (const std::size_t t : kept) multiples.push_back(stratum.multiples[t]);
        stratum.multiples = std::move(multiples);
    }
}

/// Variance in each stratum, relative to the residual variance.
std::vector<double> BalancedEquations::multipliers(std::span<const double> theta) const
{
    std::vector<double> result;
    for (const Stratum& stratum : m_strata) {
        double multiplier = 1;
        for (std::size_t k = 0; k < theta.size(); ++k) multiplier += theta[k] * theta[k] * stratum.multiples[k];
        result.push_back(multiplier);
    }
    return result;
}

CriterionParts BalancedEquations::criterionAt(std::span<const double> theta) const
{
    const std::vector<double> multiplier = multipliers(theta);
    CriterionParts parts;
    parts.theta.assign(theta.begin(), theta.end());
    const auto conditions = static_cast<double>(m_conditions);
    parts.logDetFixed = conditions * std::log(static_cast<double>(rows()) / conditions);
    for (std::size_t s = 0; s < m_strata.size(); ++s) {
        const double logDet = m_strata[s].degrees * std::log(multiplier[s]);
        parts.logDetRandom += logDet;
        if (m_strata[s].fixed)
            parts.logDetFixed -= logDet;
        else
            parts.residual += m_strata[s].squares / multiplier[s];
    }
    parts.exists = parts.residual > 0 && std::isfinite(parts.residual);
    return parts;
}

/// Covariance of the treatment-coded estimates where the strata of the mean and of the condition have these variances.
Matrix BalancedEquations::fixedCovariance(double ofMean, double ofCondition) const
{
    const auto n = static_cast<double>(rows());
    const double ofOne = ofCondition * static_cast<double>(m_conditions) / n;  // variance within the condition stratum
    Matrix result(m_conditions, m_conditions);
    for (std::size_t i = 0; i < m_conditions; ++i)
        for (std::size_t j = 0; j < m_conditions; ++j)
            result(i, j) = i == 0 && j == 0   ? ofOne + (ofMean - ofCondition) / n
                           : i == 0 || j == 0 ? -ofOne
                           : i == j           ? 2 * ofOne
                                              : ofOne;
    return result;
}

VarianceDerivatives BalancedEquations::derivativesAt(std::span<const double> multiplier, bool reml) const
{
    const std::size_t n = m_terms.size();
    VarianceDerivatives result;
    result.traces.assign(n, 0);
    result.forms.assign(n, 0);
    result.traceProducts = result.formProducts = Matrix(n, n);
    for (std::size_t s = 0; s < m_strata.size(); ++s) {
        const Stratum& stratum = m_strata[s];
        const double degrees = reml && stratum.fixed ? 0 : stratum.degrees;
        const double squares = stratum.fixed ? 0 : stratum.squares / multiplier[s];
        for (std::size_t k = 0; k < n; ++k) {
            const double own = stratum.multiples[k] / multiplier[s];
            result.traces[k] += degrees * own;
            result.forms[k] += squares * own;
            for (std::size_t l = 0; l < n; ++l) {
                const double both = own * stratum.multiples[l] / multiplier[s];
                result.traceProducts(k, l) += degrees * both;
                result.formProducts(k, l) += squares * both;
            }
        }
    }
    for (std::size_t k = 0; k < n; ++k)
        result.fixedCovariance.push_back(
            fixedCovariance(m_strata[0].multiples[k], m_conditions > 1 ? m_strata[1].multiples[k] : 0));
    return result;
}

SystemSolution BalancedEquations::solutionAt(std::span<const double> theta, bool reml) const
{
    const std::vector<double> multiplier = multipliers(theta);
    SystemSolution solution;
    solution.fixed.assign(m_conditions, 0);  // the estimates are those of least squares, which were subtracted
    solution.fixedCovariance = fixedCovariance(multiplier[0], m_conditions > 1 ? multiplier[1] : 0);
    solution.derivatives = derivativesAt(multiplier, reml);
    return solution;
}

}  // namespace stats
