#include "study/app/pages/study_page.h"

#include <QFrame>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QKeyEvent>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "protocols/files/id_rule.h"
#include "protocols/files/utf8.h"
#include "study/app/language/below.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

using database::SlotState;

namespace {

constexpr int numberColumn = 0, participantColumn = 1, stateColumn = 2, answersColumn = 3;

/// Equal for codes that look alike: "p01" and "P01", or one letter that two keyboards write with different characters.
QString lookOf(const QString& code) { return code.normalized(QString::NormalizationForm_KC).toCaseFolded(); }

const QString releaseOption = QStringLiteral("--release-held");

/// The same option with word joiners, so that no line ends within it.
QString inOnePiece(QString option) { return option.replace(QLatin1Char('-'), QStringLiteral("-\u2060")); }

QString noRehearsal()
{
    return StudyPage::tr(
        "There is no rehearsal at a station: the images and the codes of the pieces lie on the server. Rehearse in the study's "
        "folder before it moves there.");
}

}  // namespace

StudyPage::StudyPage(QWidget* parent)
    : QWidget(parent),
      m_title(label("studyTitle", Type::Title, this, Weight::Bold)),
      m_folder(quietLabel("studyFolder", this, Type::Plain)),
      m_summary(label("studySummary", Type::Lead, this)),
      m_middle(new QBoxLayout(QBoxLayout::LeftToRight)),
      m_places(new QTreeWidget(this)),
      m_going(field("resumeField", tr("Code of the participant who goes on"), this)),
      m_resume(mainButton("resumeButton", tr("Continue a session"), this)),
      m_enrolHint(quietLabel("cardHint", this, Type::Plain)),
      m_participant(field("participantField", tr("Code of the next participant"), this)),
      m_enrol(mainButton("enrolButton", tr("Enrol and begin (Enter)"), this)),
      m_display(button("displayButton", tr("Display…"), this)),
      m_keys(button("studyKeysButton", tr("Keys…"), this)),
      m_screen(button("participantScreenButton", tr("Participant's screen… (F4)"), this)),
      m_close(plainButton("closeStudyButton", tr("Close the study (Esc)"), this)),
      m_tools(plainButton("toolsButton", tr("Tools… (F2)"), this)),
      m_rehearsal(button("rehearsalButton", tr("Rehearse… (F8)"), this)),
      m_message(new MessageBar("studyMessage", this)),
      m_remarks(new MessageBar("studyRemarks", this))
{
    setObjectName("studyPage");
    name(*m_places, "placesList", tr("Places of the study"));
    setType(*m_places, Type::Body);
    m_places->setRootIsDecorated(false);
    m_places->setAllColumnsShowFocus(true);
    m_places->setHeaderLabels({tr("Place"), tr("Participant"), tr("State"), tr("Answers")});
    m_places->header()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_places->header()->setStretchLastSection(true);
    m_places->header()->setFocusPolicy(Qt::NoFocus);
    setType(*m_places->header(), Type::Small);
    setType(*m_participant, Type::Lead, Weight::Bold);
    setType(*m_going, Type::Lead, Weight::Bold);

    auto* side = new QVBoxLayout;
    side->setSpacing(14);
    auto* resumeHint = quietLabel("cardHint", this, Type::Plain);
    resumeHint->setText(tr("Type the code of the participant who is here."));
    side->addWidget(card("enrolCard", tr("Next participant"), m_enrolHint, {m_participant, m_enrol}));
    side->addWidget(card("resumeCard", tr("Session in progress"), resumeHint, {m_going, m_resume}));
    side->addStretch(1);
    m_middle->setSpacing(22);
    m_middle->addLayout(side, 2);
    m_middle->addWidget(m_places, 3);
    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    column->addWidget(m_title);
    column->addWidget(m_folder);
    column->addWidget(m_summary);
    column->addWidget(m_remarks);
    column->addWidget(m_message);
    column->addSpacing(10);
    column->addLayout(m_middle, 1);
    column->addLayout(actionsRow({m_display, m_keys, m_screen, m_rehearsal, m_tools, m_close}));
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("studyArea", page, this));
    setTabOrder(m_participant, m_enrol);
    setTabOrder(m_enrol, m_going);
    setTabOrder(m_going, m_resume);
    setTabOrder(m_resume, m_places);
    setTabOrder(m_places, m_display);
    setTabOrder(m_display, m_keys);
    setTabOrder(m_keys, m_screen);
    setTabOrder(m_screen, m_rehearsal);
    setTabOrder(m_rehearsal, m_tools);
    setTabOrder(m_tools, m_close);

    connect(m_display, &QPushButton::clicked, this, &StudyPage::displayRequested);
    connect(m_keys, &QPushButton::clicked, this, &StudyPage::keysRequested);
    connect(m_screen, &QPushButton::clicked, this, &StudyPage::participantRequested);
    connect(m_enrol, &QPushButton::clicked, this, &StudyPage::enrol);
    connect(m_resume, &QPushButton::clicked, this, &StudyPage::resumeChosen);
    connect(m_participant, &QLineEdit::textChanged, this, [this] { m_isAskedAgain = false; });
    for (const QLineEdit* line : {m_participant, m_going})
        connect(line, &QLineEdit::textChanged, m_message, &MessageBar::clearMessage);
    connect(m_places, &QTreeWidget::itemActivated, this, &StudyPage::resumeChosen);
    connect(m_places, &QTreeWidget::currentItemChanged, this, &StudyPage::showChosen);
    connect(m_close, &QPushButton::clicked, this, &StudyPage::closeRequested);
    connect(m_tools, &QPushButton::clicked, this, &StudyPage::toolsRequested);
    connect(m_rehearsal, &QPushButton::clicked, this, &StudyPage::rehearsalRequested);
}

