// What the pages of a running session have in common: they are given a view, show it, and ask for events.
#pragma once

#include <QWidget>

#include "study/app/state/session_facts.h"
#include "study/session/driver.h"

namespace study::app {

class StagePage : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;

    /// A session starts or goes on in this window.
    virtual void begin(const SessionFacts&) {}
    /// Only of a stage that the page is for.
    virtual void present(const session::View& view) = 0;
    /// Whether the hand writes text there, so that letters are no keys.
    virtual bool isForWriting() const { return false; }
    /// A key without modifiers that no control took; true where the page acts on it.
    virtual bool pressKey(int key) = 0;
    /// The control where the hand starts.
    virtual QWidget& firstFocus() = 0;

Q_SIGNALS:
    void eventRequested(const study::session::EventBody& event);
    /// Something to tell the operator without asking the engine; empty: what was told is settled.
    void hinted(const QString& text);
};

inline bool isEnter(int key) { return key == Qt::Key_Return || key == Qt::Key_Enter; }

}  // namespace study::app
