#include "rendering/models/networks/inference.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <thread>

#include "protocols/files/errors.h"
#include "rendering/models/elapsed.h"
#include "rendering/models/networks/finished_relief.h"
#include "rendering/models/networks/weights.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/models/preset.h"
#include "rendering/models/ring_spectrum.h"
#include "rendering/models/seeing/friction_target.h"
#include "rendering/models/seeing/picture_tensors.h"
#include "rendering/models/seeing/seen_signals.h"
#include "rendering/models/seeing/shared_batch_norm.h"
#include "rendering/signals/spectrogram.h"

namespace rendering::models {

namespace {

constexpr int tileSide = 256;  ///< px of the height map from one pass of G_h

int roundedUpTo16(int length) { return (length + 15) / 16 * 16; }

/// Symmetries of the square over which a quality averages. Of two, the second is number 3.
std::vector<int> turnsOf(Quality quality)
{
    const int count = presetOf(quality).turns;
    if (count == 2) return {0, 3};
    std::vector<int> turns(static_cast<std::size_t>(count));
    std::iota(turns.begin(), turns.end(), 0);
    return turns;
}

/// Corners of the crops for G_s, evenly spread over the photograph.
std::vector<cv::Point> cropCorners(const cv::Size& size, int side, Quality quality)
{
    const int across = presetOf(quality).cropsAcross;
    const auto along = [&](int length, int i) {
        const int room = std::max(0, length - side);
        return across == 1 ? room / 2 : room * i / (across - 1);
    };
    std::vector<cv::Point> corners;
    for (int row = 0; row < across; ++row)
        for (int column = 0; column < across; ++column) corners.emplace_back(along(size.width, column), along(size.height, row));
    return corners;
}

/// Margin in px around a tile for G_h; a multiple of 16 together with the tile. With Quality::Fast a single tile has none: its
/// borders are those of the photograph, as in the training crops.
int marginOf(const cv::Size& photograph, Quality quality)
{
    const bool single = photograph.width <= tileSide && photograph.height <= tileSide;
    return quality == Quality::Fast && single ? 0 : presetOf(quality).paperMarginPx;
}

void requireFinite(const cv::Mat& values)
{
    if (!cv::checkRange(values))
        throw protocols::badInput({"the model gives numbers that are not finite", "weights", "a completely trained model",
                                   "train again or use the weights of the program"});
}

}  // namespace

struct LoadedModel::Parts {
    ModelCardFields card;
    Architecture architecture;
    mutable Generators generators;
    mutable SeeingNetworks seeing;  ///< instead of the generators where the architecture sees

    cv::Mat height(const cv::Mat& rgb, Quality quality) const
    {
        cv::Mat padded;
        const int margin = marginOf(rgb.size(), quality);
        const int right = roundedUpTo16(rgb.cols) - rgb.cols, below = roundedUpTo16(rgb.rows) - rgb.rows;
        cv::copyMakeBorder(rgb, padded, margin, margin + below, margin, margin + right, cv::BORDER_REFLECT_101);
        cv::Mat result(rgb.rows + below, rgb.cols + right, CV_32F);
        for (int y = 0; y < result.rows; y += tileSide)
            for (int x = 0; x < result.cols; x += tileSide) {
                const cv::Rect tile(x, y, std::min(tileSide, result.cols - x), std::min(tileSide, result.rows - y));
                heightOfTile(padded({x, y, tile.width + 2 * margin, tile.height + 2 * margin}), margin, quality)
                    .copyTo(result(tile));
            }
        const cv::Mat relief = result({0, 0, rgb.cols, rgb.rows}) * architecture.heightScaleMm;
        requireFinite(relief);  // The filter would spread a single value that is not finite over the whole map.
        if (!architecture.imposesSpectrum) return relief;
        return withRingPowers(relief, predictedRings(rgb, quality), ringFilter(architecture, presetOf(quality).spectrumPasses));
    }

    /// Radial power spectrum that G_h predicts, averaged over crops.
    std::vector<float> predictedRings(const cv::Mat& rgb, Quality quality) const
    {
        const torch::Tensor mean = generators.height->rings(crops(rgb, quality)).mean(0).contiguous();
        return {mean.data_ptr<float>(), mean.data_ptr<float>() + ringCount};
    }

