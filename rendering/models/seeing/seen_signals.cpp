#include "rendering/models/seeing/seen_signals.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/models/seeing/friction_target.h"
#include "rendering/models/seeing/picture_tensors.h"
#include "rendering/models/seeing/pitch_unit.h"
#include "rendering/models/seeing/seen_texture.h"
#include "rendering/signals/spectrogram.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::models {

namespace {

constexpr int tilePx = 512;  ///< px of the relief from one pass
/// Slow waves of the relief, which a photograph does not show, end here, in pixels.
constexpr double longestWavePx = 128;

int upTo16(int length) { return (length + 15) / 16 * 16; }

/// Symmetries of the square over which a quality averages (bit 0 mirrors columns, bit 1 rows, bit 2 swaps both axes).
std::vector<int> symmetriesOf(Quality quality)
{
    switch (quality) {
        case Quality::Fast:
            return {0};
        case Quality::Balanced:
            return {0};
        case Quality::Accurate:
            return {0, 1, 2, 3, 4, 5, 6, 7};
    }
    return {};
}

int marginFor(Quality quality) { return quality == Quality::Fast ? 16 : 64; }

int cropsAcross(Quality quality) { return quality == Quality::Fast ? 1 : quality == Quality::Balanced ? 2 : 3; }

cv::Mat matOf(const torch::Tensor& map)
{
    const torch::Tensor flat = map.contiguous();
    return cv::Mat(static_cast<int>(flat.size(2)), static_cast<int>(flat.size(3)), CV_32F, flat.data_ptr<float>()).clone();
}

/// Photograph with mirrored borders, so that its sides are multiples of 16 and at least 48.
cv::Mat padded(const cv::Mat& rgb, int margin, const cv::Size& whole)
{
    cv::Mat wide;
    cv::copyMakeBorder(rgb, wide, margin, margin + whole.height - rgb.rows, margin, margin + whole.width - rgb.cols,
                       cv::BORDER_REFLECT_101);
    return wide;
}

cv::Mat reliefPx(SeeingNetworks& networks, const cv::Mat& rgb, Quality quality)
{
    const int margin = marginFor(quality);
    const cv::Size whole(std::max(48, upTo16(rgb.cols)), std::max(48, upTo16(rgb.rows)));
    const cv::Mat wide = padded(rgb, margin, whole);
    const std::vector<int> turns = symmetriesOf(quality);
    cv::Mat relief(whole, CV_32F);
    for (int y = 0; y < whole.height; y += tilePx)
        for (int x = 0; x < whole.width; x += tilePx) {
            const cv::Rect tile(x, y, std::min(tilePx, whole.width - x), std::min(tilePx, whole.height - y));
            const torch::Tensor photograph = tensorOfPicture(wide({x, y, tile.width + 2 * margin, tile.height + 2 * margin}));
            torch::Tensor sum = torch::zeros({1, 1, photograph.size(2), photograph.size(3)});
            for (const int turn : turns) sum += turnedBack(networks.relief->forward(seenTexture(turned(photograph, turn))), turn);
            matOf(sum / static_cast<double>(turns.size()))({margin, margin, tile.width, tile.height}).copyTo(relief(tile));
        }
    return relief({0, 0, rgb.cols, rgb.rows}).clone();
}

/// Crops [N, 3, side, side], evenly spread.
torch::Tensor squareCrops(const cv::Mat& rgb, int side, Quality quality)
{
    const cv::Mat wide = padded(rgb, 0, {std::max(side, rgb.cols), std::max(side, rgb.rows)});
    const int across = cropsAcross(quality);
    const auto along = [&](int length, int i) { return across == 1 ? (length - side) / 2 : (length - side) * i / (across - 1); };
    std::vector<torch::Tensor> all;
    for (int row = 0; row < across; ++row)
        for (int column = 0; column < across; ++column)
            all.push_back(tensorOfPicture(wide({along(wide.cols, column), along(wide.rows, row), side, side})));
    return torch::cat(all, 0);
}

int griffinLimIterations(Quality quality)
{
    using signals::GriffinLimOptions, signals::InversionQuality;
    switch (quality) {
        case Quality::Fast:
            return 8;
        case Quality::Balanced:
            return GriffinLimOptions::of(InversionQuality::Fast).iterations;
        case Quality::Accurate:
            return GriffinLimOptions::of(InversionQuality::Accurate).iterations;
    }
    return 0;
}

void addFriction(GeneratedSignals& signals, SeeingNetworks& networks, const Architecture& architecture, const cv::Mat& rgb,
                 double pitch, Quality quality)
{
    const torch::Tensor texture = seenTexture(squareCrops(rgb, architecture.crop, quality));
    const torch::Tensor logPitch = torch::full({texture.size(0), 1}, std::log(pitch / pitchUnitMm));
    const SeenFriction seen = networks.friction->forward(texture, networks.relief->forward(texture), logPitch);
    FrictionTarget target;
    const torch::Tensor logRatio = seen.logRatio.mean(0).contiguous();
    target.logRatio = cv::Mat(architecture.rows, architecture.frames, CV_32F, logRatio.data_ptr<float>()).clone();
    target.mean = std::exp(seen.logMean.mean().item<float>());
    signals.spectrogram = magnitudes(target, architecture);
    signals.spectrogramParameters = spectrogramParameters(architecture);
    signals.trace = traceOf(target, architecture, griffinLimIterations(quality));
    signals.traceMmPerSample = architecture.traceMmPerSample;
    signals.meanFriction = target.mean;
}

void requireFiniteSignals(const GeneratedSignals& signals)
{
    for (const cv::Mat& values : {signals.heightMm, signals.spectrogram, cv::Mat(1, 1, CV_64F, cv::Scalar(signals.meanFriction))})
        if (!values.empty() && !cv::checkRange(values))
            throw protocols::badInput({"the model gives numbers that are not finite", "weights", "a completely trained model",
                                       "train again or use the weights of the program"});
}

}  // namespace

GeneratedSignals seenSignals(SeeingNetworks& networks, const Architecture& architecture, const InputPhotograph& photograph,
                             const GenerationOptions& options)
{
    const torch::NoGradGuard noGradient;
    const double pitch = photograph.mmPerPixel.value();
    GeneratedSignals signals;
    if (options.height) {
        const cv::Mat heightMm = reliefPx(networks, photograph.photograph, options.quality) * pitch;
        signals.heightMm = signals::zeroedRelief(heightMm, {pitch, pitch}, longestWavePx * pitch, architecture.zeroPercentile);
        signals.heightMmPerPixel = pitch;
    }
    if (options.friction) addFriction(signals, networks, architecture, photograph.photograph, pitch, options.quality);
    requireFiniteSignals(signals);
    return signals;
}

}  // namespace rendering::models
