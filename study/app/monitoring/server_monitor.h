// Progress of a study on a server for the monitor: participants, and stations with their queues. Other threads ask the server,
// so a silent server stops nobody. The folder of the study's owner adds the stages of participants; an address alone gives their
// states and counts.
#pragma once

#include <QObject>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "database/server/server_progress.h"
#include "protocols/files/temporary_folder.h"
#include "study/app/monitoring/unawaited_work.h"
#include "study/app/state/in_background.h"
#include "study/app/state/monitor.h"
#include "study/session/clock.h"

namespace study::app {

class ServerMonitor : public QObject {
    Q_OBJECT
public:
    /// `ownersFolder`: empty where only the address is known.
    ServerMonitor(database::ServerAddress address, std::filesystem::path ownersFolder, std::shared_ptr<session::Clock> clock,
                  QObject* parent);

    /// Asks the server again. The reply comes by read().
    void refresh();
    /// Opens the rows of the last overview, on any thread; empty without the owner's folder.
    std::function<database::StudyStore()> openLast() const;

Q_SIGNALS:
    /// A reply arrived, or the reason why there is none: one sentence, else empty.
    void read(const study::app::MonitorOverview& overview, const QString& fault);

private:
    void look();
    void fetchRows();
    void readRows(std::shared_ptr<const protocols::TemporaryFolder> rows);
    void tell();
    QString fault() const;

    database::ServerAddress m_address;
    std::filesystem::path m_folder;
    std::shared_ptr<session::Clock> m_clock;
    database::ProgressWatch m_watch;
    std::chrono::steady_clock::time_point m_fetchedAt = {}, m_readAt = {};
    std::shared_ptr<const protocols::TemporaryFolder> m_rows;  ///< those of m_details
    std::optional<MonitorOverview> m_details;
    std::string m_headOfRows;
    QString m_fetchFault;
    UnawaitedWork m_fetching;
    InBackground m_reading;
};

/// The monitor of a study on a server: of an address, or of a folder with a note (server.json). Null for a study in a folder.
/// Throws badInput for an address or a note that cannot be read.
ServerMonitor* serverMonitorOf(const std::filesystem::path& place, const std::shared_ptr<session::Clock>& clock, QObject* parent);

}  // namespace study::app
