#include "study/evaluation/surfaces.h"

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/drawn_memory.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_at_pitch.h"
#include "rendering/signals/grey.h"
#include "rendering/signals/shape_from_shading.h"
#include "stats/kernels/descriptive.h"
#include "stats/kernels/threads.h"
#include "study/evaluation/leaks.h"
#include "study/evaluation/pixel_ridge.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;

constexpr int usualPhotographs = 4;
constexpr int ridgeSamplesPerFabric = 12000;
constexpr double longestWaveMm = 4;

/// A photograph with its surface.
struct SurfacePair {
    int index = 0;
    std::optional<double> mmPerPixel;
    std::optional<double> lightDeg;  ///< told where all photographs have the same lamp
};
/// By light, then by fabric.
using SurfacePairs = std::map<std::string, std::map<protocols::FabricId, std::vector<SurfacePair>>>;

/// The program's own words for light whose side is withheld, as if nobody knew it.
bool hasSeveralLamps(const std::string& light) { return light == "two_lamps" || light == "three_lamps" || light == "four_lamps"; }

SurfacePairs pairsOf(const fabrics::Dataset& dataset)
{
    std::map<std::pair<protocols::FabricId, int>, fabrics::SamplePlace> places;
    for (const auto& place : fabrics::readSamplePlaces(dataset))
        if (place.modality == Modality::Visual) places.emplace(std::pair(place.fabric, place.index), place);
    SurfacePairs pairs;
    for (const auto& fabric : dataset.fabrics)
        for (const int index : fabrics::sampleIndices(dataset, fabric.id, Modality::Visual)) {
            if (!std::filesystem::exists(fabrics::surfacePath(dataset, fabric.id, index))) continue;
            const auto place = places.find({fabric.id, index});
            const bool isListed = place != places.end();
            pairs[isListed ? place->second.light : ""][fabric.id].push_back(
                {index, isListed ? fabrics::photographPitch(dataset, place->second) : dataset.cameraMmPerPixel,
                 isListed && !hasSeveralLamps(place->second.light) ? place->second.lightDeg : std::nullopt});
        }
    return pairs;
}

std::vector<SurfacePair> spread(const std::vector<SurfacePair>& pairs, int most)
{
    std::vector<SurfacePair> chosen;
    const int count = std::min(most, static_cast<int>(pairs.size()));
    for (int i = 0; i < count; ++i)
        chosen.push_back(pairs[static_cast<std::size_t>(i) * pairs.size() / static_cast<std::size_t>(count)]);
    return chosen;
}

/// The part of a surface that belongs to this part of its photograph. Points without a measurement are NaN, but the middle half
/// of both sides, which every correlation covers, has enough others.
cv::Mat surfaceOf(const fabrics::Dataset& dataset, const protocols::FabricId& fabric, int index, const cv::Mat& photograph,
                  const cv::Rect& part)
{
    constexpr std::size_t fewestPoints = 100;
    const cv::Mat surface = fabrics::readSurfaceOf(dataset, fabric, index, photograph.size()).value()(part).clone();
    const cv::Mat middle = surface(cv::Rect(surface.cols / 4, surface.rows / 4, (surface.cols + 1) / 2, (surface.rows + 1) / 2));
    const std::size_t measured = measuredCount(middle);
    if (measured < fewestPoints && measured < middle.total())
        throw protocols::badInput({"only " + std::to_string(measured) + " of the " + std::to_string(middle.total()) +
                                       " points in the middle of the surface are measured",
                                   fabrics::surfacePath(dataset, fabric, index).string(),
                                   "at least " + std::to_string(fewestPoints), "measure the surface again, or remove it"});
    return surface;
}

using SumsOfFabric = std::map<protocols::FabricId, RidgeSums>;

