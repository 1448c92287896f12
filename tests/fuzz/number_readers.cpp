#include "tests/fuzz/number_readers.h"

#include <QImage>
#include <QPainter>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "rendering/fabrics/dataset_json.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/signals/friction_trace.h"
#include "study/analyse/analyse.h"
#include "study/analyse/power/kept_counts.h"
#include "study/analyse/request_file.h"
#include "study/looking/plot.h"
#include "study/looking/read_trace.h"

namespace fuzz {

namespace {

namespace fs = std::filesystem;

void writeFile(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// ------------------------------------------------------------------ requests for analyses

/// A value that suits a field of this name in most analyses.
nlohmann::ordered_json valueOf(const std::string& field)
{
    static const nlohmann::ordered_json values = nlohmann::ordered_json::parse(R"({
        "kind":"paired","x":[1,2.5,3,4,6],"y":[2,2,3.5,5,5],"t":2.1,"n":[20,20,20],"k":[8,12,18],"m":3,"p0":"1/3","level":[1,2,3],
        "b":[[1,2],[2,3]],"c":4,"p":[0.01,0.02,0.4],"rows":[[1,0,1],[0,0,1],[1,1,1],[1,0,0]],"groups":[[1,2,3],[2,3,5],[4,5,7]],
        "value":[1,2,3,4,2,3,4,6],"a":[[1,2],[2,1]],"participant":["P1","P1","P2","P2","P3","P3","P4","P4"],
        "fabric":["F1","F2","F1","F2","F1","F2","F1","F2"],"condition":["h","f","f","h","h","f","f","h"],
        "correct":[1,0,1,1,0,1,1,0],"rating":[1,2,3,4,2,3,4,6],"seconds":[1,2,3,4,2,3,4,6],"generated":[1,2,3,2,1,2,3,2],
        "truth":[1,2,3,3,1,2,2,2],"pc":[0.5,0.7,0.9],"rt":[1,2,3],"low":-1,"high":1,"data_range":255,"design":"within"})");
    return values.value(field, nlohmann::ordered_json(1));
}

nlohmann::ordered_json fieldsIn(std::string_view list)
{
    auto fields = nlohmann::ordered_json::object();
    std::istringstream words{std::string(list)};
    for (std::string word; words >> word;)
        if (word.front() != '[') fields[word] = valueOf(word);
    return fields;
}

std::string requestOf(const std::string& analysis, const nlohmann::ordered_json& inputs, const nlohmann::ordered_json& options)
{
    const nlohmann::ordered_json one{{"id", "a"}, {"analysis", analysis}, {"inputs", inputs}, {"options", options}};
    return nlohmann::ordered_json{{"cases", {one}}}.dump();
}

/// Requests of some kilobytes that ask for gigabytes or minutes.
std::vector<std::string> greedyRequests()
{
    using nlohmann::ordered_json;
    ordered_json ids = ordered_json::array(), ones = ordered_json::array(), levels = ordered_json::array();
    for (int i = 0; i < 1200; ++i) {
        ids.push_back(i);
        ones.push_back(i % 2);
        levels.push_back(i / 40);
    }
    std::vector<std::string> corpus;
    for (const char* model : {"linear_mixed", "r_squared", "claims"})
        corpus.push_back(requestOf(model, {{"value", ones}, {"condition", ids}, {"participant", levels}}, {}));
    corpus.push_back(
        requestOf("speed_contrasts", {{"seconds", ones}, {"correct", ones}, {"condition", ids}, {"participant", ids}}, {}));
    corpus.push_back(requestOf("anova_oneway", {{"y", ones}, {"group", ids}}, {}));
    // Recipes near their limit are left out: unoptimised code takes longer for them than an input may.
    const ordered_json wide{{"recipe", "x=i*i mod 7, i=0..39999"}};
    corpus.push_back(requestOf("rm_anova_oneway", {{"rows", ordered_json::array({wide, wide, wide})}}, {}));
    corpus.push_back(requestOf("spectrum_distance", {{"generated", wide}, {"truth", wide}}, {{"segment", 39999}}));
    corpus.push_back(requestOf("registered_ssim", {{"recipe", "a=i mod 7, b=i mod 5, 300 rows x 300 cols"}},
                               {{"data_range", 9}, {"most_shift", 280}}));
    corpus.push_back(requestOf("bca_bootstrap_mean", {{"x", {1, 2, 4, 7}}}, {{"n_resamples", 99999999}}));
    return corpus;
}

/// A request that ran out of memory is a fault, although answers take it as one more error: requests here have 64 KB.
void readRequests(const std::string& bytes, const fs::path& folder)
{
    const auto answers = study::analyse::answersTo(bytes, "r.json", folder);
    if (answers.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).empty())
        throw std::runtime_error("no answer was written");
    for (const auto& [id, answer] : answers.items()) {
        const std::string error = answer.contains("error") ? answer["error"].get<std::string>() : "";
        for (const char* sign : {"bad_alloc", "max_size", "vector::"})
            if (error.starts_with("the analysis failed") && error.find(sign) != std::string::npos)
                throw std::runtime_error("a small request asked for too much memory: " + error);
    }
}

/// A request for each analysis, and some with recipes, roots and files.
std::vector<std::string> requests(const fs::path& folder)
{
    std::vector<std::string> corpus;
    for (const auto& one : study::analyse::analyses())
        corpus.push_back(requestOf(std::string(one.name), fieldsIn(one.inputs), fieldsIn(one.options)));
    writeFile(folder / "numbers.csv", "x,y\n1,2\n2,NA\n3,5\n");
    corpus.push_back(requestOf("describe", {{"recipe", "x_i = sin(i/3) + 2*(i mod 7), i = 0 .. 99"}}, {}));
    corpus.push_back(requestOf("describe", {{"x", {"1/3", "sqrt(2)/2", "inf", "1e400", nullptr}}}, {}));
    corpus.push_back(requestOf("ssim", {{"a", "i row-major"}, {"b", "i row-major"}, {"shape", {4, 4}}}, {{"data_range", 9}}));
    corpus.push_back(requestOf("bca_bootstrap_mean", {{"x", {1, 2, 4, 7}}}, {{"n_resamples", 200}, {"seed", 3}}));
    for (std::string& one : greedyRequests()) corpus.push_back(std::move(one));
    return corpus;
}

// ------------------------------------------------------------------ finished counts

/// Small enough that the settings of every input can be compared.
struct CountOptions {
    CountOptions()
    {
        calibrated.simulation.studies = planted.simulation.studies = 10;
        planted.contrasts = {{0, 1}};
    }
    stats::CalibrationOptions calibrated;
    stats::PlantedOptions planted;
};

std::string countsOf(const fs::path& file)
{
    CountOptions options;
    study::analyse::KeptCounts kept(file);
    resumeFrom(kept, options.calibrated);
    resumeFrom(kept, options.planted);
    options.calibrated.finished("a", {{10, 1, 0}, {10, 0, 2}});
    options.planted.finished("b", {{"different", false, {10, 4, 4}, {10, 3, 3}, {10, 5, 5}, {10, -2, 2}}});
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void readCounts(const fs::path& file)
{
    CountOptions options;
    study::analyse::KeptCounts kept(file);
    resumeFrom(kept, options.calibrated);
    resumeFrom(kept, options.planted);
    for (const auto& one : options.calibrated.counted("a", 10))
        if (one.rejected > one.studies || one.undefined > one.studies)
            throw std::runtime_error("more rejections than studies were read");
    for (const auto& row : options.planted.counted("b", 10))
        if (!std::isfinite(row.these.sum)) throw std::runtime_error("a sum that is not finite was read");
}

// ------------------------------------------------------------------ friction

const std::string forces = "t_s,normal_n,tangential_n\n0,0.5,0.1\n0.1,0.5,0.2\n0.2,0.6,0.2\n0.3,0.5,0.3\n";

/// A stroke of 100 Hz. The last stamp is `lastS` seconds late.
std::string strokeOfCoefficients(double lastS)
{
    std::ostringstream text;
    text << "t_s,mu\n";
    for (int i = 0; i < 20; ++i) text << (i < 19 ? i * 0.01 : i * 0.01 + lastS) << ',' << 0.3 + 0.01 * (i % 7) << '\n';
    return text.str();
}

const std::string coefficients = "t_s,mu\n0,0.5\n0.1,0.6\n0.2,0.4\n";
const std::string trace = "t_s,position_mm,normal_n,tangential_n\n0,0,0.5,0.2\n0.001,0.05,0.5,0.21\n0.002,0.1,0.5,0.19\n";

void readRecord(const rendering::fabrics::Dataset& dataset, const std::string& bytes)
{
    const protocols::FabricId fabric("F01");
    writeFile(samplePath(dataset, fabric, rendering::fabrics::Modality::Friction, 0), bytes);
    const auto record = readFriction(dataset, fabric, 0);
    if (record.values.size() != record.timeS.size() || !(record.sampleRateHz > 0))
        throw std::runtime_error("a record without a sample rate was read");
    const auto even = rendering::signals::frictionTrace(record, "000.csv");
    if (!std::isfinite(even.sampleRateHz) || even.values.size() > record.values.size())
        throw std::runtime_error("a trace is longer than its record");
}

/// Draws the curve as a sheet does, and makes its ticks. Texts would need a window system.
void drawSeenTrace(const study::looking::SeenSignal& signal)
{
    using namespace study::looking;
    const auto& seen = std::get<SeenTrace>(signal.what);
    const double length = seen.places.back() - seen.places.front();
    const PlotAxis x{seen.places.front(), seen.places.front() + (length > 0 ? length : 1), {}}, y = axisAround(seen.values, {});
    for (const PlotAxis& axis : {x, y, PlotAxis{0, seen.sampleRateHz.value_or(1) / 2, {}}})
        for (const double tick : ticksBetween(axis.low, axis.high, 6))
            if (!std::isfinite(tick)) throw std::runtime_error("a tick is not finite");
    QImage picture(64, 32, QImage::Format_RGB32);
    picture.fill(Qt::white);
    QPainter painter(&picture);
    drawCurve(painter, QRectF(2, 2, 60, 28), x, y, seen.places, seen.values, lightSheet());
    warningsOf(signal, factsOf(signal));
}

rendering::fabrics::Dataset datasetIn(const fs::path& folder)
{
    auto dataset = rendering::fabrics::datasetFromJson(
        R"({"schema":"vis2hap.dataset/1","name":"d","fabrics":[{"id":"F01","name":"a","structure":"b"}],)"
        R"("friction":{"sample_rate_hz":60,"speed_mm_per_s":5,"length_mm":40},"pairing":"weak","procedural":true,"licence":"x"})",
        "d.json");
    dataset.folder = folder / "dataset";
    fs::create_directories(samplePath(dataset, dataset.fabrics[0].id, rendering::fabrics::Modality::Friction, 0).parent_path());
    return dataset;
}

}  // namespace

std::vector<Reader> numberReaders(const fs::path& folder)
{
    const auto dataset = datasetIn(folder);
    return {{"requests", requests(folder), [folder](const std::string& bytes) { readRequests(bytes, folder); }},
            {"counts",
             {countsOf(folder / "counts.json")},
             [folder](const std::string& bytes) {
                 writeFile(folder / "counts.json", bytes);
                 readCounts(folder / "counts.json");
             }},
            {"friction-record",
             {strokeOfCoefficients(0), forces, coefficients, strokeOfCoefficients(3600), strokeOfCoefficients(1e308),
              "t_s,mu\n-1e308,0.5\n1e308,0.6\n", "t_s,mu\n0,0.5\n1e-320,0.6\n"},
             [dataset](const std::string& bytes) { readRecord(dataset, bytes); }},
            {"trace",
             {trace, forces, coefficients, "taxel_sum\n1\n\n3\n", strokeOfCoefficients(0) + strokeOfCoefficients(0).substr(7),
              "t_s,mu\n-1e308,0.5\n1e308,0.6\n", "t_s,mu\n0,0.5\n1e-320,0.6\n2e-320,0.5\n", "t_s,mu\n0,-1e308\n1,1e308\n",
              "t_s,mu\n1e17,0.3\n1.0000000000000002e17,0.30000000000000004\n"},
             [folder](const std::string& bytes) {
                 writeFile(folder / "trace.csv", bytes);
                 drawSeenTrace(study::looking::readTrace(folder / "trace.csv", {}));
             }}};
}

}  // namespace fuzz
