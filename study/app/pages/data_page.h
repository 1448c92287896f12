// Page to inspect a data set before a study is made from it: the fabrics with their counts, the faults of the files, and the
// signals of one fabric, sample by sample.
#pragma once

#include <QWidget>
#include <atomic>
#include <optional>

#include "study/app/state/data_look.h"

class QBoxLayout;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QScrollArea;
class QTreeWidget;
class QVBoxLayout;

namespace study::app {

class InBackground;
class MessageBar;

class DataPage : public QWidget {
    Q_OBJECT
public:
    DataPage(const LookAtData& look, QWidget* parent);
    ~DataPage() override;

    void focusFirst();
    /// Opens the folder and shows its contents, or the fault, on the page.
    void open(const QString& folder);
    /// True while the page reads, draws or checks.
    bool isBusy() const;

Q_SIGNALS:
    void backRequested();

protected:
    void keyPressEvent(QKeyEvent* event) override;
    void changeEvent(QEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void build();
    void browse();
    void showOverview(const QString& folder, const DataOverview& overview);
    void checkFiles();
    void showFaults(const QStringList& faults);
    void stepSample(int step);
    void chooseFabric();
    void draw();
    void drawSoon();
    void showSheet(const DataSheet& sheet);
    void arrange();
    void enable();
    const DataOverview::Fabric* chosen() const;

    LookAtData m_look;
    DataOverview m_overview;
    QString m_folder;  ///< open data set; empty if none
    int m_sample = 0;
    bool m_isDrawingDue = false;  ///< a drawing is scheduled for the end of resizing
    bool m_isDrawnAgain = false;  ///< another sheet was requested during the current drawing

    QLineEdit* m_folderField;
    QPushButton* m_browse;
    QPushButton* m_open;
    QLabel* m_about;
    QTreeWidget* m_fabrics;
    QLabel* m_checked;
    QPlainTextEdit* m_faults;
    QLabel* m_sampleLabel;
    QPushButton* m_before;
    QPushButton* m_after;
    QLabel* m_keys;
    QLabel* m_sheet;
    QPushButton* m_back;
    QScrollArea* m_area = nullptr;
    MessageBar* m_message;
    InBackground* m_reading;
    InBackground* m_drawing;
    InBackground* m_checking;
};

}  // namespace study::app
