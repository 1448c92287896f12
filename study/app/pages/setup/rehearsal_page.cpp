#include "study/app/pages/setup/rehearsal_page.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QVBoxLayout>

#include "study/app/language/app_text.h"
#include "study/app/pages/stage_page.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/tick_box.h"

namespace study::app {

QStringList RehearsalState::missing() const
{
    QStringList phrases;
    const auto add = [&](bool isMissing, const QString& phrase) {
        if (isMissing) phrases << phrase;
    };
    add(!displayIsThere, RehearsalPage::tr("a display"));
    add(displayIsThere && !patternWasFelt, RehearsalPage::tr("a test pattern that was felt"));
    add(!soundWasHeard, RehearsalPage::tr("the masking sound"));
    add(!sheetsAreThere, RehearsalPage::tr("the sheets"));
    add(piecesLeft.size() == 1, RehearsalPage::tr("one fabric piece"));
    add(piecesLeft.size() > 1, RehearsalPage::tr("%1 fabric pieces").arg(piecesLeft.size()));
    add(!diskFault.isEmpty(), RehearsalPage::tr("a disk in order"));
    add(!clockFault.isEmpty(), RehearsalPage::tr("a clock in order"));
    add(!sessionWasPlayed, RehearsalPage::tr("a session played to its end"));
    return phrases;
}

RehearsalPage::RehearsalPage(QWidget* parent)
    : QWidget(parent),
      m_display(label("rehearsalDisplay", Type::Body, this)),
      m_pieces(label("rehearsalPieces", Type::Body, this)),
      m_piece(field("rehearsalPieceField", tr("Code of a fabric piece"), this)),
      m_computer(label("rehearsalComputer", Type::Body, this)),
      m_session(label("rehearsalSession", Type::Body, this)),
      m_result(label("rehearsalResult", Type::Lead, this, Weight::Bold)),
      m_play(mainButton("rehearsalPlayButton", tr("Play the session (F5)"), this)),
      m_chooseDisplay(button("rehearsalDisplayButton", tr("Display… (F6)"), this)),
      m_again(button("rehearsalAgainButton", tr("Check again (F7)"), this)),
      m_back(plainButton("rehearsalBackButton", tr("Back (Esc)"), this)),
      m_message(new MessageBar("rehearsalMessage", this))
{
    setObjectName("rehearsalPage");
    auto* page = new QWidget(this);
    auto* column = new QVBoxLayout(page);
    column->setSpacing(10);
    auto* head = new PageHead(page);
    head->setTexts(tr("Rehearsal"), tr("Try everything once before the first participant comes. Nothing of it becomes data."));
    column->addWidget(head);
    column->addWidget(m_result);
    column->addLayout(actionsRow({m_play, m_chooseDisplay, m_again, m_back}));
    column->addWidget(m_message);
    column->addWidget(m_display);
    m_felt =
        addTick(*column, "rehearsalFelt", tr("An edge or a grating was felt on the display."), &RehearsalState::patternWasFelt);
    m_heard =
        addTick(*column, "rehearsalHeard",
                tr("With the headphones on, the masking sound is heard, and the display and the fabrics are not. F4 plays it."),
                &RehearsalState::soundWasHeard);
    m_sheets = addTick(*column, "rehearsalSheets", tr("The sheets are printed: labels on the pieces, consent, facts, scale."),
                       &RehearsalState::sheetsAreThere);
    column->addWidget(m_pieces);
    column->addWidget(m_piece);
    column->addWidget(m_computer);
    column->addWidget(m_session);
    column->addStretch(1);
    column->addWidget(appearanceHint(page));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scrolling("rehearsalArea", page, this));
    m_piece->setMaximumWidth(520);
    connect(m_play, &QPushButton::clicked, this, &RehearsalPage::sessionRequested);
    connect(m_chooseDisplay, &QPushButton::clicked, this, &RehearsalPage::displayRequested);
    connect(m_again, &QPushButton::clicked, this, &RehearsalPage::checksRequested);
    connect(m_back, &QPushButton::clicked, this, &RehearsalPage::backRequested);
    connect(m_piece, &QLineEdit::textEdited, m_message, &MessageBar::clearMessage);
}

