// Which branches of the instrumented sources have run. The compiler calls a function of coverage.cpp at each of them.
#pragma once

namespace fuzz {

/// True once for every first run of an edge between two branches since the last call.
bool hasNewCoverage();

}  // namespace fuzz