SumsOfFabric ridgeSums(const fabrics::Dataset& dataset, const std::map<protocols::FabricId, std::vector<SurfacePair>>& pairs,
                       unsigned threads)
{
    std::vector<protocols::FabricId> ids;
    for (const auto& [fabric, all] : pairs) ids.push_back(fabric);
    std::vector<RidgeSums> own(ids.size());
    stats::onThreads(ids.size(), threads, [&](std::size_t i) {
        const std::vector<SurfacePair>& all = pairs.at(ids[i]);
        const int each = std::max(1, ridgeSamplesPerFabric / static_cast<int>(all.size()));
        for (const SurfacePair& pair : all) {
            const cv::Mat photograph = fabrics::readPhotograph(dataset, ids[i], pair.index);
            own[i].add(photograph, surfaceOf(dataset, ids[i], pair.index, photograph, {{}, photograph.size()}), each,
                       static_cast<std::uint64_t>(pair.index));
        }
    });
    SumsOfFabric sums;
    for (std::size_t i = 0; i < ids.size(); ++i) sums.emplace(ids[i], std::move(own[i]));
    return sums;
}

/// Weights that never saw `without`; empty where there is no other fabric.
cv::Mat weightsWithout(const SumsOfFabric& sums, const protocols::FabricId& without)
{
    RidgeSums others;
    for (const auto& [fabric, own] : sums)
        if (fabric != without) others += own;
    return sums.size() > 1 ? others.weights() : cv::Mat();
}

SurfaceCorrelation correlate(cv::Mat relief, const cv::Mat& surface, const std::optional<double>& mmPerPixel)
{
    if (relief.empty()) return {};
    if (relief.size() != surface.size())
        cv::resize(relief, relief, surface.size(), 0, 0, relief.total() > surface.total() ? cv::INTER_AREA : cv::INTER_CUBIC);
    SurfaceCorrelation result{reliefCorrelation(relief, surface), {}};
    if (mmPerPixel) result.at4Mm = reliefCorrelation(relief, surface, longestWaveMm / *mmPerPixel);
    return result;
}

/// `shareAt4Mm`: of the pairs whose scale is known.
void addTo(SurfaceCorrelation& sum, const SurfaceCorrelation& one, double share, double shareAt4Mm)
{
    sum.at16Px += share * one.at16Px;
    if (one.at4Mm) sum.at4Mm = sum.at4Mm.value_or(0) + shareAt4Mm * *one.at4Mm;
}

SurfaceRow rowOf(const fabrics::Dataset& dataset, const fabrics::FabricInfo& fabric, const std::string& light,
                 const std::vector<SurfacePair>& pairs, const cv::Mat& weights, const models::Architecture& architecture,
                 const models::GenerationOptions& options, const Generate& generate)
{
    SurfaceRow row{fabric.id,
                   fabric.name,
                   light,
                   static_cast<int>(pairs.size()),
                   std::ranges::all_of(pairs, [](const SurfacePair& pair) { return pair.lightDeg.has_value(); }),
                   std::vector<SurfaceCorrelation>(std::size(allSeenReliefs))};
    row.hasRidge = !weights.empty();
    std::vector<models::InputPhotograph> photographs;
    for (const SurfacePair& pair : pairs)
        photographs.push_back({fabrics::readPhotograph(dataset, fabric.id, pair.index), pair.mmPerPixel, pair.lightDeg});
    const auto answers = generate(photographs, options);
    const auto scaled = std::ranges::count_if(pairs, [](const SurfacePair& pair) { return pair.mmPerPixel.has_value(); });
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        // All sources are judged on the part that the generators use of a large photograph.
        const cv::Rect part = models::usedPart(photographs[i], architecture);
        const cv::Mat photograph = photographs[i].photograph(part).clone();
        const cv::Mat reliefs[] = {answers[i].heightMm, rendering::signals::shapeFromShading(photograph),
                                   rendering::signals::grey(photograph),
                                   weights.empty() ? cv::Mat() : ridgeRelief(photograph, weights)};
        const cv::Mat surface = surfaceOf(dataset, fabric.id, pairs[i].index, photographs[i].photograph, part);
        row.points += surface.total();
        row.unmeasured += surface.total() - measuredCount(surface);
        for (std::size_t source = 0; source < std::size(reliefs); ++source)
            addTo(row.correlations[source], correlate(reliefs[source], surface, pairs[i].mmPerPixel), 1.0 / double(pairs.size()),
                  1.0 / double(scaled));
    }
    return row;
}

