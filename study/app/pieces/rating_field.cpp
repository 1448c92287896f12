#include "study/app/pieces/rating_field.h"

#include <QKeyEvent>

#include "study/app/pieces/pieces.h"

namespace study::app {

namespace {

bool isLetterKey(const QKeyEvent& event)
{
    const bool isPlain = (event.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0;
    return isPlain && !event.text().isEmpty() && event.text().at(0).isLetter();
}

}  // namespace

RatingField::RatingField(const char* objectName, const QString& accessibleName, QWidget* parent) : QLineEdit(parent)
{
    constexpr int longestRating = 8;
    name(*this, objectName, accessibleName);
    setMaxLength(longestRating);
    setInputMethodHints(Qt::ImhFormattedNumbersOnly);
    // An input method, such as one for Chinese, would take the letters that are keys here: T, V, N.
    setAttribute(Qt::WA_InputMethodEnabled, false);
}

QSize RatingField::sizeHint() const
{
    ensurePolished();
    const int marginPx = 40;
    return {fontMetrics().horizontalAdvance(QStringLiteral("00000000")) + marginPx, QLineEdit::sizeHint().height()};
}

bool RatingField::event(QEvent* event)
{
    if (event->type() == QEvent::ShortcutOverride && isLetterKey(*static_cast<QKeyEvent*>(event))) {
        event->ignore();
        return false;
    }
    return QLineEdit::event(event);
}

void RatingField::keyPressEvent(QKeyEvent* event)
{
    if (isLetterKey(*event))
        event->ignore();
    else
        QLineEdit::keyPressEvent(event);
}

}  // namespace study::app
