#include "reports/json/claims_json.h"

#include <nlohmann/json.hpp>

#include "reports/json/json_fields.h"

namespace reports {
namespace {

void putMean(Json& row, const stats::CrossedMean& mean)
{
    put(row, "estimate", mean.estimate);
    put(row, "se", mean.se);
    put(row, "df", mean.df);
    put(row, "ci90", mean.ci90);
    put(row, "ci95", mean.ci95);
}

Json leftOutRows(const std::vector<LeftOneOut>& list)
{
    Json rows = Json::array();
    for (const LeftOneOut& one : list) {
        Json row{{"without", one.leftOut}};
        put(row, "estimate", one.estimate);
        put(row, "ci90", one.ci90);
        row["verdict"] = stats::nameOf(one.verdict);
        putReasonsLast(row);
        rows.push_back(std::move(row));
    }
    return rows;
}

Json claimRow(const std::string& question, const std::vector<std::string>& fabrics, const QuestionClaims& claims,
              const ContrastFinding& finding)
{
    const stats::ContrastClaim& claim = finding.claim;
    Json row{{"question", question},
             {"a", finding.a},
             {"b", finding.b},
             {"primary", finding.primary},
             {"planned", finding.planned},
             {"generalises_to", nameOf(finding.generalisation)},
             {"n", claim.mean.values},
             {"participants", claim.mean.participants},
             {"fabrics", claim.mean.fabrics}};
    putMean(row, claim.mean);
    putP(row, "p", claim.difference.p, claim.difference.logP);
    putP(row, "p_adjusted", claim.pAdjusted);
    if (claims.bounds)
        row["bounds"] = {claims.bounds->first, claims.bounds->second};
    else
        putNull(row, "bounds", "the protocol states bounds for ratings only");
    putP(row, "p_equivalence", claim.equivalence.p, claim.equivalence.logP);
    putP(row, "p_equivalence_adjusted", claim.pEquivalenceAdjusted);
    row["verdict"] = stats::nameOf(claim.verdict);
    Json byFabric = Json::object();
    for (std::size_t f = 0; f < fabrics.size(); ++f) put(byFabric, fabrics[f], finding.byFabric[f]);
    row["by_fabric"] = std::move(byFabric);
    row["leave_one_fabric_out"] = leftOutRows(finding.withoutFabric);
    row["leave_one_participant_out"] = leftOutRows(finding.withoutParticipant);
    putReasonsLast(row);
    return row;
}

}  // namespace

void addOmnibus(const TakeRow& take, const std::string& question, const QuestionClaims& claims)
{
    for (const OmnibusFinding& finding : claims.omnibus) {
        Json row{{"question", question}, {"generalises_to", nameOf(finding.generalisation)}};
        put(row, "statistic", finding.test.f);
        putWhole(row, "df1", finding.test.df1);
        putWhole(row, "df2", finding.test.df2);
        putP(row, "p", finding.test.p, finding.test.logP);
        putReasonsLast(row);
        take(std::move(row));
    }
}

void addAboveChance(const TakeRow& take, const std::string& question, const QuestionClaims& claims)
{
    for (const ChanceFinding& finding : claims.aboveChance) {
        Json row{{"question", question}, {"condition", finding.condition}, {"generalises_to", nameOf(finding.generalisation)}};
        putMean(row, finding.claim.mean);
        putP(row, "p", finding.claim.above.p, finding.claim.above.logP);
        putP(row, "p_adjusted", finding.claim.pAdjusted);
        if (finding.claim.above.p.exists())
            row["above_chance"] = finding.claim.isAbove;
        else
            putNull(row, "above_chance", finding.claim.above.p.why());
        putReasonsLast(row);
        take(std::move(row));
    }
}

void addClaims(const TakeRow& take, const std::string& question, const std::vector<std::string>& fabrics,
               const QuestionClaims& claims)
{
    for (const ContrastFinding& finding : claims.contrasts) take(claimRow(question, fabrics, claims, finding));
}

}  // namespace reports