QFrame* StudyPage::card(const char* objectName, const QString& caption, QLabel* hint, const std::vector<QWidget*>& controls)
{
    auto* made = new QFrame(this);
    made->setObjectName(QString::fromLatin1(objectName));
    setRole(*made, "card");
    auto* column = new QVBoxLayout(made);
    column->setContentsMargins(20, 16, 20, 18);
    column->setSpacing(10);
    auto* title = label("cardTitle", Type::Lead, made, Weight::Bold);
    title->setText(caption);
    column->addWidget(title);
    column->addWidget(hint);
    for (QWidget* control : controls) column->addWidget(control);
    return made;
}

void StudyPage::arrange()
{
    // Side by side if both fit, otherwise one below the other.
    const int side = std::max(m_enrol->sizeHint().width(), m_resume->sizeHint().width()) + 60;
    int list = 40;
    for (int column = 0; column < m_places->columnCount(); ++column)
        list += std::max(m_places->header()->sectionSizeHint(column),
                         static_cast<QAbstractItemView*>(m_places)->sizeHintForColumn(column));
    const bool isWide = side + list + m_middle->spacing() + 60 <= width();
    m_middle->setDirection(isWide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    m_places->setMinimumWidth(isWide ? list : 0);
    m_places->setMinimumHeight(m_places->fontMetrics().height() * 9);
}

void StudyPage::resizeEvent(QResizeEvent* event)
{
    QWidget::resizeEvent(event);
    arrange();
}

void StudyPage::changeEvent(QEvent* event)
{
    QWidget::changeEvent(event);
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange) arrangeSoon();
}

void StudyPage::showEvent(QShowEvent* event)
{
    QWidget::showEvent(event);
    arrangeSoon();
}

void StudyPage::arrangeSoon()
{
    // Queued, because the widgets of the page get their font after the page itself.
    QMetaObject::invokeMethod(this, &StudyPage::arrange, Qt::QueuedConnection);
}

void StudyPage::present(const StudyOverview& overview, database::ParticipantKind kind)
{
    m_kind = kind;
    m_message->clearMessage();
    m_message->standBelow(*m_summary);
    if (m_folder->text() != overview.folder) m_remarks->clearMessage();  // they are of another study
    m_isAskedAgain = false;
    m_going->clear();
    m_title->setText(overview.name);
    m_folder->setText(overview.folder);
    refresh(overview);
    const bool hasFree = overview.placesIn(SlotState::Free) > 0;
    m_participant->setText(hasFree ? overview.nextParticipant : QString());
    m_participant->setEnabled(hasFree);
    m_enrol->setEnabled(hasFree);
}

