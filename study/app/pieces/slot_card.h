// Card of one tray slot: its letter, the code of the piece that belongs there, large enough to be read from two metres, and what
// the operator does with it now.
#pragma once

#include <QFrame>

class QLabel;

namespace study::app {

class SlotCard : public QFrame {
    Q_OBJECT
public:
    SlotCard(const QString& letter, QWidget* parent);

    /// `act`: "stays", "put here"; `isNew`: the operator must act. `hasLetter`: false if the tray has only one slot.
    void showPiece(const QString& piece, const QString& act, bool isNew, bool hasLetter);
    /// Marks the piece as confirmed, or takes the mark back.
    void setConfirmed(bool isConfirmed);

private:
    void describe();

    QLabel* m_letter;
    QString m_act;
    QLabel* m_tag;
    QLabel* m_piece;
};

}  // namespace study::app
