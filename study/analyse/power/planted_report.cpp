#include "study/analyse/power/planted_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "protocols/files/safe_text.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

std::string percentWithError(const stats::StudyMean& mean)
{
    char text[48];
    std::snprintf(text, sizeof text, "%.2f +-%.2f", 100 * mean.mean(), 100 * mean.se());
    return text;
}

void putMean(ordered_json& json, const std::string& name, const stats::StudyMean& mean)
{
    json[name] = mean.mean();
    json[name + "_se"] = mean.se();
}

}  // namespace

stats::PlantedOptions plantedOptionsOf(const protocols::Protocol& protocol, const stats::PowerOptions& power, std::size_t studies)
{
    stats::PlantedOptions options;
    options.design = power.design;
    options.ratings = power.ratings;
    options.hasRatings = power.hasRatings;
    options.hasChoices = power.hasChoices;
    options.simulation.studies = studies;
    options.simulation.seed = power.simulation.seed;
    const auto placeOf = [&](const protocols::ConditionId& id) {
        return static_cast<std::size_t>(std::ranges::find(protocol.conditions, id) - protocol.conditions.begin());
    };
    for (const auto& contrast : protocols::contrastsInOrder(protocol))
        options.contrasts.emplace_back(placeOf(contrast.a), placeOf(contrast.b));
    return options;
}

void putPlanted(ordered_json& json, const std::vector<stats::PlantedCell>& cells)
{
    json["planted"] = ordered_json::array();
    for (const stats::PlantedCell& cell : cells)
        for (const stats::PlantedRow& row : cell.rows) {
            ordered_json one{{"truth", cell.truth.text()}, {"what", row.name}};
            one["studies"] = row.alike.studies;
            putMean(one, "these_fabrics", row.these);
            putMean(one, "fabrics_like_these", row.alike);
            putMean(one, "lmer_test", row.reference);
            putMean(one, "difference", row.alikeMinusReference);
            json["planted"].push_back(std::move(one));
        }
}

void printPlanted(const std::vector<stats::PlantedCell>& cells)
{
    std::printf(
        "\nclaims in studies with a planted difference: decided rightly, %%, with the Monte-Carlo standard error\n"
        "lmerTest: its linear mixed model of the two conditions alone, with the same correction; for fabrics like these\n");
    for (const stats::PlantedCell& cell : cells) {
        std::printf("%s\n  %-44s %15s %18s %15s %17s\n", cell.truth.text().c_str(), "", "these fabrics", "fabrics like these",
                    "lmerTest", "minus lmerTest");
        for (const stats::PlantedRow& row : cell.rows)
            std::printf("  %-44s %15s %18s %15s %17s\n", protocols::printable(row.name).c_str(),
                        percentWithError(row.these).c_str(), percentWithError(row.alike).c_str(),
                        percentWithError(row.reference).c_str(), percentWithError(row.alikeMinusReference).c_str());
    }
}

}  // namespace study::analyse
