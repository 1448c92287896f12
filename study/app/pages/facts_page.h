// Questions of the protocol about the participant. Every answer is voluntary and can be erased later.
#pragma once

#include "study/app/pages/stage_page.h"

class QLabel;
class QPushButton;

namespace study::app {

class LineForm;

class FactsPage : public StagePage {
    Q_OBJECT
public:
    explicit FactsPage(QWidget* parent);

    void begin(const SessionFacts& facts) override;
    void present(const session::View&) override {}
    bool isForWriting() const override { return true; }
    bool hasUnstoredText() const override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    int largestType() const override { return 190; }
    QWidget* pinned() override;

private:
    void confirm();

    QLabel* m_rights;  ///< what the participant may leave out
    LineForm* m_form;
    QPushButton* m_action;
};

}  // namespace study::app
