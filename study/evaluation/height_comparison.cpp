#include "study/evaluation/height_comparison.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "rendering/signals/roughness.h"
#include "stats/metrics/image_metrics.h"

namespace study::evaluation {

namespace {

constexpr double longestMm = 6.4;
constexpr double bandFloor = 1e-4;  // -40 dB of the strongest band: weaker bands are neither visible nor tangible
constexpr int bandCount = 15;       // third-octave bands down to 0.2 mm

cv::Mat middle(const cv::Mat& map, cv::Size size)
{
    return map(cv::Rect({(map.cols - size.width) / 2, (map.rows - size.height) / 2}, size));
}

cv::Mat asDouble(const cv::Mat& map)
{
    cv::Mat result;
    map.convertTo(result, CV_64F);
    return result;
}

stats::ImageView viewOf(const cv::Mat& map)
{
    return {{map.ptr<double>(), map.total()}, static_cast<std::size_t>(map.cols), static_cast<std::size_t>(map.rows)};
}

cv::Mat stretched(const cv::Mat& map)
{
    double low = 0, high = 0;
    cv::minMaxLoc(map, &low, &high);
    cv::Mat result = map - low;
    if (high > low) result /= high - low;
    return result;
}

/// Hann window over the inscribed circle. A separable window would weight textures by their direction.
cv::Mat roundWindow(int side)
{
    cv::Mat window(side, side, CV_64F);
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double radius = std::hypot(i - (side - 1) / 2.0, j - (side - 1) / 2.0) / (side / 2.0);
            window.at<double>(i, j) = radius < 1 ? 0.5 + 0.5 * std::cos(std::numbers::pi * radius) : 0;
        }
    return window;
}

/// Power density of the map minus its windowed mean, mm⁴, [side × side].
cv::Mat powerDensity(const cv::Mat& square, double pitchMm)
{
    const cv::Mat window = roundWindow(square.cols);
    cv::Mat values = asDouble(square), spectrum, parts[2];
    values -= cv::sum(values.mul(window))[0] / cv::sum(window)[0];
    cv::dft(values.mul(window), spectrum, cv::DFT_COMPLEX_OUTPUT);
    cv::split(spectrum, parts);
    return (parts[0].mul(parts[0]) + parts[1].mul(parts[1])) * (pitchMm * pitchMm / cv::sum(window.mul(window))[0]);
}

/// Mean power of each band. Bands are triangles over the logarithm of the frequency and overlap by half. So a spectral line moves
/// smoothly from one band to the next.
std::vector<double> bandPowersOf(const cv::Mat& square, double pitchMm)
{
    const int side = square.cols;
    if (side < 8) return {};
    const cv::Mat power = powerDensity(square, pitchMm);
    std::vector<double> sums(bandCount), weights(bandCount);
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            const double cycles = std::hypot(j <= side / 2 ? j : j - side, i <= side / 2 ? i : i - side);
            if (cycles < 1 || cycles > side / 2.0) continue;
            const double place = 3 * std::log2(cycles / (side * pitchMm) * longestMm) - 0.5;  // 0: middle of the first band
            const int below = static_cast<int>(std::floor(place));
            for (const int band : {below, below + 1}) {
                if (band < 0 || band >= bandCount) continue;
                const double weight = 1 - std::abs(place - band);
                sums[static_cast<std::size_t>(band)] += weight * power.at<double>(i, j);
                weights[static_cast<std::size_t>(band)] += weight;
            }
        }
    std::vector<double> powers;
    for (std::size_t band = 0; band < sums.size(); ++band)
        if (weights[band] > 0) powers.push_back(sums[band] / weights[band]);
    return powers;
}

stats::Value ratioOf(double generated, double measured)
{
    if (!(generated > 0 && measured > 0)) return stats::Value::undefined(flatMapWhy);
    return generated / measured;
}

/// Position in `window` at which `part` correlates best; the middle if `part` is constant. Uses a Fourier transform, because
/// stats::registeredSsim tries shifts one by one, which is too slow for a whole repeat.
cv::Point bestPlace(const cv::Mat& part, const cv::Mat& window)
{
    cv::Mat partFloat, windowFloat, correlation;
    cv::Mat(part - cv::mean(part)[0]).convertTo(partFloat, CV_32F);
    cv::Mat(window - cv::mean(window)[0]).convertTo(windowFloat, CV_32F);
    cv::Point best((window.cols - part.cols) / 2, (window.rows - part.rows) / 2);
    if (cv::norm(partFloat, cv::NORM_INF) > 0) {
        cv::matchTemplate(windowFloat, partFloat, correlation, cv::TM_CCOEFF_NORMED);
        cv::minMaxLoc(correlation, nullptr, nullptr, nullptr, &best);
    }
    return best;
}

