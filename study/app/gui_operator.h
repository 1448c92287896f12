// Operates the real widgets as an experimenter does. For the next event of a script it types the keys that lead to the
// event, then checks that the window sent exactly this event. Used by `replay --gui` and by tests; needs no test library.
#pragma once

#include <QPoint>
#include <QString>
#include <optional>

#include "study/app/main_window.h"
#include "study/session/driver.h"

namespace study::app {

class GuiOperator {
public:
    /// The window must outlive this object. A session must be running in it during every call.
    explicit GuiOperator(MainWindow& window) : m_window(window) {}

    /// Performs the event and returns the engine's refusal, if any. Throws workFailed if a widget is missing, hidden or
    /// disabled, or if the window sent another event. Faults of disk and display pass through.
    std::optional<session::Refusal> perform(const session::EventBody& event);

    const session::View& view() const;
    const session::Plan& plan() const;

    // ---- single actions, for tests that need their own sequence
    void pressKey(int key);
    /// Types into the widget that has the focus.
    void type(const QString& text);
    /// Empties the field that has the focus.
    void clear();
    /// Clicks the widget with this object name on the current page.
    void click(const QString& objectName);
    void clickAt(QWidget& target, const QPoint& point);
    void focusOn(const QString& objectName);
    /// The visible and enabled widget of this name; throws workFailed if there is none.
    QWidget& widget(const QString& objectName) const;
    /// True while the window offers the refresher and the checklist of a later sitting.
    bool isOfferedPreparation() const;

private:
    SessionController& controller() const;
    QWidget& focus() const;

    MainWindow& m_window;
};

}  // namespace study::app
