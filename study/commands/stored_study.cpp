#include "study/commands/stored_study.h"

#include "protocols/protocol_json.h"

#include <algorithm>

namespace study::commands {

namespace {

void describeProtocol(const protocols::Protocol& protocol, reports::StudyData& data)
{
    data.equivalenceBounds = protocol.equivalenceBounds;
    for (const auto& contrast : protocol.planned)
        data.planned.emplace_back(contrast.a.value, contrast.b.value);
    for (const auto& phase : protocol.phases) {
        for (const auto& question : phase.questions)
            data.questions.push_back({question.id.value, question.text, phase.isChoice()});
        if (phase.alternatives)
            data.alternatives = *phase.alternatives;
        if (phase.scale) {
            data.scaleMin = phase.scale->min.inScaleUnits();
            data.scaleMax = phase.scale->max.inScaleUnits();
        }
    }
}

void describeParticipants(const database::StudyStore& store, reports::StudyData& data)
{
    for (const auto& slot : store.slots()) {
        if (slot.state == database::SlotState::Free)
            continue;
        data.participants.push_back(slot.participant.value);
        data.simulated = data.simulated || slot.kind == database::ParticipantKind::Simulated;
        data.scripted = data.scripted || slot.kind == database::ParticipantKind::Scripted;
    }
}

reports::Response responseOf(const database::CurrentAnswer& answer, const Naming::Entry& entry)
{
    const auto& record = answer.record;
    reports::Response response;
    response.participant = answer.participant.value;
    response.fabric = entry.fabric.value;
    response.condition = entry.condition;
    response.question = record.question.value;
    response.seconds = answer.seconds;
    if (record.answer) {
        response.answer = record.answer->value;
        response.correct = *record.answer == entry.fabric;
        const auto slot = std::find(record.alternatives.begin(), record.alternatives.end(), *record.answer);
        response.answerSlot = static_cast<int>(slot - record.alternatives.begin());
    }
    if (record.rating)
        response.rating = record.rating->inScaleUnits();
    return response;
}

}  // namespace

database::StudyStore openStudy(const std::filesystem::path& study)
{
    return {database::StudyFolder{study}, database::StudyStore::Access::Read};
}

protocols::Protocol protocolOf(const database::StudyFacts& facts)
{
    return protocols::protocolFromJson(facts.protocolJson, "the study's protocol");
}

Naming namingOf(const database::StudyStore& store, const protocols::Protocol& protocol,
                const std::optional<database::Unblinded>& permission)
{
    Naming naming;
    naming.blinded = !permission;
    if (permission) {
        for (const auto& [code, entry] : readAllocationKey(store, *permission).entries)
            naming.entries[code] = {entry.fabric, entry.condition.value};
        for (const auto& condition : protocol.conditions)
            naming.conditions.push_back(condition.value);
        return naming;
    }
    for (const auto& [code, entry] : readMaskedKey(store).entries)
        naming.entries[code] = {entry.fabric, entry.label.value};
    for (std::size_t k = 1; k <= protocol.conditions.size(); ++k)
        naming.conditions.push_back("K" + std::to_string(k));
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
    for (const auto& fabric : facts.fabrics)
        data.fabrics.push_back(fabric.value);
    describeParticipants(store, data);
    const std::size_t questions = data.questions.size();
    data.expectedResponses = store.slots().size() * static_cast<std::size_t>(protocol.presentationsPerPhase()) * questions;
    for (const auto& answer : store.answers()) {
        if (answer.voided)
            ++data.voided;
        else
            data.responses.push_back(responseOf(answer, naming.entries.at(answer.record.fileCode)));
    }
    return data;
}

}  // namespace study::commands
