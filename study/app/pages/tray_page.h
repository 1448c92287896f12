// Page before a presentation: what to take off, move and put on, and one card for each tray slot with the piece that belongs
// there. Where the protocol asks for it, every piece is confirmed by its code, scanned or typed. The code of the presentation is
// small, because nobody needs it during a session.
#pragma once

#include <optional>

#include "study/app/pages/stage_page.h"

class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace study::app {

class SlotCard;

class TrayPage : public StagePage {
    Q_OBJECT
public:
    explicit TrayPage(QWidget* parent);

    /// Sets the codes of the pieces that were last confirmed to lie on the tray; empty if unknown.
    void setPlaced(const std::vector<std::string>& pieces) { m_placed = pieces; }

    void begin(const SessionFacts& facts) override;
    void present(const session::View& view) override;
    bool isForWriting() const override { return m_confirmsPieces; }
    int lettersTaken() const override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

private:
    QString actOf(const session::View& view, std::size_t place) const;
    void showCards(const session::View& view);
    void takePiece();
    void showConfirmed();
    void confirm();

    std::vector<std::string> m_placed, m_wanted;
    std::vector<std::string> m_confirmed;    ///< in the order of the slots
    std::optional<std::int64_t> m_shownFor;  ///< time when the shown tray was asked for
    bool m_confirmsPieces = false;
    bool m_isTypedAhead = false;  ///< a key of an answer came before its question
    QLabel* m_code;
    QLabel* m_instruction;  ///< of the block; hidden where the protocol gives none
    QLabel* m_task;
    QWidget* m_slots;  ///< holds the grid of the cards, from left to right like the tray
    QGridLayout* m_grid;
    std::vector<SlotCard*> m_cards;  ///< at least one for each slot; unused cards are hidden
    QLineEdit* m_piece;              ///< for the code of the next piece; hidden where pieces are not confirmed
    QLabel* m_stroke;
    QPushButton* m_ready;
};

}  // namespace study::app
