// One running session: header, the page of its stage, footer, and in the stage's place the panels that are
// opened by wish. Shows what it is given and asks for events; the engine is elsewhere.
#pragma once

#include "study/app/session_controller.h"

#include <QWidget>

class QScrollArea;
class QStackedWidget;

namespace study::app {

class ChoicePage;
class CorrectionPanel;
class GuidePage;
class MessageBar;
class RatingPage;
class ReasonPanel;
class SessionFooter;
class SessionHeader;
class StagePage;
class TrayPage;

class SessionPage : public QWidget {
    Q_OBJECT
public:
    explicit SessionPage(QWidget* parent);

    /// A session starts or goes on in this window: nothing is known of the tray, no box is ticked.
    void begin(const SessionFacts& facts);
    void present(const session::View& view, const std::vector<Correctable>& correctables);
    /// An event was accepted: messages and panels go.
    void settle();
    void tell(const QString& text, Tone tone);
    const session::View& shows() const { return m_view; }

    /// A key that no control took; true where something came of it.
    bool pressKey(int key);

Q_SIGNALS:
    void eventAsked(const study::session::EventBody& event);
    /// The session shall be left, after a pause where it still runs.
    void leaveAsked();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void addPage(StagePage* page, const char* areaName);
    void joinPanels();
    StagePage& pageOf(const session::View& view) const;
    StagePage& pageInFront() const;
    void bringForward(StagePage& page);
    void openPanel(StagePage& panel);
    void closePanel();
    void rememberTray(const session::View& view);
    /// Empty where it is about the presentation before the tray that is being laid.
    QString codeThatAVoidIsAbout() const;
    bool pressFocusedButton() const;
    bool scrollBy(int key);

    session::View m_view;
    std::vector<Correctable> m_correctables;
    StagePage* m_panel = nullptr;  ///< the open one

    SessionHeader* m_header;
    QStackedWidget* m_stages;
    MessageBar* m_message;
    SessionFooter* m_footer;
    GuidePage* m_guide;
    TrayPage* m_tray;
    ChoicePage* m_choice;
    RatingPage* m_rating;
    CorrectionPanel* m_correction;
    ReasonPanel* m_reason;
};

}  // namespace study::app
