// How fast drawn fabrics are made. Training draws every patch anew, so this bounds the speed of training.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Takes a few seconds on two threads.
std::vector<BenchRow> benchFabrics();

}  // namespace study::bench
