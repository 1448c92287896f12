#include "reports/json/results_json.h"

#include <nlohmann/json.hpp>

#include "protocols/files/whole_file.h"
#include "reports/json/claims_json.h"
#include "reports/json/json_fields.h"
#include "reports/json/plan_comparison_json.h"
#include "reports/json/signals_json.h"

namespace reports {
namespace {

const std::string schemaName = "vis2hap.results/";

Json studyPart(const StudyData& data)
{
    Json study{{"name", data.name}};
    if (data.protocolSha256.empty())
        putNull(study, "protocol_sha256", "the answers came without a protocol");
    else
        study["protocol_sha256"] = data.protocolSha256;
    study["participants"] = data.participants.size();
    study["fabrics"] = data.fabrics.size();
    study["blinded"] = data.blinded;
    study["simulated"] = data.simulated;
    putReasonsLast(study);
    return study;
}

Json conditionPart(const ConditionChoices& choices)
{
    Json part{{"trials", choices.count.trials}, {"correct", choices.count.correct}};
    put(part, "matches_per_rendering", choices.matchesPerRendering);
    put(part, "proportion", choices.againstChance.estimate);
    put(part, "ci95", choices.againstChance.wilson);
    putP(part, "p_chance", choices.againstChance.pGreater, choices.againstChance.logPGreater);
    putP(part, "p_chance_participants", choices.participantsAgainstChance.p, choices.participantsAgainstChance.logP);
    putReasonsLast(part);
    return part;
}

Json conditionPart(const ConditionRatings& ratings)
{
    Json part{{"n", ratings.ratings}};
    put(part, "mean", ratings.mean);
    put(part, "sd", ratings.sd);
    part["participants"] = ratings.participants;
    put(part, "ci95", ratings.ci95);
    putReasonsLast(part);
    return part;
}

Json conditionPart(const WordedCount& words) { return {{"answers", words.answers}, {"participants", words.participants}}; }

Json questionPart(const StudyData& data, const QuestionAnalysis& question)
{
    Json part = Json::object();
    std::visit(
        [&](const auto& findings) {
            for (std::size_t i = 0; i < data.conditions.size(); ++i)
                part[data.conditions[i]] = conditionPart(findings.conditions[i]);
        },
        question.findings);
    return part;
}

void putPlanned(Json& row, const ConditionPair& pair)
{
    if (pair.planned) row["planned"] = true;
    putReasonsLast(row);
}

Json comparisonRow(const std::string& question, const PairComparison& comparison)
{
    const stats::TTest& test = comparison.test;
    Json row{{"question", question}, {"a", comparison.pair.a}, {"b", comparison.pair.b}, {"test", "paired-t"}, {"n", test.n}};
    put(row, "statistic", test.t);
    putWhole(row, "df", test.df);
    putP(row, "p", test.p, test.logP);
    put(row, "p_holm", comparison.pHolm);
    put(row, "mean_difference", test.estimate);
    put(row, "ci95", test.ci);
    put(row, "d_z", test.dZ);
    row["generalises_to"] = "these_fabrics";
    putPlanned(row, comparison.pair);
    return row;
}

Json equivalenceRow(const std::string& question, const PairEquivalence& equivalence)
{
    const stats::EquivalenceTest& test = equivalence.test;
    Json row{{"question", question},
             {"a", equivalence.pair.a},
             {"b", equivalence.pair.b},
             {"bounds", {equivalence.low, equivalence.high}}};
    put(row, "p_lower", test.pLower);
    put(row, "p_upper", test.pUpper);
    put(row, "p", test.p);
    if (test.why.empty())
        row["equivalent"] = test.equivalent;
    else
        putNull(row, "equivalent", test.why);
    row["n"] = test.n;
    put(row, "mean_difference", test.estimate);
    put(row, "ci90", test.ci);
    row["verdict"] = equivalence.verdict;
    row["generalises_to"] = "these_fabrics";
    putPlanned(row, equivalence.pair);
    return row;
}

void putClaims(Json& results, const StudyAnalysis& analysis)
{
    Json omnibus = Json::array(), aboveChance = Json::array(), claims = Json::array();
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionClaims* of = claimsOf(question)) {
            addOmnibus(omnibus, question.question.id, *of);
            addAboveChance(aboveChance, question.question.id, *of);
            addClaims(claims, question.question.id, analysis.data.fabrics, *of);
        }
    results["omnibus"] = std::move(omnibus);
    results["above_chance"] = std::move(aboveChance);
    results["claims"] = std::move(claims);
}

/// The claims without the flagged participants.
void putWithoutFlagged(Json& results, const StudyAnalysis& analysis)
{
    const Screening& screening = analysis.screening;
    if (!analysis.withoutFlagged)
        return putNull(results, "without_flagged", screening.why.empty() ? "left out by --quick" : screening.why);
    Json part{{"excluded", Json::array()}, {"participants", screening.participantsAfter}};
    for (const ExcludedParticipant& one : screening.excluded) part["excluded"].push_back(one.participant);
    Json questions = Json::object();
    for (const QuestionAnalysis& question : analysis.withoutFlagged->questions)
        questions[question.question.id] = questionPart(analysis.data, question);
    part["questions"] = std::move(questions);
    putClaims(part, *analysis.withoutFlagged);
    results["without_flagged"] = std::move(part);
}

Json designPart(const StudyAnalysis& analysis)
{
    return {{"answers_per_cell", analysis.data.answersPerCell},
            {"groups", analysis.groups.groups},
            {"left_out", analysis.designLimits}};
}

Json speedPart(const StudyAnalysis& analysis)
{
    Json part = Json::object();
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        Json row = Json::object();
        put(row, "median_seconds", analysis.speed[i].medianSeconds);
        put(row, "bits_per_second", analysis.speed[i].bitsPerSecond);
        put(row, "bis", analysis.speed[i].balancedIntegrationScore);
        put(row, "bits_per_second_ci95", analysis.speed[i].bitsPerSecondCi95);
        put(row, "bis_ci95", analysis.speed[i].scoreCi95);
        putReasonsLast(row);
        part[analysis.data.conditions[i]] = std::move(row);
    }
    return part;
}

