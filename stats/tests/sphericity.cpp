#include "stats/tests/sphericity.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

using Square = std::vector<std::vector<double>>;

/// The k - 1 orthonormal Helmert contrasts of every block: condition j against the mean of those before it.
std::vector<std::vector<double>> contrastsOf(const TwoWayEffects& effects)
{
    std::vector<std::vector<double>> contrasts(effects.conditions - 1, std::vector<double>(effects.blocks));
    for (std::size_t i = 0; i < effects.blocks; ++i) {
        ExactSum before;
        for (std::size_t j = 1; j < effects.conditions; ++j) {
            before.add(effects.residualAt(i, j - 1));
            const auto count = static_cast<double>(j);
            contrasts[j - 1][i] = (before.total() - count * effects.residualAt(i, j)) / std::sqrt(count * (count + 1));
        }
    }
    return contrasts;
}

Square productsOf(const std::vector<std::vector<double>>& contrasts)
{
    Square products(contrasts.size(), std::vector<double>(contrasts.size()));
    for (std::size_t a = 0; a < contrasts.size(); ++a)
        for (std::size_t b = 0; b < contrasts.size(); ++b)
            products[a][b] = orderFreeSum(contrasts[a].size(), [&](std::size_t i) { return contrasts[a][i] * contrasts[b][i]; });
    return products;
}

/// Logarithm of the determinant of a matrix whose diagonal is 1 on average, from the pivots of its Cholesky
/// factor; empty where the matrix is singular up to rounding.
std::optional<double> logDeterminant(Square matrix)
{
    const std::size_t p = matrix.size();
    double logarithm = 0;
    for (std::size_t j = 0; j < p; ++j) {
        if (!(matrix[j][j] > 1e-14 * static_cast<double>(p * p))) return std::nullopt;
        logarithm += std::log(matrix[j][j]);
        for (std::size_t i = j + 1; i < p; ++i) {
            const double factor = matrix[i][j] / matrix[j][j];
            for (std::size_t l = j + 1; l <= i; ++l) matrix[i][l] -= factor * matrix[l][j];
        }
    }
    return logarithm;
}

MauchlyTest undefinedSphericity(const std::string& why)
{
    MauchlyTest test;
    test.why = why;
    test.w = test.chiSquared = test.df = test.pChiSquared = test.pSecondOrder = Value::undefined(why);
    return test;
}

MauchlyTest ofTwoConditions()
{
    MauchlyTest test = undefinedSphericity("two conditions are always spherical");
    test.w = 1.0;
    test.chiSquared = 0.0;
    test.df = 0.0;
    return test;
}

}  // namespace

MauchlyTest mauchlyTest(std::optional<double> logDeterminantOfW, double p, double n)
{
    if (p < 2) return ofTwoConditions();
    if (n < p) return undefinedSphericity("sphericity cannot be tested with fewer blocks than conditions");
    if (!logDeterminantOfW)
        return undefinedSphericity("some differences between conditions determine others: no sphericity to test");
    MauchlyTest test;
    const double logW = std::min(0.0, *logDeterminantOfW);
    const double rho = 1 - (2 * p * p + p + 2) / (6 * p * n);
    const double second =
        (p + 2) * (p - 1) * (p - 2) * (2 * p * p * p + 6 * p * p + 3 * p + 2) / (288 * (n * p * rho) * (n * p * rho));
    test.w = std::exp(logW);
    test.chiSquared = -n * rho * logW;
    test.df = p * (p + 1) / 2 - 1;
    const double first = chiSquaredUpper(*test.chiSquared, *test.df).p;
    test.pChiSquared = first;
    test.pSecondOrder = first + second * (chiSquaredUpper(*test.chiSquared, *test.df + 4).p - first);
    return test;
}

MauchlyTest mauchlyTest(const TwoWayEffects& effects)
{
    const auto p = static_cast<double>(effects.conditions - 1);
    const auto n = static_cast<double>(effects.blocks - 1);
    if (p < 2 || n < p) return mauchlyTest(std::nullopt, p, n);
    Square products = productsOf(contrastsOf(effects));
    double trace = 0;
    for (std::size_t j = 0; j < products.size(); ++j) trace += products[j][j];
    for (auto& row : products)
        for (double& product : row) product /= trace / p;
    return mauchlyTest(logDeterminant(products), p, n);
}

MauchlyTest mauchlyTest(const BlockTable& table)
{
    if (const std::string fault = twoWayFault(table); !fault.empty()) return undefinedSphericity(fault);
    const ScaledSamples scaled({table.values});
    const TwoWayEffects effects = twoWayEffects(scaled.sample(0), table);
    if (effects.hasNoResiduals())
        return undefinedSphericity("no error variance: the conditions differ by the same amounts in every block");
    return mauchlyTest(effects);
}

}  // namespace stats
