// The upper part of a question page: which presentation, and what to say to the participant; and the mark of the first
// touch.
#pragma once

#include <QWidget>

#include "study/app/state/session_facts.h"
#include "study/session/driver.h"

class QLabel;
class QPushButton;

namespace study::app {

class QuestionHead : public QWidget {
    Q_OBJECT
public:
    explicit QuestionHead(QWidget* parent);

    void present(const session::View& view);

private:
    QLabel* m_caption;
    QLabel* m_words;
};

/// The button that stamps the first touch, and by whom it has been stamped.
class TouchButton : public QWidget {
    Q_OBJECT
public:
    explicit TouchButton(QWidget* parent);

    void begin(const SessionFacts& facts) { m_displayReports = facts.displayReportsTouches; }
    void present(const session::View& view);

Q_SIGNALS:
    void touched();

private:
    QString textFor(const session::View& view) const;

    bool m_displayReports = false;
    QPushButton* m_button;
};

}  // namespace study::app
