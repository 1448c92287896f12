#include "stats/models/mixed_model_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "stats/models/mixed_model_blocks.h"
#include "stats/models/mixed_model_equations.h"

namespace stats {
namespace {

/// Beyond this number of random effects a model of incomplete data is fitted by blocks of one factor.
constexpr std::size_t mostDenseEffects = 300;
constexpr std::size_t mostDenseSlopes = 5000;  // random effects where some are slopes, which have no blocks
constexpr double mostWork = 5e9;               // operations of one solution by blocks; a fit takes about ten
constexpr double smallTheta = 0.03;            // a relative SD that is compared with zero

constexpr int mostFitSteps = 200;
constexpr double suspiciousTheta = 50;       // beyond, the residual may be nothing but the end of the descent
constexpr double residualNoise = 1e-6;       // of the criterion
constexpr double negligibleDecrease = 1e-9;  // expected further decrease; the step taken then squares the error
constexpr double smallestFraction = 0.1;     // share of a standard deviation that one step may leave,
constexpr double small = 0.02;               // unless it was small already: then it may go to the floor

std::vector<bool> diagonalOf(const MixedModelSystem& system)
{
    std::vector<bool> diagonal(system.thetaCount(), true);
    for (const TermPlace& term : system.terms())
        if (term.components == 2) diagonal[term.firstTheta + 1] = false;
    return diagonal;
}

/// Theta from the method of moments: variances for which the quadratic forms equal their expectations (MINQUE at the
/// present theta). Balanced data need no more. For terms of intercepts only.
std::vector<double> momentTheta(const MixedModelSystem& system, const CriterionParts& at, const VarianceDerivatives& d)
{
    const std::size_t n = at.theta.size();
    Matrix expected(n + 1, n + 1);  // the last row and column: the residual, V = I
    std::vector<double> found = d.forms;
    found.push_back(at.residual);
    expected(n, n) = residualDegrees(system, true);
    for (std::size_t k = 0; k < n; ++k) {
        expected(k, n) = d.traces[k];
        for (std::size_t l = 0; l < n; ++l) {
            expected(k, l) = d.traceProducts(k, l);
            expected(k, n) -= at.theta[l] * at.theta[l] * d.traceProducts(k, l);
        }
        expected(n, k) = expected(k, n);
    }
    for (std::size_t k = 0; k < n; ++k) {
        const double gamma = at.theta[k] * at.theta[k];
        expected(n, n) -= gamma * (d.traces[k] + expected(k, n));
        found[n] -= gamma * d.forms[k];
    }
    const auto variances = solved(expected, found);
    std::vector<double> theta;
    for (std::size_t k = 0; k < n && !variances.empty(); ++k)
        theta.push_back(variances[n] > 0 ? std::max(small, std::sqrt(std::max(0.0, variances[k] / variances[n]))) : at.theta[k]);
    return theta;
}

/// Newton's step in the free directions. Where the criterion is concave, the step goes downhill.
std::vector<double> newtonStep(const ThetaDerivatives& at, const std::vector<bool>& free)
{
    Matrix hessian = at.hessian;
    std::vector<double> gradient = at.gradient;
    for (std::size_t i = 0; i < free.size(); ++i) {
        if (free[i]) continue;
        gradient[i] = 0;
        for (std::size_t j = 0; j < free.size(); ++j) hessian(i, j) = hessian(j, i) = i == j ? 1 : 0;
    }
    const Eigen eigen = eigenOf(hessian);
    double largest = 0;
    for (const double value : eigen.values) largest = std::max(largest, std::fabs(value));
    std::vector<double> step(free.size());
    for (std::size_t k = 0; k < free.size(); ++k) {
        const auto direction = eigen.vectors.row(k);
        const double curvature = std::max(std::fabs(eigen.values[k]), 1e-10 * largest);
        const double length = -dot(direction, gradient) / curvature;
        for (std::size_t i = 0; i < free.size(); ++i) step[i] += length * direction[i];
    }
    return step;
}

/// Newton's method for one fit.
class Descent {
public:
    Descent(const MixedModelSystem& system, bool reml) : m_system(system), m_reml(reml), m_diagonal(diagonalOf(system))
    {
        std::vector<double> start(m_diagonal.size());
        for (std::size_t i = 0; i < start.size(); ++i) start[i] = m_diagonal[i] ? 1 : 0;
        m_at = system.criterionAt(start);
    }

