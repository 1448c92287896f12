// The stages of `vis2hap bench`, by name.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/bench/bench_row.h"

namespace study::bench {

struct BenchOptions {
    bool peers = false;                                    ///< also times other programs on the same work
    std::filesystem::path recordings;                      ///< folder for the stage "signals"; empty: no recordings
    std::function<void(const std::string& line)> skipped;  ///< gets each part that the folder lacks
    std::function<void(const std::string& part)> begins;   ///< gets the name of each part of the work before it begins
};

/// "signals", "perception", "fabrics", "statistics", "session" and "generators", in the order of a whole run.
const std::vector<std::string>& benchStages();

/// Throws badInput where there is no such folder. It is for the beginning, because the first row takes seconds.
void requireRecordings(const std::filesystem::path& folder);

/// The rows of one stage. "session" needs a QApplication.
std::vector<BenchRow> benchStage(const std::string& stage, const BenchOptions& options);

}  // namespace study::bench
