#include "study/app/pages/reason_panel.h"

namespace study::app {

using session::EventBody;

void ReasonPanel::askForNote()
{
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
    m_event = [](const std::string& text) { return EventBody(session::WithdrawnEvent{text}); };
    open(
        {.title = tr("The participant withdraws"),
         .explanation = tr("This ends the session permanently. The answers so far are kept, and another participant can take the "
                           "place. Which reason did the participant give?"),
         .caption = tr("Reason"),
         .action = tr("End the session (Enter)"),
         .hintWhenEmpty = tr("The participant need not give a reason. Press Enter again to end the session, Esc to go back.")});
}

}  // namespace study::app
