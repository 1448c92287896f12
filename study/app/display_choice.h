// The display of the sessions: which one the operator chose, its page, and the page that waits for its driver.
#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <string>

#include "study/app/state/app_options.h"
#include "study/app/state/display_opening.h"

namespace study::app {

class WindowPages;

class DisplayChoice : public QObject {
    Q_OBJECT
public:
    /// Takes the display of `options`, or the one of the last time where the operator named none.
    DisplayChoice(const AppOptions& options, WindowPages& pages);

    const std::string& specification() const { return m_specification; }
    /// Who runs the sessions, with what this display leaves behind.
    const session::OperatedBy& operatedBy() const { return m_operatedBy; }
    /// Scale of the display, mm per pixel, if the operator measured it.
    std::optional<double> mmPerPixel() const;
    /// Whether the operator chose to run sessions without a display.
    bool rehearses() const { return m_rehearses; }
    /// Why the display of the last time is not in use; empty if it is, or if there is none.
    const QString& faultOfLastTime() const { return m_faultOfLastTime; }

    /// Connects the display of the sessions, on the connecting page where its driver must be waited for. Then calls `use`, or
    /// `failed` with the reason; both show the page that comes next.
    void connectDisplay(DisplayOpening::Opened use, DisplayOpening::Failed failed);
    /// The connecting page is in front, and another page comes by itself.
    bool isConnecting() const { return m_opening.isOpening(); }

    /// Shows the page of the display. `why`: reason that the operator must choose one; empty if there is none.
    void show(const QString& why = {});
    /// The same for a session that waits: `begin` runs if the operator rehearses without a display.
    void showFor(const QString& why, std::function<void()> begin);
    /// Forgets the session that waits, and asks for the page that was there before.
    void leave();

Q_SIGNALS:
    void left();

private:
    void takeRemembered(const AppOptions& options);
    void connectPages();
    void take(const std::string& specification);
    void rehearse();
    void stopConnecting();

    WindowPages& m_pages;
    std::shared_ptr<QSettings> m_settings;
    std::string m_specification;
    session::OperatedBy m_operatedBy;
    bool m_rehearses;
    QString m_faultOfLastTime;
    DisplayOpening m_opening;
    DisplayOpening::Failed m_stopped;  ///< what follows when the operator stops connecting
    std::function<void()> m_waiting;   ///< begins the session that waits for a display; empty if none does
};

}  // namespace study::app
