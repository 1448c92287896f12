#include "study/making/plan_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/analysis/question_claims.h"
#include "reports/data/study_data.h"
#include "stats/claims/claims.h"

namespace study::making {

namespace {

using nlohmann::ordered_json;

ordered_json fabricsJson(const StudyPlan& plan)
{
    ordered_json rows = ordered_json::array();
    for (const auto& fabric : plan.facts.fabrics)
        rows.push_back({{"id", fabric.value}, {"name", plan.facts.fabricNames.at(fabric)}});
    return rows;
}

ordered_json scoringJson(const protocols::AnswerKind& kind)
{
    return std::visit(protocols::Overloaded{
                          [](const reports::RightOrWrong& choice) -> ordered_json {
                              return {{"scored", "right_or_wrong"},
                                      {"alternatives", choice.alternatives},
                                      {"chance", 1.0 / choice.alternatives}};
                          },
                          [](const reports::NumberOnScale& scale) -> ordered_json {
                              return {{"scored", "number"}, {"scale", {{"min", scale.min}, {"max", scale.max}}}};
                          },
                          [](const reports::OpenWords&) -> ordered_json {
                              return {{"scored", "words"}};
                          },
                      },
                      reports::scoringOf(kind));
}

ordered_json questionsJson(const protocols::Protocol& protocol)
{
    ordered_json rows = ordered_json::array();
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions) {
            ordered_json row{{"id", question.id.value}, {"text", question.text}, {"answer", nameOf(question.kind)}};
            row.update(scoringJson(question.kind));
            rows.push_back(std::move(row));
        }
    return rows;
}

ordered_json contrastsJson(const StudyPlan& plan)
{
    ordered_json rows = ordered_json::array();
    for (const auto& contrast : plan.contrasts)
        rows.push_back({{"a", contrast.a.value}, {"b", contrast.b.value}, {"primary", rows.empty()}});
    return rows;
}

std::vector<std::string> namesOf(const std::vector<protocols::ConditionId>& conditions)
{
    std::vector<std::string> names;
    for (const auto& condition : conditions) names.push_back(condition.value);
    return names;
}

/// Three digits: formulas may differ between processors in the last one.
void putRounded(ordered_json& row, const std::string& key, const stats::Value& value)
{
    row[key] = value.exists() ? ordered_json(std::round(*value * 1000) / 1000) : ordered_json();
    if (!value.exists()) row["why"][key] = value.why();
}

ordered_json claimJson(const analyse::PowerOfClaim& claim)
{
    ordered_json row{{"claim", nameOf(claim.kind)}, {"generalises_to", reports::nameOf(claim.generalisation)}};
    putRounded(row, claim.kind == analyse::ClaimKind::AboveChance ? "true_share" : "true_difference", claim.effect);
    putRounded(row, "power", claim.power.alone);
    putRounded(row, "power_first_step_of_holm", claim.power.firstStep);
    return row;
}

ordered_json assumedJson(const analyse::QuestionPower& power)
{
    if (power.ratings)
        return {{"variance_participant_condition", power.ratings->participantCondition},
                {"variance_fabric_condition", power.ratings->fabricCondition},
                {"variance_residual", power.ratings->residual}};
    return {{"sd_participant_log_odds", power.choices->participantSd}, {"sd_fabric_log_odds", power.choices->fabricSd}};
}

ordered_json powerJson(const StudyPlan& plan)
{
    ordered_json rows = ordered_json::array();
    for (const auto& power : plan.power) {
        ordered_json row{{"question", power.question}, {"contrasts", power.contrasts}, {"assumed", assumedJson(power)}};
        row["claims"] = ordered_json::array();
        for (const auto& claim : power.claims) row["claims"].push_back(claimJson(claim));
        row["narrowest_bounds_with_80_percent"] = ordered_json::array();
        for (const auto& narrowest : power.narrowest) {
            ordered_json bounds{{"generalises_to", reports::nameOf(narrowest.generalisation)}};
            putRounded(bounds, "bounds", narrowest.bounds.alone);
            putRounded(bounds, "bounds_first_step_of_holm", narrowest.bounds.firstStep);
            row["narrowest_bounds_with_80_percent"].push_back(std::move(bounds));
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// By the questions of the phase; a phase without instructions is left out.
ordered_json instructionsJson(const protocols::Protocol& protocol)
{
    ordered_json rows = ordered_json::array();
    for (const auto& phase : protocol.phases)
        for (const auto& instruction : phase.instructions) {
            ordered_json row{{"questions", ordered_json::array()}, {"id", instruction.id.value}, {"text", instruction.text}};
            for (const auto& question : phase.questions) row["questions"].push_back(question.id.value);
            if (instruction.aim != protocols::SpeedAim::None) row["aim"] = nameOf(instruction.aim);
            if (instruction.deadlineSeconds) row["deadline_seconds"] = *instruction.deadlineSeconds;
            rows.push_back(std::move(row));
        }
    return rows;
}

/// By the questions of the phase; a phase without anchors is left out.
ordered_json anchorsJson(const protocols::Protocol& protocol)
{
    ordered_json rows = ordered_json::array();
    for (const auto& phase : protocol.phases) {
        if (phase.anchors.presentations() == 0) continue;
        ordered_json row{{"questions", ordered_json::array()}};
        for (const auto& question : phase.questions) row["questions"].push_back(question.id.value);
        row["mismatched"] = phase.anchors.mismatched;
        row["repeated"] = phase.anchors.repeated;
        if (phase.anchors.mismatched > 0) row["condition"] = anchorConditionOf(protocol, phase.anchors).value;
        rows.push_back(std::move(row));
    }
    return rows;
}

ordered_json studyJson(const StudyPlan& plan)
{
    const auto& facts = plan.facts;
    ordered_json study{{"name", facts.name},
                       {"protocol_sha256", plan.version.sha256},
                       {"protocol_version", plan.version.version},
                       {"dataset_sha256", facts.datasetSha256}};
    study["model_sha256"] = facts.modelSha256.empty() ? ordered_json() : ordered_json(facts.modelSha256);
    study["allocation_key_sha256"] = facts.keySha256;
    study["made_at"] = facts.createdAt;
    study["made_by"] = facts.programVersion;
    study["program"] = plan.program;
    study["stamps"] = facts.stamps;
    if (facts.modelSha256.empty()) study["why"]["model_sha256"] = "no condition has generated signals";
    return study;
}

}  // namespace

ordered_json plannedPart(const StudyPlan& plan)
{
    const protocols::Protocol& protocol = plan.protocol;
    const ExclusionRules rules = exclusionRules(protocol);
    ordered_json part{{"participants", protocol.participants}, {"stopping_rule", "number_of_participants"}};
    part["answers_per_participant"] = protocol.answersPerParticipant();
    part["fabrics"] = fabricsJson(plan);
    part["conditions"] = namesOf(protocol.conditions);
    part["questions"] = questionsJson(protocol);
    if (hasInstructions(protocol)) part["instructions"] = instructionsJson(protocol);
    if (hasAnchors(protocol)) part["anchors"] = anchorsJson(protocol);
    part["planned"] = contrastsJson(plan);
    part["family"] = plan.contrasts.empty() ? "all_pairs" : "planned";
    part["generalisations"] = {reports::nameOf(stats::Generalisation::TheseFabrics),
                               reports::nameOf(stats::Generalisation::FabricsLikeThese)};
    part["decides"] = reports::nameOf(stats::Generalisation::FabricsLikeThese);
    part["alpha"] = stats::claimAlpha;
    part["correction"] = "holm";
    part["equivalence_bounds"] = {protocol.equivalenceBounds.first, protocol.equivalenceBounds.second};
    part["exclusions"] = {{"main_analysis", "nobody"}, {"second_analysis_without", rules.flags}, {"rules", rules.sentences}};
    return part;
}

std::string planJson(const StudyPlan& plan, const RegistrationStamp& stamp, const std::string& textSha256)
{
    ordered_json json{{"schema", "vis2hap.preregistration/1"}, {"number", stamp.number}, {"registered_at", stamp.time}};
    json["registered_by"] = stamp.who.empty() ? ordered_json() : ordered_json(stamp.who);
    json["timing"] = timingOf(stamp);
    json["answers_before"] = stamp.answersBefore;
    json["after_unblinding"] = stamp.afterUnblinding;
    json["earlier_sha256"] = stamp.earlierHashes;
    json["changes"] = stamp.changes;
    json["text_sha256"] = textSha256;
    json["study"] = studyJson(plan);
    json["plan"] = plannedPart(plan);
    json["power"] = powerJson(plan);
    if (stamp.who.empty()) json["why"]["registered_by"] = "no name was given";
    return json.dump(2) + "\n";
}

}  // namespace study::making
