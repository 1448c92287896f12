#include "protocols/protocol_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/id_rule.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "protocols/new_texts.h"
#include "protocols/protocol_part.h"
#include "protocols/protocol_schema.h"
#include "protocols/question_ids.h"
#include "protocols/texts/shipped_texts.h"
#include "protocols/usual_texts.h"

namespace protocols {

namespace {

using nlohmann::json;
constexpr int mostFabrics = 100;  // as the schema has it

std::vector<ProtocolFault> placed(const ProtocolFaults& faults, const JsonDocument& document)
{
    std::vector<ProtocolFault> all;
    for (const SchemaFault& fault : faults.all()) {
        const TextPlace place = document.textPlaceOf(pointerOf(fault.place));
        all.push_back({place.line, place.column, fault.text});
    }
    std::ranges::stable_sort(all, {}, [](const ProtocolFault& fault) { return std::pair(fault.line, fault.column); });
    if (faults.unlisted() > 0)
        all.push_back(
            {all.back().line, all.back().column,
             "the protocol: " + std::to_string(faults.unlisted()) + " more faults are not listed, correct these first"});
    return all;
}

[[noreturn]] void refuse(const ProtocolFaults& faults, const JsonDocument& document)
{
    std::string list;
    for (const SchemaFault& fault : faults.all())
        list += (list.empty() ? "" : "; ") + document.placeOf(pointerOf(fault.place)) + ", " + fault.text;
    if (faults.unlisted() > 0) list += "; and " + std::to_string(faults.unlisted()) + " more";
    const std::size_t number = faults.all().size() + faults.unlisted();
    const std::string count = number == 1 ? "1 fault" : std::to_string(number) + " faults";
    throw badInput({.what = "malformed protocol, " + count + ": " + list,
                    .where = document.where(),
                    .expected = "",
                    .nextStep = "see protocols/protocol.schema.json and protocols/vis2hap.json"});
}

/// The known id for either spelling; an unknown one stays as it is for faultsOf to name.
ConditionId conditionFrom(const std::string& text) { return faultOf(text) ? ConditionId(text) : conditionIdFrom(text); }

AnswerKind taskOf(const ProtocolPart& phase, const std::string& place)
{
    const std::vector<AnswerKind> declared = kindsDeclaredIn(phase);
    if (declared.size() != 1)
        phase.faults().add(place + ": has " + (declared.empty() ? "none" : "more than one") + " of " + keysOfKinds() +
                           ", expected one of them");
    return declared.empty() ? AnswerKind() : declared.front();
}

/// Which of the usual texts stand in for missing ones.
struct WordingOfTexts {
    ProtocolEdition edition;
    std::string language;
};

BlockInstruction instructionFrom(const ProtocolPart& part, const std::string& language)
{
    BlockInstruction instruction{InstructionId(part.text("id", "")), speedAimNamed(part.text("aim", "")), {}, {}};
    if (part.has("deadline_seconds")) instruction.deadlineSeconds = part.number("deadline_seconds", 1);
    instruction.text = part.text("text", usualInstructionText(instruction, language));
    return instruction;
}

Anchors anchorsFrom(const ProtocolPart& part)
{
    Anchors anchors;
    anchors.mismatched = part.whole("mismatched", anchors.mismatched);
    anchors.repeated = part.whole("repeated", anchors.repeated);
    if (part.has("condition")) anchors.condition = conditionFrom(part.text("condition", ""));
    return anchors;
}

Phase phaseFrom(const ProtocolPart& part, const ProtocolPart& texts, const std::string& place, const WordingOfTexts& wording)
{
    Phase phase;
    phase.task = taskOf(part, place);
    phase.catchTrials = part.whole("catch_trials", phase.catchTrials);
    phase.anchors = anchorsFrom(part.part("anchors"));
    if (part.yesOrNo("few_swaps", false)) phase.trayAim = TrayAim::FewSwaps;
    if (part.has("few_swaps") && !std::holds_alternative<ForcedChoice>(phase.task))
        part.faults().add(place + ".few_swaps: the tray has one piece, expected a phase with alternatives");
    for (const ProtocolPart& instruction : part.parts("instructions"))
        phase.instructions.push_back(instructionFrom(instruction, wording.language));
    for (const std::string& id : part.texts("questions")) {
        const std::string text = texts.text(id, usualTextOf(QuestionId(id), phase.task, wording.edition, wording.language));
        // A text that the schema refuses is no missing text.
        phase.questions.push_back({QuestionId(id), text.empty() && texts.has(id) ? "?" : text, phase.task});
    }
    for (const std::string& id : part.texts("free_text")) {
        const auto asked = std::ranges::find(phase.questions, QuestionId(id), &Question::id);
        if (asked != phase.questions.end())
            asked->kind = FreeText{};
        else
            part.faults().add(place + ".free_text: '" + id + "' is not among the phase's questions");
    }
    return phase;
}

/// Which texts belong to no question can be said only where all questions can be read.
void checkTexts(const Protocol& protocol, const json& texts, ProtocolFaults& faults)
{
    const auto isUnreadable = [](const Phase& phase) {
        return phase.questions.empty() || std::ranges::any_of(phase.questions, [](const Question& q) { return q.id.empty(); });
    };
    if (!texts.is_object() || protocol.phases.empty() || std::ranges::any_of(protocol.phases, isUnreadable)) return;
    for (const auto& [id, text] : texts.items())
        if (!questionWith(protocol, QuestionId(id)))
            faults.add("question_texts: '" + id + "' is asked in no phase, expected ids of the phases' questions");
}

void readPhases(const ProtocolPart& document, Protocol& protocol, const WordingOfTexts& wording)
{
    const ProtocolPart texts = document.part("question_texts");
    for (const ProtocolPart& phase : document.parts("phases"))
        protocol.phases.push_back(phaseFrom(phase, texts, "phases[" + std::to_string(protocol.phases.size()) + "]", wording));
    checkTexts(protocol, document.raw("question_texts"), document.faults());
}

void readFabrics(const ProtocolPart& document, Protocol& protocol)
{
    for (const std::string& id : document.texts("fabrics")) protocol.fabrics.emplace_back(id);
    // An unreadable number of fabrics must not make other numbers wrong.
    protocol.fabricCount =
        protocol.fabrics.empty() ? document.whole("fabrics", mostFabrics) : static_cast<int>(protocol.fabrics.size());
}

/// A condition of the lab's own: {"id": ..., "images": FOLDER} or {"id": ..., "program": true}.
void readOwnCondition(const ProtocolPart& part, const std::string& place, Protocol& protocol)
{
    const ConditionId id = protocol.conditions.emplace_back(part.text("id", ""));
    if (part.has("images") == part.has("program"))
        part.faults().add(place + ": has " + (part.has("images") ? "both" : "neither") +
                          " of 'images' and 'program', expected one of them");
    if (part.has("program") && !part.has("images"))
        protocol.ownPrograms.insert(id);
    else
        protocol.ownImages[id] = part.text("images", "?");
}

void readConditions(const ProtocolPart& document, Protocol& protocol)
{
    if (const json& list = document.raw("conditions"); list.is_array()) {
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (list[i].is_object()) {
                readOwnCondition(ProtocolPart(list[i], "conditions[" + std::to_string(i) + "]", document.faults()),
                                 "conditions[" + std::to_string(i) + "]", protocol);
            } else {
                protocol.conditions.push_back(conditionFrom(list[i].is_string() ? list[i].get<std::string>() : ""));
            }
        }
        return;
    }
    // An unreadable list must not make the planned contrasts wrong; the schema has named it.
    for (const Condition& condition : allConditions()) {
        protocol.conditions.push_back(condition.conditionId());
        if (condition.hasQuality())
            for (const Quality quality : allQualities) protocol.conditions.push_back(withQuality(condition, quality));
    }
}

PlannedContrast contrastFrom(const json& pair)
{
    const auto side = [&](std::size_t i) {
        const bool isText = pair.is_array() && i < pair.size() && pair[i].is_string();
        return conditionFrom(isText ? pair[i].get<std::string>() : "");
    };
    return {side(0), side(1)};
}

void readAnalysis(const ProtocolPart& document, Protocol& protocol)
{
    const json& bounds = document.raw("equivalence_bounds");
    if (bounds.is_array() && !document.faults().isRefusedWithin("equivalence_bounds"))
        protocol.equivalenceBounds = bounds.get<std::pair<double, double>>();
    protocol.hasUsualBounds = !document.has("equivalence_bounds");
    if (protocol.hasUsualBounds) protocol.equivalenceBounds = usualBoundsOf(protocol.phases);
    const json& planned = document.raw("planned");
    if (planned.is_array())
        for (const json& pair : planned) protocol.planned.push_back(contrastFrom(pair));
    if (document.has("primary")) protocol.primary = contrastFrom(document.raw("primary"));
}

void readTextsByKey(const ProtocolPart& document, const std::string& key, std::map<std::string, std::string>& into)
{
    const json& texts = document.raw(key);
    if (!texts.is_object()) return;
    const ProtocolPart part = document.part(key);
    for (const auto& [name, text] : texts.items()) into[name] = part.text(name, "?");
}

void readCourse(const ProtocolPart& document, Protocol& protocol, const WordingOfTexts& wording)
{
    protocol.secondsPerPresentation = document.number("seconds_per_presentation", protocol.secondsPerPresentation);
    protocol.breakAfterPresentations = document.whole("break_after", protocol.breakAfterPresentations);
    protocol.sittingMinutes = document.whole("sitting_minutes", protocol.sittingMinutes);
    if (document.has("break_after_minutes")) protocol.breakAfterMinutes = document.whole("break_after_minutes", 1);
    protocol.consent = document.text("consent", usualConsent(wording.edition, wording.language));
    protocol.strokeWords = document.text("stroke_words", usualStrokeWords(wording.edition, wording.language));
    protocol.swatchCodes = document.text("swatches", "once") == "fresh" ? SwatchCodes::PerParticipant : SwatchCodes::Once;
    protocol.familiarisationFabrics = document.whole("familiarisation_fabrics", protocol.familiarisationFabrics);
    protocol.secondEntry = document.yesOrNo("second_entry", protocol.secondEntry);
    protocol.deadTimeSeconds = document.number("dead_time_seconds", protocol.deadTimeSeconds);
    protocol.confirmPieces = document.yesOrNo("confirm_pieces", protocol.confirmPieces);
    readTextsByKey(document, "participant_texts", protocol.participantTexts);
    readTextsByKey(document, "prompts", protocol.prompts);
    protocol.checklist = document.texts("checklist");
    protocol.readings = document.texts("readings");
    protocol.facts = document.texts("facts");
}

Protocol protocolFrom(const ProtocolPart& document, ProtocolEdition edition)
{
    Protocol protocol;
    protocol.name = document.text("name", "");
    protocol.participants = document.whole("participants", protocol.participants);
    readFabrics(document, protocol);
    readConditions(document, protocol);
    protocol.language = document.text("language", protocol.language);
    const WordingOfTexts wording{edition, protocol.language};
    readPhases(document, protocol, wording);
    readAnalysis(document, protocol);
    readCourse(document, protocol, wording);
    return protocol;
}

/// The protocol as far as it can be read; its faults are added to those of the schema.
Protocol readFrom(const JsonDocument& document, ProtocolEdition edition, ProtocolFaults& faults)
{
    SchemaFaults ofSchema = schemaFaultsOf(document.root(), edition);
    // Without an object there is nothing to read on, and a value is read only where all its faults are known.
    const bool isReadOn = document.root().is_object() && !ofSchema.isTooLarge && ofSchema.unlisted == 0;
    faults = ProtocolFaults(std::move(ofSchema));
    if (!isReadOn) return {};
    const Protocol protocol = protocolFrom(ProtocolPart(document.root(), "", faults), edition);
    for (const std::string& fault : faultsOf(protocol)) faults.add(fault);
    if (edition == ProtocolEdition::Current)
        for (const std::string& fault : faultsOfQuestionIds(protocol)) faults.add(fault);
    return protocol;
}

/// The name stands in titles, certificates and on terminals. A study that was made with another name or with other ids still
/// opens.
Protocol readNewFrom(const JsonDocument& document, ProtocolFaults& faults)
{
    Protocol protocol = readFrom(document, ProtocolEdition::Current, faults);
    for (const std::string& fault : faultsOfTexts(document.root())) faults.add(fault);
    if (const std::string why = faultOfLine(protocol.name, longestReason); !why.empty() && !protocol.name.empty())
        faults.add("name: " + why + ", expected " + lineRule(longestReason));
    for (std::size_t i = 0; i < protocol.fabrics.size(); ++i)
        // An empty id is one that the schema has refused.
        if (const std::string why = faultOfId(protocol.fabrics[i].value); !why.empty() && !protocol.fabrics[i].empty())
            faults.add("fabrics[" + std::to_string(i) + "]: the id " + why + ", expected " + idRule());
    return protocol;
}

Protocol readBy(const std::optional<ProtocolEdition>& kept, std::string_view text, const std::string& where)
{
    const JsonDocument document(text, where);
    ProtocolFaults faults({});
    Protocol protocol = kept ? readFrom(document, *kept, faults) : readNewFrom(document, faults);
    if (!faults.all().empty()) refuse(faults, document);
    return protocol;
}

std::string sizeFaultOf(std::string_view text)
{
    return std::to_string(text.size()) + " bytes, expected at most " + std::to_string(largestProtocol);
}

}  // namespace

CheckedProtocol checkedProtocol(std::string_view text, const std::string& where)
{
    CheckedProtocol checked;
    if (text.size() > largestProtocol) {
        checked.faults.push_back({1, 1, "the protocol: " + sizeFaultOf(text)});
        return checked;
    }
    const JsonDocument document(text, where);
    ProtocolFaults faults({});
    checked.protocol = readNewFrom(document, faults);
    checked.faults = placed(faults, document);
    if (!checked.faults.empty()) checked.protocol.reset();
    return checked;
}

Protocol protocolFromJson(std::string_view text, const std::string& where)
{
    if (text.size() > largestProtocol) throw badInput({sizeFaultOf(text), where, "", "check the path"});
    return readBy(std::nullopt, text, where);
}

Protocol keptProtocolFromJson(std::string_view text, const std::string& where, std::string_view madeBy)
{
    return readBy(editionOf(madeBy), text, where);
}

Protocol readProtocol(const std::filesystem::path& file) { return protocolFromJson(readProtocolText(file), file.string()); }

std::string readProtocolText(const std::filesystem::path& file) { return readWholeFile(file, largestProtocol); }

std::string_view paperProtocolJson() { return shipped::paperProtocol(); }

}  // namespace protocols
