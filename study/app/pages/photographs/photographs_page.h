// Page that makes a data set from photographs, step by step: photographs, scale, check, data set, friction images, study. Each
// step has its own sentence, and its message beside its controls.
#pragma once

#include <QWidget>
#include <filesystem>

#include "study/app/state/in_background.h"
#include "study/app/state/photograph_steps.h"

class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class MessageBar;
class PhotographList;
class PhotographScale;

class PhotographsPage : public QWidget {
    Q_OBJECT
public:
    PhotographsPage(PhotographSteps steps, QWidget* parent);
    ~PhotographsPage() override;

    void focusFirst();
    /// Adds a photograph, or all in a folder and its sub-folders.
    void add(const QString& place);
    /// True while a step is under way or a picture is read.
    bool isBusy() const { return m_work.isBusy() || m_viewing.isBusy(); }

Q_SIGNALS:
    void backRequested();
    /// The operator goes on to a new study with this data set and this protocol.
    void studyRequested(const QString& dataset, const QString& protocol);

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void build();
    void addStep(QVBoxLayout& column, const char* objectName, const QString& title, const QString& sentence);
    void buildPhotographs(QVBoxLayout& column);
    void buildResults(QVBoxLayout& column);
    void connectSteps();
    void browseFiles();
    void browseFolder();
    void browseTarget();
    void addAll(const std::vector<std::filesystem::path>& places);
    void view();
    void check();
    void showWarnings(const std::vector<QStringList>& warnings);
    void write();
    void draw();
    void plan();
    /// Ids of the chosen conditions. If there is none, shows a hint beside them.
    std::vector<std::string> chosenConditions();
    /// Fits the friction images to the width of the page.
    void showPicture();
    void changed();
    void proposeFolder();
    /// The set as the page shows it. Empty where names or scale are not valid; the page then shows why.
    std::optional<PhotographSet> goodSet();
    /// Runs a step; its progress and its fault appear in `message`.
    using Step = std::function<InBackground::Then(const ToolProgress& progress)>;
    void run(MessageBar& message, const QString& doing, Step step);
    void enable();
    void goBack();

    PhotographSteps m_steps;
    std::filesystem::path m_dataset;  ///< data set that was written from these photographs; empty if none
    QImage m_drawn;                   ///< friction images of the data set
    bool m_isTargetTyped = false;
    bool m_isViewedAgain = false;  ///< another photograph was chosen while one was read
    QLineEdit* m_place;
    QPushButton* m_browseFiles;
    QPushButton* m_browseFolder;
    QPushButton* m_add;
    MessageBar* m_placeMessage;
    PhotographList* m_list;
    PhotographScale* m_scale;
    QPushButton* m_check;
    MessageBar* m_checkMessage;
    QPlainTextEdit* m_warnings;
    QLineEdit* m_target;
    QPushButton* m_browseTarget;
    QPushButton* m_write;
    MessageBar* m_targetMessage;
    std::vector<QPushButton*> m_conditions;
    QPushButton* m_draw;
    MessageBar* m_drawMessage;
    QLabel* m_picture;
    QPushButton* m_study;
    MessageBar* m_studyMessage;
    QPushButton* m_back;
    InBackground m_work, m_viewing;
};

}  // namespace study::app