std::optional<double> valueOf(const SurfaceRow& row, SeenRelief source, bool isAt4Mm)
{
    const SurfaceCorrelation& one = row.correlations.at(static_cast<std::size_t>(source));
    return isAt4Mm ? one.at4Mm : std::optional(one.at16Px);
}

constexpr std::size_t cellWidth = 15;

std::string cell(const std::string& text) { return std::string(cellWidth - std::min(cellWidth - 1, text.size()), ' ') + text; }

std::string text(const std::optional<double>& value) { return value ? protocols::fixed(*value, 2) : "-"; }
std::string text(const stats::Value& value) { return text(value.exists() ? std::optional(*value) : std::nullopt); }
std::string text(const stats::Interval& ci95)
{
    return ci95.low.exists() && ci95.high.exists() ? text(ci95.low) + " to " + text(ci95.high) : "-";
}

/// One line of the table: its name and a cell for each source.
std::string line(std::string name, const std::function<std::string(SeenRelief)>& cellOf)
{
    name.resize(std::max<std::size_t>(name.size(), 34), ' ');
    for (const SeenRelief source : allSeenReliefs) name += cell(cellOf(source));
    return name + "\n";
}

std::string linesOf(const std::vector<const SurfaceRow*>& rows, bool isAt4Mm)
{
    std::string lines =
        line(std::string("  high-passed at ") + (isAt4Mm ? "4 mm" : "16 px"), [](SeenRelief source) { return nameOf(source); });
    for (const SurfaceRow* row : rows)
        lines += line("  " + row->fabric.value + " " + row->name,
                      [&](SeenRelief source) { return text(valueOf(*row, source, isAt4Mm)); });
    const auto summary = [&](SeenRelief source) { return summaryOf(rows, source, isAt4Mm); };
    const auto ofOthers = [](SeenRelief source, const std::string& entry) {
        return source == SeenRelief::Generated ? std::string() : entry;
    };
    lines += line("  mean", [&](SeenRelief source) { return text(summary(source).mean); });
    lines += line("    95 % interval over fabrics", [&](SeenRelief source) { return text(summary(source).ci95); });
    lines +=
        line("  generated minus it", [&](SeenRelief source) { return ofOthers(source, text(summary(source).generatedAbove)); });
    lines += line("    95 % interval over fabrics",
                  [&](SeenRelief source) { return ofOthers(source, text(summary(source).generatedAboveCi95)); });
    lines += line("    fabrics above it", [&](SeenRelief source) {
        const SourceSummary one = summary(source);
        return ofOthers(source, std::to_string(one.fabricsBelow) + " of " + std::to_string(one.fabrics));
    });
    return lines;
}

/// A line for each fabric of which points have no measured height; such points count nowhere.
std::string gapsOf(const std::vector<const SurfaceRow*>& rows)
{
    std::string lines;
    for (const SurfaceRow* row : rows)
        if (row->unmeasured > 0)
            lines += "  " + row->fabric.value + " " + row->name + ": " + std::to_string(row->unmeasured) + " of " +
                     std::to_string(row->points) + " points of its surfaces were not measured and are left out\n";
    return lines;
}

std::vector<const SurfaceRow*> notTrainedOn(const std::vector<const SurfaceRow*>& rows)
{
    std::vector<const SurfaceRow*> others;
    std::ranges::copy_if(rows, std::back_inserter(others), [](const SurfaceRow* row) { return row->trainedOn == 0; });
    return others;
}

/// Names the fabrics that the model may remember; empty where there are none.
std::string memoryOf(const std::vector<const SurfaceRow*>& rows)
{
    std::string names;
    for (const SurfaceRow* row : rows)
        if (row->trainedOn > 0) names += (names.empty() ? "" : ", ") + row->fabric.value;
    if (names.empty()) return {};
    const std::size_t others = notTrainedOn(rows).size();
    return "  MEMORY: the model was trained on photographs of " + std::to_string(rows.size() - others) + " of these " +
           std::to_string(rows.size()) + " fabrics (" + names + "); figures of these fabrics also measure memory\n";
}

/// The rows of each light, in the order of the report.
std::vector<std::vector<const SurfaceRow*>> byLight(const SurfaceReport& surfaces)
{
    std::vector<std::vector<const SurfaceRow*>> lights;
    for (const SurfaceRow& row : surfaces.rows) {
        if (lights.empty() || lights.back().front()->light != row.light) lights.emplace_back();
        lights.back().push_back(&row);
    }
    return lights;
}

