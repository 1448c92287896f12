// The editor of protocols in a window, for its tests: opens it and types into its controls as an experimenter does.
#pragma once

#include <QApplication>
#include <QComboBox>
#include <QCoreApplication>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>
#include <QTimer>

#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "study/app/pages/editor/editor_page.h"
#include "study/commands/parts/look_ahead.h"
#include "tests/support/open_window.h"

namespace tests {

inline study::app::AppOptions editorOptions()
{
    study::app::AppOptions options;
    options.makeStudy = [](const study::app::NewStudyRequest&, const study::app::MakingProgress&) {
        return std::vector<std::string>();
    };
    options.lookAhead = study::commands::lookAhead;
    return options;
}

/// Names the file in the dialog that opens next.
inline void nameInDialog(const QString& path)
{
    QTimer::singleShot(0, [path] {
        QFileDialog* dialog = nullptr;
        QTRY_VERIFY((dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) != nullptr);
        dialog->findChild<QLineEdit*>("fileNameEdit")->setText(path);
        QPushButton* accept = nullptr;
        for (const auto role : {QDialogButtonBox::Open, QDialogButtonBox::Save})
            if (!accept) accept = dialog->findChild<QDialogButtonBox*>()->button(role);
        // A file that exists is asked about.
        QTimer::singleShot(100, [] {
            if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) box->button(QMessageBox::Yes)->click();
        });
        QTest::mouseClick(accept, Qt::LeftButton);
    });
}

/// A window with the editor in front.
struct ShownEditor : support::ShownWindow {
    explicit ShownEditor(const study::app::AppOptions& options = editorOptions()) : support::ShownWindow(options)
    {
        window.resize(1280, 800);
        (void)QTest::qWaitForWindowActive(&window);
        gui.click("makeProtocolButton");
    }
    study::app::EditorPage& page() const { return *qobject_cast<study::app::EditorPage*>(window.currentPage()); }

    /// Begins with the example whose row contains the words.
    void beginWith(const QString& words)
    {
        auto& list = widget<QListWidget>("exampleList");
        for (int row = 0; row < list.count(); ++row)
            if (list.item(row)->text().contains(words)) list.setCurrentRow(row);
        QVERIFY(list.currentItem()->text().contains(words));
        gui.click("beginProtocolButton");
    }
    void open(const QString& file)
    {
        gui.focusOn("protocolFileField");
        gui.clear();
        gui.type(file);
        gui.pressKey(Qt::Key_Return);
    }
    /// Types into a field and waits for the check.
    void enter(const char* place, const QString& text)
    {
        gui.focusOn(QLatin1String(place));
        gui.clear();
        gui.type(text);
        check();
    }
    /// Chooses the row of a list by its number, with the keys.
    void pick(const char* box, int row)
    {
        // A choice may build its part of the page anew, and itself with it.
        const auto choice = [&] { return qobject_cast<QComboBox*>(&gui.widget(QLatin1String(box))); };
        for (int step = 0; choice()->currentIndex() != row && step < 50; ++step) {
            choice()->setFocus();
            QTest::keyClick(choice(), choice()->currentIndex() < row ? Qt::Key_Down : Qt::Key_Up);
        }
        QCOMPARE(choice()->currentIndex(), row);
    }
    void section(int number) { gui.click(QStringLiteral("section%1Button").arg(number)); }
    void check()
    {
        QTRY_VERIFY_WITH_TIMEOUT(!page().isBusy(), 60000);
        QCoreApplication::processEvents();  // a layout shows its new widgets later
    }
    QString text(const char* name) const
    {
        const auto* found = page().findChild<QLabel*>(QLatin1String(name));
        return found ? found->text() : QString();
    }
    QStringList faults() const
    {
        QStringList all;
        for (int number = 1;; ++number) {
            const auto* one = page().findChild<QLabel*>(QStringLiteral("fault%1").arg(number));
            if (!one) return all;
            all << one->text();
        }
    }
    /// Saves under a new name.
    void saveAs(const QString& file)
    {
        nameInDialog(file);
        gui.click("saveAsButton");
    }
};

inline protocols::Protocol protocolAt(const QString& file) { return protocols::readProtocol(file.toStdString()); }

inline std::string bytesAt(const QString& file) { return protocols::readWholeFile(file.toStdString()); }

}  // namespace tests
