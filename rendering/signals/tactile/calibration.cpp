#include "rendering/signals/tactile/calibration.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/dataset.h"

namespace rendering::signals {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

protocols::Error notACalibration(const std::string& where, const std::string& what, const std::string& expected)
{
    return protocols::badInput(
        {.what = what, .where = where, .expected = expected, .nextStep = "make the file with vis2hap calibrate"});
}

/// A JSON object with access to its members by name; faults name the source and the member.
class CalibrationFields {
public:
    CalibrationFields(const json& object, std::string where) : m_object(object), m_where(std::move(where)) {}

    const json& member(const char* name) const
    {
        if (!m_object.contains(name))
            throw notACalibration(m_where, std::string("the calibration has no \"") + name + "\"", "this field");
        return m_object.at(name);
    }
    bool has(const char* name) const { return m_object.contains(name) && !m_object.at(name).is_null(); }

    double number(const char* name) const { return numberIn(member(name), name); }
    double numberOr(const char* name, double otherwise) const { return has(name) ? number(name) : otherwise; }
    int whole(const char* name, int least, int most) const
    {
        const double value = number(name);
        if (value != std::floor(value) || value < least || value > most)
            throw notACalibration(m_where, std::string(name) + " is " + member(name).dump(),
                                  "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
        return static_cast<int>(value);
    }
    bool yes(const char* name) const
    {
        if (!member(name).is_boolean())
            throw notACalibration(m_where, std::string(name) + " is " + member(name).dump(), "true or false");
        return member(name).get<bool>();
    }
    std::vector<double> numbers(const char* name, std::size_t count) const { return numbersIn(member(name), name, count); }
    std::array<std::vector<double>, 2> twoRows(const char* name, std::size_t count) const
    {
        const json& rows = member(name);
        if (!rows.is_array() || rows.size() != 2)
            throw notACalibration(m_where, std::string(name) + " is " + rows.dump(),
                                  "two rows of " + std::to_string(count) + " numbers");
        return {numbersIn(rows[0], name, count), numbersIn(rows[1], name, count)};
    }
    std::vector<double> numbersIn(const json& value, const char* name, std::size_t count) const
    {
        if (!value.is_array() || value.size() != count)
            throw notACalibration(m_where, std::string(name) + " is " + value.dump().substr(0, 80),
                                  std::to_string(count) + " numbers");
        std::vector<double> result;
        for (const auto& item : value) result.push_back(numberIn(item, name));
        return result;
    }
    protocols::Error fault(const char* name, const std::string& expected) const
    {
        return notACalibration(m_where, std::string(name) + " is " + member(name).dump().substr(0, 80), expected);
    }

private:
    double numberIn(const json& value, const char* name) const
    {
        if (!value.is_number() || !std::isfinite(value.get<double>()))
            throw notACalibration(m_where, std::string(name) + " is " + value.dump().substr(0, 80), "a number");
        return value.get<double>();
    }

    const json& m_object;
    std::string m_where;
};

SlopeMap linearFrom(const CalibrationFields& reading, int channels)
{
    const auto offset = reading.numbers("offset", 2);
    return LinearMap{reading.twoRows("gradient_from_rgb", static_cast<std::size_t>(channels)), {offset[0], offset[1]}};
}

SlopeMap polynomialFrom(const CalibrationFields& reading, int channels)
{
    PolynomialMap map{reading.whole("degree", 1, 6), reading.yes("by_place"), reading.number("light_scale"), {}};
    map.coefficients = reading.twoRows("coefficients", monomials(channels + (map.byPlace ? 2 : 0), map.degree).size());
    return map;
}

SlopeMap networkFrom(const CalibrationFields& reading, int channels)
{
    NetworkMap map{reading.yes("by_place"), reading.number("light_scale"), {}, {}};
    const json& sizes = reading.member("sizes");
    if (!sizes.is_array() || sizes.size() < 2 || sizes.size() > 8) throw reading.fault("sizes", "the units of 2 to 8 layers");
    for (const auto& size : sizes) {
        if (!size.is_number_unsigned() || size.get<std::uint64_t>() < 1 || size.get<std::uint64_t>() > 1024)
            throw reading.fault("sizes", "1 to 1024 units for each layer");
        map.sizes.push_back(size.get<int>());
    }
    if (map.sizes.front() != channels + (map.byPlace ? 2 : 0) || map.sizes.back() != 2)
        throw reading.fault("sizes", "one input for each number of the light, and 2 outputs");
    const json& weights = reading.member("weights");
    if (!weights.is_array() || weights.size() + 1 != map.sizes.size()) throw reading.fault("weights", "one list for each layer");
    for (std::size_t i = 0; i < weights.size(); ++i)
        map.weights.push_back(
            reading.numbersIn(weights[i], "weights", static_cast<std::size_t>(map.sizes[i + 1] * (map.sizes[i] + 1))));
    return map;
}

SlopeMap mapFrom(const CalibrationFields& reading, int channels)
{
    const auto& kind = reading.member("kind");
    if (kind == "linear") return linearFrom(reading, channels);
    if (kind == "polynomial") return polynomialFrom(reading, channels);
    if (kind == "network") return networkFrom(reading, channels);
    throw reading.fault("kind", "\"linear\", \"polynomial\" or \"network\"");
}

LightMeasure lightFrom(const CalibrationFields& reading)
{
    if (!reading.has("light") || reading.member("light") == "reference") return LightMeasure::AgainstReference;
    if (reading.member("light") == "own") return LightMeasure::AgainstOwnLight;
    throw reading.fault("light", "\"reference\" or \"own\"");
}

std::optional<SensorAppearance> sensorFrom(const CalibrationFields& reading, int channels, const std::string& where)
{
    if (!reading.has("sensor")) return std::nullopt;
    const CalibrationFields sensor(reading.member("sensor"), where);
    return SensorAppearance{
        sensor.whole("width", 1, 1 << 20), sensor.whole("height", 1, 1 << 20),
        sensor.numbers("colours", static_cast<std::size_t>(SensorAppearance::columns * SensorAppearance::rows * channels))};
}

void requireSound(const Calibration& calibration, const std::string& where)
{
    if (!(calibration.mmPerPixel > 0))
        throw notACalibration(where, "mm_per_pixel is not above 0", "the pitch of the tactile frames");
    if (calibration.highPassCutoffMm && !(*calibration.highPassCutoffMm > 0))
        throw notACalibration(where, "high_pass_cutoff_mm is not above 0", "a wavelength in mm, or null");
    if (!(calibration.zeroPercentile >= 0 && calibration.zeroPercentile <= 50))
        throw notACalibration(where, "zero_percentile is not from 0 to 50", "a low percentile, such as 2");
}

struct MapWriter {
    ordered_json& object;
    void operator()(const LinearMap& map) const
    {
        object["gradient_from_rgb"] = map.gain;
        object["offset"] = map.offset;
    }
    void operator()(const PolynomialMap& map) const
    {
        object["degree"] = map.degree;
        object["by_place"] = map.byPlace;
        object["light_scale"] = map.lightScale;
        object["coefficients"] = map.coefficients;
    }
    void operator()(const NetworkMap& map) const
    {
        object["by_place"] = map.byPlace;
        object["light_scale"] = map.lightScale;
        object["sizes"] = map.sizes;
        object["weights"] = map.weights;
    }
};

}  // namespace

Calibration calibrationFromJson(std::string_view text, const std::string& where)
{
    const auto object = protocols::parseStrictJson(text, where);
    if (!object.is_object()) throw notACalibration(where, "is not a calibration", "a JSON object");
    const CalibrationFields reading(object, where);
    if (reading.member("schema") != "vis2hap.calibration/1") throw reading.fault("schema", "\"vis2hap.calibration/1\"");
    Calibration calibration;
    calibration.light = lightFrom(reading);
    if (reading.has("channels")) calibration.channels = reading.whole("channels", 1, 64);
    calibration.map = mapFrom(reading, calibration.channels);
    calibration.mmPerPixel = reading.number("mm_per_pixel");
    if (reading.has("high_pass_cutoff_mm")) calibration.highPassCutoffMm = reading.number("high_pass_cutoff_mm");
    calibration.zeroPercentile = reading.number("zero_percentile");
    calibration.sensor = sensorFrom(reading, calibration.channels, where);
    requireSound(calibration, where);
    return calibration;
}

Calibration readCalibration(const std::filesystem::path& file)
{
    return calibrationFromJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
}

Calibration calibrationOf(const fabrics::Dataset& dataset, const cv::Mat& reference)
{
    const std::filesystem::path file = dataset.folder / dataset.tactileCalibration;
    Calibration calibration = readCalibration(file);
    const auto difference = calibration.sensor ? differenceOf(*calibration.sensor, appearanceOf(reference)) : std::nullopt;
    if (difference)
        throw protocols::badInput({.what = "the reference frame is not of the calibrated sensor: " + *difference,
                                   .where = (dataset.folder / "tactile-reference.png").string(),
                                   .expected = "a frame of the sensor of " + file.string(),
                                   .nextStep = "calibrate this sensor at the size of its frames, and name that calibration"});
    if (const auto stated = dataset.tactileMmPerPixel; stated && !isSamePitch(calibration.mmPerPixel, *stated))
        throw protocols::badInput({.what = "the tactile frames have " + protocols::shortest(*stated) +
                                           " mm per pixel, but their calibration is for " +
                                           protocols::shortest(calibration.mmPerPixel),
                                   .where = (dataset.folder / "dataset.json").string(),
                                   .expected = "the pitch of " + file.string() + ", within 1 %",
                                   .nextStep = "correct tactile.mm_per_pixel, or calibrate at the size of the frames"});
    return calibration;
}

std::string toJson(const Calibration& calibration)
{
    ordered_json object{{"schema", "vis2hap.calibration/1"},
                        {"kind", kindOf(calibration.map)},
                        {"light", calibration.light == LightMeasure::AgainstReference ? "reference" : "own"},
                        {"channels", calibration.channels}};
    std::visit(MapWriter{object}, calibration.map);
    object["mm_per_pixel"] = calibration.mmPerPixel;
    object["high_pass_cutoff_mm"] = nullptr;
    if (calibration.highPassCutoffMm) object["high_pass_cutoff_mm"] = *calibration.highPassCutoffMm;
    object["zero_percentile"] = calibration.zeroPercentile;
    if (calibration.sensor)
        object["sensor"] = {{"width", calibration.sensor->width},
                            {"height", calibration.sensor->height},
                            {"columns", SensorAppearance::columns},
                            {"rows", SensorAppearance::rows},
                            {"colours", calibration.sensor->colours}};
    return object.dump(2) + "\n";
}

}  // namespace rendering::signals