void StudyPage::refresh(const StudyOverview& overview)
{
    m_overview = overview;
    const int withdrawn = overview.placesIn(SlotState::Withdrawn);
    const QString counts = tr("Finished %1  ·  in progress %2  ·  free %3")
                               .arg(overview.placesIn(SlotState::Finished))
                               .arg(overview.placesIn(SlotState::Started))
                               .arg(overview.placesIn(SlotState::Free));
    m_summary->setText(withdrawn > 0 ? tr("%1  ·  withdrawn %2").arg(counts).arg(withdrawn) : counts);
    m_enrolHint->setText(
        overview.placesIn(SlotState::Free) == 0 && overview.hasHeldPlace()
            ? tr("No place is free. Places of participants who withdrew wait for the study's owner, who gives them "
                 "out: vis2hap server roles ADDRESS --release-held. Then open the study again.")
                  .replace(releaseOption, inOnePiece(releaseOption))
            : tr("Type a code, not the name of the person."));
    m_rehearsal->setEnabled(!overview.isAtStation);
    m_rehearsal->setToolTip(overview.isAtStation ? fullName(noRehearsal()) : QString());
    const bool isNew = std::ranges::all_of(overview.places, [](const auto& place) { return place.state == SlotState::Free; });
    if (!isNew) m_remarks->clearMessage();
    showPlaces();
}

void StudyPage::showPlaces()
{
    m_places->clear();
    QTreeWidgetItem* toResume = nullptr;
    for (const auto& place : m_overview.places) {
        auto* row = new QTreeWidgetItem(m_places);
        row->setText(numberColumn, QString::number(place.number));
        row->setText(participantColumn, place.participant.isEmpty() ? QStringLiteral("–") : place.participant);
        row->setText(stateColumn, stateText(place));
        row->setText(answersColumn,
                     place.state == SlotState::Free ? QString() : tr("%1 of %2").arg(place.answers).arg(m_overview.answersInAll));
        if (!toResume && canResume(place)) toResume = row;
    }
    m_places->setCurrentItem(toResume);
    showChosen();
    arrange();
}

QString StudyPage::stateText(const StudyOverview::ParticipantPlace& place) const
{
    QString text;
    switch (place.state) {
        case SlotState::Free:
            text = tr("free");
            break;
        case SlotState::Started:
            text = tr("in progress");
            break;
        case SlotState::Finished:
            text = tr("finished");
            break;
        case SlotState::Withdrawn:
            text = place.isHeld ? tr("withdrawn, waits for the owner") : tr("withdrawn, place freed");
            break;
    }
    switch (place.kind) {
        case database::ParticipantKind::Human:
            return text;
        case database::ParticipantKind::Scripted:
            return place.participant.isEmpty() ? text : tr("%1, scripted").arg(text);
        case database::ParticipantKind::Simulated:
            return place.participant.isEmpty() ? text : tr("%1, simulated").arg(text);
    }
    return text;
}

bool StudyPage::canResume(const StudyOverview::ParticipantPlace& place) const
{
    return place.state == SlotState::Started && place.kind == m_kind;
}

const StudyOverview::ParticipantPlace* StudyPage::chosenPlace() const
{
    const int row = m_places->indexOfTopLevelItem(m_places->currentItem());
    return row < 0 ? nullptr : &m_overview.places.at(static_cast<std::size_t>(row));
}

void StudyPage::showChosen()
{
    m_message->clearMessage();
    const auto* place = chosenPlace();
    const bool isResumable = place && canResume(*place);
    m_resume->setEnabled(isResumable);
    m_going->setEnabled(isResumable);
    setButtonText(*m_resume, isResumable ? tr("Continue with %1").arg(place->participant) : tr("Continue a session"));
}

/// Two acts that do not follow each other must agree: the row of the list and the typed code. So one slip opens nobody's session.
void StudyPage::resumeChosen()
{
    const auto* place = chosenPlace();
    const QString typed = m_going->text().trimmed();
    m_message->clearMessage();
    m_message->standBelow(*m_going);
    if (!place || !canResume(*place))
        m_message->showHint(tr("Choose a participant whose session has started but is not finished."));
    else if (typed != place->participant) {
        m_going->setFocus();
        m_message->showHint(typed.isEmpty()
                                ? tr("Type %1 to continue with this participant.").arg(place->participant)
                                : tr("%1 is chosen in the list, and %2 is typed. Choose and type the same participant.")
                                      .arg(place->participant, typed));
    } else
        Q_EMIT sessionRequested(place->participant);
}

