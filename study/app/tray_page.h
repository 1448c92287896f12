// Which fabrics go where before a presentation: the presentation's code, one card a tray slot, and what
// has to be changed since the last one marked.
#pragma once

#include "study/app/stage_page.h"

class QHBoxLayout;
class QLabel;
class QPushButton;

namespace study::app {

class TrayPage : public StagePage {
    Q_OBJECT
public:
    explicit TrayPage(QWidget* parent);

    /// The tray as it was last confirmed to lie there; empty when nobody knows.
    void setPlaced(const std::vector<protocols::FabricId>& fabrics) { m_placed = fabrics; }

    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

private:
    enum class Change { New, AsBefore };
    QWidget* cardFor(std::size_t place, const QString& fabric, Change change, bool isOnlyOne);
    Change changeOf(const session::View& view, std::size_t place) const;

    std::vector<protocols::FabricId> m_placed;
    QLabel* m_code;
    QLabel* m_task;
    QHBoxLayout* m_cards;
    QPushButton* m_ready;
};

}  // namespace study::app
