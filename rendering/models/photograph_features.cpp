#include "rendering/models/photograph_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"

namespace rendering::models {

namespace {

constexpr int tileSide = 128;
constexpr int tilesAcross = 4;
constexpr int bands = 12;
constexpr double lowestFrequency = 1.0 / 32;     ///< cycles per pixel; the highest, 1/2, lies twelve third octaves above
constexpr double leastTextureDeviation = 0.003;  ///< standard deviation of grey over illumination; left by rounding to 8 bits
constexpr double leastShare = 1e-3;              ///< share of the power; the noise of the camera dominates below

/// Weights of the features in a distance. They are large for features that differ between fabrics and agree within one.
/// The spectrum characterises a weave best; dye and lamp characterise it little.
constexpr float colourWeight = 0.5F, contrastWeight = 2, skewnessWeight = 1.5F, bandWeight = 0.5F, regularityWeight = 3,
                directionWeight = 0.75F;

/// Sums over the tiles of a photograph.
struct TileSums {
    cv::Scalar colour;
    double variance = 0, cube = 0;
    cv::Mat power;                           ///< CV_64F [tileSide x tileSide]: power spectrum of grey over illumination
    std::array<cv::Vec3d, 2> tensor{};       ///< structure tensor (xx, yy, xy) at two scales
    std::array<double, 2> localCoherence{};  ///< coherence of the tensor, smoothed over a few threads
    int tiles = 0;
};

std::vector<int> tileStarts(int length)
{
    const int count = std::clamp((length + tileSide - 1) / tileSide, 1, tilesAcross);
    std::vector<int> starts;
    for (int i = 0; i < count; ++i)
        starts.push_back(count == 1 ? (length - tileSide) / 2 : (length - tileSide) * i / (count - 1));
    return starts;
}

/// Slowly varying brightness, at least one grey level: a blur over a few millimetres, computed on a small copy.
cv::Mat illumination(const cv::Mat& grey)
{
    cv::Mat small, wide;
    cv::resize(grey, small, {tileSide / 8, tileSide / 8}, 0, 0, cv::INTER_AREA);
    cv::GaussianBlur(small, small, {}, 3);
    cv::resize(small, wide, grey.size(), 0, 0, cv::INTER_CUBIC);
    return cv::max(wide, 1.0);
}

const cv::Mat& hann()
{
    static const cv::Mat window = [] {
        cv::Mat made;
        cv::createHanningWindow(made, {tileSide, tileSide}, CV_32F);
        return made;
    }();
    return window;
}

cv::Mat powerOf(const cv::Mat& texture)
{
    cv::Mat spectrum, parts[2], power;
    cv::dft(texture.mul(hann()), spectrum, cv::DFT_COMPLEX_OUTPUT);
    cv::split(spectrum, parts);
    cv::Mat(parts[0].mul(parts[0]) + parts[1].mul(parts[1])).convertTo(power, CV_64F);
    return power;
}

/// Coherence (l1 - l2) / (l1 + l2) of a structure tensor; 0 where there are no slopes.
double coherence(double xx, double yy, double xy)
{
    const double least = leastTextureDeviation * leastTextureDeviation / 4;
    return std::hypot(xx - yy, 2 * xy) / (xx + yy + least);
}

void addDirections(const cv::Mat& texture, int scale, TileSums& sums)
{
    const auto at = static_cast<std::size_t>(scale);
    const double sigma = scale == 0 ? 1 : 3;
    cv::Mat smooth, dx, dy, xx, yy, xy;
    cv::GaussianBlur(texture, smooth, {}, sigma);
    cv::Sobel(smooth, dx, CV_32F, 1, 0, 3, sigma / 8);
    cv::Sobel(smooth, dy, CV_32F, 0, 1, 3, sigma / 8);
    const double local = 3 * sigma;
    cv::GaussianBlur(dx.mul(dx), xx, {}, local);
    cv::GaussianBlur(dy.mul(dy), yy, {}, local);
    cv::GaussianBlur(dx.mul(dy), xy, {}, local);
    sums.tensor[at] += cv::Vec3d(cv::mean(xx)[0], cv::mean(yy)[0], cv::mean(xy)[0]);
    double found = 0;
    for (int y = 4; y < tileSide; y += 8)
        for (int x = 4; x < tileSide; x += 8) found += coherence(xx.at<float>(y, x), yy.at<float>(y, x), xy.at<float>(y, x));
    sums.localCoherence[at] += found / ((tileSide / 8.0) * (tileSide / 8.0));
}

void addTile(const cv::Mat& rgb, TileSums& sums)
{
    cv::Mat grey;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_32F);
    cv::Mat texture = grey / illumination(grey);
    texture -= cv::mean(texture);
    sums.colour += cv::mean(rgb);
    const cv::Mat square = texture.mul(texture);
    sums.variance += cv::mean(square)[0];
    sums.cube += cv::mean(square.mul(texture))[0];
    const cv::Mat power = powerOf(texture);
    sums.power = sums.power.empty() ? power : cv::Mat(sums.power + power);
    for (int scale = 0; scale < 2; ++scale) addDirections(texture, scale, sums);
    ++sums.tiles;
}

/// Band of each frequency bin; -1 outside all bands.
int bandOf(int row, int column)
{
    const auto cycles = [](int bin) { return static_cast<double>(bin <= tileSide / 2 ? bin : bin - tileSide) / tileSide; };
    const double frequency = std::hypot(cycles(row), cycles(column));
    if (frequency < lowestFrequency || frequency >= 0.5) return -1;
    return std::clamp(static_cast<int>(3 * std::log2(frequency / lowestFrequency)), 0, bands - 1);
}

/// Appends the logarithms of the bands' shares of the power, and that of the strongest hundredth of all bins. The latter is
/// high for regular threads and low for felt.
void appendSpectrum(const TileSums& sums, std::vector<float>& features)
{
    std::array<double, bands> inBand{};
    std::vector<double> bins;
    double total = 0;
    for (int row = 0; row < tileSide; ++row)
        for (int column = 0; column < tileSide; ++column)
            if (const int band = bandOf(row, column); band >= 0) {
                const double power = sums.power.at<double>(row, column);
                inBand[static_cast<std::size_t>(band)] += power;
                bins.push_back(power);
                total += power;
            }
    const double floor = leastShare * total + leastTextureDeviation * leastTextureDeviation * tileSide * tileSide * sums.tiles;
    for (const double power : inBand)
        features.push_back(bandWeight * static_cast<float>(std::log((power + floor) / (total + bands * floor))));
    const auto strongest = static_cast<std::ptrdiff_t>(bins.size() / 100);
    std::nth_element(bins.begin(), bins.begin() + strongest, bins.end(), std::greater<>());
    double strong = 0;
    for (auto power = bins.begin(); power != bins.begin() + strongest; ++power) strong += *power;
    features.push_back(regularityWeight * static_cast<float>(std::log((strong + 0.01 * floor) / (total + floor))));
}

std::vector<float> featuresOf(const TileSums& sums)
{
    const double tiles = sums.tiles;
    const cv::Scalar colour = sums.colour / (255 * tiles);
    const double deviation = std::sqrt(sums.variance / tiles) + leastTextureDeviation;
    std::vector<float> features{colourWeight * static_cast<float>((colour[0] + colour[1] + colour[2]) / 3),
                                colourWeight * static_cast<float>(colour[0] - colour[1]),
                                colourWeight * static_cast<float>((colour[0] + colour[1]) / 2 - colour[2]),
                                contrastWeight * static_cast<float>(std::log(deviation)),
                                skewnessWeight * static_cast<float>(std::tanh(sums.cube / tiles / std::pow(deviation, 3)))};
    appendSpectrum(sums, features);
    for (std::size_t scale = 0; scale < 2; ++scale) {
        const cv::Vec3d tensor = sums.tensor[scale] / tiles;
        features.push_back(directionWeight * static_cast<float>(coherence(tensor[0], tensor[1], tensor[2])));
        features.push_back(directionWeight * static_cast<float>(sums.localCoherence[scale] / tiles));
    }
    return features;
}

}  // namespace

std::vector<float> photographFeatures(const cv::Mat& rgb)
{
    if (rgb.empty() || rgb.type() != CV_8UC3)
        throw protocols::badInput(
            {"the photograph is empty or not 8-bit RGB", "photograph", "8-bit RGB", "convert it to 8-bit RGB"});
    cv::Mat wide = rgb;
    if (rgb.rows < tileSide || rgb.cols < tileSide) {
        const int below = std::max(0, tileSide - rgb.rows), right = std::max(0, tileSide - rgb.cols);
        const cv::Rect used(0, 0, std::min(rgb.cols, 1 << 15), std::min(rgb.rows, 1 << 15));
        cv::copyMakeBorder(rgb(used), wide, below / 2, below - below / 2, right / 2, right - right / 2,
                           cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
    }
    TileSums sums;
    for (const int y : tileStarts(wide.rows))
        for (const int x : tileStarts(wide.cols)) addTile(wide({x, y, tileSide, tileSide}), sums);
    return featuresOf(sums);
}

}  // namespace rendering::models
