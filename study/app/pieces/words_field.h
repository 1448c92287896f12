// Free text of a few lines: Enter is left to the page, Shift and Enter begin a new line, Tab goes on.
#pragma once

#include <QPlainTextEdit>

namespace study::app {

class WordsField : public QPlainTextEdit {
    Q_OBJECT
public:
    WordsField(const char* objectName, const QString& accessibleName, QWidget* parent);

    /// As written; empty where it is nothing but spaces.
    QString words() const;
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace study::app
