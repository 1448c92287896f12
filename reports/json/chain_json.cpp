#include "reports/json/chain_json.h"

#include <nlohmann/json.hpp>

#include "reports/analysis/quality_chain.h"
#include "reports/json/json_fields.h"
#include "reports/json/prices_json.h"

namespace reports {

nlohmann::ordered_json chainMember(const StudyAnalysis& analysis)
{
    Json part = Json::object();
    const QualityChain chain = qualityChain(analysis);
    if (chain.rows.empty()) {
        putNull(part, "chain", "no condition of these answers carries a quality");
        return part;
    }
    part["chain"] = Json::array();
    for (const ChainRow& one : chain.rows) {
        Json row{{"condition", one.price.condition}, {"rendering", priceJson(one.price)}, {"questions", Json::object()}};
        row["rendering"].erase("condition");
        for (std::size_t q = 0; q < chain.questions.size(); ++q) {
            Json answer = Json::object();
            put(answer, chain.questions[q].isChoice ? "proportion" : "mean", one.answers[q].value);
            put(answer, "ci95", one.answers[q].ci95);
            putReasonsLast(answer);
            row["questions"][chain.questions[q].id] = std::move(answer);
        }
        put(row, "matches_per_rendering", one.matchesPerRendering);
        put(row, "bits_per_second", one.bitsPerSecond);
        put(row, "bits_per_second_ci95", one.bitsPerSecondCi95);
        putReasonsLast(row);
        part["chain"].push_back(std::move(row));
    }
    return part;
}

}  // namespace reports
