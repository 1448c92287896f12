#include "stats/kernels/quasi_newton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stats {
namespace {

constexpr int mostSearchSteps = 300;
constexpr double smallestDecrease = 1e-9;  // expected further decrease
constexpr double longestStep =
    1;  // change of a parameter: a poor guess of the curvature must not leave the valley of the minimum
constexpr double hessianStep = 1e-4;  // change of a parameter for the Hessian

/// The BFGS update of the inverse Hessian after one step.
void update(Matrix& inverse, std::span<const double> step, std::span<const double> change)
{
    const double along = dot(step, change);
    if (!(along > 1e-10 * std::sqrt(dot(step, step) * dot(change, change)))) return;
    const auto mapped = product(inverse, change);
    const double stretch = 1 + dot(change, mapped) / along;
    for (std::size_t i = 0; i < step.size(); ++i)
        for (std::size_t j = 0; j < step.size(); ++j)
            inverse(i, j) += (stretch * step[i] * step[j] - mapped[i] * step[j] - step[i] * mapped[j]) / along;
}

std::vector<double> moved(std::span<const double> place, std::span<const double> step, double fraction)
{
    std::vector<double> result(place.begin(), place.end());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += fraction * step[i];
    return result;
}

std::vector<double> downhill(const Matrix& inverse, std::span<const double> gradient)
{
    auto step = product(inverse, gradient);
    double longest = longestStep;
    for (const double x : step) longest = std::max(longest, std::fabs(x));
    for (double& x : step) x *= -longestStep / longest;
    return step;
}

class Search {
public:
    Search(const SmoothFunction& function, std::vector<double> start, Matrix inverseHessian)
        : m_function(function), m_inverse(std::move(inverseHessian)), m_place(std::move(start)), m_at(function(m_place))
    {
    }

    Minimum run()
    {
        Minimum minimum;
        minimum.why = "the fit did not converge in " + std::to_string(mostSearchSteps) + " steps";
        for (int steps = 0; m_at.exists && steps < mostSearchSteps && !minimum.why.empty(); ++steps) {
            const auto step = downhill(m_inverse, m_at.gradient);
            const double decrease = -dot(step, m_at.gradient) / 2;
            // Where no step lowers the function, only rounding error is left.
            if (decrease < smallestDecrease || !take(step, decrease)) minimum.why.clear();
        }
        minimum.place = m_place;
        minimum.at = m_at;
        return minimum;
    }

private:
    /// Halves the step until the function falls; false where it never does.
    bool take(std::span<const double> step, double decrease)
    {
        for (double fraction = 1; fraction > 1e-8; fraction /= 2) {
            auto place = moved(m_place, step, fraction);
            auto next = m_function(place);
            if (!next.exists || !(next.value <= m_at.value - 1e-4 * fraction * decrease)) continue;
            std::vector<double> taken(place.size());
            std::vector<double> change(place.size());
            for (std::size_t i = 0; i < place.size(); ++i) {
                taken[i] = place[i] - m_place[i];
                change[i] = next.gradient[i] - m_at.gradient[i];
            }
            update(m_inverse, taken, change);
            m_place = std::move(place);
            m_at = std::move(next);
            return true;
        }
        return false;
    }

    const SmoothFunction& m_function;
    Matrix m_inverse;
    std::vector<double> m_place;
    PointOfFunction m_at;
};

}  // namespace

Minimum minimised(const SmoothFunction& function, std::vector<double> start, Matrix inverseHessian)
{
    return Search(function, std::move(start), std::move(inverseHessian)).run();
}

Matrix hessianOf(const SmoothFunction& function, std::span<const double> place)
{
    const std::size_t n = place.size();
    Matrix hessian(n, n);
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<double> shift(n);
        shift[i] = hessianStep;
        const auto above = function(moved(place, shift, 1));
        const auto below = function(moved(place, shift, -1));
        if (!above.exists || !below.exists) return {};
        for (std::size_t j = 0; j < n; ++j) {
            const double second = (above.gradient[j] - below.gradient[j]) / (2 * hessianStep);
            hessian(i, j) += second / 2;
            hessian(j, i) += second / 2;
        }
    }
    return hessian;
}

}  // namespace stats
