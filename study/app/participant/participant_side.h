// What the participant sees on a screen of their own, and what they do there. Holds the present instruction, gives it to the page
// in a tablet's browser and to the window on a second screen, and passes on the acts of the participant. It decides nothing about
// the session.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <map>
#include <string>

#include "protocols/protocol.h"
#include "study/app/participant/line_process.h"

namespace study::app {

/// The page in the network, as the operator sees it.
struct PageState {
    bool isOn = false;  ///< the operator has started the page
    QString address;    ///< "http://192.168.1.5:8577"; empty until the page listens
    QString code;       ///< for the first browser; empty if a browser is in, or the code is void
    QString device;     ///< address of the browser that is in
    QString refused;    ///< address of the last other browser that tried to enter while one is in
    int wrongCodes = 0;
    QString fault;  ///< why the page does not run, with the next step
    bool operator==(const PageState&) const = default;
};

class ParticipantSide : public QObject {
    Q_OBJECT
public:
    explicit ParticipantSide(QObject* parent);

    /// The words of this study, for the page itself. The same words again change nothing.
    void setWords(const protocols::Protocol& protocol);
    /// Shows this now.
    void show(const participant::Instruction& instruction);
    const participant::Instruction& shown() const { return m_shown.instruction; }
    /// How long the break has lasted, s; 0 outside breaks.
    int breakSeconds() const;

    /// Starts the page at an address of this computer, with a new code. Faults stand in state().
    void startPage(const QString& address);
    void stopPage();
    /// Draws a new code; the browser that was in is out.
    void drawCode();
    const PageState& state() const { return m_state; }
    qint64 pageProcessId() const { return m_process->processId(); }

Q_SIGNALS:
    void instructionChanged();
    void stateChanged();
    /// The participant did this while the page showed the present instruction.
    void acted(const study::participant::ParticipantAct& act);

private:
    void launch();
    void tell(const participant::LineToPage& line);
    void hear(const std::string& text);
    void take(const participant::LineFromPage& line);
    void recover(const QString& why);

    participant::NumberedInstruction m_shown;
    QElapsedTimer m_sinceShown;
    participant::PageTexts m_texts;
    PageState m_state;
    LineProcess* m_process;
    QTimer* m_again;
    QString m_listenAddress;
    int m_port = 0;  ///< 0 until the page has listened once
    int m_failuresInARow = 0;
    QElapsedTimer m_sinceLaunch;
    std::string m_sessionHash;  ///< of the browser that is in
};

}  // namespace study::app
