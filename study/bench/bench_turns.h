// The settings of a stage, timed in turns: each round runs every setting once, and the next round begins with another. So load
// that comes and goes on the machine meets all settings alike.
#pragma once

#include <functional>
#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// A setting of a stage. `row` names stage, setting, unit of the error and note; time, quartiles, memory and error are measured.
struct TimedSetting {
    BenchRow row;
    std::function<void()> work;
    std::function<double()> error;  ///< of the latest run; empty where `row` has it already
};

struct Rounds {
    int most = 21;
    double wantedMs = 1500;  ///< rounds end at about this time, but not before `least`
    int least = 3;
};

/// Runs each setting once for its memory and its error, then in turns. Returns the rows with the Pareto front marked.
std::vector<BenchRow> benchInTurns(const std::vector<TimedSetting>& settings, const Rounds& rounds = {});

/// Runs `work` once. Largest resident memory meanwhile, less that before; MB. None where the system does not reset its count.
std::optional<double> megabytesOf(const std::function<void()>& work);

}  // namespace study::bench
