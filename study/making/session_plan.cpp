#include "study/making/session_plan.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/number_text.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/records/balance.h"
#include "protocols/usual_texts.h"
#include "reports/text/plain_words.h"
#include "stats/power/power.h"
#include "study/analyse/power/planned_power.h"

namespace study::making {

namespace {

using nlohmann::ordered_json;
using protocols::Phase;
using protocols::Protocol;
using reports::counted;

constexpr std::uint64_t shownSeed = 1;

bool hasUsualText(const protocols::Question& question, const Phase& phase, const Protocol& protocol)
{
    return question.text ==
           protocols::usualTextOf(question.id, phase.task, protocols::ProtocolEdition::Current, protocol.language);
}

/// Empty unless a number scale of a question of the lab's own keeps the usual words at both ends.
std::string noteOnUsualEnds(const Protocol& protocol)
{
    for (const char* key : {"scale_low", "scale_high", "card_low", "card_high", "say_unrelated", "say_same"})
        if (protocol.participantTexts.contains(key)) return {};
    std::string ids;
    for (const Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions) {
            const auto* rating = std::get_if<protocols::Rating>(&question.kind);
            if (rating && rating->scale.labels.empty() && !hasUsualText(question, phase, protocol) &&
                question.text != protocols::paperWordingOf(question.id))
                ids += (ids.empty() ? "" : ", ") + question.id.value;
        }
    if (ids.empty()) return {};
    return "participant_texts: the ends of the scale of " + ids + " are \"" + participantText(protocol, "scale_low") +
           "\" and \"" + participantText(protocol, "scale_high") +
           "\"; where these do not fit, write scale_low, scale_high, card_low, card_high, say_unrelated, say_same and say_ends";
}

/// Empty unless a question has the paper's sentence where another kind of answer is asked for.
std::string noteOnUsualQuestions(const Protocol& protocol)
{
    std::string ids;
    for (const Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions) {
            const bool fits = question.id.value == "Q1" ? std::holds_alternative<protocols::ForcedChoice>(phase.task)
                                                        : std::holds_alternative<protocols::Rating>(phase.task);
            if (!fits && hasUsualText(question, phase, protocol)) ids += (ids.empty() ? "" : ", ") + question.id.value;
        }
    if (ids.empty()) return {};
    return "question_texts: the usual sentence of " + ids +
           " asks for another kind of answer than the phase; write one of your own";
}

std::string answersText(const protocols::AnswerKind& kind)
{
    return std::visit(
        protocols::Overloaded{
            [](const protocols::ForcedChoice& choice) { return "one of " + counted(choice.alternatives, "piece"); },
            [](const protocols::Rating& rating) {
                const protocols::RatingScale& scale = rating.scale;
                const auto number = [](protocols::Tenths tenths) { return protocols::shortest(tenths.value / 10.0); };
                const std::string words =
                    scale.labels.empty() ? "" : ", in words (" + scale.labels.front() + " … " + scale.labels.back() + ")";
                return number(scale.min) + " to " + number(scale.max) + " in steps of " + number(scale.step) + words;
            },
            [](const protocols::SameDifferent&) { return std::string("same or different"); },
            [](const protocols::FreeText&) { return std::string("words"); },
        },
        kind);
}

ordered_json phaseJson(const Protocol& protocol, const Phase& phase)
{
    ordered_json json{{"questions", ordered_json::array()}};
    for (const protocols::Question& question : phase.questions)
        json["questions"].push_back({{"id", question.id.value}, {"text", question.text}, {"answer", answersText(question.kind)}});
    json["pieces_on_tray"] = protocols::piecesOnTray(phase.task);
    json["instructions"] = ordered_json::array();
    for (const protocols::BlockInstruction& instruction : phase.instructions)
        json["instructions"].push_back(instruction.id.value);
    const int presentations = (protocol.presentationsPerPhase() + phase.extraPresentations()) * phase.runs();
    json["presentations"] = presentations;
    json["catch_trials"] = phase.catchTrials * phase.runs();
    json["anchors"] = {{"mismatched", phase.anchors.mismatched * phase.runs()},
                       {"repeated", phase.anchors.repeated * phase.runs()},
                       {"condition", phase.anchors.mismatched > 0 ? ordered_json(anchorConditionOf(protocol, phase.anchors).value)
                                                                  : ordered_json()}};
    if (phase.anchors.mismatched == 0) json["anchors"]["why"] = {{"condition", "no anchor is mismatched"}};
    json["minutes"] = presentations * protocol.secondsPerPresentation / 60;
    return json;
}

stats::StudyDesign designOf(const Protocol& protocol)
{
    stats::StudyDesign design;
    design.participants = static_cast<std::size_t>(protocol.participants);
    design.fabrics = static_cast<std::size_t>(protocol.fabricCount);
    design.conditions = protocol.conditions.size();
    return design;
}

ordered_json detected(const std::string& question, const std::string& claim, const stats::Value& effect, const std::string& unit)
{
    ordered_json json{{"question", question}, {"claim", claim}, {"unit", unit}};
    json["smallest"] = effect.exists() ? ordered_json(*effect) : ordered_json();
    if (!effect.exists()) json["why"] = {{"smallest", effect.why()}};
    return json;
}

/// The largest difference that fits the scale is its length.
ordered_json ratingPower(const Protocol& protocol, const Phase& phase, const protocols::Question& question,
                         const protocols::RatingScale& scale)
{
    const stats::StudyDesign design = designOf(protocol);
    stats::RatingTruth truth = analyse::ratingTruthOf(scale);
    truth.residual /= phase.runs();  // the tests take the mean over the instructions
    const auto power = [&](double effect) {
        return stats::tTestPower(protocol.participants, effect / truth.sdOfDifference(design));
    };
    stats::Value smallest = stats::Value::undefined("needs at least 2 participants");
    if (protocol.participants >= 2) smallest = stats::smallestDetectable(power, truth.scaleMax - truth.scaleMin);
    if (protocol.participants >= 2 && !smallest.exists())
        smallest = stats::Value::undefined("no difference that fits the scale is detected that surely");
    return detected(question.id.value, "difference of two conditions, these fabrics", smallest, "scale points");
}

ordered_json choicePower(const Protocol& protocol, const Phase& phase, const protocols::Question& question)
{
    const double chance = 1.0 / protocols::alternativesOf(question.kind);
    const stats::BinomialPlan plan{.trials = static_cast<long long>(protocol.participants) * protocol.fabricCount * phase.runs(),
                                   .chance = chance};
    const auto power = [&](double above) { return stats::binomialPower(plan, std::min(1.0, chance + above)); };
    const stats::Value above = stats::smallestDetectable(power, 1 - chance);
    return detected(question.id.value, "one condition above chance, these answers",
                    above.exists() ? stats::Value(chance + *above) : above, "share right");
}

std::string word(const ordered_json& object, const char* key) { return object[key].get<std::string>(); }

std::string fixed(double value, int decimals) { return protocols::fixed(value, decimals); }

std::string shownAnchors(const ordered_json& anchors)
{
    std::string text;
    if (const int mismatched = anchors["mismatched"]; mismatched > 0)
        text += "  " + std::to_string(mismatched) + " of them are mismatched: the image is " + word(anchors, "condition") +
                " of one fabric, and another fabric lies on the tray\n";
    if (const int repeated = anchors["repeated"]; repeated > 0)
        text += "  " + std::to_string(repeated) + " of them come a second time, in a later block where the list is long enough\n";
    return text;
}

std::string phaseText(const ordered_json& phase, std::size_t number)
{
    std::string text = "phase " + std::to_string(number) + ": " + counted(phase["presentations"], "presentation") + ", about " +
                       fixed(phase["minutes"], 0) + " minutes, " + counted(phase["pieces_on_tray"], "piece") + " on the tray";
    if (const int blank = phase["catch_trials"]; blank > 0) text += ", " + std::to_string(blank) + " of them with blank glass";
    text += "\n" + shownAnchors(phase["anchors"]);
    if (!phase["instructions"].empty()) {
        text += "  under the instructions";
        for (const auto& id : phase["instructions"]) text += " " + id.get<std::string>();
        text += ", in an order that is balanced over the participants\n";
    }
    for (const auto& question : phase["questions"])
        text += "  " + word(question, "id") + ": \"" + word(question, "text") + "\" (" + word(question, "answer") + ")\n";
    return text;
}

}  // namespace

ordered_json sessionPlan(const Protocol& protocol)
{
    ordered_json json{{"schema", "vis2hap.session_plan/1"}, {"name", protocol.name}, {"participants", protocol.participants}};
    json["fabrics"] = protocol.fabricCount;
    json["conditions"] = ordered_json::array();
    for (const protocols::ConditionId& id : protocol.conditions) json["conditions"].push_back(id.value);
    for (const protocols::ConditionId& id : protocol.ownPrograms) json["programs"].push_back(id.value);
    json["language"] = protocol.language;
    json["phases"] = ordered_json::array();
    for (const Phase& phase : protocol.phases) json["phases"].push_back(phaseJson(protocol, phase));
    json["presentations_per_participant"] = protocol.presentations();
    json["answers_per_participant"] = protocol.answersPerParticipant();
    json["minutes_per_participant"] = protocol.minutesPerParticipant();
    json["breaks"] = protocol.breaks();
    json["sittings"] = protocol.sittingsPerParticipant();
    json["answers"] = protocol.answersPerParticipant() * protocol.participants;
    json.update(protocols::jsonOf(protocols::balanceOf(protocols::drawDesign(protocol, shownSeed), protocol)));
    json["detects"] = detectableEffects(protocol);
    return json;
}

ordered_json detectableEffects(const Protocol& protocol)
{
    ordered_json rows = ordered_json::array();
    for (const Phase& phase : protocol.phases)
        for (const protocols::Question& question : phase.questions) {
            if (const auto* rating = std::get_if<protocols::Rating>(&question.kind); rating && protocol.conditions.size() > 1)
                rows.push_back(ratingPower(protocol, phase, question, rating->scale));
            if (protocols::alternativesOf(question.kind) > 1) rows.push_back(choicePower(protocol, phase, question));
        }
    return rows;
}

std::vector<std::string> remarksOn(const Protocol& protocol)
{
    std::vector<std::string> remarks{analyse::boundsWarning(protocol), protocols::noteOnOwnEnds(protocol),
                                     noteOnUsualEnds(protocol), noteOnUsualQuestions(protocol)};
    std::erase(remarks, std::string());
    return remarks;
}

std::string textOf(const ordered_json& plan)
{
    std::string text = word(plan, "name") + "\n" + counted(plan["participants"], "participant") + ", " +
                       counted(plan["fabrics"], "fabric") + ", " + counted(plan["conditions"].size(), "condition") + ":";
    for (const auto& id : plan["conditions"]) text += " " + id.get<std::string>();
    for (const auto& id : plan.value("programs", ordered_json::array()))
        text += "\n" + id.get<std::string>() + " comes from a program of yours: `vis2hap study new --program " +
                id.get<std::string>() + "=COMMAND`";
    text += "\n\neach participant: " + counted(plan["presentations_per_participant"], "presentation") + ", " +
            counted(plan["answers_per_participant"], "answer") + ", about " + fixed(plan["minutes_per_participant"], 0) +
            " minutes without breaks; " + counted(plan["breaks"], "break") + ", " + counted(plan["sittings"], "sitting") + "\n";
    for (std::size_t i = 0; i < plan["phases"].size(); ++i) text += phaseText(plan["phases"][i], i + 1);
    text += "the whole study: " + counted(plan["answers"], "answer") + "\n\nbalance of the running orders (seed " +
            std::to_string(shownSeed) + "):\n";
    for (const auto& range : plan["balance"])
        text += "  " + word(range, "what") + ": " + std::to_string(range["min"].get<int>()) + " to " +
                std::to_string(range["max"].get<int>()) + "\n";
    text += "\nwhat the study can detect with a power of 80 %, under the usual assumptions (`vis2hap power` prints them):\n";
    for (const auto& row : plan["detects"])
        text += "  " + word(row, "question") + ", " + word(row, "claim") + ": " +
                (row["smallest"].is_null() ? word(row["why"], "smallest") : fixed(row["smallest"], 2) + " " + word(row, "unit")) +
                "\n";
    return text;
}

}  // namespace study::making
