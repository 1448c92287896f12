#include "protocols/protocol_json.h"
#include "protocols/files/whole_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/protocol_schema.h"
#include "protocols/shipped_texts.h"

namespace protocols {

namespace {

using nlohmann::json;
using Faults = std::vector<std::string>;

/// Words for the questions of the paper where the file gives none; free of the number of fabrics shown.
const std::map<std::string, std::string>& wordsOfThePaper()
{
    static const std::map<std::string, std::string> words{
        {"Q1", "Which of the showed fabric pieces does the haptic rendering match with?"},
        {"Q2", "Does the haptic rendering have the same slipperiness as the physical fabric?"},
        {"Q3", "Does the haptic rendering have the same texture as the physical fabric?"},
        {"Q4", "How much realism of haptic rendering do you feel compared with physical fabric?"},
    };
    return words;
}

constexpr const char* wordsOfConsent =
    "The participant has read the information sheet, was told that they may stop at any time without giving a reason, "
    "and has agreed to take part";

constexpr const char* wordsOfStroke =
    "Stroke from left to right with one finger, lightly, at about the width of the hand in two seconds; lift the finger on the "
    "way back. Stroke the glass and the cloth the same way, as often as you like.";

[[noreturn]] void refuse(const Faults& faults, const std::string& where)
{
    std::string list;
    for (const std::string& fault : faults) list += (list.empty() ? "" : "; ") + fault;
    const std::string count = faults.size() == 1 ? "1 fault" : std::to_string(faults.size()) + " faults";
    throw badInput({.what = "malformed protocol, " + count + ": " + list,
                    .where = where,
                    .expected = "",
                    .nextStep = "see protocols/protocol.schema.json and protocols/vis2hap.json"});
}

Tenths tenthsFrom(const json& number, const std::string& place, Faults& faults)
{
    const double tenths = number.get<double>() * 10;
    // 0.1 * 10 need not be 1 in binary; anything further off is not a tenth.
    if (std::abs(tenths - std::round(tenths)) > 1e-6)
        faults.push_back(place + ": " + number.dump() + ", expected a whole number of tenths");
    return Tenths{static_cast<int>(std::lround(tenths))};
}

Scale scaleFrom(const json& object, const std::string& place, Faults& faults)
{
    Scale scale;
    scale.min = tenthsFrom(object.at("min"), place + ".min", faults);
    scale.max = tenthsFrom(object.at("max"), place + ".max", faults);
    if (object.contains("step")) scale.step = tenthsFrom(object.at("step"), place + ".step", faults);
    scale.sections = object.value("sections", scale.sections);
    scale.labels = object.value("labels", scale.labels);
    return scale;
}

/// The known id for either spelling; an unknown one stays as it is for faultsOf to name.
ConditionId conditionFrom(const json& text)
{
    ConditionId id(text.get<std::string>());
    std::ranges::replace(id.value, '+', '&');
    const bool known = std::ranges::any_of(allConditions(), [&](const Condition& c) { return c.id == id.value; });
    return known ? id : ConditionId(text.get<std::string>());
}

Phase phaseFrom(const json& object, const json& texts, const std::string& place, Faults& faults)
{
    Phase phase;
    for (const json& entry : object.at("questions")) {
        const std::string id = entry.get<std::string>();
        const auto known = wordsOfThePaper().find(id);
        const std::string usual = known == wordsOfThePaper().end() ? "" : known->second;
        phase.questions.push_back({QuestionId(id), texts.value(id, usual)});
    }
    for (const json& id : object.value("free_text", json::array())) {
        const auto asked = std::ranges::find(phase.questions, QuestionId(id.get<std::string>()), &Question::id);
        if (asked == phase.questions.end())
            faults.push_back(place + ".free_text: '" + id.get<std::string>() + "' is not among the phase's questions");
        else
            asked->inWords = true;
    }
    phase.sameDifferent = object.value("same_different", false);
    phase.catchTrials = object.value("catch_trials", 0);
    if (object.contains("alternatives")) phase.alternatives = object.at("alternatives").get<int>();
    if (object.contains("scale")) phase.scale = scaleFrom(object.at("scale"), place + ".scale", faults);
    return phase;
}

void readPhases(const json& document, Protocol& protocol, Faults& faults)
{
    const json texts = document.value("question_texts", json::object());
    std::vector<std::string> asked;
    for (std::size_t i = 0; i < document.at("phases").size(); ++i) {
        const std::string place = "phases[" + std::to_string(i) + "]";
        protocol.phases.push_back(phaseFrom(document.at("phases")[i], texts, place, faults));
        for (const Question& question : protocol.phases.back().questions) asked.push_back(question.id.value);
    }
    for (const auto& [id, text] : texts.items())
        if (std::ranges::find(asked, id) == asked.end())
            faults.push_back("question_texts: '" + id + "' is asked in no phase, expected ids of the phases' questions");
}

Protocol protocolFrom(const json& document, Faults& faults)
{
    Protocol protocol;
    protocol.name = document.at("name").get<std::string>();
    protocol.participants = document.at("participants").get<int>();
    const json& fabrics = document.at("fabrics");
    protocol.fabricCount = fabrics.is_array() ? static_cast<int>(fabrics.size()) : fabrics.get<int>();
    if (fabrics.is_array())
        for (const json& id : fabrics) protocol.fabrics.emplace_back(id.get<std::string>());
    for (const json& id : document.at("conditions")) protocol.conditions.push_back(conditionFrom(id));
    readPhases(document, protocol, faults);
    if (document.contains("equivalence_bounds"))
        protocol.equivalenceBounds = document.at("equivalence_bounds").get<std::pair<double, double>>();
    for (const json& pair : document.value("planned", json::array()))
        protocol.planned.push_back({conditionFrom(pair[0]), conditionFrom(pair[1])});
    protocol.secondsPerPresentation = document.value("seconds_per_presentation", protocol.secondsPerPresentation);
    protocol.breakAfterPresentations = document.value("break_after", protocol.breakAfterPresentations);
    protocol.sittingMinutes = document.value("sitting_minutes", protocol.sittingMinutes);
    if (document.contains("break_after_minutes")) protocol.breakAfterMinutes = document.at("break_after_minutes").get<int>();
    protocol.consent = document.value("consent", wordsOfConsent);
    protocol.strokeWords = document.value("stroke_words", wordsOfStroke);
    protocol.swatchCodes = document.value("swatches", "once") == "fresh" ? SwatchCodes::PerParticipant : SwatchCodes::Once;
    protocol.familiarisationFabrics = document.value("familiarisation_fabrics", protocol.familiarisationFabrics);
    protocol.secondEntry = document.value("second_entry", protocol.secondEntry);
    protocol.checklist = document.value("checklist", protocol.checklist);
    protocol.readings = document.value("readings", protocol.readings);
    protocol.facts = document.value("facts", protocol.facts);
    return protocol;
}

}  // namespace

Protocol protocolFromJson(std::string_view text, const std::string& where)
{
    const json document = parseStrictJson(text, where);
    Faults faults = schemaFaultsOf(document);
    if (!faults.empty()) refuse(faults, where);
    const Protocol protocol = protocolFrom(document, faults);
    for (const std::string& fault : faultsOf(protocol)) faults.push_back(fault);
    if (!faults.empty()) refuse(faults, where);
    return protocol;
}

Protocol readProtocol(const std::filesystem::path& file) { return protocolFromJson(readWholeFile(file), file.string()); }

std::string_view paperProtocolJson() { return shipped::paperProtocol(); }

}  // namespace protocols
