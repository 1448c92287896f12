#include "study/app/pages/form_panel.h"

#include <QGridLayout>
#include <QVBoxLayout>

#include "study/app/pieces/flow_layout.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/words_field.h"

namespace study::app {

namespace {

constexpr int rowOfReason = 100;  // below all rows that addRow() adds

QLabel* captionFor(const QString& text, QWidget* parent)
{
    QLabel* made = quietLabel("panelCaption", parent);
    made->setText(text);
    made->setWordWrap(false);
    made->setContentsMargins(0, 7, 0, 0);  // aligns the caption with the text in the field
    return made;
}

}  // namespace

FormPanel::FormPanel(QWidget* parent)
    : StagePage(parent),
      m_head(new PageHead(this)),
      m_form(new QGridLayout),
      m_caption(captionFor({}, this)),
      m_reason(new WordsField("reasonField", tr("Reason"), this)),
      m_action(mainButton("panelConfirmButton", tr("Store (Enter)"), this)),
      m_back(button("panelBackButton", tr("Back (Esc)"), this))
{
    m_reason->setLines(1, 2, 6);
    m_form->setHorizontalSpacing(18);
    m_form->setVerticalSpacing(14);
    m_form->setColumnStretch(1, 1);
    m_form->addWidget(m_caption, rowOfReason, 0, Qt::AlignTop);
    m_form->addWidget(m_reason, rowOfReason, 1);
    m_form->addLayout(m_messagePlace, rowOfReason + 1, 1);
    auto* column = new QVBoxLayout(this);
    column->setSpacing(18);
    column->addWidget(m_head);
    column->addLayout(m_form, 1);
    column->addLayout(actionsRow({m_action, m_back}));
    column->addStretch(0);
    connect(m_action, &QPushButton::clicked, this, &FormPanel::confirm);
    connect(m_reason, &QPlainTextEdit::textChanged, this, [this] {
        m_isAskedAgain = false;  // its question is no longer visible
        Q_EMIT mended();
    });
    connect(m_back, &QPushButton::clicked, this, &FormPanel::closeRequested);
}

QWidget* FormPanel::addRow(const QString& caption, QWidget* control)
{
    const int row = m_form->rowCount() > rowOfReason ? m_form->count() / 2 : m_form->rowCount();
    QLabel* made = captionFor(caption, this);
    m_form->addWidget(made, row, 0, Qt::AlignTop);
    m_form->addWidget(control, row, 1);
    return made;
}

void FormPanel::setReasonAfter(const QWidget& controls) { setTabOrderAfter(controls, {m_reason, m_action, m_back}); }

void FormPanel::open(const Texts& texts)
{
    m_texts = texts;
    m_isAskedAgain = false;
    m_head->setTexts(texts.title, texts.explanation);
    m_caption->setText(texts.caption);
    m_reason->clear();
    m_reason->setAccessibleName(texts.caption);
    setButtonText(*m_action, texts.action);
    Q_EMIT textChanged();
}

void FormPanel::focusReason() { m_reason->setFocus(); }

void FormPanel::setReason(const QString& reason)
{
    m_reason->setPlainText(reason);
    m_reason->moveCursor(QTextCursor::End);
    focusReason();
}

void FormPanel::confirm()
{
    if (!isReady()) return;
    const bool isEmpty = m_reason->words().isEmpty();
    const bool isAccepted = !isEmpty || m_texts.withoutReason == WithoutReason::Accept ||
                            (m_texts.withoutReason == WithoutReason::AskTwice && m_isAskedAgain);
    if (isAccepted) {
        Q_EMIT eventRequested(eventFor(isEmpty ? std::string() : m_reason->words().toStdString()));
        return;
    }
    m_isAskedAgain = true;
    m_reason->setFocus();
    Q_EMIT hinted(m_texts.hintWhenEmpty);
}

bool FormPanel::pressKey(int key)
{
    if (isEnter(key))
        confirm();
    else if (key == Qt::Key_Escape)
        Q_EMIT closeRequested();
    else
        return false;
    return true;
}

QWidget& FormPanel::firstFocus() { return *m_reason; }

bool FormPanel::hasUnstoredText() const { return !m_reason->words().isEmpty(); }

}  // namespace study::app
