#include "study/app/state/open_study.h"

#include <QCoreApplication>
#include <algorithm>
#include <map>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "study/app/language/app_text.h"
#include "study/app/language/below.h"
#include "study/app/language/fonts.h"
#include "study/session/driver.h"
#include "study/session/stimuli.h"

namespace study::app {

OpenStudy::OpenStudy(const std::filesystem::path& folder)
    : m_store(database::StudyFolder{folder}, database::StudyStore::Access::Write),
      m_facts(m_store.facts()),
      m_protocol(protocols::keptProtocolFromJson(m_store.protocolVersions().back().json,
                                                 database::StudyFolder{folder}.protocol().string(), m_facts.programVersion))
{
}

rendering::StimulusBank& OpenStudy::bank()
{
    if (!m_bank) m_bank.emplace(session::stimuliOf(m_store));
    return *m_bank;
}

QString OpenStudy::name() const { return QString::fromStdString(m_facts.name); }

int StudyOverview::placesIn(database::SlotState state) const
{
    return static_cast<int>(
        std::count_if(places.begin(), places.end(), [state](const ParticipantPlace& p) { return p.state == state; }));
}

StudyOverview OpenStudy::overview() const
{
    std::map<protocols::ParticipantId, int> stored;
    for (const auto& answer : m_store.answers())
        if (!answer.voided) ++stored[answer.participant];
    StudyOverview seen{name(),
                       QString::fromStdString(m_store.folder().folder.string()),
                       {},
                       m_protocol.answersPerParticipant(),
                       QString::fromStdString(m_store.nextParticipantId().value)};
    const auto enrolments = m_store.enrolments();
    for (const auto& slot : m_store.slots()) {
        for (const auto& one : enrolments)
            if (one.slot == slot.number)
                seen.places.push_back(
                    {one.slot, one.state, QString::fromStdString(one.participant.value), one.kind, stored[one.participant]});
        if (slot.state == database::SlotState::Free) seen.places.push_back({slot.number, slot.state, {}, slot.kind, 0});
    }
    return seen;
}

QStringList OpenStudy::codesOnPieces() const
{
    const auto slots = m_store.slots();
    const auto free =
        std::find_if(slots.begin(), slots.end(), [](const auto& s) { return s.state == database::SlotState::Free; });
    const auto place = static_cast<std::size_t>((free == slots.end() ? slots.back() : *free).number) - 1;
    QStringList codes;
    for (const auto& fabric : m_facts.fabrics)
        codes << QString::fromStdString(m_facts.swatches.empty() ? m_facts.fabricNames.at(fabric)
                                                                 : m_facts.swatches.at(place).at(fabric));
    codes.sort();  // the order of the fabrics says nothing
    return codes;
}

std::string OpenStudy::lastWallTime() const
{
    std::int64_t last = 0;
    std::string time = m_facts.createdAt;
    for (const auto& enrolment : m_store.enrolments()) {
        const auto events = m_store.events(enrolment.participant);
        if (events.empty() || events.back().sequence < last) continue;
        last = events.back().sequence;
        time = events.back().wallTime;
    }
    return time;
}

QString OpenStudy::fontFault() const
{
    const QString language = QString::fromStdString(m_protocol.language), package = missingFontPackage(language);
    if (package.isEmpty()) return {};
    return AppText::tr(
               "This computer has no font for the language of the participants, %1: they would see boxes. "
               "Run: apt-get install %2")
        .arg(language, package);
}

QString OpenStudy::protocolFault() const
{
    try {
        session::requireKeptProtocol(m_store);
        return {};
    } catch (const protocols::Error& fault) {
        // Both remedies write to the study, which this window keeps locked.
        return QCoreApplication::translate("study::app::OpenStudy", "%1. First close the study in this window (Esc).")
            .arg(inOwnLanguage(fault.what()));
    }
}

}  // namespace study::app
