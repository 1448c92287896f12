// Debriefing at the end of the session: the participant's comments in free words. They can be erased later.
#pragma once

#include "study/app/pages/stage_page.h"

namespace study::app {

class StepList;
class WordsField;

class DebriefingPage : public StagePage {
    Q_OBJECT
public:
    explicit DebriefingPage(QWidget* parent);

    void begin(const SessionFacts& facts) override;
    void present(const session::View&) override {}
    bool isForWriting() const override { return true; }
    bool hasUnstoredText() const override;
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    int largestType() const override { return 200; }

private:
    void confirm();

    StepList* m_steps;
    WordsField* m_notes;
};

}  // namespace study::app
