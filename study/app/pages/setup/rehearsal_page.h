// Page of the rehearsal: everything that a session needs, tried once before the first participant comes. It ends with "Ready for
// P01", or with the list of what is missing.
#pragma once

#include <QWidget>

#include "study/app/state/rehearsal.h"

class QBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace study::app {

class MessageBar;
class TickBox;

class RehearsalPage : public QWidget {
    Q_OBJECT
public:
    explicit RehearsalPage(QWidget* parent);

    struct Study {
        QString nextParticipant;
        QStringList pieces;  ///< codes on the fabric pieces
        QString clockFault;
    };
    /// Forgets what was tried before. showRoom() and refresh() follow. `pieces`: codes on the fabric pieces.
    void begin(const QStringList& pieces);
    /// What is known where the study cannot be read, too; what was tried stays. `displayName`: empty if no display is connected.
    void showRoom(const QString& displayName, const QString& diskFault);
    /// What the study tells now. A fault that the page showed is over.
    void refresh(const Study& study);
    /// The session was left. `isWhole`: it was played to its end.
    void sessionLeft(bool isWhole);
    void showFault(const QString& text);
    void focusFirst();
    const RehearsalState& tried() const { return m_state; }

Q_SIGNALS:
    void sessionRequested();
    void displayRequested();
    void checksRequested();  ///< asks for showRoom() and refresh()
    void backRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    TickBox* addTick(QBoxLayout& column, const char* objectName, const QString& text, bool RehearsalState::*item);
    void readPiece();
    void show();

    RehearsalState m_state;
    Study m_study;
    QString m_displayName;
    QLabel* m_display;
    QLabel* m_pieces;
    QLineEdit* m_piece;
    QLabel* m_computer;
    QLabel* m_session;
    QLabel* m_result;
    TickBox* m_felt;
    TickBox* m_heard;
    TickBox* m_sheets;
    QPushButton* m_play;
    QPushButton* m_chooseDisplay;
    QPushButton* m_again;
    QPushButton* m_back;
    MessageBar* m_message;
};

}  // namespace study::app
