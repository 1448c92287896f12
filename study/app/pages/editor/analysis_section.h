// The section of the analysis: bounds of equivalence, planned contrasts, the primary one.
#pragma once

#include <QWidget>

#include "study/app/drafts/draft_edits.h"

class QComboBox;
class QLineEdit;
class QListWidget;
class QPushButton;

namespace study::app {

class DraftFields;
class MessageBar;

class AnalysisSection : public QWidget {
    Q_OBJECT
public:
    AnalysisSection(DraftFields& fields, QWidget* parent);

    /// Chooses the planned contrast with this number, from 0.
    void choose(int contrast);

private:
    void present();
    /// As hints in the empty fields: the bounds of a protocol that states none.
    void showUsualBounds();
    void offerConditions();
    void takeBounds();
    void add();
    void remove();
    void makePrimary();

    DraftFields& m_fields;
    QLineEdit* m_lower;
    QLineEdit* m_upper;
    QListWidget* m_list;
    QPushButton* m_remove;
    QPushButton* m_primary;
    QComboBox* m_a;
    QComboBox* m_b;
    QPushButton* m_add;
    MessageBar* m_message;
};

}  // namespace study::app