nlohmann::ordered_json numberJson(const stats::Value& value) { return value.exists() ? nlohmann::ordered_json(*value) : nullptr; }

nlohmann::ordered_json meanJson(const stats::Value& mean, const stats::Interval& ci95)
{
    nlohmann::ordered_json json{{"mean", numberJson(mean)}, {"ci95", {numberJson(ci95.low), numberJson(ci95.high)}}};
    if (!mean.exists()) json["why"]["mean"] = mean.why();
    if (!ci95.low.exists()) json["why"]["ci95"] = ci95.low.why();
    return json;
}

nlohmann::ordered_json meansJson(const std::vector<const SurfaceRow*>& rows)
{
    nlohmann::ordered_json json{{"light", rows.front()->light}, {"unit", "fabric"}};
    for (const SeenRelief source : allSeenReliefs)
        for (const bool isAt4Mm : {false, true}) {
            const SourceSummary one = summaryOf(rows, source, isAt4Mm);
            nlohmann::ordered_json entry = meanJson(one.mean, one.ci95);
            entry["fabrics"] = one.fabrics;
            if (source != SeenRelief::Generated) {
                entry["generated_minus"] = meanJson(one.generatedAbove, one.generatedAboveCi95);
                entry["generated_minus"]["fabrics_above"] = one.fabricsBelow;
            }
            json[nameOf(source)][isAt4Mm ? "at_4_mm" : "at_16_px"] = entry;
        }
    const auto others = notTrainedOn(rows);
    json["fabrics_trained_on"] = rows.size() - others.size();
    if (others.size() == rows.size()) return json;
    json["not_trained_on"] = others.empty() ? nlohmann::ordered_json(nullptr) : meansJson(others);
    if (others.empty()) json["why"] = {{"not_trained_on", "the model was trained on photographs of every fabric"}};
    return json;
}

}  // namespace

std::string nameOf(SeenRelief source)
{
    switch (source) {
        case SeenRelief::Generated:
            return "generated";
        case SeenRelief::ShapeFromShading:
            return "v_shape";
        case SeenRelief::Photograph:
            return "photograph";
        case SeenRelief::Ridge:
            return "ridge";
    }
    return {};
}

SourceSummary summaryOf(const std::vector<const SurfaceRow*>& rows, SeenRelief source, bool isAt4Mm)
{
    const bool isRidge = source == SeenRelief::Ridge;
    if (isRidge && std::ranges::none_of(rows, [](const SurfaceRow* row) { return row->hasRidge; })) {
        const auto none = stats::Value::undefined("there is no other fabric to learn from");
        return {none, {none, none}, none, {none, none}};
    }
    std::vector<double> values, above;
    for (const SurfaceRow* row : rows) {
        const auto value = valueOf(*row, source, isAt4Mm), generated = valueOf(*row, SeenRelief::Generated, isAt4Mm);
        if (!value || !generated || (isRidge && !row->hasRidge)) continue;
        values.push_back(*value);
        above.push_back(*generated - *value);
    }
    const stats::Description own = stats::describe(values), difference = stats::describe(above);
    return {own.mean,
            own.ci95,
            difference.mean,
            difference.ci95,
            static_cast<int>(values.size()),
            static_cast<int>(std::ranges::count_if(above, [](double one) { return one > 0; }))};
}

bool hasSurfaces(const fabrics::Dataset& dataset)
{
    return std::ranges::any_of(dataset.fabrics, [&](const auto& fabric) {
        const auto indices = fabrics::sampleIndices(dataset, fabric.id, Modality::Visual);
        return std::ranges::any_of(
            indices, [&](int index) { return std::filesystem::exists(fabrics::surfacePath(dataset, fabric.id, index)); });
    });
}

