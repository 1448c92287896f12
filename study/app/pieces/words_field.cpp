#include "study/app/pieces/words_field.h"

#include <QKeyEvent>

#include "study/app/pieces/pieces.h"

namespace study::app {

WordsField::WordsField(const char* objectName, const QString& accessibleName, QWidget* parent) : QPlainTextEdit(parent)
{
    name(*this, objectName, accessibleName);
    setType(*this, Type::Lead);
    setTabChangesFocus(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

QString WordsField::words() const
{
    const QString text = toPlainText();
    return text.trimmed().isEmpty() ? QString() : text;
}

void WordsField::setLines(int fewest, int usual, int most)
{
    m_fewest = fewest;
    m_usual = usual;
    m_most = most;
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    limitHeight();
    updateGeometry();
}

int WordsField::heightOf(int lines) const
{
    const int padding = fontMetrics().height();
    return fontMetrics().lineSpacing() * lines + (m_most > 0 ? padding : 0);
}

void WordsField::limitHeight()
{
    if (m_most > 0) setMaximumHeight(heightOf(m_most));
}

void WordsField::changeEvent(QEvent* event)
{
    QPlainTextEdit::changeEvent(event);
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) limitHeight();
}

QSize WordsField::sizeHint() const
{
    ensurePolished();
    return {fontMetrics().height() * 20, heightOf(m_usual)};
}

QSize WordsField::minimumSizeHint() const
{
    ensurePolished();
    return {fontMetrics().height() * 8, heightOf(m_fewest)};
}

void WordsField::keyPressEvent(QKeyEvent* event)
{
    const bool isEnterKey = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    const bool isForThePage = (isEnterKey && !event->modifiers().testFlag(Qt::ShiftModifier)) || event->key() == Qt::Key_Escape;
    if (isForThePage)
        event->ignore();
    else if (isEnterKey)
        insertPlainText(QStringLiteral("\n"));
    else
        QPlainTextEdit::keyPressEvent(event);
}

}  // namespace study::app
