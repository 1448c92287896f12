// Card of one tray slot: its letter, the piece of fabric that belongs there, and whether the operator must put it there now.
#pragma once

#include <QFrame>

class QLabel;

namespace study::app {

class SlotCard : public QFrame {
    Q_OBJECT
public:
    SlotCard(const QString& letter, QWidget* parent);

    /// `hasLetter`: false if the tray has only one slot.
    void showPiece(const QString& piece, bool isNew, bool hasLetter);

private:
    QLabel* m_letter;
    QLabel* m_tag;
    QLabel* m_piece;
};

}  // namespace study::app
