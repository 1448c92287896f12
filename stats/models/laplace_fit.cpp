#include "stats/models/laplace_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stats/kernels/quasi_newton.h"

namespace stats {
namespace {

constexpr double startSd = 0.5;
constexpr double zeroSd = 1e-3;
constexpr double largestSd = 50;  // log odds; beyond, the likelihood has no maximum

/// First guess of the inverse Hessian: about the information in the choices of each cell and at each threshold.
Matrix guessedInverse(const LaplaceCriterion& criterion)
{
    const std::size_t terms = criterion.termCount();
    Matrix inverse(criterion.parameterCount(), criterion.parameterCount());
    for (std::size_t t = 0; t < terms; ++t) inverse(t, t) = 0.05;
    const auto variances = criterion.crudeVariances();
    for (std::size_t i = 0; i < variances.size(); ++i) inverse(terms + i, terms + i) = variances[i];
    return inverse;
}

/// The part from `from` on, with a row and a column of zeros at `anchor`.
Matrix withAnchor(const Matrix& matrix, std::size_t from, std::size_t anchor)
{
    const std::size_t n = matrix.rows() - from + 1;
    Matrix part(n, n);
    const auto place = [&](std::size_t i) { return from + i - (i > anchor ? 1 : 0); };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            if (i != anchor && j != anchor) part(i, j) = matrix(place(i), place(j));
    return part;
}

/// Twice the inverse of the Hessian of -2 log likelihood; empty where that is not positive.
Matrix covarianceFrom(Matrix hessian)
{
    const std::size_t n = hessian.rows();
    if (factorise(hessian) < n) return {};
    Matrix covariance = inverseFrom(inverseOfTransposed(hessian, n), n);
    for (std::size_t i = 0; i < n; ++i)
        for (double& x : covariance.row(i)) x *= 2;
    return covariance;
}

/// A fit with some of the groups.
struct Attempt {
    std::vector<std::size_t> kept;  ///< groups in this fit
    Minimum minimum;
    std::size_t anchor = 0;
    Matrix covariance;  ///< covariance of all parameters; empty where the criterion is flat

    std::span<const double> sds() const { return std::span(minimum.place).first(kept.size()); }
    /// Means of the cells, then thresholds without the anchor.
    std::span<const double> fixed() const { return std::span(minimum.place).subspan(kept.size()); }
};

std::string costText(double cost)
{
    return std::to_string(static_cast<long long>(std::ceil(cost / 1e6))) + " million multiplications";
}

std::vector<double> crudeStart(const LaplaceCriterion& criterion)
{
    std::vector<double> start(criterion.termCount(), startSd);
    const auto fixed = criterion.crudeStart();
    start.insert(start.end(), fixed.begin(), fixed.end());
    return start;
}

bool isZeroSd(double sd) { return std::fabs(sd) <= zeroSd; }

/// Fits, and ends with one Newton step, which squares the remaining error. Without a `start` it begins at crude values. Where a
/// standard deviation is zero, it ends at the minimum: the fit without that group replaces this one.
Attempt attempted(const OrderedAnswers& whole, std::vector<std::size_t> kept, std::vector<double> start, Curvature curvature,
                  int& evaluations)
{
    Attempt attempt{std::move(kept), {}, 0, {}};
    OrderedAnswers answers{whole.categories, whole.category, whole.cells, {}};
    for (const std::size_t t : attempt.kept) answers.groups.push_back(whole.groups[t]);
    LaplaceCriterion criterion(answers);
    attempt.anchor = criterion.anchor();
    if (criterion.cost() > mostLaplaceCost) {
        attempt.minimum.why = "one step of the fit would take " + costText(criterion.cost()) + "; at most " +
                              costText(mostLaplaceCost) + " are done";
        return attempt;
    }
    const auto counted = [&](LaplaceCriterion::At at) {
        ++evaluations;
        return PointOfFunction{at.exists, at.value, std::move(at.gradient)};
    };
    const SmoothFunction function = [&](std::span<const double> parameters) { return counted(criterion.at(parameters)); };
    const SmoothFunction oneStep = [&](std::span<const double> parameters) { return counted(criterion.atOneStep(parameters)); };
    if (start.empty()) start = crudeStart(criterion);
    Minimum& minimum = attempt.minimum = minimised(function, std::move(start), guessedInverse(criterion));
    if (!minimum.why.empty() || std::any_of(attempt.sds().begin(), attempt.sds().end(), isZeroSd)) return attempt;
    function(minimum.place);
    criterion.holdMode(minimum.place);
    attempt.covariance = covarianceFrom(hessianOf(curvature == Curvature::AtOneStep ? oneStep : function, minimum.place));
    if (attempt.covariance.rows() == 0) return attempt;
    auto place = minimum.place;
    const auto step = product(attempt.covariance, minimum.at.gradient);
    for (std::size_t i = 0; i < place.size(); ++i) place[i] -= step[i] / 2;
    if (auto at = function(place); at.exists && at.value <= minimum.at.value) minimum = {"", std::move(place), std::move(at)};
    return attempt;
}

}  // namespace

LaplaceFit laplaceFit(const OrderedAnswers& answers, Curvature curvature)
{
    LaplaceFit fit;
    fit.sd.assign(answers.groups.size(), 0);
    std::vector<std::size_t> kept;
    for (std::size_t t = 0; t < answers.groups.size(); ++t) kept.push_back(t);
    std::vector<double> start;
    while (true) {
        const Attempt attempt = attempted(answers, kept, start, curvature, fit.evaluations);
        fit.why = attempt.minimum.why;
        if (attempt.minimum.place.empty()) return fit;
        for (std::size_t i = 0; i < attempt.kept.size(); ++i)
            if (std::fabs(attempt.sds()[i]) > largestSd)
                fit.why = "the random effects reproduce almost every choice: the standard deviation of " +
                          answers.groups[attempt.kept[i]].name + " has no finite estimate";
        if (!fit.why.empty()) return fit;
        kept.clear();
        start.clear();
        for (std::size_t i = 0; i < attempt.kept.size(); ++i) {
            if (isZeroSd(attempt.sds()[i])) continue;
            kept.push_back(attempt.kept[i]);
            start.push_back(attempt.sds()[i]);
        }
        const auto fixed = attempt.fixed();
        start.insert(start.end(), fixed.begin(), fixed.end());
        if (kept.size() < attempt.kept.size()) continue;
        if (attempt.covariance.rows() == 0) {
            fit.why = "the likelihood is flat at its maximum";
            return fit;
        }
        fit.criterion = attempt.minimum.at.value;
        for (std::size_t i = 0; i < kept.size(); ++i) fit.sd[kept[i]] = std::fabs(attempt.sds()[i]);
        const std::size_t cells = answers.cells.levels.size();
        fit.means.assign(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(cells));
        fit.thresholds.assign(fixed.begin() + static_cast<std::ptrdiff_t>(cells), fixed.end());
        fit.thresholds.insert(fit.thresholds.begin() + static_cast<std::ptrdiff_t>(attempt.anchor), 0.0);
        fit.covariance = withAnchor(attempt.covariance, kept.size(), cells + attempt.anchor);
        return fit;
    }
}

}  // namespace stats
