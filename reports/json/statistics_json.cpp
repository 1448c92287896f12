#include "reports/json/statistics_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "reports/json/choice_statistics_json.h"
#include "reports/json/effects_json.h"
#include "reports/json/group_json.h"
#include "reports/json/instructions_json.h"
#include "reports/json/json_members.h"
#include "reports/json/model_json.h"
#include "reports/json/ordinal_json.h"
#include "reports/json/rating_statistics_json.h"
#include "reports/json/speed_json.h"

namespace reports {
namespace {

/// "choice" for every question with right and wrong answers, whatever its kind.
std::string scoringName(const QuestionInfo& question)
{
    return std::visit(protocols::Overloaded{
                          [](const RightOrWrong&) { return "choice"; },
                          [](const NumberOnScale&) { return "rating"; },
                          [](const OpenWords&) { return "words"; },
                      },
                      scoringOf(question.kind));
}

/// The range of all rating questions together; the paper's scale where there is none.
NumberOnScale commonScale(const StudyAnalysis& analysis)
{
    std::optional<NumberOnScale> common;
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) {
        const NumberOnScale& scale = question.findings.scale;
        common = common ? NumberOnScale{std::min(common->min, scale.min), std::max(common->max, scale.max)} : scale;
    }
    return common.value_or(NumberOnScale());
}

Json questionRow(const QuestionAnalysis& question, const NumberOnScale& common)
{
    Json row{{"id", question.question.id}, {"text", question.question.text}, {"kind", scoringName(question.question)}};
    putWordings(row, question.question.wordings);
    const auto* ratings = std::get_if<RatingAnalysis>(&question.findings);
    if (ratings != nullptr && ratings->scale != common) row["scale"] = {ratings->scale.min, ratings->scale.max};
    return row;
}

Json missingPart(const StudyAnalysis& analysis)
{
    Json missing = Json::object();
    for (const QuestionAnalysis& question : analysis.questions)
        for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i)
            missing[question.question.id][analysis.data.conditions[i]] = question.missing[i];
    return missing;
}

Json dataPart(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    const NumberOnScale scale = commonScale(analysis);
    Json questions = Json::array();
    for (const QuestionAnalysis& question : analysis.questions) questions.push_back(questionRow(question, scale));
    Json part{{"participants", data.participants},
              {"fabrics", data.fabrics},
              {"conditions", data.conditions},
              {"questions", questions},
              {"alternatives", firstAlternatives(data)},
              {"scale", {scale.min, scale.max}},
              {"scripted", data.scripted},
              {"stamps", data.stamps},
              {"responses", analysis.completeness.present},
              {"expected_responses", analysis.completeness.expected},
              {"missing_responses", analysis.completeness.missing()},
              {"missing_by_condition", missingPart(analysis)},
              {"voided_presentations", data.voided}};
    if (!data.knowsKinds) putNull(part, "scripted", kindsUnknown);
    putReasonsLast(part);
    return part;
}

Json countedRate(const stats::Rejections& rejections)
{
    Json row{{"studies", rejections.studies}, {"rejected", rejections.rejected}, {"rate", rejections.rate()}};
    put(row, "ci95", rejections.interval());
    return row;
}

Json falseClaimsPart(const StudyAnalysis& analysis)
{
    Json part = Json::object();
    for (const FalseClaimFinding& finding : analysis.falseClaims) {
        Json row{{"sd_participant_condition", finding.participantSd},
                 {"sd_fabric_condition", finding.fabricSd},
                 {"interpolated", {{"one_contrast", finding.one}, {"any_pair", finding.any}}}};
        if (finding.simulated)
            row["simulated"] = {{"first_contrast", countedRate(finding.simulated->first)},
                                {"any_contrast", countedRate(finding.simulated->any)}};
        part[finding.question] = std::move(row);
    }
    return part;
}

Json screeningPart(const StudyAnalysis& analysis)
{
    const Screening& screening = analysis.screening;
    Json part{{"excluded", Json::array()}};
    for (const ExcludedParticipant& one : screening.excluded) {
        Json flags = Json::array();
        for (const FlagKind kind : one.flags) flags.push_back(nameOf(kind));
        part["excluded"].push_back({{"participant", one.participant}, {"flags", flags}});
    }
    part["participants"] = {{"before", screening.participantsBefore}, {"after", screening.participantsAfter}};
    if (!screening.why.empty()) {
        putNull(part, "questions", screening.why);
        return part;
    }
    part["questions"] = Json::object();
    for (const ScreenedQuestion& question : screening.questions)
        for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
            Json row = Json::object();
            put(row, "before", question.conditions[i].before);
            put(row, "after", question.conditions[i].after);
            part["questions"][question.question][analysis.data.conditions[i]] = std::move(row);
        }
    return part;
}