TickBox* RehearsalPage::addTick(QBoxLayout& column, const char* objectName, const QString& text, bool RehearsalState::*item)
{
    auto* box = new TickBox(this);
    name(*box, objectName, text);
    auto* words = label("rehearsalTickText", Type::Body, this);
    words->setText(text);
    words->setBuddy(box);
    box->takeClicksOf(*words);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    row->addWidget(box, 0, Qt::AlignTop);
    row->addWidget(words, 1);
    column.addLayout(row);
    connect(box, &QCheckBox::toggled, this, [this, item](bool isTicked) {
        m_state.*item = isTicked;
        show();
    });
    return box;
}

void RehearsalPage::begin(const QStringList& pieces)
{
    for (TickBox* box : {m_felt, m_heard, m_sheets}) box->setChecked(false);
    m_state = {};
    m_state.piecesLeft = pieces;
    m_piece->clear();
    m_message->clearMessage();
}

void RehearsalPage::showRoom(const QString& displayName, const QString& diskFault)
{
    m_displayName = displayName;
    m_state.displayIsThere = !displayName.isEmpty();
    m_state.diskFault = diskFault;
    m_state.clockFault = tr("The clock was not compared with the study.");
    show();
}

void RehearsalPage::refresh(const Study& study)
{
    m_study = study;
    m_state.clockFault = study.clockFault;
    m_message->clearFault();
    show();
}

void RehearsalPage::sessionLeft(bool isWhole)
{
    m_state.sessionWasPlayed = m_state.sessionWasPlayed || isWhole;
    m_message->standBelow(*m_play);
    if (!isWhole) m_message->showHint(tr("The session was left before its end. Play it again to see all of it."));
    show();
}

void RehearsalPage::readPiece()
{
    const QString code = m_piece->text().trimmed();
    if (code.isEmpty()) return;
    m_piece->clear();
    m_message->clearMessage();
    m_message->standBelow(*m_piece);
    if (m_state.piecesLeft.removeOne(code))
        m_message->showDone(tr("%1 is there.").arg(code));
    else if (m_study.pieces.contains(code))
        m_message->showHint(tr("%1 was read before.").arg(code));
    else
        m_message->showHint(tr("%1 is no code of this study. Read the label on the piece.").arg(code));
    show();
}

void RehearsalPage::show()
{
    m_display->setText(m_state.displayIsThere ? tr("Display: %1 is connected.").arg(shortName(m_displayName))
                                              : tr("No display is connected. Choose one on the page of the display."));
    m_display->setToolTip(fullName(m_displayName));
    m_felt->setEnabled(m_state.displayIsThere);
    const QString left = m_state.piecesLeft.join(listMark());
    m_pieces->setText(m_state.piecesLeft.isEmpty()
                          ? tr("Every fabric piece is there.")
                          : tr("Scan or type the code of every fabric piece. Still to come: %1").arg(left));
    m_piece->setEnabled(!m_state.piecesLeft.isEmpty());
    QStringList computer;
    computer << (m_state.diskFault.isEmpty() ? tr("The disk is in order.") : m_state.diskFault);
    computer << (m_state.clockFault.isEmpty() ? tr("The clock is in order.") : m_state.clockFault);
    m_computer->setText(sentencesTogether(computer));
    m_session->setText(m_state.sessionWasPlayed ? tr("The session was played to its end.")
                                                : tr("Play the session: every page, a few presentations of each part, a break. "
                                                     "Its images are patterns, not those of the study."));
    const QStringList missing = m_state.missing();
    setRole(*m_result, missing.isEmpty() ? "done" : "hint");
    m_result->setText(missing.isEmpty() ? tr("Ready for %1.").arg(m_study.nextParticipant)
                                        : tr("Still missing: %1.").arg(missing.join(listMark())));
}

void RehearsalPage::showFault(const QString& text)
{
    m_message->standBelow(*m_play);
    m_message->showFault(text);
}

void RehearsalPage::focusFirst()
{
    if (m_piece->isEnabled())
        m_piece->setFocus();
    else
        m_play->setFocus();
}

void RehearsalPage::keyPressEvent(QKeyEvent* event)
{
    auto* pressed = qobject_cast<QPushButton*>(focusWidget());
    if (event->key() == Qt::Key_Escape)
        Q_EMIT backRequested();
    else if (event->key() == Qt::Key_F5)
        m_play->click();
    else if (event->key() == Qt::Key_F6)
        m_chooseDisplay->click();
    else if (event->key() == Qt::Key_F7)
        m_again->click();
    else if (isEnter(event->key()) && pressed)
        pressed->click();
    else if (isEnter(event->key()) && focusWidget() == m_piece)
        readPiece();
    else
        QWidget::keyPressEvent(event);
}

}  // namespace study::app
