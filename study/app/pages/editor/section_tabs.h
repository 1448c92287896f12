// The sections of the editor to choose from, and which of them holds a place of the protocol. Buttons where there is room, else a
// list.
#pragma once

#include <QWidget>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

class QComboBox;
class QPushButton;

namespace study::app {

enum class EditorSection { Study, Conditions, Questions, Course, Texts, Analysis };
inline constexpr int editorSections = 6;

/// The section whose controls belong to the place ("phases[0].scale").
EditorSection sectionOf(const std::string& place);

/// The whole number behind `before` in a place: 2 for "phases[2].scale" and "phases[".
std::optional<int> numberIn(const std::string& place, std::string_view before);

class SectionTabs : public QWidget {
    Q_OBJECT
public:
    explicit SectionTabs(QWidget* parent);

    void setChosen(EditorSection section);
    /// Offers the sections in a list instead of buttons.
    void setNarrow(bool isNarrow);

Q_SIGNALS:
    void chosen(study::app::EditorSection section);

private:
    std::vector<QPushButton*> m_buttons;
    QComboBox* m_list;
};

/// What to do with changes that are not saved, asked before the page is left.
class LeaveGuard : public QWidget {
    Q_OBJECT
public:
    explicit LeaveGuard(QWidget* parent);
    void ask();

Q_SIGNALS:
    void saveRequested();
    void dropRequested();
    void stayRequested();

private:
    QPushButton* m_save;
};

}  // namespace study::app
