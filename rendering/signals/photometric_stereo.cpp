#include "rendering/signals/photometric_stereo.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <vector>

#include "protocols/errors.h"

namespace rendering::signals {

namespace {

protocols::Error malformed(const std::string& where, const std::string& what, const std::string& expected)
{
    return protocols::badInput({.what = what, .where = where, .expected = expected, .nextStep = ""});
}

const nlohmann::json& member(const nlohmann::json& json, const char* name, const std::string& where)
{
    if (!json.contains(name))
        throw malformed(where, std::string("the calibration lacks \"") + name + "\"", "a file made by vis2hap calibrate");
    return json.at(name);
}

double number(const nlohmann::json& json, const std::string& place, const std::string& where)
{
    if (!json.is_number() || !std::isfinite(json.get<double>())) throw malformed(where, place + " is " + json.dump(), "a number");
    return json.get<double>();
}

template <std::size_t n>
std::array<double, n> numbers(const nlohmann::json& json, const std::string& place, const std::string& where)
{
    if (!json.is_array() || json.size() != n)
        throw malformed(where, place + " is " + json.dump(), std::to_string(n) + " numbers");
    std::array<double, n> values{};
    for (std::size_t i = 0; i < n; ++i) values[i] = number(json[i], place, where);
    return values;
}

void requireSound(const Calibration& calibration, const std::string& where)
{
    if (!(calibration.mmPerPixel > 0)) throw malformed(where, "mm_per_pixel is not above 0", "the pitch of the tactile frames");
    if (calibration.highPassCutoffMm && !(*calibration.highPassCutoffMm > 0))
        throw malformed(where, "high_pass_cutoff_mm is not above 0", "a wavelength in mm, or null");
    if (!(calibration.zeroPercentile >= 0 && calibration.zeroPercentile <= 50))
        throw malformed(where, "zero_percentile is outside 0..50", "a low percentile, such as 2");
}

/// The value that `percent` of the pixels do not exceed.
double percentile(const cv::Mat& values, double percent)
{
    std::vector<float> sorted(values.begin<float>(), values.end<float>());
    const auto place = static_cast<std::ptrdiff_t>(std::floor(percent / 100 * static_cast<double>(sorted.size() - 1)));
    std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
    return sorted[static_cast<std::size_t>(place)];
}

}  // namespace

Calibration calibrationFromJson(std::string_view text, const std::string& where)
{
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) throw malformed(where, "this is no calibration", "a JSON object");
    if (member(json, "schema", where) != "vis2hap.calibration/1")
        throw malformed(where, "schema is " + json.at("schema").dump(), "\"vis2hap.calibration/1\"");
    if (member(json, "kind", where) != "linear") throw malformed(where, "kind is " + json.at("kind").dump(), "\"linear\"");
    const auto& matrix = member(json, "gradient_from_rgb", where);
    if (!matrix.is_array() || matrix.size() != 2)
        throw malformed(where, "gradient_from_rgb is " + matrix.dump(), "two rows of three numbers");
    Calibration calibration;
    for (std::size_t i = 0; i < 2; ++i) calibration.gradientFromRgb[i] = numbers<3>(matrix[i], "gradient_from_rgb", where);
    calibration.offset = numbers<2>(member(json, "offset", where), "offset", where);
    calibration.mmPerPixel = number(member(json, "mm_per_pixel", where), "mm_per_pixel", where);
    if (json.contains("high_pass_cutoff_mm") && !json.at("high_pass_cutoff_mm").is_null())
        calibration.highPassCutoffMm = number(json.at("high_pass_cutoff_mm"), "high_pass_cutoff_mm", where);
    calibration.zeroPercentile = number(member(json, "zero_percentile", where), "zero_percentile", where);
    requireSound(calibration, where);
    return calibration;
}

Calibration readCalibration(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw malformed(file.string(), "the calibration cannot be read", "the file that dataset.json names");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    return calibrationFromJson(text, file.string());
}

std::string toJson(const Calibration& calibration)
{
    nlohmann::ordered_json json{{"schema", "vis2hap.calibration/1"},
                                {"kind", "linear"},
                                {"gradient_from_rgb", calibration.gradientFromRgb},
                                {"offset", calibration.offset},
                                {"mm_per_pixel", calibration.mmPerPixel},
                                {"high_pass_cutoff_mm", nullptr},
                                {"zero_percentile", calibration.zeroPercentile}};
    if (calibration.highPassCutoffMm) json["high_pass_cutoff_mm"] = *calibration.highPassCutoffMm;
    return json.dump(2) + "\n";
}

Slopes slopesFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration)
{
    if (frame.empty() || frame.type() != CV_8UC3 || reference.type() != CV_8UC3 || frame.size() != reference.size())
        throw protocols::badInput({.what = "the tactile frame (" + std::to_string(frame.cols) + " x " +
                                           std::to_string(frame.rows) + ") and its reference (" + std::to_string(reference.cols) +
                                           " x " + std::to_string(reference.rows) + ") do not belong together",
                                   .where = "",
                                   .expected = "two 8-bit colour images of one size",
                                   .nextStep = ""});
    cv::Mat change;
    cv::subtract(frame, reference, change, cv::noArray(), CV_32F);
    cv::Matx<float, 2, 4> map;
    for (int i = 0; i < 2; ++i) {
        const auto row = static_cast<std::size_t>(i);
        for (int c = 0; c < 3; ++c)
            map(i, c) = static_cast<float>(calibration.gradientFromRgb[row][static_cast<std::size_t>(c)] / 255);
        map(i, 3) = static_cast<float>(calibration.offset[row]);
    }
    cv::Mat both;
    cv::transform(change, both, map);
    Slopes slopes;
    cv::extractChannel(both, slopes.x, 0);
    cv::extractChannel(both, slopes.y, 1);
    return slopes;
}

cv::Mat settled(const cv::Mat& heightMm, const Pitch& pitch, std::optional<double> highPassCutoffMm, double zeroPercentile)
{
    const cv::Mat relief = highPassCutoffMm ? withoutLowFrequency(heightMm, pitch, *highPassCutoffMm) : heightMm;
    cv::Mat height;
    relief.convertTo(height, CV_32F);
    height -= percentile(height, zeroPercentile);
    return cv::max(height, 0);
}

cv::Mat heightFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration,
                        IntegrationQuality quality)
{
    const Pitch pitch{calibration.mmPerPixel, calibration.mmPerPixel};
    const cv::Mat height = integrate(slopesFromFrame(frame, reference, calibration), pitch, SlopeKind::Point, quality);
    return settled(height, pitch, calibration.highPassCutoffMm, calibration.zeroPercentile);
}

}  // namespace rendering::signals
