#include "reports/json/choice_statistics_json.h"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "reports/json/effects_json.h"
#include "reports/json/instructions_json.h"
#include "reports/json/model_json.h"
#include "reports/json/speed_json.h"
#include "reports/text/plain_words.h"
#include "stats/power/measured_claims.h"

namespace reports {
namespace {

/// What a test generalises to that takes every answer as independent: nothing beyond the trials of the study.
const std::string theseTrials = "these_trials", theseFabrics = "these_fabrics";

/// "third" for 1/3, as names have it; "1_over_7" where English has no short word.
std::string fractionName(int alternatives)
{
    static const std::map<int, std::string> names{{2, "half"}, {3, "third"}, {4, "quarter"}, {5, "fifth"}};
    const auto found = names.find(alternatives);
    return found != names.end() ? found->second : "1_over_" + std::to_string(alternatives);
}

Json perConditionPart(const StudyData& data, const ChoiceAnalysis& choices)
{
    const std::string people = std::to_string(answeringParticipants(data, choices));
    Json rows = Json::array();
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        const ConditionChoices& condition = choices.conditions[i];
        const stats::BinomialTest& exact = condition.againstChance;
        Json row{{"condition", data.conditions[i]}, {"correct", condition.count.correct}, {"trials", condition.count.trials}};
        put(row, "mean_matches_per_rendering_of_" + people,
            condition.count.trials > 0 ? condition.matchesPerRendering : exact.estimate);
        putP(row, "p_exact_greater_one_" + fractionName(choices.alternatives), exact.pGreater, exact.logPGreater);
        putP(row, "p_holm", condition.pHolm);
        put(row, "cp95", exact.clopperPearson);
        put(row, "wilson95", exact.wilson);
        row["generalises_to"] = theseTrials;
        rows.push_back(std::move(row));
    }
    return rows;
}

Json cochranPart(const StudyData&, const ChoiceAnalysis& choices)
{
    const stats::CochranTest& test = choices.cochran;
    Json part = Json::object();
    put(part, "Q", test.q);
    putWhole(part, "df", test.df);
    putP(part, "p", test.p, test.logP);
    part["blocks"] = test.blocks;
    part["generalises_to"] = theseTrials;
    const auto rateAt = [](double people, double fabrics) {
        return stats::falseClaimRate(stats::cochranOfSampledFabrics, {true, people, fabrics, false});
    };
    part["rejects_falsely"] = {{"without_interactions", rateAt(0, 0)},
                               {"fabric_sd_0.5", rateAt(0, 0.5)},
                               {"participant_and_fabric_sd_0.5", rateAt(0.5, 0.5)}};
    part["note"] = "blocks = participant x fabric; ignores clustering, descriptive only";
    return part;
}

Json participantPart(const StudyData&, const ChoiceAnalysis& choices)
{
    Json shares = Json::object();
    for (const ParticipantShare& one : choices.participants) put(shares, one.participant, one.share);
    const stats::TTest& test = choices.participantsAgainstChance;
    Json part{{"prop", shares}};
    put(part, "t_vs_" + fractionName(choices.alternatives), test.t);
    putWhole(part, "df", test.df);
    putP(part, "p", test.p, test.logP);
    part["generalises_to"] = theseFabrics;
    return part;
}

/// Without interactions the model rejects as often as Cochran's Q where conditions differ from fabric to fabric.
Json modelPart(const StudyData&, const ChoiceAnalysis& choices)
{
    Json part = choiceModelJson(choices.model);
    part["generalises_to"] = theseTrials;
    return part;
}

Json crossedModelPart(const StudyData&, const ChoiceAnalysis& choices)
{
    Json part = crossedChoiceModelJson(choices.crossedModel);
    putGeneralisation(part, choices.crossedModel.leftOut);
    return part;
}

/// What a same-different question adds to d'.
void putMatches(Json& row, const stats::MatchSensitivity& matches)
{
    row["rule"] = "hits and false alarms";
    row["hits"] = matches.counts.hits;
    row["same_pairs"] = matches.counts.same;
    row["false_alarms"] = matches.counts.falseAlarms;
    row["different_pairs"] = matches.counts.different;
    put(row, "hit_rate", matches.hitRate);
    put(row, "false_alarm_rate", matches.falseAlarmRate);
    put(row, "criterion", matches.criterion.estimate);
    put(row, "criterion_ci95", matches.criterion.overParticipants);
}

Json sensitivityPart(const StudyData& data, const ChoiceAnalysis& choices)
{
    Json part = Json::object();
    for (std::size_t i = 0; i < data.conditions.size(); ++i) {
        Json row = Json::object();
        put(row, "d_prime", choices.conditions[i].dPrime);
        put(row, "se", choices.conditions[i].dPrimeSe);
        if (const auto& matches = choices.conditions[i].matches) putMatches(row, *matches);
        row["generalises_to"] = theseTrials;
        row["clustered"] = clusteredSensitivityRows(choices.sensitivities, data.conditions[i], ruleOfDPrime(choices));
        putReasonsLast(row);
        part[data.conditions[i]] = std::move(row);
    }
    return part;
}

Json confusionPart(const StudyData& data, const ChoiceAnalysis& choices)
{
    const ChoiceConfusion& confusion = choices.confusion;
    Json part{{"answered", Json::object()}, {"slots", Json::object()}};
    for (std::size_t truth = 0; truth < data.fabrics.size(); ++truth)
        for (std::size_t chosen = 0; chosen < data.fabrics.size(); ++chosen)
            part["answered"][data.fabrics[truth]][data.fabrics[chosen]] = confusion.chosen[truth][chosen];
    for (const int slot : confusion.slots)
        part["slots"][std::string(1, static_cast<char>('A' + slot))] = confusion.slotCounts.at(slot);
    if (!confusion.known) putNull(part, "answered", "the answers tell right and wrong alone, not which fabric was named");
    return part;
}

Json byRenderingPart(const StudyData& data, const ChoiceAnalysis& choices)
{
    Json part = Json::object();
    for (std::size_t i = 0; i < data.conditions.size(); ++i)
        for (std::size_t k = 0; k < data.fabrics.size(); ++k) {
            const CountCorrect& count = choices.conditions[i].byFabric[k];
            part[data.conditions[i]][data.fabrics[k]] = {{"correct", count.correct}, {"trials", count.trials}};
        }
    return part;
}

Json speedContrastsPart(const StudyData&, const ChoiceAnalysis& choices) { return speedContrastsJson(choices.speed); }

Json conditionalAccuracyPart(const StudyData& data, const ChoiceAnalysis& choices)
{
    return accuracyBySpeedJson(data.conditions, choices.accuracyBySpeed);
}

struct ChoiceKey {
    std::string suffix;
    std::function<Json(const StudyData&, const ChoiceAnalysis&)> part;
};

const std::vector<ChoiceKey>& choiceKeys()
{
    static const std::vector<ChoiceKey> keys{
        {"_per_condition", perConditionPart},
        {"_cochran", cochranPart},
        {"_participant_level", participantPart},
        {"_glmm", modelPart},
        {"_glmm_crossed", crossedModelPart},
        {"_sensitivity", sensitivityPart},
        {"_confusion", confusionPart},
        {"_matches_by_rendering", byRenderingPart},
        {"_speed_accuracy_contrasts", speedContrastsPart},
        {"_conditional_accuracy", conditionalAccuracyPart},
    };
    return keys;
}

}  // namespace

std::vector<std::string> choiceStatisticsKeys(const std::string& question)
{
    std::vector<std::string> keys;
    for (const ChoiceKey& key : choiceKeys()) keys.push_back(lowerCase(question) + key.suffix);
    keys.push_back(lowerCase(question) + "_instructions");
    return keys;
}

void putChoiceStatistics(Json& statistics, const StudyData& data, const std::string& question, const ChoiceAnalysis& choices)
{
    for (const ChoiceKey& key : choiceKeys()) statistics[lowerCase(question) + key.suffix] = key.part(data, choices);
    if (!choices.instructions.instructions.empty())
        statistics[lowerCase(question) + "_instructions"] = instructionsJson(data.conditions, choices.instructions);
}

}  // namespace reports
