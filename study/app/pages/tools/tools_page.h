// Page for the work around the sessions of an open study: status, check, sheets, backup, export, report, data sheet, monitor.
#pragma once

#include <QWidget>
#include <filesystem>
#include <vector>

#include "study/app/state/in_background.h"
#include "study/app/state/study_tool.h"

class QLineEdit;
class QPlainTextEdit;
class QPushButton;

namespace study::app {

class MessageBar;

class ToolsPage : public QWidget {
    Q_OBJECT
public:
    ToolsPage(UseTool use, QWidget* parent);

    /// Shows the tools of this study. Its neighbour is the folder that new files go to, until the operator names another.
    void present(const std::filesystem::path& study);
    void showFault(const QString& text);
    void focusFirst();
    bool isBusy() const { return m_work.isBusy(); }

Q_SIGNALS:
    void monitorRequested();
    void backRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    struct Entry {
        StudyTool tool;
        int key;
        QPushButton* button;
    };
    void use(StudyTool tool);
    void showProgress(const QString& text);
    void show(const ToolOutcome& outcome);
    void enable();
    void goBack();
    void browse();
    void openMade();

    UseTool m_use;
    std::filesystem::path m_study, m_made;
    std::vector<Entry> m_tools;
    QLineEdit* m_into;  ///< folder that receives new files
    QPushButton* m_browse;
    QPushButton* m_monitor;
    QPushButton* m_open;
    QPushButton* m_back;
    QPlainTextEdit* m_text;
    MessageBar* m_message;
    InBackground m_work;  ///< last member: its thread ends before the widgets that it reports to
};

}  // namespace study::app
