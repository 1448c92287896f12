#include "study/bench/bench_frames.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "rendering/composition/frame_images.h"
#include "study/bench/bench_turns.h"

namespace study::bench {

namespace {

using rendering::Extension;

/// A sensor whose colours follow the slopes, with a little of every term of its cubic map.
rendering::signals::Calibration sensor()
{
    rendering::signals::PolynomialMap map;
    map.degree = 3;
    const auto count = rendering::signals::monomials(5, map.degree).size();
    map.coefficients = {std::vector<double>(count, 0.01), std::vector<double>(count, -0.01)};
    map.coefficients[0][1] = map.coefficients[1][2] = 0.5;
    rendering::signals::Calibration calibration;
    calibration.map = map;
    calibration.mmPerPixel = 0.05;
    calibration.highPassCutoffMm = 3;
    return calibration;
}

cv::Mat untouched(cv::Size size) { return {size, CV_8UC3, cv::Scalar(110, 120, 130)}; }

/// Light of a plain weave whose period of 0.57 mm fits no size, with the noise of a camera.
cv::Mat pressedCloth(cv::Size size)
{
    protocols::Random random(9);
    cv::Mat frame = untouched(size);
    const double perPixel = 2 * std::numbers::pi * 0.05 / 0.57;
    for (int i = 0; i < frame.rows; ++i)
        for (int j = 0; j < frame.cols; ++j) {
            auto& pixel = frame.at<cv::Vec3b>(i, j);
            pixel[0] = cv::saturate_cast<unsigned char>(pixel[0] + 30 * std::sin(perPixel * j) + random.normal());
            pixel[1] = cv::saturate_cast<unsigned char>(pixel[1] + 30 * std::cos(perPixel * 0.9 * i) + random.normal());
        }
    return frame;
}

std::vector<BenchRow> benchSize(cv::Size size)
{
    const auto calibration = sensor();
    const cv::Mat reference = untouched(size), frame = pressedCloth(size);
    cv::Mat image;
    std::vector<TimedSetting> settings;
    char stage[60];
    std::snprintf(stage, sizeof stage, "frame %dx%d to image 800x1280", size.height, size.width);
    const char* note = "photometric stereo, integration, high pass, extension and range; against render's own functions";
    for (const auto extension : {Extension::Mirror, Extension::Tile}) {
        const std::string name = extension == Extension::Mirror ? "mirror" : "tile";
        const auto range = frameRange(frame, reference, calibration, extension);
        const cv::Mat accurate = frameImage(frame, reference, calibration, range, extension);
        const auto error = [&image, accurate] {
            return cv::norm(image, accurate) / std::sqrt(static_cast<double>(accurate.total()));
        };
        const auto images = std::make_shared<rendering::FrameImages>(calibration, reference, range, extension);
        settings.push_back(
            {{stage, "fast, " + name, {}, {}, "levels of 255", note}, [&, images] { image = images->imageOf(frame); }, error});
        settings.push_back({{stage, "accurate, " + name, {}, {}, "levels of 255", note},
                            [&, range, extension] { image = frameImage(frame, reference, calibration, range, extension); },
                            error});
    }
    return benchInTurns(settings);
}

}  // namespace

std::vector<BenchRow> benchFrames()
{
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    auto rows = benchSize({320, 240});
    for (BenchRow& row : benchSize({640, 480})) rows.push_back(std::move(row));
    cv::setNumThreads(threads);
    return rows;
}

}  // namespace study::bench
