#include "study/evaluation/known_samples.h"

#include <algorithm>

#include "protocols/files/sha256.h"
#include "protocols/random.h"
#include "rendering/fabrics/friction_record.h"
#include "rendering/fabrics/location_split.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;

/// A sample with its place, and its bytes where they are needed.
struct Candidate {
    fabrics::SamplePlace place;
    bool training = false;
};

std::optional<int> shownIndex(const ShownSamples& shown, Modality modality)
{
    switch (modality) {
        case Modality::Visual:
            return shown.photograph;
        case Modality::Tactile:
            return shown.press;
        case Modality::Friction:
            return shown.stroke;
    }
    return {};
}

std::string bytesHash(const fabrics::Dataset& dataset, const fabrics::SamplePlace& place)
{
    return protocols::sha256OfFile(fabrics::samplePath(dataset, place.fabric, place.modality, place.index));
}

PlannedSample plannedSample(const fabrics::Dataset& dataset, const fabrics::SamplePlace& place)
{
    return {place.fabric, place.modality, place.index, place.rotationDeg, bytesHash(dataset, place)};
}

/// Whether a control can use the sample: it gives a height or a coefficient of friction.
bool isUsable(const fabrics::Dataset& dataset, const fabrics::SamplePlace& place)
{
    switch (place.modality) {
        case Modality::Visual:
            return true;
        case Modality::Tactile:
            return dataset.tactileCalibration != "known" ||
                   std::filesystem::exists(fabrics::knownHeightPath(dataset, place.fabric, place.index));
        case Modality::Friction:
            return fabrics::readFriction(dataset, place.fabric, place.index).isCoefficient();
    }
    return false;
}

/// A place of the fabric that the study shows.
class ShownPlace {
public:
    ShownPlace(const fabrics::Dataset& dataset, const fabrics::SamplePlace& place)
        : m_place(place), m_footprint(fabrics::footprintOf(dataset, place)), m_sha256(bytesHash(dataset, place))
    {
    }

    bool isSeenIn(const fabrics::Dataset& dataset, const fabrics::SamplePlace& other) const
    {
        if (other.index == m_place.index || (!other.group.empty() && other.group == m_place.group)) return true;
        const auto footprint = fabrics::footprintOf(dataset, other);
        return (m_footprint && footprint && fabrics::overlap(*m_footprint, *footprint)) || bytesHash(dataset, other) == m_sha256;
    }

private:
    fabrics::SamplePlace m_place;
    std::optional<fabrics::Footprint> m_footprint;
    std::string m_sha256;
};

/// All samples of one fabric, in an order that is drawn by seed and is the same for all signals.
std::vector<Candidate> candidatesOf(const std::vector<std::pair<fabrics::SamplePlace, fabrics::Part>>& split,
                                    const protocols::FabricId& fabric, std::uint64_t seed)
{
    std::vector<Candidate> candidates;
    std::vector<int> indices;
    for (const auto& [place, part] : split) {
        if (place.fabric != fabric) continue;
        candidates.push_back({place, part == fabrics::Part::Training});
        indices.push_back(place.index);
    }
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    protocols::Random::stream(seed, "known samples/" + fabric.value).shuffle(indices);
    std::map<int, std::size_t> rank;
    for (std::size_t i = 0; i < indices.size(); ++i) rank[indices[i]] = i;
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Candidate& a, const Candidate& b) { return rank.at(a.place.index) < rank.at(b.place.index); });
    return candidates;
}

std::vector<PlannedSample> knownOf(const fabrics::Dataset& dataset, const std::vector<Candidate>& candidates, Modality modality,
                                   const std::optional<ShownPlace>& shown)
{
    std::vector<PlannedSample> known;
    for (const Candidate& candidate : candidates) {
        if (known.size() == mostKnownSamples) break;
        const bool wanted = candidate.training && candidate.place.modality == modality && isUsable(dataset, candidate.place);
        if (wanted && !(shown && shown->isSeenIn(dataset, candidate.place)))
            known.push_back(plannedSample(dataset, candidate.place));
    }
    return known;
}

const fabrics::SamplePlace* placeOf(const std::vector<Candidate>& candidates, Modality modality, std::optional<int> index)
{
    const auto found = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& one) {
        return index && one.place.modality == modality && one.place.index == *index;
    });
    return found == candidates.end() ? nullptr : &found->place;
}

/// The shown samples with the first known ones as their other place. None if the data set has lost the photograph.
std::optional<TestPair> pairOf(const fabrics::Dataset& dataset, const std::vector<Candidate>& candidates,
                               const PlannedFabric& fabric, std::size_t number, const ShownSamples& shown)
{
    const auto sample = [&](Modality modality) -> std::optional<PlannedSample> {
        const auto* place = placeOf(candidates, modality, shownIndex(shown, modality));
        return place != nullptr ? std::optional(plannedSample(dataset, *place)) : std::nullopt;
    };
    const auto first = [&](Modality modality) -> std::optional<PlannedSample> {
        const auto& known = fabric.training.at(modality);
        return known.empty() ? std::nullopt : std::optional(known.front());
    };
    const auto photograph = sample(Modality::Visual);
    if (!photograph) return {};
    return TestPair{number,
                    *photograph,
                    sample(Modality::Tactile),
                    sample(Modality::Friction),
                    first(Modality::Tactile),
                    first(Modality::Friction)};
}

}  // namespace

TestPlan planOfStudy(const fabrics::Dataset& dataset, const KnownSamplesRequest& request)
{
    const auto split = request.splitByLocation ? fabrics::splitByLocation(dataset, request.splitSeed)
                                               : fabrics::splitBySample(dataset, request.splitSeed);
    TestPlan plan;
    for (std::size_t i = 0; i < dataset.fabrics.size(); ++i) {
        const protocols::FabricId& id = dataset.fabrics[i].id;
        const auto candidates = candidatesOf(split, id, request.drawSeed);
        const auto shown =
            std::find_if(request.shown.begin(), request.shown.end(), [&](const ShownSamples& one) { return one.fabric == id; });
        const bool heldOut = std::find(request.heldOut.begin(), request.heldOut.end(), id) != request.heldOut.end();
        PlannedFabric fabric{id, heldOut, {}, {}};
        for (const Modality modality : rendering::fabrics::allModalities) {
            const auto* place =
                shown == request.shown.end() ? nullptr : placeOf(candidates, modality, shownIndex(*shown, modality));
            fabric.training[modality] = knownOf(dataset, candidates, modality,
                                                place != nullptr ? std::optional(ShownPlace(dataset, *place)) : std::nullopt);
        }
        if (shown != request.shown.end())
            if (auto pair = pairOf(dataset, candidates, fabric, i, *shown)) plan.pairs.push_back(std::move(*pair));
        plan.fabrics.push_back(std::move(fabric));
    }
    return plan;
}

}  // namespace study::evaluation
