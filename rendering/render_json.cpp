#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "rendering/render_fabrics.h"

namespace rendering {

namespace {

using Json = nlohmann::ordered_json;

/// Microseconds are enough of a time.
double rounded(double milliseconds) { return std::round(milliseconds * 1000) / 1000; }

Json jsonOf(const MapRange& range) { return {{"min", range.min}, {"max", range.max}, {"constant", range.constant()}}; }

Json jsonOf(const RenderedCondition& rendered)
{
    Json json{{"range", jsonOf(rendered.range)}, {"range_over", Json::array()}, {"signals", Json::array()}};
    for (const auto& fabric : rendered.rangeOver) json["range_over"].push_back(fabric.value);
    if (rendered.ranges.size() > 1)
        for (const auto& [quantity, range] : rendered.ranges) json["ranges"][quantity] = jsonOf(range);
    for (const Signal signal : signalsFor(protocols::conditionNamed(rendered.condition.value)))
        json["signals"].push_back(nameOf(signal));
    for (const auto& [fabric, extension] : rendered.extension) json["extension"][fabric.value] = extension;
    json["ms"] = rounded(rendered.milliseconds);
    return json;
}

/// Only the signals that the fabric's images rest on.
Json samplesOf(const SampleChoice& samples, const Rendering& rendering)
{
    Json json = Json::object();
    if (rendering.computed.contains(Signal::Photograph)) json["visual"] = samples.visual;
    if (rendering.computed.contains(Signal::TactileFrame)) json["tactile"] = samples.tactile;
    if (rendering.computed.contains(Signal::FrictionRecord)) json["friction"] = samples.friction;
    return json;
}

const char* nameOf(models::Quality quality)
{
    switch (quality) {
        case models::Quality::Fast:
            return "fast";
        case models::Quality::Balanced:
            return "balanced";
        case models::Quality::Accurate:
            return "accurate";
    }
    return "";
}

}  // namespace

std::string renderJson(const fabrics::Dataset& dataset, const RenderRequest& request, const Rendering& rendering)
{
    Json json{{"schema", "vis2hap.render/1"},
              {"dataset", dataset.name},
              {"scale", request.scale == Scale::Pixels ? "pixels" : "physical"},
              {"quality", nameOf(request.generation.quality)},
              {"conditions", Json::object()},
              {"samples", Json::object()},
              {"signals_computed", Json::object()},
              {"signals_ms", Json::object()}};
    for (const auto& rendered : rendering.conditions) json["conditions"][rendered.condition.value] = jsonOf(rendered);
    for (const auto& [fabric, samples] : rendering.samples) json["samples"][fabric.value] = samplesOf(samples, rendering);
    for (const auto& [signal, count] : rendering.computed) json["signals_computed"][nameOf(signal)] = count;
    for (const auto& [signal, milliseconds] : rendering.milliseconds) json["signals_ms"][nameOf(signal)] = rounded(milliseconds);
    for (const auto& [fabric, signals] : rendering.signals)
        if (signals.measuredMeanFriction)
            json["measured_friction"][fabric.value] = {{"quantity", signals.measuredQuantity},
                                                       {"mean", *signals.measuredMeanFriction}};
    return json.dump(2) + "\n";
}

}  // namespace rendering
