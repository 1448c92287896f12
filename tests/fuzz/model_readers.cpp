#include "tests/fuzz/model_readers.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "protocols/files/errors.h"
#include "rendering/models/exchange.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/seeing/checkpoint.h"
#include "rendering/models/tensors/tensor_file.h"
#include "rendering/models/training_curves.h"
#include "rendering/models/training_table.h"
#include "study/bench/bench_generators.h"
#include "study/making/image_folder.h"
#include "tests/fuzz/inputs.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;
using namespace rendering::models;

void write(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes; }

std::string read(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// ------------------------------------------------------------------ weights and training runs

/// A card of networks that see, with what they know of a fibre.
ModelCardFields seeingCard()
{
    ModelCardFields card;
    card.architecture.sees = true;
    card.architecture.fibres[std::size_t(rendering::fabrics::Fibre::Wool)] = FibreReading{0.1, 0.8, 0.6};
    return card;
}

/// The header as a text, which need not be what tensorFileBytes() writes.
std::string tensorFileWith(const std::string& header, const std::string& numbers)
{
    std::string bytes;
    for (int i = 0; i < 8; ++i) bytes += static_cast<char>(header.size() >> 8 * i & 0xff);
    return bytes + header + numbers;
}

const std::vector<TensorKind>& threeKinds()
{
    static const std::vector<TensorKind> kinds{{"a", Element::F32, {2, 3}}, {"b", Element::F16, {5}}, {"step", Element::I64, {}}};
    return kinds;
}

std::vector<StoredTensor> threeTensors()
{
    std::vector<StoredTensor> stored;
    for (const TensorKind& kind : threeKinds()) stored.push_back({kind, std::string(byteCount(kind), '\1')});
    return stored;
}

/// Behind a "+" the header alone: it gets its length and the numbers here.
void readTensors(const std::string& bytes, const TensorSource& source)
{
    const auto header = contentToPack(bytes);
    const std::string file = header ? tensorFileWith(*header, std::string(42, '\1')) : bytes;
    tensorMetadata(file, source);
    parseTensorFile(file, threeKinds(), source);
}

constexpr const char* tensorHeader =
    R"(+{"__metadata__":{"format":"x","nested":"{\"a\":[1,{\"b\":null}]}"},)"
    R"("step":{"dtype":"I64","shape":[],"data_offsets":[0,8]},)"
    R"("a":{"dtype":"F32","shape":[2,3],"data_offsets":[8,32]},"b":{"dtype":"F16","shape":[5],"data_offsets":[32,42]}})";

std::vector<Reader> tensorReaders(const fs::path& folder)
{
    const std::vector<StoredTensor> stored = threeTensors();
    const fs::path model = folder / "m.safetensors", checkpoint = folder / "m.checkpoint";
    const TensorSource source{model, "weights", "train again"};
    Checkpoint state;
    state.fingerprint = "run";
    state.validationBefore = R"({"height":0.5})";
    writeCheckpoint(checkpoint, state, stored);
    return {{"tensors",
             {tensorFileBytes({{{"format", "x"}}, stored}), tensorHeader},
             [source](const std::string& bytes) { readTensors(bytes, source); }},
            {"model-card",
             {cardText(ModelCardFields{}), cardText(seeingCard())},
             [model](const std::string& bytes) {
                 write(cardOf(model), bytes);
                 readModelCardFields(model);
             }},
            {"checkpoint",
             {read(checkpoint)},
             [checkpoint](const std::string& bytes) {
                 write(checkpoint, bytes);
                 const Checkpoint found = readCheckpoint(checkpoint, "run", threeKinds()).state;
                 if (found.step < 0 || found.bestStep < 0 || !std::isfinite(found.elapsedS))
                     throw std::runtime_error("a run with an impossible state was read");
             }},
            {"training-table",
             {"step,height,friction\n100,0.5,\n200,0.25,inf\n", "step\n7\n", "step,a\n1,0.3\n2,0.30000000000000004\n",
              "step,a\n1,1e17\n2,1.0000000000000002e17\n", "step,a,b,c\n1,-1e308,5e-324,1e-300\n2,1e308,0,1e300\n"},
             [folder](const std::string& bytes) {
                 write(folder / "losses.csv", bytes);
                 TrainingTable table = readTrainingTable(folder / "losses.csv");
                 const std::string text = csvText(table);
                 curvesSvg(table, table);
                 write(folder / "losses.csv", text);
                 if (csvText(readTrainingTable(folder / "losses.csv")) != text)
                     throw std::runtime_error("a table is not read as it was written");
                 table.dropAfter(100);
             }}};
}

