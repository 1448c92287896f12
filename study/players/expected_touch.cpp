#include "study/players/expected_touch.h"

#include <algorithm>
#include <cstdio>

#include "protocols/files/errors.h"
#include "rendering/composition/render_fabrics.h"

namespace study::players {

namespace {

using rendering::fabrics::Dataset;
using rendering::fabrics::Modality;

constexpr int placesFelt = 4;  // a hand goes over a swatch, not over one spot

/// The sample at place `place` of `places`, spread over all there are.
int sampleAt(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality, int place)
{
    const auto indices = sampleIndices(dataset, fabric, modality);
    if (indices.empty())
        throw protocols::badInput({"fabric " + fabric.value + " has no " + nameOf(modality) + " sample", dataset.folder.string(),
                                   "presses and strokes, from which simulated participants know a fabric's touch",
                                   "use scripted participants (`vis2hap replay`) for this study"});
    return indices[static_cast<std::size_t>(place) * (indices.size() - 1) / (placesFelt - 1)];
}

Percept mean(const std::vector<Percept>& felt)
{
    Percept average;
    for (const auto& percept : felt) {
        average.slipperiness += percept.slipperiness / static_cast<double>(felt.size());
        for (std::size_t i = 0; i < average.texture.size(); ++i)
            average.texture[i] += percept.texture[i] / static_cast<double>(felt.size());
    }
    return average;
}

}  // namespace

std::map<protocols::FabricId, Percept> expectedTouch(const database::StudyFacts& facts, const std::filesystem::path& folder)
{
    const auto dataset = rendering::fabrics::readDataset(folder);
    if (hashOf(dataset) != facts.datasetSha256)
        std::fprintf(stderr, "warning: %s is not the data set that the study was made from\n", folder.c_str());
    rendering::RenderRequest request;
    request.fabrics = facts.fabrics;
    request.rangeOver = facts.fabrics;
    request.conditions = {protocols::conditionNamed("h&f").conditionId()};
    std::map<protocols::FabricId, std::vector<Percept>> felt;
    for (int place = 0; place < placesFelt; ++place) {
        for (const auto& fabric : facts.fabrics)
            request.samples[fabric] = {0, sampleAt(dataset, fabric, Modality::Tactile, place),
                                       sampleAt(dataset, fabric, Modality::Friction, place)};
        const auto rendering = renderFabrics(dataset, request);
        for (const auto& [fabric, image] : rendering.conditions.front().images) felt[fabric].push_back(feel(image));
    }
    std::map<protocols::FabricId, Percept> expected;
    for (const auto& [fabric, percepts] : felt) expected[fabric] = mean(percepts);
    return expected;
}

}  // namespace study::players
