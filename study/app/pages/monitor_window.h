// The window of the live monitor (monitor.h). AppearanceKeys again every two seconds; any number of them may be open beside
// the console, on the same computer or wherever the study's folder is shared.
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
    /// Throws protocols::Error where `study` is none.
    MonitorWindow(const std::filesystem::path& study, const AppOptions& options, QWidget* parent = nullptr);
    ~MonitorWindow() override;

    /// AppearanceKeys at the study now. What goes wrong is told on the page, and the next look tries again.
    void look();
    void setAppearance(const Appearance& appearance) { m_appearanceKeys->set(appearance); }

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void present(const MonitorOverview& overview);
    void showFlags(const std::vector<MonitorFlag>& flags);

    database::StudyStore m_store;
    std::shared_ptr<session::Clock> m_clock;
    std::optional<MonitorOverview> m_shown;
    int m_answersAtFlags = -1;  ///< as many there were when flags were last read
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
