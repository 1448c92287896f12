#include "rendering/models/exchange.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"

namespace rendering::models {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* requestSchema = "vis2hap.generate/1";
constexpr const char* answerSchema = "vis2hap.generated/1";
constexpr std::pair<Quality, const char*> qualities[] = {
    {Quality::Fast, "fast"}, {Quality::Balanced, "balanced"}, {Quality::Accurate, "accurate"}};

ordered_json written(const fs::path& folder, const std::string& name, const cv::Mat& array)
{
    if (array.empty()) return nullptr;
    writeNpy(folder / name, array, protocols::Sync::Later);
    return name;
}

ordered_json numberOrNull(const std::optional<double>& number) { return number ? ordered_json(*number) : ordered_json(nullptr); }

cv::Mat readBack(const fs::path& folder, const ordered_json& name)
{
    return name.is_null() ? cv::Mat() : readNpy(folder / name.get<std::string>());
}

}  // namespace

std::string nameOf(Quality quality)
{
    for (const auto& [value, name] : qualities)
        if (value == quality) return name;
    return {};
}

Quality qualityNamed(std::string_view name)
{
    for (const auto& [value, known] : qualities)
        if (name == known) return value;
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
    m_photographs.push_back({name, photograph.mmPerPixel});
}

void RequestWriter::finish() const
{
    ordered_json photographs = ordered_json::array();
    for (const auto& [file, mmPerPixel] : m_photographs)
        photographs.push_back({{"file", file.string()}, {"mm_per_pixel", numberOrNull(mmPerPixel)}});
    const ordered_json json{
        {"schema", requestSchema},    {"model", m_options.model.string()}, {"quality", nameOf(m_options.quality)},
        {"height", m_options.height}, {"friction", m_options.friction},    {"photographs", photographs}};
    protocols::writeWholeFile(m_folder / "request.json", json.dump() + "\n", protocols::Sync::Later);
}

GenerationRequest readRequest(const fs::path& folder)
{
    const fs::path file = folder / "request.json";
    const std::string text = protocols::readWholeFile(file);
    GenerationRequest request;
    try {
        const ordered_json json = ordered_json::parse(text);
        if (json.at("schema").get<std::string>() != requestSchema)
            throw protocols::badInput({"has another schema", file.string(), requestSchema, "build both executables again"});
        const std::string model = json.at("model").get<std::string>();
        request.options.model = model.empty() ? shippedModel() : fs::path(model);
        request.options.quality = qualityNamed(json.at("quality").get<std::string>());
        request.options.height = json.at("height").get<bool>();
        request.options.friction = json.at("friction").get<bool>();
        for (const ordered_json& item : json.at("photographs")) {
            const ordered_json& pitch = item.at("mm_per_pixel");
            request.photographs.push_back({folder / item.at("file").get<std::string>(),
                                           pitch.is_null() ? std::nullopt : std::optional(pitch.get<double>())});
        }
    } catch (const ordered_json::exception& fault) {
        throw protocols::badInput({fault.what(), file.string(), requestSchema, "build both executables again"});
    }
    return request;
}

InputPhotograph readPhotograph(const RequestedPhotograph& photograph)
{
    const cv::Mat flat = readNpy(photograph.file);
    if (flat.type() != CV_8UC1 || flat.cols < 3 || flat.cols % 3 != 0)
        throw protocols::badInput(
            {"is not a photograph", photograph.file.string(), "uint8 [height x 3 width]", "build both executables again"});
    return {flat.reshape(3), photograph.mmPerPixel};
}

AnswerWriter::AnswerWriter(fs::path folder) : m_folder(std::move(folder)) {}

void AnswerWriter::add(const GeneratedSignals& answer)
{
    const std::string number = std::to_string(m_signals.size());
    const cv::Mat trace = answer.trace.empty() ? cv::Mat() : cv::Mat(answer.trace, true).reshape(1, 1);
    const auto& parameters = answer.spectrogramParameters;
    const ordered_json signals{{"height", written(m_folder, "height" + number + ".npy", answer.heightMm)},
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
                               {"distance", numberOrNull(answer.photograph.distance)},
                               {"usual_distance", answer.photograph.usualDistance}};
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
        const ordered_json json = ordered_json::parse(protocols::readWholeFile(file));
        for (const ordered_json& item : json.at("signals")) {
            GeneratedSignals answer;
            answer.heightMm = readBack(folder, item.at("height"));
            answer.heightMmPerPixel = item.at("height_mm_per_pixel").get<double>();
            answer.spectrogram = readBack(folder, item.at("spectrogram"));
            const ordered_json& parameters = item.at("spectrogram_parameters");
            answer.spectrogramParameters = {parameters.at("window").get<int>(), parameters.at("hop").get<int>(),
                                            parameters.at("fft").get<int>(), parameters.at("samples_per_mm").get<double>()};
            const cv::Mat trace = readBack(folder, item.at("trace"));
            if (!trace.empty()) answer.trace.assign(trace.ptr<double>(), trace.ptr<double>() + trace.total());
            answer.traceMmPerSample = item.at("trace_mm_per_sample").get<double>();
            answer.meanFriction = item.at("mean_friction").get<double>();
            if (const ordered_json& distance = item.at("distance"); !distance.is_null())
                answer.photograph.distance = distance.get<double>();
            answer.photograph.usualDistance = item.at("usual_distance").get<double>();
            answers.push_back(answer);
        }
    } catch (const std::exception& fault) {
        throw protocols::workFailed({std::string("the answer of vis2hap-nn cannot be read: ") + fault.what(), file.string(),
                                     answerSchema, "build both executables again, so that their versions match"});
    }
    return answers;
}

}  // namespace rendering::models
