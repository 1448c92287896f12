// Periodic surfaces of known height and slopes, for the tests of integration and of scans.
#pragma once

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <vector>

#include "rendering/signals/periodic_slopes.h"
#include "rendering/signals/periodic_transform.h"

namespace scan_folders {

/// A surface of oblique waves and its exact slopes.
struct KnownSurface {
    cv::Mat heightMm;  ///< CV_32FC1, mean 0
    rendering::signals::Slopes slopes;
};

/// Waves of whole periods in the tile; waves along x or y alone would show no sign of the green channel.
inline KnownSurface obliqueWaves(cv::Size size, double tileMm, double amplitudeMm = 0.05)
{
    struct Wave {
        int across, down;
        double share, phase;
    };
    // Many waves of different amplitudes, so that no place repeats.
    std::vector<Wave> waves;
    for (int across = -12; across <= 12; across += 3)
        for (int down = 1; down <= 13; down += 4)
            waves.push_back(
                {across + down % 3, down, 0.1 + 0.02 * ((across * across + 7 * down) % 11), 0.7 * across + 1.3 * down * down});
    const double pitch = tileMm / size.width;
    KnownSurface known{cv::Mat::zeros(size, CV_32FC1), {cv::Mat::zeros(size, CV_32FC1), cv::Mat::zeros(size, CV_32FC1)}};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            for (const Wave& wave : waves) {
                const double kx = 2 * std::numbers::pi * wave.across / size.width,
                             ky = 2 * std::numbers::pi * wave.down / size.height;
                const double angle = kx * x + ky * y + wave.phase, a = amplitudeMm * wave.share;
                known.heightMm.at<float>(y, x) += float(a * std::sin(angle));
                known.slopes.x.at<float>(y, x) += float(a * kx / pitch * std::cos(angle));
                known.slopes.y.at<float>(y, x) += float(a * ky / pitch * std::cos(angle));
            }
    return known;
}

/// A surface that repeats nowhere: noise of a fixed seed without its shortest waves, and its slopes. RMS slope about 0.2.
inline KnownSurface unevenCloth(cv::Size size, double tileMm, std::uint64_t seed)
{
    using namespace rendering::signals;
    KnownSurface known;
    known.heightMm.create(size, CV_32FC1);
    cv::RNG(seed).fill(known.heightMm, cv::RNG::NORMAL, 0, 1);
    cv::Mat spectrum = fourierTransform(known.heightMm);
    for (int v = 0; v < spectrum.rows; ++v)
        for (int u = 0; u < spectrum.cols; ++u) {
            const double fx = fourierFrequency(u, size.width), fy = fourierFrequency(v, size.height);
            spectrum.at<cv::Vec2f>(v, u) *= float(std::exp(-40 * (fx * fx + fy * fy)));
        }
    spectrum.at<cv::Vec2f>(0, 0) = 0;
    const double pitch = tileMm / size.width;
    known.heightMm = inverseFourierTransform(spectrum, size.width) * pitch;
    known.slopes = periodicSlopes(known.heightMm, {pitch, pitch});
    return known;
}

}  // namespace scan_folders
