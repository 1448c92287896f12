#include "study/app/pages/reason_panel.h"

#include <QShortcut>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

using session::EventBody;

ReasonPanel::ReasonPanel(QWidget* parent)
    : FormPanel(parent),
      m_code(field("confirmField", tr("Code of the participant"), this)),
      m_codeCaption(addRow(tr("Participant's code"), m_code)),
      m_usual(usualReasons()),
      m_usualCaption(addRow(tr("Usual reasons"), m_usual))
{
    setType(*m_code, Type::Lead);
    setReasonAfter(*m_usual);
    connect(m_code, &QLineEdit::textEdited, this, &StagePage::mended);
    askForCode(false);
    offerUsualReasons(false);
}

/// With Alt, because a digit alone may begin a typed reason.
QWidget* ReasonPanel::usualReasons()
{
    auto* made = new QWidget(this);
    auto* row = new FlowLayout(8, 8, made);
    row->setContentsMargins(0, 0, 0, 0);
    int number = 0;
    for (const QString& reason :
         {tr("Wrong piece on the tray"), tr("Disturbance in the room"), tr("Fault of the display"), tr("Slip of the operator")}) {
        ++number;
        auto* choice =
            button(qPrintable(QStringLiteral("usualReason%1").arg(number)), tr("%1 (Alt %2)").arg(reason).arg(number), made);
        connect(choice, &QPushButton::clicked, this, [this, reason] { setReason(reason); });
        auto* shortcut = new QShortcut(QKeySequence(Qt::ALT | static_cast<Qt::Key>(Qt::Key_0 + number)), this);
        shortcut->setContext(Qt::WidgetWithChildrenShortcut);
        connect(shortcut, &QShortcut::activated, choice, [choice] {
            if (choice->isVisible()) choice->click();
        });
        row->addWidget(choice);
    }
    return made;
}

void ReasonPanel::offerUsualReasons(bool isOffered)
{
    m_usual->setVisible(isOffered);
    m_usualCaption->setVisible(isOffered);
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
    const QString typed = m_code->text().trimmed();
    Q_EMIT hinted(
        typed.isEmpty()
            ? tr("This ends the session for good. Type %1 in the first line, or press Esc to go back.").arg(m_participantCode)
            : tr("“%1” is not the code of this participant. Type %2 in the first line, or press Esc to go back.")
                  .arg(shortName(typed), m_participantCode));
    return false;
}

QWidget& ReasonPanel::firstFocus() { return m_code->isHidden() ? FormPanel::firstFocus() : *m_code; }

void ReasonPanel::askForNote()
{
    askForCode(false);
    offerUsualReasons(false);
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
    offerUsualReasons(false);
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
    offerUsualReasons(true);
    m_event = [](const std::string& text) { return EventBody(session::Voided{text}); };
    open({.title = presentation.isEmpty() ? tr("Void the last presentation") : tr("Void presentation %1").arg(presentation),
          .explanation = tr("Its answers are kept but not analysed. The presentation is repeated at the end of this block under "
                            "another code. Why was it invalid?"),
          .caption = tr("Reason"),
          .action = tr("Void the presentation (Enter)"),
          .hintWhenEmpty = tr("Write a short reason, or choose one with Alt 1 to Alt 4. Press Esc to go back."),
          .withoutReason = WithoutReason::Refuse});
}

void ReasonPanel::askWhyWithdrawn()
{
    askForCode(true);
    offerUsualReasons(false);
    const QString explanation =
        m_isAtStation
            ? tr("This ends the session of %1 permanently. The answers so far are kept, and the study's owner gives the place "
                 "out again. To stop for today, press Esc and then Q. Which reason did the participant give?")
            : tr("This ends the session of %1 permanently. The answers so far are kept, and another participant can take "
                 "the place. To stop for today, press Esc and then Q. Which reason did the participant give?");
    m_event = [](const std::string& text) { return EventBody(session::WithdrawnEvent{text}); };
    open({.title = tr("The participant withdraws"),
          .explanation = explanation.arg(m_participantCode),
          .caption = tr("Reason"),
          .action = tr("End the session (Enter)"),
          .hintWhenEmpty = tr("The participant need not give a reason. Press Enter again to end the session, Esc to go back.")});
}

}  // namespace study::app
