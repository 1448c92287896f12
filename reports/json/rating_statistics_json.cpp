#include "reports/json/rating_statistics_json.h"

#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "reports/json/model_json.h"

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
    putP(part, "p_hf", anova.pHf, anova.logPHf);
    put(part, "pes", anova.partialEtaSquared);
    part["n"] = anova.blocks;
    part["generalises_to"] = "these_fabrics";
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
    part["generalises_to"] = "these_fabrics";
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

Json comparisonsPart(const std::vector<PairComparison>& comparisons)
{
    Json rows = Json::array();
    for (const PairComparison& comparison : comparisons) {
        Json row{{"a", comparison.pair.a}, {"b", comparison.pair.b}};
        put(row, "diff", comparison.test.estimate);
        put(row, "t", comparison.test.t);
        putWhole(row, "df", comparison.test.df);
        putP(row, "p", comparison.test.p, comparison.test.logP);
        putP(row, "p_holm", comparison.pHolm);
        row["n"] = comparison.test.n;
        row["generalises_to"] = "these_fabrics";
        rows.push_back(std::move(row));
    }
    return rows;
}

/// "hgfg" for "h_g&f_g" (and for "hg_fg"), unless two conditions would then share a name.
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

Json equivalencePart(const PairEquivalence& equivalence)
{
    const stats::EquivalenceTest& test = equivalence.test;
    Json part{{"bounds", {equivalence.low, equivalence.high}}};
    put(part, "estimate", test.estimate);
    put(part, "t_lower", test.tLower);
    putP(part, "p_lower", test.pLower, test.logPLower);
    put(part, "t_upper", test.tUpper);
    putP(part, "p_upper", test.pUpper, test.logPUpper);
    putP(part, "p_tost", test.p, test.logP);
    put(part, "ci90", test.ci);
    putP(part, "nhst_p", test.pDifference, test.logPDifference);
    put(part, "dz", test.dZ);
    part["n"] = test.n;
    part["generalises_to"] = "these_fabrics";
    return part;
}

void putEquivalences(Json& part, const StudyData& data, const std::vector<PairEquivalence>& equivalences)
{
    const auto names = shortNames(data.conditions);
    for (const PairEquivalence& equivalence : equivalences)
        part["tost_" + names.at(equivalence.pair.a) + "_vs_" + names.at(equivalence.pair.b) + "_participant"] =
            equivalencePart(equivalence);
}

/// Means of all participants; null where one has no answer under a condition.
Json meanTable(const StudyData& data, const RatingAnalysis& ratings)
{
    Json table = Json::array();
    for (const ParticipantMeans& one : ratings.participants) {
        Json row{{"participant", one.participant}, {"means", Json::array()}};
        std::string unanswered;
        for (std::size_t i = 0; i < data.conditions.size(); ++i) {
            const stats::Value& mean = one.means[i];
            row["means"].push_back(mean.exists() ? Json(*mean) : Json(nullptr));
            if (!mean.exists()) unanswered += (unanswered.empty() ? "" : ", ") + data.conditions[i];
        }
        if (!unanswered.empty()) row["why"]["means"] = "no answers under " + unanswered;
        table.push_back(std::move(row));
    }
    return table;
}

/// Where answers are missing, the names of the reference keep the reference's means over all fabrics that are answered. The tests
/// of page, tables and results.json then stand here.
Json commonFabricsPart(const StudyData& data, const RatingAnalysis& ratings)
{
    Json part{{"participants_complete", ratings.completeParticipants}, {"morey95_halfwidth", Json::object()}};
    for (std::size_t i = 0; i < data.conditions.size(); ++i)
        put(part["morey95_halfwidth"], data.conditions[i], ratings.conditions[i].withinHalfWidth);
    part["rm_anova"] = anovaPart(ratings.anova);
    part["friedman"] = friedmanPart(ratings.friedman);
    part["pairwise_t_participant_means"] = comparisonsPart(ratings.comparisons);
    putEquivalences(part, data, ratings.equivalences);
    part["icc_conditions_by_participants"] = iccPart(ratings.anova);
    return part;
}

}  // namespace

Json ratingStatistics(const StudyData& data, const RatingAnalysis& ratings)
{
    Json part{{"cell_mean", Json::object()}, {"n_ratings", Json::object()}};
    Json widths = Json::object();
    const auto& over = ratings.overAnswered;
    const stats::RepeatedMeasuresAnova& anova = over ? over->anova : ratings.anova;
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        put(part["cell_mean"], data.conditions[i], ratings.conditions[i].mean);
        part["n_ratings"][data.conditions[i]] = ratings.conditions[i].ratings;
        put(widths, data.conditions[i], anova.moreyHalfWidths[i]);
    }
    part["participants_complete"] = over ? over->completeParticipants : ratings.completeParticipants;
    part["participant_mean_table"] = meanTable(data, ratings);
    part["morey95_halfwidth"] = std::move(widths);
    part["rm_anova"] = anovaPart(anova);
    part["friedman"] = friedmanPart(over ? over->friedman : ratings.friedman);
    part["lmm"] = ratingModelJson(ratings.model);
    putGeneralisation(part["lmm"], ratings.model.leftOut);
    part["pairwise_t_participant_means"] = comparisonsPart(over ? over->comparisons : ratings.comparisons);
    putEquivalences(part, data, over ? over->equivalences : ratings.equivalences);
    part["icc_conditions_by_participants"] = iccPart(anova);
    if (over) part["on_common_fabrics"] = commonFabricsPart(data, ratings);
    return part;
}

}  // namespace reports
