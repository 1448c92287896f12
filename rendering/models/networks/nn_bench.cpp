#include "rendering/models/networks/nn_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/models/exchange.h"
#include "rendering/models/networks/inference.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::models {

namespace {

using fabrics::Modality;

constexpr double benchMmPerPixel = 0.05;  ///< of the noise whose memory is measured

/// A photograph and the measured values of its fabric.
struct BenchCase {
    InputPhotograph photograph;
    std::optional<double> meanFriction, heightSpreadMm;
};

double spread(const cv::Mat& map)
{
    cv::Scalar mean, deviation;
    cv::meanStdDev(map, mean, deviation);
    return deviation[0];
}

std::optional<double> measuredSpread(const fabrics::Dataset& dataset, const protocols::FabricId& fabric)
{
    const std::vector<int> indices = fabrics::sampleIndices(dataset, fabric, Modality::Tactile);
    if (indices.empty() || dataset.tactileCalibration.empty()) return std::nullopt;
    if (dataset.tactileCalibration == "known") {
        const std::optional<cv::Mat> known = fabrics::readKnownHeight(dataset, fabric, indices.front());
        return known ? std::optional(spread(*known)) : std::nullopt;
    }
    return spread(signals::heightFromFrame(fabrics::readTactileFrame(dataset, fabric, indices.front()),
                                           fabrics::readTactileReference(dataset),
                                           signals::readCalibration(dataset.folder / dataset.tactileCalibration)));
}

std::optional<double> measuredMean(const fabrics::Dataset& dataset, const protocols::FabricId& fabric)
{
    const std::vector<int> indices = fabrics::sampleIndices(dataset, fabric, Modality::Friction);
    if (indices.empty()) return std::nullopt;
    const fabrics::FrictionRecord record = fabrics::readFriction(dataset, fabric, indices.front());
    if (!record.isCoefficient()) return std::nullopt;
    return signals::frictionTrace(record, fabric.value).mean;
}

std::vector<BenchCase> casesOf(const fabrics::Dataset& dataset)
{
    std::vector<BenchCase> cases;
    for (const fabrics::FabricInfo& fabric : dataset.fabrics) {
        const std::vector<int> indices = fabrics::sampleIndices(dataset, fabric.id, Modality::Visual);
        if (indices.empty()) continue;
        cases.push_back(
            {{fabrics::readPhotograph(dataset, fabric.id, indices.front()), dataset.cameraMmPerPixel.value_or(benchMmPerPixel)},
             measuredMean(dataset, fabric.id),
             measuredSpread(dataset, fabric.id)});
    }
    if (cases.empty())
        throw protocols::badInput(
            {"there are no photographs", dataset.folder.string(), "a data set with photographs", "choose another data set"});
    return cases;
}

/// A photograph, and the height of the same place that its simulated surface has.
struct KnownRelief {
    InputPhotograph photograph;
    cv::Mat heightMm;
};

std::vector<KnownRelief> knownReliefs(const std::filesystem::path& folder)
{
    fabrics::ProceduralOptions options;
    options.samples = 1;
    options.seed = 92;
    options.pairing = fabrics::Pairing::Aligned;
    const fabrics::Dataset dataset = fabrics::makeProceduralFabrics(folder, options);
    std::vector<KnownRelief> reliefs;
    for (const fabrics::FabricInfo& fabric : dataset.fabrics)
        if (const std::optional<cv::Mat> known = fabrics::readKnownHeight(dataset, fabric.id, 0))
            reliefs.push_back({{fabrics::readPhotograph(dataset, fabric.id, 0), dataset.cameraMmPerPixel}, *known});
    return reliefs;
}

cv::Mat middleOf(const cv::Mat& map, const cv::Size& size)
{
    return map({(map.cols - size.width) / 2, (map.rows - size.height) / 2, size.width, size.height});
}

/// RMS difference of the relief from the known one where both are known, in percent of the known one's RMS height. Waves longer
/// than 3 mm, which a photograph does not show, are left out of both.
double reliefErrorPercent(const cv::Mat& generatedMm, const cv::Mat& knownMm, double pitch)
{
    constexpr double cutoffMm = 3;
    const cv::Size shared(std::min(generatedMm.cols, knownMm.cols), std::min(generatedMm.rows, knownMm.rows));
    const auto flattened = [&](const cv::Mat& map) {
        cv::Mat values;
        signals::withoutLowFrequency(middleOf(map, shared), {pitch, pitch}, cutoffMm).convertTo(values, CV_64F);
        return values;
    };
    const cv::Mat generated = flattened(generatedMm), known = flattened(knownMm);
    return 100 * cv::norm(generated, known) / cv::norm(known);
}

/// Peak resident memory of this process in MB; 0 where the system does not state it.
double peakMb()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) * 1024 / 1e6;
    return 0;
}

