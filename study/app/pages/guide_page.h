// Page that shows the operator what to do now and waits for one confirmation: welcome, consent, break, pause, end.
// Its texts come from stage_guides.h. They are as large as the window allows with the buttons still in view (page_fit.h).
#pragma once

#include <QElapsedTimer>
#include <chrono>

#include "study/app/pages/stage_guides.h"
#include "study/app/pages/stage_page.h"

class QLabel;
class QPushButton;
class QTimer;

namespace study::app {

class PageHead;
class StepList;

class GuidePage : public StagePage {
    Q_OBJECT
public:
    explicit GuidePage(QWidget* parent);

    void begin(const SessionFacts& facts) override { m_facts = facts; }
    /// Sets whether the page offers the refresher and the checklist of this sitting.
    void offerPreparation(bool isDue) { m_isPreparationDue = isDue; }
    void present(const session::View& view) override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    int largestType() const override { return 200; }

Q_SIGNALS:
    void leaveRequested();
    /// The operator skips the refresher and the checklist.
    void preparationDeclined();

private:
    void act(GuideAct act);
    void showClock();

    SessionFacts m_facts;
    bool m_isPreparationDue = false;
    Guide m_guide;
    std::chrono::milliseconds m_breakBefore{0};  ///< how long the break had lasted when it was shown
    QElapsedTimer m_sinceShown;
    QTimer* m_tick;
    QLabel* m_clock;  ///< how long the break has lasted
    PageHead* m_head;
    StepList* m_steps;
    QPushButton* m_action;
    QPushButton* m_second;
};

}  // namespace study::app
