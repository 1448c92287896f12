#include "stats/kernels/moments.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "stats/kernels/block_sums.h"
#include "stats/kernels/exact_sum.h"

namespace stats {
namespace {

// Between these exponents no square or product of two squares can leave the range of double.
constexpr int smallestSafeExponent = -200;
constexpr int largestSafeExponent = 200;

// Samples up to this length are sorted and summed with compensation: the order of the values changes no bit.
// Longer samples are summed in blocks, each about its own mean. That loses almost no digits and runs at the speed
// of the memory, but the order of the values may change the last bit.
constexpr std::size_t longestShort = 4096;
constexpr std::size_t blockLength = 1024;

double largestMagnitude(std::span<const double> x)
{
    double largest = 0;
    for (const double value : x) largest = std::max(largest, std::fabs(value));
    return largest;
}

/// True where the sum of magnitudes alone shows that no number is too large and the largest is not too small.
bool isClearlySafe(double sumOfAll, std::size_t n)
{
    return sumOfAll < std::ldexp(1.0, largestSafeExponent) && sumOfAll > std::ldexp(static_cast<double>(n), smallestSafeExponent);
}

/// number * 2^exponent; its decimal where that is beyond the range of double.
Value scaledBack(double number, int exponent)
{
    const double value = std::ldexp(number, exponent);
    if (std::isfinite(value) || !std::isfinite(number)) return value;
    std::array<char, 40> text{};
    const long double whole = std::ldexp(static_cast<long double>(number), exponent);
    const auto end = std::to_chars(text.data(), text.data() + text.size(), whole, std::chars_format::scientific, 16).ptr;
    return Value::beyondDouble({text.data(), end});
}

Moments momentsOfShort(std::span<const double> values)
{
    std::vector<double> x(values.begin(), values.end());
    std::sort(x.begin(), x.end());
    Moments moments;
    moments.n = x.size();
    const auto n = static_cast<double>(x.size());
    const double shift = exactSum(x.size(), [&](std::size_t i) { return x[i]; }) / n;
    const double sum = exactSum(x.size(), [&](std::size_t i) { return x[i] - shift; });
    const double squares = exactSum(x.size(), [&](std::size_t i) { return (x[i] - shift) * (x[i] - shift); });
    moments.shift = shift;
    moments.residual = sum / n;
    moments.squares = std::max(0.0, squares - sum * moments.residual);
    moments.smallest = x.front();
    moments.largest = x.back();
    return moments;
}

/// Combines the sums of all blocks about one common shift.
class BlockMoments {
public:
    explicit BlockMoments(std::size_t n) : m_n(n) { m_blocks.reserve(n / blockLength + 1); }

    void add(const double* x, std::size_t n) { blockSums(x, n, m_blocks.emplace_back()); }

    Moments moments() const
    {
        Moments moments;
        moments.n = m_n;
        const auto n = static_cast<double>(m_n);
        moments.shift = exactSum(m_blocks.size(), [&](std::size_t i) { return sizeOf(i) * m_blocks[i].mean; }) / n;
        const auto distance = [&](std::size_t i) {
            return (m_blocks[i].mean - moments.shift) + m_blocks[i].residual / sizeOf(i);
        };
        moments.residual = exactSum(m_blocks.size(), [&](std::size_t i) { return sizeOf(i) * distance(i); }) / n;
        const double within = exactSum(m_blocks.size(), [&](std::size_t i) {
            return m_blocks[i].squares - m_blocks[i].residual * m_blocks[i].residual / sizeOf(i);
        });
        const double between = exactSum(m_blocks.size(), [&](std::size_t i) {
            const double deviation = distance(i) - moments.residual;
            return sizeOf(i) * deviation * deviation;
        });
        moments.squares = std::max(0.0, within) + between;
        moments.smallest = m_blocks.front().smallest;
        moments.largest = m_blocks.front().largest;
        for (const BlockSums& one : m_blocks) {
            moments.smallest = std::min(moments.smallest, one.smallest);
            moments.largest = std::max(moments.largest, one.largest);
        }
        return moments;
    }

private:
    double sizeOf(std::size_t i) const { return static_cast<double>(std::min(blockLength, m_n - i * blockLength)); }

