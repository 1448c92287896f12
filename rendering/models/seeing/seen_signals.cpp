#include "rendering/models/seeing/seen_signals.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/models/elapsed.h"
#include "rendering/models/preset.h"
#include "rendering/models/seeing/friction_target.h"
#include "rendering/models/seeing/picture_tensors.h"
#include "rendering/models/seeing/pitch_unit.h"
#include "rendering/models/seeing/seen_texture.h"
#include "rendering/models/seeing/told_lamp.h"
#include "rendering/models/seeing/told_shading.h"
#include "rendering/signals/dominant_wave.h"
#include "rendering/signals/spectrogram.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::models {

namespace {

/// Side of the relief from one pass, px. Each pass judges light and cloth anew, so heights of neighbours may differ a little.
constexpr int tilePx = 1024;
constexpr int leastSeamPx = 16;  ///< margin at least, where several tiles meet
/// Slow waves of the relief, which a photograph does not show, end here, in pixels.
constexpr double longestWavePx = 128;
constexpr int displacementStep = 16;  ///< no displacement of displacementsOf() is larger
/// Threads with a shorter wave, in pixels, lie near the finest that the networks resolve. They see such a picture enlarged.
constexpr double fineThreadsPx = 3.5;
constexpr double enlargement = 2;

int upTo16(int length) { return (length + 15) / 16 * 16; }

/// Displacements of the picture over which a quality averages, at most four. The networks halve the picture four times, so
/// displaced pictures give slightly different heights. Symmetries of the square would not do: they move the lamp.
std::vector<cv::Point> displacementsOf(Quality quality)
{
    static const std::vector<cv::Point> all{{0, 0}, {8, 8}, {4, 12}, {12, 4}};
    return {all.begin(), all.begin() + presetOf(quality).pictures};
}

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

/// What the relief network sees and says of pictures [N, 3, H, W]. Pictures that come a second time are not computed again: of a
/// photograph as small as the crop for friction, `fast` takes one crop, which is the photograph.
class ReliefReader {
public:
    ReliefReader(ReliefNetwork network, const ToldLamp& lamp) : m_network(std::move(network)), m_lamp(lamp) {}

    struct Seen {
        torch::Tensor texture, relief;
    };
    Seen of(const torch::Tensor& pictures)
    {
        if (!m_pictures.defined() || !m_pictures.sizes().equals(pictures.sizes()) || !torch::equal(m_pictures, pictures)) {
            const torch::Tensor texture = seenTexture(pictures);
            m_seen = {texture, m_network->forward(texture, tensorOf(m_lamp, pictures.size(0)))};
            m_pictures = pictures;
        }
        return m_seen;
    }
    std::optional<double> lampDeg() const { return m_lamp.sideDeg(); }

private:
    static torch::Tensor tensorOf(const ToldLamp& lamp, std::int64_t count)
    {
        return torch::tensor({lamp.numbers[0], lamp.numbers[1]}).unsqueeze(0).expand({count, lampNumbers});
    }

