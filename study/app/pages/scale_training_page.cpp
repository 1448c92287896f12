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
      m_action(mainButton("confirmButton", tr("Go on (Enter)"), this)),
      m_done(button("scaleKnownButton", tr("The scale is known (G)"), this))
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
    column->addWidget(m_deviation);
    column->addLayout(actionsRow({m_action, m_done}));
    column->addStretch(1);
    connect(m_action, &QPushButton::clicked, this, &ScaleTrainingPage::confirm);
    connect(m_done, &QPushButton::clicked, this, [this] { Q_EMIT eventRequested(session::ScaleTrainingDone{}); });
}

QLayout* ScaleTrainingPage::anchors()
{
    auto* row = new QHBoxLayout;
    row->setContentsMargins(0, 0, 0, 0);
    m_highAnchor->setAlignment(Qt::AlignRight);
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
    m_scale = facts.scale.value_or(protocols::Scale{});
    m_line->setScale(m_scale);
    showAnchors();
    m_place.reset();
    m_asked.reset();
    m_lastNamed.reset();
    m_spoken->clear();
}

void ScaleTrainingPage::showInstruction(bool isRefresher)
{
    const QString low = textOf(m_scale.min), high = textOf(m_scale.max);
    m_anchors->setVisible(!isRefresher);
    if (isRefresher)
        m_head->setTexts(tr("The scale, once more"),
                         m_scale.labels.empty()
                             ? tr("Show this line again: %1 is unrelated, %2 is totally the same.").arg(low, high)
                             : tr("Show this line again, from %1 to %2.").arg(low, high));
    else
        m_head->setTexts(tr("The scale, to be memorised"),
                         m_scale.sections > 1 ? tr("Show this line. It has equal sections, and only its ends carry a number.")
                                              : tr("Show this line. Only its ends carry a number."));
}

void ScaleTrainingPage::showAnchors()
{
    const QString low = wordedText(m_scale.min, m_scale), high = wordedText(m_scale.max, m_scale);
    if (!m_scale.labels.empty()) {  // a scale that says itself what its ends are
        m_lowAnchor->setText(low);
        m_highAnchor->setText(high);
        return;
    }
    m_lowAnchor->setText(tr("Let them touch sandpaper, then silk. “These two are unrelated. That is %1.”").arg(low));
    m_highAnchor->setText(
        tr("Let them touch two pieces of the same fabric. “These two are totally the same. That is %1.”").arg(high));
}

void ScaleTrainingPage::present(const session::View& view)
{
    const auto& training = std::get<session::ScaleTraining>(view.state.stage);
    const int places = static_cast<int>(view.placesToName.size());
    const std::optional<Tenths> place =
        training.placed < places ? std::optional(view.placesToName[static_cast<std::size_t>(training.placed)]) : std::nullopt;
    if (place != m_place) {
        m_spoken->clear();
        m_lastNamed = std::exchange(m_asked, std::nullopt);
    }
    m_place = place;
    showInstruction(training.isRefresher);
    m_line->setRating(m_place);
    m_placeRow->setVisible(m_place.has_value());
    m_whichPlace->setText(places == 1 ? tr("Which number has the mark?")
                                      : tr("Mark %1 of %2: which number do they say?").arg(training.placed + 1).arg(places));
    showText(*m_deviation, m_lastNamed ? deviation(*m_lastNamed) : QString());
    setButtonText(*m_action, m_place ? tr("They say this number (Enter)") : tr("The scale is known (Enter)"));
    m_done->setVisible(m_place.has_value());
}

QString ScaleTrainingPage::deviation(const ScalePlaced& placed) const
{
    const int off = placed.spoken.value - placed.shown.value;
    const int span = m_scale.max.value - m_scale.min.value;
    const QString far = textOf(Tenths{std::abs(off)}), shown = textOf(placed.shown), spoken = textOf(placed.spoken);
    if (off == 0) return tr("They said %1, and that is just where the mark was.").arg(spoken);
    if (std::abs(off) * 20 <= span) return tr("They said %1, the mark was at %2: very close.").arg(spoken, shown);
    const QString way = off > 0 ? tr("%1 too high").arg(far) : tr("%1 too low").arg(far);
    if (std::abs(off) * 10 <= span) return tr("They said %1, the mark was at %2: close, %3.").arg(spoken, shown, way);
    return tr("They said %1, the mark was at %2: %3. Let them look at the ends and the sections once more.")
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
        m_asked = ScalePlaced{*m_place, *spoken};
        const ScalePlaced placed = *m_asked;
        Q_EMIT eventRequested(placed);
        return;
    }
    m_spoken->setFocus();
    m_spoken->selectAll();
    Q_EMIT hinted(tr("%1 G goes on where the scale is known already.").arg(std::get<NoRating>(typed).why));
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
