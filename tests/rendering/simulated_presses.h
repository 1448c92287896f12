// Ball presses into a sensor with known light, which a calibration should recover. Each of three lamps is brighter for slopes
// towards it (slightly curved), unevenly over the frame. Around the contact the gel returns to rest.
#pragma once

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "protocols/random.h"
#include "rendering/signals/tactile/ball_calibration.h"

namespace tests {

struct SimulatedPresses {
    rendering::signals::BallPresses presses;
    std::vector<cv::Point2d> centres;
    double contactPx = 0;
};

inline cv::Vec3d simulatedLight(double p, double q, double u, double v)
{
    cv::Vec3d light;
    for (int lamp = 0; lamp < 3; ++lamp) {
        const double angle = 2 * std::numbers::pi * lamp / 3 + 0.4;
        const double towards = -(p * std::cos(angle) + q * std::sin(angle));
        light[lamp] = (45 + 8 * u * (lamp - 1) + 6 * v) * (towards - 0.12 * towards * towards);
    }
    return light;
}

inline cv::Vec3d simulatedBackground(double u, double v) { return {130 + 15 * u, 120 - 12 * v, 140 + 10 * u * v}; }

/// Frames of 160 x 120 with a ball of 2 mm at 0.125 mm per pixel (16 px) and a contact radius of `contactPx`.
inline SimulatedPresses simulatedPresses(int count, double contactPx = 13, double noise = 1)
{
    constexpr int width = 160, height = 120;
    constexpr double ball = 16;
    protocols::Random random(5);
    SimulatedPresses made;
    made.contactPx = contactPx;
    made.presses.ballRadiusMm = 2;
    made.presses.mmPerPixel = 0.125;
    const auto frameOf = [&](const auto& slopeAt) {
        cv::Mat frame(height, width, CV_8UC3);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double u = 2.0 * x / width - 1, v = 2.0 * y / height - 1;
                const auto slope = slopeAt(x, y);
                const auto level = simulatedBackground(u, v) + simulatedLight(slope.x, slope.y, u, v);
                for (int c = 0; c < 3; ++c)
                    frame.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(level[c] + noise * random.normal());
            }
        return frame;
    };
    made.presses.background = frameOf([](int, int) { return cv::Point2d(); });
    for (int i = 0; i < count; ++i) {
        const cv::Point2d centre(25 + 110.0 * ((i * 7) % count) / count, 25 + 70.0 * ((i * 3) % count) / count);
        const auto slopeAt = [&](int x, int y) {
            const double dx = x - centre.x, dy = y - centre.y, r = std::max(1e-9, std::hypot(dx, dy)),
                         inside = std::min(r, contactPx);
            double steep = inside / std::sqrt(ball * ball - inside * inside);
            if (r > contactPx) steep *= std::exp(-(r - contactPx) / 4);
            return cv::Point2d(-dx / r * steep, -dy / r * steep);
        };
        made.centres.push_back(centre);
        made.presses.presses.push_back({"press_" + std::to_string(i) + ".png", frameOf(slopeAt)});
    }
    return made;
}

}  // namespace tests
