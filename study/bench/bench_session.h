// The time that an operator waits during a session, in the engine and in the window.
#pragma once

#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

/// Rows for `vis2hap bench session`: the time to store an answer in the engine, from a key press until the next question is
/// drawn, and of a whole session through the window. Also the memory that 10,000 trials take. Plays scripted participants in a
/// temporary study. With `peers` also the same rows committed by statements of SQLite alone, in turns. Needs a QApplication.
std::vector<BenchRow> benchSession(bool peers);

}  // namespace study::bench
