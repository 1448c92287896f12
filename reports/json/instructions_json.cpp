#include "reports/json/instructions_json.h"

#include <nlohmann/json.hpp>

#include "reports/json/speed_json.h"

namespace reports {
namespace {

Json instructedSpeedRow(const ConditionSpeed& speed)
{
    Json row = Json::object();
    put(row, "proportion", speed.share);
    put(row, "proportion_ci95", speed.shareCi95);
    put(row, "median_seconds", speed.medianSeconds);
    put(row, "median_seconds_ci95", speed.medianSecondsCi95);
    put(row, "bits_per_second", speed.bitsPerSecond);
    put(row, "bits_per_second_ci95", speed.bitsPerSecondCi95);
    put(row, "bis", speed.balancedIntegrationScore);
    put(row, "bis_ci95", speed.scoreCi95);
    return row;
}

Json instructedRow(const std::vector<std::string>& conditions, const InstructedSpeed& under)
{
    Json row{{"id", under.instruction.id}};
    if (!under.instruction.text.empty()) row["text"] = under.instruction.text;
    putWordings(row, under.instruction.wordings);
    if (under.instruction.deadlineSeconds) row["deadline_seconds"] = *under.instruction.deadlineSeconds;
    row["answers"] = under.answers;
    if (under.instruction.deadlineSeconds) {
        row["late"] = under.late;
        row["answers_with_known_time"] = under.timed;
    }
    row.update(instructedSpeedRow(under.speed));
    putReasonsLast(row);
    row["conditions"] = Json::object();
    for (std::size_t c = 0; c < conditions.size(); ++c) {
        Json own = instructedSpeedRow(under.conditions[c]);
        putReasonsLast(own);
        row["conditions"][conditions[c]] = std::move(own);
    }
    row["conditional_accuracy"] = accuracyBySpeedJson(conditions, under.accuracy);
    return row;
}

void addContrastRow(Json& rows, const InstructionContrast& contrast, const char* measure,
                    const stats::SpeedDifference& difference)
{
    Json row{{"a", contrast.a}, {"b", contrast.b}, {"measure", measure}, {"n", difference.test.n}};
    put(row, "estimate", difference.test.estimate);
    put(row, "ci95", difference.test.ci);
    put(row, "statistic", difference.test.t);
    putWhole(row, "df", difference.test.df);
    putP(row, "p", difference.test.p, difference.test.logP);
    putP(row, "p_holm", difference.pHolm);
    putReasonsLast(row);
    rows.push_back(std::move(row));
}

Json anovaJson(const stats::TwoWayAnova& anova)
{
    Json part{{"participants", anova.participants}, {"dropped", anova.dropped}};
    if (!anova.why.empty()) {
        putNull(part, "effects", anova.why);
        return part;
    }
    part["effects"] = Json::array();
    for (const stats::AnovaEffect& effect : anova.effects) {
        Json row{{"effect", effect.name}};
        put(row, "f", effect.f);
        putWhole(row, "df1", effect.df1);
        putWhole(row, "df2", effect.df2);
        putP(row, "p", effect.p, effect.logP);
        put(row, "epsilon_gg", effect.epsilonGg);
        putP(row, "p_gg", effect.pGg, effect.logPGg);
        put(row, "partial_eta_squared", effect.partialEtaSquared);
        putReasonsLast(row);
        part["effects"].push_back(std::move(row));
    }
    return part;
}

}  // namespace

Json instructionsJson(const std::vector<std::string>& conditions, const InstructionAnalysis& analysis)
{
    Json part{{"generalises_to", "these_fabrics"}};
    part["instructions"] = Json::array();
    for (const InstructedSpeed& under : analysis.instructions) part["instructions"].push_back(instructedRow(conditions, under));
    part["contrasts"] = Json::array();
    for (const InstructionContrast& contrast : analysis.contrasts) {
        addContrastRow(part["contrasts"], contrast, "proportion", contrast.share);
        addContrastRow(part["contrasts"], contrast, "bits_per_second", contrast.tests.bitsPerSecond);
        addContrastRow(part["contrasts"], contrast, "bis", contrast.tests.score);
        addContrastRow(part["contrasts"], contrast, "log_seconds", contrast.tests.logSeconds);
    }
    part["anova_proportion"] = anovaJson(analysis.shares);
    part["anova_log_seconds"] = anovaJson(analysis.logSeconds);
    return part;
}

void putWordings(Json& row, const std::vector<SentenceWording>& wordings)
{
    for (const SentenceWording& one : wordings)
        row["wordings"].push_back({{"text", one.text}, {"protocol_versions", one.versions}, {"participants", one.participants}});
}

}  // namespace reports
