// The card of one tray slot: its letter, the piece that belongs there, and whether the hand has to put it there.
#pragma once

#include <QFrame>

class QLabel;

namespace study::app {

class SlotCard : public QFrame {
    Q_OBJECT
public:
    SlotCard(const QString& letter, QWidget* parent);

    /// `hasLetter`: not where the tray has one slot only.
    void showPiece(const QString& piece, bool isNew, bool hasLetter);

private:
    QLabel* m_letter;
    QLabel* m_tag;
    QLabel* m_piece;
};

}  // namespace study::app
