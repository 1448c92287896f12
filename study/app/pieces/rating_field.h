// The line for a typed rating: takes digits and signs, leaves letters to the page (whose keys they are).
#pragma once

#include <QLineEdit>

namespace study::app {

class RatingField : public QLineEdit {
    Q_OBJECT
public:
    RatingField(const char* objectName, const QString& accessibleName, QWidget* parent);

    /// Room for a rating, not for a sentence.
    QSize sizeHint() const override;

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
};

}  // namespace study::app
