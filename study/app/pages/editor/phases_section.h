// The section of the questions: the phases in their order, and the chosen one in detail.
#pragma once

#include <QWidget>

class QComboBox;
class QListWidget;
class QPushButton;
class QVBoxLayout;

namespace study::app {

class DraftFields;

class PhasesSection : public QWidget {
    Q_OBJECT
public:
    PhasesSection(DraftFields& fields, QWidget* parent);

    /// Number of the phase that is shown, from 0; -1 without phases.
    int chosen() const { return m_chosen; }
    void choose(int phase);

Q_SIGNALS:
    /// Another phase is shown.
    void chosenChanged();

private:
    void present();
    void listPhases();
    void showDetail();
    /// Takes the name of a question that is still being typed.
    void commitField();
    void add();
    void move(int step);
    void remove();

    DraftFields& m_fields;
    int m_chosen = -1;
    QListWidget* m_list;
    QComboBox* m_newKind;
    QPushButton* m_add;
    QPushButton* m_up;
    QPushButton* m_down;
    QPushButton* m_remove;
    QVBoxLayout* m_place;         ///< of the detail
    QWidget* m_detail = nullptr;  ///< of the chosen phase
};

/// "pick the fabric among pieces", …: the kinds of phases in the order of PhaseKind.
QStringList phaseKindNames();

}  // namespace study::app