stats::Value registered(const HeightMap& generated, const HeightMap& measured, double rangeMm)
{
    const int wide = largestSideAlongFabric(measured);
    const int side = std::min({largestSideAlongFabric(generated), wide, registeredSidePx});
    if (side < 16) return stats::Value::undefined("the maps are too small to be registered");
    // Sides of equal parity, so that the pixels of both maps lie on one lattice around the middle.
    const cv::Mat part = alongFabric(generated, side), window = alongFabric(measured, wide - (wide - side) % 2);
    const cv::Mat fitted = window(cv::Rect(bestPlace(part, window), part.size())).clone();
    return stats::ssim(viewOf(part), viewOf(fitted), rangeMm).mean;
}

}  // namespace

bool HeightMap::isFlat() const
{
    double low = 0, high = 0;
    cv::minMaxLoc(heightMm, &low, &high);
    return !(high > low);
}

HeightMap atPitch(HeightMap map, double pitchMm)
{
    const double ratio = map.pitchMm / pitchMm;
    if (std::abs(ratio - 1) < 1e-6) return map;
    const cv::Size size(std::max(1, static_cast<int>(std::lround(map.heightMm.cols * ratio))),
                        std::max(1, static_cast<int>(std::lround(map.heightMm.rows * ratio))));
    cv::Mat resized;
    cv::resize(map.heightMm, resized, size, 0, 0, ratio < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    return {resized, pitchMm, map.rotationDeg};
}

HeightFeatures heightFeatures(const HeightMap& map, int side)
{
    const int fits = std::min({side, map.heightMm.cols, map.heightMm.rows});
    const cv::Mat square = middle(map.heightMm, {fits, fits}).clone();
    const auto roughness = rendering::signals::roughnessOf(square, {map.pitchMm, map.pitchMm});
    return {bandPowersOf(square, map.pitchMm), roughness.sqMm, roughness.sdr, roughness.salMm};
}

stats::Value bandDistance(const HeightFeatures& generated, const HeightFeatures& measured)
{
    if (measured.bandPowers.empty() || generated.bandPowers.size() != measured.bandPowers.size())
        return stats::Value::undefined("the maps are too small for a spectrum, or differ in size");
    const double floor = bandFloor * *std::max_element(measured.bandPowers.begin(), measured.bandPowers.end());
    if (!(floor > 0)) return stats::Value::undefined("the measured map is flat");
    double squares = 0;
    for (std::size_t band = 0; band < measured.bandPowers.size(); ++band) {
        const double decibels = 10 * std::log10((generated.bandPowers[band] + floor) / (measured.bandPowers[band] + floor));
        squares += decibels * decibels;
    }
    return std::sqrt(squares / static_cast<double>(measured.bandPowers.size()));
}

int largestSideAlongFabric(const HeightMap& map)
{
    const double angle = map.rotationDeg * std::numbers::pi / 180;
    const double shadow = std::abs(std::cos(angle)) + std::abs(std::sin(angle));
    const double shorter = std::min(map.heightMm.cols, map.heightMm.rows);
    return static_cast<int>(std::floor((shorter - 1) / shadow)) + 1;
}

cv::Mat alongFabric(const HeightMap& map, int side)
{
    const double angle = map.rotationDeg * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle), to = (side - 1) / 2.0;
    const double x = (map.heightMm.cols - 1) / 2.0, y = (map.heightMm.rows - 1) / 2.0;
    // Maps point (u, v) on the axes of the fabric to the picture. The fabric is rotated anticlockwise, and y points down.
    const cv::Mat fromFabric = (cv::Mat_<double>(2, 3) << c, s, x - c * to - s * to, -s, c, y + s * to - c * to);
    cv::Mat turned;
    cv::warpAffine(map.heightMm, turned, fromFabric, {side, side}, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REFLECT_101);
    return asDouble(turned);
}

void compareHeights(const HeightMap& generated, const HeightFeatures& generatedFeatures, const HeightMap& measured,
                    const HeightFeatures& measuredFeatures, double rangeMm, Values& values)
{
    const cv::Size common(std::min(generated.heightMm.cols, measured.heightMm.cols),
                          std::min(generated.heightMm.rows, measured.heightMm.rows));
    const cv::Mat a = asDouble(middle(generated.heightMm, common)), b = asDouble(middle(measured.heightMm, common));
    at(values, Measure::Ssim) = stats::ssim(viewOf(a), viewOf(b), rangeMm).mean;
    const cv::Mat stretchedA = stretched(a), stretchedB = stretched(b);
    at(values, Measure::SsimNormalised) = stats::ssim(viewOf(stretchedA), viewOf(stretchedB), 1).mean;
    at(values, Measure::SsimRegistered) = registered(generated, measured, rangeMm);
    at(values, Measure::HeightSpectrum) = bandDistance(generatedFeatures, measuredFeatures);
    at(values, Measure::SqRatio) = ratioOf(generatedFeatures.sqMm, measuredFeatures.sqMm);
    at(values, Measure::SdrRatio) = ratioOf(generatedFeatures.sdr, measuredFeatures.sdr);
    at(values, Measure::SalRatio) = ratioOf(generatedFeatures.salMm, measuredFeatures.salMm);
    at(values, Measure::SqMm) = generatedFeatures.sqMm;
}

}  // namespace study::evaluation
