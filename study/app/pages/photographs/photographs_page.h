// Page that makes a data set from photographs, step by step: photographs, scale, check, data set, friction images, study. Each
// step has its own sentence, and its message beside its controls.
#pragma once

#include <QWidget>
#include <filesystem>

#include "study/app/pages/photographs/photograph_form.h"
#include "study/app/pages/photographs/step_work.h"
#include "study/app/state/in_background.h"
#include "study/app/state/photograph_steps.h"

namespace study::app {

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
    void enable();
    void goBack();

    PhotographSteps m_steps;
    std::filesystem::path m_dataset;  ///< data set that was written from these photographs; empty if none
    QImage m_drawn;                   ///< friction images of the data set
    bool m_isTargetTyped = false;
    bool m_isViewedAgain = false;  ///< another photograph was chosen while one was read
    PhotographForm m_form;
    StepWork m_work;
    InBackground m_viewing;
};

}  // namespace study::app