    ThetaFit run()
    {
        ThetaFit fit;
        if (!m_at.exists) return refused(noResidual);
        startFromMoments();
        for (; fit.steps < mostFitSteps; ++fit.steps) {
            fit.solution = m_system.solutionAt(m_at.theta, m_reml);
            const auto here = profiledDerivatives(m_system, m_at, fit.solution.derivatives, m_reml);
            fit.free = freeAt(here);
            const auto step = newtonStep(here, fit.free);
            const double decrease = -dot(here.gradient, step) / 2;
            if (std::ranges::any_of(m_at.theta, [](double theta) { return theta > largestTheta; })) return refused(noResidual);
            if (m_close || !(decrease > 0) || !descend(step, decrease)) {
                if (losesResidual()) return refused(noResidual);
                fit.parts = m_at;
                return fit;
            }
            m_close = decrease < negligibleDecrease;
        }
        return refused("the fit did not converge in " + std::to_string(mostFitSteps) + " steps");
    }

private:
    static ThetaFit refused(const char* why) { return refused(std::string(why)); }
    static ThetaFit refused(std::string why)
    {
        ThetaFit fit;
        fit.why = std::move(why);
        return fit;
    }

    /// Whether the criterion stays as it is on the way to no residual at all: it falls ever more slowly there, so the descent
    /// ends.
    bool losesResidual() const
    {
        if (std::ranges::none_of(m_at.theta, [](double theta) { return theta > suspiciousTheta; })) return false;
        std::vector<double> beyond = m_at.theta;
        for (double& theta : beyond) theta *= 2;  // much farther, rounding would hide what is asked
        const CriterionParts there = m_system.criterionAt(beyond);
        return !there.exists ||
               profiledCriterion(m_system, there, m_reml) <= profiledCriterion(m_system, m_at, m_reml) + residualNoise;
    }

    void startFromMoments()
    {
        if (std::find(m_diagonal.begin(), m_diagonal.end(), false) != m_diagonal.end()) return;
        for (int pass = 0; pass < 2; ++pass) {
            const auto derivatives = m_system.solutionAt(m_at.theta, true).derivatives;
            const auto theta = momentTheta(m_system, m_at, derivatives);
            CriterionParts next = theta.empty() ? CriterionParts{} : m_system.criterionAt(theta);
            if (!next.exists || profiledCriterion(m_system, next, m_reml) > profiledCriterion(m_system, m_at, m_reml)) return;
            m_at = std::move(next);
        }
    }

    std::vector<bool> freeAt(const ThetaDerivatives& here) const
    {
        std::vector<bool> free(m_diagonal.size(), true);
        for (std::size_t i = 0; i < free.size(); ++i)
            free[i] = !(m_diagonal[i] && m_at.theta[i] <= thetaFloor && here.gradient[i] >= 0);
        return free;
    }

    std::vector<double> moved(const std::vector<double>& step, double fraction) const
    {
        std::vector<double> theta = m_at.theta;
        for (std::size_t i = 0; i < theta.size(); ++i) {
            const double least = !m_diagonal[i] ? -HUGE_VAL : theta[i] > small ? smallestFraction * theta[i] : thetaFloor;
            theta[i] = std::max(theta[i] + fraction * step[i], least);
        }
        return theta;
    }

    /// Halves the step until the criterion falls; false where it never does.
    bool descend(const std::vector<double>& step, double decrease)
    {
        const double before = profiledCriterion(m_system, m_at, m_reml);
        const double noise = 1e-13 * std::fabs(before);
        for (double fraction = 1; fraction > 1e-9; fraction /= 2) {
            CriterionParts next = m_system.criterionAt(moved(step, fraction));
            if (!next.exists) continue;
            const double after = profiledCriterion(m_system, next, m_reml);
            if (!(after <= before - 1e-4 * fraction * decrease + noise)) continue;
            m_at = std::move(next);
            return true;
        }
        return false;
    }

