#include "study/app/participant/instruction_view.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "study/app/participant/participant_side.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/scale_line.h"

namespace study::app {

using participant::Instruction;
using participant::Task;

namespace {

QLabel* sentence(const char* objectName, QWidget* parent)
{
    QLabel* made = label(objectName, Type::Body, parent);
    made->setProperty("type", QVariant());  // this widget sets its sizes itself: its screen is not the console's
    made->setAlignment(Qt::AlignCenter);
    return made;
}

QString linesOf(const std::vector<std::string>& texts, const QString& between)
{
    QStringList lines;
    for (const std::string& text : texts) lines << QString::fromStdString(text);
    return lines.join(between);
}

}  // namespace

InstructionView::InstructionView(const ParticipantSide& side, QWidget* parent)
    : QWidget(parent),
      m_side(side),
      m_title(sentence("participantTitle", this)),
      m_lines(sentence("participantLines", this)),
      m_statement(sentence("participantStatement", this)),
      m_feedback(sentence("participantFeedback", this)),
      m_question(sentence("participantQuestion", this)),
      m_scale(new ScaleLine(ScaleLine::Use::Show, this)),
      m_ends(new QWidget(this)),
      m_low(sentence("participantLow", m_ends)),
      m_high(sentence("participantHigh", m_ends)),
      m_count(sentence("participantCount", this)),
      m_clock(sentence("participantClock", this)),
      m_tick(new QTimer(this))
{
    setObjectName("instructionView");
    m_scale->setObjectName("participantScale");
    m_ends->setLayoutDirection(Qt::LeftToRight);  // each end below its end of the line, in every language
    m_low->setAlignment(Qt::AlignLeft | Qt::AlignAbsolute);
    m_high->setAlignment(Qt::AlignRight | Qt::AlignAbsolute);
    auto* ends = new QHBoxLayout(m_ends);
    ends->setContentsMargins(0, 0, 0, 0);
    ends->addWidget(m_low, 1);
    ends->addWidget(m_high, 1);
    auto* column = new QVBoxLayout(this);
    column->addStretch(1);
    for (QWidget* part : {static_cast<QWidget*>(m_title), static_cast<QWidget*>(m_lines), static_cast<QWidget*>(m_statement),
                          static_cast<QWidget*>(m_feedback), static_cast<QWidget*>(m_question), static_cast<QWidget*>(m_scale),
                          m_ends, static_cast<QWidget*>(m_count), static_cast<QWidget*>(m_clock)})
        column->addWidget(part);
    column->addStretch(1);
    m_tick->setInterval(500);
    connect(m_tick, &QTimer::timeout, this, &InstructionView::showClock);
    connect(&side, &ParticipantSide::instructionChanged, this, &InstructionView::present);
    present();
}

void InstructionView::present()
{
    const Instruction& instruction = m_side.shown();
    m_title->setText(QString::fromStdString(instruction.title));
    showText(*m_lines, linesOf(instruction.lines, QStringLiteral("\n\n")));
    const QString asked = instruction.task == Task::Facts ? linesOf(instruction.questions, QStringLiteral("\n"))
                                                          : QString::fromStdString(instruction.statement);
    showText(*m_statement, asked);
    presentScale(instruction);
    m_clock->setVisible(instruction.breakSeconds.has_value());
    showClock();
    if (instruction.breakSeconds)
        m_tick->start();
    else
        m_tick->stop();
    grow();
}

void InstructionView::presentScale(const Instruction& instruction)
{
    const auto& task = instruction.scale;
    for (QWidget* part : {static_cast<QWidget*>(m_scale), m_ends}) part->setVisible(task.has_value());
    showText(*m_feedback, task && task->last ? QString::fromStdString(task->last->text) : QString());
    showText(*m_question, task ? QString::fromStdString(task->say) : QString());
    showText(*m_count, task ? QString::fromStdString(task->count) : QString());
    if (!task) return;
    m_scale->setScale(task->scale);
    m_scale->setRating(task->asked);
    m_low->setText(QString::fromStdString(task->low));
    m_high->setText(QString::fromStdString(task->high));
}

void InstructionView::showClock()
{
    const int seconds = m_side.breakSeconds();
    const QString time = QStringLiteral("%1:%2").arg(seconds / 60).arg(seconds % 60, 2, 10, QLatin1Char('0'));
    m_clock->setText(QString::fromStdString(m_side.shown().breakClock).replace(QLatin1String("{time}"), time));
}

void InstructionView::grow()
{
    // Long texts get smaller letters, so that nothing lies outside the screen.
    constexpr int charactersOfAFullScreen = 420;
    const auto length = m_lines->text().size() + m_statement->text().size();
    double room = std::min(1.0, double(charactersOfAFullScreen) / std::max<double>(1, double(length)));
    if (m_scale->isVisibleTo(this)) room = std::min(room, 0.7);  // the line and its texts stand below each other
    const double base = std::max(11.0, std::min(width() / 32.0, height() / 18.0) * std::max(0.45, room));
    setStyleSheet(QStringLiteral("QLabel { font-size: %1px; } #participantTitle { font-size: %2px; font-weight: bold; }"
                                 " #participantQuestion, #participantClock { font-size: %3px; font-weight: bold; }"
                                 " #participantFeedback { font-weight: bold; }")
                      .arg(qRound(base))
                      .arg(qRound(base * 1.8))
                      .arg(qRound(base * 1.25)));
    layout()->setSpacing(qRound(base * 0.9));
    const int side = std::max(12, width() / 14);
    layout()->setContentsMargins(side, side / 3, side, side / 3);
    m_scale->setMinimumHeight(qRound(base * 4.5));
}

void InstructionView::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    grow();
}

}  // namespace study::app
