// A form that is opened by wish in place of the stage page: what it is about, one line to write a reason into, and
// whether a second Enter does it without one. Enter does it, Esc goes back.
#pragma once

#include "study/app/pages/stage_page.h"

class QGridLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace study::app {

class PageHead;

class FormPanel : public StagePage {
    Q_OBJECT
public:
    void present(const session::View&) override {}
    bool pressKey(int key) override;
    QWidget& firstFocus() override;

Q_SIGNALS:
    void closeRequested();

protected:
    /// What Enter does while nothing is written.
    enum class Empty { IsRefused, IsAskedAgain, IsFine };
    struct Texts {
        QString title, explanation, caption, action, hintWhenEmpty;
        Empty empty = Empty::IsAskedAgain;
    };
    explicit FormPanel(QWidget* parent);

    /// Opens with nothing written.
    void open(const Texts& texts);
    /// A row between the explanation and the line to write; takes the control.
    void addRow(const QString& caption, QWidget* control);
    /// Lets the hand go on to the line to write.
    void focusReason();
    /// Tab leads there from the last of these controls.
    void setReasonAfter(const QWidget& controls);

    /// False, after a hint, where something other than the reason is missing.
    virtual bool isReady() { return true; }
    virtual session::EventBody eventFor(const std::string& reason) = 0;

private:
    void confirm();

    Texts m_texts;
    bool m_isAskedAgain = false;
    PageHead* m_head;
    QGridLayout* m_form;
    QLabel* m_caption;
    QLineEdit* m_reason;
    QPushButton* m_action;
    QPushButton* m_back;
};

}  // namespace study::app
