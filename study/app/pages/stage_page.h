// Common interface of the pages of a running session: they receive a view, show it and request events.
#pragma once

#include <QVBoxLayout>
#include <QWidget>

#include "study/app/state/answer_mark.h"
#include "study/app/state/session_facts.h"
#include "study/app/state/tried_display.h"
#include "study/session/driver.h"

namespace study::app {

class StagePage : public QWidget {
    Q_OBJECT
public:
    using QWidget::QWidget;

    /// Takes the message of the session into the page, beside the control that messages are about.
    void take(QWidget& message) const
    {
        if (m_messagePlace->indexOf(&message) < 0) m_messagePlace->addWidget(&message);
    }

    /// Resets the page for a session that starts or continues.
    virtual void begin(const SessionFacts&) {}
    /// Shows `view`, whose stage must belong to this page.
    virtual void present(const session::View& view) = 0;
    /// True if the page has a text field, so that letters are text and not commands.
    virtual bool isForWriting() const { return false; }
    /// Number of letters, from A on, that the page takes for answers or text. Commands with these keys need Alt.
    virtual int lettersTaken() const { return isForWriting() ? 26 : 0; }
    /// True while the page holds a text of the operator that is not stored and would be lost with the window.
    virtual bool hasUnstoredText() const { return false; }
    /// Handles a key without modifiers that no control used; returns whether it had an effect.
    virtual bool pressKey(int key) = 0;
    /// Empties an entry that a barcode scanner typed, where it could be taken for an answer.
    virtual void discardEntry() {}
    /// The control that has the focus at first.
    virtual QWidget& firstFocus() = 0;
    /// The control below the answer, which must be in view together with it; null on pages that are read from their top.
    virtual QWidget* lastOfAnswer() { return nullptr; }
    /// The control that stays in view below a page whose protocol may give it any number of lines; null on other pages.
    virtual QWidget* pinned() { return nullptr; }
    /// The largest type that the page takes where the window has room for it, percent of the usual one.
    virtual int largestType() const { return 100; }

Q_SIGNALS:
    void eventRequested(const study::session::EventBody& event);
    void answerMarked(study::app::AnswerMark mark);
    /// A hint for the operator that does not come from the engine; empty clears the last hint.
    void hinted(const QString& text);
    /// The operator changed the entry that the last hint was about.
    void mended();
    /// The page shows another text, whose type may have another size.
    void textChanged();
    /// The operator switches a test pattern of the display on, or off (none).
    void patternRequested(const std::optional<rendering::TestPattern>& pattern);

protected:
    /// Every page puts this empty layout beside the controls that its messages are about.
    QVBoxLayout* m_messagePlace = new QVBoxLayout;
};

inline bool isEnter(int key) { return key == Qt::Key_Return || key == Qt::Key_Enter; }

}  // namespace study::app
