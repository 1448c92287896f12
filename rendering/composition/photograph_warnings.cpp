#include "rendering/composition/photograph_warnings.h"

#include <cmath>

namespace rendering {

namespace {

std::string oneDecimal(double value)
{
    const long tenths = std::lround(value * 10);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

std::string photographOf(const RenderedFabrics& rendering, const protocols::FabricId& fabric)
{
    return "photograph " + std::to_string(rendering.samples.at(fabric).visual) + " of " + fabric.value;
}

}  // namespace

std::vector<std::string> unfamiliarPhotographs(const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    bool unknown = false;
    for (const auto& [fabric, signals] : rendering.signals) {
        if (!signals.photograph) continue;
        unknown = unknown || !signals.photograph->distance;
        if (signals.photograph->unfamiliar())
            lines.push_back(photographOf(rendering, fabric) + " differs from all training photographs (distance " +
                            oneDecimal(*signals.photograph->distance) + ", 99 % of known fabrics lie below " +
                            oneDecimal(signals.photograph->usualDistance) + "); its height and friction are extrapolations");
    }
    if (unknown)
        lines.push_back("the weights do not state their training photographs, so unfamiliar photographs cannot be recognised");
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
