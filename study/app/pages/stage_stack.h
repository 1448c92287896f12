// The pages of a session's stages and the panels that are opened by wish, one of them in front. Which page a stage has
// is decided here.
#pragma once

#include <QStackedWidget>
#include <vector>

#include "study/app/pages/stage_page.h"

namespace study::app {

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
    CorrectionPanel& correction() const { return *m_correction; }
    ReasonPanel& reason() const { return *m_reason; }

    void begin(const SessionFacts& facts);
    /// The page of the stage itself, whatever else is to be said now.
    StagePage& pageOf(const session::Stage& stage) const;
    /// Read from its top, with the hand where it starts; where one types is in sight.
    void bringForward(StagePage& page);
    /// By the keys that turn pages; false for others.
    bool scrollBy(int key);

Q_SIGNALS:
    void eventRequested(const study::session::EventBody& event);
    void hinted(const QString& text);
    void panelCloseRequested();

private:
    struct PageOfStage;
    template <class Page>
    Page* add(const char* areaName);

    std::vector<StagePage*> m_pages;  ///< in the order of the stack
    GuidePage* m_guide;
    StagePage* m_facts;
    StagePage* m_familiarisation;
    StagePage* m_scaleTraining;
    StagePage* m_checklist;
    TrayPage* m_tray;
    StagePage* m_question;
    StagePage* m_debriefing;
    CorrectionPanel* m_correction;
    ReasonPanel* m_reason;
};

}  // namespace study::app
