#include "study/app/reason_panel.h"

#include "study/app/pieces.h"

#include <QCoreApplication>
#include <QHBoxLayout>
#include <QVBoxLayout>

namespace study::app {

namespace {

QString tr(const char* text)
{
    return QCoreApplication::translate("study::app::ReasonPanel", text);
}

}  // namespace

Reason noteReason()
{
    return {tr("Note"), tr("What should be known about this moment? The note is kept with its time."), tr("Note"),
            tr("Store the note (Enter)"), false,
            [](const std::string& text) { return session::EventBody(session::Noted{text}); }};
}

Reason voidReason(const QString& presentation)
{
    return {presentation.isEmpty() ? tr("Void the last presentation") : tr("Void presentation %1").arg(presentation),
            tr("Its answers are kept but not analysed, and it is presented once more at the end of this part. "
               "Why was it invalid?"),
            tr("Reason"), tr("Void it (Enter)"), true,
            [](const std::string& text) { return session::EventBody(session::Voided{text}); }};
}

Reason withdrawReason()
{
    return {tr("The participant withdraws"),
            tr("This ends the session for good. Answers until now are kept. What is the reason, as far as it was given?"),
            tr("Reason"), tr("End the session (Enter)"), true,
            [](const std::string& text) { return session::EventBody(session::WithdrawnEvent{text}); }};
}

ReasonPanel::ReasonPanel(QWidget* parent)
    : StagePage(parent),
      m_title(label("panelTitle", Type::Title, this, Weight::Bold)),
      m_explanation(label("panelExplanation", Type::Lead, this)),
      m_text(field("reasonField", tr("Reason"), this)),
      m_action(mainButton("panelConfirmButton", tr("Store (Enter)"), this)),
      m_back(button("panelBackButton", tr("Back (Esc)"), this))
{
    setType(*m_text, Type::Lead);
    auto* actions = new QHBoxLayout;
    actions->setSpacing(14);
    actions->addWidget(m_action);
    actions->addWidget(m_back);
    actions->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(18);
    column->addWidget(m_title);
    column->addWidget(m_explanation);
    column->addWidget(m_text);
    column->addLayout(actions);
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, &ReasonPanel::confirm);
    connect(m_back, &QPushButton::clicked, this, &ReasonPanel::closeAsked);
}

void ReasonPanel::ask(const Reason& reason)
{
    m_reason = reason;
    m_isAskedAgain = false;
    m_title->setText(reason.title);
    m_explanation->setText(reason.explanation);
    m_text->clear();
    m_text->setAccessibleName(reason.fieldName);
    setButtonText(*m_action, reason.action);
}

void ReasonPanel::confirm()
{
    const bool isEmpty = m_text->text().trimmed().isEmpty();
    if (!isEmpty || (m_reason.mayBeEmpty && m_isAskedAgain)) {
        Q_EMIT eventAsked(m_reason.event(isEmpty ? std::string() : m_text->text().toStdString()));
        return;
    }
    m_isAskedAgain = true;
    m_text->setFocus();
    Q_EMIT hinted(m_reason.mayBeEmpty ? tr("Write a few words. Enter once more goes on without a reason; Esc goes back.")
                                      : tr("Write a few words first; Esc goes back without storing anything."));
}

bool ReasonPanel::pressKey(int key)
{
    if (isEnter(key))
        confirm();
    else if (key == Qt::Key_Escape)
        Q_EMIT closeAsked();
    else
        return false;
    return true;
}

QWidget& ReasonPanel::firstFocus()
{
    return *m_text;
}

}  // namespace study::app
