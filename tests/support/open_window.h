// A small study in the real window, with a clock that stands still, a display that can fail, and an operator.
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

/// Base of the window tests: a temporary folder with studies.
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

/// Calls that the display received, shared with the test. The display fails while `fault` is not empty.
struct DisplayRecord {
    std::vector<std::string> calls;
    std::string fault;
    bool reportsTouches = false;
    std::function<void()> touch;  ///< simulates the touch of a finger; empty without a session
};

class OpenWindow {
public:
    /// Opens `study` and shows the window.
    explicit OpenWindow(const database::StudyFolder& study, const study::app::AppOptions& options = {});
    /// `display`: initial state of the display.
    OpenWindow(const database::StudyFolder& study, const study::app::AppOptions& options, const DisplayRecord& display);

    study::app::MainWindow& window() { return *m_window; }
    study::app::GuiOperator& gui() { return m_gui; }
    study::session::VirtualClock& clock() { return *m_clock; }
    DisplayRecord& display() { return *m_display; }
    const study::session::View& view() { return m_gui.view(); }

    /// Performs an event by keys. Throws if the engine refuses it, so that the test fails.
    void perform(const study::session::EventBody& event);
    /// Enrols the participant and plays to the first tray.
    void enrolAndBegin(const std::string& participant = "P01");
    /// Plays by keys to the stage with this name ("Presenting", …) and, if given, to this question.
    void playTo(const std::string& stage, const std::string& question = "");
    void playToEnd();
    /// The event that continues the session from the current view.
    study::session::EventBody nextEvent();

    template <class Widget>
    Widget& widget(const char* objectName)
    {
        for (Widget* found : m_window->currentPage()->template findChildren<Widget*>(QString::fromLatin1(objectName)))
            if (found->isVisible()) return *found;
        throw std::logic_error(std::string(objectName) + " is not visible");
    }
    /// Text of the message on the page; empty if none is visible.
    QString message(const char* objectName = "sessionMessage");

private:
    std::shared_ptr<DisplayRecord> m_display;
    std::shared_ptr<study::session::VirtualClock> m_clock;
    std::unique_ptr<study::app::MainWindow> m_window;
    study::app::GuiOperator m_gui;
};

/// Every text that `root` and the widgets in it show, or give to a screen reader.
std::vector<QString> textsIn(const QWidget& root);

/// Texts that contain one of the words as a whole token. "h&f" and "h_g+f_g" are single tokens.
std::vector<QString> textsNaming(const std::set<QString>& words, const std::vector<QString>& texts);

}  // namespace tests::support
