#include "study/app/tray_page.h"

#include "study/app/pieces.h"

#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace study::app {

TrayPage::TrayPage(QWidget* parent)
    : StagePage(parent),
      m_code(label("presentationCode", Type::Huge, this, Weight::Bold)),
      m_task(label("trayTask", Type::Lead, this)),
      m_cards(new QHBoxLayout),
      m_ready(mainButton("trayReadyButton", tr("The tray is ready (Enter)"), this))
{
    auto* caption = quietLabel("presentationCaption", this);
    caption->setText(tr("Presentation"));
    m_cards->setSpacing(18);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(6);
    column->addWidget(caption);
    column->addWidget(m_code);
    column->addSpacing(6);
    column->addWidget(m_task);
    column->addSpacing(6);
    column->addLayout(m_cards);
    column->addSpacing(10);
    column->addWidget(m_ready, 0, Qt::AlignLeft);
    column->addStretch(1);
    connect(m_ready, &QPushButton::clicked, this, [this] { Q_EMIT eventAsked(session::TrayReady{}); });
}

TrayPage::Change TrayPage::changeOf(const session::View& view, std::size_t place) const
{
    const bool isThere = m_placed.size() == view.trayIds.size() && m_placed[place] == view.trayIds[place];
    return isThere ? Change::AsBefore : Change::New;
}

QWidget* TrayPage::cardFor(std::size_t place, const QString& fabric, Change change, bool isOnlyOne)
{
    const bool isNew = change == Change::New;
    auto* card = new QFrame(this);
    card->setObjectName(QStringLiteral("slotCard%1").arg(slotLetter(place)));
    setRole(*card, isNew ? "card-new" : "card");
    auto* column = new QVBoxLayout(card);
    column->setContentsMargins(20, 16, 20, 16);
    auto* letter = label("slotLetter", Type::Title, card, Weight::Bold);
    letter->setText(isOnlyOne ? QString() : slotLetter(place));
    letter->setVisible(!isOnlyOne);
    auto* tag = label("slotTag", Type::Small, card, isNew ? Weight::Bold : Weight::Normal);
    tag->setText(isNew ? tr("put here") : tr("stays"));
    tag->setWordWrap(false);
    setRole(*tag, isNew ? "tag-new" : "tag");
    auto* top = new QHBoxLayout;
    top->addWidget(letter, 1);
    top->addWidget(tag, 0, Qt::AlignTop | (isOnlyOne ? Qt::AlignLeft : Qt::AlignRight));
    auto* fabricName = label("slotFabric", Type::Title, card, isNew ? Weight::Bold : Weight::Normal);
    fabricName->setText(fabric);
    column->addLayout(top);
    column->addWidget(fabricName);
    column->addStretch(1);
    return card;
}

void TrayPage::present(const session::View& view)
{
    while (QLayoutItem* item = m_cards->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    m_code->setText(QString::fromStdString(view.code.value));
    const bool isOnlyOne = view.tray.size() == 1;
    bool isAnyNew = false;
    for (std::size_t place = 0; place < view.tray.size(); ++place) {
        const Change change = changeOf(view, place);
        isAnyNew = isAnyNew || change == Change::New;
        QWidget* card = cardFor(place, QString::fromStdString(view.tray[place]), change, isOnlyOne);
        m_cards->addWidget(card, 1);
        card->show();
    }
    if (!isAnyNew)
        m_task->setText(tr("Nothing to change."));
    else
        m_task->setText(isOnlyOne ? tr("Put this fabric on the tray.") : tr("Put these fabrics on the tray."));
}

bool TrayPage::pressKey(int key)
{
    if (!isEnter(key))
        return false;
    Q_EMIT eventAsked(session::TrayReady{});
    return true;
}

QWidget& TrayPage::firstFocus()
{
    return *m_ready;
}

}  // namespace study::app