    /// Crops [N, 3, crop, crop] for outputs that describe the whole photograph.
    torch::Tensor crops(const cv::Mat& rgb, Quality quality) const
    {
        const int side = architecture.crop;
        cv::Mat wide;
        cv::copyMakeBorder(rgb, wide, 0, std::max(0, side - rgb.rows), 0, std::max(0, side - rgb.cols), cv::BORDER_REFLECT_101);
        const int turns = presetOf(quality).cropTurns;
        std::vector<torch::Tensor> all;
        for (const cv::Point& corner : cropCorners(wide.size(), side, quality))
            for (int turn = 0; turn < turns; ++turn)
                all.push_back(turned(tensorOfPicture(wide({corner.x, corner.y, side, side})), turn));
        return torch::cat(all, 0);
    }

    /// Height of a tile. `padded` is the tile with its margin, which is cut off again.
    cv::Mat heightOfTile(const cv::Mat& padded, int margin, Quality quality) const
    {
        const torch::Tensor photograph = tensorOfPicture(padded);
        torch::Tensor sum = torch::zeros({1, 1, padded.rows, padded.cols});
        const std::vector<int> turns = turnsOf(quality);
        for (const int turn : turns) sum += turnedBack(generators.height->forward(turned(photograph, turn)), turn);
        sum /= static_cast<double>(turns.size());
        const cv::Mat whole(padded.rows, padded.cols, CV_32F, sum.data_ptr<float>());
        return whole({margin, margin, padded.cols - 2 * margin, padded.rows - 2 * margin}).clone();
    }

    /// Friction by G_s, averaged over crops.
    FrictionTarget friction(const cv::Mat& rgb, Quality quality) const
    {
        const FrictionOutput output = generators.friction->forward(crops(rgb, quality));
        const torch::Tensor logRatio = output.logRatio.mean(0).contiguous();
        FrictionTarget target;
        target.logRatio = cv::Mat(architecture.rows, architecture.frames, CV_32F, logRatio.data_ptr<float>()).clone();
        target.mean = output.mean.mean().item<float>();
        return target;
    }
};

LoadedModel::LoadedModel(const std::filesystem::path& model, int threads) : m_parts(std::make_unique<Parts>())
{
    torch::set_num_threads(threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
    m_parts->card = readModelCardFields(model);
    m_parts->architecture = m_parts->card.architecture;
    if (m_parts->architecture.sees) {
        m_parts->seeing = readSeeingModel(model, m_parts->card);
        foldBatchNorms(*m_parts->seeing.relief);
        foldBatchNorms(*m_parts->seeing.friction);
    } else
        m_parts->generators = readModel(model, m_parts->card);
}

LoadedModel::~LoadedModel() = default;

GeneratedSignals LoadedModel::generate(const InputPhotograph& photograph, const GenerationOptions& options) const
{
    const torch::NoGradGuard noGradient;
    const Architecture& architecture = m_parts->architecture;
    if (architecture.sees) return seenSignals(m_parts->seeing, architecture, photograph, options);
    const cv::Mat rgb = photographAtPitch(photograph, architecture.mmPerPixel).rgb;
    GeneratedSignals signals;
    if (options.height)
        signals.heightMilliseconds = millisecondsOf([&] {
            signals.heightMm = m_parts->height(rgb, options.quality);
            signals.heightMmPerPixel = architecture.mmPerPixel;
            requireFinite(signals.heightMm);
        });
    if (options.friction)
        signals.frictionMilliseconds = millisecondsOf([&] {
            const FrictionTarget target = m_parts->friction(rgb, options.quality);
            requireFinite(target.logRatio);
            requireFinite(cv::Mat(1, 1, CV_32F, cv::Scalar(static_cast<double>(target.mean))));
            signals.spectrogram = magnitudes(target, architecture);
            signals.spectrogramParameters = spectrogramParameters(architecture);
            signals.trace = traceOf(target, architecture, presetOf(options.quality).phaseIterations);
            signals.traceMmPerSample = architecture.traceMmPerSample;
            signals.meanFriction = target.mean;
        });
    return signals;
}

}  // namespace rendering::models
