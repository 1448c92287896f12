#include "study/making/sample_choice.h"

#include <algorithm>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/random.h"

namespace study::making {

namespace {

using rendering::Signal;
using rendering::fabrics::Modality;

struct Draw {
    int index = 0;
    bool trainedOn = false;
};

bool wasTrainedOn(const rendering::models::ModelCard& card, const std::filesystem::path& file)
{
    const auto& hashes = card.trainingSampleHashes;
    return std::binary_search(hashes.begin(), hashes.end(), protocols::sha256OfFile(file));
}

Draw drawSample(const rendering::fabrics::Dataset& dataset, const protocols::FabricId& fabric, Modality modality,
                const rendering::models::ModelCard* card, std::uint64_t seed, bool allowTrained)
{
    auto indices = sampleIndices(dataset, fabric, modality);
    const std::string name = rendering::fabrics::nameOf(modality);
    if (indices.empty())
        throw protocols::badInput({"fabric " + fabric.value + " has no " + name + " sample", dataset.folder.string(),
                                   "at least one, because a condition of the protocol needs it",
                                   "add recordings or leave those conditions out of the protocol"});
    auto random = protocols::Random::stream(seed, "sample/" + fabric.value + "/" + name);
    random.shuffle(indices);
    if (!card) return {indices.front(), false};
    for (int index : indices)
        if (!wasTrainedOn(*card, samplePath(dataset, fabric, modality, index))) return {index, false};
    if (!allowTrained)
        throw protocols::badInput({"the model was trained on every " + name + " sample of fabric " + fabric.value,
                                   dataset.folder.string(), "a sample that it has not seen",
                                   "use another data set or model, or --allow-training-samples (stamped into the report)"});
    return {indices.front(), true};
}

bool contains(const std::vector<Signal>& signals, Signal signal)
{
    return std::find(signals.begin(), signals.end(), signal) != signals.end();
}

}  // namespace

ChosenSamples chooseSamples(const rendering::fabrics::Dataset& dataset, const std::vector<protocols::FabricId>& fabrics,
                            const std::vector<Signal>& signals, const rendering::models::ModelCard* card, std::uint64_t seed,
                            bool allowTrained)
{
    ChosenSamples chosen;
    const auto take = [&](const protocols::FabricId& fabric, Signal needed, Modality modality, int& index) {
        if (!contains(signals, needed)) return;
        const Draw draw = drawSample(dataset, fabric, modality, card, seed, allowTrained);
        index = draw.index;
        chosen.someTrainedOn = chosen.someTrainedOn || draw.trainedOn;
    };
    for (const auto& fabric : fabrics) {
        auto& sample = chosen.samples[fabric];
        take(fabric, Signal::Photograph, Modality::Visual, sample.visual);
        take(fabric, Signal::TactileFrame, Modality::Tactile, sample.tactile);
        take(fabric, Signal::FrictionRecord, Modality::Friction, sample.friction);
    }
    return chosen;
}

}  // namespace study::making
