// The rehearsal of the open study: its page, and the small study that is played from it.
#pragma once

#include <QObject>
#include <filesystem>
#include <memory>

#include "study/app/state/open_study.h"
#include "study/app/state/rehearsal.h"

namespace rendering {
class HapticDisplay;
}

namespace study::app {

class DisplayChoice;
class SessionRoom;
class WindowPages;

class RehearsalRoom : public QObject {
    Q_OBJECT
public:
    /// All references outlive the room. `make` may be empty; `openStudy`: the window's own.
    RehearsalRoom(MakeRehearsal make, const std::unique_ptr<OpenStudy>& openStudy, WindowPages& pages,
                  DisplayChoice& displayChoice, SessionRoom& session);
    ~RehearsalRoom() override { close(); }

    /// Whether the page of the rehearsal is in use, perhaps behind another page.
    bool isInUse() const { return m_isInUse; }
    /// Whether the session is one of the rehearsal.
    bool isPlaying() const { return m_played != nullptr; }
    /// Connects the display to see whether it is there, and shows the page.
    void show();
    /// Closes the study that was played, and shows the page. `isWhole`: its session was played to its end.
    void leaveSession(bool isWhole);

Q_SIGNALS:
    /// The operator goes back to the study.
    void left();

private:
    void connectPages();
    /// `displayName`: empty if no display is connected.
    void present(const QString& displayName);
    void requestSession();
    void play(std::unique_ptr<rendering::HapticDisplay> display);
    void close();

    MakeRehearsal m_make;
    const std::unique_ptr<OpenStudy>& m_openStudy;
    WindowPages& m_pages;
    DisplayChoice& m_displayChoice;
    SessionRoom& m_session;
    std::shared_ptr<const std::filesystem::path> m_folder;
    std::unique_ptr<OpenStudy> m_played;  ///< closes before its folder vanishes
    bool m_isInUse = false;
};

}  // namespace study::app
