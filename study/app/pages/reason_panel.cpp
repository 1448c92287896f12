#include "study/app/pages/reason_panel.h"

#include "study/app/pieces/pieces.h"

namespace study::app {

using session::EventBody;

ReasonPanel::ReasonPanel(QWidget* parent)
    : FormPanel(parent),
      m_code(field("confirmField", tr("Code of the participant"), this)),
      m_codeCaption(addRow(tr("Participant's code"), m_code))
{
    setType(*m_code, Type::Lead);
    setReasonAfter(*m_code);
    connect(m_code, &QLineEdit::textEdited, this, &StagePage::mended);
    askForCode(false);
}

void ReasonPanel::askForCode(bool isAsked)
{
    m_code->clear();
    m_code->setVisible(isAsked);
    m_codeCaption->setVisible(isAsked);
}

bool ReasonPanel::isReady()
{
    if (m_code->isHidden() || m_code->text().trimmed() == m_participantCode) return true;
    m_code->setFocus();
    Q_EMIT hinted(
        tr("This ends the session for good. Type %1 in the first line, or press Esc to go back.").arg(m_participantCode));
    return false;
}

QWidget& ReasonPanel::firstFocus() { return m_code->isHidden() ? FormPanel::firstFocus() : *m_code; }

void ReasonPanel::askForNote()
{
    askForCode(false);
    m_event = [](const std::string& text) { return EventBody(session::Noted{text, false}); };
    open({.title = tr("Note"),
          .explanation = tr("Describe the event in a few words. The program stores the note with its time."),
          .caption = tr("Note"),
          .action = tr("Store the note (Enter)"),
          .hintWhenEmpty = tr("The note is empty. Write a few words, or press Esc to go back."),
          .withoutReason = WithoutReason::Refuse});
}

void ReasonPanel::askForFlag(const QString& presentation)
{
    askForCode(false);
    m_event = [](const std::string& text) { return EventBody(session::Noted{text, true}); };
    open({.title = presentation.isEmpty() ? tr("Flag the last presentation") : tr("Flag presentation %1").arg(presentation),
          .explanation = tr("The presentation stays in the analysis and is marked for inspection. You may add a reason."),
          .caption = tr("Reason"),
          .action = tr("Flag the presentation (Enter)"),
          .hintWhenEmpty = {},
          .withoutReason = WithoutReason::Accept});
}

void ReasonPanel::askWhyVoid(const QString& presentation)
{
    askForCode(false);
    m_event = [](const std::string& text) { return EventBody(session::Voided{text}); };
    open({.title = presentation.isEmpty() ? tr("Void the last presentation") : tr("Void presentation %1").arg(presentation),
          .explanation = tr("Its answers are kept but not analysed. The presentation is repeated at the end of this block under "
                            "another code. Why was it invalid?"),
          .caption = tr("Reason"),
          .action = tr("Void the presentation (Enter)"),
          .hintWhenEmpty =
              tr("Write a short reason. Press Enter again to void the presentation without a reason, Esc to go back.")});
}

void ReasonPanel::askWhyWithdrawn()
{
    askForCode(true);
    m_event = [](const std::string& text) { return EventBody(session::WithdrawnEvent{text}); };
    open({.title = tr("The participant withdraws"),
          .explanation =
              tr("This ends the session of %1 permanently. The answers so far are kept, and another participant can take "
                 "the place. To stop for today, press Esc and then Q. Which reason did the participant give?")
                  .arg(m_participantCode),
          .caption = tr("Reason"),
          .action = tr("End the session (Enter)"),
          .hintWhenEmpty = tr("The participant need not give a reason. Press Enter again to end the session, Esc to go back.")});
}

}  // namespace study::app