/// Must run before any other work, because the peak never falls.
void measureMemory(const LoadedModel& model, BenchTable& table)
{
    GenerationOptions options;
    const auto afterSquareOf = [&](int side) {
        cv::Mat picture(side, side, CV_8UC3);
        cv::RNG(7).fill(picture, cv::RNG::UNIFORM, 0, 256);
        model.generate({picture, benchMmPerPixel}, options);
        return peakMb();
    };
    table.peakMbAt128 = afterSquareOf(128);
    options.quality = Quality::Fast;
    table.peakMbAtLargest = afterSquareOf(largestSidePx);
}

cv::Mat middle128(const cv::Mat& photograph)
{
    const int width = std::min(128, photograph.cols), height = std::min(128, photograph.rows);
    return photograph({(photograph.cols - width) / 2, (photograph.rows - height) / 2, width, height});
}

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double average(const std::vector<double>& values)
{
    return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Our model and the networks of 0.5.0, which are timed in turns so that both meet the same load of the machine.
struct BenchModels {
    const LoadedModel& ours;
    const LoadedModel* earlier = nullptr;
    std::vector<KnownRelief> reliefs;
};

GeneratorBenchRow benchQuality(const BenchModels& models, const std::vector<BenchCase>& cases,
                               const std::vector<GeneratedSignals>& accurate, Quality quality)
{
    using std::chrono::steady_clock;
    GenerationOptions options;
    options.quality = quality;
    std::vector<double> milliseconds, at128, ratios, height, friction, meanError, spreadError, reliefError;
    const auto timed = [&](const LoadedModel& model, const InputPhotograph& photograph, std::vector<double>& times) {
        const steady_clock::time_point started = steady_clock::now();
        GeneratedSignals signals = model.generate(photograph, options);
        times.push_back(std::chrono::duration<double, std::milli>(steady_clock::now() - started).count());
        return signals;
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const InputPhotograph small{middle128(cases[i].photograph.photograph), cases[i].photograph.mmPerPixel};
        timed(models.ours, small, at128);
        if (models.earlier) {
            std::vector<double> theirs;
            timed(*models.earlier, small, theirs);
            ratios.push_back(at128.back() / theirs.back());
        }
        const GeneratedSignals signals = timed(models.ours, cases[i].photograph, milliseconds);
        cv::Mat difference;
        cv::absdiff(signals.heightMm, accurate[i].heightMm, difference);
        height.push_back(cv::mean(difference)[0]);
        friction.push_back(std::abs(signals.meanFriction / accurate[i].meanFriction - 1));
        if (cases[i].meanFriction) meanError.push_back(std::abs(signals.meanFriction / *cases[i].meanFriction - 1));
        if (cases[i].heightSpreadMm && *cases[i].heightSpreadMm > 0)
            spreadError.push_back(std::abs(spread(signals.heightMm) / *cases[i].heightSpreadMm - 1));
    }
    for (const KnownRelief& one : models.reliefs)
        reliefError.push_back(reliefErrorPercent(models.ours.generate(one.photograph, options).heightMm, one.heightMm,
                                                 one.photograph.mmPerPixel.value()));
    return {quality,
            median(milliseconds),
            median(at128),
            ratios.empty() ? 0 : median(ratios),
            average(height),
            average(friction),
            average(meanError),
            average(spreadError),
            average(reliefError)};
}

}  // namespace

