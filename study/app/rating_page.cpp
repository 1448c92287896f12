#include "study/app/rating_page.h"

#include "study/app/pieces.h"
#include "study/app/question_head.h"
#include "study/app/rating_field.h"
#include "study/app/rating_text.h"
#include "study/app/scale_line.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace study::app {

using protocols::Tenths;

RatingPage::RatingPage(QWidget* parent)
    : StagePage(parent),
      m_head(new QuestionHead(this)),
      m_rating(new RatingField("ratingField", tr("Rating that the participant says"), this)),
      m_range(quietLabel("ratingRange", this, Type::Lead)),
      m_line(new ScaleLine(ScaleLine::Use::Pick, this)),
      m_readBack(label("readBack", Type::Lead, this)),
      m_touch(new TouchButton(this)),
      m_store(mainButton("storeButton", tr("Store the answer (Enter)"), this))
{
    m_line->setObjectName("scaleLine");
    setType(*m_rating, Type::Title, Weight::Bold);
    m_rating->setAlignment(Qt::AlignCenter);
    m_rating->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    auto* number = new QHBoxLayout;
    number->setSpacing(16);
    number->addWidget(m_rating);
    number->addWidget(m_range, 1);
    auto* actions = new QHBoxLayout;
    actions->setSpacing(14);
    actions->addWidget(m_store);
    actions->addWidget(m_touch);
    actions->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(12);
    column->addWidget(m_head);
    column->addSpacing(4);
    column->addLayout(number);
    column->addWidget(m_line);
    column->addWidget(m_readBack);
    column->addLayout(actions);
    column->addStretch(1);
    connect(m_rating, &QLineEdit::textChanged, this, &RatingPage::showTyped);
    connect(m_line, &ScaleLine::ratingPicked, this, [this](Tenths rating) { m_rating->setText(textOf(rating)); });
    connect(m_store, &QPushButton::clicked, this, &RatingPage::store);
    connect(m_touch, &TouchButton::touched, this, [this] {
        m_rating->setFocus();
        Q_EMIT eventAsked(session::Touched{});
    });
}

void RatingPage::present(const session::View& view)
{
    const auto& presenting = std::get<session::Presenting>(view.state.stage);
    m_head->present(view);
    m_touch->present(view);
    m_scale = view.scale.value_or(protocols::Scale{});
    m_line->setScale(m_scale);
    m_range->setText(tr("from %1 to %2, one decimal").arg(textOf(m_scale.min), textOf(m_scale.max)));
    const bool isSameQuestion = m_shown && m_shown->index == presenting.index && m_shown->question == presenting.question &&
                                m_shown->readyAtNs == presenting.readyAtNs && m_shownCode == view.code;
    m_shown = presenting;
    m_shownCode = view.code;
    if (!isSameQuestion) {
        m_rating->clear();
        showTyped();
    }
}

void RatingPage::showTyped()
{
    const auto typed = ratingFromText(m_rating->text(), m_scale);
    const auto* rating = std::get_if<Tenths>(&typed);
    const QString text = m_rating->text().trimmed();
    const bool isUnfinished = text.isEmpty() || !text.back().isDigit();
    m_line->setRating(rating ? std::optional(*rating) : std::nullopt);
    if (rating)
        m_readBack->setText(tr("Read back: “%1.” Enter stores it.").arg(textOf(*rating)));
    else if (!isUnfinished)
        m_readBack->setText(std::get<NoRating>(typed).why);
    else
        m_readBack->setText(tr("Type the number that the participant says, or click on the line."));
}

void RatingPage::store()
{
    const auto typed = ratingFromText(m_rating->text(), m_scale);
    if (const auto* rating = std::get_if<Tenths>(&typed)) {
        Q_EMIT eventAsked(session::Answered{*rating});
        return;
    }
    m_rating->setFocus();
    m_rating->selectAll();
    Q_EMIT hinted(std::get<NoRating>(typed).why);
}

bool RatingPage::pressKey(int key)
{
    if (isEnter(key))
        store();
    else if (key == Qt::Key_T)
        Q_EMIT eventAsked(session::Touched{});
    else
        return false;
    return true;
}

QWidget& RatingPage::firstFocus()
{
    return *m_rating;
}

}  // namespace study::app
