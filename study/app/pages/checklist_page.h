// The protocol's checklist before the first presentation of a sitting: every line must be ticked; readings of
// instruments are written if there are any. Stamped when it is done.
#pragma once

#include <QCheckBox>

#include "study/app/pages/stage_page.h"

class QPushButton;
class QVBoxLayout;

namespace study::app {

class LineForm;

class ChecklistPage : public StagePage {
    Q_OBJECT
public:
    explicit ChecklistPage(QWidget* parent);

    /// All lines open.
    void begin(const SessionFacts& facts) override;
    void present(const session::View&) override {}
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

    /// Enter goes on with the page, also from a box (some desktops would let it tick the box); a click on the
    /// text beside a box ticks it.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QWidget* rowFor(const QString& line);
    void confirm();
    QCheckBox* firstUnticked() const;

    QVBoxLayout* m_rows;
    std::vector<QCheckBox*> m_boxes;  ///< each in a row with its text
    LineForm* m_readings;
    QPushButton* m_action;
};

}  // namespace study::app
