// One running session: header, the page of its stage, footer, and in the stage's place the panels that are
// opened by wish. Shows what it is given and asks for events; the engine is elsewhere.
#pragma once

#include <QWidget>

#include "study/app/state/session_controller.h"

namespace study::app {

class MessageBar;
class SessionFooter;
class SessionHeader;
class StagePage;
class StageStack;

class SessionPage : public QWidget {
    Q_OBJECT
public:
    explicit SessionPage(QWidget* parent);

    /// A session starts or goes on in this window: nothing is known of the tray, no box is ticked.
    void begin(const SessionFacts& facts);
    void present(const session::View& view, bool canCorrect);
    /// The panel to correct one of these, the last one first; at least one.
    void openCorrection(const std::vector<Correctable>& answers);
    /// An event was accepted: messages and panels go.
    void closePanelAndMessage();
    void showMessage(const QString& text, Tone tone);
    const session::View& shownView() const { return m_view; }

    /// A later sitting has begun, and its refresher and checklist are offered now.
    bool offersPreparation() const;

    /// A key that no control took; true where something came of it.
    bool pressKey(int key);

Q_SIGNALS:
    void eventRequested(const study::session::EventBody& event);
    void correctionRequested();
    /// The session shall be left, after a pause where it still runs.
    void leaveRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void connectPanels();
    void bindKeysWhileWriting();
    StagePage& pageOf(const session::View& view) const;
    StagePage& pageInFront() const;
    void bringForward(StagePage& page);
    void openPanel(StagePage& panel);
    void closePanel();
    void goOnUnprepared();
    /// Of the presentation that a void or flag is about; empty: the one before the tray that is being laid.
    QString codeMeant() const;
    bool pressFocusedButton() const;

    SessionFacts m_facts;
    session::View m_view;
    bool m_isPreparationDeclined = false;
    StagePage* m_panel = nullptr;  ///< the open one

    SessionHeader* m_header;
    StageStack* m_stages;
    MessageBar* m_message;
    SessionFooter* m_footer;
};

}  // namespace study::app
