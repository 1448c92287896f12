#include "study/app/stray_keys.h"

#include <QApplication>

#include "study/app/pages/session_page.h"
#include "study/app/pages/setup/keys_page.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/window_pages.h"

namespace study::app {

StrayKeys::StrayKeys(QWidget& window, WindowPages& pages, std::shared_ptr<const session::Clock> clock)
    : QObject(&window), m_window(window), m_pages(pages), m_clock(std::move(clock))
{
    qApp->installEventFilter(this);
}

bool StrayKeys::confirmsWhenHeld(int key, const QWidget& target) const
{
    if (isEnter(key)) return true;
    if (key == Qt::Key_Space) return !target.testAttribute(Qt::WA_InputMethodEnabled);  // Space presses buttons and boxes
    return m_pages.currentWidget() == m_pages.session && m_pages.keys->keys().isExtraKey(key);
}

bool StrayKeys::isEnterHeld() const
{
    constexpr std::int64_t bounceNs = 700'000'000;  // the usual dead time of a protocol
    return m_enterHeldAtNs && m_pages.currentWidget() == m_pages.study && m_clock->monotonicNs() - *m_enterHeldAtNs < bounceNs;
}

bool StrayKeys::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() != QEvent::KeyPress && event->type() != QEvent::KeyRelease) return QObject::eventFilter(watched, event);
    const auto& key = static_cast<const QKeyEvent&>(*event);
    const bool isRepeat = m_heldKeys.isRepeat(key);
    const auto* target = qobject_cast<QWidget*>(watched);
    if (event->type() != QEvent::KeyPress || !target || target->window() != &m_window)
        return QObject::eventFilter(watched, event);
    if (isRepeat && confirmsWhenHeld(key.key(), *target)) return true;
    if (!isEnter(key.key()) || !isEnterHeld()) return false;
    m_pages.study->showHint(bouncedKeyText());
    return true;
}

}  // namespace study::app
