#include "reports/json/group_json.h"

#include <nlohmann/json.hpp>

#include "reports/json/json_fields.h"

namespace reports {
namespace {

Json groupTestRow(const std::vector<std::string>& groups, const GroupTest& test)
{
    Json row{{"participants", Json::object()}};
    for (std::size_t g = 0; g < groups.size(); ++g) row["participants"][groups[g]] = test.participants[g];
    Json means = Json::object();
    for (std::size_t g = 0; g < groups.size(); ++g) put(means, groups[g], test.means[g]);
    row["means"] = std::move(means);
    put(row, "difference", test.difference);
    put(row, "ci95", test.ci95);
    put(row, "statistic", test.f);
    putWhole(row, "df1", test.df1);
    putWhole(row, "df2", test.df2);
    putP(row, "p", test.p);
    putP(row, "p_adjusted", test.pHolm);
    row["generalises_to"] = "these_fabrics";
    if (!test.fabricsLeftOut.empty()) row["fabrics_left_out"] = test.fabricsLeftOut;
    putReasonsLast(row);
    return row;
}

}  // namespace

nlohmann::ordered_json groupsJson(const StudyAnalysis& analysis)
{
    const GroupAnalysis& groups = analysis.groups;
    Json part{{"participants", Json::object()}, {"questions", Json::object()}};
    for (std::size_t g = 0; g < groups.groups.size(); ++g) part["participants"][groups.groups[g]] = groups.participants[g];
    for (const GroupedQuestion& question : groups.questions) {
        Json& row = part["questions"][question.question];
        for (std::size_t g = 0; g < groups.groups.size(); ++g) {
            Json means = Json::object();
            for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c)
                put(means, analysis.data.conditions[c], question.means[g][c]);
            row["means"][groups.groups[g]] = std::move(means);
        }
        for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c)
            if (!question.fabricsLeftOut[c].empty())
                row["means_fabrics_left_out"][analysis.data.conditions[c]] = question.fabricsLeftOut[c];
        row["overall"] = groupTestRow(groups.groups, question.overall);
        row["contrasts"] = Json::array();
        for (const GroupContrast& contrast : question.contrasts) {
            Json one{{"a", contrast.a}, {"b", contrast.b}};
            one.update(groupTestRow(groups.groups, contrast.test));
            row["contrasts"].push_back(std::move(one));
        }
    }
    return part;
}

}  // namespace reports
