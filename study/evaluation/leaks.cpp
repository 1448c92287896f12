#include "study/evaluation/leaks.h"

#include <algorithm>
#include <set>

#include "protocols/files/sha256.h"
#include "stats/kernels/threads.h"

namespace study::evaluation {

namespace fabrics = rendering::fabrics;
using fabrics::Part;

namespace {

bool sameSignal(const PlacedSample& a, const PlacedSample& b)
{
    return a.place.modality == b.place.modality && a.place.fabric == b.place.fabric;
}

bool overlapping(const PlacedSample& a, const PlacedSample& b)
{
    return a.footprint && b.footprint && fabrics::overlap(*a.footprint, *b.footprint);
}

}  // namespace

std::vector<PlacedSample> placedSamples(const fabrics::Dataset& dataset, const PlanRequest& request, const Report& report)
{
    const auto split = request.split == SplitKind::Location ? fabrics::splitByLocation(dataset, request.seed)
                                                            : fabrics::splitBySample(dataset, request.seed);
    std::vector<PlacedSample> samples(split.size());
    const auto progress = [&](std::size_t done) {
        if (report) report("hashes of the samples", static_cast<int>(done), static_cast<int>(split.size()));
    };
    stats::onThreads(
        split.size(), request.threads,
        [&](std::size_t i) {
            const auto& place = split[i].first;
            const auto file = fabrics::samplePath(dataset, place.fabric, place.modality, place.index);
            samples[i] = {place, split[i].second, protocols::sha256OfFile(file), fabrics::footprintOf(dataset, place), false};
        },
        progress);
    return samples;
}

bool isHeldOut(const PlanRequest& request, const protocols::FabricId& fabric)
{
    return request.split == SplitKind::Fabric &&
           std::find(request.heldOut.begin(), request.heldOut.end(), fabric) != request.heldOut.end();
}

bool isTested(const PlanRequest& request, const PlacedSample& sample)
{
    return sample.part == Part::Testing && (request.split != SplitKind::Fabric || isHeldOut(request, sample.place.fabric));
}

Leaks findLeaks(std::vector<PlacedSample>& samples, const PlanRequest& request)
{
    Leaks leaks;
    std::set<std::string> hashesElsewhere;
    for (const PlacedSample& sample : samples)
        if (sample.part != Part::Testing) hashesElsewhere.insert(sample.sha256);
    for (PlacedSample& sample : samples) {
        if (!isTested(request, sample)) continue;
        const Modality modality = sample.place.modality;
        const bool known = request.trainedOn.contains(sample.sha256);
        ++leaks.tested[modality];
        leaks.placesKnown = leaks.placesKnown && sample.footprint.has_value();
        leaks.duplicates[modality] += hashesElsewhere.contains(sample.sha256);
        bool overlaps = false, overlapsTraining = false;
        for (const PlacedSample& other : samples) {
            if (&other == &sample || !sameSignal(sample, other) || !overlapping(sample, other)) continue;
            overlaps = overlaps || other.part != Part::Testing;
            overlapsTraining = overlapsTraining || request.trainedOn.contains(other.sha256);
        }
        leaks.overlaps[modality] += overlaps;
        leaks.trainedOn[modality] += known;
        const bool leftOutForPlace = !known && overlapsTraining && request.split == SplitKind::Location;
        leaks.placeTrainedOn[modality] += leftOutForPlace;
        sample.leftOut = request.split != SplitKind::Augmented && (known || leftOutForPlace);
    }
    return leaks;
}

std::map<protocols::FabricId, int> photographsTrainedOn(const fabrics::Dataset& dataset,
                                                        const std::vector<std::string>& trainedOn)
{
    std::map<protocols::FabricId, int> counts;
    if (trainedOn.empty()) return counts;
    for (const auto& fabric : dataset.fabrics)
        for (const int index : fabrics::sampleIndices(dataset, fabric.id, Modality::Visual))
            if (std::ranges::binary_search(
                    trainedOn, protocols::sha256OfFile(fabrics::samplePath(dataset, fabric.id, Modality::Visual, index))))
                ++counts[fabric.id];
    return counts;
}

}  // namespace study::evaluation
