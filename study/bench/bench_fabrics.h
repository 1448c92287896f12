// How fast drawn fabrics are made, and how much of their friction a photograph must show. Training draws every patch anew, so
// the speed bounds that of training.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Patches by one and two threads; then the error of the mean friction of drawn fabrics where fibre, relief, both or none of
/// them are known. Takes ten seconds on two threads.
std::vector<BenchRow> benchFabrics();

}  // namespace study::bench
