#include "study/app/session_footer.h"

#include "study/app/flow_layout.h"
#include "study/app/pieces.h"

#include <QVBoxLayout>

#include <utility>

namespace study::app {

SessionFooter::SessionFooter(QWidget* parent)
    : QFrame(parent),
      m_lastAnswer(label("lastAnswer", Type::Plain, this, Weight::Bold)),
      m_correct(plainButton("correctButton", tr("Correct last answer (L)"), this)),
      m_note(plainButton("noteButton", tr("Note (N)"), this)),
      m_void(plainButton("voidButton", tr("Void (V)"), this)),
      m_pause(plainButton("pauseButton", tr("Pause (Esc)"), this)),
      m_withdraw(plainButton("withdrawButton", tr("Withdrawal (W)"), this)),
      m_leave(plainButton("leaveButton", tr("Stop for now (Q)"), this))
{
    setObjectName("sessionFooter");
    setRole(*this, "bar");
    m_lastAnswer->setWordWrap(false);
    auto* row = new FlowLayout(6, 0);
    row->addWidget(m_lastAnswer);
    for (QPushButton* made : {m_correct, m_note, m_void, m_pause, m_leave, m_withdraw})
        row->addWidget(made);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(28, 8, 22, 8);
    column->addLayout(row);
    connect(m_correct, &QPushButton::clicked, this, &SessionFooter::correctionAsked);
    connect(m_note, &QPushButton::clicked, this, &SessionFooter::noteAsked);
    connect(m_void, &QPushButton::clicked, this, &SessionFooter::voidAsked);
    connect(m_pause, &QPushButton::clicked, this, &SessionFooter::pauseAsked);
    connect(m_withdraw, &QPushButton::clicked, this, &SessionFooter::withdrawAsked);
    connect(m_leave, &QPushButton::clicked, this, &SessionFooter::leaveAsked);
}

void SessionFooter::present(const session::View& view, bool canCorrect)
{
    const session::Stage& stage = view.state.stage;
    m_canCorrect = canCorrect;
    m_isPaused = view.state.paused;
    m_isOver = std::holds_alternative<session::Finished>(stage) || std::holds_alternative<session::Withdrawn>(stage);
    m_isTrialOn = std::holds_alternative<session::PlacingTray>(stage) || std::holds_alternative<session::Presenting>(stage) ||
                  std::holds_alternative<session::OnBreak>(stage);
    m_lastAnswer->setText(view.lastAnswer ? tr("Last answer  %1").arg(QString::fromStdString(*view.lastAnswer))
                                          : tr("No answer yet"));
    enable();
}

void SessionFooter::setPanelOpen(bool open)
{
    m_isPanelOpen = open;
    enable();
}

void SessionFooter::enable()
{
    const bool isFree = !m_isPanelOpen;
    m_correct->setEnabled(isFree && m_canCorrect);
    m_note->setEnabled(isFree && !m_isOver);
    m_void->setEnabled(isFree && m_isTrialOn && !m_isPaused);
    m_pause->setEnabled(isFree && !m_isPaused && !m_isOver);
    m_withdraw->setEnabled(isFree && !m_isOver);
    m_leave->setEnabled(isFree);
}

bool SessionFooter::pressKey(int key)
{
    const std::pair<int, QPushButton*> keys[] = {{Qt::Key_L, m_correct},    {Qt::Key_N, m_note},  {Qt::Key_V, m_void},
                                                 {Qt::Key_Escape, m_pause}, {Qt::Key_P, m_pause}, {Qt::Key_W, m_withdraw},
                                                 {Qt::Key_Q, m_leave}};
    for (const auto& [ofButton, target] : keys)
        if (ofButton == key && target->isEnabled()) {
            target->click();
            return true;
        }
    return false;
}

}  // namespace study::app
