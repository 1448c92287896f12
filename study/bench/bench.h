// Speed and error of every signal stage that has a choice of quality, on surfaces and traces whose true values are known.
#pragma once

#include <string>
#include <vector>

namespace study::bench {

struct BenchRow {
    std::string stage;        ///< "integration 480x640"
    std::string quality;      ///< "full", "fast"
    double milliseconds = 0;  ///< median of several runs
    double error = 0;
    std::string errorUnit;  ///< meaning of `error`: "% of Sq"
    std::string note;
};

/// Takes a few seconds on one thread.
std::vector<BenchRow> benchSignals();

}  // namespace study::bench
