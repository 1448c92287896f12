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
using nlohmann::ordered_json;
using signals::MagnitudeSpectrogram;
using signals::Spectrogram;
using signals::SpectrogramParameters;

constexpr const char* schema = "vis2hap.spectrogram/1";

fs::path valuesBeside(const fs::path& file)
{
    fs::path values = file;
    return values.replace_extension(".npy");
}

template <class AnySpectrogram>
void write(const fs::path& file, const AnySpectrogram& spectrogram, const char* kind, const cv::Mat& values, protocols::Sync sync)
{
    const auto& parameters = spectrogram.parameters;
    const ordered_json json{{"schema", schema},
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
    writeNpy(valuesBeside(file), values, sync);
    protocols::writeWholeFile(file, json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n", sync);
}

protocols::Error notASpectrogram(const fs::path& file, const std::string& what, const std::string& expected)
{
    return protocols::badInput({.what = what, .where = file.string(), .expected = expected, .nextStep = "write the file again"});
}

/// Contents of NAME.json.
struct SpectrogramHeader {
    std::string kind;
    SpectrogramParameters parameters;
    int traceLength = 0;
    double mean = 0;
};

SpectrogramHeader headerIn(const fs::path& file)
{
    try {
        const nlohmann::json json =
            protocols::parseStrictJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
        if (json.at("schema") != schema)
            throw notASpectrogram(file, "is not a spectrogram", std::string("\"schema\": \"") + schema + "\"");
        const auto whole = [&](const char* name) {
            if (!json.at(name).is_number_integer())
                throw notASpectrogram(file, std::string(name) + " is not a whole number", "1 or more");
            const auto value = json.at(name).get<std::int64_t>();
            if (value < 0 || value > 1'000'000'000)
                throw notASpectrogram(file, std::string(name) + " is out of range", "up to 10^9");
            return static_cast<int>(value);
        };
        SpectrogramHeader result{
            json.at("kind").get<std::string>(),
            {whole("window_length"), whole("hop"), whole("fft_size"), json.at("sample_rate_hz").get<double>()},
            whole("trace_length"),
            json.at("mean").get<double>()};
        // Longer transforms than any trace would allocate tables of any size.
        if (result.parameters.fftSize > (1 << 24)) throw notASpectrogram(file, "fft_size is out of range", "up to 2^24");
        return result;
    } catch (const nlohmann::json::exception& fault) {
        throw notASpectrogram(file, "is not a spectrogram (" + std::string(fault.what()) + ")",
                              "the fields of " + std::string(schema));
    }
}

void requireFit(const fs::path& file, const SpectrogramHeader& header, const cv::Mat& values, int columns)
{
    signals::requireInvertible(header.parameters);
    const int frequencies = header.parameters.frequencies();
    const auto frames = static_cast<std::int64_t>(header.parameters.frames(header.traceLength));
    if (header.traceLength < 2 || values.channels() != 1 || values.rows != frequencies || values.cols != frames * columns)
        throw notASpectrogram(
            file, "holds " + std::to_string(values.rows) + " x " + std::to_string(values.cols) + " values",
            std::to_string(frequencies) + " x " + std::to_string(frames * columns) + " values, by its parameters");
    // Sums and squares of larger values would overflow.
    if (!cv::checkRange(values, true, nullptr, -1e100, 1e100) || !(std::abs(header.mean) < 1e100))
        throw notASpectrogram(file, "holds values that are not finite or exceed 1e100", "finite numbers");
}

}  // namespace

void writeSpectrogram(const fs::path& file, const Spectrogram& spectrogram, protocols::Sync sync)
{
    write(file, spectrogram, "complex", spectrogram.values.reshape(1), sync);
}

void writeSpectrogram(const fs::path& file, const MagnitudeSpectrogram& spectrogram, protocols::Sync sync)
{
    cv::Mat values;
    spectrogram.values.convertTo(values, CV_64F);
    write(file, spectrogram, "magnitude", values, sync);
}

std::variant<Spectrogram, MagnitudeSpectrogram> readSpectrogram(const fs::path& file)
{
    const SpectrogramHeader header = headerIn(file);
    cv::Mat values;
    readNpy(valuesBeside(file)).convertTo(values, CV_64F);
    if (header.kind == "complex") {
        requireFit(valuesBeside(file), header, values, 2);
        return Spectrogram{header.parameters, header.traceLength, header.mean, values.reshape(2)};
    }
    if (header.kind != "magnitude") throw notASpectrogram(file, "has the kind \"" + header.kind + "\"", "complex or magnitude");
    requireFit(valuesBeside(file), header, values, 1);
    double least = 0;
    cv::minMaxLoc(values, &least);
    if (least < 0) throw notASpectrogram(valuesBeside(file), "holds negative magnitudes", "magnitudes >= 0");
    return MagnitudeSpectrogram{header.parameters, header.traceLength, header.mean, values};
}

}  // namespace rendering
