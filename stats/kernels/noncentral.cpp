#include "stats/kernels/noncentral.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <cmath>

#include "stats/kernels/quiet_policy.h"

namespace stats {
namespace {

namespace bm = boost::math;

// Below the first limit the central distribution is used, because the series need a noncentrality above 0. Above
// the other two the series have too many terms, and the approximations below are accurate enough.
constexpr double negligibleNoncentrality = 1e-12;
constexpr double largeNoncentrality = 1e4;
constexpr double largeT = 3e3;

double probability(double p) { return std::clamp(p, 0.0, 1.0); }

double chiSquaredUpperTail(double x, double df)
{
    return bm::cdf(bm::complement(bm::chi_squared_distribution<double, Quiet>(df), x));
}

double fisherUpperTail(double f, double df1, double df2)
{
    return bm::cdf(bm::complement(bm::fisher_f_distribution<double, Quiet>(df1, df2), f));
}

/// Degrees of freedom of the central chi-squared with the same two moments (Patnaik 1949).
double patnaikDegrees(double df, double noncentrality)
{
    return (df + noncentrality) * (df + noncentrality) / (df + 2 * noncentrality);
}

}  // namespace

double noncentralStudentUpper(double t, double df, double noncentrality)
{
    if (std::fabs(noncentrality) > largeT) {
        // Beside this noncentrality the normal variable in the numerator of T is negligible.
        if ((noncentrality > 0) != (t > 0)) return noncentrality > 0 ? 1 : 0;
        const double below = 1 - chiSquaredUpperTail(df * (noncentrality / t) * (noncentrality / t), df);
        return noncentrality > 0 ? below : 1 - below;
    }
    return probability(bm::cdf(bm::complement(bm::non_central_t_distribution<double, Quiet>(df, noncentrality), t)));
}

double noncentralFisherUpper(double f, double df1, double df2, double noncentrality)
{
    if (noncentrality < negligibleNoncentrality) return fisherUpperTail(f, df1, df2);
    if (noncentrality > largeNoncentrality)
        return fisherUpperTail(f * df1 / (df1 + noncentrality), patnaikDegrees(df1, noncentrality), df2);
    return probability(bm::cdf(bm::complement(bm::non_central_f_distribution<double, Quiet>(df1, df2, noncentrality), f)));
}

double noncentralChiSquaredUpper(double x, double df, double noncentrality)
{
    if (noncentrality < negligibleNoncentrality) return chiSquaredUpperTail(x, df);
    if (noncentrality > largeNoncentrality)
        return chiSquaredUpperTail(x * (df + noncentrality) / (df + 2 * noncentrality), patnaikDegrees(df, noncentrality));
    return probability(bm::cdf(bm::complement(bm::non_central_chi_squared_distribution<double, Quiet>(df, noncentrality), x)));
}

double fisherQuantile(double upperTail, double df1, double df2)
{
    return bm::quantile(bm::complement(bm::fisher_f_distribution<double, Quiet>(df1, df2), upperTail));
}

double chiSquaredQuantile(double upperTail, double df)
{
    return bm::quantile(bm::complement(bm::chi_squared_distribution<double, Quiet>(df), upperTail));
}

}  // namespace stats
