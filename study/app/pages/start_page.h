// First page of the program: opens a study folder, recent or other, or leads to the pages for a new study or data set.
#pragma once

#include <QStringList>
#include <QWidget>

#include "study/app/language/language.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace study::app {

class MessageBar;

class StartPage : public QWidget {
    Q_OBJECT
public:
    explicit StartPage(QWidget* parent);

    /// Work that the program offers besides open studies.
    struct Offered {
        bool newStudies = false, dataSets = false, photographs = false;
    };
    /// `recentFolders`: the most recent first.
    void present(const QStringList& recentFolders, const Offered& offered);
    void showFault(const QString& text);
    /// Offers the shipped languages, with the present one chosen, and says whether somebody has checked its texts.
    void offerLanguages(const Language& present);
    void focusFirst();

Q_SIGNALS:
    void openRequested(const QString& folder);
    void monitorRequested(const QString& folder);
    void newStudyRequested();
    void makeProtocolRequested();
    void changeProtocolRequested();
    void dataRequested();
    void photographsRequested();
    void displayRequested();
    void keysRequested();
    void participantRequested();
    void languageChosen(const QString& tag);

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    /// Asks for the study by one of the signals, or for its name.
    void open(const QString& folder, void (StartPage::*request)(const QString&) = &StartPage::openRequested);
    void browse();

    QLabel* m_recentCaption;
    QListWidget* m_recent;
    QLineEdit* m_folder;
    QPushButton* m_browse;
    QPushButton* m_open;
    QPushButton* m_monitor;
    QPushButton* m_new;
    QPushButton* m_makeProtocol;
    QPushButton* m_changeProtocol;
    QPushButton* m_data;
    QPushButton* m_photographs;
    QPushButton* m_display;
    QPushButton* m_keys;
    QPushButton* m_participant;
    QLabel* m_languageCaption;
    QComboBox* m_languages;
    QLabel* m_reviewed;    ///< whether a native speaker has checked the texts
    QLabel* m_firstSteps;  ///< where to begin without a study
    MessageBar* m_message;
};

}  // namespace study::app
