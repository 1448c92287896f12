// Stack of the pages of all stages and of the panels that the operator opens. Decides which page belongs to a stage.
#pragma once

#include <QScrollArea>
#include <QStackedWidget>
#include <vector>

#include "study/app/pages/stage_page.h"

namespace study::app {

class ChecklistPage;
class CorrectionPanel;
class GuidePage;
class ReasonPanel;
class TrayPage;

class StageStack : public QStackedWidget {
    Q_OBJECT
public:
    explicit StageStack(QWidget* parent);

    GuidePage& guide() const { return *m_guide; }
    TrayPage& tray() const { return *m_tray; }
    ChecklistPage& checklist() const { return *m_checklist; }
    CorrectionPanel& correction() const { return *m_correction; }
    ReasonPanel& reason() const { return *m_reason; }

    void begin(const SessionFacts& facts);
    /// The page of `stage`, even while a panel or a guide is in front of it.
    StagePage& pageOf(const session::Stage& stage) const;
    /// Shows the page from its top and focuses its first control. Scrolls to that control if it is a text field.
    void bringForward(StagePage& page);
    /// Scrolls to the message of the page in front, and then to the text field that has the focus. Emits messageHidden() if the
    /// area then does not show the whole message, and later if it is scrolled away.
    void showMessage(QWidget& message);
    /// Scrolls on Page Up and Page Down; returns false for other keys.
    bool scrollBy(int key);

Q_SIGNALS:
    void patternRequested(const std::optional<rendering::TestPattern>& pattern);
    void eventRequested(const study::session::EventBody& event);
    void answerMarked(study::app::AnswerMark mark);
    void hinted(const QString& text);
    void mended();
    void panelCloseRequested();
    void messageHidden();

private:
    struct PageOfStage;
    template <class Page>
    Page* add(const char* areaName);

    void checkMessage();
    void checkMessageSoon();
    QScrollArea& areaAt(int place) const { return *m_areas[static_cast<std::size_t>(place)]; }

    QWidget* m_message = nullptr;       ///< the one that was shown last
    std::vector<QScrollArea*> m_areas;  ///< in the order of the stack
    std::vector<StagePage*> m_pages;    ///< in the order of the stack
    GuidePage* m_guide;
    StagePage* m_facts;
    StagePage* m_familiarisation;
    StagePage* m_scaleTraining;
    ChecklistPage* m_checklist;
    TrayPage* m_tray;
    StagePage* m_question;
    StagePage* m_debriefing;
    CorrectionPanel* m_correction;
    ReasonPanel* m_reason;
};

}  // namespace study::app