    const MixedModelSystem& m_system;
    bool m_reml;
    std::vector<bool> m_diagonal;
    CriterionParts m_at;
    bool m_close = false;
};

std::size_t effectsOf(const std::vector<RandomTerm>& terms)
{
    std::size_t count = 0;
    for (const RandomTerm& term : terms) count += (term.slope.empty() ? 1 : 2) * term.group.levels.size();
    return count;
}

bool isZero(const TermPlace& term, const ThetaFit& fit) { return term.components == 1 && !fit.free[term.firstTheta]; }

}  // namespace

ThetaFit fitTheta(const MixedModelSystem& system, bool reml) { return Descent(system, reml).run(); }

ChosenSystem TermChoice::systemOf(const std::vector<std::size_t>& kept) const
{
    if (m_balanced) return {"", std::make_unique<BalancedEquations>(*m_balanced, kept)};
    std::vector<RandomTerm> terms;
    for (const std::size_t t : kept) terms.push_back(m_rows.random[t]);
    const std::size_t effects = effectsOf(terms);
    const bool slopes = std::ranges::any_of(terms, [](const RandomTerm& term) { return !term.slope.empty(); });
    if (effects <= mostDenseEffects || (slopes && effects <= mostDenseSlopes))
        return {"", std::make_unique<MixedModelEquations>(m_rows.y, m_rows.fixed, terms)};
    if (!slopes) {
        const RowBlocks blocks = cheapestBlocks(m_rows.fixed, terms);
        if (blocks.work <= mostWork) return {"", std::make_unique<BlockEquations>(m_rows.y, m_rows.fixed, terms, blocks)};
    }
    return {"the data are incomplete, and a model with " + std::to_string(effects) + " random effects then takes too long", {}};
}

FittedTerms TermChoice::fit(std::vector<std::size_t> terms) const
{
    FittedTerms result;
    result.kept = std::move(terms);
    ChosenSystem chosen = systemOf(result.kept);
    result.fit.why = chosen.why;
    if (!chosen.system) return result;
    result.system = std::move(chosen.system);
    result.fit = fitTheta(*result.system, m_reml);
    return result;
}

bool TermChoice::isTie(const TermPlace& term, const FittedTerms& fitted) const
{
    if (m_ties == Ties::LeftOut) return false;
    const VarianceDerivatives& d = fitted.fit.solution.derivatives;
    const double expected = fitted.fit.parts.residual / residualDegrees(*fitted.system, m_reml) * d.traces[term.firstTheta];
    return std::fabs(d.forms[term.firstTheta] - expected) <= tieShare * expected;
}

/// Leaves out the intercepts whose variance is at its lower bound; false where there is none.
bool TermChoice::leaveOutZeros(FittedTerms& fitted) const
{
    std::vector<std::size_t> kept, tied = fitted.tied;
    for (std::size_t i = 0; i < fitted.kept.size(); ++i) {
        const TermPlace& term = fitted.system->terms()[i];
        if (!isZero(term, fitted.fit))
            kept.push_back(fitted.kept[i]);
        else if (isTie(term, fitted))
            tied.push_back(fitted.kept[i]);
    }
    if (kept.size() == fitted.kept.size()) return false;
    fitted = fit(std::move(kept));
    fitted.tied = std::move(tied);
    return true;
}

/// Where the criterion is level at zero, Newton's method stops beside it. Leaves out a small variance without which the criterion
/// is no larger beyond its noise; false where there is none.
bool TermChoice::leaveOutLevel(FittedTerms& fitted) const
{
    const double before = profiledCriterion(*fitted.system, fitted.fit.parts, m_reml);
    for (std::size_t i = 0; i < fitted.kept.size(); ++i) {
        const TermPlace& term = fitted.system->terms()[i];
        if (term.components != 1 || fitted.fit.parts.theta[term.firstTheta] > smallTheta) continue;
        std::vector<std::size_t> others = fitted.kept;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        FittedTerms next = fit(std::move(others));
        if (!next.fit.why.empty()) continue;
        const double after = profiledCriterion(*next.system, next.fit.parts, m_reml);
        if (after > before + criterionNoise + 1e-13 * std::fabs(before)) continue;
        next.tied = fitted.tied;
        if (m_ties == Ties::Counted) next.tied.push_back(fitted.kept[i]);
        fitted = std::move(next);
        return true;
    }
    return false;
}

FittedTerms TermChoice::fitWithoutZeros() const
{
    std::vector<std::size_t> all(m_rows.random.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    FittedTerms result = fit(std::move(all));
    while (result.fit.why.empty() && (leaveOutZeros(result) || leaveOutLevel(result))) {
    }
    return result;
}

}  // namespace stats
