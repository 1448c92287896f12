#include "rendering/signals/shape_from_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "rendering/signals/grey.h"

namespace rendering::signals {

namespace {

/// Waves longer than `longestPx` or half the image, by a Gaussian filter that passes half of a wave of that length (ISO
/// 16610-21).
cv::Mat slowPart(const cv::Mat& values, double longestPx)
{
    const double length = std::min(longestPx, std::max(2.0, std::min(values.rows, values.cols) / 2.0));
    const double sigma = length * std::sqrt(std::log(2.0) / 2) / std::numbers::pi;
    cv::Mat slow;
    cv::GaussianBlur(values, slow, {}, sigma, sigma, cv::BORDER_REFLECT);
    return slow;
}

/// Brightness relative to the surroundings, minus 1. This removes uneven light and exposure and keeps the slope along the
/// light.
cv::Mat shadingOf(const cv::Mat& photograph, double longestPx, std::optional<double> meanLight = {})
{
    const cv::Mat light = grey(photograph);
    const cv::Mat surroundings = slowPart(light, longestPx);
    // Black surroundings have no relative brightness, so divide by at least a hundredth of the mean.
    const double floor = std::max(1e-6, 0.01 * meanLight.value_or(cv::mean(light)[0]));
    cv::Mat difference, shading;
    cv::subtract(light, surroundings, difference);
    cv::divide(difference, cv::max(surroundings, floor), shading);
    return shading;
}

/// Extends the photograph by its mirror image, which fades to 0, so that the periodic continuation of the transform has no
/// step at the border.
cv::Mat faded(const cv::Mat& shading, int margin, cv::Size full)
{
    cv::Mat wide;
    cv::copyMakeBorder(shading, wide, margin, full.height - shading.rows - margin, margin, full.width - shading.cols - margin,
                       cv::BORDER_REFLECT);
    const auto fade = [margin](int place, int length) {
        const int outside = std::max({margin - place, place - (margin + length - 1), 0});
        return outside >= margin ? 0.F : static_cast<float>(0.5 + 0.5 * std::cos(std::numbers::pi * outside / margin));
    };
    for (int i = 0; i < wide.rows; ++i)
        for (int j = 0; j < wide.cols; ++j) wide.at<float>(i, j) *= fade(i, shading.rows) * fade(j, shading.cols);
    return wide;
}

/// Photographs with more pixels are judged by tiles: the direction of the light and the variation of colour.
constexpr std::size_t largestWholePx = 4'200'000;
constexpr int partMarginPx = 512;  ///< a wave at the regularisation's limit has fallen to 1e-6 over so many pixels
constexpr int tilesAlong = 4, lightTilePx = 512, colourTilePx = 256;

/// Sine of the angle across the light's axis at which half of a slope passes. Slopes nearly across the light only leave
/// harmonics and noise in a photograph, and the division would amplify them.
constexpr double acrossShare = 0.2;
/// Weight of the prior for light from above, as a share of full coherence. The lines of a weave attract the estimated axis.
constexpr double aboveWeight = 0.04;

double frequency(int k, int n) { return (2 * k <= n ? k : k - n) / static_cast<double>(n); }

/// Solves brightness = -(slope along the light), so height = brightness / (-2 pi i f) with f along the light.
/// Tikhonov regularisation damps small f.
cv::Mat linearRelief(const cv::Mat& shading, double azimuthDeg, double regularisation)
{
    const double angle = azimuthDeg * std::numbers::pi / 180;
    const double towardsX = std::cos(angle), towardsY = -std::sin(angle);  // Image rows increase downwards.
    const int margin = std::clamp(std::min(shading.rows, shading.cols) / 8, 1, 48);
    const cv::Size full(cv::getOptimalDFTSize(shading.cols + 2 * margin), cv::getOptimalDFTSize(shading.rows + 2 * margin));
    cv::Mat spectrum;
    cv::dft(faded(shading, margin, full), spectrum, cv::DFT_COMPLEX_OUTPUT);
    for (int i = 0; i < spectrum.rows; ++i)
        for (int j = 0; j < spectrum.cols; ++j) {
            const double fx = frequency(j, full.width), fy = frequency(i, full.height), f = fx * towardsX + fy * towardsY;
            const double floor = regularisation * regularisation + acrossShare * acrossShare * (fx * fx + fy * fy);
            const double gain = f / (2 * std::numbers::pi * (f * f + floor));
            auto& bin = spectrum.at<cv::Vec2f>(i, j);
            bin = {static_cast<float>(-gain * bin[1]), static_cast<float>(gain * bin[0])};  // Multiplied by i.
        }
    cv::Mat height;
    cv::dft(spectrum, height, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
    return height(cv::Rect(margin, margin, shading.cols, shading.rows));
}

cv::Mat levelled(const cv::Mat& height) { return height - cv::mean(height)[0]; }

/// Sums of products of the derivatives of brightness.
struct StructureTensor {
    double xx = 0, yy = 0, xy = 0;

    void add(const cv::Mat& shading)
    {
        cv::Mat smooth, x, y;
        cv::GaussianBlur(shading, smooth, {}, 1.0);
        cv::Sobel(smooth, x, CV_32F, 1, 0);
        cv::Sobel(smooth, y, CV_32F, 0, 1);
        xx += x.dot(x);
        yy += y.dot(y);
        xy += x.dot(y);
    }
};

/// The photograph or, of a large one, tiles that are evenly spread over it.
std::vector<cv::Mat> sampledTiles(const cv::Mat& photograph, int sidePx)
{
    if (photograph.total() <= largestWholePx) return {photograph};
    std::vector<cv::Mat> tiles;
    const cv::Size tile(std::min(sidePx, photograph.cols), std::min(sidePx, photograph.rows));
    const auto start = [](int k, int length, int part) { return (length - part) * k / (tilesAlong - 1); };
    for (int i = 0; i < tilesAlong; ++i)
        for (int j = 0; j < tilesAlong; ++j)
            tiles.push_back(
                photograph(cv::Rect({start(j, photograph.cols, tile.width), start(i, photograph.rows, tile.height)}, tile)));
    return tiles;
}

Light lightOf(const StructureTensor& tensor)
{
    const auto& [xx, yy, xy] = tensor;
    Light light;
    if (!(xx + yy > 0)) return light;
    light.coherence = std::hypot(xx - yy, 2 * xy) / (xx + yy);
    if (light.coherence < 0.02) return light;
    // In image coordinates (rows downwards) with doubled angles; light from above lies at 180 degrees.
    const double axis = 0.5 * std::atan2(2 * xy / (xx + yy), (xx - yy) / (xx + yy) - aboveWeight);
    light.azimuthDeg = -axis * 180 / std::numbers::pi;   // -90 to 90.
    if (light.azimuthDeg < 10) light.azimuthDeg += 180;  // The upper end or, of a nearly horizontal axis, the left end.
    return light;
}

constexpr int bumpSpacingPx = 2;  ///< distance between the centres of bumps, and their standard deviation
constexpr int outerSteps = 3, innerSteps = 25;
constexpr double bumpRidge = 1e-4;  ///< ridge on the heights, for bumps that the light does not determine

/// Surface as a sum of Gaussian bumps, its Lambertian image and the derivative of this image. The light has a slant of 45
/// degrees; the image is relative to a level place, minus 1. Heights are given at the centres of bumps (every
/// bumpSpacingPx-th pixel) and 0 elsewhere.
class Bumps {
public:
    Bumps(cv::Size size, double azimuthDeg) : m_size(size)
    {
        const double angle = azimuthDeg * std::numbers::pi / 180;
        m_towardsX = static_cast<float>(std::cos(angle));
        m_towardsY = static_cast<float>(-std::sin(angle));
    }

    static cv::Mat surface(const cv::Mat& heights)
    {
        cv::Mat result;
        cv::GaussianBlur(heights, result, {}, bumpSpacingPx, bumpSpacingPx, cv::BORDER_ISOLATED | cv::BORDER_CONSTANT);
        return result;
    }

    cv::Mat image(const cv::Mat& heights)
    {
        const auto [p, q] = slopes(surface(heights));
        cv::Mat along = m_towardsX * p + m_towardsY * q, steep = p.mul(p) + q.mul(q) + 1, root;
        cv::sqrt(steep, root);
        const cv::Mat light = 1 - along;
        // d/dp of (1 - along) / root, likewise q.
        m_byP = -m_towardsX / root - light.mul(p) / steep.mul(root);
        m_byQ = -m_towardsY / root - light.mul(q) / steep.mul(root);
        return light / root - 1;
    }

    /// Directional derivative at the heights of the last call of `image`.
    cv::Mat change(const cv::Mat& heights) const
    {
        const auto [p, q] = slopes(surface(heights));
        return m_byP.mul(p) + m_byQ.mul(q);
    }

    cv::Mat transposedChange(const cv::Mat& image) const
    {
        const cv::Mat p = m_byP.mul(image), q = m_byQ.mul(image);
        cv::Mat back = cv::Mat::zeros(m_size, CV_32FC1);
        for (int i = 0; i < m_size.height; ++i)
            for (int j = 0; j < m_size.width; ++j) {
                if (j + 1 < m_size.width) {
                    back.at<float>(i, j + 1) += p.at<float>(i, j);
                    back.at<float>(i, j) -= p.at<float>(i, j);
                }
                if (i + 1 < m_size.height) {
                    back.at<float>(i + 1, j) += q.at<float>(i, j);
                    back.at<float>(i, j) -= q.at<float>(i, j);
                }
            }
        return atCentres(surface(back));
    }

private:
    static std::pair<cv::Mat, cv::Mat> slopes(const cv::Mat& surface)
    {
        cv::Mat p = cv::Mat::zeros(surface.size(), CV_32FC1), q = p.clone();
        if (surface.cols > 1)
            cv::subtract(surface.colRange(1, surface.cols), surface.colRange(0, surface.cols - 1),
                         p.colRange(0, surface.cols - 1));
        if (surface.rows > 1)
            cv::subtract(surface.rowRange(1, surface.rows), surface.rowRange(0, surface.rows - 1),
                         q.rowRange(0, surface.rows - 1));
        return {p, q};
    }

    static cv::Mat atCentres(cv::Mat values)
    {
        for (int i = 0; i < values.rows; ++i)
            for (int j = 0; j < values.cols; ++j)
                if (i % bumpSpacingPx != 0 || j % bumpSpacingPx != 0) values.at<float>(i, j) = 0;
        return values;
    }

    cv::Size m_size;
    float m_towardsX = 0, m_towardsY = 0;
    cv::Mat m_byP, m_byQ;
};

/// Gauss-Newton; conjugate gradients solve the least-squares problem of each step.
cv::Mat bumpsThatShade(const cv::Mat& shading, double azimuthDeg)
{
    Bumps bumps(shading.size(), azimuthDeg);
    cv::Mat heights = cv::Mat::zeros(shading.size(), CV_32FC1);
    for (int outer = 0; outer < outerSteps; ++outer) {
        const cv::Mat left = shading - bumps.image(heights);
        cv::Mat residual = bumps.transposedChange(left) - bumpRidge * heights, direction = residual.clone(),
                step = cv::Mat::zeros(shading.size(), CV_32FC1);
        double power = residual.dot(residual);
        const double enough = 1e-8 * power;
        for (int inner = 0; inner < innerSteps && power > enough && power > 0; ++inner) {
            const cv::Mat image = bumps.change(direction);
            const cv::Mat pushed = bumps.transposedChange(image) + bumpRidge * direction;
            const double length = power / direction.dot(pushed);
            step += length * direction;
            residual -= length * pushed;
            const double next = residual.dot(residual);
            direction = residual + (next / power) * direction;
            power = next;
        }
        heights += step;
    }
    const cv::Mat surface = Bumps::surface(heights);
    return surface - cv::mean(surface)[0];
}

}  // namespace

double colourVariation(const cv::Mat& photograph, double highPassPx)
{
    if (photograph.channels() != 3) return 0;
    double colour = 0, all = 0;
    for (const auto& tile : sampledTiles(photograph, colourTilePx)) {
        std::vector<cv::Mat> channels;
        cv::split(tile, channels);
        for (auto& channel : channels) channel = shadingOf(channel, highPassPx);
        // The mean of the channels contains the shading, because shading changes them equally. The rest of each channel is
        // colour.
        const cv::Mat brightness = (channels[0] + channels[1] + channels[2]) / 3;
        for (const auto& channel : channels) {
            cv::Mat calm;
            cv::GaussianBlur(channel - brightness, calm, {}, 1.0);  // Suppresses camera noise, which differs between channels.
            colour += std::pow(cv::norm(calm), 2) / 3;
        }
        all += std::pow(cv::norm(brightness), 2);
    }
    return all > 0 ? std::sqrt(colour / all) : 0;
}

Light estimateLight(const cv::Mat& photograph, double highPassPx)
{
    StructureTensor tensor;
    for (const auto& tile : sampledTiles(photograph, lightTilePx)) tensor.add(shadingOf(tile, highPassPx));
    return lightOf(tensor);
}

ReliefPart reliefOfPart(const cv::Mat& photograph, const cv::Rect& part, const Light& light, const ShadingOptions& options)
{
    const cv::Rect whole({}, photograph.size());
    const cv::Rect around =
        cv::Rect(part.x - partMarginPx, part.y - partMarginPx, part.width + 2 * partMarginPx, part.height + 2 * partMarginPx) &
        whole;
    cv::Mat sparse;
    const int step = std::max(1, std::min(photograph.rows, photograph.cols) / 512);
    cv::resize(photograph, sparse, {photograph.cols / step, photograph.rows / step}, 0, 0, cv::INTER_NEAREST);
    const cv::Mat shading = shadingOf(photograph(around), options.highPassPx, cv::mean(grey(sparse))[0]);
    const double azimuthDeg = options.lightAzimuthDeg.value_or(light.azimuthDeg + (options.lightFromBelow ? 180 : 0));
    const cv::Rect inside(part.x - around.x, part.y - around.y, part.width, part.height);
    double power = 0, pixels = 0;
    for (const auto& tile : sampledTiles(photograph, lightTilePx)) {
        power += std::pow(cv::norm(shadingOf(tile, options.highPassPx)), 2);
        pixels += static_cast<double>(tile.total());
    }
    const double own = std::pow(cv::norm(shading(inside)), 2), all = power / pixels * static_cast<double>(photograph.total());
    return {linearRelief(shading, azimuthDeg, options.regularisation)(inside).clone(),
            all > 0 ? std::clamp(1 - own / all, 0.0, 1.0) : 0};
}

cv::Mat shapeFromShading(const cv::Mat& photograph, const ShadingOptions& options)
{
    const cv::Mat shading = shadingOf(photograph, options.highPassPx);
    const auto estimated = [&] {
        if (photograph.total() > largestWholePx) return estimateLight(photograph, options.highPassPx);
        StructureTensor tensor;
        tensor.add(shading);
        return lightOf(tensor);
    };
    const double azimuthDeg =
        options.lightAzimuthDeg ? *options.lightAzimuthDeg : estimated().azimuthDeg + (options.lightFromBelow ? 180 : 0);
    if (options.method == ShadingMethod::GaussianBumps) return bumpsThatShade(shading, azimuthDeg);
    if (options.quality == ShadingQuality::Accurate) return levelled(linearRelief(shading, azimuthDeg, options.regularisation));
    cv::Mat small, large;
    cv::resize(shading, small, {std::max(1, shading.cols / 2), std::max(1, shading.rows / 2)}, 0, 0, cv::INTER_AREA);
    // A pixel of the small image is two pixels of the large one, so wavelengths and heights are halved there.
    cv::resize(2 * levelled(linearRelief(small, azimuthDeg, 2 * options.regularisation)), large, shading.size(), 0, 0,
               cv::INTER_LINEAR);
    return large;
}

}  // namespace rendering::signals
