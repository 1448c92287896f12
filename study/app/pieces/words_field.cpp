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

QSize WordsField::sizeHint() const
{
    ensurePolished();
    return {fontMetrics().height() * 20, fontMetrics().height() * 6};
}

QSize WordsField::minimumSizeHint() const
{
    ensurePolished();
    return {fontMetrics().height() * 8, fontMetrics().height() * 3};
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
