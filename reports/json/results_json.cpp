#include "reports/json/results_json.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "reports/json/anchors_json.h"
#include "reports/json/chain_json.h"
#include "reports/json/claims_json.h"
#include "reports/json/json_fields.h"
#include "reports/json/plan_comparison_json.h"
#include "reports/json/signals_json.h"
#include "reports/json/touch_json.h"

namespace reports {
namespace {

const std::string schemaName = "vis2hap.results/";

Json studyPart(const StudyData& data, const ReportOrigin& origin)
{
    Json study{{"name", data.name}};
    if (data.protocolSha256.empty())
        putNull(study, "protocol_sha256", "the answers came without a protocol");
    else
        study["protocol_sha256"] = data.protocolSha256;
    for (const FollowedVersion& one : data.protocolVersions)
        study["protocol_versions"].push_back(
            {{"version", one.version}, {"sha256", one.sha256}, {"participants", one.participants}});
    study["participants"] = answeringParticipants(data);
    study["fabrics"] = data.fabrics.size();
    study["blinded"] = data.blinded;
    study["simulated"] = data.simulated;
    study["scripted"] = data.scripted;
    if (!data.knowsKinds)
        for (const char* kind : {"simulated", "scripted"}) putNull(study, kind, kindsUnknown);
    if (!origin.logHead.empty()) study["log_head"] = origin.logHead;
    if (Json made = protocols::storedOrderedJson(origin.madeWith); made.is_object()) study["made_with"] = std::move(made);
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
    put(part, "mean_of_participants", ratings.meanOfParticipants);
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
    putP(row, "p_holm", comparison.pHolm);
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
    putP(row, "p_lower", test.pLower, test.logPLower);
    putP(row, "p_upper", test.pUpper, test.logPUpper);
    putP(row, "p", test.p, test.logP);
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

/// "omnibus", "above_chance" and "claims".
JsonParts claimMembers(const StudyAnalysis& analysis)
{
    const auto rowsOf = [&analysis](const auto& add) -> MakeRows {
        return [&analysis, add](const TakeRow& take) {
            for (const QuestionAnalysis& question : analysis.questions)
                if (const QuestionClaims* claims = claimsOf(question)) add(take, question.question.id, *claims);
        };
    };
    const auto addFamily = [&analysis](const TakeRow& take, const std::string& id, const QuestionClaims& claims) {
        addClaims(take, id, analysis.data.fabrics, claims);
    };
    return {JsonMember{"omnibus", rowsOf(addOmnibus)}, JsonMember{"above_chance", rowsOf(addAboveChance)},
            JsonMember{"claims", rowsOf(addFamily)}};
}

/// The claims without the flagged participants.
Json withoutFlaggedPart(const StudyAnalysis& analysis)
{
    const Screening& screening = analysis.screening;
    Json part{{"excluded", Json::array()}, {"participants", screening.participantsAfter}};
    for (const ExcludedParticipant& one : screening.excluded) part["excluded"].push_back(one.participant);
    Json questions = Json::object();
    for (const QuestionAnalysis& question : analysis.withoutFlagged->questions)
        questions[question.question.id] = questionPart(analysis.data, question);
    part["questions"] = std::move(questions);
    const Json claims = objectOf(claimMembers(*analysis.withoutFlagged));
    for (const auto& [key, rows] : claims.items()) part[key] = rows;
    return part;
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
        put(row, "median_seconds_ci95", analysis.speed[i].medianSecondsCi95);
        putReasonsLast(row);
        part[analysis.data.conditions[i]] = std::move(row);
    }
    return part;
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

// A question may carry any id, also that of another key of this file: all stand in an object of their own.
Json questionsPart(const StudyAnalysis& analysis)
{
    Json questions = Json::object();
    for (const QuestionAnalysis& question : analysis.questions)
        questions[question.question.id] = questionPart(analysis.data, question);
    return questions;
}

void addComparisons(const TakeRow& take, const StudyAnalysis& analysis)
{
    for (const QuestionAnalysis& question : analysis.questions)
        for (const PairComparison& comparison : comparisonsOf(question)) take(comparisonRow(question.question.id, comparison));
}

void addEquivalences(const TakeRow& take, const StudyAnalysis& analysis)
{
    for (const QuestionAnalysis& question : analysis.questions)
        for (const PairEquivalence& test : equivalencesOf(question)) take(equivalenceRow(question.question.id, test));
}

/// null, or the signals.
Json signalsMember(const StudyData& data)
{
    Json part = Json::object();
    if (!data.signals)
        putNull(part, "signals", "no generated and measured signals belong to these answers");
    else
        part["signals"] = signalsJson(*data.signals);
    return part;
}

Json withoutFlaggedMember(const StudyAnalysis& analysis)
{
    Json part = Json::object();
    const std::string& why = analysis.screening.why;
    if (!analysis.withoutFlagged)
        putNull(part, "without_flagged", why.empty() ? "left out by --quick" : why);
    else
        part["without_flagged"] = withoutFlaggedPart(analysis);
    return part;
}

Json blindedRow(const BlindedQuestion& question, const BlindedMean& mean, std::size_t participants)
{
    Json row = Json::object();
    if (question.isChosen()) {
        row["trials"] = mean.n;
        putLeftOut(row, {"correct", "matches_per_rendering"}, leftOutWhileBlinded);
        put(row, "proportion", mean.mean);
        putLeftOut(row, {"ci95", "p_chance", "p_chance_participants"}, leftOutWhileBlinded);
    } else if (question.isRated()) {
        row["n"] = mean.n;
        put(row, "mean", mean.mean);
        putLeftOut(row, {"sd"}, leftOutWhileBlinded);
        row["participants"] = participants;
        putLeftOut(row, {"ci95"}, leftOutWhileBlinded);
    } else {
        row["answers"] = mean.n;
        row["participants"] = participants;
    }
    if (question.step > 0) row["rounded_to"] = question.step;
    putReasonsLast(row);
    return row;
}

/// null with the reason where there are no means.
Json blindedQuestionsMember(const BlindedMeans& means)
{
    Json member = Json::object();
    if (!means.why.empty()) {
        putNull(member, "questions", means.why);
        return member;
    }
    member["questions"] = Json::object();
    for (const BlindedQuestion& question : means.questions)
        for (const BlindedMean& mean : question.conditions)
            member["questions"][question.question.id][mean.condition] = blindedRow(question, mean, means.participants);
    return member;
}

/// The keys of an unblinded study; what a blinded one must not show is null.
JsonParts blindedResultsParts(const StudyAnalysis& analysis, const ReportOrigin& origin)
{
    const auto* const of = &analysis;
    const auto leftOut = [](std::vector<std::string> keys) {
        return JsonMembers{[keys] {
            Json members = Json::object();
            putLeftOut(members, keys, leftOutWhileBlinded);
            return members;
        }};
    };
    return {JsonMember{"schema", [] { return Json(schemaName + "2"); }},
            JsonMember{"study", [of, origin] { return studyPart(of->data, origin); }},
            JsonMember{"conditions", [of] { return Json(of->data.conditions); }},
            JsonMembers{[of] { return blindedQuestionsMember(of->blindedMeans); }},
            leftOut({"comparisons", "equivalence", "omnibus", "above_chance", "claims", "anchors", "speed_accuracy", "chain",
                     "signals"}),
            JsonMember{"quality", [of] { return qualityPart(of->flags); }},
            JsonMember{"preregistration", [of] { return preregistrationJson(*of); }},
            leftOut({"without_flagged"}),
            JsonMember{"design", [of] { return designPart(*of); }},
            leftOut({"touch"}),
            JsonMembers{[of] { return operatorLatencyMember(of->data); }}};
}

JsonParts resultsParts(const StudyAnalysis& analysis, const ReportOrigin& origin)
{
    if (analysis.data.blinded) return blindedResultsParts(analysis, origin);
    const auto* const of = &analysis;
    JsonParts parts{JsonMember{"schema", [] { return Json(schemaName + "2"); }},
                    JsonMember{"study", [of, origin] { return studyPart(of->data, origin); }},
                    JsonMember{"conditions", [of] { return Json(of->data.conditions); }},
                    JsonMember{"questions", [of] { return questionsPart(*of); }},
                    JsonMember{"comparisons", [of](const TakeRow& take) { addComparisons(take, *of); }},
                    JsonMember{"equivalence", [of](const TakeRow& take) { addEquivalences(take, *of); }}};
    for (auto& member : claimMembers(analysis)) parts.push_back(std::move(member));
    parts.push_back(JsonMembers{[of] { return anchorsMember(*of); }});
    parts.push_back(JsonMember{"speed_accuracy", [of] { return speedPart(*of); }});
    parts.push_back(JsonMembers{[of] { return chainMember(*of); }});
    parts.push_back(JsonMembers{[of] { return signalsMember(of->data); }});
    parts.push_back(JsonMember{"quality", [of] { return qualityPart(of->flags); }});
    parts.push_back(JsonMember{"preregistration", [of] { return preregistrationJson(*of); }});
    parts.push_back(JsonMembers{[of] { return withoutFlaggedMember(*of); }});
    parts.push_back(JsonMember{"design", [of] { return designPart(*of); }});
    parts.push_back(JsonMembers{[of] { return touchMember(*of); }});
    parts.push_back(JsonMembers{[of] { return operatorLatencyMember(of->data); }});
    return parts;
}

}  // namespace

nlohmann::ordered_json resultsJson(const StudyAnalysis& analysis, const ReportOrigin& origin)
{
    return objectOf(resultsParts(analysis, origin));
}

void writeResults(const StudyAnalysis& analysis, const ReportOrigin& origin, const TakeText& take)
{
    writeObject(resultsParts(analysis, origin), take);
}

bool isResultsFile(const std::filesystem::path& file)
{
    std::error_code unknown;
    // Anything may lie at this place. A pipe has no size and is not opened.
    if (std::filesystem::file_size(file, unknown) > protocols::largestJson) return false;
    const nlohmann::json results = protocols::storedJson(protocols::readIfPossible(file).value_or(""));
    return results.is_object() && results.contains("schema") && results["schema"].is_string() &&
           results["schema"].get<std::string>().starts_with(schemaName);
}

}  // namespace reports
