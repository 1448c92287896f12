// Window of the live monitor (monitor.h). It updates every two seconds. Several may be open beside the console, on this
// computer or on another that shares the study folder. Of a study on a server it also shows the stations.
#pragma once

#include <QWidget>

#include "study/app/pieces/appearance_keys.h"
#include "study/app/state/app_options.h"
#include "study/app/state/monitor.h"

class QLabel;
class QTreeWidget;

namespace study::app {

class FlagReading;
class MessageBar;
class ServerMonitor;

class MonitorWindow : public QWidget {
    Q_OBJECT
public:
    /// `study`: its folder, or its address on a server. Throws protocols::Error for another folder or a wrong address. A server
    /// that cannot be reached is a line in the window.
    MonitorWindow(const std::filesystem::path& study, const AppOptions& options, QWidget* parent = nullptr);
    ~MonitorWindow() override;

    /// Reads the study now, or asks its server, whose reply is shown when it comes. A fault is shown in the window, and the next
    /// update tries again.
    void refresh();
    void setAppearance(const Appearance& appearance) { m_appearanceKeys->set(appearance); }

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void buildTables();
    void connectServer();
    void present(const MonitorOverview& overview);
    void presentRows(const MonitorOverview& overview);
    void presentStations(const std::vector<MonitorOverview::StationRow>& stations);
    void readFlags(const MonitorOverview& overview);
    void showFlags(const std::vector<MonitorFlag>& flags);

    std::filesystem::path m_study;
    std::shared_ptr<session::Clock> m_clock;
    ServerMonitor* m_server;                      ///< null for a study in a folder
    std::optional<database::StudyStore> m_store;  ///< of a study in a folder
    std::optional<MonitorOverview> m_shown;
    int m_answersAtFlags = -1;  ///< number of answers when the flags were last read
    AppearanceKeys* m_appearanceKeys;
    FlagReading* m_flagReading;
    QLabel* m_title;
    QLabel* m_summary;
    QTreeWidget* m_rows;
    QLabel* m_stationsCaption;
    QTreeWidget* m_stations;
    QLabel* m_flagsCaption;
    QLabel* m_flags;
    QLabel* m_hint;
    MessageBar* m_message;
};

}  // namespace study::app
