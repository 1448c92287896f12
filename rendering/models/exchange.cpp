#include "rendering/models/exchange.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"

namespace rendering::models {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* requestSchema = "vis2hap.generate/1";
constexpr const char* answerSchema = "vis2hap.generated/1";

ordered_json written(const fs::path& folder, const std::string& name, const cv::Mat& array)
{
    if (array.empty()) return nullptr;
    writeNpy(folder / name, array, protocols::Sync::Later);
    return name;
}

ordered_json numberOrNull(const std::optional<double>& number) { return number ? ordered_json(*number) : ordered_json(nullptr); }

/// Files lie in the folder itself. Throws std::invalid_argument for a name that leads out of it.
fs::path fileIn(const fs::path& folder, const nlohmann::json& name)
{
    const fs::path file = name.get<std::string>();
    if (file.empty() || file != file.filename()) throw std::invalid_argument("\"" + file.string() + "\" is no name of a file");
    return folder / file;
}

/// Empty for null. Throws std::invalid_argument for other elements than `type` and for values that are not finite.
cv::Mat readBack(const fs::path& folder, const nlohmann::json& name, int type)
{
    if (name.is_null()) return {};
    const fs::path file = fileIn(folder, name);
    cv::Mat array = readNpy(file);
    if (array.type() != type || !cv::checkRange(array))
        throw std::invalid_argument(file.filename().string() + " holds values of another type, or values that are not finite");
    return array;
}

constexpr double largestScale = 1e9;     // as in samples.csv
constexpr double largestFriction = 1e3;  // a coefficient

double positive(const nlohmann::json& object, const char* name, double below = largestScale)
{
    const double value = object.at(name).get<double>();
    if (!(value > 0 && value < below))
        throw std::invalid_argument(std::string(name) + " is no number above 0 and below " + protocols::shortest(below));
    return value;
}

int whole(const nlohmann::json& object, const char* name)
{
    constexpr std::int64_t most = 1 << 24;
    const nlohmann::json& value = object.at(name);
    if (!value.is_number_integer() || value.get<std::int64_t>() < 1 || value.get<std::int64_t>() > most)
        throw std::invalid_argument(std::string(name) + " is no whole number from 1 to 2^24");
    return value.get<int>();
}

void readSpectrogram(GeneratedSignals& answer, const fs::path& folder, const nlohmann::json& item)
{
    answer.spectrogram = readBack(folder, item.at("spectrogram"), CV_32FC1);
    if (answer.spectrogram.empty()) return;
    const nlohmann::json& parameters = item.at("spectrogram_parameters");
    answer.spectrogramParameters = {whole(parameters, "window"), whole(parameters, "hop"), whole(parameters, "fft"),
                                    positive(parameters, "samples_per_mm")};
    // The rows come first: they bound the length of the windows.
    if (answer.spectrogram.rows != answer.spectrogramParameters.frequencies())
        throw std::invalid_argument("the spectrogram has " + std::to_string(answer.spectrogram.rows) + " frequencies");
    signals::requireInvertible(answer.spectrogramParameters);
}

std::optional<FrictionInterval> intervalIn(const nlohmann::json& item)
{
    if (item.is_null()) return std::nullopt;
    const FrictionInterval interval{item.at(0).get<double>(), item.at(1).get<double>()};
    if (!(interval.low > 0 && interval.low <= interval.high && interval.high < largestFriction))
        throw std::invalid_argument("mean_friction_interval is no interval of coefficients");
    return interval;
}

GeneratedSignals answerIn(const fs::path& folder, const nlohmann::json& item)
{
    GeneratedSignals answer;
    answer.heightMm = readBack(folder, item.at("height"), CV_32FC1);
    if (!answer.heightMm.empty()) answer.heightMmPerPixel = positive(item, "height_mm_per_pixel");
    readSpectrogram(answer, folder, item);
    const cv::Mat trace = readBack(folder, item.at("trace"), CV_64FC1);
    if (!trace.empty()) {
        answer.trace.assign(trace.ptr<double>(), trace.ptr<double>() + trace.total());
        answer.traceMmPerSample = positive(item, "trace_mm_per_sample");
        answer.meanFriction = positive(item, "mean_friction", largestFriction);
        answer.photograph.meanFriction = intervalIn(item.at("mean_friction_interval"));
    }
    answer.heightMilliseconds = item.value("height_ms", 0.0);
    answer.frictionMilliseconds = item.value("friction_ms", 0.0);
    return answer;
}

}  // namespace

namespace {

fabrics::Fibre fibreNamed(const std::string& name)
{
    if (const auto fibre = fabrics::fibreFrom(name)) return *fibre;
    throw std::invalid_argument("unknown fibre '" + name + "'");
}

}  // namespace

Quality qualityNamed(std::string_view name)
{
    if (const auto quality = protocols::qualityFrom(name)) return *quality;
    throw protocols::badInput(
        {"unknown quality '" + std::string(name) + "'", "--quality", "fast, balanced or accurate", "correct the option"});
}

RequestWriter::RequestWriter(fs::path folder, GenerationOptions options)
    : m_folder(std::move(folder)), m_options(std::move(options))
{
}

void RequestWriter::add(const InputPhotograph& photograph)
{
    const std::string name = "photo" + std::to_string(m_photographs.size()) + ".npy";
    const cv::Mat whole = photograph.photograph.isContinuous() ? photograph.photograph : photograph.photograph.clone();
    writeNpy(m_folder / name, whole.reshape(1), protocols::Sync::Later);
    m_photographs.push_back({name, photograph.mmPerPixel, photograph.lightDeg, photograph.fibre});
}

