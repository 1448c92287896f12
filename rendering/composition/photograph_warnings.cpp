#include <cmath>
#include <cstdio>

#include "rendering/composition/render_fabrics.h"

namespace rendering {

namespace {

std::string oneDecimal(double value)
{
    const long tenths = std::lround(value * 10);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

std::string photographOf(const Rendering& rendering, const protocols::FabricId& fabric)
{
    return "photograph " + std::to_string(rendering.samples.at(fabric).visual) + " of " + fabric.value;
}

}  // namespace

std::vector<std::string> unfamiliarPhotographs(const Rendering& rendering)
{
    std::vector<std::string> lines;
    bool untold = false;
    for (const auto& [fabric, signals] : rendering.signals) {
        if (!signals.photograph) continue;
        untold = untold || !signals.photograph->distance;
        if (signals.photograph->unfamiliar())
            lines.push_back(photographOf(rendering, fabric) +
                            " is unlike every photograph that the model was trained on (distance " +
                            oneDecimal(*signals.photograph->distance) + ", 99 % of known fabrics lie below " +
                            oneDecimal(signals.photograph->usualDistance) + "); what it generates is a guess");
    }
    if (untold)
        lines.push_back("these weights do not tell which photographs they know; what is generated of an unlike one is a guess");
    return lines;
}

std::vector<std::string> cutPhotographs(const Rendering& rendering)
{
    std::vector<std::string> lines;
    for (const auto& [fabric, signals] : rendering.signals)
        if (signals.photograph && signals.photograph->middleOnly)
            lines.push_back(photographOf(rendering, fabric) +
                            " is larger than the generators take; its middle of 2048 px at the model's pitch is used");
    return lines;
}

}  // namespace rendering
