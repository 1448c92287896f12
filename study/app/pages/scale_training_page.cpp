#include "study/app/pages/scale_training_page.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cstdlib>
#include <utility>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/rating_field.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/rating_text.h"

namespace study::app {

using protocols::Tenths;
using session::ScalePlaced;

ScaleTrainingPage::ScaleTrainingPage(QWidget* parent)
    : StagePage(parent),
      m_head(new PageHead(this)),
      m_line(new ScaleLine(ScaleLine::Use::Show, this)),
      m_anchors(new QWidget(this)),
      m_lowAnchor(label("lowAnchor", Type::Body, m_anchors)),
      m_highAnchor(label("highAnchor", Type::Body, m_anchors)),
      m_placeRow(new QWidget(this)),
      m_spoken(new RatingField("spokenField", tr("Number that the participant says for the mark"), m_placeRow)),
      m_whichPlace(label("whichPlace", Type::Lead, m_placeRow)),
      m_deviation(label("deviation", Type::Lead, this)),
      m_action(mainButton("confirmButton", tr("Continue (Enter)"), this)),
      m_done(button("scaleKnownButton", tr("The participant knows the scale (G)"), this))
{
    m_line->setObjectName("memorisedLine");
    m_anchors->setLayout(anchors());
    m_placeRow->setLayout(placeRow());
    auto* column = new QVBoxLayout(this);
    column->setSpacing(12);
    column->addWidget(m_head);
    column->addWidget(m_line);
    column->addWidget(m_anchors);
    column->addWidget(m_placeRow);
    column->addLayout(m_messagePlace);
    column->addWidget(m_deviation);
    column->addLayout(actionsRow({m_action, m_done}));
    column->addStretch(1);
    connect(m_spoken, &QLineEdit::textChanged, this, &StagePage::mended);
    connect(m_action, &QPushButton::clicked, this, &ScaleTrainingPage::confirm);
    connect(m_done, &QPushButton::clicked, this, [this] { Q_EMIT eventRequested(session::ScaleTrainingDone{}); });
}

QLayout* ScaleTrainingPage::anchors()
{
    auto* row = new QHBoxLayout;
    row->setContentsMargins(0, 0, 0, 0);
    m_anchors->setLayoutDirection(Qt::LeftToRight);  // each end below its end of the line, in every language
    m_lowAnchor->setAlignment(Qt::AlignLeft | Qt::AlignTop | Qt::AlignAbsolute);
    m_highAnchor->setAlignment(Qt::AlignRight | Qt::AlignTop | Qt::AlignAbsolute);
    row->addWidget(m_lowAnchor, 1);
    row->addSpacing(40);
    row->addWidget(m_highAnchor, 1);
    return row;
}

QLayout* ScaleTrainingPage::placeRow()
{
    auto* row = new QHBoxLayout;
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(16);
    setType(*m_spoken, Type::Title, Weight::Bold);
    m_spoken->setAlignment(Qt::AlignCenter);
    m_spoken->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    row->addWidget(m_spoken);
    row->addWidget(m_whichPlace, 1);
    return row;
}

void ScaleTrainingPage::begin(const SessionFacts& facts)
{
    m_facts = facts;
    m_scale = facts.scale.value_or(protocols::RatingScale{});
    m_line->setScale(m_scale);
    showAnchors();
    m_place.reset();
    m_spoken->clear();
}

void ScaleTrainingPage::showInstruction(bool isRefresher)
{
    const QString low = textOf(m_scale.min), high = textOf(m_scale.max);
    m_anchors->setVisible(!isRefresher);
    if (isRefresher)
        m_head->setTexts(tr("Repeat the scale"),
                         m_scale.labels.empty()
                             ? tr("Show this line again. Say: “%1”")
                                   .arg(m_facts.sentence("say_ends", {{"low", low.toStdString()}, {"high", high.toStdString()}}))
                             : tr("Show this line again, from %1 to %2.").arg(low, high));
    else
        m_head->setTexts(tr("Learn the scale"),
                         m_scale.sections > 1
                             ? tr("Show this line to the participant. Its sections are equal, and only its ends have numbers.")
                             : tr("Show this line to the participant. Only its ends have numbers."));
}

void ScaleTrainingPage::showAnchors()
{
    const QString low = wordedText(m_scale.min, m_scale), high = wordedText(m_scale.max, m_scale);
    if (!m_scale.labels.empty()) {  // the scale has its own words for its ends
        m_lowAnchor->setText(low);
        m_highAnchor->setText(high);
        return;
    }
    const QString forLow = m_facts.hasOwnLowEnd
                               ? tr("Let the participant touch your materials (usually sandpaper, then silk). Say: “%1”")
                               : tr("Let the participant touch sandpaper, then silk. Say: “%1”");
    const QString forHigh =
        m_facts.hasOwnHighEnd ? tr("Let the participant touch your materials (usually two pieces of the same fabric). Say: “%1”")
                              : tr("Let the participant touch two pieces of the same fabric. Say: “%1”");
    m_lowAnchor->setText(forLow.arg(m_facts.sentence("say_unrelated", {{"number", low.toStdString()}})));
    m_highAnchor->setText(forHigh.arg(m_facts.sentence("say_same", {{"number", high.toStdString()}})));
}

void ScaleTrainingPage::present(const session::View& view)
{
    const auto& training = std::get<session::ScaleTraining>(view.state.stage);
    if (training.placed != m_placed || view.placeToName != m_place) m_spoken->clear();
    const bool isOtherText = training.isRefresher != m_isRefresher || view.placeToName.has_value() != m_place.has_value();
    m_isRefresher = training.isRefresher;
    m_placed = training.placed;
    m_place = view.placeToName;
    showInstruction(training.isRefresher);
    m_line->setRating(m_place);
    m_placeRow->setVisible(m_place.has_value());
    const QString question = m_facts.sentence("ask_mark");
    m_whichPlace->setText(training.isRefresher
                              ? tr("Ask: “%1”").arg(question)
                              : tr("Mark %1; right in a row: %2 of 3. Ask: “%3”")
                                    .arg(QString::number(training.placed + 1), QString::number(training.rightInARow), question));
    showText(*m_deviation, training.last ? deviation(*training.last) : QString());
    setButtonText(*m_action, m_place ? tr("Store this number (Enter)") : tr("The participant knows the scale (Enter)"));
    m_done->setVisible(m_place.has_value());
    if (isOtherText) Q_EMIT textChanged();  // not with each mark, so that the type stays
}

QString ScaleTrainingPage::deviation(const session::NamedPlace& placed) const
{
    const int off = placed.named.value - placed.shown.value;
    const int span = m_scale.max.value - m_scale.min.value;
    const QString far = textOf(Tenths{std::abs(off)}), shown = textOf(placed.shown), spoken = textOf(placed.named);
    if (off == 0) return tr("The participant said %1. The mark was exactly there.").arg(spoken);
    if (std::abs(off) * 20 <= span)
        return tr("The participant said %1, and the mark was at %2. This is very close.").arg(spoken, shown);
    const QString way = off > 0 ? tr("%1 too high").arg(far) : tr("%1 too low").arg(far);
    if (std::abs(off) * 10 <= span)
        return tr("The participant said %1, and the mark was at %2. This is close, %3.").arg(spoken, shown, way);
    return tr("The participant said %1, and the mark was at %2. This is %3. Show the ends and the sections again.")
        .arg(spoken, shown, way);
}

void ScaleTrainingPage::confirm()
{
    if (!m_place) {
        Q_EMIT eventRequested(session::ScaleTrainingDone{});
        return;
    }
    const auto typed = ratingFromText(m_spoken->text(), m_scale);
    if (const auto* spoken = std::get_if<Tenths>(&typed)) {
        const ScalePlaced placed{*m_place, *spoken};
        Q_EMIT eventRequested(placed);
        return;
    }
    m_spoken->setFocus();
    m_spoken->selectAll();
    Q_EMIT hinted(tr("%1 Press G to skip this if the participant already knows the scale.").arg(std::get<NoRating>(typed).why));
}

bool ScaleTrainingPage::pressKey(int key)
{
    if (isEnter(key))
        confirm();
    else if (key == Qt::Key_G)
        Q_EMIT eventRequested(session::ScaleTrainingDone{});
    else
        return false;
    return true;
}

QWidget& ScaleTrainingPage::firstFocus()
{
    if (m_place) return *m_spoken;
    return *m_action;
}

}  // namespace study::app
