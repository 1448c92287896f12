// Keeps key presses from the pages that nobody meant for them: repeats of a held key, and an Enter that bounces on the page of
// the study. Filters the keys of the whole window.
#pragma once

#include <QObject>
#include <memory>
#include <optional>

#include "study/app/state/held_keys.h"
#include "study/session/clock.h"

namespace study::app {

class WindowPages;

class StrayKeys : public QObject {
    Q_OBJECT
public:
    /// Made after `pages`, because the filter that is installed last sees a key first.
    StrayKeys(QWidget& window, WindowPages& pages, std::shared_ptr<const session::Clock> clock);

    /// Enter does nothing on the page of the study for a moment, and the page says so. It must not enrol the next participant.
    void holdEnterOfStudy() { m_enterHeldAtNs = m_clock->monotonicNs(); }
    bool isRepeat(const QKeyEvent& event) { return m_heldKeys.isRepeat(event); }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// Whether a key that is held down on `target` would run through pages: Enter, Space on a control, keys of a session.
    bool confirmsWhenHeld(int key, const QWidget& target) const;
    bool isEnterHeld() const;

    QWidget& m_window;
    WindowPages& m_pages;
    std::shared_ptr<const session::Clock> m_clock;
    HeldKeys m_heldKeys;
    std::optional<std::int64_t> m_enterHeldAtNs;
};

}  // namespace study::app
