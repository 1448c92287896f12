#include "rendering/composition/photograph_warnings.h"

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"

namespace rendering {

namespace {

std::string photographOf(const RenderedFabrics& rendering, const protocols::FabricId& fabric)
{
    return "photograph " + std::to_string(rendering.samples.at(fabric).visual) + " of " + fabric.value;
}

}  // namespace

void refuseOtherThings(const RenderedFabrics& rendering)
{
    std::string names;
    for (const auto& [fabric, signals] : rendering.signals)
        if (signals.likeness == models::ClothLikeness::NotCloth)
            names += (names.empty() ? "" : ", ") + photographOf(rendering, fabric);
    if (names.empty()) return;
    throw protocols::badInput({names + " does not look like cloth, so nothing is generated", "the generators",
                               "photographs that one fabric fills, sharp and evenly lit",
                               "choose another photograph or cut it to the fabric; --even-strange generates all the same"});
}

std::vector<std::string> strangePhotographs(const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    for (const auto& [fabric, signals] : rendering.signals)
        if (signals.likeness == models::ClothLikeness::NotCloth)
            lines.push_back(photographOf(rendering, fabric) +
                            " does not look like cloth; what is generated from it means nothing");
        else if (signals.likeness == models::ClothLikeness::Unusual)
            lines.push_back(photographOf(rendering, fabric) +
                            " is unusual for cloth (one drawn cloth in twenty is like it); its height and friction are doubtful");
    return lines;
}

std::vector<std::string> uncertainFriction(const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    for (const auto& [fabric, signals] : rendering.signals)
        if (signals.photograph && signals.photograph->meanFriction && signals.photograph->meanFriction->tellsLittle())
            lines.push_back(photographOf(rendering, fabric) + " tells little of its friction (90 % interval " +
                            protocols::fixed(signals.photograph->meanFriction->low, 2) + " to " +
                            protocols::fixed(signals.photograph->meanFriction->high, 2) +
                            "). Its generated friction is that of an ordinary cloth" +
                            (signals.fibre ? " of " + nameOf(*signals.fibre)
                                           : ". If its label names one fibre, state it (\"fibre\" in dataset.json)"));
    return lines;
}

std::vector<std::string> cutPhotographs(const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    for (const auto& [fabric, signals] : rendering.signals)
        if (signals.photograph && signals.photograph->middleOnly)
            lines.push_back(photographOf(rendering, fabric) +
                            " is too large for the generators; only its middle of 2048 px at the model's pitch is used");
    return lines;
}

}  // namespace rendering
