// Which settings the rule of rendering/models/preset.h would choose from a measured table, beside the shipped ones.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Settings of one stage in the order fast, balanced, accurate.
struct StageChoice {
    std::string stage;
    std::array<std::string, 3> shipped;
    std::array<std::optional<BenchRow>, 3> byRule;  ///< none where the stage was not measured

    bool agrees() const;
};

/// The setting that the rule chooses for a limit of the error, `most` times the least one. None where nothing was measured.
std::optional<BenchRow> cheapestWithin(const std::vector<BenchRow>& rows, const std::string& stage, double most);

/// The setting with the least error, within `accurateMost`, among those of at most `mostMs`. None where there is none.
std::optional<BenchRow> bestFor(const std::vector<BenchRow>& rows, const std::string& stage, double mostMs);

/// Every stage that a preset fixes. Two stages stand for both kinds of networks: a preset is chosen as a whole there.
std::vector<StageChoice> presetChoices(const std::vector<BenchRow>& rows);

/// The rule in words, and each stage with what is shipped, what the rule chooses here, and what each preset gives up.
std::string choiceText(const std::vector<BenchRow>& rows);

}  // namespace study::bench
