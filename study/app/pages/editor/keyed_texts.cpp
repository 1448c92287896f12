#include "study/app/pages/editor/keyed_texts.h"

#include <QListWidget>
#include <QPlainTextEdit>
#include <QScopedValueRollback>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>

#include "study/app/pages/editor/draft_fields.h"
#include "study/app/pieces/pieces.h"

namespace study::app {

KeyedTexts::KeyedTexts(DraftFields& fields, Kind kind, QWidget* parent)
    : QWidget(parent), m_fields(fields), m_kind(std::move(kind)), m_list(new QListWidget(this)), m_field(new QPlainTextEdit(this))
{
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(8);
    name(*m_list, (m_kind.object + "List").c_str(), m_kind.listCaption);
    setType(*m_list, Type::Plain);
    constexpr int mostRows = 8;
    fitRows(*m_list, mostRows);
    m_list->setTextElideMode(Qt::ElideRight);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    name(*m_field, m_kind.object.c_str(), m_kind.fieldCaption);
    setType(*m_field, Type::Body);
    m_field->setTabChangesFocus(true);
    addCaptioned(*column, m_kind.listCaption, *m_list);
    addCaptioned(*column, m_kind.fieldCaption, *m_field);
    m_fields.bind(m_kind.object, m_kind.fieldCaption, *m_field);
    connect(&fields, &DraftFields::edited, this, &KeyedTexts::list);
    connect(&fields, &DraftFields::replaced, this, [this] {
        list();
        showChosen();
    });
    connect(m_list, &QListWidget::currentRowChanged, this, [this](int row) {
        showChosen();
        if (row >= 0) Q_EMIT chosen(QString::fromStdString(m_texts[static_cast<std::size_t>(row)].key));
    });
    connect(m_field, &QPlainTextEdit::textChanged, this, &KeyedTexts::take);
    list();
    showChosen();
}

QString KeyedTexts::rowOf(const KeyedText& text) const
{
    const QString key = QString::fromStdString(text.key);
    if (!text.own.empty()) return tr("%1    own: %2").arg(key, QString::fromStdString(text.own).simplified());
    return text.usual.empty() ? key : key + QStringLiteral("    ") + QString::fromStdString(text.usual).simplified();
}

void KeyedTexts::list()
{
    const int before = m_list->currentRow();
    const std::string key = before >= 0 ? m_texts[static_cast<std::size_t>(before)].key : std::string();
    m_texts = m_kind.offered(m_fields.draft());
    const QSignalBlocker quiet(m_list);
    while (m_list->count() > static_cast<int>(m_texts.size())) delete m_list->takeItem(m_list->count() - 1);
    for (int row = 0; row < static_cast<int>(m_texts.size()); ++row) {
        const QString text = rowOf(m_texts[static_cast<std::size_t>(row)]);
        if (row >= m_list->count())
            m_list->addItem(text);
        else if (m_list->item(row)->text() != text)
            m_list->item(row)->setText(text);
    }
    const auto same = std::ranges::find(m_texts, key, &KeyedText::key);
    m_list->setCurrentRow(same == m_texts.end() ? 0 : static_cast<int>(same - m_texts.begin()));
    if (same == m_texts.end())
        showChosen();
    else
        showUsual();
}

void KeyedTexts::showUsual()
{
    const KeyedText& text = m_texts[static_cast<std::size_t>(m_list->currentRow())];
    m_field->setPlaceholderText(text.usual.empty() ? m_kind.hint : QString::fromStdString(text.usual));
}

void KeyedTexts::showChosen()
{
    const QScopedValueRollback showing(m_isShowing, true);
    const int row = m_list->currentRow();
    m_field->setEnabled(row >= 0);
    if (row < 0) return;
    showUsual();
    const QString own = QString::fromStdString(m_texts[static_cast<std::size_t>(row)].own);
    if (m_field->toPlainText() != own) m_field->setPlainText(own);
    fitLines(*m_field);
}

void KeyedTexts::take()
{
    fitLines(*m_field);
    const int row = m_list->currentRow();
    if (m_isShowing || row < 0) return;
    const std::string key = m_texts[static_cast<std::size_t>(row)].key;
    const QString typed = m_field->toPlainText();
    m_fields.edit(m_kind.object + "." + key,
                  [&](ProtocolDraft& draft) { setOwnText(draft, m_kind.object, key, typed.trimmed().toStdString()); });
}

void KeyedTexts::choose(const std::string& key)
{
    const auto found = std::ranges::find(m_texts, key, &KeyedText::key);
    if (found != m_texts.end()) m_list->setCurrentRow(static_cast<int>(found - m_texts.begin()));
}

}  // namespace study::app
