// The speed and the error of every signal stage that has a quality to choose, on surfaces and traces
// whose true values are known.
#pragma once

#include <string>
#include <vector>

namespace study::bench {

struct BenchRow {
    std::string stage;        ///< "integration 480x640"
    std::string quality;      ///< "full", "fast"
    double milliseconds = 0;  ///< median of several runs
    double error = 0;
    std::string errorUnit;  ///< what `error` is: "% of Sq"
    std::string note;
};

/// A few seconds of work, one thread of ours.
std::vector<BenchRow> benchSignals();

}  // namespace study::bench
