#include "study/bench/preset_choice.h"

#include <algorithm>
#include <cstdio>
#include <functional>

#include "protocols/files/number_text.h"
#include "rendering/models/preset.h"

namespace study::bench {

namespace {

using rendering::models::Preset;

/// A stage that presets fix, the names of its settings in the table, and which of them a preset has.
struct PresetStage {
    const char* stage;
    std::vector<std::string> settings;  ///< from which the rule chooses
    std::function<std::string(const Preset&)> of;
};

const std::vector<PresetStage>& presetStages()
{
    using rendering::signals::IntegrationQuality, rendering::signals::ShadingQuality;
    static const std::vector<PresetStage> all{
        {"integration 480x640",
         {"fast", "full"},
         [](const Preset& preset) { return preset.integration == IntegrationQuality::Fast ? "fast" : "full"; }},
        {"shape from shading 512x512",
         {"fast", "accurate"},
         [](const Preset& preset) { return preset.shading == ShadingQuality::Fast ? "fast" : "accurate"; }},
        {"spectrogram inversion",
         {},
         [](const Preset& preset) { return std::to_string(preset.phaseIterations) + " iterations"; }},
        {"photograph to relief", {}, [](const Preset& preset) { return std::string(preset.name); }}};
    return all;
}

bool isCandidate(const BenchRow& row, const PresetStage& stage)
{
    return row.stage == stage.stage && row.milliseconds && row.error &&
           (stage.settings.empty() ||
            std::find(stage.settings.begin(), stage.settings.end(), row.quality) != stage.settings.end());
}

std::string sameOr(const std::optional<BenchRow>& chosen, const std::string& shipped)
{
    if (!chosen) return "not measured";
    char text[120];
    std::snprintf(text, sizeof text, "%s%s (%.3g ms, error %.3g)", chosen->quality.c_str(),
                  chosen->quality == shipped ? ", as shipped" : "", *chosen->milliseconds, *chosen->error);
    return text;
}

}  // namespace

bool StageChoice::agrees() const
{
    for (std::size_t i = 0; i < shipped.size(); ++i)
        if (byRule[i] && byRule[i]->quality != shipped[i]) return false;
    return true;
}

std::optional<BenchRow> cheapestWithin(const std::vector<BenchRow>& rows, const std::string& stage, double most)
{
    std::optional<double> least;
    for (const BenchRow& row : rows)
        if (row.stage == stage && row.milliseconds && row.error) least = std::min(least.value_or(*row.error), *row.error);
    std::optional<BenchRow> best;
    for (const BenchRow& row : rows)
        if (row.stage == stage && row.milliseconds && row.error && *row.error <= most * *least &&
            (!best || *row.milliseconds < *best->milliseconds))
            best = row;
    return best;
}

std::optional<BenchRow> bestFor(const std::vector<BenchRow>& rows, const std::string& stage, double mostMs)
{
    std::vector<BenchRow> affordable;
    for (const BenchRow& row : rows)
        if (row.milliseconds && *row.milliseconds <= mostMs) affordable.push_back(row);
    return cheapestWithin(affordable, stage, rendering::models::accurateMost);
}

std::vector<StageChoice> presetChoices(const std::vector<BenchRow>& rows)
{
    std::vector<StageChoice> choices;
    for (const PresetStage& stage : presetStages()) {
        std::vector<BenchRow> candidates;
        for (const BenchRow& row : rows)
            if (isCandidate(row, stage)) candidates.push_back(row);
        StageChoice choice{stage.stage, {}, {}};
        for (std::size_t i = 0; i < choice.shipped.size(); ++i) choice.shipped[i] = stage.of(rendering::models::presets[i]);
        auto& [fast, balanced, accurate] = choice.byRule;
        fast = cheapestWithin(candidates, stage.stage, rendering::models::fastMost);
        if (fast) balanced = bestFor(candidates, stage.stage, rendering::models::balancedPrice * *fast->milliseconds);
        accurate = cheapestWithin(candidates, stage.stage, rendering::models::accurateMost);
        choices.push_back(choice);
    }
    return choices;
}

std::string choiceText(const std::vector<BenchRow>& rows)
{
    using rendering::models::accurateMost, rendering::models::balancedPrice, rendering::models::fastMost;
    std::string text = "Rule: accurate is the cheapest setting of a stage with at most " + protocols::shortest(accurateMost) +
                       " times the least error,\nfast the cheapest with at most " + protocols::shortest(fastMost) +
                       " times. balanced has the least error for at most " + protocols::shortest(balancedPrice) +
                       " times the time of fast.\n";
    for (const StageChoice& choice : presetChoices(rows)) {
        text += "\n" + choice.stage + "\n";
        for (std::size_t i = choice.shipped.size(); i-- > 0;) {
            char line[240];
            std::snprintf(line, sizeof line, "  %-9s shipped: %-16s the rule here: %s\n", rendering::models::presets[i].name,
                          choice.shipped[i].c_str(), sameOr(choice.byRule[i], choice.shipped[i]).c_str());
            text += line;
        }
    }
    return text + "\nNothing was changed: images do not depend on the machine.\n";
}

}  // namespace study::bench
