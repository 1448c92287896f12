// One line of the bench's table.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace study::bench {

/// Quartiles of the runs, ms.
struct Quartiles {
    double low = 0, high = 0;
};

/// A promise about the ratio of our time to another program's.
struct RatioPromise {
    std::string peer;
    double most = 1;              ///< our time over theirs, at most
    std::optional<double> ratio;  ///< measured in this run; none where the peer is not installed

    bool isMet() const { return ratio && *ratio <= most; }
};

struct BenchRow {
    std::string stage;                   ///< "integration 480x640"
    std::string quality;                 ///< the setting: "full", "32 iterations"
    std::optional<double> milliseconds;  ///< median of several runs
    std::optional<double> error;
    std::string errorUnit;  ///< meaning of `error`: "% of Sq"
    std::string note;
    std::map<std::string, std::optional<double>> peers = {};  ///< milliseconds of other programs; none where not installed
    std::optional<Quartiles> quartiles = {};
    std::optional<double> megabytes = {};            ///< memory that one run takes beyond what was held before it
    bool onFront = false;                            ///< no other setting of the stage is as fast and as exact
    std::map<std::string, double> peersDiffer = {};  ///< difference of a peer's answer from ours, relative
    std::optional<RatioPromise> promise = {};
};

/// Marks the rows of each stage that lie on its Pareto front of time and error. Stages with one timed setting have none.
void markFronts(std::vector<BenchRow>& rows);

/// Half the distance of the quartiles over the median, in percent: median over the rows. None where no row was repeated.
std::optional<double> spreadPercent(const std::vector<BenchRow>& rows);

nlohmann::ordered_json jsonOf(const BenchRow& row);

/// The rows as lines of text with a head.
std::string tableOf(const std::vector<BenchRow>& rows);

}  // namespace study::bench
