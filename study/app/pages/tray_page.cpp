#include "study/app/pages/tray_page.h"

#include <QGridLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "study/app/pieces/pieces.h"
#include "study/app/pieces/question_head.h"
#include "study/app/pieces/slot_card.h"
#include "study/app/state/answer_form.h"
#include "study/app/state/tray_steps.h"

namespace study::app {

namespace {

constexpr int cardsInARow = 3;

}  // namespace

TrayPage::TrayPage(QWidget* parent)
    : StagePage(parent),
      m_code(quietLabel("presentationCode", this)),
      m_instruction(label("blockInstruction", Type::Lead, this, Weight::Bold)),
      m_task(label("trayTask", Type::Title, this, Weight::Bold)),
      m_slots(new QWidget(this)),
      m_grid(new QGridLayout(m_slots)),
      m_piece(field("pieceField", tr("Code of the next piece"), this)),
      m_stroke(quietLabel("strokeWords", this, Type::Plain)),
      m_ready(mainButton("trayReadyButton", tr("The tray is ready (Enter)"), this))
{
    m_slots->setLayoutDirection(Qt::LeftToRight);
    m_grid->setContentsMargins(0, 0, 0, 0);
    m_grid->setSpacing(18);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(6);
    column->addWidget(m_instruction);
    column->addWidget(m_task);
    column->addSpacing(10);
    column->addWidget(m_slots, 1);
    column->addSpacing(10);
    column->addWidget(m_piece);
    column->addLayout(m_messagePlace);
    column->addWidget(m_ready, 0, Qt::AlignLeft);
    column->addSpacing(10);
    column->addWidget(m_stroke);
    column->addWidget(m_code);
    m_piece->setMaximumWidth(420);
    connect(m_piece, &QLineEdit::textEdited, this, &StagePage::mended);
    connect(m_ready, &QPushButton::clicked, this, &TrayPage::confirm);
}

void TrayPage::begin(const SessionFacts& facts)
{
    m_placed.clear();
    m_confirmsPieces = facts.confirmPieces;
    setButtonText(*m_ready, facts.keys.withKeys(tr("The tray is ready"), KeyAct::Confirm));
    m_piece->setVisible(m_confirmsPieces);
    m_wanted.clear();
    m_shownFor.reset();
    showText(*m_stroke, strokeText(facts));
}

QString TrayPage::actOf(const session::View& view, std::size_t place) const
{
    const std::string& piece = view.tray[place];
    if (place < m_placed.size() && m_placed[place] == piece) return tr("stays");
    const auto from = std::ranges::find(m_placed, piece);
    if (from == m_placed.end()) return tr("put here");
    return view.tray.size() > 1 ? tr("from %1").arg(slotLetter(static_cast<std::size_t>(from - m_placed.begin()))) : tr("stays");
}

void TrayPage::present(const session::View& view)
{
    m_code->setText(tr("Presentation %1").arg(QString::fromStdString(view.code.value)));
    showText(*m_instruction, instructionToSay(view));
    showCards(view);
    m_task->setText(trayStepsText(trayStepsTo(view.tray, m_placed), view.tray.size()));
    const bool isSameTray = m_shownFor == view.state.trayAskedAtNs && m_wanted == view.tray;
    m_shownFor = view.state.trayAskedAtNs;
    m_wanted = view.tray;
    if (isSameTray) return showConfirmed();  // a note or a fault must not take back what is confirmed
    m_confirmed.clear();
    m_isTypedAhead = false;
    m_piece->clear();
    showConfirmed();
}

/// A scanner types the code and presses Enter.
void TrayPage::takePiece()
{
    const std::string read = m_piece->text().trimmed().toStdString();
    const std::size_t slot = m_confirmed.size();
    m_piece->clear();
    if (read != m_wanted[slot])
        return Q_EMIT hinted(tr("%1 is not the piece of slot %2. It must be %3.")
                                 .arg(QString::fromStdString(read), slotLetter(slot), QString::fromStdString(m_wanted[slot])));
    m_confirmed.push_back(read);
    Q_EMIT hinted({});
    showConfirmed();
}

void TrayPage::showConfirmed()
{
    if (!m_confirmsPieces) return;
    for (std::size_t slot = 0; slot < m_wanted.size(); ++slot) m_cards[slot]->setConfirmed(slot < m_confirmed.size());
    const bool isComplete = m_confirmed.size() == m_wanted.size();
    m_piece->setEnabled(!isComplete);
    m_piece->setPlaceholderText(isComplete ? tr("All pieces are confirmed.")
                                           : tr("Scan or type the piece in slot %1").arg(slotLetter(m_confirmed.size())));
    firstFocus().setFocus();
}

void TrayPage::confirm()
{
    if (!m_piece->text().trimmed().isEmpty() && m_confirmed.size() < m_wanted.size()) return takePiece();
    Q_EMIT eventRequested(session::TrayReady{m_confirmed});
}

void TrayPage::showCards(const session::View& view)
{
    while (m_cards.size() < view.tray.size()) {
        m_cards.push_back(new SlotCard(slotLetter(m_cards.size()), m_slots));
        const int place = static_cast<int>(m_cards.size()) - 1;
        m_grid->addWidget(m_cards.back(), place / cardsInARow, place % cardsInARow);
    }
    // Cards are reused for the next tray, because making a card takes longer than showing one.
    for (std::size_t place = 0; place < m_cards.size(); ++place) {
        const bool isNeeded = place < view.tray.size();
        if (isNeeded)
            m_cards[place]->showPiece(QString::fromStdString(view.tray[place]), actOf(view, place),
                                      actOf(view, place) != tr("stays"), view.tray.size() > 1);
        m_cards[place]->setVisible(isNeeded);
    }
}

int TrayPage::lettersTaken() const { return std::max(StagePage::lettersTaken(), static_cast<int>(m_wanted.size())); }

bool TrayPage::pressKey(int key)
{
    const int letters = std::max(4, static_cast<int>(m_wanted.size()));  // D is "different" at every tray
    const bool isOfAnAnswer = (key >= Qt::Key_0 && key <= Qt::Key_9) || (key >= Qt::Key_A && key < Qt::Key_A + letters) ||
                              key == Qt::Key_S || key == Qt::Key_Period || key == Qt::Key_Comma;
    if (isOfAnAnswer) {
        // Who types an answer now believes that the presentation runs. The Enter that follows must not begin it.
        m_isTypedAhead = true;
        Q_EMIT hinted(tr("No question is asked yet, so this key is no answer. Look at the tray, then press Enter twice."));
        return true;
    }
    if (!isEnter(key)) return false;
    if (std::exchange(m_isTypedAhead, false))
        Q_EMIT hinted(tr("Press Enter once more to confirm the tray."));
    else
        confirm();
    return true;
}

QWidget& TrayPage::firstFocus()
{
    const bool isOpen = m_confirmsPieces && m_confirmed.size() < m_wanted.size();
    return isOpen ? static_cast<QWidget&>(*m_piece) : *m_ready;
}

}  // namespace study::app
