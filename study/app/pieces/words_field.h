// Text field of a few lines. The page handles Enter; Shift and Enter begin a new line; Tab moves to the next control.
#pragma once

#include <QPlainTextEdit>

namespace study::app {

class WordsField : public QPlainTextEdit {
    Q_OBJECT
public:
    WordsField(const char* objectName, const QString& accessibleName, QWidget* parent);

    /// The text as typed; empty if it contains only spaces.
    QString words() const;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace study::app
