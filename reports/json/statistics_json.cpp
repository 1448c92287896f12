#include "reports/json/statistics_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "reports/json/choice_statistics_json.h"
#include "reports/json/effects_json.h"
#include "reports/json/group_json.h"
#include "reports/json/json_fields.h"
#include "reports/json/model_json.h"
#include "reports/json/ordinal_json.h"
#include "reports/json/rating_statistics_json.h"
#include "reports/json/speed_json.h"

namespace reports {
namespace {

/// "choice" for every question with right and wrong answers, whatever its kind.
std::string scoringName(const QuestionFindings& findings)
{
    return std::visit(protocols::Overloaded{
                          [](const ChoiceAnalysis&) { return "choice"; },
                          [](const RatingAnalysis&) { return "rating"; },
                          [](const WordedAnalysis&) { return "words"; },
                      },
                      findings);
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
    Json row{{"id", question.question.id}, {"text", question.question.text}, {"kind", scoringName(question.findings)}};
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
    return {{"participants", data.participants},
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

}  // namespace

nlohmann::ordered_json statisticsJson(const StudyAnalysis& analysis)
{
    Json statistics{{"schema", "vis2hap.statistics/1"}, {"data", dataPart(analysis)}};
    const std::set<std::string> displaced = displacedQuestions(analysis);
    for (const QuestionAnalysis& question : analysis.questions) {
        const std::string& id = question.question.id;
        // Readers find Q2 and "q1_cochran" at the top level. Only ids that collide there need a place of their own.
        const bool isDisplaced = displaced.contains(id);
        std::visit(protocols::Overloaded{
                       [&](const ChoiceAnalysis& choices) {
                           putChoiceStatistics(isDisplaced ? statistics["questions"][id] : statistics, analysis.data, id,
                                               choices);
                       },
                       [&](const RatingAnalysis& ratings) {
                           (isDisplaced ? statistics["questions"] : statistics)[id] = ratingStatistics(analysis.data, ratings);
                       },
                       [](const WordedAnalysis&) {},  // "data" counts them, tables/worded_answers.csv lists them
                   },
                   question.findings);
    }
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) {
        const RatingAnalysis& ratings = question.findings;
        statistics["lmm_contrasts"][question.id()] = modelContrastsJson(ratings.modelContrasts, analysis.data.equivalenceBounds);
        statistics["lmm_variances"][question.id()] = variancesJson(ratings.model);
        statistics["lmm_leave_one_fabric_out"][question.id()] = leaveOneFabricOutJson(ratings.leaveOneFabricOut);
    }
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionEffects* effects = effectsOf(question))
            putEffects(statistics, question.question.id, *effects, unitOf(question));
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) {
        // The reference report has one such model, that of the last question.
        const Json ordinal = ordinalRatingsJson(question.id(), question.findings.ordinal);
        statistics["rating_ordinal"] = ordinal;
        statistics["rating_ordinal_by_question"][question.id()] = ordinal;
    }
    if (!analysis.groups.questions.empty()) statistics["groups"] = groupsJson(analysis);
    statistics["false_claims"] = falseClaimsPart(analysis);
    statistics["screening"] = screeningPart(analysis);
    statistics["response_times"] = responseTimesPart(analysis);
    statistics["order_effects"] = orderEffectsJson(analysis.order);
    return statistics;
}

std::string statisticsText(const StudyAnalysis& analysis) { return statisticsJson(analysis).dump(2) + "\n"; }

}  // namespace reports
