// Form for a new study, with the progress of its creation. Paths can be typed or chosen in a dialog.
#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <vector>

#include "protocols/secrets/new_passphrase.h"
#include "study/app/state/app_options.h"

class QComboBox;
class QGridLayout;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;

namespace study::app {

class MessageBar;
class StudyMaking;

class NewStudyPage : public QWidget {
    Q_OBJECT
public:
    NewStudyPage(MakeStudy make, QWidget* parent);
    ~NewStudyPage() override;

    void focusFirst();
    /// Enters this data set and this protocol.
    void fill(const QString& dataset, const QString& protocol);
    /// Enters this protocol and keeps the other fields.
    void fillProtocol(const QString& protocol);

Q_SIGNALS:
    void made(const QString& folder, const QStringList& remarks);
    void backRequested();
    /// The operator makes a protocol, or changes this file; empty if none is named.
    void protocolEditRequested(const QString& file);

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    enum class Browse { Folder, NewFolder, File };
    QLineEdit* addPath(QGridLayout& form, const char* objectName, const QString& caption, const QString& hint, Browse browse);
    void addRow(QGridLayout& form, const QString& caption, QWidget* control);
    /// Puts the message below the row of this line.
    void placeMessage(QLineEdit* line);
    /// The field whose path the text of a fault names; the study folder if it names none.
    QLineEdit& fieldOf(const QString& fault) const;
    void browseFor(QLineEdit& target, Browse browse);
    std::optional<NewStudyRequest> request();
    static QString textOf(protocols::PassphraseFault fault);
    void make();
    void goBack();
    void end();
    void enable();

    MakeStudy m_make;
    std::unique_ptr<StudyMaking> m_making;
    QGridLayout* m_form;
    QLineEdit* m_study;
    QLineEdit* m_dataset;
    QLineEdit* m_protocol;
    QComboBox* m_language;  ///< of the participants
    QLineEdit* m_participants;
    QLineEdit* m_seed;
    QLineEdit* m_passphrase;
    QLineEdit* m_passphraseAgain;
    QPushButton* m_editProtocol;
    QPushButton* m_makeButton;
    QPushButton* m_back;
    QLabel* m_doing;
    QProgressBar* m_bar;
    MessageBar* m_message;
    std::vector<QWidget*> m_inputs;
};

}  // namespace study::app
