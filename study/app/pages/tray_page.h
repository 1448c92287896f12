// Which pieces of fabric go where before a presentation: the presentation's code, one card a tray slot, and what has
// to be changed since the last one marked; and the words to say about stroking.
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

    /// The tray as it was last confirmed to lie there; empty when nobody knows.
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
    std::vector<SlotCard*> m_cards;  ///< at least one a slot; those left over are hidden
    QLabel* m_stroke;
    QPushButton* m_ready;
};

}  // namespace study::app
