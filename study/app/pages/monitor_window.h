// Window of the live monitor (monitor.h). It updates every two seconds. Several may be open beside the console, on this
// computer or on another that shares the study folder.
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

class MonitorWindow : public QWidget {
    Q_OBJECT
public:
    /// Throws protocols::Error if `study` is not a study folder.
    MonitorWindow(const std::filesystem::path& study, const AppOptions& options, QWidget* parent = nullptr);
    ~MonitorWindow() override;

    /// Reads the study now. A fault is shown in the window, and the next update tries again.
    void refresh();
    void setAppearance(const Appearance& appearance) { m_appearanceKeys->set(appearance); }

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void present(const MonitorOverview& overview);
    void showFlags(const std::vector<MonitorFlag>& flags);

    std::filesystem::path m_study;
    database::StudyStore m_store;
    std::shared_ptr<session::Clock> m_clock;
    std::optional<MonitorOverview> m_shown;
    int m_answersAtFlags = -1;  ///< number of answers when the flags were last read
    AppearanceKeys* m_appearanceKeys;
    FlagReading* m_flagReading;
    QLabel* m_title;
    QLabel* m_summary;
    QTreeWidget* m_rows;
    QLabel* m_flagsCaption;
    QLabel* m_flags;
    MessageBar* m_message;
};

}  // namespace study::app
