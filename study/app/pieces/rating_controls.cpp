#include "study/app/pieces/rating_controls.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <algorithm>

#include "study/app/pieces/pieces.h"
#include "study/app/pieces/rating_field.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/rating_text.h"

namespace study::app {

using protocols::RatingScale;
using protocols::Tenths;

RatingControls::RatingControls(QWidget* parent)
    : EntryControls(parent),
      m_rating(new RatingField("ratingField", tr("Rating that the participant says"), this)),
      m_range(quietLabel("ratingRange", this, Type::Lead)),
      m_line(new ScaleLine(ScaleLine::Use::Pick, this)),
      m_words(new QWidget(this)),
      m_labels(new QBoxLayout(QBoxLayout::LeftToRight, m_words))
{
    m_line->setObjectName("scaleLine");
    m_words->setLayoutDirection(Qt::LeftToRight);
    m_labels->setContentsMargins(0, 0, 0, 0);
    setType(*m_rating, Type::Title, Weight::Bold);
    m_rating->setAlignment(Qt::AlignCenter);
    m_rating->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    auto* number = new QHBoxLayout;
    number->setSpacing(16);
    number->addWidget(m_rating);
    number->addWidget(m_range, 1);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(12);
    column->addLayout(number);
    column->addWidget(m_line);
    column->addWidget(m_words);
    m_labels->setSpacing(0);
    connect(m_rating, &QLineEdit::textChanged, this, &RatingControls::showTyped);
    connect(m_line, &ScaleLine::ratingPicked, this, [this](Tenths rating) { m_rating->setText(textOf(rating)); });
}

void RatingControls::ask(const AnswerForm& form)
{
    const RatingScale& scale = std::get<ScaleForm>(form).scale;
    if (scale != m_scale) setScale(scale);
    m_rating->clear();
    showTyped();
}

void RatingControls::setScale(const RatingScale& scale)
{
    m_scale = scale;
    m_line->setScale(scale);
    m_range->setText(rangeText(scale));
    showLabels();
}

void RatingControls::showLabels()
{
    clearLayout(*m_labels);
    for (std::size_t step = 0; step < m_scale->labels.size(); ++step) {
        const Tenths rating{m_scale->min.value + static_cast<int>(step) * m_scale->step.value};
        auto* made = label("scaleLabel", Type::Body, m_words);
        made->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
        made->setText(wordedText(rating, *m_scale));
        m_labels->addWidget(made, 1);
        made->show();
    }
    m_words->setVisible(!m_scale->labels.empty());
    arrangeLabels();
}

void RatingControls::arrangeLabels()
{
    if (m_labels->isEmpty()) return;
    int widestWord = 0;
    for (int place = 0; place < m_labels->count(); ++place) {
        const auto* word = qobject_cast<QLabel*>(m_labels->itemAt(place)->widget());
        word->ensurePolished();
        for (const QString& part : word->text().split(QLatin1Char(' ')))
            widestWord = std::max(widestWord, word->fontMetrics().horizontalAdvance(part) + 8);
    }
    const bool fits = widestWord * m_labels->count() <= width();
    m_labels->setDirection(fits ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    for (int place = 0; place < m_labels->count(); ++place)
        qobject_cast<QLabel*>(m_labels->itemAt(place)->widget())
            ->setAlignment(fits ? Qt::AlignHCenter | Qt::AlignTop : Qt::AlignLeft | Qt::AlignTop);
}

void RatingControls::resizeEvent(QResizeEvent* event)
{
    EntryControls::resizeEvent(event);
    arrangeLabels();
}

void RatingControls::changeEvent(QEvent* event)
{
    EntryControls::changeEvent(event);
    // Queued, because the words get their font after this widget.
    if (event->type() == QEvent::StyleChange || event->type() == QEvent::FontChange)
        QMetaObject::invokeMethod(this, &RatingControls::arrangeLabels, Qt::QueuedConnection);
}

void RatingControls::showTyped()
{
    const auto typed = ratingFromText(m_rating->text(), *m_scale);
    const auto* rating = std::get_if<Tenths>(&typed);
    m_line->setRating(rating ? std::optional(*rating) : std::nullopt);
    Q_EMIT changed();
}

std::variant<session::GivenAnswer, NoAnswer> RatingControls::give()
{
    const auto typed = ratingFromText(m_rating->text(), *m_scale);
    if (const auto* rating = std::get_if<Tenths>(&typed)) return *rating;
    return NoAnswer{std::get<NoRating>(typed).why};
}

ReadBack RatingControls::readBack() const
{
    const auto typed = ratingFromText(m_rating->text(), *m_scale);
    if (const auto* rating = std::get_if<Tenths>(&typed))
        return {tr("Read back: “%1.”").arg(wordedText(*rating, *m_scale)), true};
    const QString text = m_rating->text().trimmed();
    const bool isUnfinished = text.isEmpty() || !text.back().isDigit();
    return {isUnfinished ? tr("Type the number that the participant says, or click on the line.")
                         : std::get<NoRating>(typed).why};
}

bool RatingControls::isEmpty() const { return m_rating->text().trimmed().isEmpty(); }

QWidget& RatingControls::firstFocus() { return *m_rating; }

}  // namespace study::app
