#include <cctype>
#include <map>
#include <set>

#include "reports/json/statistic_parts.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

Json anovaPart(const stats::RepeatedMeasuresAnova& anova)
{
    Json part = Json::object();
    put(part, "F", anova.f);
    putWhole(part, "df1", anova.df1);
    putWhole(part, "df2", anova.df2);
    putP(part, "p", anova.p, anova.logP);
    put(part, "eps_gg", anova.epsilonGg);
    putP(part, "p_gg", anova.pGg, anova.logPGg);
    put(part, "eps_hf", anova.epsilonHf);
    put(part, "p_hf", anova.pHf);
    put(part, "pes", anova.partialEtaSquared);
    part["n"] = anova.blocks;
    return part;
}

Json friedmanPart(const stats::FriedmanTest& test)
{
    Json part = Json::object();
    put(part, "Q", test.q);
    putWhole(part, "df", test.df);
    putP(part, "p", test.p, test.logP);
    put(part, "kendall_w", test.kendallW);
    put(part, "iman_davenport_F", test.imanDavenportF);
    put(part, "iman_davenport_p", test.fP);
    part["n"] = test.blocks;
    return part;
}

Json iccPart(const stats::RepeatedMeasuresAnova& anova)
{
    Json part = Json::object();
    put(part, "ICC2", anova.icc2);
    put(part, "ICC2k", anova.icc2k);
    put(part, "ICC3", anova.icc3);
    put(part, "ICC3k", anova.icc3k);
    return part;
}

Json pairwisePart(const StudyData& data, const Cells& cells, const std::string& question)
{
    std::vector<stats::TTest> tests;
    std::vector<stats::Value> p;
    Json rows = Json::array();
    for (std::size_t a = 0; a < data.conditions.size(); ++a)
        for (std::size_t b = a + 1; b < data.conditions.size(); ++b) {
            const Cells::Pairs pairs = cells.pairs(question, data.conditions[a], data.conditions[b]);
            tests.push_back(stats::pairedTTest(pairs.a, pairs.b));
            p.push_back(tests.back().p);
            rows.push_back({{"a", data.conditions[a]}, {"b", data.conditions[b]}});
        }
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t i = 0; i < tests.size(); ++i) {
        put(rows[i], "diff", tests[i].estimate);
        put(rows[i], "t", tests[i].t);
        putWhole(rows[i], "df", tests[i].df);
        putP(rows[i], "p", tests[i].p, tests[i].logP);
        put(rows[i], "p_holm", holm[i]);
        rows[i]["n"] = tests[i].n;
    }
    return rows;
}

/// "hgfg" of "h_g&f_g" (and of "hg_fg"), unless two conditions would then share a name.
std::map<std::string, std::string> shortNames(const std::vector<std::string>& conditions)
{
    std::map<std::string, std::string> names;
    std::set<std::string> taken;
    for (const std::string& condition : conditions) {
        std::string name;
        for (const char c : condition)
            if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
        names[condition] = name.empty() || !taken.insert(name).second ? condition : name;
    }
    return names;
}

Json tostPart(const StudyData& data, const Cells& cells, const std::string& question, const std::string& a, const std::string& b)
{
    const Cells::Pairs pairs = cells.pairs(question, a, b);
    const auto [low, high] = data.equivalenceBounds;
    const auto test = stats::equivalenceTest(stats::TKind::Paired, pairs.a, pairs.b, {.low = low, .high = high});
    Json part{{"bounds", {low, high}}};
    put(part, "estimate", test.estimate);
    put(part, "t_lower", test.tLower);
    put(part, "p_lower", test.pLower);
    put(part, "t_upper", test.tUpper);
    put(part, "p_upper", test.pUpper);
    put(part, "p_tost", test.p);
    put(part, "ci90", test.ci);
    put(part, "nhst_p", test.pDifference);
    put(part, "dz", test.dZ);
    part["n"] = test.n;
    return part;
}

/// Means of all participants, null where one has no answer under a condition.
Json meanTable(const StudyData& data, const Cells& cells, const std::string& question)
{
    Json table = Json::array();
    for (const std::string& participant : cells.participants()) {
        Json row{{"participant", participant}, {"means", Json::array()}};
        std::string unanswered;
        for (const std::string& condition : data.conditions) {
            const stats::Value mean = cells.participantMean(question, condition, participant);
            row["means"].push_back(mean.exists() ? Json(*mean) : Json(nullptr));
            if (!mean.exists()) unanswered += (unanswered.empty() ? "" : ", ") + condition;
        }
        if (!unanswered.empty()) row["why"]["means"] = "no answers under " + unanswered;
        table.push_back(std::move(row));
    }
    return table;
}

}  // namespace

Json ratingStatistics(const StudyData& data, const Cells& cells, const std::string& question)
{
    Json part{{"cell_mean", Json::object()}, {"n_ratings", Json::object()}};
    for (const std::string& condition : data.conditions) {
        const auto ratings = valuesOf(cells.of(question, condition));
        put(part["cell_mean"], condition, stats::meanOf(ratings));
        part["n_ratings"][condition] = ratings.size();
    }
    const Cells::CompleteBlocks blocks = cells.completeBlocks(question, data.conditions);
    part["participants_complete"] = blocks.participants;
    part["participant_mean_table"] = meanTable(data, cells, question);
    const stats::RepeatedMeasuresAnova anova = stats::repeatedMeasuresAnova(blocks.table);
    Json widths = Json::object();
    for (std::size_t i = 0; i < data.conditions.size(); ++i) put(widths, data.conditions[i], anova.moreyHalfWidths[i]);
    part["morey95_halfwidth"] = std::move(widths);
    part["rm_anova"] = anovaPart(anova);
    part["friedman"] = friedmanPart(stats::friedmanTest(blocks.table));
    part["lmm"] = ratingModelPart(data, cells, question);
    part["pairwise_t_participant_means"] = pairwisePart(data, cells, question);
    const auto names = shortNames(data.conditions);
    for (std::size_t a = 0; a < data.conditions.size(); ++a)
        for (std::size_t b = a + 1; b < data.conditions.size(); ++b)
            part["tost_" + names.at(data.conditions[a]) + "_vs_" + names.at(data.conditions[b]) + "_participant"] =
                tostPart(data, cells, question, data.conditions[a], data.conditions[b]);
    part["icc_conditions_by_participants"] = iccPart(anova);
    return part;
}

}  // namespace reports
