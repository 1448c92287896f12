#include "study/app/pieces/session_footer.h"

#include <QEvent>
#include <QRegularExpression>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "study/app/language/app_text.h"
#include "study/app/language/below.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// Shortens a long answer; the footer only identifies the last answer.
QString inShort(const QString& answer)
{
    constexpr int longest = 24;
    const QString line = answer.simplified();
    return line.size() > longest ? line.left(longest) + QStringLiteral("…") : line;
}

/// "Q2: 5.4", "S1: same", with the words and the decimal mark of the window.
QString lastAnswerOf(const session::View& view)
{
    QString said = QString::fromStdString(*view.lastAnswer);
    const QString question = QString::fromStdString(view.lastQuestion->value + ": ");
    const session::GivenAnswer& response = view.state.answers.back().response;
    if (std::holds_alternative<session::Sameness>(response)) return question + inOwnLanguage(session::textOf(response));
    static const QRegularExpression point(QStringLiteral("(?<=\\d)\\.(?=\\d$)"));
    return std::holds_alternative<protocols::Tenths>(response) ? said.replace(point, decimalMark()) : said;
}

}  // namespace

SessionFooter::SessionFooter(QWidget* parent)
    : QFrame(parent),
      m_lastAnswer(label("lastAnswer", Type::Plain, this, Weight::Bold)),
      m_correct(add("correctButton", tr("Correct"), KeyAct::Correct, Qt::Key_L, QStringLiteral("L"))),
      m_note(add("noteButton", tr("Note"), KeyAct::Note, Qt::Key_N, QStringLiteral("N"))),
      m_flag(add("flagButton", tr("Flag"), KeyAct::Flag, Qt::Key_F, QStringLiteral("F"))),
      m_void(add("voidButton", tr("Void"), KeyAct::Void, Qt::Key_V, QStringLiteral("V"))),
      m_pause(add("pauseButton", tr("Pause"), KeyAct::Pause, Qt::Key_Escape, QStringLiteral("Esc"))),
      m_leave(add("leaveButton", tr("Stop for now"), KeyAct::Stop, Qt::Key_Q, QStringLiteral("Q"))),
      m_withdraw(add("withdrawButton", tr("Withdrawal"), KeyAct::Withdraw, Qt::Key_W, QStringLiteral("W")))
{
    setObjectName("sessionFooter");
    setRole(*this, "bar");
    m_lastAnswer->setWordWrap(false);
    m_lastAnswer->setContentsMargins(0, 0, 10, 0);
    auto* row = new FlowLayout(0, 0);
    row->addWidget(m_lastAnswer);
    for (const Key& one : m_keys) row->addWidget(one.button);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(28, 8, 22, 8);
    column->addLayout(row);
    connect(m_correct, &QPushButton::clicked, this, &SessionFooter::correctionRequested);
    connect(m_note, &QPushButton::clicked, this, &SessionFooter::noteRequested);
    connect(m_flag, &QPushButton::clicked, this, &SessionFooter::flagRequested);
    connect(m_void, &QPushButton::clicked, this, &SessionFooter::voidRequested);
    connect(m_pause, &QPushButton::clicked, this, &SessionFooter::pauseRequested);
    connect(m_withdraw, &QPushButton::clicked, this, &SessionFooter::withdrawRequested);
    connect(m_leave, &QPushButton::clicked, this, &SessionFooter::leaveRequested);
}

QPushButton* SessionFooter::add(const char* objectName, const QString& text, KeyAct act, int key, const QString& keyName)
{
    m_keys.push_back({act, key, keyName, plainButton(objectName, tr("%1 (%2)").arg(text, keyName), this), text});
    setType(*m_keys.back().button, Type::Small);
    return m_keys.back().button;
}

void SessionFooter::setLettersTaken(int count)
{
    const int before = std::exchange(m_lettersTaken, count);
    if (std::ranges::any_of(m_keys, [&](const Key& one) { return needsAlt(one, before) != needsAlt(one, count); })) showKeys();
}

void SessionFooter::setKeys(const KeyBindings& keys)
{
    m_bindings = keys;
    showKeys();
}

void SessionFooter::showKeys()
{
    for (const Key& one : m_keys) {
        QString keys = needsAlt(one, m_lettersTaken) ? tr("Alt %1").arg(one.name) : one.name;
        if (const auto extra = m_bindings.extraKey(one.act)) keys = tr("%1 or %2").arg(keys, nameOfKey(*extra));
        setButtonText(*one.button, tr("%1 (%2)").arg(one.text, keys));
    }
    arrange();
}

void SessionFooter::present(const session::View& view, bool canCorrect)
{
    const session::Stage& stage = view.state.stage;
    m_canCorrect = canCorrect;
    m_isPaused = view.state.paused;
    m_isOver = std::holds_alternative<session::Finished>(stage) || std::holds_alternative<session::Withdrawn>(stage);
    const bool isPresenting = std::holds_alternative<session::Presenting>(stage);
    m_canFlag = !m_isOver && (isPresenting || !view.state.answers.empty());
    m_canVoid = isPresenting || std::holds_alternative<session::PlacingTray>(stage) ||
                std::holds_alternative<session::OnBreak>(stage) || std::holds_alternative<session::Debriefing>(stage);
    m_lastAnswer->setText(view.lastAnswer ? tr("Last answer  %1").arg(inShort(lastAnswerOf(view))) : tr("No answer yet"));
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
    m_flag->setEnabled(isFree && m_canFlag);
    m_void->setEnabled(isFree && m_canVoid && !m_isPaused);
    m_pause->setEnabled(isFree && !m_isPaused && !m_isOver);
    m_withdraw->setEnabled(isFree && !m_isOver);
    m_leave->setEnabled(isFree);
    arrange();
}

void SessionFooter::arrange()
{
    // A key that can be used always has its button, for operators who use the mouse.
    const bool isLow = isLowFor(*this);
    for (const Key& one : m_keys) one.button->setVisible(!isLow || one.button->isEnabled());
    m_lastAnswer->setVisible(!isLow);
    layout()->invalidate();  // its height depends on the size of the text
    updateGeometry();
}

void SessionFooter::resizeEvent(QResizeEvent* event)
{
    QFrame::resizeEvent(event);
    arrange();
}

void SessionFooter::changeEvent(QEvent* event)
{
    QFrame::changeEvent(event);
    // Queued, because the buttons get their font after this bar.
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        QMetaObject::invokeMethod(this, &SessionFooter::arrange, Qt::QueuedConnection);
}

bool SessionFooter::pressKey(int key)
{
    const int meant = key == Qt::Key_P ? static_cast<int>(Qt::Key_Escape) : key;
    for (const Key& one : m_keys)
        if (one.key == meant && one.button->isEnabled()) {
            one.button->click();
            return true;
        }
    return false;
}

}  // namespace study::app