SurfaceReport evaluateSurfaces(const fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report,
                               const Generate& generate)
{
    SurfaceReport surfaces;
    surfaces.dataset = dataset.name;
    models::GenerationOptions options;
    options.model = request.model.empty() ? models::shippedModel() : request.model;
    options.quality = request.quality;
    options.friction = false;
    const models::ModelCardFields card = models::readModelCardFields(options.model);
    surfaces.model = card.summary.name;
    surfaces.memory = models::noteOnDrawnFabrics(dataset, card.summary);
    const SurfacePairs pairs = pairsOf(dataset);
    if (pairs.empty())
        throw protocols::badInput({"no photograph has its surface", dataset.folder.string(), "F01/surface/000.tiff",
                                   "import scans with `vis2hap import scans`"});
    const auto trainedOn = photographsTrainedOn(dataset, card.summary.trainingSampleHashes);
    int total = 0, done = 0;
    for (const auto& [light, ofFabric] : pairs) total += static_cast<int>(ofFabric.size());
    for (const auto& [light, ofFabric] : pairs) {
        const SumsOfFabric sums = ridgeSums(dataset, ofFabric, request.threads);
        for (const auto& fabric : dataset.fabrics) {
            const auto own = ofFabric.find(fabric.id);
            if (own == ofFabric.end()) continue;
            surfaces.rows.push_back(rowOf(dataset, fabric, light,
                                          spread(own->second, request.samplesPerFabric.value_or(usualPhotographs)),
                                          weightsWithout(sums, fabric.id), card.architecture, options, generate));
            if (const auto seen = trainedOn.find(fabric.id); seen != trainedOn.end())
                surfaces.rows.back().trainedOn = seen->second;
            if (report) report("reliefs and surfaces", ++done, total);
        }
    }
    return surfaces;
}

nlohmann::ordered_json surfacesJson(const SurfaceReport& surfaces)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const SurfaceRow& row : surfaces.rows) {
        nlohmann::ordered_json entry{{"fabric", row.fabric.value}, {"name", row.name},
                                     {"light", row.light},         {"photographs", row.photographs},
                                     {"lamp_told", row.lampTold},  {"photographs_trained_on", row.trainedOn}};
        for (std::size_t i = 0; i < row.correlations.size(); ++i) {
            const auto& one = row.correlations[i];
            entry[nameOf(allSeenReliefs[i])] = {{"at_16_px", one.at16Px},
                                                {"at_4_mm", one.at4Mm ? nlohmann::ordered_json(*one.at4Mm) : nullptr}};
            if (!one.at4Mm) entry["why"] = {{"at_4_mm", "the scale of the photographs is unknown"}};
        }
        if (row.unmeasured > 0) entry["left_out"] = {{"points", row.unmeasured}, {"of", row.points}};
        rows.push_back(entry);
    }
    nlohmann::ordered_json means = nlohmann::ordered_json::array();
    for (const auto& light : byLight(surfaces)) means.push_back(meansJson(light));
    return {{"schema", "vis2hap.evaluation/1"},
            {"dataset", surfaces.dataset},
            {"model", surfaces.model},
            {"notes", surfaces.memory.empty() ? nlohmann::ordered_json::array() : nlohmann::ordered_json{surfaces.memory}},
            {"surfaces", rows},
            {"surface_means", means}};
}

std::string surfacesText(const SurfaceReport& surfaces)
{
    std::string text = "Relief of photographs against the surface that they show: model \"" + surfaces.model + "\" on \"" +
                       surfaces.dataset +
                       "\"\n  correlation pixel by pixel; ridge: 15 x 15 pixels, fitted on the other fabrics\n";
    if (!surfaces.memory.empty()) text += "  MEMORY: " + surfaces.memory + "\n";
    for (const auto& rows : byLight(surfaces)) {
        const SurfaceRow& first = *rows.front();
        text += "\n" + (first.light.empty() ? std::string("light unknown") : first.light) + ", " +
                std::to_string(first.photographs) + " photographs of each fabric" +
                (first.lampTold ? ", the side of the lamp is told" : "") + "\n" + memoryOf(rows) + linesOf(rows, false) +
                linesOf(rows, true) + gapsOf(rows);
        if (const auto others = notTrainedOn(rows); !others.empty() && others.size() < rows.size())
            text += "  only the fabrics that the model was not trained on\n" + linesOf(others, false) + linesOf(others, true);
    }
    return text;
}

}  // namespace study::evaluation