    ReliefNetwork m_network;
    ToldLamp m_lamp;
    torch::Tensor m_pictures;
    Seen m_seen;
};

cv::Mat contrastOf(const cv::Mat& rgb) { return matOf(seenContrast(tensorOfPicture(rgb))); }

cv::Mat reliefPx(ReliefReader& reader, const cv::Mat& rgb, Quality quality)
{
    const cv::Size whole(std::max(48, upTo16(rgb.cols)), std::max(48, upTo16(rgb.rows)));
    const bool isOneTile = whole.width <= tilePx && whole.height <= tilePx;
    const int margin = std::max(isOneTile ? 0 : leastSeamPx, presetOf(quality).marginPx);
    const std::vector<cv::Point> displacements = displacementsOf(quality);
    const int border = margin + displacementStep;
    const cv::Mat wide = padded(rgb, border, whole);
    const std::optional<double> side = reader.lampDeg();
    cv::Mat relief(whole, CV_32F), contrast(side ? whole : cv::Size(), CV_32F);
    for (int y = 0; y < whole.height; y += tilePx)
        for (int x = 0; x < whole.width; x += tilePx) {
            const cv::Rect tile(x, y, std::min(tilePx, whole.width - x), std::min(tilePx, whole.height - y));
            cv::Mat sum = cv::Mat::zeros(tile.size(), CV_32F);
            for (const cv::Point& moved : displacements) {
                const cv::Rect seen(x + displacementStep - moved.x, y + displacementStep - moved.y, tile.width + 2 * margin,
                                    tile.height + 2 * margin);
                sum += matOf(reader.of(tensorOfPicture(wide(seen))).relief)(
                    {margin + moved.x, margin + moved.y, tile.width, tile.height});
            }
            cv::Mat(sum / static_cast<double>(displacements.size())).copyTo(relief(tile));
            if (side)
                contrastOf(wide({x, y, tile.width + 2 * border, tile.height + 2 * border}))(
                    {border, border, tile.width, tile.height})
                    .copyTo(contrast(tile));
        }
    const cv::Rect shown(0, 0, rgb.cols, rgb.rows);
    return side ? withToldShading(relief(shown), contrast(shown), *side) : relief(shown).clone();
}

bool hasFineThreads(const cv::Mat& rgb)
{
    const std::optional<signals::DominantWave> wave = signals::dominantWave(rgb);
    return wave && wave->periodPx < fineThreadsPx;
}

/// Relief in pixels of `rgb`. A picture of fine threads is enlarged for the networks, and its relief is made small again.
cv::Mat reliefOfThreads(ReliefReader& reader, const cv::Mat& rgb, Quality quality)
{
    if (!hasFineThreads(rgb)) return reliefPx(reader, rgb, quality);
    cv::Mat large, relief;
    cv::resize(rgb, large, {}, enlargement, enlargement, cv::INTER_CUBIC);
    cv::resize(reliefPx(reader, large, quality), relief, rgb.size(), 0, 0, cv::INTER_AREA);
    return relief / enlargement;
}

/// Crops [N, 3, side, side], evenly spread.
torch::Tensor squareCrops(const cv::Mat& rgb, int side, Quality quality)
{
    const cv::Mat wide = padded(rgb, 0, {std::max(side, rgb.cols), std::max(side, rgb.rows)});
    const int across = presetOf(quality).cropsAcross;
    const auto along = [&](int length, int i) { return across == 1 ? (length - side) / 2 : (length - side) * i / (across - 1); };
    std::vector<torch::Tensor> all;
    for (int row = 0; row < across; ++row)
        for (int column = 0; column < across; ++column)
            all.push_back(tensorOfPicture(wide({along(wide.cols, column), along(wide.rows, row), side, side})));
    return torch::cat(all, 0);
}

void addFriction(GeneratedSignals& signals, FrictionNetwork& network, ReliefReader& reader, const Architecture& architecture,
                 const cv::Mat& rgb, double pitch, const std::optional<fabrics::Fibre>& fibre, Quality quality)
{
    const auto [texture, relief] = reader.of(squareCrops(rgb, architecture.crop, quality));
    const torch::Tensor logPitch = torch::full({texture.size(0), 1}, std::log(pitch / pitchUnitMm));
    const SeenFriction seen = network->forward(texture, relief, logPitch);
    FrictionTarget target;
    const torch::Tensor logRatio = seen.logRatio.mean(0).contiguous();
    target.logRatio = cv::Mat(architecture.rows, architecture.frames, CV_32F, logRatio.data_ptr<float>()).clone();
    const ReadFriction read = withToldFibre({seen.logMean.mean().item<double>(), ninetyPercent * architecture.intervalFactor *
                                                                                     seen.logSpread.exp().mean().item<double>()},
                                            architecture.fibres, fibre);
    const double logMean = read.logMean + std::log(architecture.frictionFactor), halfWidth = read.halfWidth;
    target.mean = static_cast<float>(std::exp(logMean));
    signals.spectrogram = magnitudes(target, architecture);
    signals.spectrogramParameters = spectrogramParameters(architecture);
    signals.trace = traceOf(target, architecture, presetOf(quality).phaseIterations);
    signals.traceMmPerSample = architecture.traceMmPerSample;
    signals.meanFriction = target.mean;
    signals.photograph.meanFriction = FrictionInterval{std::exp(logMean - halfWidth), std::exp(logMean + halfWidth)};
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
    const ToldLamp lamp = toldLamp(photograph.lightDeg);
    const cv::Mat rgb = turned(photograph.photograph, lamp.turn);
    ReliefReader reader(networks.relief, lamp);
    GeneratedSignals signals;
    if (options.height)
        signals.heightMilliseconds = millisecondsOf([&] {
            const cv::Mat heightMm =
                turnedBack(reliefOfThreads(reader, rgb, options.quality), lamp.turn) * (pitch * architecture.reliefFactor);
            signals.heightMm =
                signals::zeroedRelief(heightMm, {pitch, pitch}, longestWavePx * pitch, architecture.zeroPercentile);
            signals.heightMmPerPixel = pitch;
        });
    if (options.friction)
        signals.frictionMilliseconds = millisecondsOf([&] {
            addFriction(signals, networks.friction, reader, architecture, rgb, pitch, photograph.fibre, options.quality);
        });
    requireFiniteSignals(signals);
    return signals;
}

}  // namespace rendering::models
