#include "study/records/stored_study.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "protocols/condition.h"
#include "protocols/protocol_json.h"
#include "study/records/participants_sentence.h"

namespace study::records {

namespace {

void describeProtocol(const protocols::Protocol& protocol, reports::StudyData& data)
{
    data.equivalenceBounds = protocol.equivalenceBounds;
    for (const auto& contrast : protocol.planned) data.planned.emplace_back(contrast.a.value, contrast.b.value);
    bool isFirstChoice = true;
    for (const auto& phase : protocol.phases) {
        for (const auto& question : phase.questions)
            if (!std::holds_alternative<protocols::FreeText>(question.kind))
                data.questions.push_back(
                    {question.id.value, question.text, alternativesOf(question.kind) > 0, alternativesOf(question.kind)});
        if (alternativesOf(phase.task) > 0 && std::exchange(isFirstChoice, false)) data.alternatives = alternativesOf(phase.task);
        if (const auto* rating = std::get_if<protocols::Rating>(&phase.task)) {
            data.scaleMin = rating->scale.min.inScaleUnits();
            data.scaleMax = rating->scale.max.inScaleUnits();
        }
    }
}

void describeParticipants(const database::StudyStore& store, reports::StudyData& data)
{
    for (const auto& enrolment : store.enrolments()) {
        const bool hasWithdrawn = enrolment.state == database::SlotState::Withdrawn;
        (hasWithdrawn ? data.withdrawn : data.participants).push_back(enrolment.participant.value);
        data.simulated = data.simulated || enrolment.kind == database::ParticipantKind::Simulated;
        data.scripted = data.scripted || enrolment.kind == database::ParticipantKind::Scripted;
    }
    data.participantsSentence = participantsSentence(store);
}

reports::Response responseOf(const database::CurrentAnswer& answer, const Naming::Entry& entry, const protocols::AnswerKind& kind)
{
    const auto& record = answer.record;
    reports::Response response;
    response.participant = answer.participant.value;
    response.fabric = entry.fabric.value;
    response.condition = entry.condition;
    response.question = record.question.value;
    response.seconds = answer.seconds;
    if (record.answer) {
        response.answer = record.answer;
        response.correct = isRight(kind, record.alternatives, entry.fabric, *record.answer);
        response.answerSlot = placeAmongAlternatives(kind, record.alternatives, *record.answer);
    }
    if (record.rating) response.rating = record.rating->inScaleUnits();
    return response;
}

}  // namespace

database::StudyStore openStudy(const std::filesystem::path& study)
{
    return {database::StudyFolder{study}, database::StudyStore::Access::Read};
}

protocols::Protocol protocolOf(const database::StudyFacts& facts)
{
    return protocols::keptProtocolFromJson(facts.protocolJson, "the study's protocol");
}

Naming namingOf(const database::StudyStore& store, const protocols::Protocol& protocol,
                const std::optional<database::Unblinded>& permission)
{
    Naming naming;
    naming.blinded = !permission;
    if (permission) {
        for (const auto& [code, entry] : readAllocationKey(store, *permission).entries)
            naming.entries[code] = {entry.fabric, entry.condition.value};
        for (const auto& condition : protocol.conditions) naming.conditions.push_back(condition.value);
        return naming;
    }
    for (const auto& [code, entry] : readMaskedKey(store).entries) naming.entries[code] = {entry.fabric, entry.label.value};
    for (std::size_t k = 1; k <= protocol.conditions.size(); ++k) naming.conditions.push_back("K" + std::to_string(k));
    return naming;
}

reports::StudyData studyData(const database::StudyStore& store)
{
    const auto facts = store.facts();
    const auto protocol = protocolOf(facts);
    const auto naming = namingOf(store, protocol, recordedUnblinding(store));

    reports::StudyData data;
    data.name = facts.name;
    data.protocolSha256 = facts.protocolSha256;
    data.blinded = naming.blinded;
    data.stamps = facts.stamps;
    data.conditions = naming.conditions;
    describeProtocol(protocol, data);
    if (data.blinded)
        data.planned.clear();
    else
        data.signalsJson = facts.signalsJson;
    for (const auto& fabric : facts.fabrics) data.fabrics.push_back(fabric.value);
    describeParticipants(store, data);
    const std::size_t questions = data.questions.size();
    std::set<std::string> analysed(data.participants.begin(), data.participants.end()), asked;
    for (const auto& question : data.questions) asked.insert(question.id);
    data.expectedResponses = store.slots().size() * static_cast<std::size_t>(protocol.presentationsPerPhase()) * questions;
    std::set<std::tuple<protocols::ParticipantId, protocols::TrialNumber, int>> voided;
    for (const auto& answer : store.answers()) {
        if (!analysed.contains(answer.participant.value)) continue;
        const auto& entry = naming.entries.at(answer.record.fileCode);
        if (answer.voided)
            voided.emplace(answer.participant, answer.record.trial, answer.attempt);
        else if (asked.contains(answer.record.question.value))
            (entry.condition == protocols::catchTrialId().value ? data.catchResponses : data.responses)
                .push_back(responseOf(answer, entry, questionWith(protocol, answer.record.question)->kind));
    }
    data.voided = voided.size();
    return data;
}

}  // namespace study::records
