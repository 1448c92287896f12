// Statistics that can be had in several ways, on data whose truth is known: exact and approximate tests, models of one study,
// and a simulated finger whose force has a closed form.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Exact against approximate p, and standard errors and log odds of planted studies. Takes some seconds.
std::vector<BenchRow> benchModels();

/// The simulated finger at several sample rates, on a sine whose friction force is known. `vis2hap simulate` feels at 1,000 Hz.
std::vector<BenchRow> benchPerception();

}  // namespace study::bench
