// One line of the bench's table.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace study::bench {

struct BenchRow {
    std::string stage;                   ///< "integration 480x640"
    std::string quality;                 ///< "full", "fast"
    std::optional<double> milliseconds;  ///< median of several runs
    std::optional<double> error;
    std::string errorUnit;  ///< meaning of `error`: "% of Sq"
    std::string note;
    std::map<std::string, std::optional<double>> peers = {};  ///< milliseconds of other programs; none where not installed
};

nlohmann::ordered_json jsonOf(const BenchRow& row);

/// The rows as lines of text with a head.
std::string tableOf(const std::vector<BenchRow>& rows);

}  // namespace study::bench
