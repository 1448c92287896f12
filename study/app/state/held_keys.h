// Recognises the repeats of a key that is held down. X11 sends most of them as a release and a press with the same time, and
// Qt then does not call them repeats. A key that bounces is no repeat: its second press has a time of its own.
#pragma once

#include <QKeyEvent>
#include <map>

namespace study::app {

class HeldKeys {
public:
    /// Takes the next press or release. True for a press that repeats a key which is still down. An event may be given again,
    /// as it goes from a control to its parents. A key event of no device has the time 0, ms.
    bool isRepeat(const QKeyEvent& event)
    {
        if (event.type() == QEvent::KeyRelease) m_releasedAtMs[event.key()] = event.timestamp();
        if (event.type() != QEvent::KeyPress) return false;
        const auto released = m_releasedAtMs.find(event.key());
        const bool isAtRelease = released != m_releasedAtMs.end() && released->second == event.timestamp();
        return event.isAutoRepeat() || (event.timestamp() != 0 && isAtRelease);
    }

private:
    std::map<int, quint64> m_releasedAtMs;  ///< last release of every key
};

}  // namespace study::app
