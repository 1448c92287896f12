// Page before a presentation: its code and one card for each tray slot with the piece of fabric that belongs there. Cards
// whose piece changed are marked. The page also shows the words to say about stroking.
#pragma once

#include "study/app/pages/stage_page.h"

class QGridLayout;
class QLabel;
class QPushButton;

namespace study::app {

class SlotCard;

class TrayPage : public StagePage {
    Q_OBJECT
public:
    explicit TrayPage(QWidget* parent);

    /// Sets the pieces that were last confirmed to lie on the tray; empty if unknown.
    void setPlaced(const std::vector<protocols::FabricId>& fabrics) { m_placed = fabrics; }

    void begin(const SessionFacts& facts) override;
    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

private:
    bool isNew(const session::View& view, std::size_t place) const;
    void showCards(const session::View& view);

    std::vector<protocols::FabricId> m_placed;
    QLabel* m_code;
    QLabel* m_task;
    QGridLayout* m_grid;
    std::vector<SlotCard*> m_cards;  ///< at least one for each slot; unused cards are hidden
    QLabel* m_stroke;
    QPushButton* m_ready;
};

}  // namespace study::app
