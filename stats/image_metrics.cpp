#include "stats/image_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "stats/exact_sum.h"

namespace stats {
namespace {

constexpr std::size_t window = 11;
constexpr double sigma = 1.5;
constexpr double k1 = 0.01;
constexpr double k2 = 0.03;
// Output pixels of a tile. Each tile is shifted by its own centre before squares are taken, so that
// neither an offset nor a slope over the image costs digits.
constexpr std::size_t tileWidth = 64;
constexpr std::size_t tileHeight = 32;
constexpr std::size_t patchHeight = tileHeight + window - 1;

std::array<double, window> gaussian()
{
    std::array<double, window> weights{};
    double sum = 0;
    for (std::size_t i = 0; i < window; ++i) {
        const double distance = static_cast<double>(i) - static_cast<double>(window / 2);
        weights[i] = std::exp(-distance * distance / (2 * sigma * sigma));
        sum += weights[i];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

std::string pixelFault(const ImageView& image, const char* which)
{
    for (std::size_t i = 0; i < image.values.size(); ++i)
        if (!std::isfinite(image.values[i]))
            return "pixel x " + std::to_string(i % image.width) + ", y " + std::to_string(i / image.width) + " of the " + which +
                   " image " + (std::isnan(image.values[i]) ? "is not a number" : "is infinite");
    return {};
}

std::string faultOf(const ImageView& a, const ImageView& b, double range)
{
    if (a.width != b.width || a.height != b.height)
        return "the images differ in shape: " + std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
               std::to_string(b.width) + "x" + std::to_string(b.height);
    if (a.values.size() != a.width * a.height || b.values.size() != b.width * b.height)
        return "an image's size and the number of its pixels disagree";
    if (a.width < window || a.height < window) return "the images are smaller than the 11x11 window";
    if (!(range > 0) || !std::isfinite(range)) return "the range must be a positive number";
    if (std::string fault = pixelFault(a, "first"); !fault.empty()) return fault;
    return pixelFault(b, "second");
}

using Row = std::array<double, tileWidth>;

/// The five weighted sums of a tile: a, b, a^2, b^2, ab.
enum Quantity : std::size_t { A, B, AA, BB, AB, Quantities };

struct Tile {
    std::size_t left = 0;
    std::size_t top = 0;
    std::size_t width = 0;  ///< of its windows
    std::size_t height = 0;
};

class SsimSums {
public:
    SsimSums(const ImageView& a, const ImageView& b, double range) : m_a(a), m_b(b), m_weights(gaussian())
    {
        // A power of two near the range: exact, and keeps squares of 1e150 from overflowing.
        m_factor = std::ldexp(1.0, -std::clamp(std::ilogb(range), -1000, 1000));
        const double scaledRange = range * m_factor;
        m_c1 = (k1 * scaledRange) * (k1 * scaledRange);
        m_c2 = (k2 * scaledRange) * (k2 * scaledRange);
    }

    void addTile(const Tile& tile)
    {
        const std::size_t centre = (tile.top + tile.height / 2) * m_a.width + tile.left + tile.width / 2;
        m_shiftA = m_a.values[centre] * m_factor;
        m_shiftB = m_b.values[centre] * m_factor;
        for (std::size_t y = 0; y < tile.height + window - 1; ++y) filterRow(tile, y);
        for (std::size_t y = 0; y < tile.height; ++y) addRow(tile, y);
    }

    double total() const { return m_total.total(); }
    double smallest() const { return m_smallest; }
    double largest() const { return m_largest; }

private:
    void filterRow(const Tile& tile, std::size_t y)
    {
        std::array<double, tileWidth + window - 1> a;
        std::array<double, tileWidth + window - 1> b;
        const std::size_t begin = (tile.top + y) * m_a.width + tile.left;
        const std::size_t count = tile.width + window - 1;
        for (std::size_t x = 0; x < count; ++x) {
            a[x] = m_a.values[begin + x] * m_factor - m_shiftA;
            b[x] = m_b.values[begin + x] * m_factor - m_shiftB;
        }
        std::array<Row, Quantities> sums{};
        for (std::size_t i = 0; i < window; ++i) {
            const double weight = m_weights[i];
            for (std::size_t x = 0; x < tile.width; ++x) {
                const double p = a[x + i];
                const double q = b[x + i];
                sums[A][x] += weight * p;
                sums[B][x] += weight * q;
                sums[AA][x] += weight * (p * p);
                sums[BB][x] += weight * (q * q);
                sums[AB][x] += weight * (p * q);
            }
        }
        m_rows[y] = sums;
    }

    void addRow(const Tile& tile, std::size_t y)
    {
        std::array<Row, Quantities> sums{};
        for (std::size_t i = 0; i < window; ++i)
            for (std::size_t quantity = 0; quantity < Quantities; ++quantity)
                for (std::size_t x = 0; x < tile.width; ++x) sums[quantity][x] += m_weights[i] * m_rows[y + i][quantity][x];
        for (std::size_t x = 0; x < tile.width; ++x) {
            const double varianceA = std::max(0.0, sums[AA][x] - sums[A][x] * sums[A][x]);
            const double varianceB = std::max(0.0, sums[BB][x] - sums[B][x] * sums[B][x]);
            const double most = (varianceA + varianceB) / 2;
            const double covariance = std::clamp(sums[AB][x] - sums[A][x] * sums[B][x], -most, most);
            const double meanA = m_shiftA + sums[A][x];
            const double meanB = m_shiftB + sums[B][x];
            const double value = std::clamp((2 * (meanA * meanB) + m_c1) / (meanA * meanA + meanB * meanB + m_c1) *
                                                ((2 * covariance + m_c2) / (varianceA + varianceB + m_c2)),
                                            -1.0, 1.0);
            m_total.add(value);
            m_smallest = std::min(m_smallest, value);
            m_largest = std::max(m_largest, value);
        }
    }

    const ImageView& m_a;
    const ImageView& m_b;
    std::array<double, window> m_weights;
    std::vector<std::array<Row, Quantities>> m_rows{patchHeight};
    double m_factor = 1;
    double m_c1 = 0;
    double m_c2 = 0;
    double m_shiftA = 0;
    double m_shiftB = 0;
    ExactSum m_total;
    double m_smallest = 1;
    double m_largest = -1;
};

}  // namespace

Ssim ssim(const ImageView& a, const ImageView& b, double range)
{
    Ssim result;
    result.why = faultOf(a, b, range);
    if (!result.why.empty()) {
        result.mean = result.smallest = result.largest = Value::undefined(result.why);
        return result;
    }
    result.windowsAcross = a.width - window + 1;
    result.windowsDown = a.height - window + 1;
    SsimSums sums(a, b, range);
    for (std::size_t top = 0; top < result.windowsDown; top += tileHeight)
        for (std::size_t left = 0; left < result.windowsAcross; left += tileWidth)
            sums.addTile(
                {left, top, std::min(tileWidth, result.windowsAcross - left), std::min(tileHeight, result.windowsDown - top)});
    if (!std::isfinite(sums.total())) {
        result.why = "the pixels lie too far beyond the range for their squares to be written as doubles";
        result.mean = result.smallest = result.largest = Value::undefined(result.why);
        return result;
    }
    const auto windows = static_cast<double>(result.windowsAcross * result.windowsDown);
    result.mean = std::clamp(sums.total() / windows, -1.0, 1.0);
    result.smallest = sums.smallest();
    result.largest = sums.largest();
    return result;
}

}  // namespace stats
