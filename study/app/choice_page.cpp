#include "study/app/choice_page.h"

#include "study/app/pieces.h"
#include "study/app/question_head.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace study::app {

ChoicePage::ChoicePage(QWidget* parent)
    : StagePage(parent),
      m_head(new QuestionHead(this)),
      m_answersColumn(new QVBoxLayout),
      m_readBack(label("readBack", Type::Lead, this)),
      m_touch(new TouchButton(this)),
      m_store(mainButton("storeButton", tr("Store the answer (Enter)"), this))
{
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Choice among the fabrics on the tray"));
    m_answersColumn->setSpacing(8);
    auto* actions = new QHBoxLayout;
    actions->setSpacing(14);
    actions->addWidget(m_store);
    actions->addWidget(m_touch);
    actions->addStretch(1);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(12);
    column->addWidget(m_head);
    column->addLayout(m_answersColumn);
    column->addWidget(m_readBack);
    column->addLayout(actions);
    column->addStretch(1);
    connect(m_store, &QPushButton::clicked, this, &ChoicePage::store);
    connect(m_touch, &TouchButton::touched, this, [this] {
        setFocus();
        Q_EMIT eventAsked(session::Touched{});
    });
}

void ChoicePage::present(const session::View& view)
{
    const auto& presenting = std::get<session::Presenting>(view.state.stage);
    m_head->present(view);
    m_touch->present(view);
    const bool isSameQuestion = m_shown && m_shown->index == presenting.index && m_shown->readyAtNs == presenting.readyAtNs &&
                                m_shownCode == view.code && m_fabrics == view.trayIds;
    m_shown = presenting;
    m_shownCode = view.code;
    if (!isSameQuestion)
        showAnswers(view);
}

void ChoicePage::showAnswers(const session::View& view)
{
    for (QPushButton* old : m_answers) {
        // The key that led here may still be on its way through the old button.
        old->setObjectName({});
        old->hide();
        old->deleteLater();
    }
    m_answers.clear();
    m_fabricNames.clear();
    m_fabrics = view.trayIds;
    m_chosen.reset();
    for (std::size_t place = 0; place < view.tray.size(); ++place) {
        const QString letter = slotLetter(place);
        m_fabricNames.push_back(QString::fromStdString(view.tray[place]));
        auto* answer = button(qPrintable(QStringLiteral("answer%1").arg(letter)),
                              QStringLiteral("%1    %2").arg(letter, m_fabricNames.back()), this);
        setRole(*answer, "answer");
        setType(*answer, Type::Lead, Weight::Bold);
        answer->setCheckable(true);
        connect(answer, &QPushButton::clicked, this, [this, place] { choose(place); });
        m_answersColumn->addWidget(answer);
        answer->show();
        m_answers.push_back(answer);
    }
    m_readBack->setText(tr("Press the letter that the participant says."));
}

void ChoicePage::choose(std::size_t place)
{
    m_chosen = place;
    for (std::size_t i = 0; i < m_answers.size(); ++i)
        m_answers[i]->setChecked(i == place);
    m_readBack->setText(tr("Read back: “%1, %2.” Enter stores it; another letter changes it.")
                            .arg(slotLetter(place), m_fabricNames[place]));
    setFocus();
}

void ChoicePage::store()
{
    if (m_chosen)
        Q_EMIT eventAsked(session::Answered{m_fabrics[*m_chosen]});
    else
        Q_EMIT hinted(tr("Choose first: press the letter of the fabric that the participant names."));
}

bool ChoicePage::pressKey(int key)
{
    if (isEnter(key)) {
        store();
        return true;
    }
    // Checked before T: a tray of twenty slots would have a letter of its own there.
    const int place = key >= Qt::Key_1 && key <= Qt::Key_9 ? key - Qt::Key_1 : key - Qt::Key_A;
    if (place >= 0 && place < static_cast<int>(m_fabrics.size())) {
        choose(static_cast<std::size_t>(place));
        return true;
    }
    if (key != Qt::Key_T)
        return false;
    Q_EMIT eventAsked(session::Touched{});
    return true;
}

}  // namespace study::app
