// Speed and error of the statistics that must be fast. R and packages of Python do the same work on the same machine, on one
// core.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// With `peers`, the rows also have the times of these programs.
std::vector<BenchRow> benchStatistics(bool peers);

}  // namespace study::bench
