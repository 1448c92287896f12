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
    /// Makes the field `usual` lines high where there is room, up to `most`, and never lower than `fewest`.
    void setLines(int fewest, int usual, int most);
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    int heightOf(int lines) const;
    void limitHeight();

    int m_fewest = 3, m_usual = 6;
    int m_most = 0;  ///< 0: as high as its layout makes it
};

}  // namespace study::app
