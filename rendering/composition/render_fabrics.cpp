#include "rendering/composition/render_fabrics.h"

#include <algorithm>
#include <chrono>
#include <opencv2/core/types.hpp>
#include <set>
#include <utility>

#include "protocols/files/errors.h"
#include "rendering/composition/fabric_signals.h"
#include "rendering/composition/kept_ranges.h"
#include "rendering/models/kept_generation.h"

namespace rendering {

namespace {

using protocols::ConditionId;
using protocols::FabricId;

/// Work of a rendering, planned before anything is computed.
struct RenderPlan {
    /// Signals of every fabric that is used, by the quality of the conditions.
    std::map<models::Quality, std::map<FabricId, std::set<Signal>>> needed;
    std::map<ConditionId, std::vector<FabricId>> rangeOf;         ///< fabrics whose maps determine a condition's range
    std::map<std::pair<ConditionId, FabricId>, KeptRange> known;  ///< ranges of maps that need no computation
};

std::vector<FabricId> rangeFabrics(const fabrics::Dataset& dataset, const RenderRequest& request)
{
    std::vector<FabricId> ids = request.rangeOver;
    if (ids.empty())
        for (const auto& fabric : dataset.fabrics) ids.push_back(fabric.id);
    for (const auto& id : request.fabrics)
        if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    return ids;
}

RenderPlan planFor(const fabrics::Dataset& dataset, const RenderRequest& request, KeptRanges& kept, RenderedFabrics& rendering)
{
    RenderPlan plan;
    for (const auto& fabric : rangeFabrics(dataset, request)) {
        dataset.fabric(fabric);  // Throws for an unknown id.
        const bool written = std::find(request.fabrics.begin(), request.fabrics.end(), fabric) != request.fabrics.end();
        const auto chosen = request.samples.find(fabric);
        const auto samples = chosen != request.samples.end() ? chosen->second : firstSamples(dataset, fabric);
        for (const auto& id : request.conditions) {
            const auto& condition = protocols::conditionNamed(id.value);
            if (const auto fault = missingInput(dataset, fabric, samples, condition, request.scale)) {
                if (written) throw protocols::badInput(*fault);
                continue;
            }
            plan.rangeOf[id].push_back(fabric);
            rendering.samples[fabric] = samples;
            if (const auto range = kept.find(fabric, samples, id)) {
                plan.known[{id, fabric}] = *range;
                ++rendering.keptRanges;
                if (!written) continue;  // nothing else of this map is needed
            }
            for (const Signal signal : signalsFor(condition)) plan.needed[qualityOf(id, request)][fabric].insert(signal);
        }
    }
    return plan;
}

std::set<Signal> generatedAmong(const std::set<Signal>& needed)
{
    std::set<Signal> result;
    for (const Signal signal : {Signal::GeneratedHeight, Signal::GeneratedSpectrogram, Signal::GeneratedTrace})
        if (needed.contains(signal)) result.insert(signal);
    return result;
}

/// Passes all photographs of a quality in one call, because starting the generators costs more than running them.
void generate(const RenderPlan& plan, models::Quality quality, const RenderRequest& request, RenderedFabrics& rendering)
{
    std::vector<FabricId> fabrics;
    std::vector<models::InputPhotograph> photographs;
    std::set<Signal> wanted;
    auto& all = rendering.signalsAt.at(quality);
    for (const auto& [fabric, needed] : plan.needed.at(quality)) {
        const auto generated = generatedAmong(needed);
        if (generated.empty()) continue;
        wanted.insert(generated.begin(), generated.end());
        auto& signals = all.at(fabric);
        signals.likeness = models::shippedClothCheck().judge(signals.images.at(Signal::Photograph));
        fabrics.push_back(fabric);
        photographs.push_back(
            {signals.images.at(Signal::Photograph), signals.photographMmPerPixel, signals.photographLightDeg, signals.fibre});
    }
    if (fabrics.empty()) return;
    auto options = request.generation;
    options.quality = quality;
    options.height = wanted.contains(Signal::GeneratedHeight);
    options.friction = wanted.contains(Signal::GeneratedSpectrogram);
    const auto start = std::chrono::steady_clock::now();
    models::KeptGeneration kept(request.cache.get(), request.generate);
    auto generated = kept(photographs, options);
    rendering.milliseconds[*wanted.begin()] +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    if (generated.size() != fabrics.size())
        throw protocols::workFailed({.what = "the generators answered " + std::to_string(generated.size()) + " of " +
                                             std::to_string(fabrics.size()) + " photographs",
                                     .where = "",
                                     .expected = "signals for each photograph",
                                     .nextStep = "build both executables again"});
    for (std::size_t i = 0; i < fabrics.size(); ++i) {
        addGenerated(all[fabrics[i]], std::move(generated[i]), wanted);
    }
    if (kept.generated() > 0)
        for (const Signal signal : wanted) rendering.computed[signal] += kept.generated();
}

/// Key of the range of a map: the quantity of its measured friction, or "".
std::string rangeKey(const protocols::Condition& condition, const FabricSignals& signals)
{
    return condition.friction == protocols::FrictionSource::MeasuredTrace ? signals.measuredQuantity : "";
}

/// Replaces ranges by those between percentiles of all pixels. Needs another pass, because the whole range must be known.
template <class KeyOf, class MapOf>
void makeRobust(std::map<std::string, MapRange>& ranges, const KeyOf& keyOf, const MapOf& mapOf,
                const std::vector<FabricId>& rangeOver, const Percentiles& percentiles)
{
    std::map<std::string, RobustRange> robust;
    for (const auto& [key, range] : ranges) robust.emplace(key, range);
    for (const auto& fabric : rangeOver) robust.at(keyOf(fabric)).include(mapOf(fabric));
    for (auto& [key, range] : ranges) range = robust.at(key).between(percentiles.low, percentiles.high);
}

void requirePercentiles(const Percentiles& percentiles)
{
    if (percentiles.low >= 0 && percentiles.low < percentiles.high && percentiles.high <= 100) return;
    throw protocols::badInput({.what = "the percentiles do not form a range",
                               .where = "--range-percentiles",
                               .expected = "0 <= LO < HI <= 100, such as 0.1,99.9",
                               .nextStep = "correct the option"});
}

RenderedCondition renderCondition(const ConditionId& id, const RenderPlan& plan, const RenderRequest& request, KeptRanges& kept,
                                  const RenderedFabrics& rendering)
{
    const auto start = std::chrono::steady_clock::now();
    const auto& condition = protocols::conditionNamed(id.value);
    const auto& signals = rendering.signalsAt.at(qualityOf(id, request));
    const auto mapOf = [&](const FabricId& fabric) {
        return compose(condition, sourcesOf(condition, signals.at(fabric)), request.scale, request.extension);
    };
    const auto& rangeOver = plan.rangeOf.at(id);
    RenderedCondition result;
    result.condition = id;
    result.quality = qualityOf(id, request);
    result.rangeOver = rangeOver;
    // Two passes, because composing again is fast, while keeping the maps of all fabrics would take 4 MB each.
    const auto keyOf = [&](const FabricId& fabric) { return rangeKey(condition, signals.at(fabric)); };
    const auto rangeOfMap = [&](const FabricId& fabric) {
        if (const auto known = plan.known.find({id, fabric}); known != plan.known.end()) return known->second;
        MapRange own;
        own.include(mapOf(fabric));
        const KeptRange range{own.min, own.max, keyOf(fabric)};
        kept.keep(fabric, rendering.samples.at(fabric), id, signals.at(fabric), range);
        return range;
    };
    std::map<std::string, RenderedCondition::RangeSetters> setters;
    for (const auto& fabric : rangeOver) {
        const KeptRange own = rangeOfMap(fabric);
        auto& range = result.ranges[own.quantity];
        const MapRange before = range;
        range.include(own.min, own.max);
        auto& set = setters[own.quantity];
        if (before.empty || range.min < before.min) set.lowest = fabric;
        if (before.empty || range.max > before.max) set.highest = fabric;
    }
    if (!request.percentiles.whole()) makeRobust(result.ranges, keyOf, mapOf, rangeOver, request.percentiles);
    for (const auto& fabric : request.fabrics) {
        const auto map = mapOf(fabric);
        const auto& range = result.ranges.at(keyOf(fabric));
        if (result.images.empty()) {
            result.range = range;
            result.rangeSetBy = setters.at(keyOf(fabric));
        }
        result.images[fabric] = mapToDisplay(map, range, request.mapping);
        result.maps[fabric] = {map.extension, map.agreement, map.varianceLost,
                               request.percentiles.whole() ? 0 : shareOutside(map, range),
                               request.mapping.response ? shareOutOfReach(map, range, *request.mapping.response) : 0};
    }
    result.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return result;
}

/// What another quality has computed of a fabric already.
FabricSignals knownOf(const RenderedFabrics& rendering, const FabricId& fabric)
{
    FabricSignals known;
    for (const auto& [quality, signals] : rendering.signalsAt)
        if (const auto found = signals.find(fabric); found != signals.end()) addMissing(known, found->second);
    return known;
}

/// The signals of the usual quality, then those of the most accurate other one.
void joinQualities(RenderedFabrics& rendering, models::Quality usual)
{
    using models::Quality;
    for (const Quality quality : {usual, Quality::Accurate, Quality::Balanced, Quality::Fast})
        if (const auto found = rendering.signalsAt.find(quality); found != rendering.signalsAt.end())
            for (const auto& [fabric, signals] : found->second) addMissing(rendering.signals[fabric], signals);
}

std::size_t fabricsIn(const RenderPlan& plan)
{
    std::size_t count = 0;
    for (const auto& [quality, fabrics] : plan.needed) count += fabrics.size();
    return count;
}

}  // namespace

models::Quality qualityOf(const ConditionId& condition, const RenderRequest& request)
{
    return protocols::qualityOf(condition).value_or(request.generation.quality);
}

RenderedFabrics renderFabrics(const fabrics::Dataset& dataset, const RenderRequest& request,
                              const std::function<void(int, int, const std::string&)>& progress)
{
    requirePercentiles(request.percentiles);
    RenderedFabrics rendering;
    KeptRanges kept(dataset, request);
    const RenderPlan plan = planFor(dataset, request, kept, rendering);
    const int total = static_cast<int>(fabricsIn(plan) + request.conditions.size()) + 1;
    int done = 0;
    const auto report = [&](const std::string& what) {
        if (progress) progress(done, total, what);
        ++done;
    };
    const cv::Size shown = request.scale == DisplayScale::Pixels ? cv::Size(displayWidthPx, displayHeightPx) : cv::Size();
    for (const auto& [quality, fabrics] : plan.needed) {
        SignalComputation computation(dataset, quality, request.shading, shown, request.cache.get());
        for (const auto& [fabric, needed] : fabrics) {
            report("signals of " + fabric.value);
            const FabricSignals known = knownOf(rendering, fabric);
            rendering.signalsAt[quality][fabric] =
                computation.measured(fabric, rendering.samples.at(fabric), needed, rendering, known);
        }
    }
    for (const auto& id : request.conditions) rendering.signalsAt[qualityOf(id, request)];  // empty where only ranges are needed
    const auto wanted = signalsFor(request.conditions);
    report(needsGenerators(wanted) ? "generating" : "composing");
    for (const auto& [quality, fabrics] : plan.needed) generate(plan, quality, request, rendering);
    joinQualities(rendering, request.generation.quality);
    for (const auto& id : request.conditions) {
        report(id.value);
        if (plan.rangeOf.contains(id)) rendering.conditions.push_back(renderCondition(id, plan, request, kept, rendering));
    }
    if (progress) progress(total, total, "done");
    return rendering;
}

}  // namespace rendering