// ------------------------------------------------------------------ files between the program and vis2hap-nn

cv::Mat photograph()
{
    cv::Mat image(4, 5, CV_8UC3);
    for (std::size_t byte = 0; byte < image.total() * 3; ++byte) image.data[byte] = static_cast<unsigned char>(byte * 11 % 251);
    return image;
}

/// The folder as the program leaves it for vis2hap-nn, with what vis2hap-nn answers.
fs::path exchangeIn(const fs::path& folder)
{
    const fs::path exchange = folder / "exchange";
    fs::create_directory(exchange);
    RequestWriter request(exchange, {folder / "m.safetensors", Quality::Fast, true, true});
    request.add({photograph(), 0.05});
    request.add({photograph(), std::nullopt, 135, rendering::fabrics::Fibre::Wool});
    request.finish();
    GeneratedSignals answer;
    answer.heightMm = cv::Mat(4, 5, CV_32FC1, cv::Scalar(0.25));
    answer.heightMmPerPixel = 0.05;
    answer.spectrogramParameters = {8, 2, 8, 20};
    answer.spectrogram = cv::Mat(5, 6, CV_32FC1, cv::Scalar(0.5));
    answer.trace.assign(10, 0.4);
    answer.traceMmPerSample = 0.05;
    answer.meanFriction = 0.4;
    answer.photograph.meanFriction = FrictionInterval{0.3, 0.5};
    AnswerWriter answers(exchange);
    answers.add(answer);
    answers.finish();
    return exchange;
}

void readWholeRequest(const fs::path& exchange)
{
    for (const RequestedPhotograph& one : readRequest(exchange).photographs) {
        const cv::Mat image = readPhotograph(one).photograph;
        if (image.type() != CV_8UC3 || cv::sum(image)[0] < 0) throw std::runtime_error("another kind of photograph was read");
    }
}

/// Uses every number, so that the address sanitizer checks it.
void readWholeAnswer(const fs::path& exchange)
{
    for (const GeneratedSignals& answer : readAnswers(exchange)) {
        double sum = answer.meanFriction;
        for (const double value : answer.trace) sum += value * 1e-200;
        for (const cv::Mat& map : {answer.heightMm, answer.spectrogram})
            for (int row = 0; row < map.rows; ++row)
                for (int column = 0; column < map.cols; ++column) sum += map.at<float>(row, column) * 1e-200;
        if (!std::isfinite(sum)) throw std::runtime_error("an answer that is not finite was read");
        if (!answer.heightMm.empty() && !(answer.heightMmPerPixel > 0))
            throw std::runtime_error("a height without a scale was read");
        if (!answer.trace.empty() && !(answer.meanFriction > 0 && answer.meanFriction < 1e3 && answer.traceMmPerSample > 0))
            throw std::runtime_error("a trace without friction or step was read");
        if (const auto& interval = answer.photograph.meanFriction;
            interval && !(0 < interval->low && interval->low <= interval->high))
            throw std::runtime_error("an interval that is none was read");
    }
}