void StudyPage::enrol()
{
    Q_EMIT placesWanted();
    const QString participant = m_participant->text().trimmed();
    const auto alike = std::find_if(m_overview.places.begin(), m_overview.places.end(),
                                    [&](const auto& place) { return lookOf(place.participant) == lookOf(participant); });
    const bool isKnown = alike != m_overview.places.end();
    m_message->clearMessage();
    m_message->standBelow(*m_participant);
    if (participant.isEmpty())
        m_message->showHint(tr("Type a code for the next participant, such as %1.").arg(m_overview.nextParticipant));
    else if (const std::string fault = isKnown ? std::string() : protocols::faultOfNewId(participant.toStdString());
             !fault.empty())
        m_message->showHint(
            protocols::faultOfId(participant.toStdString()).empty()
                ? tr("This code %1. Type another code, such as %2.").arg(inOwnLanguage(fault), m_overview.nextParticipant)
                : tr("This code %1. Type at most %2 letters and digits, such as %3.")
                      .arg(inOwnLanguage(fault))
                      .arg(protocols::longestId)
                      .arg(m_overview.nextParticipant));
    else if (isKnown && alike->state == SlotState::Withdrawn)
        m_message->showHint(tr("%1 has withdrawn. Type another code.").arg(alike->participant));
    else if (isKnown)
        m_message->showHint(tr("%1 is already enrolled. Choose this participant in the list to continue, or type another code.")
                                .arg(alike->participant));
    else if (m_overview.placesIn(SlotState::Started) > 0 && !m_isAskedAgain) {
        m_isAskedAgain = true;
        m_message->showHint(tr("A session is in progress. Press Enter again to enrol %1 as a new participant.").arg(participant));
        Q_EMIT secondEnterAsked();
    } else
        Q_EMIT enrolmentRequested(participant);
}

void StudyPage::offerTools(bool isOffered) { m_tools->setVisible(isOffered); }

void StudyPage::offerRehearsal(bool isOffered) { m_rehearsal->setVisible(isOffered); }

void StudyPage::askForRehearsal()
{
    if (m_rehearsal->isEnabled()) return m_rehearsal->click();
    m_message->clearMessage();  // so that the same words come into view again
    m_message->standBelow(*m_summary);
    m_message->showHint(noRehearsal());
}

void StudyPage::showFault(const QString& text) { m_message->showFault(text); }

void StudyPage::showRemarks(const QStringList& remarks)
{
    constexpr qsizetype mostLines = 5;
    constexpr std::size_t longestRemark = 300;  // bytes; the page must keep its places in view
    if (remarks.isEmpty()) return m_remarks->clearMessage();
    QStringList lines{tr("The study is made. Look at these remarks before the first session:")};
    for (const QString& remark : remarks.first(std::min(mostLines, remarks.size())))
        lines << QString::fromStdString(protocols::inShort(remark.toStdString(), longestRemark));
    if (remarks.size() > mostLines) lines << tr("And %1 more.").arg(remarks.size() - mostLines);
    m_remarks->showHint(lines.join(QLatin1Char('\n')));
}

void StudyPage::showHint(const QString& text) { m_message->showHint(text); }

void StudyPage::focusFirst()
{
    if (m_resume->isEnabled())
        m_going->setFocus();
    else if (m_participant->isEnabled())
        m_participant->setFocus();
    else {
        m_places->setFocus();
        bringIntoView(*m_enrolHint);  // it says why nobody can be enrolled
    }
}

void StudyPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        Q_EMIT closeRequested();
    else if (event->key() == Qt::Key_F2 && m_tools->isVisible())
        m_tools->click();
    else if (event->key() == Qt::Key_F8 && m_rehearsal->isVisible())
        askForRehearsal();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()) && focusWidget() == m_participant)
        enrol();
    else if (isEnter(event->key()) && focusWidget() == m_going)
        resumeChosen();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
