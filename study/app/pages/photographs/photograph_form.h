// The controls of the page that makes a data set from photographs, laid out step by step. They belong to the page, which connects
// them.
#pragma once

#include <QCoreApplication>
#include <string>
#include <vector>

class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QVBoxLayout;
class QWidget;

namespace study::app {

class MessageBar;
class PhotographList;
class PhotographScale;

struct PhotographForm {
    Q_DECLARE_TR_FUNCTIONS(study::app::PhotographForm)

public:
    /// Makes the controls and lays them out on the page, which has no layout yet.
    explicit PhotographForm(QWidget& page);

    /// Ids of the conditions whose buttons are down.
    std::vector<std::string> chosenConditions() const;

    // ---- photographs
    QLineEdit* place;
    QPushButton* browseFiles;
    QPushButton* browseFolder;
    QPushButton* add;
    MessageBar* placeMessage;
    PhotographList* list;
    PhotographScale* scale;
    QPushButton* check;
    MessageBar* checkMessage;
    QPlainTextEdit* warnings;
    // ---- data set
    QLineEdit* target;
    QPushButton* browseTarget;
    QPushButton* write;
    MessageBar* targetMessage;
    // ---- friction images and study
    std::vector<QPushButton*> conditions;
    QPushButton* draw;
    MessageBar* drawMessage;
    QLabel* picture;
    QPushButton* toStudy;
    MessageBar* studyMessage;
    QPushButton* back;

private:
    void build(QWidget& page);
    void orderTabs() const;
    static void addStep(QVBoxLayout& column, const char* objectName, const QString& title, const QString& sentence);
    void buildPhotographs(QVBoxLayout& column);
    void buildResults(QVBoxLayout& column);
};

}  // namespace study::app
