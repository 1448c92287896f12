#include "rendering/composition/render_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "rendering/composition/image_warnings.h"
#include "rendering/models/preset.h"
#include "rendering/models/preset_trade.h"

namespace rendering {

namespace {

using nlohmann::ordered_json;

/// Rounded to microseconds.
double rounded(double milliseconds) { return std::round(milliseconds * 1000) / 1000; }

ordered_json jsonOf(const MapRange& range) { return {{"min", range.min}, {"max", range.max}, {"constant", range.constant()}}; }

const char* nameOf(DisplayScale scale) { return scale == DisplayScale::Pixels ? "pixels" : "physical"; }
const char* nameOf(Extension extension) { return extension == Extension::Tile ? "tile" : "mirror"; }

/// Everything besides the range that determines how a value becomes a level.
ordered_json mappingOf(const RenderRequest& request)
{
    ordered_json json{{"scale", nameOf(request.scale)},
                      {"extension", nameOf(request.extension)},
                      {"percentiles", {request.percentiles.low, request.percentiles.high}},
                      {"bits", request.mapping.bits},
                      {"dither", request.mapping.dither}};
    if (request.mapping.dither) json["dither_seed"] = request.mapping.seed;
    if (request.mapping.response)
        json["response"] = {{"display", request.mapping.response->setting.display}, {"sha256", request.mapping.response->sha256}};
    return json;
}

ordered_json jsonOf(const RenderedCondition& rendered, const RenderRequest& request)
{
    ordered_json json{
        {"range", jsonOf(rendered.range)}, {"range_over", ordered_json::array()}, {"signals", ordered_json::array()}};
    for (const auto& fabric : rendered.rangeOver) json["range_over"].push_back(fabric.value);
    json["range_set_by"] = {{"lowest", rendered.rangeSetBy.lowest.value}, {"highest", rendered.rangeSetBy.highest.value}};
    if (rendered.ranges.size() > 1)
        for (const auto& [quantity, range] : rendered.ranges) json["ranges"][quantity] = jsonOf(range);
    for (const Signal signal : signalsFor(protocols::conditionNamed(rendered.condition.value)))
        json["signals"].push_back(nameOf(signal));
    json["quality"] = nameOf(rendered.quality);
    if (rendered.quality != request.generation.quality) json["settings"] = settingsOf(rendered.quality);
    json["mapping"] = mappingOf(request);
    json["stroke_axis"] = std::string(1, strokeAxis);
    json["images"] = ordered_json::array();
    for (const auto& [fabric, facts] : rendered.maps) {
        json["images"].push_back(fabric.value);
        json["extension"][fabric.value] = facts.extension;
        json["agreement"][fabric.value] = facts.agreement;
        json["variance_lost"][fabric.value] = facts.varianceLost ? ordered_json(*facts.varianceLost) : ordered_json();
        if (!facts.varianceLost) json["why"]["variance_lost"] = "a constant source has no variance";
        if (!request.percentiles.whole()) json["outside_range"][fabric.value] = facts.outsideRange;
        if (request.mapping.response) json["out_of_reach"][fabric.value] = facts.outOfReach;
    }
    json["ms"] = rounded(rendered.milliseconds);
    return json;
}

ordered_json jsonOf(const models::PhotographFacts& photograph)
{
    ordered_json json{{"middle_only", photograph.middleOnly}};
    if (photograph.meanFriction)
        json["mean_friction"] = {{"interval_90", {photograph.meanFriction->low, photograph.meanFriction->high}},
                                 {"tells_little", photograph.meanFriction->tellsLittle()},
                                 {"checked", "not checked against measured friction"}};
    if (photograph.assumedMmPerPixel) json["assumed_mm_per_pixel"] = *photograph.assumedMmPerPixel;
    return json;
}

/// Sample indices of the recordings that the images use, whether they were read now or a cache made that needless.
ordered_json samplesOf(const SampleChoice& samples, const std::vector<Signal>& used)
{
    const auto uses = [&](Signal signal) { return std::find(used.begin(), used.end(), signal) != used.end(); };
    ordered_json json = ordered_json::object();
    if (uses(Signal::Photograph)) json["visual"] = samples.visual;
    if (uses(Signal::TactileFrame)) json["tactile"] = samples.tactile;
    if (uses(Signal::FrictionRecord)) json["friction"] = samples.friction;
    return json;
}

std::string percent(double share)
{
    char text[16];
    std::snprintf(text, sizeof text, "%d.%d %%", static_cast<int>(share * 1000 + 0.5) / 10,
                  static_cast<int>(share * 1000 + 0.5) % 10);
    return text;
}

std::string inWords(const MapFacts& facts)
{
    return facts.extension + (facts.varianceLost ? ", " + percent(*facts.varianceLost) + " of its variance lost" : ", constant") +
           (facts.outsideRange > 0 ? ", " + percent(facts.outsideRange) + " of its pixels outside the range" : "") +
           (facts.outOfReach > 0
                ? ", " + percent(facts.outOfReach) + " of its pixels at a friction that the display does not reach"
                : "");
}

}  // namespace

ordered_json settingsOf(models::Quality quality)
{
    const models::Preset& preset = models::presetOf(quality);
    ordered_json json{{"preset", preset.name},
                      {"integration_bits", preset.integration == signals::IntegrationQuality::Fast ? 32 : 64},
                      {"shading_pixels", preset.shading == signals::ShadingQuality::Fast ? "a quarter" : "all"},
                      {"phase_iterations", preset.phaseIterations},
                      {"pictures_averaged", preset.pictures},
                      {"margin_px", preset.marginPx},
                      {"crops", preset.cropsAcross * preset.cropsAcross},
                      {"trade_measured_on", models::presetTradeMachine}};
    for (const models::PresetTrade& trade : models::presetTrades) {
        const auto i = static_cast<std::size_t>(quality);
        json["trade"][trade.stage] = {{"ms", trade.milliseconds[i]},
                                      {"error", trade.error[i]},
                                      {"least_error", *std::min_element(trade.error.begin(), trade.error.end())},
                                      {"error_is", trade.errorIs}};
    }
    return json;
}

std::vector<std::string> describeMaps(const RenderedFabrics& rendering)
{
    // Conditions with the same facts share one description.
    std::map<protocols::FabricId, std::vector<std::pair<std::string, std::string>>> descriptions;
    for (const auto& rendered : rendering.conditions)
        for (const auto& [fabric, facts] : rendered.maps) {
            auto& known = descriptions[fabric];
            const auto words = inWords(facts);
            const auto same = std::find_if(known.begin(), known.end(), [&](const auto& entry) { return entry.first == words; });
            if (same == known.end())
                known.emplace_back(words, rendered.condition.value);
            else
                same->second += ", " + rendered.condition.value;
        }
    std::vector<std::string> lines;
    for (const auto& [fabric, known] : descriptions) {
        std::string line;
        for (const auto& [words, conditions] : known)
            line += (line.empty() ? fabric.value + ": " : "; ") + conditions + ": " + words;
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> shadingWarnings(const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    for (const auto& [fabric, computed] : rendering.signals)
        if (computed.colourVariation && *computed.colourVariation > signals::coloursSpoilShading)
            lines.push_back(fabric.value + ": its photograph varies in colour by " + percent(*computed.colourVariation) +
                            " of its brightness; v_shape may mistake dye for relief");
    return lines;
}

std::string renderJson(const fabrics::Dataset& dataset, const RenderRequest& request, const RenderedFabrics& rendering)
{
    ordered_json json{{"schema", "vis2hap.render/1"},
                      {"dataset", dataset.name},
                      {"scale", nameOf(request.scale)},
                      {"quality", models::presetOf(request.generation.quality).name},
                      {"settings", settingsOf(request.generation.quality)},
                      {"conditions", ordered_json::object()},
                      {"samples", ordered_json::object()},
                      {"signals_computed", ordered_json::object()},
                      {"signals_ms", ordered_json::object()}};
    for (const auto& rendered : rendering.conditions) json["conditions"][rendered.condition.value] = jsonOf(rendered, request);
    json["image_faults"] = jsonOf(imageFaults(rendering));
    const auto used = signalsFor(std::span<const protocols::ConditionId>(request.conditions));
    for (const auto& [fabric, samples] : rendering.samples) json["samples"][fabric.value] = samplesOf(samples, used);
    for (const auto& [signal, count] : rendering.computed) json["signals_computed"][nameOf(signal)] = count;
    for (const auto& [signal, milliseconds] : rendering.milliseconds) json["signals_ms"][nameOf(signal)] = rounded(milliseconds);
    // Of the rendered fabrics alone, because a cache may know the ranges of others without their signals.
    const auto isRendered = [&](const protocols::FabricId& fabric) {
        return std::find(request.fabrics.begin(), request.fabrics.end(), fabric) != request.fabrics.end();
    };
    for (const auto& [fabric, computed] : rendering.signals)
        if (computed.measuredMeanFriction && isRendered(fabric))
            json["measured_friction"][fabric.value] = {{"quantity", computed.measuredQuantity},
                                                       {"mean", *computed.measuredMeanFriction}};
    for (const auto& [fabric, computed] : rendering.signals)
        if (computed.light && isRendered(fabric))
            json["shading"][fabric.value] = {
                {"method", request.shading.method == signals::ShadingMethod::Linear ? "linear" : "bumps"},
                {"light_from", request.shading.lightFromBelow ? "below" : "above"},
                {"light_azimuth_deg", computed.light->azimuthDeg},
                {"light_coherence", computed.light->coherence},
                {"colour_variation", *computed.colourVariation}};
    for (const auto& [fabric, computed] : rendering.signals)
        if (computed.photograph && isRendered(fabric)) {
            json["photographs"][fabric.value] = jsonOf(*computed.photograph);
            if (computed.fibre) json["photographs"][fabric.value]["fibre"] = nameOf(*computed.fibre);
            if (computed.likeness) json["photographs"][fabric.value]["likeness"] = models::nameOf(*computed.likeness);
        }
    return json.dump(2) + "\n";
}

}  // namespace rendering
