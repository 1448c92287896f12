// Ten scripted participants whose answers add up to the totals that the paper publishes. Where the
// paper gives only an order or a difference, the total is chosen to agree with it and marked so.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace support {

struct PaperTotal {
    std::string condition;
    int correct;            ///< of 70 matches; the paper prints correct / 7 with one decimal
    double ratings[3];      ///< mean of Q2, Q3, Q4
    bool correctPublished;  ///< else chosen
    bool ratingsPublished;  ///< else chosen
};

/// In the order of the conditions.
const std::vector<PaperTotal>& paperTotals();

/// Scripts S01..S10 for a study of these seven fabrics.
std::vector<nlohmann::ordered_json> paperScripts(const std::vector<std::string>& fabrics);

}  // namespace support
