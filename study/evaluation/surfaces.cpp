#include "study/evaluation/surfaces.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/signals/grey.h"
#include "rendering/signals/shape_from_shading.h"
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
                 isListed && place->second.light == "one_lamp" ? place->second.lightDeg : std::nullopt});
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

cv::Mat surfaceOf(const fabrics::Dataset& dataset, const protocols::FabricId& fabric, int index)
{
    return fabrics::readSurface(dataset, fabric, index).value();
}

using SumsOfFabric = std::map<protocols::FabricId, RidgeSums>;

SumsOfFabric ridgeSums(const fabrics::Dataset& dataset, const std::map<protocols::FabricId, std::vector<SurfacePair>>& pairs)
{
    SumsOfFabric sums;
    for (const auto& [fabric, all] : pairs) {
        const int each = std::max(1, ridgeSamplesPerFabric / static_cast<int>(all.size()));
        for (const SurfacePair& pair : all)
            sums[fabric].add(fabrics::readPhotograph(dataset, fabric, pair.index), surfaceOf(dataset, fabric, pair.index), each,
                             static_cast<std::uint64_t>(pair.index));
    }
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

void addTo(SurfaceCorrelation& sum, const SurfaceCorrelation& one, double share)
{
    sum.at16Px += share * one.at16Px;
    if (one.at4Mm) sum.at4Mm = sum.at4Mm.value_or(0) + share * *one.at4Mm;
}

SurfaceRow rowOf(const fabrics::Dataset& dataset, const fabrics::FabricInfo& fabric, const std::string& light,
                 const std::vector<SurfacePair>& pairs, const cv::Mat& weights, const models::GenerationOptions& options,
                 const Generate& generate)
{
    SurfaceRow row{fabric.id,
                   fabric.name,
                   light,
                   static_cast<int>(pairs.size()),
                   std::ranges::all_of(pairs, [](const SurfacePair& pair) { return pair.lightDeg.has_value(); }),
                   std::vector<SurfaceCorrelation>(std::size(allSeenReliefs))};
    std::vector<models::InputPhotograph> photographs;
    for (const SurfacePair& pair : pairs)
        photographs.push_back({fabrics::readPhotograph(dataset, fabric.id, pair.index), pair.mmPerPixel, pair.lightDeg});
    const auto answers = generate(photographs, options);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const cv::Mat& photograph = photographs[i].photograph;
        const cv::Mat reliefs[] = {answers[i].heightMm, rendering::signals::shapeFromShading(photograph),
                                   rendering::signals::grey(photograph),
                                   weights.empty() ? cv::Mat() : ridgeRelief(photograph, weights)};
        const cv::Mat surface = surfaceOf(dataset, fabric.id, pairs[i].index);
        for (std::size_t source = 0; source < std::size(reliefs); ++source)
            addTo(row.correlations[source], correlate(reliefs[source], surface, pairs[i].mmPerPixel), 1.0 / double(pairs.size()));
    }
    return row;
}

std::string cell(const std::optional<double>& value)
{
    const std::string text = value ? protocols::fixed(*value, 2) : "-";
    return std::string(text.size() < 12 ? 12 - text.size() : 1, ' ') + text;
}

std::string linesOf(const std::vector<const SurfaceRow*>& rows, bool isAt4Mm)
{
    const auto value = [&](const SurfaceCorrelation& one) { return isAt4Mm ? one.at4Mm : std::optional(one.at16Px); };
    std::string text = std::string("  high-passed at ") + (isAt4Mm ? "4 mm" : "16 px") + std::string(isAt4Mm ? 13 : 12, ' ');
    for (const SeenRelief source : allSeenReliefs) {
        const std::string name = nameOf(source);
        text += std::string(12 - name.size(), ' ') + name;
    }
    text += "\n";
    std::vector<double> sums(std::size(allSeenReliefs));
    for (const SurfaceRow* row : rows) {
        std::string name = row->fabric.value + " " + row->name;
        name.resize(32, ' ');
        text += "  " + name;
        for (std::size_t source = 0; source < sums.size(); ++source) {
            text += cell(value(row->correlations[source]));
            sums[source] += value(row->correlations[source]).value_or(0) / double(rows.size());
        }
        text += "\n";
    }
    text += "  mean" + std::string(28, ' ');
    for (const double sum : sums) text += cell(sum);
    return text + "\n";
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
    surfaces.model = models::readModelCardFields(options.model).summary.name;
    const SurfacePairs pairs = pairsOf(dataset);
    if (pairs.empty())
        throw protocols::badInput({"no photograph has its surface", dataset.folder.string(), "F01/surface/000.tiff",
                                   "import scans with `vis2hap import scans`"});
    int total = 0, done = 0;
    for (const auto& [light, ofFabric] : pairs) total += static_cast<int>(ofFabric.size());
    for (const auto& [light, ofFabric] : pairs) {
        const SumsOfFabric sums = ridgeSums(dataset, ofFabric);
        for (const auto& fabric : dataset.fabrics) {
            const auto own = ofFabric.find(fabric.id);
            if (own == ofFabric.end()) continue;
            surfaces.rows.push_back(rowOf(dataset, fabric, light,
                                          spread(own->second, request.samplesPerFabric.value_or(usualPhotographs)),
                                          weightsWithout(sums, fabric.id), options, generate));
            if (report) report("reliefs and surfaces", ++done, total);
        }
    }
    return surfaces;
}

nlohmann::ordered_json surfacesJson(const SurfaceReport& surfaces)
{
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const SurfaceRow& row : surfaces.rows) {
        nlohmann::ordered_json entry{{"fabric", row.fabric.value},
                                     {"name", row.name},
                                     {"light", row.light},
                                     {"photographs", row.photographs},
                                     {"lamp_told", row.lampTold}};
        for (std::size_t i = 0; i < row.correlations.size(); ++i) {
            const auto& one = row.correlations[i];
            entry[nameOf(allSeenReliefs[i])] = {{"at_16_px", one.at16Px},
                                                {"at_4_mm", one.at4Mm ? nlohmann::ordered_json(*one.at4Mm) : nullptr}};
            if (!one.at4Mm) entry["why"] = {{"at_4_mm", "the scale of the photographs is unknown"}};
        }
        rows.push_back(entry);
    }
    return {{"schema", "vis2hap.evaluation/1"}, {"dataset", surfaces.dataset}, {"model", surfaces.model}, {"surfaces", rows}};
}

std::string surfacesText(const SurfaceReport& surfaces)
{
    std::string text = "Relief of photographs against the surface that they show: model \"" + surfaces.model + "\" on \"" +
                       surfaces.dataset +
                       "\"\n  correlation pixel by pixel; ridge: 15 x 15 pixels, fitted on the other fabrics\n";
    std::vector<std::string> lights;
    for (const SurfaceRow& row : surfaces.rows)
        if (lights.empty() || lights.back() != row.light) lights.push_back(row.light);
    for (const std::string& light : lights) {
        std::vector<const SurfaceRow*> rows;
        for (const SurfaceRow& row : surfaces.rows)
            if (row.light == light) rows.push_back(&row);
        text += "\n" + (light.empty() ? std::string("light unknown") : light) + ", " + std::to_string(rows.front()->photographs) +
                " photographs of each fabric" + (rows.front()->lampTold ? ", the side of the lamp is told" : "") + "\n" +
                linesOf(rows, false) + linesOf(rows, true);
    }
    return text;
}

}  // namespace study::evaluation
