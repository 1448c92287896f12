// Page of an open study: all participants, the next one to enrol, and sessions to continue. Blinded: it shows places, codes
// and counts, but no stimulus, condition or answer.
#pragma once

#include <QWidget>

#include "study/app/state/open_study.h"

class QBoxLayout;
class QFrame;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;

namespace study::app {

class MessageBar;

class StudyPage : public QWidget {
    Q_OBJECT
public:
    explicit StudyPage(QWidget* parent);

    /// `kind`: sessions of participants of other kinds cannot be continued here.
    void present(const StudyOverview& overview, database::ParticipantKind kind);
    /// The places as they stand now. What the operator has typed stays.
    void refresh(const StudyOverview& overview);
    void showFault(const QString& text);
    void showHint(const QString& text);
    /// What the program noticed as it made this study, until its first participant.
    void showRemarks(const QStringList& remarks);
    void focusFirst();
    /// Shows the button of the tools.
    void offerTools(bool isOffered);
    /// Shows the button of the rehearsal. At a station it cannot be pressed, and F8 says why.
    void offerRehearsal(bool isOffered);

Q_SIGNALS:
    /// The operator continues the session of this participant.
    void sessionRequested(const QString& participant);
    /// The operator enrols this participant, whom nobody may have enrolled before.
    void enrolmentRequested(const QString& participant);
    /// The page is about to compare a code with those of all participants. Answered by refresh() before the signal returns.
    void placesWanted();
    /// The page asked the operator to press Enter again.
    void secondEnterAsked();
    void closeRequested();
    void displayRequested();
    void keysRequested();
    void participantRequested();
    void toolsRequested();
    void rehearsalRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    QFrame* card(const char* objectName, const QString& caption, QLabel* hint, const std::vector<QWidget*>& controls);
    void arrange();
    void arrangeSoon();
    void askForRehearsal();
    void showPlaces();
    void enrol();
    void resumeChosen();
    void showChosen();
    const StudyOverview::ParticipantPlace* chosenPlace() const;
    bool canResume(const StudyOverview::ParticipantPlace& place) const;
    QString stateText(const StudyOverview::ParticipantPlace& place) const;

    bool m_isAskedAgain = false;  ///< whether a new participant is really meant while a session is in progress
    StudyOverview m_overview;
    database::ParticipantKind m_kind = database::ParticipantKind::Human;
    QLabel* m_title;
    QLabel* m_folder;
    QLabel* m_summary;
    QBoxLayout* m_middle;
    QTreeWidget* m_places;
    QLineEdit* m_going;  ///< code of the participant who goes on
    QPushButton* m_resume;
    QLabel* m_enrolHint;
    QLineEdit* m_participant;
    QPushButton* m_enrol;
    QPushButton* m_display;
    QPushButton* m_keys;
    QPushButton* m_screen;
    QPushButton* m_close;
    QPushButton* m_tools;
    QPushButton* m_rehearsal;
    MessageBar* m_message;
    MessageBar* m_remarks;
};

}  // namespace study::app
