// Page of a running session: header, page of the current stage, footer. A panel that the operator opens takes the place of
// the stage page. The page shows a view and requests events; it contains no engine.
#pragma once

#include <QElapsedTimer>
#include <QWidget>

#include "study/app/state/answer_mark.h"
#include "study/app/state/held_keys.h"
#include "study/app/state/scanner_entry.h"
#include "study/app/state/session_controller.h"
#include "study/participant/participant_act.h"

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

    /// Resets the page for a session that starts or continues: unknown tray, no ticks.
    void begin(const SessionFacts& facts);
    void present(const session::View& view, bool canCorrect);
    /// Opens the correction panel. `answers`: at least one, the latest first.
    void openCorrection(const std::vector<Correctable>& answers);
    /// Closes the panel and clears the message after an accepted event.
    void closePanelAndMessage();
    void showMessage(const QString& text, Tone tone);
    /// Who has moved the session on, beside the operator.
    enum class MovedBy { Participant, Display };
    /// Keys and clicks that were meant for the page before do nothing for a moment. After a fault of the display it begins anew
    /// with each of them, because the rest of a sentence may follow. A panel takes keys all the time.
    void holdKeys(MovedBy by = MovedBy::Participant);
    /// Says what the participant did on their own page. A disagreement stands until they agree or the consent is over.
    void showAct(const participant::ParticipantAct& act);
    /// Shows which test pattern can be felt; none if it is off.
    void showPattern(const std::optional<TestPattern>& pattern);
    const session::View& shownView() const { return m_view; }

    /// False if the operator typed a text that is not stored; the page then asks what to do with it.
    bool mayClose();

    /// True while the page offers the refresher and the checklist of a later sitting.
    bool offersPreparation() const;

    /// Handles a key that no control used; returns whether it had an effect.
    bool pressKey(int key);

Q_SIGNALS:
    void eventRequested(const study::session::EventBody& event);
    void answerMarked(study::app::AnswerMark mark);
    /// The page showed a hint, which may ask for a second Enter.
    void hintShown();
    void correctionRequested();
    void patternRequested(const std::optional<rendering::TestPattern>& pattern);
    /// The operator leaves the session; a running session must be paused first.
    void leaveRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    /// Sees each key before the control with the focus: extra keys act in text fields, too, and what a scanner types stores
    /// nothing.
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    bool takesKeyFirst(const QKeyEvent& event);
    bool isScannedByMistake(const QKeyEvent& event);
    bool isOpeningKeyAgain(const QKeyEvent& event);
    bool isHeld() const;
    void connectPanels();
    void fillGuard();
    bool hasUnstoredText() const;
    void stay();
    /// What was asked for, and would lose a text.
    enum class GoingOn { Close, Leave };
    bool mayGoOn(GoingOn goingOn);
    void leave();
    void goOnWithoutText();
    void bindKeysWhileWriting();
    StagePage& pageOf(const session::View& view) const;
    StagePage& pageInFront() const;
    void bringForward(StagePage& page);
    void openPanel(StagePage& panel);
    /// Moves the message below the stages, where it cannot be scrolled away. It goes back with the next page.
    void pinMessage();
    void closePanel();
    void goOnUnprepared();
    void clearMendedMessage();
    /// Leaves nothing but a disagreement of the participant.
    void clearMessage();
    /// Asks for a second Enter where the operator confirms the consent of somebody who did not agree.
    void request(const session::EventBody& event);
    /// Code of the presentation that a void or flag applies to; empty: the presentation before the current tray.
    QString codeMeant() const;
    /// The key of a command, by a pedal or with Alt: never the letter of a slot.
    void pressCommand(int key);
    bool pressFocusedButton() const;

    SessionFacts m_facts;
    session::View m_view;
    bool m_isPreparationDeclined = false;
    bool m_hasDisagreed = false;    ///< the participant does not agree, and the consent is still asked for
    bool m_isConsentAsked = false;  ///< the operator confirmed the consent nevertheless, and was asked again
    bool m_isMendable = false;      ///< the message is about an entry, so it goes with the next change of that entry
    ScannerEntry m_scanner;
    HeldKeys m_heldKeys;
    struct KeyPressed {
        int key = 0;  ///< 0: none
        quint64 atMs = 0;
    };
    KeyPressed m_lastKey, m_openedBy;  ///< the second: the key that opened the panel, until another one is pressed
    bool m_isTextGivenUp = false;      ///< the operator closes the window without it
    GoingOn m_goingOn = GoingOn::Close;
    MovedBy m_heldBy = MovedBy::Participant;
    QElapsedTimer m_sinceHeld;
    StagePage* m_panel = nullptr;  ///< open panel; null if none

    SessionHeader* m_header;
    StageStack* m_stages;
    MessageBar* m_message;
    QWidget* m_guard;  ///< asks what to do with a text that is not stored
    SessionFooter* m_footer;
};

}  // namespace study::app
