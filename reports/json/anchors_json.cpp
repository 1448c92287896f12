#include "reports/json/anchors_json.h"

#include <nlohmann/json.hpp>

#include "reports/json/json_fields.h"

namespace reports {
namespace {

void putEstimate(Json& row, const std::string& key, const stats::Estimate& estimate)
{
    put(row, key, estimate.value);
    put(row, key + "_ci95", estimate.ci95);
}

Json floorRow(const AnchorFloor& floor)
{
    Json row{{"n", floor.ratings}};
    put(row, "mean", floor.mean);
    put(row, "sd", floor.sd);
    row["participants"] = floor.participants;
    put(row, "ci95", floor.ci95);
    put(row, "mean_of_participants", floor.meanOfParticipants);
    if (floor.conditions.size() == 1) {
        row["condition"] = floor.conditions.front();
    } else {
        putNull(row, "condition", "images of several conditions were mismatched");
        row["conditions"] = floor.conditions;
    }
    row["lowest_condition"] = floor.lowest;
    put(row, "lowest_mean", floor.lowestMean);
    put(row, "share_above_lowest", floor.shareAbove);
    row["conditions_not_above"] = floor.notAbove;
    putReasonsLast(row);
    return row;
}

Json biasRow(const stats::RatingReliability& ratings, const std::pair<double, double>& bounds)
{
    Json row{{"n", ratings.bias.n}};
    put(row, "mean_difference", ratings.bias.estimate);
    put(row, "ci95", ratings.bias.ci);
    putP(row, "p", ratings.bias.p, ratings.bias.logP);
    row["bounds"] = {bounds.first, bounds.second};
    const stats::EquivalenceTest& test = ratings.biasEquivalence;
    putP(row, "p_equivalence", test.p, test.logP);
    put(row, "ci90", test.ci);
    if (test.why.empty())
        row["equivalent"] = test.equivalent;
    else
        putNull(row, "equivalent", test.why);
    put(row, "limits_of_agreement", ratings.limitsOfAgreement);
    putReasonsLast(row);
    return row;
}

Json repeatedRow(const stats::RatingReliability& ratings, const std::pair<double, double>& bounds)
{
    Json row{{"pairs", ratings.pairs}, {"participants", ratings.participants}};
    putEstimate(row, "icc", ratings.icc);
    putEstimate(row, "within_sd", ratings.withinSd);
    row["bias"] = biasRow(ratings, bounds);
    putEstimate(row, "ceiling_of_correlation", ratings.correlationCeiling);
    putEstimate(row, "ceiling_of_mean", ratings.meanCeiling);
    putReasonsLast(row);
    return row;
}

std::string comparedName(stats::ChoicesCompared compared)
{
    switch (compared) {
        case stats::ChoicesCompared::Outcomes:
            return "right and wrong";
        case stats::ChoicesCompared::Words:
            return "words";
        case stats::ChoicesCompared::Answers:
            break;
    }
    return "answers";
}

Json repeatedRow(const stats::ChoiceReliability& choices, stats::ChoicesCompared compared, int alternatives)
{
    Json row{{"pairs", choices.pairs},
             {"participants", choices.participants},
             {"alternatives", alternatives},
             {"compared", comparedName(compared)},
             {"agreeing", choices.agreeing}};
    if (compared == stats::ChoicesCompared::Outcomes) row["both_wrong"] = choices.bothWrong;
    putEstimate(row, "agreement", choices.agreement);
    putEstimate(row, "kappa", choices.kappa);
    putEstimate(row, "ceiling_of_proportion", choices.shareCeiling);
    putReasonsLast(row);
    return row;
}

}  // namespace

nlohmann::ordered_json anchorsMember(const StudyAnalysis& analysis)
{
    Json part = Json::object();
    if (analysis.anchors.empty()) return part;
    part["anchors"] = Json::array();
    for (const QuestionAnchors& anchors : analysis.anchors) {
        Json row{{"question", anchors.question}};
        if (anchors.floor) row["mismatched"] = floorRow(*anchors.floor);
        if (anchors.ratings) row["repeated"] = repeatedRow(*anchors.ratings, analysis.data.equivalenceBounds);
        if (anchors.choices) row["repeated"] = repeatedRow(*anchors.choices, anchors.compared, anchors.alternatives);
        if (!anchors.noPairs.empty()) putNull(row, "repeated", anchors.noPairs);
        part["anchors"].push_back(std::move(row));
    }
    return part;
}

}  // namespace reports
