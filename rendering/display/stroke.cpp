#include "rendering/display/stroke.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"

namespace rendering {

namespace {

/// Pixel values along the row, averaged over the contact of the finger pad.
std::vector<double> feltAlong(const cv::Mat& image, int row, double sigmaPx)
{
    // Outside the image its border is repeated, so a wider kernel would change nothing.
    const double widest = 4.0 * std::max(image.cols, image.rows) + 1;
    const int reach = std::max(1, static_cast<int>(std::ceil(std::min(3 * sigmaPx, widest))));
    const cv::Mat kernel = cv::getGaussianKernel(2 * reach + 1, std::max(sigmaPx, 1e-3), CV_64F);
    cv::Mat line = cv::Mat::zeros(1, image.cols, CV_64FC1);
    for (int offset = -reach; offset <= reach; ++offset) {
        cv::Mat neighbour;
        image.row(std::clamp(row + offset, 0, image.rows - 1)).convertTo(neighbour, CV_64F);
        line += kernel.at<double>(offset + reach) * neighbour;
    }
    cv::Mat felt;
    cv::sepFilter2D(line, felt, CV_64F, kernel, cv::Mat::ones(1, 1, CV_64F), {-1, -1}, 0, cv::BORDER_REPLICATE);
    return {felt.begin<double>(), felt.end<double>()};
}

double at(const std::vector<double>& values, double place)
{
    const auto low = static_cast<std::size_t>(place);
    const auto high = std::min(low + 1, values.size() - 1);
    return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

/// First-order response to a drive that is linear between samples; starts in equilibrium.
class FirstOrderResponse {
public:
    explicit FirstOrderResponse(const StrokeOptions& options) : m_hasDelay(options.responseS > 0)
    {
        if (!m_hasDelay) return;
        const double step = 1 / (options.responseS * options.sampleRateHz);
        m_keep = std::exp(-step);
        m_lag = -std::expm1(-step) / step;
    }

    double to(double driven)
    {
        if (m_isDriven && m_hasDelay)
            m_force = m_keep * (m_force - m_driven) + driven - (driven - m_driven) * m_lag;
        else
            m_force = driven;
        m_driven = driven;
        m_isDriven = true;
        return m_force;
    }

private:
    bool m_hasDelay, m_isDriven = false;
    double m_keep = 0, m_lag = 0, m_force = 0, m_driven = 0;
};

void requireUsable(const StrokeOptions& options)
{
    struct Bound {
        const char* name;
        double value, least, most;
    };
    const Bound bounds[] = {{"speed (mm/s)", options.speedMmPerS, 1e-6, 1e6},
                            {"pitch of the display (mm)", options.mmPerPixel, 1e-6, 1e3},
                            {"width of the contact (mm)", options.contactMm, 1e-6, 1e2},
                            {"normal force (N)", options.normalForceN, 1e-6, 1e3},
                            {"friction of the glass", options.glassFriction, 0, 100},
                            {"highest friction", options.highestFriction, 0, 100},
                            {"time constant (s)", options.responseS, 0, 100},
                            {"sample rate (Hz)", options.sampleRateHz, 1e-3, 1e6}};
    for (const Bound& bound : bounds)
        if (!(bound.value >= bound.least && bound.value <= bound.most))
            throw protocols::badInput({std::string("the ") + bound.name + " of a stroke is " + protocols::shortest(bound.value),
                                       "", protocols::shortest(bound.least) + " to " + protocols::shortest(bound.most),
                                       "correct the option"});
}

std::size_t samplesFor(double lastPixel, double pixelsPerSample, const StrokeOptions& options)
{
    constexpr double mostSamples = 1e7;
    const double count = std::floor(lastPixel / pixelsPerSample + 1e-9) + 1;
    if (count <= mostSamples) return static_cast<std::size_t>(count);
    const double slowest = std::ceil(lastPixel * options.mmPerPixel * options.sampleRateHz / (mostSamples - 1) * 1e6) / 1e6;
    throw protocols::badInput({"the stroke would take more than 10000000 samples", "",
                               "a speed from " + protocols::shortest(slowest) + " mm/s at this sample rate",
                               "choose a higher speed"});
}

}  // namespace

std::vector<StrokeSample> strokeImage(const cv::Mat& image, int line, bool vertical, const StrokeOptions& options)
{
    assert((image.type() == CV_8UC1 || image.type() == CV_16UC1) && !image.empty() && "friction images are grey");
    requireUsable(options);
    const cv::Mat upright = vertical ? cv::Mat(image.t()) : image;
    assert(line >= 0 && line < upright.rows && "the stroke runs over the image");
    const auto felt = feltAlong(upright, line, options.contactMm / 2 / options.mmPerPixel);

    const double pixelsPerSample = options.speedMmPerS / options.sampleRateHz / options.mmPerPixel;
    const double lastPixel = static_cast<double>(felt.size() - 1);
    const std::size_t count = samplesFor(lastPixel, pixelsPerSample, options);
    const double fullScale = image.depth() == CV_8U ? 255 : 65535;
    const double frictionPerLevel = (options.highestFriction - options.glassFriction) / fullScale;
    FirstOrderResponse response(options);
    std::vector<StrokeSample> samples(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double place = std::min(static_cast<double>(i) * pixelsPerSample, lastPixel);
        const double driven = options.normalForceN * (options.glassFriction + frictionPerLevel * at(felt, place));
        samples[i] = {static_cast<double>(i) / options.sampleRateHz, place * options.mmPerPixel, options.normalForceN,
                      response.to(driven)};
    }
    return samples;
}

std::string strokeCsv(const std::vector<StrokeSample>& samples)
{
    std::string text = "t_s,position_mm,normal_n,tangential_n\n";
    for (const StrokeSample& sample : samples)
        text += protocols::csvRow({protocols::shortest(sample.timeS), protocols::shortest(sample.positionMm),
                                   protocols::shortest(sample.normalN), protocols::shortest(sample.tangentialN)});
    return text;
}

std::vector<double> strokeForce(const cv::Mat& image, int row, bool vertical, const StrokeOptions& options)
{
    std::vector<double> force;
    for (const StrokeSample& sample : strokeImage(image, row, vertical, options)) force.push_back(sample.tangentialN);
    return force;
}

}  // namespace rendering
