// Speed and error of the statistics that must be fast, on one core, beside the times of R and packages of Python for the same
// work on this machine.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// With `peers` also their times.
std::vector<BenchRow> benchStatistics(bool peers);

}  // namespace study::bench
