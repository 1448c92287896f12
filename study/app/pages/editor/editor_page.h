// The page that makes and changes protocols. It takes a draft, shows it in sections and gives the changed one back; it also opens
// and saves its file. Beside the sections it shows every fault, minutes, power and a preview of the session's pages.
#pragma once

#include <QWidget>
#include <filesystem>
#include <optional>

#include "study/app/drafts/protocol_draft.h"
#include "study/app/drafts/session_outlook.h"
#include "study/app/pages/editor/section_tabs.h"
#include "study/app/state/data_look.h"

class QFrame;
class QLabel;
class QPushButton;
class QScrollArea;
class QStackedWidget;
class QTimer;

namespace study::app {

class AnalysisSection;
class CheckPanel;
class ConditionsSection;
class DraftFields;
class EditorStart;
class KeyedTexts;
class MessageBar;
class PhasesSection;
class StudySection;

class EditorPage : public QWidget {
    Q_OBJECT
public:
    EditorPage(LookAtData look, LookAhead lookAhead, QWidget* parent);
    ~EditorPage() override;

    void focusFirst();
    /// Shows the examples, or the field for a file to change.
    void offerExamples();
    void offerFile();
    /// Opens the file in the editor. What is wrong is shown beside it, or on the page of the beginning if it is no JSON.
    void open(const std::filesystem::path& file);

    /// Shows this draft. `file`: where it stands as it is; empty if it is not saved yet.
    void edit(const ProtocolDraft& draft, const std::filesystem::path& file);
    const ProtocolDraft& draft() const;
    void showSection(EditorSection section);
    /// Shows faults, numbers and preview where the window has no room for them beside the section, or the section again.
    void showPanel(bool isShown);
    const std::filesystem::path& file() const { return m_file; }
    bool hasUnsavedChanges() const;
    /// False if the draft is not saved; the page then asks what to do with it.
    bool mayClose();
    /// True while numbers are computed or a data set is read.
    bool isBusy() const;

Q_SIGNALS:
    void backRequested();
    /// A study is to be made by this saved protocol.
    void studyRequested(const QString& protocol);

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void buildEditor();
    void buildBars(QWidget& editor);
    void connectParts();
    void jumpTo(const QString& place);
    void removeKey(const QString& object, const QString& key);
    void checkSoon();
    void check();
    void arrange();
    void showTitle();
    void commitField();
    bool save();
    bool saveAs();
    bool write(const std::filesystem::path& file);
    void makeStudy();
    void leave();
    void stay();

    LookAtData m_look;
    LookAhead m_lookAhead;
    DraftFields* m_fields;
    std::filesystem::path m_file;
    std::optional<ProtocolDraft> m_saved;  ///< as it stands in the file; empty for a new draft
    std::string m_savedText;               ///< of the file; empty for a new draft
    ProtocolDraft m_begun;                 ///< the new draft before any change
    bool m_isPanelShown = false;           ///< in a window that has no room for both

    QStackedWidget* m_pages;
    EditorStart* m_start;
    QWidget* m_editor;
    QLabel* m_title;
    SectionTabs* m_tabs;
    QStackedWidget* m_sections;
    StudySection* m_study;
    ConditionsSection* m_conditions;
    PhasesSection* m_phases;
    AnalysisSection* m_analysis;
    QList<KeyedTexts*> m_keyedTexts;  ///< of the section of the texts
    CheckPanel* m_panel;
    QScrollArea* m_panelArea;
    MessageBar* m_message;
    LeaveGuard* m_guard;
    QFrame* m_bar;
    QPushButton* m_summary;
    QPushButton* m_save;
    QPushButton* m_saveAs;
    QPushButton* m_make;
    QPushButton* m_undo;
    QPushButton* m_back;
    QTimer* m_checkTimer;
};

}  // namespace study::app
