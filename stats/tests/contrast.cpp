#include "stats/tests/contrast.h"

#include <algorithm>
#include <cmath>

namespace stats {
namespace {

double largestMagnitude(const Moments& moments) { return std::max(std::fabs(moments.smallest), std::fabs(moments.largest)); }

/// True where all differences are the same decimal: their doubles then differ by at most two units in the last place of the
/// inputs, those of means by some more.
bool isConstantDifference(const PairedMoments& moments, const ScaledSamples& scaled)
{
    const Moments& differences = moments.differences;
    const double unit = unitInLastPlace(std::max(largestMagnitude(moments.x), largestMagnitude(moments.y)));
    const double spread = differences.largest - differences.smallest;
    if (isConstant(differences) || spread <= 2 * unit) return true;
    const auto whole = [&](std::size_t sample) { return areWhole(scaled.sample(sample), scaled.exponent()); };
    return spread <= computedNoise * unit && !(whole(0) && whole(1));
}

/// The contrast of one sample, or of the differences of pairs. `why` is left to the caller where there are two values or more.
Contrast ofOne(const Moments& moments)
{
    Contrast contrast;
    contrast.first = moments;
    if (moments.n < 2) {
        contrast.why = "needs at least 2 values";
        return contrast;
    }
    const auto n = static_cast<double>(moments.n);
    contrast.hasSpread = true;
    contrast.sd = std::sqrt(moments.variance());
    contrast.se = contrast.sd / std::sqrt(n);
    contrast.df = n - 1;
    return contrast;
}

Contrast oneSample(const ScaledSamples& scaled)
{
    const Moments moments = momentsOf(scaled.sample(0));
    Contrast contrast = ofOne(moments);
    if (contrast.hasSpread && isConstantButForRounding(moments, scaled.sample(0), scaled.exponent()))
        contrast.why = "no variation: all values are equal";
    return contrast;
}

Contrast paired(const ScaledSamples& scaled)
{
    const PairedMoments moments = pairedMomentsOf(scaled.sample(0), scaled.sample(1));
    Contrast contrast = ofOne(moments.differences);
    if (!contrast.hasSpread) {
        contrast.why = "needs at least 2 pairs";
        return contrast;
    }
    contrast.sdX = std::sqrt(moments.x.variance());
    contrast.sdY = std::sqrt(moments.y.variance());
    if (isConstantDifference(moments, scaled)) contrast.why = "no variation: all differences are equal";
    return contrast;
}

Contrast twoSamples(TKind kind, std::span<const double> x, std::span<const double> y)
{
    Contrast contrast;
    contrast.first = momentsOf(x);
    contrast.second = momentsOf(y);
    contrast.twoSamples = true;
    const auto n1 = static_cast<double>(x.size());
    const auto n2 = static_cast<double>(y.size());
    if (kind == TKind::Student) {
        if (n1 + n2 < 3) {
            contrast.why = "needs at least 3 values in the two samples";
            return contrast;
        }
        contrast.df = n1 + n2 - 2;
        contrast.sd = std::sqrt((contrast.first.squares + contrast.second.squares) / contrast.df);
        contrast.se = contrast.sd * std::sqrt(1 / n1 + 1 / n2);
    } else {
        if (n1 < 2 || n2 < 2) {
            contrast.why = "needs at least 2 values in each sample";
            return contrast;
        }
        const double v1 = contrast.first.variance() / n1;
        const double v2 = contrast.second.variance() / n2;
        contrast.se = std::sqrt(v1 + v2);
        // The Welch-Satterthwaite formula in shares of the variance, which cannot overflow.
        const double share1 = v1 / (v1 + v2);
        const double share2 = v2 / (v1 + v2);
        contrast.df = 1 / (share1 * share1 / (n1 - 1) + share2 * share2 / (n2 - 1));
    }
    contrast.hasSpread = true;
    if (isConstant(contrast.first) && isConstant(contrast.second)) contrast.why = "no variation: both samples are constant";
    return contrast;
}

}  // namespace

double Contrast::estimateMinus(double reference) const
{
    if (!twoSamples) return first.meanMinus(reference);
    return ((first.shift - second.shift) - reference) + (first.residual - second.residual);
}

Contrast contrastOf(TKind kind, const ScaledSamples& scaled)
{
    switch (kind) {
        case TKind::OneSample:
            return oneSample(scaled);
        case TKind::Paired:
            return paired(scaled);
        case TKind::Student:
        case TKind::Welch:
            return twoSamples(kind, scaled.sample(0), scaled.sample(1));
    }
    return {};
}

std::span<const double> secondOf(TKind kind, std::span<const double> y)
{
    return kind == TKind::OneSample ? std::span<const double>() : y;
}

std::string inputFault(TKind kind, std::span<const double> x, std::span<const double> y)
{
    if (kind == TKind::Paired && x.size() != y.size())
        return "the two samples are not pairs: " + std::to_string(x.size()) + " and " + std::to_string(y.size()) + " values";
    if (x.empty() || (kind != TKind::OneSample && y.empty())) return "there are no values";
    if (std::string fault = nonFiniteFault(x, "x"); !fault.empty()) return fault;
    return nonFiniteFault(secondOf(kind, y), "y");
}

}  // namespace stats
