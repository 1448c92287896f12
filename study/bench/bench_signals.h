// Speed and error of every signal stage that has a choice of quality, on surfaces and traces whose true values are known.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Takes a few seconds on one thread.
std::vector<BenchRow> benchSignals();

/// RMS height about the mean of the weave of "integration 480x640", from its formula.
double knownWeaveSqMm();

}  // namespace study::bench
