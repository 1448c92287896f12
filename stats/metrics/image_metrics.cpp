#include "stats/metrics/image_metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "stats/kernels/exact_sum.h"
#include "stats/metrics/ssim_rows.h"

namespace stats {
namespace {

// Size of a tile in windows. The value at the centre of a tile is subtracted from its pixels before they are
// squared. So neither an offset nor a slope over the image costs digits.
constexpr std::size_t tileWidth = ssimTileWidth;
constexpr std::size_t tileHeight = 64;
constexpr std::size_t rowsAhead = 8;  ///< between a row and the row that is fetched meanwhile

std::vector<double> weightsOf(SsimWindow window)
{
    if (window == SsimWindow::Uniform7) return std::vector<double>(7, 1.0 / 7);
    constexpr double sigma = 1.5;
    std::vector<double> weights(11);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double distance = static_cast<double>(i) - 5;
        weights[i] = std::exp(-distance * distance / (2 * sigma * sigma));
        sum += weights[i];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
}

template <typename Pixel>
std::string pixelFault(const BasicImageView<Pixel>& image, const char* which)
{
    if (countNotFinite(image.values.data(), image.values.size()) == 0) return {};
    for (std::size_t i = 0; i < image.values.size(); ++i)
        if (!std::isfinite(image.values[i]))
            return "pixel x " + std::to_string(i % image.width) + ", y " + std::to_string(i / image.width) + " of the " + which +
                   " image " + (std::isnan(image.values[i]) ? "is not a number" : "is infinite");
    return {};
}

template <typename Pixel>
std::string faultOf(const BasicImageView<Pixel>& a, const BasicImageView<Pixel>& b, double range, std::size_t window)
{
    if (a.width != b.width || a.height != b.height)
        return "the images differ in shape: " + std::to_string(a.width) + "x" + std::to_string(a.height) + " and " +
               std::to_string(b.width) + "x" + std::to_string(b.height);
    if (a.values.size() != a.width * a.height || b.values.size() != b.width * b.height)
        return "an image's size and the number of its pixels disagree";
    const std::string side = std::to_string(window);
    if (a.width < window || a.height < window) return "the images are smaller than the " + side + "x" + side + " window";
    if (!(range > 0) || !std::isfinite(range)) return "the range must be a positive number";
    return {};
}

template <typename Pixel>
std::string pixelFaultOf(const BasicImageView<Pixel>& a, const BasicImageView<Pixel>& b)
{
    if (std::string fault = pixelFault(a, "first"); !fault.empty()) return fault;
    return pixelFault(b, "second");
}

/// A rectangle of windows.
struct SsimTile {
    std::size_t left = 0;
    std::size_t top = 0;
    std::size_t width = 0;  ///< number of windows
    std::size_t height = 0;
};

/// Exponent of the largest power of two by which the pixels are multiplied.
constexpr int safeExponent(double) { return 1000; }
constexpr int safeExponent(float) { return 120; }

template <typename Pixel>
class SsimSums {
public:
    SsimSums(const BasicImageView<Pixel>& a, const BasicImageView<Pixel>& b, double range, const SsimOptions& options)
        : m_a(a), m_b(b)
    {
        const std::vector<double> weights = weightsOf(options.window);
        m_window = weights.size();
        m_weights.half = m_window / 2;
        for (std::size_t i = 0; i <= m_weights.half; ++i) m_weights.weight[i] = static_cast<Pixel>(weights[i]);
        // The product with a power of two is exact; without it, squares of 1e150 would overflow.
        const int limit = safeExponent(Pixel{});
        const double factor = std::ldexp(1.0, -std::clamp(std::ilogb(range), -limit, limit));
        const double pixels = static_cast<double>(m_window * m_window);
        m_factor = static_cast<Pixel>(factor);
        m_terms.c1 = static_cast<Pixel>(options.k1 * range * factor * (options.k1 * range * factor));
        m_terms.c2 = static_cast<Pixel>(options.k2 * range * factor * (options.k2 * range * factor));
        m_terms.momentFactor = static_cast<Pixel>(options.sampleMoments ? pixels / (pixels - 1) : 1.0);
    }

