// The table of the bench as one picture: a panel for each stage with a choice, time to the right and error upwards, both on
// logarithmic axes. The Pareto front is a line; the settings of the presets carry their letters F, B and A.
#pragma once

#include <string>
#include <vector>

#include "study/bench/bench_row.h"
#include "study/bench/cost_curves.h"

namespace study::bench {

/// A stage with at least two timed settings of one kind of error.
struct TradePanel {
    std::string stage, errorUnit;
    std::vector<BenchRow> rows;  ///< in the order of time
};
std::vector<TradePanel> tradePanels(const std::vector<BenchRow>& rows);

/// One <svg> element. `machine`: what the numbers were measured on. The curves follow the stages; there may be none.
std::string tradeSvg(const std::vector<BenchRow>& rows, const std::vector<CostCurve>& curves, const std::string& machine);

/// The panels in plain characters, at most `columns` wide.
std::string tradeInCharacters(const std::vector<BenchRow>& rows, std::size_t columns);

}  // namespace study::bench
