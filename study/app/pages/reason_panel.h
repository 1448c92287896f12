// Form with a few lines of text: a note, a flag, the reason to void a presentation, or the reason for a withdrawal.
#pragma once

#include "study/app/pages/form_panel.h"

class QLineEdit;

namespace study::app {

class ReasonPanel : public FormPanel {
    Q_OBJECT
public:
    explicit ReasonPanel(QWidget* parent);

    void begin(const SessionFacts& facts) override
    {
        m_participantCode = facts.participant;
        m_isAtStation = facts.isAtStation;
    }

    void askForNote();
    /// Marks a presentation for inspection; the reason is optional. `presentation`: see askWhyVoid().
    void askForFlag(const QString& presentation);
    /// Needs a reason, typed or chosen from the usual ones. `presentation`: its code; empty: the presentation before the current
    /// tray.
    void askWhyVoid(const QString& presentation);
    /// Ends a session for good, so the operator types the participant's code.
    void askWhyWithdrawn();
    QWidget& firstFocus() override;

protected:
    bool isReady() override;
    session::EventBody eventFor(const std::string& reason) override { return m_event(reason); }

private:
    QWidget* usualReasons();
    void askForCode(bool isAsked);
    void offerUsualReasons(bool isOffered);

    QString m_participantCode;
    bool m_isAtStation = false;
    QLineEdit* m_code;
    QWidget* m_codeCaption;
    QWidget* m_usual;  ///< buttons of the usual reasons for a void
    QWidget* m_usualCaption;
    std::function<session::EventBody(const std::string&)> m_event;
};

}  // namespace study::app