/// Reads the bytes in place of one file of the folder, beside its sound files. Arrays of another kind are tried, too.
Reader exchangeReader(const std::string& name, const fs::path& file, void (*readFolder)(const fs::path&))
{
    const std::string sound = read(file);
    std::vector<std::string> corpus{sound};
    for (const std::string_view part : {"\"mean_friction\":", "\"height_mm_per_pixel\":", "\"trace_mm_per_sample\":"})
        if (const std::size_t at = sound.find(part); at != std::string::npos)
            for (const char* other : {"-", "1e300,\"x\":", "1e-300,\"x\":"})
                corpus.push_back(std::string(sound).insert(at + part.size(), other));
    if (file.extension() == ".npy")
        for (const char* other : {"photo1.npy", "height0.npy", "trace0.npy"}) corpus.push_back(read(file.parent_path() / other));
    return {name, std::move(corpus), [file, sound, readFolder](const std::string& bytes) {
                struct PutBack {
                    const fs::path& file;
                    const std::string& sound;
                    ~PutBack() { write(file, sound); }
                } const putBack{file, sound};
                write(file, bytes);
                readFolder(file.parent_path());
            }};
}

std::vector<Reader> exchangeReaders(const fs::path& folder)
{
    const fs::path exchange = exchangeIn(folder);
    return {exchangeReader("nn-request", exchange / "request.json", readWholeRequest),
            exchangeReader("nn-photograph", exchange / "photo0.npy", readWholeRequest),
            exchangeReader("nn-answer", exchange / "answer.json", readWholeAnswer),
            exchangeReader("nn-height", exchange / "height0.npy", readWholeAnswer),
            exchangeReader("nn-spectrogram", exchange / "spectrogram0.npy", readWholeAnswer),
            exchangeReader("nn-trace", exchange / "trace0.npy", readWholeAnswer),
            {"nn-bench",
             {R"({"peak_mb_at_128":310.5,"peak_mb_at_largest":2900,"qualities":[{"quality":"fast","ms_per_photograph":40.25,)"
              R"("mean_friction_relative_error":0.08,"height_deviation_from_accurate_mm":0.011,"ms_at_128":12.5,)"
              R"("relief_error_percent":31,"ratio_at_128_to_version_0_5_0":0.9},{"quality":"accurate","ms_per_photograph":90,)"
              R"("mean_friction_relative_error":0.07,"height_deviation_from_accurate_mm":0,"ms_at_128":30,)"
              R"("relief_error_percent":28,"ratio_at_128_to_version_0_5_0":0}]})"},
             [](const std::string& bytes) {
                 for (const auto& row : study::bench::rowsOfGenerators(bytes))
                     require(!row.stage.empty(), "a row without a stage was read");
             }}};
}

// ------------------------------------------------------------------ kept friction images

Reader imageFolderReader(const fs::path& folder)
{
    const fs::path images = folder / "images";
    const protocols::FabricId fabric("F01");
    rendering::RenderRequest request;
    request.fabrics = {fabric};
    request.conditions = {protocols::ConditionId("h&f")};
    rendering::RenderedFabrics rendered;
    rendered.conditions.emplace_back().condition = request.conditions.front();
    rendered.conditions.front().images[fabric] = cv::Mat(4, 5, CV_8UC1, cv::Scalar(7));
    study::making::writeImageFolder(images, "key", "{}", rendered, R"({"height":[0.5]})", {"a stamp"});
    const fs::path manifest = images / "images.json";
    const std::string nested = R"({"key":"key","stamps":[],"signals":)" + std::string(30000, '[') + std::string(30000, ']') + "}";
    return {"images", {read(manifest), nested}, [images, manifest, request](const std::string& bytes) {
                write(manifest, bytes);
                const auto kept = study::making::readImageFolder(images, "key", request);
                if (kept && kept->images.size() != 1) throw std::runtime_error("images of another study were kept");
            }};
}

}  // namespace

std::vector<Reader> modelReaders(const fs::path& folder)
{
    std::vector<Reader> readers = tensorReaders(folder);
    for (Reader& more : exchangeReaders(folder)) readers.push_back(std::move(more));
    readers.push_back(imageFolderReader(folder));
    return readers;
}

}  // namespace fuzz
