// A small study open in the real window, with a still clock, a display that can fail, and hands.
#pragma once

#include <QTemporaryDir>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "study/app/gui_operator.h"
#include "study/app/main_window.h"
#include "tests/support/study_builder.h"

namespace tests::support {

/// What tests of the window start from: a folder that goes with them, and studies in it.
class WindowTest : public QObject {
protected:
    database::StudyFolder newStudy(const StudyRecipe& recipe = {});
    QString filePath(const QString& name) const { return m_folder.filePath(name); }

private:
    QTemporaryDir m_folder;
    int m_made = 0;
};

/// A window on its start page.
struct ShownWindow {
    explicit ShownWindow(const study::app::AppOptions& options = {});

    template <class Widget>
    Widget& widget(const char* objectName)
    {
        return *window.findChild<Widget*>(QString::fromLatin1(objectName));
    }

    study::app::MainWindow window;
    study::app::GuiOperator gui;
};

/// What the display was calls, shared with the test; it fails while `fault` is not empty.
struct DisplayRecord {
    std::vector<std::string> calls;
    std::string fault;
    bool reportsTouches = false;
    std::function<void()> touch;  ///< as if a finger came down; empty without a session
};

class OpenWindow {
public:
    /// Opens `study` and shows the window.
    explicit OpenWindow(const database::StudyFolder& study, const study::app::AppOptions& options = {});
    /// With a display as the record says at the start.
    OpenWindow(const database::StudyFolder& study, const study::app::AppOptions& options, const DisplayRecord& display);

    study::app::MainWindow& window() { return *m_window; }
    study::app::GuiOperator& gui() { return m_gui; }
    study::session::VirtualClock& clock() { return *m_clock; }
    DisplayRecord& display() { return *m_display; }
    const study::session::View& view() { return m_gui.view(); }

    /// Performs an event by keys; a refusal fails the test that calls it.
    void perform(const study::session::EventBody& event);
    /// Enrols and goes on to the first tray.
    void enrolAndBegin(const std::string& participant = "P01");
    /// Plays by keys until the stage has the name ("Presenting" ...) and `question` is asked, if one is given.
    void playTo(const std::string& stage, const std::string& question = "");
    void playToEnd();
    /// The one event that leads on from here.
    study::session::EventBody nextEvent();

    template <class Widget>
    Widget& widget(const char* objectName)
    {
        for (Widget* found : m_window->currentPage()->template findChildren<Widget*>(QString::fromLatin1(objectName)))
            if (found->isVisible()) return *found;
        throw std::logic_error(std::string(objectName) + " is not to be seen");
    }
    /// Text of the message on the page; empty where none is shown.
    QString message(const char* objectName = "sessionMessage");

private:
    std::shared_ptr<DisplayRecord> m_display;
    std::shared_ptr<study::session::VirtualClock> m_clock;
    std::unique_ptr<study::app::MainWindow> m_window;
    study::app::GuiOperator m_gui;
};

/// Every text that a widget under `root` (or its title) can show or tell a screen reader.
std::vector<QString> textsIn(const QWidget& root);

/// Texts that hold one of the words as a whole token; "h&f" and "h_g+f_g" count as one.
std::vector<QString> textsNaming(const std::set<QString>& words, const std::vector<QString>& texts);

}  // namespace tests::support
