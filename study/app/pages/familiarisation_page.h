// Familiarisation with the display before anything is scored: steps for the operator, and fabrics that are not in the
// study. The number of a fabric puts its image on the display.
#pragma once

#include "study/app/pages/stage_page.h"

class QLabel;
class QPushButton;

namespace study::app {

class StepList;

class FamiliarisationPage : public StagePage {
    Q_OBJECT
public:
    explicit FamiliarisationPage(QWidget* parent);

    void begin(const SessionFacts& facts) override;
    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    int largestType() const override { return 150; }

private:
    void setFabrics(const std::vector<std::string>& fabrics);
    void showSteps();

    QString m_strokeWords, m_saySoon;
    std::vector<std::string> m_fabrics;
    StepList* m_steps;
    QWidget* m_fabricsRow;
    std::vector<QPushButton*> m_buttons;
    QLabel* m_shown;
    QPushButton* m_action;
};

}  // namespace study::app