void RequestWriter::finish() const
{
    ordered_json photographs = ordered_json::array();
    for (const auto& [file, mmPerPixel, lightDeg, fibre] : m_photographs)
        photographs.push_back({{"file", file.string()},
                               {"mm_per_pixel", numberOrNull(mmPerPixel)},
                               {"light_deg", numberOrNull(lightDeg)},
                               {"fibre", fibre ? ordered_json(nameOf(*fibre)) : ordered_json()}});
    const ordered_json json{
        {"schema", requestSchema},    {"model", m_options.model.string()}, {"quality", nameOf(m_options.quality)},
        {"height", m_options.height}, {"friction", m_options.friction},    {"photographs", photographs}};
    protocols::writeWholeFile(m_folder / "request.json", json.dump() + "\n", protocols::Sync::Later);
}

GenerationRequest readRequest(const fs::path& folder)
{
    const fs::path file = folder / "request.json";
    const auto refused = [&](const std::string& what) {
        return protocols::badInput({what, file.string(), requestSchema, "build both executables again"});
    };
    const nlohmann::json json = protocols::parseStrictJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
    GenerationRequest request;
    try {
        if (json.at("schema").get<std::string>() != requestSchema) throw refused("has another schema");
        const std::string model = json.at("model").get<std::string>();
        request.options.model = model.empty() ? shippedModel() : fs::path(model);
        request.options.quality = qualityNamed(json.at("quality").get<std::string>());
        request.options.height = json.at("height").get<bool>();
        request.options.friction = json.at("friction").get<bool>();
        for (const nlohmann::json& item : json.at("photographs")) {
            RequestedPhotograph photograph{fileIn(folder, item.at("file"))};
            if (!item.at("mm_per_pixel").is_null()) photograph.mmPerPixel = positive(item, "mm_per_pixel");
            if (!item.at("light_deg").is_null()) photograph.lightDeg = item.at("light_deg").get<double>();
            if (item.contains("fibre") && !item.at("fibre").is_null())
                photograph.fibre = fibreNamed(item.at("fibre").get<std::string>());
            request.photographs.push_back(photograph);
        }
    } catch (const nlohmann::json::exception& fault) {
        throw refused(fault.what());
    } catch (const std::invalid_argument& fault) {
        throw refused(fault.what());
    }
    return request;
}

InputPhotograph readPhotograph(const RequestedPhotograph& photograph)
{
    const cv::Mat flat = readNpy(photograph.file);
    if (flat.type() != CV_8UC1 || flat.cols < 3 || flat.cols % 3 != 0)
        throw protocols::badInput(
            {"is not a photograph", photograph.file.string(), "uint8 [height x 3 width]", "build both executables again"});
    return {flat.reshape(3), photograph.mmPerPixel, photograph.lightDeg, photograph.fibre};
}

AnswerWriter::AnswerWriter(fs::path folder) : m_folder(std::move(folder)) {}

void AnswerWriter::add(const GeneratedSignals& answer)
{
    const std::string number = std::to_string(m_signals.size());
    const cv::Mat trace = answer.trace.empty() ? cv::Mat() : cv::Mat(answer.trace, true).reshape(1, 1);
    const auto& parameters = answer.spectrogramParameters;
    const auto& interval = answer.photograph.meanFriction;
    const ordered_json signals{
        {"height", written(m_folder, "height" + number + ".npy", answer.heightMm)},
        {"height_mm_per_pixel", answer.heightMmPerPixel},
        {"spectrogram", written(m_folder, "spectrogram" + number + ".npy", answer.spectrogram)},
        {"spectrogram_parameters",
         {{"window", parameters.windowLength},
          {"hop", parameters.hop},
          {"fft", parameters.fftSize},
          {"samples_per_mm", parameters.sampleRateHz}}},
        {"trace", written(m_folder, "trace" + number + ".npy", trace)},
        {"trace_mm_per_sample", answer.traceMmPerSample},
        {"mean_friction", answer.meanFriction},
        {"mean_friction_interval", interval ? ordered_json{interval->low, interval->high} : ordered_json()},
        {"height_ms", answer.heightMilliseconds},
        {"friction_ms", answer.frictionMilliseconds}};
    m_signals.push_back(signals.dump());
}

void AnswerWriter::finish() const
{
    ordered_json signals = ordered_json::array();
    for (const std::string& object : m_signals) signals.push_back(ordered_json::parse(object));
    protocols::writeWholeFile(m_folder / "answer.json",
                              ordered_json{{"schema", answerSchema}, {"signals", signals}}.dump() + "\n", protocols::Sync::Later);
}

std::vector<GeneratedSignals> readAnswers(const fs::path& folder)
{
    const fs::path file = folder / "answer.json";
    std::vector<GeneratedSignals> answers;
    try {
        const nlohmann::json json =
            protocols::parseStrictJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
        if (json.at("schema") != answerSchema) throw std::invalid_argument("has another schema");
        for (const nlohmann::json& item : json.at("signals")) answers.push_back(answerIn(folder, item));
    } catch (const std::exception& fault) {
        throw protocols::workFailed({std::string("the answer of vis2hap-nn cannot be read: ") + fault.what(), file.string(),
                                     answerSchema, "build both executables again, so that their versions match"});
    }
    return answers;
}

}  // namespace rendering::models
