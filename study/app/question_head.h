// The upper part of both question pages: which presentation, what to say to the participant, and the mark
// of the first touch.
#pragma once

#include "study/session/driver.h"

#include <QWidget>

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
    QLabel* m_way;
};

/// The button that stamps the first touch, and that it has been stamped.
class TouchButton : public QWidget {
    Q_OBJECT
public:
    explicit TouchButton(QWidget* parent);

    void present(const session::View& view);

Q_SIGNALS:
    void touched();

private:
    QPushButton* m_button;
};

}  // namespace study::app
