// First page of the program: opens a study folder, recent or other, or leads to the pages for a new study or a data set.
#pragma once

#include <QStringList>
#include <QWidget>

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

    /// `recentFolders`: the most recent first.
    void present(const QStringList& recentFolders, bool canMakeStudies, bool canLookAtData);
    void showFault(const QString& text);
    void focusFirst();

Q_SIGNALS:
    void openRequested(const QString& folder);
    void newStudyRequested();
    void dataRequested();
    void displayRequested();
    void keysRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    void open(const QString& folder);
    void browse();

    QLabel* m_recentCaption;
    QListWidget* m_recent;
    QLineEdit* m_folder;
    QPushButton* m_browse;
    QPushButton* m_open;
    QPushButton* m_new;
    QPushButton* m_data;
    QPushButton* m_display;
    QPushButton* m_keys;
    MessageBar* m_message;
};

}  // namespace study::app