    void addTile(const SsimTile& tile)
    {
        const std::size_t centre = (tile.top + tile.height / 2) * m_a.width + tile.left + tile.width / 2;
        m_terms.shiftA = m_a.values[centre] * m_factor;
        m_terms.shiftB = m_b.values[centre] * m_factor;
        SsimColumns<Pixel> columns{};
        std::fill_n(columns.smallest, tileWidth, Pixel(1));
        std::fill_n(columns.largest, tileWidth, Pixel(-1));
        SsimRow<Pixel> sums;
        std::array<const SsimRow<Pixel>*, ssimWidestWindow> rows{};
        for (std::size_t y = 0; y < tile.height + m_window - 1; ++y) {
            filterRow(tile, y);
            if (y + 1 < m_window) continue;
            for (std::size_t i = 0; i < m_window; ++i) rows[i] = &m_rows[(y + 1 + i) % m_window];
            filterDown(rows.data(), m_weights, sums);
            addSimilarities(sums, m_terms, columns);
        }
        for (std::size_t x = 0; x < tile.width; ++x) {
            m_total.add(columns.sum[x]);
            m_smallest = std::min<double>(m_smallest, columns.smallest[x]);
            m_largest = std::max<double>(m_largest, columns.largest[x]);
        }
    }

    std::size_t window() const { return m_window; }
    double total() const { return m_total.total(); }
    double smallest() const { return m_smallest; }
    double largest() const { return m_largest; }

private:
    /// Rows of a large image lie on pages of their own, so no hardware foresees the next one.
    void fetch(std::size_t begin, std::size_t count) const
    {
        constexpr std::size_t line = 64 / sizeof(Pixel);
        if (begin + count > m_a.values.size()) return;
        for (std::size_t x = 0; x < count; x += line) {
            __builtin_prefetch(&m_a.values[begin + x]);
            __builtin_prefetch(&m_b.values[begin + x]);
        }
    }

    void filterRow(const SsimTile& tile, std::size_t y)
    {
        const std::size_t begin = (tile.top + y) * m_a.width + tile.left;
        fetch(begin + rowsAhead * m_a.width, tile.width + m_window - 1);
        const std::size_t count = tile.width + m_window - 1;
        for (std::size_t x = 0; x < count; ++x) {
            m_rowA[x] = m_a.values[begin + x] * m_factor - m_terms.shiftA;
            m_rowB[x] = m_b.values[begin + x] * m_factor - m_terms.shiftB;
        }
        filterAlong(m_rowA.data(), m_rowB.data(), m_weights, m_rows[y % m_window]);
    }

    const BasicImageView<Pixel>& m_a;
    const BasicImageView<Pixel>& m_b;
    std::size_t m_window = 0;
    SsimWeights<Pixel> m_weights{};
    SsimTerms<Pixel> m_terms{};
    Pixel m_factor = 1;
    std::array<SsimRow<Pixel>, ssimWidestWindow> m_rows{};  ///< ring of the last rows filtered
    std::array<Pixel, tileWidth + ssimWidestWindow - 1> m_rowA{};
    std::array<Pixel, tileWidth + ssimWidestWindow - 1> m_rowB{};
    ExactSum m_total;
    double m_smallest = 1;
    double m_largest = -1;
};

Ssim& refuse(Ssim& result, const std::string& why)
{
    result.why = why;
    result.mean = result.smallest = result.largest = Value::undefined(why);
    return result;
}

template <typename Pixel>
Ssim ssimOf(const BasicImageView<Pixel>& a, const BasicImageView<Pixel>& b, double range, const SsimOptions& options)
{
    Ssim result;
    const std::size_t window = weightsOf(options.window).size();
    std::string fault = faultOf(a, b, range, window);
    if (fault.empty() && !(options.k1 > 0 && options.k2 > 0)) fault = "K1 and K2 must be positive";
    if (!fault.empty()) return refuse(result, fault);
    result.windowsAcross = a.width - window + 1;
    result.windowsDown = a.height - window + 1;
    SsimSums<Pixel> sums(a, b, range, options);
    for (std::size_t top = 0; top < result.windowsDown; top += tileHeight)
        for (std::size_t left = 0; left < result.windowsAcross; left += tileWidth)
            sums.addTile(
                {left, top, std::min(tileWidth, result.windowsAcross - left), std::min(tileHeight, result.windowsDown - top)});
    // Each pixel lies in a window, and a sum with a pixel that is not finite is not a number. So most images are read once.
    if (!std::isfinite(sums.total())) {
        fault = pixelFaultOf(a, b);
        return refuse(result, fault.empty() ? "the pixels lie too far beyond the range for their squares to be written" : fault);
    }
    const auto windows = static_cast<double>(result.windowsAcross * result.windowsDown);
    result.mean = std::clamp(sums.total() / windows, -1.0, 1.0);
    result.smallest = sums.smallest();
    result.largest = sums.largest();
    return result;
}

}  // namespace

Ssim ssim(const ImageView& a, const ImageView& b, double range, const SsimOptions& options)
{
    return ssimOf(a, b, range, options);
}

Ssim ssim(const FloatImageView& a, const FloatImageView& b, double range, const SsimOptions& options)
{
    return ssimOf(a, b, range, options);
}

}  // namespace stats
