#include "rendering/composition/kept_signals.h"

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <utility>

#include "rendering/cache/cache_key.h"
#include "rendering/cache/packed_result.h"

namespace rendering {

namespace {

using cache::CacheKey;
using fabrics::Modality;
using nlohmann::json;

/// A kept result with one map, CV_32FC1. Of an array of another type the values would be read beyond its end, so that it counts
/// as not kept.
std::optional<cache::PackedResult> keptMap(cache::ResultCache& cache, const std::string& key)
{
    const auto bytes = cache.find(key);
    auto result = bytes ? cache::unpacked(*bytes) : std::nullopt;
    const bool isMap =
        result && result->arrays.size() == 1 && !result->arrays.front().empty() && result->arrays.front().type() == CV_32FC1;
    return isMap ? std::move(result) : std::nullopt;
}

double millisecondsOf(const FabricSignals& signals, Signal signal)
{
    const auto found = signals.milliseconds.find(signal);
    return found == signals.milliseconds.end() ? 0 : found->second;
}

json reliefFacts(const FabricSignals& signals)
{
    return {{"azimuth_deg", signals.light->azimuthDeg},
            {"coherence", signals.light->coherence},
            {"colour_variation", *signals.colourVariation},
            {"left_out", signals.shapeLeftOut ? json(*signals.shapeLeftOut) : json(nullptr)},
            {"ms", millisecondsOf(signals, Signal::ShapeFromShading)}};
}

/// Throws nlohmann's exceptions for other fields.
void takeReliefFacts(const json& facts, FabricSignals& signals)
{
    // All are read before the first is kept: the fields of a result that is computed again must not be mixed with these.
    const signals::Light light{facts.at("azimuth_deg").get<double>(), facts.at("coherence").get<double>()};
    const double colourVariation = facts.at("colour_variation").get<double>(), taken = facts.at("ms").get<double>();
    const auto& leftOut = facts.at("left_out");
    if (!leftOut.is_null()) signals.shapeLeftOut = leftOut.get<double>();
    signals.light = light;
    signals.colourVariation = colourVariation;
    signals.milliseconds[Signal::ShapeFromShading] = taken;
}

}  // namespace

cv::Mat KeptSignals::height(const protocols::FabricId& fabric, int index, models::Quality quality, FabricSignals& result,
                            const std::function<cv::Mat()>& compute)
{
    if (!isOn()) return compute();
    const std::string key = CacheKey(*m_cache, "photometric height")
                                .addFile("frame", samplePath(m_dataset, fabric, Modality::Tactile, index))
                                .addFile("reference", m_dataset.folder / "tactile-reference.png")
                                .addFile("calibration", m_dataset.folder / m_dataset.tactileCalibration)
                                .add("mm_per_pixel", m_dataset.tactileMmPerPixel)
                                .add("fast", quality == models::Quality::Fast)
                                .hex();
    if (const auto kept = keptMap(*m_cache, key)) try {
            result.milliseconds[Signal::PhotometricHeight] = json::parse(kept->factsJson).at("ms").get<double>();
            return kept->arrays.front();
        } catch (const json::exception&) {
            // Of another layout: computed again.
        }
    cv::Mat height = compute();
    const json facts{{"ms", millisecondsOf(result, Signal::PhotometricHeight)}};
    m_cache->keep(key, cache::packed({facts.dump(), {height}}));
    return height;
}

cv::Mat KeptSignals::relief(const protocols::FabricId& fabric, int index, const signals::ShadingOptions& options, cv::Size shown,
                            FabricSignals& result, const std::function<cv::Mat()>& compute)
{
    if (!isOn()) return compute();
    const std::string key = CacheKey(*m_cache, "shape from shading")
                                .addFile("photograph", samplePath(m_dataset, fabric, Modality::Visual, index))
                                .add("method", static_cast<int>(options.method))
                                .add("quality", static_cast<int>(options.quality))
                                .add("high_pass_px", options.highPassPx)
                                .add("regularisation", options.regularisation)
                                .add("light_azimuth_deg", options.lightAzimuthDeg)
                                .add("from_below", options.lightFromBelow)
                                .add("shown_width", shown.width)
                                .add("shown_height", shown.height)
                                .hex();
    if (const auto kept = keptMap(*m_cache, key)) try {
            takeReliefFacts(json::parse(kept->factsJson), result);
            return kept->arrays.front();
        } catch (const json::exception&) {
            // Of another layout: computed again.
        }
    cv::Mat relief = compute();
    m_cache->keep(key, cache::packed({reliefFacts(result).dump(), {relief}}));
    return relief;
}

}  // namespace rendering
