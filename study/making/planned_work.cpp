#include "study/making/planned_work.h"

#include <algorithm>

#include "protocols/files/number_text.h"
#include "rendering/composition/friction_image.h"

namespace study::making {

namespace {

std::string times(std::size_t count, const std::string& what) { return std::to_string(count) + " x " + what; }

}  // namespace

std::string plannedWork(const StudyMaterial& material)
{
    const auto& protocol = material.protocol;
    const std::size_t fabrics = material.fabrics.size(), conditions = protocol.conditions.size();
    const auto signals = rendering::signalsFor(std::span<const protocols::ConditionId>(material.render.conditions));
    std::string list;
    for (const auto signal : signals) list += (list.empty() ? "" : ", ") + times(fabrics, nameOf(signal));
    const double megabytes =
        static_cast<double>(fabrics * conditions) * rendering::displayWidthPx * rendering::displayHeightPx / 1e6;
    std::string text = "  a study of " + std::to_string(fabrics) + " fabrics and " + std::to_string(conditions) +
                       " conditions, " + std::to_string(protocol.participants) + " participants with " +
                       std::to_string(protocol.presentations()) + " presentations each\n";
    text += "  signals, each at most once: " + list + "\n";
    text += std::string("  generators: ") +
            (needsGenerators(signals) ? "one start of vis2hap-nn for all photographs whose signals are not kept\n" : "none\n");
    text += "  ranges: " + times(material.render.conditions.size(), std::to_string(fabrics) + " maps") +
            "; friction images: " + std::to_string(fabrics * conditions) + ", sealed, " + protocols::fixed(megabytes, 0) +
            " MB\n";
    text += "  for familiarisation: at most " + std::to_string(protocol.familiarisationFabrics) + " images of other fabrics\n";
    return text + "  generated signals are compared with measured ones and with controls" +
           (needsGenerators(signals) ? "\n" : ": none here\n");
}

}  // namespace study::making
