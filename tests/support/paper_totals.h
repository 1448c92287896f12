// Ten scripted participants whose answers give the totals published in the paper. If the paper gives only an order or a
// difference, the total is chosen to agree with it and marked as chosen.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace support {

struct PaperTotal {
    std::string condition;
    int correct;            ///< correct matches out of 70; the paper prints correct / 7 with one decimal
    double ratings[3];      ///< mean ratings of Q2, Q3 and Q4
    bool correctPublished;  ///< false: chosen
    bool ratingsPublished;  ///< false: chosen
};

/// Totals in the order of the conditions.
const std::vector<PaperTotal>& paperTotals();

/// Scripts S01..S10 for a study of these seven fabrics.
std::vector<nlohmann::ordered_json> paperScripts(const std::vector<std::string>& fabrics);

}  // namespace support
