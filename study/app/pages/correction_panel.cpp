#include "study/app/pages/correction_panel.h"

#include "study/app/pieces/answer_entry.h"
#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

/// "C", "5.5", "Same", or the beginning of an answer in words.
QString inOneWord(const Correctable& stored)
{
    constexpr qsizetype longest = 24;
    if (std::holds_alternative<protocols::FabricId>(stored.response)) return stored.current.section(QLatin1Char(' '), 0, 0);
    const QString line = stored.current.simplified();
    return line.size() > longest ? line.left(longest) + QStringLiteral("…") : line;
}

}  // namespace

CorrectionPanel::CorrectionPanel(QWidget* parent)
    : FormPanel(parent),
      m_questionsRow(new FlowLayout(8, 8)),
      m_old(label("oldValue", Type::Lead, this)),
      m_entry(new AnswerEntry(this))
{
    auto* questions = new QWidget(this);
    questions->setLayout(m_questionsRow);
    m_old->setContentsMargins(0, 4, 0, 0);
    addRow(tr("Question"), questions);
    addRow(tr("Stored answer"), m_old);
    addRow(tr("New answer"), m_entry);
    connect(m_entry, &AnswerEntry::changed, this, &StagePage::mended);
}

void CorrectionPanel::ask(const std::vector<Correctable>& answers)
{
    m_correctables = answers;
    open({.title = tr("Correct an answer"),
          .explanation = tr("The study keeps the old answer beside the new one."),
          .caption = tr("Reason"),
          .action = tr("Store the correction (Enter)"),
          .hintWhenEmpty =
              tr("Write a short reason, such as “misheard”. Press Enter again to store the correction without a reason.")});
    showQuestions();
    showAnswer(0);
}

void CorrectionPanel::showQuestions()
{
    qDeleteAll(m_questions);
    m_questions.clear();
    for (std::size_t place = 0; place < m_correctables.size(); ++place) {
        const QString question = QString::fromStdString(m_correctables[place].question.value);
        auto* choice = button(qPrintable(QStringLiteral("answerTo") + question), question, m_questionsRow->parentWidget());
        choice->setAccessibleName(tr("Correct the answer to %1").arg(question));
        choice->setCheckable(true);
        connect(choice, &QPushButton::clicked, this, [this, place] { showAnswer(place); });
        m_questionsRow->addWidget(choice);
        choice->show();
        m_questions.push_back(choice);
    }
}

void CorrectionPanel::showAnswer(std::size_t place)
{
    m_which = place;
    for (std::size_t i = 0; i < m_questions.size(); ++i) m_questions[i]->setChecked(i == place);
    m_old->setText(m_correctables[place].current);
    m_entry->ask(m_correctables[place].form);
    setReasonAfter(*m_entry);
    firstFocus().setFocus();
}

bool CorrectionPanel::isReady()
{
    const auto given = m_entry->give();
    if (const auto* missing = std::get_if<NoAnswer>(&given)) {
        m_entry->firstFocus().setFocus();
        Q_EMIT hinted(missing->why);
        return false;
    }
    m_response = std::get<session::GivenAnswer>(given);
    const Correctable& stored = m_correctables.at(m_which);
    if (*m_response != stored.response) return true;
    m_entry->firstFocus().setFocus();
    Q_EMIT hinted(tr("%1 is the stored answer. Choose another answer, or press Esc to go back.").arg(inOneWord(stored)));
    return false;
}

session::EventBody CorrectionPanel::eventFor(const std::string& reason)
{
    return session::Corrected{m_correctables.at(m_which).question, *m_response, reason};
}

bool CorrectionPanel::pressKey(int key)
{
    if (m_entry->pressKey(key)) {
        focusReason();
        return true;
    }
    return FormPanel::pressKey(key);
}

void CorrectionPanel::discardEntry() { showAnswer(m_which); }

QWidget& CorrectionPanel::firstFocus() { return m_entry->firstFocus(); }

bool CorrectionPanel::hasUnstoredText() const { return !m_entry->isEmpty() || FormPanel::hasUnstoredText(); }

}  // namespace study::app
