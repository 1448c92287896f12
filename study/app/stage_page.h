// What the pages of a running session have in common: they are given a view, show it, and ask for events.
#pragma once

#include "study/app/session_controller.h"

#include <QWidget>

namespace study::app {

class StagePage : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;

    virtual void present(const session::View& view) = 0;
    /// A key without modifiers that no control took; true where the page acts on it.
    virtual bool pressKey(int key) = 0;
    /// The control where the hand starts.
    virtual QWidget& firstFocus() = 0;

Q_SIGNALS:
    void eventAsked(const study::session::EventBody& event);
    /// Something to tell the operator without asking the engine.
    void hinted(const QString& text);
};

inline bool isEnter(int key)
{
    return key == Qt::Key_Return || key == Qt::Key_Enter;
}

/// "A", "B", ... for tray slots from 0.
inline QString slotLetter(std::size_t place)
{
    return QString(QChar(static_cast<char16_t>(u'A' + place)));
}

}  // namespace study::app
