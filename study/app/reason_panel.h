// One line to write, in place of the stage page: a note, the reason to void a presentation, the reason of a
// withdrawal. Enter does it, Esc goes back.
#pragma once

#include "study/app/stage_page.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace study::app {

/// What a panel asks for and what becomes of it.
struct Reason {
    QString title;
    QString explanation;
    QString fieldName;
    QString action;
    bool mayBeEmpty = true;  ///< a second Enter goes without a reason; nobody is forced to give one
    std::function<session::EventBody(const std::string& text)> event;
};
Reason noteReason();
/// `presentation`: the code of the one that is meant; empty: the one before the present tray.
Reason voidReason(const QString& presentation);
Reason withdrawReason();

class ReasonPanel : public StagePage {
    Q_OBJECT
public:
    explicit ReasonPanel(QWidget* parent);

    /// Opens empty.
    void ask(const Reason& reason);

    void present(const session::View&) override {}
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

Q_SIGNALS:
    void closeAsked();

private:
    void confirm();

    Reason m_reason;
    bool m_isAskedAgain = false;
    QLabel* m_title;
    QLabel* m_explanation;
    QLineEdit* m_text;
    QPushButton* m_action;
    QPushButton* m_back;
};

}  // namespace study::app
