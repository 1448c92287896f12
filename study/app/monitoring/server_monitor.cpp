#include "study/app/monitoring/server_monitor.h"

#include <QTimer>

#include "database/disk/server_note.h"
#include "database/server/study_move.h"
#include "study/app/language/app_text.h"
#include "study/app/language/below.h"

namespace study::app {

namespace {

using namespace std::chrono_literals;
using FetchedRows = std::shared_ptr<const protocols::TemporaryFolder>;

constexpr int msBetweenLooks = 100;
constexpr auto betweenFetches = 4s;
constexpr auto longestFetch = 60s;     ///< then another thread tries
constexpr auto betweenReadings = 20s;  ///< of the same rows, because the times since the last entries grow

QString wordOfState(database::SlotState state)
{
    switch (state) {
        case database::SlotState::Free:
            return AppText::tr("free");
        case database::SlotState::Started:
            return AppText::tr("in progress");
        case database::SlotState::Finished:
            return AppText::tr("finished");
        case database::SlotState::Withdrawn:
            return AppText::tr("withdrawn");
    }
    return {};
}

/// The study's own rows do not tell which places the server holds back.
void markHeldPlaces(MonitorOverview& overview, const database::ServerProgress& progress)
{
    auto held = database::heldPlaces(progress);
    std::erase_if(overview.rows, [&](const MonitorOverview::ParticipantRow& row) {
        return row.state == database::SlotState::Free && held.contains(row.place);
    });
    for (auto row = overview.rows.rbegin(); row != overview.rows.rend(); ++row)
        if (held.erase(row->place) > 0 && row->state == database::SlotState::Withdrawn)
            row->stage = AppText::tr("withdrawn, waits for the owner");
}

MonitorOverview overviewOf(const database::ServerProgress& progress)
{
    MonitorOverview seen;
    seen.isBlinded.reset();
    seen.answers = 0;
    for (const database::PlaceSeen& place : progress.places) {
        MonitorOverview::ParticipantRow row{.place = place.slot, .state = place.state, .kind = place.kind};
        row.participant = QString::fromStdString(place.participant);
        row.stage = wordOfState(place.state);
        row.answers = place.answers;
        if (place.state != database::SlotState::Withdrawn) seen.answers += place.answers;
        seen.rows.push_back(row);
    }
    return seen;
}

/// Also of earlier connections whose entries may still wait. `age`: time since this reply; `isOld`: later questions had no reply.
std::vector<MonitorOverview::StationRow> stationRows(const database::ServerProgress& progress, std::chrono::seconds age,
                                                     bool isOld)
{
    using Contact = MonitorOverview::StationRow::Contact;
    std::vector<MonitorOverview::StationRow> rows;
    for (const database::StationSeen& one : progress.stations)
        rows.push_back({QString::fromStdString(one.station), QString::fromStdString(one.participant),
                        isOld          ? Contact::Unknown
                        : one.isLost() ? Contact::Lost
                                       : Contact::Connected,
                        one.lastSeenSeconds + static_cast<int>(age.count()), one.waiting, QString::fromStdString(one.program)});
    for (const database::OwedSeen& one : progress.owed)
        rows.push_back({QString::fromStdString(one.station),
                        QString::fromStdString(one.participant),
                        Contact::Lost,
                        std::nullopt,
                        one.waiting,
                        {}});
    return rows;
}

}  // namespace

ServerMonitor::ServerMonitor(database::ServerAddress address, std::filesystem::path ownersFolder,
                             std::shared_ptr<session::Clock> clock, QObject* parent)
    : QObject(parent),
      m_address(std::move(address)),
      m_folder(std::move(ownersFolder)),
      m_clock(std::move(clock)),
      m_watch(m_address)
{
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, &ServerMonitor::look);
    timer->start(msBetweenLooks);
}

void ServerMonitor::refresh() { m_watch.ask(); }

void ServerMonitor::look()
{
    if (!m_watch.take()) return;
    if (m_watch.fault().empty()) fetchRows();
    tell();
}

void ServerMonitor::fetchRows()
{
    if (m_folder.empty() || m_reading.isBusy()) return;
    const auto now = std::chrono::steady_clock::now();
    if (m_watch.seen()->head == m_headOfRows) {
        if (now - m_readAt > betweenReadings) readRows(m_rows);
        return;
    }
    if (now - m_fetchedAt < (m_fetching.isBusy() ? longestFetch : betweenFetches)) return;
    m_fetchedAt = now;
    m_fetching.run(
        [this, folder = m_folder]() -> UnawaitedWork::Then {
            const FetchedRows rows = database::fetchedRows({folder});
            return [this, rows] { readRows(rows); };
        },
        [this](const QString& why) {
            m_fetchFault = why;
            tell();
        });
}

void ServerMonitor::readRows(FetchedRows rows)
{
    m_readAt = std::chrono::steady_clock::now();
    m_reading.run(
        [this, rows, now = m_clock->wallTime()](const std::atomic<bool>&) -> InBackground::Then {
            const database::StudyStore store({rows->path()}, database::StudyStore::Access::Read);
            return [this, rows, overview = monitorOverview(store, now), head = textOf(store.head())] {
                m_rows = rows;
                m_details = overview;
                m_headOfRows = head;
                m_fetchFault.clear();
                tell();
            };
        },
        [this](const QString& why) {
            m_fetchFault = why;
            tell();
        });
}

void ServerMonitor::tell()
{
    MonitorOverview overview;
    if (m_details)
        overview = *m_details;
    else if (m_watch.seen())
        overview = overviewOf(*m_watch.seen());
    else
        overview.isBlinded.reset();
    if (overview.study.isEmpty())
        overview.study = QString::fromStdString(m_address.study.empty() ? m_address.database : m_address.study);
    if (m_watch.seen()) {
        markHeldPlaces(overview, *m_watch.seen());
        overview.stations = stationRows(*m_watch.seen(), m_watch.age(), !m_watch.fault().empty());
    }
    Q_EMIT read(overview, fault());
}

QString ServerMonitor::fault() const
{
    if (m_watch.isAway())
        return tr("The server of %1 cannot be reached. The window shows what it read last and tries again every two seconds.")
            .arg(QString::fromStdString(m_address.text));
    const QString why = m_watch.fault().empty() ? m_fetchFault : inOwnLanguage(m_watch.fault());
    return why.isEmpty() ? why : tr("%1. The window tries again in two seconds.").arg(why);
}

std::function<database::StudyStore()> ServerMonitor::openLast() const
{
    if (!m_rows) return {};
    return [rows = m_rows] { return database::StudyStore({rows->path()}, database::StudyStore::Access::Read); };
}

ServerMonitor* serverMonitorOf(const std::filesystem::path& place, const std::shared_ptr<session::Clock>& clock, QObject* parent)
{
    if (database::isServerAddress(place.string()))
        return new ServerMonitor(database::serverAddressFrom(place.string()), {}, clock, parent);
    const auto note = database::readServerNote(place);
    if (!note) return nullptr;
    return new ServerMonitor(database::serverAddressFrom(note->address), note->isOwner ? place : std::filesystem::path(), clock,
                             parent);
}

}  // namespace study::app
