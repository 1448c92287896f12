#include "rendering/signals/spectrogram_file.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"

namespace rendering {

namespace {

namespace fs = std::filesystem;
using signals::MagnitudeSpectrogram;
using signals::Spectrogram;
using signals::SpectrogramParameters;
using Json = nlohmann::ordered_json;

constexpr const char* schema = "vis2hap.spectrogram/1";

fs::path valuesBeside(const fs::path& file)
{
    fs::path values = file;
    return values.replace_extension(".npy");
}

template <class AnySpectrogram>
void write(const fs::path& file, const AnySpectrogram& spectrogram, const char* kind, const cv::Mat& values)
{
    const auto& parameters = spectrogram.parameters;
    const Json json{{"schema", schema},
                    {"kind", kind},
                    {"values", valuesBeside(file).filename().string()},
                    {"window", "hann, periodic"},
                    {"window_length", parameters.windowLength},
                    {"hop", parameters.hop},
                    {"fft_size", parameters.fftSize},
                    {"sample_rate_hz", parameters.sampleRateHz},
                    {"frames", "centred on every hop, the trace mirrored about its end samples"},
                    {"scaling", "none"},
                    {"trace_length", spectrogram.traceLength},
                    {"mean", spectrogram.mean}};
    writeNpy(valuesBeside(file), values);
    protocols::writeWholeFile(file, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

protocols::Error malformed(const fs::path& file, const std::string& what, const std::string& expected)
{
    return protocols::badInput({.what = what, .where = file.string(), .expected = expected, .nextStep = ""});
}

struct Described {
    std::string kind;
    SpectrogramParameters parameters;
    int traceLength = 0;
    double mean = 0;
};

Described described(const fs::path& file)
{
    try {
        const nlohmann::json json = protocols::parseStrictJson(protocols::readWholeFile(file), file.string());
        if (json.at("schema") != schema)
            throw malformed(file, "is no spectrogram", std::string("\"schema\": \"") + schema + "\"");
        const auto whole = [&](const char* name) {
            if (!json.at(name).is_number_integer()) throw malformed(file, std::string(name) + " is no whole number", "1 or more");
            const auto value = json.at(name).get<std::int64_t>();
            if (value < 0 || value > 1'000'000'000) throw malformed(file, std::string(name) + " is out of range", "up to 10^9");
            return static_cast<int>(value);
        };
        Described result{json.at("kind").get<std::string>(),
                         {whole("window_length"), whole("hop"), whole("fft_size"), json.at("sample_rate_hz").get<double>()},
                         whole("trace_length"),
                         json.at("mean").get<double>()};
        // A transform longer than any trace would make tables of any size.
        if (result.parameters.fftSize > (1 << 24)) throw malformed(file, "fft_size is out of range", "up to 2^24");
        return result;
    } catch (const nlohmann::json::exception& fault) {
        throw malformed(file, "is no spectrogram (" + std::string(fault.what()) + ")", "the fields of " + std::string(schema));
    }
}

void requireFit(const fs::path& file, const Described& described, const cv::Mat& values, int columns)
{
    signals::requireInvertible(described.parameters);
    const int frequencies = described.parameters.frequencies();
    const auto frames = static_cast<std::int64_t>(described.parameters.frames(described.traceLength));
    if (described.traceLength < 2 || values.channels() != 1 || values.rows != frequencies || values.cols != frames * columns)
        throw malformed(file, "holds " + std::to_string(values.rows) + " x " + std::to_string(values.cols) + " values",
                        std::to_string(frequencies) + " x " + std::to_string(frames * columns) + ", as its parameters say");
    // Sums and squares of anything larger leave the range of numbers.
    if (!cv::checkRange(values, true, nullptr, -1e100, 1e100) || !(std::abs(described.mean) < 1e100))
        throw malformed(file, "holds values that are not finite or beyond 1e100", "a number everywhere");
}

}  // namespace

void writeSpectrogram(const fs::path& file, const Spectrogram& spectrogram)
{
    write(file, spectrogram, "complex", spectrogram.values.reshape(1));
}

void writeSpectrogram(const fs::path& file, const MagnitudeSpectrogram& spectrogram)
{
    cv::Mat values;
    spectrogram.values.convertTo(values, CV_64F);
    write(file, spectrogram, "magnitude", values);
}

std::variant<Spectrogram, MagnitudeSpectrogram> readSpectrogram(const fs::path& file)
{
    const Described told = described(file);
    cv::Mat values;
    readNpy(valuesBeside(file)).convertTo(values, CV_64F);
    if (told.kind == "complex") {
        requireFit(valuesBeside(file), told, values, 2);
        return Spectrogram{told.parameters, told.traceLength, told.mean, values.reshape(2)};
    }
    if (told.kind != "magnitude") throw malformed(file, "is of the kind \"" + told.kind + "\"", "complex or magnitude");
    requireFit(valuesBeside(file), told, values, 1);
    double least = 0;
    cv::minMaxLoc(values, &least);
    if (least < 0) throw malformed(valuesBeside(file), "holds negative magnitudes", "magnitudes >= 0");
    return MagnitudeSpectrogram{told.parameters, told.traceLength, told.mean, values};
}

}  // namespace rendering
