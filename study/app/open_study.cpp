#include "study/app/open_study.h"

#include "protocols/protocol_json.h"

#include <algorithm>
#include <map>

namespace study::app {

OpenStudy::OpenStudy(const std::filesystem::path& folder)
    : m_store(database::StudyFolder{folder}, database::StudyStore::Access::Write),
      m_facts(m_store.facts()),
      m_protocol(protocols::protocolFromJson(m_facts.protocolJson, database::StudyFolder{folder}.protocol().string())),
      m_bank(database::StudyFolder{folder}.stimuli(), m_store.stimulusHashes())
{
}

QString OpenStudy::name() const
{
    return QString::fromStdString(m_facts.name);
}

int StudyOverview::placesIn(database::SlotState state) const
{
    return static_cast<int>(std::count_if(places.begin(), places.end(), [state](const Place& p) { return p.state == state; }));
}

StudyOverview OpenStudy::overview() const
{
    std::map<protocols::ParticipantId, int> stored;
    for (const auto& answer : m_store.answers())
        if (!answer.voided)
            ++stored[answer.participant];
    StudyOverview seen{name(), QString::fromStdString(m_store.folder().folder.string()), {}, 0,
                       QString::fromStdString(m_store.nextParticipantId().value)};
    for (const auto& slot : m_store.slots())
        seen.places.push_back({slot.number, slot.state, QString::fromStdString(slot.participant.value), slot.kind,
                               stored[slot.participant]});
    for (const auto& phase : m_protocol.phases)
        seen.answersInAll += m_protocol.presentationsPerPhase() * static_cast<int>(phase.questions.size());
    return seen;
}

}  // namespace study::app
