// One line to write: a note, a flag, the reason to void a presentation, the reason of a withdrawal.
#pragma once

#include "study/app/pages/form_panel.h"

namespace study::app {

class ReasonPanel : public FormPanel {
    Q_OBJECT
public:
    explicit ReasonPanel(QWidget* parent) : FormPanel(parent) {}

    void askForNote();
    /// Marks a presentation to be looked at; words are welcome but not needed. `presentation` as below.
    void askForFlag(const QString& presentation);
    /// `presentation`: the code of the one that is meant; empty: the one before the present tray.
    void askWhyVoid(const QString& presentation);
    void askWhyWithdrawn();

protected:
    session::EventBody eventFor(const std::string& reason) override { return m_event(reason); }

private:
    std::function<session::EventBody(const std::string&)> m_event;
};

}  // namespace study::app