    std::size_t m_n;
    std::vector<BlockSums> m_blocks;
};

}  // namespace

ScaledSamples::ScaledSamples(std::initializer_list<std::span<const double>> samples, std::initializer_list<double> references)
    : m_samples(samples)
{
    double sum = 0;
    std::size_t n = 0;
    for (const auto& sample : m_samples) {
        sum += sumOfMagnitudes(sample.data(), sample.size());
        n += sample.size();
    }
    for (const double reference : references) sum += std::fabs(reference);
    if (isClearlySafe(sum, n + references.size())) return;
    double largest = 0;
    for (const auto& sample : m_samples) largest = std::max(largest, largestMagnitude(sample));
    for (const double reference : references) largest = std::max(largest, std::fabs(reference));
    if (largest == 0) return;
    const int exponent = std::ilogb(largest);
    if (exponent >= smallestSafeExponent && exponent <= largestSafeExponent) return;
    m_exponent = exponent;
    m_copies.reserve(m_samples.size());
    for (auto& sample : m_samples) {
        auto& copy = m_copies.emplace_back(sample.begin(), sample.end());
        for (double& value : copy) value = std::ldexp(value, -exponent);
        sample = copy;
    }
}

double ScaledSamples::scaled(double reference) const { return m_exponent == 0 ? reference : std::ldexp(reference, -m_exponent); }

Value ScaledSamples::unscaled(double number) const { return m_exponent == 0 ? Value(number) : scaledBack(number, m_exponent); }

Value ScaledSamples::unscaledSquare(double number) const { return scaledBack(number, 2 * m_exponent); }

Moments momentsOf(std::span<const double> x)
{
    if (x.size() <= longestShort) return momentsOfShort(x);
    BlockMoments blocks(x.size());
    for (std::size_t i = 0; i < x.size(); i += blockLength) blocks.add(x.data() + i, std::min(blockLength, x.size() - i));
    return blocks.moments();
}

PairedMoments pairedMomentsOf(std::span<const double> x, std::span<const double> y)
{
    if (x.size() <= longestShort) {
        std::vector<double> differences(x.size());
        subtract(x.data(), y.data(), differences.data(), x.size());
        return {momentsOfShort(x), momentsOfShort(y), momentsOfShort(differences)};
    }
    BlockMoments ofX(x.size());
    BlockMoments ofY(x.size());
    BlockMoments ofDifferences(x.size());
    std::array<double, blockLength> differences;
    for (std::size_t i = 0; i < x.size(); i += blockLength) {
        const std::size_t n = std::min(blockLength, x.size() - i);
        subtract(x.data() + i, y.data() + i, differences.data(), n);
        ofX.add(x.data() + i, n);
        ofY.add(y.data() + i, n);
        ofDifferences.add(differences.data(), n);
    }
    return {ofX.moments(), ofY.moments(), ofDifferences.moments()};
}

double unitInLastPlace(double x)
{
    const double magnitude = std::fabs(x);
    return std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude;
}

bool isConstant(const Moments& moments)
{
    const double magnitude = std::max(std::fabs(moments.smallest), std::fabs(moments.largest));
    return moments.largest - moments.smallest <= unitInLastPlace(magnitude) || moments.squares == 0;
}

std::string nonFiniteFault(std::span<const double> x, const std::string& name)
{
    if (std::isfinite(sumOfMagnitudes(x.data(), x.size()))) return {};
    const auto found = std::find_if(x.begin(), x.end(), [](double value) { return !std::isfinite(value); });
    if (found == x.end()) return {};
    return "value " + std::to_string(found - x.begin() + 1) + " of " + name +
           (std::isnan(*found) ? " is not a number" : " is infinite");
}

bool areWhole(std::span<const double> scaled, int exponent)
{
    return std::ranges::all_of(scaled, [exponent](double value) {
        const double own = std::ldexp(value, exponent);
        return own == std::floor(own);
    });
}

bool isConstantButForRounding(const Moments& moments, std::span<const double> scaled, int exponent)
{
    const double largest = std::max(std::fabs(moments.smallest), std::fabs(moments.largest));
    const double spread = moments.largest - moments.smallest;
    return isConstant(moments) || (spread <= computedNoise * unitInLastPlace(largest) && !areWhole(scaled, exponent));
}

}  // namespace stats
