// The time that an operator waits during a session, in the engine and in the window.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Rows for `vis2hap bench session`: an answer stored by the engine, the time from a key press until the next question is
/// drawn, a whole session through the window, and the memory that 10,000 trials take. Plays scripted participants in a
/// temporary study. Needs a QApplication.
std::vector<BenchRow> benchSession();

}  // namespace study::bench
