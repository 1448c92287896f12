#include "rendering/fabrics/procedural/stroke_rig.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace rendering::fabrics {

namespace {

constexpr double contactMm = 0.6;
constexpr double stripPitchMm = 0.1;
constexpr int stripRows = 7;
constexpr double nominalForceN = 15;
constexpr double referenceSpeedMmPerS = 5;

/// Relief under the probe along the stroke, mean removed, sampled at the pitch of the strip.
std::vector<double> probedRelief(const ReliefSampler& reliefAt, const FabricPlace& start, double lengthMm)
{
    const int margin = 10;
    const int columns = int(std::ceil(lengthMm / stripPitchMm)) + 1 + 2 * margin;
    const double angle = start.rotationDeg * std::numbers::pi / 180;
    const double toCentre = ((columns - 1) / 2.0 - margin) * stripPitchMm;
    const FabricPlace centre{start.xMm + std::cos(angle) * toCentre, start.yMm + std::sin(angle) * toCentre, start.rotationDeg};
    cv::Mat strip = reliefAt(centre, {columns, stripRows}, stripPitchMm);
    cv::GaussianBlur(strip, strip, {}, contactMm / 3 / stripPitchMm);
    std::vector<double> relief;
    double sum = 0;
    for (int column = margin - 1; column < columns - margin + 1; ++column) {
        double across = 0;
        for (int row = 0; row < stripRows; ++row) across += strip.at<float>(row, column);
        relief.push_back(across / stripRows);
        sum += relief.back();
    }
    for (double& height : relief) height -= sum / double(relief.size());
    return relief;
}

/// Texture part of the coefficient at distance `xMm`. The first entry of `relief` lies one pitch before the start.
double textureAt(const std::vector<double>& relief, double xMm)
{
    const double place = xMm / stripPitchMm + 1;
    const auto left = std::min(std::size_t(place), relief.size() - 2);
    const double blend = place - double(left);
    const double height = relief[left] * (1 - blend) + relief[left + 1] * blend;
    const double slope = (relief[left + 1] - relief[left]) / stripPitchMm;
    return 0.35 * height + 0.18 * slope;
}

/// First-order autoregressive noise with a given standard deviation and correlation time.
class ColouredNoise {
public:
    ColouredNoise(double deviation, double timeS, double rateHz, protocols::Random& random)
        : m_keep(std::exp(-1 / (timeS * rateHz))),
          m_drive(deviation * std::sqrt(1 - m_keep * m_keep)),
          m_value(deviation * random.normal())
    {
    }
    double next(protocols::Random& random) { return m_value = m_keep * m_value + m_drive * random.normal(); }

private:
    double m_keep, m_drive, m_value;
};

void appendFixed(std::string& text, double value, int digits)
{
    char buffer[40];
    const auto [end, problem] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, digits);
    text.append(buffer, problem == std::errc{} ? end : buffer);
}

}  // namespace

double meanFriction(const FabricSurface& surface, const FrictionRecording& recording)
{
    const double pitch = 0.05;
    cv::Mat height = surface.sample({37, 41, 0}, {400, 400}, pitch).heightMm, slopeX, slopeY;
    cv::GaussianBlur(height, height, {}, 0.15 / pitch);
    cv::Sobel(height, slopeX, CV_64F, 1, 0, 1, 1 / (2 * pitch));
    cv::Sobel(height, slopeY, CV_64F, 0, 1, 1, 1 / (2 * pitch));
    const double slope = std::sqrt(cv::mean(slopeX.mul(slopeX) + slopeY.mul(slopeY))[0]);
    const double resting = surface.structure().fibreFriction + 1.1 * std::tanh(0.2 * slope);
    return resting * (1 + 0.06 * std::log(recording.speedMmPerS / referenceSpeedMmPerS));
}

ForceRecord strokeFabric(const FabricSurface& surface, double mean, const FabricPlace& start, const FrictionRecording& recording,
                         protocols::Random& random)
{
    const auto sample = [&](const FabricPlace& centre, cv::Size size, double pitchMm) {
        return surface.sample(centre, size, pitchMm).heightMm;
    };
    return strokeRelief(sample, mean, start, recording, random);
}

ForceRecord strokeRelief(const ReliefSampler& reliefAt, double mean, const FabricPlace& start, const FrictionRecording& recording,
                         protocols::Random& random)
{
    const double placeFactor = 1 + 0.03 * random.normal();
    const double rate = recording.sampleRateHz;
    const auto count = std::size_t(std::lround(recording.lengthMm / recording.speedMmPerS * rate));
    const std::vector<double> relief = probedRelief(reliefAt, start, recording.lengthMm);
    ColouredNoise load(0.2, 0.5, rate, random), rubbing(0.012, 0.15, rate, random);
    ForceRecord record;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = double(i) / rate;
        const double texture = textureAt(relief, recording.speedMmPerS * time);
        const double coefficient = std::max(0.02, mean * placeFactor * (1 + rubbing.next(random)) + texture * (0.4 + mean));
        const double normal = nominalForceN + load.next(random);
        record.timeS.push_back(time);
        record.normalN.push_back(normal + 0.02 * random.normal());
        record.tangentialN.push_back(coefficient * normal + 0.02 * random.normal());
    }
    return record;
}

std::string toCsv(const ForceRecord& record)
{
    std::string text = "t_s,normal_n,tangential_n\n";
    for (std::size_t i = 0; i < record.timeS.size(); ++i) {
        appendFixed(text, record.timeS[i], 6);
        text += ',';
        appendFixed(text, record.normalN[i], 4);
        text += ',';
        appendFixed(text, record.tangentialN[i], 4);
        text += '\n';
    }
    return text;
}

}  // namespace rendering::fabrics