BenchTable benchGenerators(const std::filesystem::path& model, const std::filesystem::path& dataset)
{
    BenchTable table;
    const std::filesystem::path weights = model.empty() ? shippedModel() : model;
    table.model = weights.filename().string();
    const LoadedModel loaded(weights);
    measureMemory(loaded, table);
    std::optional<protocols::TemporaryFolder> made;
    std::filesystem::path folder = dataset;
    if (folder.empty()) {
        made.emplace();
        folder = made->path() / "fabrics";
        fabrics::ProceduralOptions options;
        options.samples = 1;
        options.seed = 91;
        fabrics::makeProceduralFabrics(folder, options);
    }
    const fabrics::Dataset read = fabrics::readDataset(folder);
    table.dataset = read.name;
    const std::vector<BenchCase> cases = casesOf(read);
    table.photographs = static_cast<int>(cases.size());
    GenerationOptions accurate;
    accurate.quality = Quality::Accurate;
    std::vector<GeneratedSignals> best;
    for (const BenchCase& one : cases) best.push_back(loaded.generate(one.photograph, accurate));
    std::optional<LoadedModel> earlier;
    if (std::filesystem::exists(earlierModel())) earlier.emplace(earlierModel());
    if (earlier) earlier->generate(cases.front().photograph, accurate);  // The first call prepares plans that later ones use.
    const protocols::TemporaryFolder aligned;
    const BenchModels models{loaded, earlier ? &*earlier : nullptr, knownReliefs(aligned.path() / "fabrics")};
    for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Accurate})
        table.rows.push_back(benchQuality(models, cases, best, quality));
    return table;
}

std::string asText(const BenchTable& table)
{
    const auto number = [](double value, double places) { return nlohmann::json(std::round(value * places) / places).dump(); };
    std::string text = "generators, " + std::to_string(table.photographs) + " photographs of " + table.dataset + "\n";
    for (const GeneratorBenchRow& row : table.rows)
        text += nameOf(row.quality) + ": " + number(row.millisecondsPerPhotograph, 10) + " ms per photograph (" +
                number(row.millisecondsAt128, 10) + " ms for 128x128" +
                (row.ratioAt128 > 0 ? ", " + number(row.ratioAt128, 100) + " times the networks of 0.5.0" : "") + "), height " +
                number(row.heightDeviationFromAccurateMm, 1e5) + " mm from accurate, mean friction " +
                number(100 * row.meanFrictionRelativeError, 100) + " % from measured, relief " +
                number(100 * row.heightSpreadRelativeError, 100) + " % from measured\n";
    text += "memory: " + number(table.peakMbAt128, 1) + " MB after a photograph of 128x128, " + number(table.peakMbAtLargest, 1) +
            " MB after the largest, " + std::to_string(largestSidePx) + "x" + std::to_string(largestSidePx) + "\n";
    return text;
}

std::string asJson(const BenchTable& table)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const GeneratorBenchRow& row : table.rows)
        rows.push_back({{"quality", nameOf(row.quality)},
                        {"ms_per_photograph", row.millisecondsPerPhotograph},
                        {"ms_at_128", row.millisecondsAt128},
                        {"ratio_at_128_to_version_0_5_0", row.ratioAt128},
                        {"height_deviation_from_accurate_mm", row.heightDeviationFromAccurateMm},
                        {"mean_friction_deviation_from_accurate", row.frictionDeviationFromAccurate},
                        {"mean_friction_relative_error", row.meanFrictionRelativeError},
                        {"height_spread_relative_error", row.heightSpreadRelativeError},
                        {"relief_error_percent", row.reliefErrorPercent}});
    const nlohmann::ordered_json json{
        {"schema", "vis2hap.bench-generation/1"},     {"model", table.model}, {"dataset", table.dataset},
        {"photographs", table.photographs},           {"qualities", rows},    {"peak_mb_at_128", table.peakMbAt128},
        {"peak_mb_at_largest", table.peakMbAtLargest}};
    return json.dump(1) + "\n";
}

void writeBench(const std::filesystem::path& file, const BenchTable& table) { protocols::writeWholeFile(file, asJson(table)); }

}  // namespace rendering::models
