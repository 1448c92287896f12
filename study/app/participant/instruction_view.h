// An instruction as a widget, for eyes two metres away: title, sentences, statement or questions, the line of the scale with its
// mark, the clock of a break. The text grows with the widget. Nothing in it can be clicked or typed.
#pragma once

#include <QWidget>

#include "study/participant/instruction.h"

class QLabel;
class QTimer;

namespace study::app {

class ParticipantSide;
class ScaleLine;

class InstructionView : public QWidget {
    Q_OBJECT
public:
    /// Shows what `side` shows, which must outlive this widget.
    InstructionView(const ParticipantSide& side, QWidget* parent);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void present();
    void presentScale(const participant::Instruction& instruction);
    void showClock();
    void grow();

    const ParticipantSide& m_side;
    QLabel* m_title;
    QLabel* m_lines;
    QLabel* m_statement;
    QLabel* m_feedback;
    QLabel* m_question;
    ScaleLine* m_scale;
    QWidget* m_ends;
    QLabel* m_low;
    QLabel* m_high;
    QLabel* m_count;
    QLabel* m_clock;
    QTimer* m_tick;
};

}  // namespace study::app
