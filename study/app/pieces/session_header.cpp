#include "study/app/pieces/session_header.h"

#include <QProgressBar>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

QLabel* fact(const char* objectName, QWidget* parent, Weight weight = Weight::Normal)
{
    QLabel* made = label(objectName, Type::Plain, parent, weight);
    made->setWordWrap(false);
    return made;
}

}  // namespace

SessionHeader::SessionHeader(QWidget* parent)
    : QFrame(parent),
      m_display(fact("displayFact", this, Weight::Bold)),
      m_participant(fact("participantFact", this, Weight::Bold)),
      m_part(fact("partFact", this)),
      m_presentations(fact("presentationFact", this)),
      m_answers(fact("answersFact", this)),
      m_timeLeft(fact("timeLeftFact", this)),
      m_sitting(fact("sittingFact", this)),
      m_nextBreak(fact("nextBreakFact", this)),
      m_bar(new QProgressBar(this))
{
    setObjectName("sessionHeader");
    setRole(*this, "bar");
    name(*m_bar, "progressBar", tr("Answers stored"));
    m_bar->setTextVisible(false);
    auto* facts = new FlowLayout(26, 4);
    for (QLabel* made : {m_display, m_participant, m_part, m_presentations, m_answers, m_timeLeft, m_nextBreak, m_sitting})
        facts->addWidget(made);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(28, 12, 28, 12);
    column->setSpacing(8);
    column->addLayout(facts);
    column->addWidget(m_bar);
}

void SessionHeader::begin(const SessionFacts& facts)
{
    m_sittingMinutes = facts.sittingMinutes;
    m_displayName = facts.displayName;
    m_pattern.clear();
    setRole(*m_display, m_displayName.isEmpty() ? "fault" : "tag");
}

namespace {

/// Whether an image can be felt now.
bool isFelt(const session::View& view)
{
    const auto* familiarising = std::get_if<session::Familiarising>(&view.state.stage);
    const bool shows = std::holds_alternative<session::Presenting>(view.state.stage) || (familiarising && familiarising->shown);
    return shows && !view.state.paused;
}

}  // namespace

void SessionHeader::present(const session::View& view)
{
    if (m_displayName.isEmpty())
        m_display->setText(tr("NO DISPLAY: rehearsal"));
    else if (!m_pattern.isEmpty())
        m_display->setText(tr("Display on: %1 (%2)").arg(m_pattern, m_displayName));
    else
        m_display->setText(isFelt(view) ? tr("Display on: %1").arg(m_displayName) : tr("Display off: %1").arg(m_displayName));
    const bool isOver = std::holds_alternative<session::Finished>(view.state.stage) ||
                        std::holds_alternative<session::Withdrawn>(view.state.stage);
    const bool isBetween = isOver || view.presentation <= 0 || std::holds_alternative<session::Debriefing>(view.state.stage);
    m_participant->setText(tr("Participant %1").arg(QString::fromStdString(view.participant)));
    showText(*m_part, isBetween || view.phaseName.empty() ? QString() : QString::fromStdString(view.phaseName));
    showText(*m_presentations,
             isBetween ? QString() : tr("Presentation %1 of %2").arg(view.presentation).arg(view.presentations));
    m_answers->setText(tr("Answers %1 of %2").arg(view.answersStored).arg(view.answersInAll));
    const int minutes = std::max(1, static_cast<int>(std::lround(view.minutesLeft)));
    showText(*m_timeLeft, isBetween ? QString() : tr("About %1 min left").arg(minutes));
    showText(*m_sitting, isOver
                             ? QString()
                             : tr("This sitting: %1 of %2 min").arg(static_cast<int>(view.sittingMinutes)).arg(m_sittingMinutes));
    showText(*m_nextBreak, isBetween || view.presentationsToBreak <= 0
                               ? QString()
                               : tr("Presentations to next break: %1").arg(view.presentationsToBreak));
    m_bar->setRange(0, std::max(1, view.answersInAll));
    m_bar->setValue(std::min(view.answersStored, view.answersInAll));
}

}  // namespace study::app
