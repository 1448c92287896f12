#include "study/evaluation/test_plan.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/random.h"
#include "study/evaluation/leaks.h"

namespace study::evaluation {

namespace {

namespace fabrics = rendering::fabrics;
using fabrics::Part;

std::vector<PlannedFabric> byFabric(const fabrics::Dataset& dataset, const std::vector<PlacedSample>& samples,
                                    const PlanRequest& request)
{
    std::vector<PlannedFabric> result;
    for (const auto& info : dataset.fabrics) result.push_back({info.id, isHeldOut(request, info.id), {}, {}});
    for (const PlacedSample& sample : samples) {
        const auto& place = sample.place;
        const auto fabric =
            std::find_if(result.begin(), result.end(), [&](const auto& one) { return one.fabric == place.fabric; });
        const PlannedSample plain{place.fabric, place.modality, place.index, place.rotationDeg, sample.sha256};
        if (isTested(request, sample) && !sample.leftOut) fabric->testing[place.modality].push_back(plain);
        if (sample.part == Part::Training) fabric->training[place.modality].push_back(plain);
    }
    return result;
}

std::vector<PlannedSample> shuffled(std::vector<PlannedSample> samples, const PlanRequest& request, const std::string& purpose)
{
    protocols::Random random = protocols::Random::stream(request.seed, "evaluate/" + purpose);
    random.shuffle(samples);
    return samples;
}

/// Measured partners for the photographs of one fabric, from one signal.
class Partners {
public:
    Partners(const PlannedFabric& fabric, Modality modality, bool aligned, const PlanRequest& request)
        : m_aligned(aligned), m_testing(partOf(fabric.testing, modality)), m_training(partOf(fabric.training, modality))
    {
        const std::string purpose = fabric.fabric.value + "/" + fabrics::nameOf(modality);
        if (!aligned) m_testing = shuffled(m_testing, request, purpose);
        m_training = shuffled(m_training, request, purpose + "/training");
    }

    /// In an aligned data set, the sample with the same index. Otherwise the samples in turn, in random order.
    std::optional<PlannedSample> of(const PlannedSample& photograph, std::size_t turn) const
    {
        if (!m_aligned) return m_testing.empty() ? std::nullopt : std::optional(m_testing[turn % m_testing.size()]);
        const auto found = std::find_if(m_testing.begin(), m_testing.end(),
                                        [&](const PlannedSample& sample) { return sample.index == photograph.index; });
        return found == m_testing.end() ? std::nullopt : std::optional(*found);
    }

    /// The next test sample with different bytes; otherwise a training sample.
    std::optional<PlannedSample> otherThan(const std::optional<PlannedSample>& partner) const
    {
        if (!partner) return {};
        const auto self = std::find_if(m_testing.begin(), m_testing.end(),
                                       [&](const PlannedSample& sample) { return sample.index == partner->index; });
        for (std::size_t k = 1; k < m_testing.size(); ++k) {
            const PlannedSample& next = m_testing[(static_cast<std::size_t>(self - m_testing.begin()) + k) % m_testing.size()];
            if (next.sha256 != partner->sha256) return next;
        }
        for (const PlannedSample& sample : m_training)
            if (sample.sha256 != partner->sha256) return sample;
        return {};
    }

private:
    static std::vector<PlannedSample> partOf(const std::map<Modality, std::vector<PlannedSample>>& samples, Modality modality)
    {
        const auto found = samples.find(modality);
        return found == samples.end() ? std::vector<PlannedSample>{} : found->second;
    }

    bool m_aligned;
    std::vector<PlannedSample> m_testing, m_training;
};

void addPairs(TestPlan& plan, std::size_t fabric, bool aligned, const PlanRequest& request)
{
    const PlannedFabric& samples = plan.fabrics[fabric];
    const auto found = samples.testing.find(Modality::Visual);
    if (found == samples.testing.end()) return;
    std::vector<PlannedSample> photographs = found->second;
    if (request.samplesPerFabric && photographs.size() > static_cast<std::size_t>(*request.samplesPerFabric)) {
        photographs = shuffled(photographs, request, samples.fabric.value + "/photographs");
        photographs.resize(static_cast<std::size_t>(*request.samplesPerFabric));
    }
    const Partners presses(samples, Modality::Tactile, aligned, request), strokes(samples, Modality::Friction, aligned, request);
    for (std::size_t turn = 0; turn < photographs.size(); ++turn) {
        const PlannedSample& photograph = photographs[turn];
        const auto press = presses.of(photograph, turn), stroke = strokes.of(photograph, turn);
        plan.pairs.push_back({fabric, photograph, press, stroke, presses.otherThan(press), strokes.otherThan(stroke)});
    }
}

int sum(const std::map<Modality, int>& counts)
{
    int total = 0;
    for (const auto& [modality, count] : counts) total += count;
    return total;
}

void requirePhotographs(const fabrics::Dataset& dataset)
{
    for (const auto& fabric : dataset.fabrics)
        if (!fabrics::sampleIndices(dataset, fabric.id, Modality::Visual).empty()) return;
    throw protocols::badInput({"the data set has no photographs to generate signals from", dataset.folder.string(),
                               "visual/*.png of at least one fabric", "import photographs with `vis2hap import photos`"});
}

void requireSomethingLeft(const fabrics::Dataset& dataset, const TestPlan& plan)
{
    if (!plan.pairs.empty()) return;
    const int trainedOn = sum(plan.leaks.trainedOn) + sum(plan.leaks.placeTrainedOn);
    const std::string left =
        trainedOn > 0 ? "the model was trained on every photograph of the testing part, or on its place (" +
                            std::to_string(trainedOn) + " samples were left out)"
                      : "the testing part of the split is empty (fewer than three places or samples cannot be split 8:1:1)";
    throw protocols::badInput(
        {"no test photograph is left: " + left, dataset.folder.string(), "photographs that the model was not trained on",
         "use the --split and --split-seed of the model's training (its card names them), another --split, or other data"});
}

}  // namespace

std::string_view nameOf(SplitKind kind)
{
    switch (kind) {
        case SplitKind::Sample:
            return "sample";
        case SplitKind::Location:
            return "location";
        case SplitKind::Fabric:
            return "fabric";
        case SplitKind::Augmented:
            return "augmented";
    }
    return {};
}

TestPlan testPlan(const fabrics::Dataset& dataset, const PlanRequest& request, const Report& report)
{
    requirePhotographs(dataset);
    std::vector<PlacedSample> samples = placedSamples(dataset, request, report);
    TestPlan plan;
    plan.leaks = findLeaks(samples, request);
    plan.fabrics = byFabric(dataset, samples, request);
    for (std::size_t i = 0; i < plan.fabrics.size(); ++i)
        addPairs(plan, i, dataset.pairing == fabrics::Pairing::Aligned, request);
    requireSomethingLeft(dataset, plan);
    if (!plan.leaks.placesKnown)
        plan.notes.push_back(request.split == SplitKind::Location
                                 ? "samples.csv does not give every place; a sample without one counts as a separate place"
                                 : "samples.csv does not give every place, so some overlapping samples may be missed");
    for (const PlannedFabric& fabric : plan.fabrics)
        if (const bool tested = request.split != SplitKind::Fabric || fabric.heldOut;
            tested && !fabric.testing.contains(Modality::Visual))
            plan.notes.push_back("fabric " + fabric.fabric.value + " is left out, because it has no test photograph left");
    return plan;
}

}  // namespace study::evaluation
