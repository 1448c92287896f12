// A form that the operator opens in place of the stage page: title, explanation and a field for a reason. Enter stores, Esc goes
// back. Each form defines what Enter does without a reason.
#pragma once

#include "study/app/pages/stage_page.h"

class QGridLayout;
class QLabel;
class QPushButton;

namespace study::app {

class PageHead;
class WordsField;

class FormPanel : public StagePage {
    Q_OBJECT
public:
    void present(const session::View&) override {}
    int largestType() const override { return 160; }
    bool pressKey(int key) override;
    QWidget& firstFocus() override;
    bool hasUnstoredText() const override;

Q_SIGNALS:
    void closeRequested();

protected:
    /// Effect of Enter while the reason is empty. AskTwice: a second Enter is needed.
    enum class WithoutReason { Refuse, AskTwice, Accept };
    struct Texts {
        QString title, explanation, caption, action, hintWhenEmpty;
        WithoutReason withoutReason = WithoutReason::AskTwice;
    };
    explicit FormPanel(QWidget* parent);

    /// Shows the form with an empty reason.
    void open(const Texts& texts);
    /// Adds a row above the reason and takes ownership of the control. Returns the label of the caption.
    QWidget* addRow(const QString& caption, QWidget* control);
    /// Moves the focus to the reason.
    void focusReason();
    /// Writes this reason in place of the present one; the operator can still change it.
    void setReason(const QString& reason);
    /// Puts the reason and the buttons after `controls` in the tab order.
    void setReasonAfter(const QWidget& controls);

    /// Whether everything except the reason is given; emits hinted() if not.
    virtual bool isReady() { return true; }
    virtual session::EventBody eventFor(const std::string& reason) = 0;

private:
    void confirm();

    Texts m_texts;
    bool m_isAskedAgain = false;
    PageHead* m_head;
    QGridLayout* m_form;
    QLabel* m_caption;
    WordsField* m_reason;
    QPushButton* m_action;
    QPushButton* m_back;
};

}  // namespace study::app
