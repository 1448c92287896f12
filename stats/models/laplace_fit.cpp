#include "stats/models/laplace_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "stats/kernels/quasi_newton.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

constexpr double startSd = 0.5;
constexpr double farStartSd = 4;         // of the second search
constexpr std::size_t fewAnswers = 200;  // the likelihood of more has had one maximum
constexpr double zeroSd = 1e-3;
constexpr double smallSd = 0.1;          // a standard deviation that is compared with zero
constexpr double levelCriterion = 2e-8;  // a group that lowers the criterion by less adds nothing
constexpr double largestSd = 50;         // log odds; beyond, the likelihood has no maximum

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

std::vector<double> crudeStart(const LaplaceCriterion& criterion, double sd)
{
    std::vector<double> start(criterion.termCount(), sd);
    const auto fixed = criterion.crudeStart();
    start.insert(start.end(), fixed.begin(), fixed.end());
    return start;
}

bool isZeroSd(double sd) { return std::fabs(sd) <= zeroSd; }

/// Where a search begins: parameters of an earlier fit, or, where there are none, crude values and these standard deviations.
struct SearchStart {
    std::vector<double> parameters;
    double sd = startSd;
};

/// Fits, and ends with one Newton step, which squares the remaining error. Where a standard deviation is zero, it ends at the
/// minimum: the fit without that group replaces this one.
Attempt attempted(const OrderedAnswers& whole, std::vector<std::size_t> kept, const SearchStart& from, Curvature curvature,
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
    std::vector<double> start = from.parameters.empty() ? crudeStart(criterion, from.sd) : from.parameters;
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

/// The fit without one of its groups where its standard deviation is small and adds nothing; otherwise nothing. The criterion is
/// level at zero where answers agree with chance exactly, and the search stops beside it.
std::optional<Attempt> withoutLevelGroup(const OrderedAnswers& answers, const Attempt& attempt, Curvature curvature,
                                         int& evaluations)
{
    for (std::size_t i = 0; i < attempt.kept.size(); ++i) {
        if (std::fabs(attempt.sds()[i]) > smallSd) continue;
        std::vector<std::size_t> others = attempt.kept;
        std::vector<double> start = attempt.minimum.place;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        start.erase(start.begin() + static_cast<std::ptrdiff_t>(i));
        Attempt other = attempted(answers, std::move(others), {std::move(start)}, curvature, evaluations);
        if (other.minimum.why.empty() && other.minimum.at.value <= attempt.minimum.at.value + levelCriterion) return other;
    }
    return {};
}

/// Groups whose standard deviation is not zero, and the parameters of a search with these alone.
std::pair<std::vector<std::size_t>, SearchStart> withoutZeros(const Attempt& attempt)
{
    std::pair<std::vector<std::size_t>, SearchStart> next;
    std::vector<double>& start = next.second.parameters;
    for (std::size_t i = 0; i < attempt.kept.size(); ++i) {
        if (isZeroSd(attempt.sds()[i])) continue;
        next.first.push_back(attempt.kept[i]);
        start.push_back(attempt.sds()[i]);
    }
    const auto fixed = attempt.fixed();
    start.insert(start.end(), fixed.begin(), fixed.end());
    return next;
}

/// One search for a maximum with some of the groups. `criterion` is set wherever a minimum was found.
LaplaceFit searched(const OrderedAnswers& answers, std::vector<std::size_t> kept, double sd, Curvature curvature)
{
    LaplaceFit fit;
    fit.sd.assign(answers.groups.size(), 0);
    fit.criterion = HUGE_VAL;
    Attempt attempt = attempted(answers, std::move(kept), {{}, sd}, curvature, fit.evaluations);
    while (true) {
        fit.why = attempt.minimum.why;
        if (attempt.minimum.place.empty()) return fit;
        fit.criterion = attempt.minimum.at.value;
        for (std::size_t i = 0; i < attempt.kept.size(); ++i)
            if (std::fabs(attempt.sds()[i]) > largestSd)
                fit.why = "the random effects reproduce almost every choice: the standard deviation of " +
                          answers.groups[attempt.kept[i]].name + " has no finite estimate";
        if (!fit.why.empty()) return fit;
        if (auto [others, start] = withoutZeros(attempt); others.size() < attempt.kept.size()) {
            attempt = attempted(answers, std::move(others), start, curvature, fit.evaluations);
            continue;
        }
        auto level = withoutLevelGroup(answers, attempt, curvature, fit.evaluations);
        if (!level) break;
        attempt = std::move(*level);
    }
    if (attempt.covariance.rows() == 0) {
        fit.why = "the likelihood is flat at its maximum";
        return fit;
    }
    for (std::size_t i = 0; i < attempt.kept.size(); ++i) fit.sd[attempt.kept[i]] = std::fabs(attempt.sds()[i]);
    const auto fixed = attempt.fixed();
    const std::size_t cells = answers.cells.levels.size();
    fit.means.assign(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(cells));
    fit.thresholds.assign(fixed.begin() + static_cast<std::ptrdiff_t>(cells), fixed.end());
    fit.thresholds.insert(fit.thresholds.begin() + static_cast<std::ptrdiff_t>(attempt.anchor), 0.0);
    fit.covariance = withAnchor(attempt.covariance, attempt.kept.size(), cells + attempt.anchor);
    return fit;
}

}  // namespace

LaplaceFit laplaceFit(const OrderedAnswers& answers, Curvature curvature)
{
    // Of groups that divide the answers in the same way only the sum of the variances is known.
    std::vector<std::size_t> kept, unknown;
    for (std::size_t t = 0; t < answers.groups.size(); ++t) {
        const auto same =
            std::ranges::find_if(kept, [&](std::size_t other) { return divideAlike(answers.groups[other], answers.groups[t]); });
        if (same == kept.end())
            kept.push_back(t);
        else
            unknown.insert(unknown.end(), {*same, t});
    }
    LaplaceFit fit = searched(answers, kept, startSd, curvature);
    if (answers.category.size() <= fewAnswers && !kept.empty()) {
        LaplaceFit far = searched(answers, kept, farStartSd, curvature);
        far.evaluations += fit.evaluations;
        fit.evaluations = far.evaluations;
        if (far.criterion < fit.criterion - levelCriterion) fit = std::move(far);
    }
    for (const std::size_t t : unknown) fit.sd[t] = std::numeric_limits<double>::quiet_NaN();
    return fit;
}

}  // namespace stats
