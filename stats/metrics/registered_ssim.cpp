#include "stats/metrics/registered_ssim.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "stats/kernels/moments.h"

namespace stats {
namespace {

struct Shift {
    int right = 0;
    int down = 0;

    int length() const { return right * right + down * down; }
};

/// The pixels of a and b that lie on each other when b is moved back by the shift.
struct Overlap {
    std::size_t width = 0;
    std::size_t height = 0;
    std::size_t leftA = 0, topA = 0;
    std::size_t leftB = 0, topB = 0;
};

Overlap overlapOf(std::size_t width, std::size_t height, const Shift& shift)
{
    const auto size = [](int x) { return static_cast<std::size_t>(std::abs(x)); };
    Overlap overlap{width - size(shift.right), height - size(shift.down)};
    (shift.right > 0 ? overlap.leftB : overlap.leftA) = size(shift.right);
    (shift.down > 0 ? overlap.topB : overlap.topA) = size(shift.down);
    return overlap;
}

/// Pearson's, of images about their means; none without variation.
std::optional<double> correlationOf(const std::vector<double>& a, const std::vector<double>& b, std::size_t width,
                                    const Overlap& overlap)
{
    double sumA = 0, sumB = 0, squaresA = 0, squaresB = 0, products = 0;
    for (std::size_t y = 0; y < overlap.height; ++y) {
        const double* rowA = &a[(overlap.topA + y) * width + overlap.leftA];
        const double* rowB = &b[(overlap.topB + y) * width + overlap.leftB];
        for (std::size_t x = 0; x < overlap.width; ++x) {
            sumA += rowA[x];
            sumB += rowB[x];
            squaresA += rowA[x] * rowA[x];
            squaresB += rowB[x] * rowB[x];
            products += rowA[x] * rowB[x];
        }
    }
    const auto n = static_cast<double>(overlap.width * overlap.height);
    const double varianceA = squaresA - sumA * sumA / n;
    const double varianceB = squaresB - sumB * sumB / n;
    if (!(varianceA > 1e-13 * squaresA) || !(varianceB > 1e-13 * squaresB)) return std::nullopt;
    return (products - sumA * sumB / n) / std::sqrt(varianceA * varianceB);
}

std::vector<double> aboutMean(std::span<const double> scaled)
{
    const Moments moments = momentsOf(scaled);
    std::vector<double> result(scaled.begin(), scaled.end());
    for (double& x : result) x = (x - moments.shift) - moments.residual;
    return result;
}

std::vector<double> cut(const ImageView& image, std::size_t left, std::size_t top, const Overlap& overlap)
{
    std::vector<double> pixels;
    pixels.reserve(overlap.width * overlap.height);
    for (std::size_t y = 0; y < overlap.height; ++y) {
        const auto row = image.values.subspan((top + y) * image.width + left, overlap.width);
        pixels.insert(pixels.end(), row.begin(), row.end());
    }
    return pixels;
}

struct FoundShift {
    Shift shift;
    double correlation = 0;
};

/// The shift of the largest correlation; of equal ones the shortest. None where no overlap varies.
std::optional<FoundShift> bestShift(const ImageView& a, const ImageView& b, int most)
{
    const ScaledSamples scaled({a.values, b.values});
    const auto centredA = aboutMean(scaled.sample(0));
    const auto centredB = aboutMean(scaled.sample(1));
    std::optional<FoundShift> best;
    for (int down = -most; down <= most; ++down)
        for (int right = -most; right <= most; ++right) {
            const Shift shift{right, down};
            const auto found = correlationOf(centredA, centredB, a.width, overlapOf(a.width, a.height, shift));
            const bool isBetter = found && (!best || *found > best->correlation ||
                                            (*found == best->correlation && shift.length() < best->shift.length()));
            if (isBetter) best = FoundShift{shift, *found};
        }
    return best;
}

RegisteredSsim& refuse(RegisteredSsim& result, const std::string& why)
{
    result.why = why;
    result.ssim = result.correlation = Value::undefined(why);
    return result;
}

}  // namespace

RegisteredSsim registeredSsim(const ImageView& a, const ImageView& b, double range, int mostShift, const SsimOptions& options)
{
    RegisteredSsim result;
    const Ssim plain = ssim(a, b, range, options);
    result.ssimUnregistered = plain.mean;
    if (!plain.why.empty()) return refuse(result, plain.why);
    if (mostShift < 0) return refuse(result, "the largest shift cannot be negative");
    const auto most = static_cast<std::size_t>(mostShift);
    if (most >= plain.windowsAcross || most >= plain.windowsDown)
        return refuse(result, "a shift of " + std::to_string(mostShift) + " pixels leaves less than a window");
    const auto best = bestShift(a, b, mostShift);
    if (!best) return refuse(result, "an image without variation cannot be registered");
    const Overlap overlap = overlapOf(a.width, a.height, best->shift);
    const auto cutA = cut(a, overlap.leftA, overlap.topA, overlap);
    const auto cutB = cut(b, overlap.leftB, overlap.topB, overlap);
    result.right = best->shift.right;
    result.down = best->shift.down;
    result.correlation = best->correlation;
    result.ssim =
        ssim(ImageView{cutA, overlap.width, overlap.height}, ImageView{cutB, overlap.width, overlap.height}, range, options).mean;
    return result;
}

}  // namespace stats
