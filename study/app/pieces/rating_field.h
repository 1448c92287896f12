// Field for a typed rating. It accepts digits and signs and leaves letters to the page, where they are command keys.
#pragma once

#include <QLineEdit>

namespace study::app {

class RatingField : public QLineEdit {
    Q_OBJECT
public:
    RatingField(const char* objectName, const QString& accessibleName, QWidget* parent);

    /// Wide enough for one rating.
    QSize sizeHint() const override;

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace study::app