void putSignals(Json& results, const StudyData& data)
{
    if (data.blinded)
        putNull(results, "signals", "left out while the study is blinded");
    else if (!data.signals)
        putNull(results, "signals", "no generated and measured signals belong to these answers");
    else
        results["signals"] = signalsJson(*data.signals);
}

Json qualityPart(const std::vector<QualityFlag>& flags)
{
    Json rows = Json::array();
    for (const QualityFlag& flag : flags)
        rows.push_back({{"participant", flag.participant ? Json(*flag.participant) : Json(nullptr)},
                        {"flag", nameOf(flag.kind)},
                        {"why", flag.why}});
    return rows;
}

}  // namespace

nlohmann::ordered_json resultsJson(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    Json results{{"schema", schemaName + "2"}, {"study", studyPart(data)}, {"conditions", data.conditions}};
    // A question may carry any id, also that of another key of this file: all stand in an object of their own.
    Json questions = Json::object();
    Json comparisons = Json::array();
    Json equivalence = Json::array();
    for (const QuestionAnalysis& question : analysis.questions) {
        const std::string& id = question.question.id;
        questions[id] = questionPart(data, question);
        for (const PairComparison& comparison : comparisonsOf(question)) comparisons.push_back(comparisonRow(id, comparison));
        for (const PairEquivalence& test : equivalencesOf(question)) equivalence.push_back(equivalenceRow(id, test));
    }
    results["questions"] = std::move(questions);
    results["comparisons"] = std::move(comparisons);
    results["equivalence"] = std::move(equivalence);
    putClaims(results, analysis);
    results["speed_accuracy"] = speedPart(analysis);
    putSignals(results, data);
    results["quality"] = qualityPart(analysis.flags);
    results["preregistration"] = preregistrationJson(analysis);
    putWithoutFlagged(results, analysis);
    results["design"] = designPart(analysis);
    putReasonsLast(results);
    return results;
}

std::string resultsText(const StudyAnalysis& analysis) { return resultsJson(analysis).dump(2) + "\n"; }

bool isResultsFile(const std::filesystem::path& file)
{
    const Json results = Json::parse(protocols::readIfPossible(file).value_or(""), nullptr, false);
    return results.is_object() && results.contains("schema") && results["schema"].is_string() &&
           results["schema"].get<std::string>().starts_with(schemaName);
}

}  // namespace reports
