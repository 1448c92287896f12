#include "rendering/signals/tactile/ball_calibration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "rendering/signals/tactile/photometric_stereo.h"
#include "rendering/signals/tactile/upper_median.h"

namespace rendering::signals {

namespace {

constexpr double farRadii = 1.9;  ///< in ball radii; at this distance the gel is at rest
constexpr int farSamplesPerPress = 600;
constexpr int pressDegree = 4;        ///< a cubic without slopes at rest has an error that is 0.4 degrees larger
constexpr double pressRidge = 1e-3;   ///< a smaller ridge leaves the map too free between few presses
constexpr double cutoffShare = 0.25;  ///< share of the frame's shorter side; frames of full contact lose longer waves

double distance(const ContactCircle& circle, int x, int y) { return std::hypot(x - circle.centrePx.x, y - circle.centrePx.y); }

cv::Mat placesWhere(cv::Size size, const auto& chosen)
{
    cv::Mat places = cv::Mat::zeros(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            if (chosen(x, y)) places.at<uchar>(y, x) = 255;
    return places;
}

cv::Mat contactPlaces(const BallPresses& presses, const ContactCircle& circle, double lessPx)
{
    return placesWhere(presses.background.size(),
                       [&](int x, int y) { return distance(circle, x, y) < circle.radiusPx - lessPx; });
}

cv::Mat farPlaces(const BallPresses& presses, const ContactCircle& circle)
{
    const double far = farRadii * presses.ballRadiusMm / presses.mmPerPixel;
    return placesWhere(presses.background.size(), [&](int x, int y) { return distance(circle, x, y) > far; });
}

/// Angles in degrees between the normals of two surfaces at the chosen places.
std::vector<double> normalErrors(const Slopes& found, const Slopes& known, const cv::Mat& places)
{
    std::vector<double> errors;
    for (int i = 0; i < places.rows; ++i)
        for (int j = 0; j < places.cols; ++j) {
            if (!places.at<uchar>(i, j)) continue;
            const cv::Vec3d a(found.x.at<float>(i, j), found.y.at<float>(i, j), 1),
                b(known.x.at<float>(i, j), known.y.at<float>(i, j), 1);
            errors.push_back(std::acos(std::clamp(a.dot(b) / std::sqrt(a.dot(a) * b.dot(b)), -1.0, 1.0)) * 180 / CV_PI);
        }
    return errors;
}

double highest(const cv::Mat& values, const cv::Mat& places)
{
    double most = 0;
    cv::minMaxLoc(values, nullptr, &most, nullptr, nullptr, places);
    return most;
}

void appendScore(CalibrationScore& all, std::vector<double>& errors, const Calibration& calibration, const BallPresses& presses,
                 const ContactCircle& circle, std::size_t press)
{
    const auto& [name, frame] = presses.presses[press];
    const Pitch pitch{presses.mmPerPixel, presses.mmPerPixel};
    const Slopes slopes = slopesFromFrame(frame, presses.background, calibration);
    const auto here = normalErrors(slopes, ballSlopes(presses, circle), contactPlaces(presses, circle, 1));
    const cv::Mat contact = contactPlaces(presses, circle, 0), known = ballHeight(presses, circle);
    const cv::Mat height = heightInContact(slopes, contact, pitch);
    PressScore score{name, circle, upperMedian(here), 0, 0, 0};
    score.depthErrorMm = cv::norm(height, known, cv::NORM_L2, contact) / std::sqrt(std::max(1, cv::countNonZero(contact)));
    score.peakMm = highest(height, contact);
    const cv::Mat gel = withoutTilt(integrate(slopes, pitch), farPlaces(presses, circle));
    score.peakOverGelMm = highest(gel, contact);
    all.presses.push_back(score);
    errors.insert(errors.end(), here.begin(), here.end());
}

CalibrationScore withTotals(CalibrationScore score, const std::vector<double>& errors, const BallPresses& presses)
{
    score.normalErrorDeg = upperMedian(errors);
    if (score.presses.empty()) return score;
    score.lowestPeakMm = score.presses.front().peakMm;
    const double count = static_cast<double>(score.presses.size());
    for (const auto& press : score.presses) {
        score.depthErrorMm += press.depthErrorMm / count;
        score.peakMm += press.peakMm / count;
        score.peakOverGelMm += press.peakOverGelMm / count;
        score.lowestPeakMm = std::min(score.lowestPeakMm, press.peakMm);
        score.highestPeakMm = std::max(score.highestPeakMm, press.peakMm);
        score.ballPeakMm += highest(ballHeight(presses, press.circle), {}) / count;
    }
    return score;
}

}  // namespace

Slopes ballSlopes(const BallPresses& presses, const ContactCircle& circle)
{
    const double ball = presses.ballRadiusMm / presses.mmPerPixel;
    Slopes slopes{cv::Mat::zeros(presses.background.size(), CV_32FC1), cv::Mat::zeros(presses.background.size(), CV_32FC1)};
    for (int y = 0; y < slopes.x.rows; ++y)
        for (int x = 0; x < slopes.x.cols; ++x) {
            const double dx = x - circle.centrePx.x, dy = y - circle.centrePx.y, r = std::hypot(dx, dy);
            if (r >= circle.radiusPx) continue;
            const double z = std::sqrt(ball * ball - r * r);
            slopes.x.at<float>(y, x) = static_cast<float>(-dx / z);
            slopes.y.at<float>(y, x) = static_cast<float>(-dy / z);
        }
    return slopes;
}

cv::Mat ballHeight(const BallPresses& presses, const ContactCircle& circle)
{
    const double radius = presses.ballRadiusMm, edge = circle.radiusPx * presses.mmPerPixel;
    const double below = std::sqrt(radius * radius - edge * edge);
    cv::Mat height = cv::Mat::zeros(presses.background.size(), CV_32FC1);
    for (int y = 0; y < height.rows; ++y)
        for (int x = 0; x < height.cols; ++x) {
            const double r = distance(circle, x, y) * presses.mmPerPixel;
            if (r < edge) height.at<float>(y, x) = static_cast<float>(std::sqrt(radius * radius - r * r) - below);
        }
    return height;
}

Calibration calibrationFrom(const BallPresses& presses, const std::vector<ContactCircle>& circles,
                            const std::vector<std::size_t>& chosen, MapQuality quality)
{
    SlopeSamples samples;
    samples.channels = presses.background.channels();
    const Slopes flat{cv::Mat::zeros(presses.background.size(), CV_32FC1), cv::Mat::zeros(presses.background.size(), CV_32FC1)};
    for (const std::size_t press : chosen) {
        const cv::Mat light = lightOf(presses.presses[press].frame, presses.background, LightMeasure::AgainstReference);
        const cv::Mat contact = contactPlaces(presses, circles[press], 1), far = farPlaces(presses, circles[press]);
        samples.add(light, ballSlopes(presses, circles[press]), contact, std::max(1, cv::countNonZero(contact) / 4000));
        samples.add(light, flat, far, std::max(1, cv::countNonZero(far) / farSamplesPerPress));
    }
    FitOptions options;
    options.quality = quality;
    options.ridge = pressRidge;
    options.degree = pressDegree;
    options.networkSamples = 3000;  // Twice as many take twice the time without a visible gain.
    options.networkSteps = 500;
    Calibration calibration;
    calibration.channels = samples.channels;
    calibration.map = fitSlopeMap(samples, options);
    calibration.mmPerPixel = presses.mmPerPixel;
    calibration.highPassCutoffMm = cutoffShare * std::min(presses.background.cols, presses.background.rows) * presses.mmPerPixel;
    calibration.sensor = appearanceOf(presses.background);
    return calibration;
}

CalibrationScore scoreOf(const Calibration& calibration, const BallPresses& presses, const std::vector<ContactCircle>& circles,
                         const std::vector<std::size_t>& chosen)
{
    CalibrationScore score;
    std::vector<double> errors;
    for (const std::size_t press : chosen) appendScore(score, errors, calibration, presses, circles[press], press);
    return withTotals(std::move(score), errors, presses);
}

CalibrationScore crossValidated(const BallPresses& presses, const std::vector<ContactCircle>& circles, MapQuality quality)
{
    const std::size_t count = presses.presses.size(), folds = count < 10 ? count : 5;
    CalibrationScore score;
    std::vector<double> errors;
    for (std::size_t fold = 0; fold < folds; ++fold) {
        std::vector<std::size_t> others, left;
        for (std::size_t i = 0; i < count; ++i) (i % folds == fold ? left : others).push_back(i);
        const auto calibration = calibrationFrom(presses, circles, others, quality);
        for (const std::size_t press : left) appendScore(score, errors, calibration, presses, circles[press], press);
    }
    return withTotals(std::move(score), errors, presses);
}

}  // namespace rendering::signals