Json responseTimesPart(const StudyAnalysis& analysis)
{
    Json part = Json::object();
    for (const QuestionAnalysis& question : analysis.questions)
        for (std::size_t i = 0; i < question.times.size(); ++i) {
            const stats::ResponseTimes& times = question.times[i];
            Json row{{"n", times.n}};
            put(row, "median_seconds", times.median);
            put(row, "mean_seconds", times.mean);
            put(row, "log_mean", times.logMean);
            put(row, "geometric_mean_seconds", times.geometricMean);
            part[question.question.id][analysis.data.conditions[i]] = std::move(row);
        }
    return part;
}

/// The keys that a question takes at the top level: a rating question its id, a choice question several with its id in them.
std::vector<std::string> topLevelKeys(const QuestionAnalysis& question)
{
    const std::string& id = question.question.id;
    using Keys = std::vector<std::string>;
    return std::visit(protocols::Overloaded{
                          [&](const ChoiceAnalysis&) { return choiceStatisticsKeys(id); },
                          [&](const RatingAnalysis&) { return Keys{id}; },
                          [](const WordedAnalysis&) { return Keys{}; },
                      },
                      question.findings);
}

/// Ids of the questions that cannot stand at the top level, because one of their keys is taken: by the file itself, or by
/// another question. Choice questions come first, so that "q1_cochran" as a question's id does not displace Q1.
std::set<std::string> displacedQuestions(const StudyAnalysis& analysis)
{
    std::set<std::string> taken{"schema",
                                "data",
                                "questions",
                                "screening",
                                "groups",
                                "false_claims",
                                "response_times",
                                "order_effects",
                                "lmm_contrasts",
                                "lmm_variances",
                                "lmm_leave_one_fabric_out",
                                "rating_ordinal",
                                "rating_ordinal_by_question",
                                "why"};
    for (const std::string& key : effectKeys()) taken.insert(key);
    std::set<std::string> displaced;
    const auto place = [&](const QuestionAnalysis& question) {
        const std::vector<std::string> keys = topLevelKeys(question);
        const auto isTaken = [&](const std::string& key) { return taken.contains(key); };
        if (std::any_of(keys.begin(), keys.end(), isTaken))
            displaced.insert(question.question.id);
        else
            taken.insert(keys.begin(), keys.end());
    };
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) place(question.analysis);
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) place(question.analysis);
    return displaced;
}

/// Readers find Q2 and "q1_cochran" at the top level. Only ids that collide there need a place of their own.
Json displacedPart(const StudyAnalysis& analysis, const std::set<std::string>& displaced)
{
    Json questions = Json::object();
    for (const auto& choices : questionsWith<ChoiceAnalysis>(analysis))
        if (displaced.contains(choices.id()))
            putChoiceStatistics(questions[choices.id()], analysis.data, choices.id(), choices.findings);
    for (const auto& ratings : questionsWith<RatingAnalysis>(analysis))
        if (displaced.contains(ratings.id())) questions[ratings.id()] = ratingStatistics(analysis.data, ratings.findings);
    return questions;
}

/// A rating question is one member, a choice question several.
void addQuestionParts(JsonParts& parts, const StudyAnalysis& analysis)
{
    const std::set<std::string> displaced = displacedQuestions(analysis);
    const StudyData* const data = &analysis.data;
    for (const QuestionAnalysis& question : analysis.questions) {
        const std::string& id = question.question.id;
        if (displaced.contains(id)) continue;
        std::visit(protocols::Overloaded{
                       [&](const ChoiceAnalysis& choices) {
                           parts.push_back(JsonMembers{[data, id, found = &choices] {
                               Json members = Json::object();
                               putChoiceStatistics(members, *data, id, *found);
                               return members;
                           }});
                       },
                       [&](const RatingAnalysis& ratings) {
                           parts.push_back(JsonMember{id, [data, found = &ratings] { return ratingStatistics(*data, *found); }});
                       },
                       [](const WordedAnalysis&) {},  // "data" counts them, tables/worded_answers.csv lists them
                   },
                   question.findings);
    }
    if (!displaced.empty())
        parts.push_back(JsonMember{"questions", [of = &analysis, displaced] { return displacedPart(*of, displaced); }});
}

/// One member with an entry for each rating question; none without such questions.
template <class EntryOf>
void addRatingPart(JsonParts& parts, const StudyAnalysis& analysis, const std::string& key, const EntryOf& entryOf)
{
    if (questionsWith<RatingAnalysis>(analysis).empty()) return;
    parts.push_back(JsonMember{key, [of = &analysis, entryOf] {
                                   Json part = Json::object();
                                   for (const auto& question : questionsWith<RatingAnalysis>(*of))
                                       part[question.id()] = entryOf(question);
                                   return part;
                               }});
}

