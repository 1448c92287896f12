#include "study/app/pages/question_page.h"

#include <QVBoxLayout>

#include "study/app/language/app_text.h"
#include "study/app/pieces/answer_entry.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/question_head.h"
#include "study/app/state/tray_steps.h"

namespace study::app {

using session::GivenAnswer;
using session::Presenting;

QuestionPage::QuestionPage(QWidget* parent)
    : StagePage(parent),
      m_head(new QuestionHead(this)),
      m_entry(new AnswerEntry(this)),
      m_readBack(label("readBack", Type::Lead, this)),
      m_touch(new TouchButton(this)),
      m_spoken(button("spokenButton", tr("The answer begins (F9)"), this)),
      m_store(mainButton("storeButton", tr("Store the answer (Enter)"), this)),
      m_next(quietLabel("nextTray", this, Type::Plain)),
      m_stroke(quietLabel("strokeWords", this, Type::Plain))
{
    auto* column = new QVBoxLayout(this);
    column->setSpacing(12);
    column->addWidget(m_head);
    column->addWidget(m_entry);
    column->addLayout(m_messagePlace);
    column->addWidget(m_readBack);
    column->addLayout(actionsRow({m_store, m_touch, m_spoken}));
    column->addSpacing(6);
    column->addWidget(m_next);
    column->addWidget(m_stroke);
    column->addStretch(1);
    connect(m_entry, &AnswerEntry::changed, this, &QuestionPage::showReadBack);
    connect(m_entry, &AnswerEntry::changed, this, &QuestionPage::markEntry);
    connect(m_entry, &AnswerEntry::changed, this, &StagePage::mended);
    setRole(*m_spoken, "stamp");
    connect(m_spoken, &QPushButton::clicked, this, &QuestionPage::markSpoken);
    connect(m_store, &QPushButton::clicked, this, &QuestionPage::store);
    connect(m_touch, &TouchButton::touched, this, [this] {
        firstFocus().setFocus();
        Q_EMIT eventRequested(session::Touched{});
    });
}

void QuestionPage::begin(const SessionFacts& facts)
{
    m_wantsSecondEntry = facts.secondEntry;
    m_keys = facts.keys;
    m_same = facts.sentence("spoken_same");
    m_different = facts.sentence("spoken_different");
    m_shown.reset();
    showText(*m_stroke, strokeText(facts));
    m_touch->begin(facts);
}

bool QuestionPage::isSameQuestion(const session::View& view) const
{
    const auto& asked = std::get<Presenting>(view.state.stage);
    return m_shown && m_shown->index == asked.index && m_shown->question == asked.question &&
           m_shown->readyAtNs == asked.readyAtNs && m_shownCode == view.code;
}

void QuestionPage::present(const session::View& view)
{
    m_head->present(view);
    showText(*m_next, view.nextTray.empty()
                          ? QString()
                          : tr("Next tray: %1").arg(trayStepsText(trayStepsTo(view.nextTray, view.tray), view.nextTray.size())));
    m_touch->present(view);
    if (isSameQuestion(view)) return;  // a touch, a note or a fault must not clear the entry
    m_shown = std::get<Presenting>(view.state.stage);
    m_shownCode = view.code;
    m_firstEntry.reset();
    m_entries = 0;
    m_spoken->setEnabled(true);
    setButtonText(*m_spoken, m_keys.withKeys(tr("The answer begins"), KeyAct::AnswerBegins));
    AnswerForm form = formOf(view);
    readBackInWords(form, m_same, m_different);
    m_entry->ask(form);
}

void QuestionPage::markSpoken()
{
    if (!m_spoken->isEnabled()) return;
    firstFocus().setFocus();
    m_spoken->setEnabled(false);
    setButtonText(*m_spoken, tr("The beginning is stamped ✓"));
    Q_EMIT answerMarked(AnswerMark::Spoken);
}

void QuestionPage::markEntry()
{
    // The second entry of an answer is no new answer.
    if (m_entries == 0) Q_EMIT answerMarked(m_entry->isEmpty() ? AnswerMark::Emptied : AnswerMark::Begun);
}

void QuestionPage::showReadBack()
{
    const bool isFirstOfTwo = m_wantsSecondEntry && !m_firstEntry;
    setButtonText(*m_store,
                  m_keys.withKeys(isFirstOfTwo ? tr("Go to the second entry") : tr("Store the answer"), KeyAct::Confirm));
    const ReadBack readBack = m_entry->readBack();
    QStringList sentences{readBack.text};
    if (m_firstEntry) sentences.prepend(tr("Second entry."));
    if (readBack.isComplete)
        sentences.append(isFirstOfTwo ? tr("Press Enter, then enter the same answer again.") : tr("Press Enter to store it."));
    m_readBack->setText(sentencesTogether(sentences));
}

void QuestionPage::store()
{
    const auto given = m_entry->give();
    if (const auto* response = std::get_if<GivenAnswer>(&given)) {
        takeEntry(*response);
        return;
    }
    m_entry->firstFocus().setFocus();
    const QString why = std::get<NoAnswer>(given).why;
    // The message says it already; the read-back returns with the next change.
    if (m_entry->readBack().text == why) m_readBack->setText(m_firstEntry ? tr("Second entry.") : QString());
    Q_EMIT hinted(why);
}

void QuestionPage::takeEntry(const GivenAnswer& response)
{
    if (!m_wantsSecondEntry) {
        Q_EMIT eventRequested(session::Answered{response});
        return;
    }
    ++m_entries;
    const QString differing = m_firstEntry ? disagreement(m_entry->form(), *m_firstEntry, response) : QString();
    if (m_firstEntry && differing.isEmpty()) {
        // Texts that differ in spaces agree; the first entry is the one that was read back.
        const GivenAnswer agreed = *m_firstEntry;
        Q_EMIT eventRequested(session::Answered{agreed, {.entries = m_entries}});
        return;
    }
    if (m_firstEntry)
        m_firstEntry.reset();
    else
        m_firstEntry = response;
    m_entry->ask(AnswerForm(m_entry->form()));
    m_entry->firstFocus().setFocus();
    Q_EMIT hinted(differing);
}

bool QuestionPage::hasUnstoredText() const { return isForWriting() && !m_entry->isEmpty(); }

bool QuestionPage::isForWriting() const { return std::holds_alternative<WordsForm>(m_entry->form()); }

int QuestionPage::lettersTaken() const
{
    const auto* choice = std::get_if<OptionsForm>(&m_entry->form());
    return choice ? static_cast<int>(choice->options.size()) : StagePage::lettersTaken();
}

bool QuestionPage::pressKey(int key)
{
    if (isEnter(key)) {
        store();
        return true;
    }
    // Before T: on a tray of twenty slots, T is the letter of a slot.
    if (m_entry->pressKey(key)) return true;
    if (key == Qt::Key_F9) {
        markSpoken();
        return true;
    }
    if (key != Qt::Key_T) return false;
    Q_EMIT eventRequested(session::Touched{});
    return true;
}

QWidget* QuestionPage::lastOfAnswer() { return m_store; }

void QuestionPage::discardEntry()
{
    m_entry->ask(AnswerForm(m_entry->form()));
    firstFocus().setFocus();
}

QWidget& QuestionPage::firstFocus() { return m_entry->firstFocus(); }

}  // namespace study::app
