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
#include "study/app/state/appearance.h"

namespace study::app {

namespace {

constexpr int gapPx = 26, sidePx = 28;

/// One line that never widens the window: where the bar is too narrow for it, its middle or its end is left out.
class Fact : public QLabel {
public:
    Fact(Qt::TextElideMode leftOut, QWidget* parent) : QLabel(parent), m_leftOut(leftOut) {}

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
        const QString shown = fontMetrics().elidedText(text(), m_leftOut, place.width());
        QPainter painter(this);
        drawFrame(&painter);
        style()->drawItemText(&painter, place, Qt::AlignLeft | Qt::AlignVCenter, palette(), isEnabled(), shown, foregroundRole());
    }

private:
    Qt::TextElideMode m_leftOut;
};

QLabel* fact(const char* objectName, QWidget* parent, Weight weight = Weight::Normal, Qt::TextElideMode leftOut = Qt::ElideMiddle)
{
    auto* made = new Fact(leftOut, parent);
    made->setObjectName(QString::fromLatin1(objectName));
    made->setTextFormat(Qt::PlainText);
    setType(*made, weight == Weight::Bold ? Type::Plain : Type::Small, weight);
    return made;
}

/// The name that the driver states about itself, without the address in brackets that the display adds to it.
QString ownNameOf(const QString& displayName)
{
    for (const QLatin1String address : {QLatin1String(" (exec:"), QLatin1String(" (tcp:")})
        if (const qsizetype at = displayName.indexOf(address); at > 0) return displayName.left(at);
    return displayName;
}

}  // namespace

SessionHeader::SessionHeader(QWidget* parent)
    : QFrame(parent),
      m_display(fact("displayFact", this, Weight::Bold, Qt::ElideRight)),
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
    for (QLabel* made : {m_participant, m_display, m_part, m_presentations, m_answers, m_timeLeft, m_nextBreak, m_sitting})
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
    m_displayName = shortName(ownNameOf(facts.displayName));
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

void SessionHeader::showDisplay(const session::View& view)
{
    const auto textWith = [&](const QString& name) {
        if (!m_pattern.isEmpty()) return tr("Display on: %1 (%2)").arg(m_pattern, name);
        return isFelt(view) ? tr("Display on: %1").arg(name) : tr("Display off: %1").arg(name);
    };
    const QString ellipsis = QStringLiteral("…");
    m_display->setText(m_displayName.isEmpty() ? tr("NO DISPLAY: rehearsal") : textWith(m_displayName));
    m_shortestDisplay =
        isFelt(view) || !m_pattern.isEmpty() ? tr("Display on: %1").arg(ellipsis) : tr("Display off: %1").arg(ellipsis);
}

void SessionHeader::present(const session::View& view)
{
    showDisplay(view);
    const bool isOver = std::holds_alternative<session::Finished>(view.state.stage) ||
                        std::holds_alternative<session::Withdrawn>(view.state.stage);
    const bool isBetween = isOver || view.presentation <= 0 || std::holds_alternative<session::Debriefing>(view.state.stage);
    m_participant->setText(m_isRehearsal ? tr("REHEARSAL: nothing becomes data")
                                         : tr("Participant %1").arg(QString::fromStdString(view.participant)));
    m_part->setText(isBetween || view.phaseName.empty() ? QString() : phaseText(view));
    m_presentations->setText(isBetween ? QString() : tr("Presentation %1 of %2").arg(view.presentation).arg(view.presentations));
    const AnswerCount answers = countedAnswers(view);
    m_answers->setText(tr("Answers %1 of %2").arg(answers.given).arg(answers.inAll));
    const int minutes = std::max(1, static_cast<int>(std::lround(view.minutesLeft)));
    m_timeLeft->setText(isBetween ? QString() : tr("About %1 min left").arg(minutes));
    m_sitting->setText(
        isOver ? QString() : tr("This sitting: %1 of %2 min").arg(static_cast<int>(view.sittingMinutes)).arg(m_sittingMinutes));
    m_nextBreak->setText(isBetween || view.presentationsToBreak <= 0
                             ? QString()
                             : tr("Presentations to next break: %1").arg(view.presentationsToBreak));
    m_bar->setRange(0, std::max(1, answers.inAll));
    m_bar->setValue(std::min(answers.given, answers.inAll));
    arrange();
}

/// A low window shows what one row holds. The display takes the room that the facts before it leave.
void SessionHeader::arrange()
{
    const bool isLow = isLowFor(*this), hasDisplay = !m_displayName.isEmpty();
    const double scale = scaleOf(window()->size());
    const int gap = static_cast<int>(std::ceil(gapPx * scale));
    int room = contentsRect().width() - static_cast<int>(std::ceil(2 * sidePx * scale)) + gap;
    for (QLabel* fact : inOrderOfImportance()) {
        fact->ensurePolished();
        const bool isWanted = !fact->text().isEmpty(), isKept = fact == m_participant || (fact == m_display && !hasDisplay);
        const int whole = fact->sizeHint().width(), least = fact == m_display && hasDisplay ? shortestDisplay() : whole;
        if (isWanted) room -= least + gap;
        const int more = isLow ? std::clamp(room, 0, std::max(0, whole - least)) : whole - least;
        if (fact == m_display) m_display->setMaximumWidth(isLow && hasDisplay ? least + more : QWIDGETSIZE_MAX);
        fact->setVisible(isWanted && (!isLow || isKept || room >= 0));
        room -= isWanted ? more : 0;
    }
    for (QLabel* fact : {m_participant, m_part})
        fact->setToolTip(fact->sizeHint().width() > contentsRect().width() - 2 * sidePx ? fullName(fact->text()) : QString());
    layout()->invalidate();  // its height depends on the size of the text
    updateGeometry();
}

/// The name of a display gives way to what changes. That there is none stays in view.
std::vector<QLabel*> SessionHeader::inOrderOfImportance() const
{
    if (m_displayName.isEmpty())
        return {m_participant, m_display, m_presentations, m_answers, m_timeLeft, m_nextBreak, m_part, m_sitting};
    return {m_participant, m_presentations, m_answers, m_timeLeft, m_display, m_nextBreak, m_part, m_sitting};
}

int SessionHeader::shortestDisplay() const
{
    return std::min(m_display->sizeHint().width(), std::max(m_display->minimumSizeHint().width(),
                                                            m_display->fontMetrics().horizontalAdvance(m_shortestDisplay)));
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
