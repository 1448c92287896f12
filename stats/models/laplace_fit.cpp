#include "stats/models/laplace_fit.h"

#include <cmath>
#include <utility>

#include "stats/kernels/quasi_newton.h"
#include "stats/models/laplace_criterion.h"

namespace stats {
namespace {

constexpr double startSd = 0.5;
constexpr double zeroSd = 1e-3;
constexpr double largestSd = 50;  // log odds; beyond, the likelihood has no maximum

/// First guess of the inverse Hessian: about the information in the choices of each cell.
Matrix guessedInverse(const LaplaceCriterion& criterion, const std::vector<double>& right, const Factor& cells)
{
    const std::size_t terms = criterion.termCount();
    Matrix inverse(criterion.parameterCount(), criterion.parameterCount());
    for (std::size_t t = 0; t < terms; ++t) inverse(t, t) = 0.05;
    std::vector<double> rows(cells.levels.size());
    for (std::size_t row = 0; row < right.size(); ++row) rows[cells.of[row]] += 1;
    for (std::size_t c = 0; c < rows.size(); ++c) inverse(terms + c, terms + c) = 2.5 / rows[c];
    return inverse;
}

Matrix lowerRightOf(const Matrix& matrix, std::size_t from)
{
    Matrix part(matrix.rows() - from, matrix.rows() - from);
    for (std::size_t i = from; i < matrix.rows(); ++i)
        for (std::size_t j = from; j < matrix.rows(); ++j) part(i - from, j - from) = matrix(i, j);
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
    Matrix covariance;  ///< covariance of standard deviations and means; empty where the criterion is flat

    std::span<const double> sds() const { return std::span(minimum.place).first(kept.size()); }
    std::span<const double> means() const { return std::span(minimum.place).subspan(kept.size()); }
};

/// Fits, and ends with one Newton step, which squares the remaining error.
Attempt attempted(const std::vector<double>& right, const Factor& cells, const std::vector<Factor>& groups,
                  std::vector<std::size_t> kept, Curvature curvature, int& evaluations)
{
    Attempt attempt{std::move(kept), {}, {}};
    std::vector<Factor> present;
    for (const std::size_t t : attempt.kept) present.push_back(groups[t]);
    LaplaceCriterion criterion(right, cells, present);
    const auto counted = [&](LaplaceCriterion::At at) {
        ++evaluations;
        return PointOfFunction{at.exists, at.value, std::move(at.gradient)};
    };
    const SmoothFunction function = [&](std::span<const double> parameters) { return counted(criterion.at(parameters)); };
    const SmoothFunction oneStep = [&](std::span<const double> parameters) { return counted(criterion.atOneStep(parameters)); };
    std::vector<double> start(attempt.kept.size(), startSd);
    const auto means = criterion.crudeMeans();
    start.insert(start.end(), means.begin(), means.end());
    Minimum& minimum = attempt.minimum = minimised(function, start, guessedInverse(criterion, right, cells));
    if (!minimum.why.empty()) return attempt;
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

LaplaceFit laplaceFit(const std::vector<double>& right, const Factor& cells, const std::vector<Factor>& groups,
                      Curvature curvature)
{
    LaplaceFit fit;
    fit.sd.assign(groups.size(), 0);
    std::vector<std::size_t> kept;
    for (std::size_t t = 0; t < groups.size(); ++t) kept.push_back(t);
    while (true) {
        const Attempt attempt = attempted(right, cells, groups, kept, curvature, fit.evaluations);
        fit.why = attempt.minimum.why;
        for (std::size_t i = 0; i < attempt.kept.size(); ++i)
            if (std::fabs(attempt.sds()[i]) > largestSd)
                fit.why = "the random effects reproduce almost every choice: the standard deviation of " +
                          groups[attempt.kept[i]].name + " has no finite estimate";
        if (!fit.why.empty()) return fit;
        kept.clear();
        for (std::size_t i = 0; i < attempt.kept.size(); ++i)
            if (std::fabs(attempt.sds()[i]) > zeroSd) kept.push_back(attempt.kept[i]);
        if (kept.size() < attempt.kept.size()) continue;
        if (attempt.covariance.rows() == 0) {
            fit.why = "the likelihood is flat at its maximum";
            return fit;
        }
        fit.criterion = attempt.minimum.at.value;
        for (std::size_t i = 0; i < kept.size(); ++i) fit.sd[kept[i]] = std::fabs(attempt.sds()[i]);
        fit.means.assign(attempt.means().begin(), attempt.means().end());
        fit.covariance = lowerRightOf(attempt.covariance, kept.size());
        return fit;
    }
}

}  // namespace stats
