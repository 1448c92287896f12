#include "study/app/state/open_study.h"

#include <QCoreApplication>
#include <QStandardPaths>
#include <algorithm>
#include <iterator>
#include <map>

#include "database/server/station_folders.h"
#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "study/app/language/app_text.h"
#include "study/app/language/below.h"
#include "study/app/language/fonts.h"
#include "study/session/driver.h"
#include "study/session/operated_by.h"
#include "study/session/station_images.h"
#include "study/session/stimuli.h"

namespace study::app {

namespace {

std::unique_ptr<database::SessionStore> storeOf(const database::StudyFolder& folder)
{
    if (database::readServerNote(folder.folder)) return std::make_unique<database::StationStore>(folder);
    return std::make_unique<database::StudyStore>(folder, database::StudyStore::Access::Write);
}

}  // namespace

std::filesystem::path folderOfStudy(const std::filesystem::path& place)
{
    if (!database::isServerAddress(place.string())) return place;
    const QString stations = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/stations";
    return stationFolder(database::serverAddressFrom(place.string()), stations.toStdString(), session::operatedBy("", "").host);
}

OpenStudy::OpenStudy(const std::filesystem::path& folder)
    : m_store(storeOf({folder})),
      m_station(dynamic_cast<database::StationStore*>(m_store.get())),
      m_facts(m_store->facts()),
      m_protocol(protocols::keptProtocolFromJson(m_store->protocolVersions().back().json,
                                                 database::StudyFolder{folder}.protocol().string(), m_facts.programVersion))
{
}

rendering::PresentedImages& OpenStudy::images()
{
    if (m_images) return *m_images;
    if (m_station)
        m_images = std::make_unique<session::StationImages>(*m_station);
    else
        m_images = std::make_unique<rendering::StimulusBank>(session::stimuliOf(static_cast<database::StudyStore&>(*m_store)));
    return *m_images;
}

std::optional<database::StationStore::Link> OpenStudy::serverLink()
{
    if (!m_station) return std::nullopt;
    m_station->refresh();
    return m_station->link();
}

void OpenStudy::enrolNew(const protocols::ParticipantId& participant, database::ParticipantKind kind)
{
    if (m_station) m_station->enrolNew(participant, kind);  // a study in a folder has no other station
}

void OpenStudy::leaveParticipant()
{
    if (m_station) m_station->leaveParticipant();
}

void OpenStudy::storeLatency(const database::OperatorLatency& run)
{
    if (m_station)
        m_station->storeLatency(run);
    else
        recordOperatorLatency(static_cast<database::StudyStore&>(*m_store), run);
}

QString OpenStudy::name() const { return QString::fromStdString(m_facts.name); }

int StudyOverview::placesIn(database::SlotState state) const
{
    return static_cast<int>(
        std::count_if(places.begin(), places.end(), [state](const ParticipantPlace& p) { return p.state == state; }));
}

bool StudyOverview::hasHeldPlace() const { return std::ranges::any_of(places, &ParticipantPlace::isHeld); }

StudyOverview OpenStudy::overview() const
{
    auto stored = m_store->answerCounts();
    StudyOverview seen{name(),
                       QString::fromStdString(m_store->folder().folder.string()),
                       {},
                       m_protocol.answersPerParticipant(),
                       QString::fromStdString(m_store->nextParticipantId().value),
                       m_station != nullptr};
    std::map<int, std::vector<StudyOverview::ParticipantPlace>> places;  // by number, also of those that the server holds back
    for (const auto& one : m_store->enrolments())
        places[one.slot].push_back(
            {one.slot, one.state, QString::fromStdString(one.participant.value), one.kind, stored[one.participant]});
    for (auto& [number, those] : places) those.back().isHeld = true;
    for (const auto& slot : m_store->slots()) {
        auto& those = places[slot.number];
        if (!those.empty()) those.back().isHeld = false;
        if (slot.state == database::SlotState::Free) those.push_back({slot.number, slot.state, {}, slot.kind, 0});
    }
    for (const auto& [number, those] : places) std::ranges::copy(those, std::back_inserter(seen.places));
    return seen;
}

QStringList OpenStudy::codesOnPieces() const
{
    if (m_station) return {};
    const auto slots = m_store->slots();
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
    for (const auto& enrolment : m_store->enrolments()) {
        const auto events = m_store->events(enrolment.participant);
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
        session::requireKeptProtocol(*m_store);
        return {};
    } catch (const protocols::Error& fault) {
        // Both remedies write to the study, which this window keeps locked.
        return QCoreApplication::translate("study::app::OpenStudy", "%1. First close the study in this window (Esc).")
            .arg(inOwnLanguage(fault.what()));
    }
}

}  // namespace study::app
