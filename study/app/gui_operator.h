// Does on the real widgets what an experimenter's hands would: given the next event of a script, types
// the keys that lead to it and checks that the window sent just that event. For `replay --gui`
// and for tests; needs no test library.
#pragma once

#include <QPoint>
#include <QString>
#include <optional>

#include "study/app/main_window.h"
#include "study/session/driver.h"

namespace study::app {

class GuiOperator {
public:
    /// The window must outlive the hands, and a session must be running in it when they are used.
    explicit GuiOperator(MainWindow& window) : m_window(window) {}

    /// The engine's refusal where it refused. Throws workFailed where a widget is missing, hidden or off or
    /// where another event came out, and passes on faults of disk and display.
    std::optional<session::Refusal> perform(const session::EventBody& event);

    const session::View& view() const;
    const session::Plan& plan() const;

    // ---- the single movements, for tests that go their own way
    void pressKey(int key);
    /// Types into whatever has the focus.
    void type(const QString& text);
    /// Empties the field that has the focus.
    void clear();
    /// By object name, on the page that is now to be seen.
    void click(const QString& objectName);
    void clickAt(QWidget& target, const QPoint& point);
    void focusOn(const QString& objectName);
    /// Seen and on; throws workFailed where there is none.
    QWidget& widget(const QString& objectName) const;
    /// A later sitting's refresher and checklist are offered before it goes on.
    bool isOfferedPreparation() const;

private:
    SessionController& controller() const;
    QWidget& focus() const;

    MainWindow& m_window;
};

}  // namespace study::app
