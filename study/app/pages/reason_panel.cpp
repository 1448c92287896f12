#include "study/app/pages/reason_panel.h"

namespace study::app {

using session::EventBody;

void ReasonPanel::askForNote()
{
    m_event = [](const std::string& text) { return EventBody(session::Noted{text, false}); };
    open({.title = tr("Note"),
          .explanation = tr("What should be known about this moment? The note is kept with its time."),
          .caption = tr("Note"),
          .action = tr("Store the note (Enter)"),
          .hintWhenEmpty = tr("Write a few words first; Esc goes back without storing anything."),
          .empty = Empty::IsRefused});
}

void ReasonPanel::askForFlag(const QString& presentation)
{
    m_event = [](const std::string& text) { return EventBody(session::Noted{text, true}); };
    open({.title = presentation.isEmpty() ? tr("Flag the last presentation") : tr("Flag presentation %1").arg(presentation),
          .explanation = tr("It stays in the analysis and is marked to be looked at. A few words may say why; none are needed."),
          .caption = tr("What happened"),
          .action = tr("Flag it (Enter)"),
          .hintWhenEmpty = {},
          .empty = Empty::IsFine});
}

void ReasonPanel::askWhyVoid(const QString& presentation)
{
    m_event = [](const std::string& text) { return EventBody(session::Voided{text}); };
    open({.title = presentation.isEmpty() ? tr("Void the last presentation") : tr("Void presentation %1").arg(presentation),
          .explanation = tr("Its answers are kept but not analysed, and it is presented once more at the end of this block, "
                            "under another code. Why was it invalid?"),
          .caption = tr("Reason"),
          .action = tr("Void it (Enter)"),
          .hintWhenEmpty = tr("Write a few words. Enter once more goes on without a reason; Esc goes back.")});
}

void ReasonPanel::askWhyWithdrawn()
{
    m_event = [](const std::string& text) { return EventBody(session::WithdrawnEvent{text}); };
    open({.title = tr("The participant withdraws"),
          .explanation = tr("This ends the session for good. Answers until now are kept, and the place becomes free for somebody "
                            "else. What is the reason, as far as it was given?"),
          .caption = tr("Reason"),
          .action = tr("End the session (Enter)"),
          .hintWhenEmpty = tr("Nobody has to give a reason. Enter once more ends the session; Esc goes back.")});
}

}  // namespace study::app
