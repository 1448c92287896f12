#include "study/app/pieces/session_header.h"

#include <QEvent>
#include <QPainter>
#include <QProgressBar>
#include <QStyle>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

constexpr int gapPx = 26, sidePx = 28;

/// One line that never widens the window: where the bar is too narrow for it, its middle is left out.
class Fact : public QLabel {
public:
    using QLabel::QLabel;

    QSize minimumSizeHint() const override
    {
        constexpr int fewestCharacters = 10;
        const QSize whole = QLabel::minimumSizeHint();
        return {std::min(whole.width(), fewestCharacters * fontMetrics().averageCharWidth()), whole.height()};
    }

protected:
    void paintEvent(QPaintEvent* event) override
    {
        if (width() >= sizeHint().width()) {
            QLabel::paintEvent(event);
            return;
        }
        const QRect place = contentsRect();
        const QString shown = fontMetrics().elidedText(text(), Qt::ElideMiddle, place.width());
        QPainter painter(this);
        drawFrame(&painter);
        style()->drawItemText(&painter, place, Qt::AlignLeft | Qt::AlignVCenter, palette(), isEnabled(), shown, foregroundRole());
    }
};

QLabel* fact(const char* objectName, QWidget* parent, Weight weight = Weight::Normal)
{
    auto* made = new Fact(parent);
    made->setObjectName(QString::fromLatin1(objectName));
    made->setTextFormat(Qt::PlainText);
    setType(*made, weight == Weight::Bold ? Type::Plain : Type::Small, weight);
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
    auto* facts = new FlowLayout(gapPx, 4);
    for (QLabel* made : {m_display, m_participant, m_part, m_presentations, m_answers, m_timeLeft, m_nextBreak, m_sitting})
        facts->addWidget(made);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(sidePx, 12, sidePx, 12);
    column->setSpacing(8);
    column->addLayout(facts);
    column->addWidget(m_bar);
}

void SessionHeader::begin(const SessionFacts& facts)
{
    m_sittingMinutes = facts.sittingMinutes;
    m_isRehearsal = facts.isRehearsal;
    m_displayName = shortName(facts.displayName);
    m_display->setToolTip(fullName(facts.displayName));
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
    m_participant->setText(m_isRehearsal ? tr("REHEARSAL: nothing becomes data")
                                         : tr("Participant %1").arg(QString::fromStdString(view.participant)));
    m_part->setText(isBetween || view.phaseName.empty() ? QString() : QString::fromStdString(view.phaseName));
    m_presentations->setText(isBetween ? QString() : tr("Presentation %1 of %2").arg(view.presentation).arg(view.presentations));
    m_answers->setText(tr("Answers %1 of %2").arg(view.answersStored).arg(view.answersInAll));
    const int minutes = std::max(1, static_cast<int>(std::lround(view.minutesLeft)));
    m_timeLeft->setText(isBetween ? QString() : tr("About %1 min left").arg(minutes));
    m_sitting->setText(
        isOver ? QString() : tr("This sitting: %1 of %2 min").arg(static_cast<int>(view.sittingMinutes)).arg(m_sittingMinutes));
    m_nextBreak->setText(isBetween || view.presentationsToBreak <= 0
                             ? QString()
                             : tr("Presentations to next break: %1").arg(view.presentationsToBreak));
    m_bar->setRange(0, std::max(1, view.answersInAll));
    m_bar->setValue(std::min(view.answersStored, view.answersInAll));
    arrange();
}

void SessionHeader::arrange()
{
    std::vector<std::pair<QWidget*, bool>> facts;
    for (QLabel* fact : {m_display, m_participant, m_presentations, m_answers, m_timeLeft, m_nextBreak, m_part, m_sitting})
        facts.emplace_back(fact, !fact->text().isEmpty());
    showInOneRow(*this, facts, gapPx);
    m_display->setVisible(!m_display->text().isEmpty());  // shortened rather than hidden
    for (QLabel* fact : {m_participant, m_part})
        fact->setToolTip(fact->sizeHint().width() > contentsRect().width() - 2 * sidePx ? fullName(fact->text()) : QString());
    layout()->invalidate();  // its height depends on the size of the text
    updateGeometry();
}

void SessionHeader::resizeEvent(QResizeEvent* event)
{
    QFrame::resizeEvent(event);
    arrange();
}

void SessionHeader::changeEvent(QEvent* event)
{
    QFrame::changeEvent(event);
    // Queued, because the facts get their font after this bar.
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        QMetaObject::invokeMethod(this, &SessionHeader::arrange, Qt::QueuedConnection);
}

}  // namespace study::app
