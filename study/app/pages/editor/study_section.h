// The first section of the editor: name of the study, participants, fabrics. Fabrics are a number or ids; the ids can be chosen
// from a data set.
#pragma once

#include <QWidget>
#include <filesystem>

#include "study/app/state/data_look.h"
#include "study/app/state/in_background.h"

class QLineEdit;
class QListWidget;
class QPushButton;

namespace study::app {

class DraftFields;
class MessageBar;

class StudySection : public QWidget {
    Q_OBJECT
public:
    StudySection(DraftFields& fields, LookAtData look, QWidget* parent);
    ~StudySection() override { m_reading.stop(); }

    /// Lists the fabrics of this data set, for choosing.
    void readDataset(const std::filesystem::path& folder);
    bool isReading() const { return m_reading.isBusy(); }

private:
    void browse();
    void showFabrics();
    void listFabrics(const DataOverview& data);
    void takeTyped(const QString& typed);
    void takeTicked();
    void tickChosen();

    DraftFields& m_fields;
    LookAtData m_look;
    QLineEdit* m_fabrics;
    QPushButton* m_browse;
    QListWidget* m_list;
    MessageBar* m_message;
    InBackground m_reading;
};

}  // namespace study::app
