#include "study/records/stored_study.h"

#include <set>
#include <tuple>

#include "protocols/condition.h"
#include "protocols/protocol_json.h"
#include "reports/json/signals_json.h"
#include "study/records/participants_sentence.h"

namespace study::records {

namespace {

void describeProtocol(const protocols::Protocol& protocol, reports::StudyData& data)
{
    data.equivalenceBounds = protocol.equivalenceBounds;
    data.boundsStated = true;
    for (const auto& contrast : contrastsInOrder(protocol)) data.planned.emplace_back(contrast.a.value, contrast.b.value);
    for (const auto& phase : protocol.phases)
        for (const auto& question : phase.questions) data.questions.push_back({question.id.value, question.text, question.kind});
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

/// A rating, a choice if answers of this kind are right or wrong, otherwise words.
reports::AnswerContent contentOf(const database::AnswerRecord& record, const protocols::FabricId& truth,
                                 const protocols::AnswerKind& kind)
{
    if (record.rating) return reports::RatedAnswer{record.rating->inScaleUnits()};
    const std::string text = record.answer.value_or("");
    if (const auto correct = isRight(kind, record.alternatives, truth, text))
        return reports::ChosenAnswer{*correct, text, placeAmongAlternatives(kind, record.alternatives, text)};
    return reports::WordedAnswer{text};
}

reports::StudyResponse responseOf(const database::CurrentAnswer& answer, const Naming::Entry& entry,
                                  const protocols::AnswerKind& kind)
{
    return {answer.participant.value,
            entry.fabric.value,
            entry.condition,
            answer.record.question.value,
            contentOf(answer.record, entry.fabric, kind),
            answer.seconds};
}

/// Sorts the current answers into analysed answers, answers to blank glass, and a count of voided presentations.
void readAnswers(const database::StudyStore& store, const protocols::Protocol& protocol, const Naming& naming,
                 reports::StudyData& data)
{
    const std::set<std::string> analysed(data.participants.begin(), data.participants.end());
    std::set<std::tuple<protocols::ParticipantId, protocols::TrialNumber, int>> voided;
    for (const auto& answer : store.answers()) {
        if (!analysed.contains(answer.participant.value)) continue;
        const auto& entry = naming.entries.at(answer.record.fileCode);
        const auto* question = questionWith(protocol, answer.record.question);
        if (answer.voided)
            voided.emplace(answer.participant, answer.record.trial, answer.attempt);
        else if (question != nullptr)
            (entry.condition == protocols::catchTrialId().value ? data.catchResponses : data.responses)
                .push_back(responseOf(answer, entry, question->kind));
    }
    data.voided = voided.size();
}

}  // namespace

database::StudyStore openStudy(const std::filesystem::path& study)
{
    return {database::StudyFolder{study}, database::StudyStore::Access::Read};
}

protocols::Protocol protocolOf(const database::StudyFacts& facts)
{
    return protocols::keptProtocolFromJson(facts.protocolJson, "the study's protocol", facts.programVersion);
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
        data.signals = reports::signalsFromJson(facts.signalsJson);
    for (const auto& fabric : facts.fabrics) data.fabrics.push_back(fabric.value);
    describeParticipants(store, data);
    data.expectedResponses =
        store.slots().size() * static_cast<std::size_t>(protocol.presentationsPerPhase()) * data.questions.size();
    readAnswers(store, protocol, naming, data);
    return data;
}

}  // namespace study::records
