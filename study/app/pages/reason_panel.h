// Form with one line of text: a note, a flag, the reason to void a presentation, or the reason for a withdrawal.
#pragma once

#include "study/app/pages/form_panel.h"

namespace study::app {

class ReasonPanel : public FormPanel {
    Q_OBJECT
public:
    explicit ReasonPanel(QWidget* parent) : FormPanel(parent) {}

    void askForNote();
    /// Marks a presentation for inspection; the reason is optional. `presentation`: see askWhyVoid().
    void askForFlag(const QString& presentation);
    /// `presentation`: its code; empty: the presentation before the current tray.
    void askWhyVoid(const QString& presentation);
    void askWhyWithdrawn();

protected:
    session::EventBody eventFor(const std::string& reason) override { return m_event(reason); }

private:
    std::function<session::EventBody(const std::string&)> m_event;
};

}  // namespace study::app