Json effectMembers(const StudyAnalysis& analysis)
{
    Json members = Json::object();
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionEffects* effects = effectsOf(question))
            putEffects(members, question.question.id, *effects, unitOf(question));
    return members;
}

void addModelParts(JsonParts& parts, const StudyAnalysis& analysis)
{
    using Rated = AnalysedQuestion<RatingAnalysis>;
    addRatingPart(parts, analysis, "lmm_contrasts", [data = &analysis.data](const Rated& question) {
        return modelContrastsJson(*data, question.findings.modelContrasts);
    });
    addRatingPart(parts, analysis, "lmm_variances", [](const Rated& question) { return variancesJson(question.findings.model); });
    addRatingPart(parts, analysis, "lmm_leave_one_fabric_out",
                  [](const Rated& question) { return leaveOneFabricOutJson(question.findings.leaveOneFabricOut); });
    parts.push_back(JsonMembers{[of = &analysis] { return effectMembers(*of); }});
    const auto ordinalOf = [](const Rated& question) { return ordinalRatingsJson(question.id(), question.findings.ordinal); };
    // The reference report has one such model, that of the last question.
    if (!questionsWith<RatingAnalysis>(analysis).empty())
        parts.push_back(JsonMember{"rating_ordinal",
                                   [of = &analysis, ordinalOf] { return ordinalOf(questionsWith<RatingAnalysis>(*of).back()); }});
    addRatingPart(parts, analysis, "rating_ordinal_by_question", ordinalOf);
}

Json questionsOfBlinded(const StudyData& data)
{
    Json questions = Json::array();
    for (const QuestionInfo& question : data.questions) {
        Json row{{"id", question.id}, {"text", question.text}, {"kind", scoringName(question)}};
        putWordings(row, question.wordings);
        if (const Scoring scoring = scoringOf(question.kind); const auto* scale = std::get_if<NumberOnScale>(&scoring))
            row["scale"] = {scale->min, scale->max};
        questions.push_back(std::move(row));
    }
    return questions;
}

/// Counts are over all answers, as they are known without the key.
Json blindedDataPart(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    Json part{{"participants", data.participants},
              {"finished", analysis.blindedMeans.participants},
              {"fabrics", data.fabrics},
              {"conditions", data.conditions},
              {"questions", questionsOfBlinded(data)},
              {"alternatives", firstAlternatives(data)},
              {"scripted", data.scripted},
              {"stamps", data.stamps},
              {"responses", analysis.completeness.present},
              {"expected_responses", analysis.completeness.expected},
              {"missing_responses", analysis.completeness.missing()}};
    putLeftOut(part, {"missing_by_condition"}, leftOutWhileBlinded);
    part["voided_presentations"] = data.voided;
    putReasonsLast(part);
    return part;
}

JsonParts blindedStatisticsParts(const StudyAnalysis& analysis)
{
    return {JsonMember{"schema", [] { return Json("vis2hap.statistics/1"); }},
            JsonMember{"data", [of = &analysis] { return blindedDataPart(*of); }}, JsonMembers{[] {
                Json members = Json::object();
                putLeftOut(members,
                           {"questions", "lmm_contrasts", "lmm_variances", "lmm_leave_one_fabric_out", "rating_ordinal",
                            "rating_ordinal_by_question", "false_claims", "screening", "response_times", "order_effects"},
                           leftOutWhileBlinded);
                return members;
            }}};
}

JsonParts statisticsParts(const StudyAnalysis& analysis)
{
    if (analysis.data.blinded) return blindedStatisticsParts(analysis);
    const auto* const of = &analysis;
    JsonParts parts{JsonMember{"schema", [] { return Json("vis2hap.statistics/1"); }},
                    JsonMember{"data", [of] { return dataPart(*of); }}};
    addQuestionParts(parts, analysis);
    addModelParts(parts, analysis);
    if (!analysis.groups.questions.empty()) parts.push_back(JsonMember{"groups", [of] { return groupsJson(*of); }});
    parts.push_back(JsonMember{"false_claims", [of] { return falseClaimsPart(*of); }});
    parts.push_back(JsonMember{"screening", [of] { return screeningPart(*of); }});
    parts.push_back(JsonMember{"response_times", [of] { return responseTimesPart(*of); }});
    parts.push_back(JsonMember{"order_effects", [of] { return orderEffectsJson(of->order); }});
    return parts;
}

}  // namespace

nlohmann::ordered_json statisticsJson(const StudyAnalysis& analysis) { return objectOf(statisticsParts(analysis)); }

void writeStatistics(const StudyAnalysis& analysis, const TakeText& take) { writeObject(statisticsParts(analysis), take); }

}  // namespace reports
