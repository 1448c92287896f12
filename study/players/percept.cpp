#include "study/players/percept.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "rendering/display/stroke.h"

namespace study::players {

namespace {

constexpr int strokesAlongEachAxis = 4;
constexpr double lowestBandHz = 8;
constexpr double leastNoticedRms = 0.003;  // coefficient; below it nothing varies to a finger
constexpr double frictionJnd = 0.2;        // Weber fraction of friction
constexpr double textureJnd = 0.15;        // log10 of the r.m.s. in a band

/// Mean square in each octave band, by the periodogram of the stroke without its mean.
std::array<double, Percept::bands> bandPower(const std::vector<double>& coefficient, double mean, double sampleRateHz)
{
    cv::Mat signal(1, cv::getOptimalDFTSize(static_cast<int>(coefficient.size())), CV_64F, cv::Scalar(0));
    const int n = static_cast<int>(coefficient.size());
    double windowPower = 0;
    for (int i = 0; i < n; ++i) {
        const double window = 0.5 - 0.5 * std::cos(2 * CV_PI * (i + 0.5) / n);
        windowPower += window * window;
        signal.at<double>(i) = window * (coefficient[i] - mean);
    }
    cv::Mat spectrum;
    cv::dft(signal, spectrum, cv::DFT_COMPLEX_OUTPUT);
    std::array<double, Percept::bands> power{};
    for (int k = 1; k < spectrum.cols / 2; ++k) {
        const double octave = std::log2(k * sampleRateHz / spectrum.cols / lowestBandHz);
        if (octave < 0 || octave >= Percept::bands) continue;
        const auto value = spectrum.at<cv::Vec2d>(k);
        power[static_cast<int>(octave)] += 2 * (value[0] * value[0] + value[1] * value[1]) / (spectrum.cols * windowPower);
    }
    return power;
}

}  // namespace

Percept feel(const cv::Mat& image)
{
    const rendering::StrokeOptions options;
    Percept percept;
    double sum = 0;
    for (const bool vertical : {false, true}) {
        std::array<double, Percept::bands> power{};
        const int lines = vertical ? image.cols : image.rows;
        for (int stroke = 0; stroke < strokesAlongEachAxis; ++stroke) {
            auto coefficient = strokeForce(image, lines * (2 * stroke + 1) / (2 * strokesAlongEachAxis), vertical, options);
            double mean = 0;
            for (double& value : coefficient) mean += (value /= options.normalForceN);
            mean /= static_cast<double>(coefficient.size());
            sum += mean;
            const auto bands = bandPower(coefficient, mean, options.sampleRateHz);
            for (int band = 0; band < Percept::bands; ++band) power[band] += bands[band] / strokesAlongEachAxis;
        }
        for (int band = 0; band < Percept::bands; ++band)
            percept.texture[band + (vertical ? Percept::bands : 0)] =
                std::log10(std::max(std::sqrt(power[band]), leastNoticedRms));
    }
    percept.slipperiness = std::log(sum / (2 * strokesAlongEachAxis));
    return percept;
}

double slipperinessDistance(const Percept& a, const Percept& b)
{
    return std::abs(a.slipperiness - b.slipperiness) / std::log1p(frictionJnd);
}

double textureDistance(const Percept& a, const Percept& b)
{
    double squares = 0;
    for (std::size_t i = 0; i < a.texture.size(); ++i) squares += (a.texture[i] - b.texture[i]) * (a.texture[i] - b.texture[i]);
    return std::sqrt(squares / static_cast<double>(a.texture.size())) / textureJnd;
}

}  // namespace study::players
