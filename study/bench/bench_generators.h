// Speed, error and memory of the generators, as vis2hap-nn measures them.
#pragma once

#include <string>
#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// The rows of the answer to `vis2hap-nn bench --json`. Throws workFailed for another answer.
std::vector<BenchRow> rowsOfGenerators(const std::string& answer);

/// With `peers` also the networks in turns with the same networks elsewhere (generator_peer.h). Throws environmentFault where
/// vis2hap-nn cannot be started.
std::vector<BenchRow> benchGenerators(bool peers);

}  // namespace study::bench
