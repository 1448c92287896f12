#include "rendering/composition/kept_ranges.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocols/files/strict_json.h"
#include "rendering/cache/cache_key.h"
#include "rendering/cache/packed_result.h"
#include "rendering/fabrics/dataset_json.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/models/kept_generation.h"

namespace rendering {

namespace {

using fabrics::Modality;
using nlohmann::json;

bool needsWarning(const FabricSignals& signals)
{
    const bool strange = signals.likeness && *signals.likeness != models::ClothLikeness::Cloth;
    const bool coloured = signals.colourVariation && *signals.colourVariation > signals::coloursSpoilShading;
    const bool doubtful =
        signals.photograph &&
        (signals.photograph->middleOnly || (signals.photograph->meanFriction && signals.photograph->meanFriction->tellsLittle()));
    return strange || coloured || doubtful;
}

}  // namespace

KeptRanges::KeptRanges(const fabrics::Dataset& dataset, const RenderRequest& request) : m_dataset(dataset), m_request(request) {}

std::string KeptRanges::keyOf(const protocols::FabricId& fabric, const SampleChoice& samples,
                              const protocols::ConditionId& condition)
{
    const auto& row = protocols::conditionNamed(condition.value);
    const auto needed = signalsFor(row);
    const auto needs = [&](Signal signal) { return std::find(needed.begin(), needed.end(), signal) != needed.end(); };
    if (!m_datasetJson) m_datasetJson = toJson(m_dataset);  // scales and settings of the recordings
    cache::CacheKey key(*m_request.cache, "range of a map");
    key.add("condition", row.id)
        .add("dataset", *m_datasetJson)
        .add("scale", static_cast<int>(m_request.scale))
        .add("extension", static_cast<int>(m_request.extension))
        .add("quality", static_cast<int>(qualityOf(condition, m_request)));
    if (needs(Signal::Photograph))
        key.addFile("photograph", samplePath(m_dataset, fabric, Modality::Visual, samples.visual))
            .addFile("places", m_dataset.folder / "samples.csv")  // may hold the scale of a photograph
            .add("fabric", fabric.value)
            .add("index", samples.visual);
    if (needs(Signal::TactileFrame))
        key.addFile("frame", samplePath(m_dataset, fabric, Modality::Tactile, samples.tactile))
            .addFile("reference", m_dataset.folder / "tactile-reference.png");
    if (needs(Signal::PhotometricHeight)) {
        if (m_dataset.tactileCalibration == "known")
            key.addFile("height", knownHeightPath(m_dataset, fabric, samples.tactile));
        else
            key.addFile("calibration", m_dataset.folder / m_dataset.tactileCalibration);
    }
    if (needs(Signal::FrictionRecord)) {
        const auto record = samplePath(m_dataset, fabric, Modality::Friction, samples.friction);
        key.addFile("record", record);
        if (const auto speed = fabrics::ownSpeedMmPerS(record)) key.add("speed_mm_per_s", *speed);
    }
    if (needs(Signal::ShapeFromShading))
        key.add("method", static_cast<int>(m_request.shading.method))
            .add("high_pass_px", m_request.shading.highPassPx)
            .add("regularisation", m_request.shading.regularisation)
            .add("light_azimuth_deg", m_request.shading.lightAzimuthDeg)
            .add("from_below", m_request.shading.lightFromBelow);
    if (needsGenerators(needed)) {
        if (!m_generators) m_generators = models::identityOfGenerators(*m_request.cache, m_request.generation);
        key.add("generators", *m_generators);
    }
    return key.hex();
}

std::optional<KeptRange> KeptRanges::find(const protocols::FabricId& fabric, const SampleChoice& samples,
                                          const protocols::ConditionId& condition)
{
    // Percentiles are those of all pixels together; single ranges do not give them.
    if (!m_request.cache || !m_request.percentiles.whole()) return std::nullopt;
    const auto bytes = m_request.cache->find(keyOf(fabric, samples, condition));
    const auto result = bytes ? cache::unpacked(*bytes) : std::nullopt;
    if (!result) return std::nullopt;
    try {
        const auto facts = json::parse(result->factsJson);
        KeptRange range{facts.at("min").get<double>(), facts.at("max").get<double>(), facts.at("quantity").get<std::string>()};
        return range.min <= range.max ? std::optional(std::move(range)) : std::nullopt;
    } catch (const json::exception&) {  // of another layout
        return std::nullopt;
    }
}

void KeptRanges::keep(const protocols::FabricId& fabric, const SampleChoice& samples, const protocols::ConditionId& condition,
                      const FabricSignals& signals, const KeptRange& range)
{
    if (!m_request.cache || needsWarning(signals)) return;
    const json facts{{"min", range.min}, {"max", range.max}, {"quantity", range.quantity}};
    m_request.cache->keep(keyOf(fabric, samples, condition), cache::packed({facts.dump(), {}}));
}

}  // namespace rendering
