#include "study/app/pieces/slot_card.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "study/app/pieces/pieces.h"

namespace study::app {

SlotCard::SlotCard(const QString& letter, QWidget* parent)
    : QFrame(parent),
      m_letter(label("slotLetter", Type::Title, this, Weight::Bold)),
      m_tag(label("slotTag", Type::Body, this)),
      m_piece(label("slotPiece", Type::Huge, this))
{
    setObjectName(QStringLiteral("slotCard%1").arg(letter));
    m_letter->setText(letter);
    m_letter->setWordWrap(false);
    m_tag->setWordWrap(false);
    m_piece->setWordWrap(false);
    auto* top = new QHBoxLayout;
    top->addWidget(m_letter);
    top->addWidget(m_tag, 0, Qt::AlignTop);
    top->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(20, 16, 20, 16);
    column->addLayout(top);
    column->addStretch(1);
    column->addWidget(m_piece, 0, Qt::AlignHCenter);
    column->addStretch(1);
}

void SlotCard::showPiece(const QString& piece, const QString& act, bool isNew, bool hasLetter)
{
    setRole(*this, isNew ? "card-new" : "card");
    setRole(*m_tag, isNew ? "tag-new" : "tag");
    setType(*m_tag, Type::Body, isNew ? Weight::Bold : Weight::Normal);
    setType(*m_piece, Type::Huge, isNew ? Weight::Bold : Weight::Normal);
    m_letter->setVisible(hasLetter);
    m_act = act;
    m_tag->setText(act);
    m_piece->setText(piece);
    describe();
}

void SlotCard::setConfirmed(bool isConfirmed)
{
    m_tag->setText(isConfirmed ? tr("confirmed ✓") : m_act);
    describe();
}

void SlotCard::describe()
{
    const QString said = tr("%1, %2").arg(m_piece->text(), m_tag->text());
    m_piece->setAccessibleName(m_letter->isHidden() ? said : tr("Slot %1: %2").arg(m_letter->text(), said));
}

}  // namespace study::app
