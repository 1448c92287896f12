#include "study/app/pages/tray_page.h"

#include <QGridLayout>
#include <QVBoxLayout>

#include "study/app/pieces/pieces.h"
#include "study/app/pieces/slot_card.h"
#include "study/app/state/answer_form.h"

namespace study::app {

namespace {

constexpr int cardsInARow = 3;

}  // namespace

TrayPage::TrayPage(QWidget* parent)
    : StagePage(parent),
      m_code(label("presentationCode", Type::Huge, this, Weight::Bold)),
      m_task(label("trayTask", Type::Lead, this)),
      m_grid(new QGridLayout),
      m_stroke(quietLabel("strokeWords", this, Type::Plain)),
      m_ready(mainButton("trayReadyButton", tr("The tray is ready (Enter)"), this))
{
    auto* caption = quietLabel("presentationCaption", this);
    caption->setText(tr("Presentation"));
    m_grid->setSpacing(18);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(6);
    column->addWidget(caption);
    column->addWidget(m_code);
    column->addSpacing(6);
    column->addWidget(m_task);
    column->addSpacing(6);
    column->addLayout(m_grid);
    column->addSpacing(10);
    column->addWidget(m_ready, 0, Qt::AlignLeft);
    column->addSpacing(10);
    column->addWidget(m_stroke);
    column->addStretch(1);
    connect(m_ready, &QPushButton::clicked, this, [this] { Q_EMIT eventRequested(session::TrayReady{}); });
}

void TrayPage::begin(const SessionFacts& facts)
{
    m_placed.clear();
    showText(*m_stroke, strokeText(facts));
}

bool TrayPage::isNew(const session::View& view, std::size_t place) const
{
    return m_placed.size() != view.trayIds.size() || m_placed[place] != view.trayIds[place];
}

void TrayPage::present(const session::View& view)
{
    m_code->setText(QString::fromStdString(view.code.value));
    showCards(view);
    bool isAnyNew = false;
    for (std::size_t place = 0; place < view.trayIds.size(); ++place) isAnyNew = isAnyNew || isNew(view, place);
    if (!isAnyNew)
        m_task->setText(tr("All pieces stay on the tray."));
    else
        m_task->setText(view.tray.size() == 1 ? tr("Put this piece on the tray.") : tr("Put these pieces on the tray."));
}

void TrayPage::showCards(const session::View& view)
{
    while (m_cards.size() < view.tray.size()) {
        m_cards.push_back(new SlotCard(slotLetter(m_cards.size()), this));
        const int place = static_cast<int>(m_cards.size()) - 1;
        m_grid->addWidget(m_cards.back(), place / cardsInARow, place % cardsInARow);
    }
    // Cards are reused for the next tray, because making a card takes longer than showing one.
    for (std::size_t place = 0; place < m_cards.size(); ++place) {
        const bool isNeeded = place < view.tray.size();
        if (isNeeded) m_cards[place]->showPiece(nameOfPiece(view.tray[place]), isNew(view, place), view.tray.size() > 1);
        m_cards[place]->setVisible(isNeeded);
    }
}

bool TrayPage::pressKey(int key)
{
    if (!isEnter(key)) return false;
    Q_EMIT eventRequested(session::TrayReady{});
    return true;
}

QWidget& TrayPage::firstFocus() { return *m_ready; }

}  // namespace study::app
