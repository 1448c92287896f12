// The tools of the study page, with the functions of the commands and a study that the window keeps locked.
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>
#include <QThread>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/commands/study_tools.h"
#include "study/exports/write_export.h"
#include "study/records/stored_study.h"
#include "study/records/study_status.h"
#include "tests/support/open_window.h"
#include "tests/support/played_session.h"

using namespace study::app;
using tests::support::OpenWindow;
namespace fs = std::filesystem;

class AppToolsTest : public tests::support::WindowTest {
    Q_OBJECT

    AppOptions options()
    {
        AppOptions given;
        given.useTool = study::commands::studyTools("Mai");
        return given;
    }
    ToolsPage& openTools(OpenWindow& open, const QString& into)
    {
        open.gui().pressKey(Qt::Key_F2);
        auto& page = *qobject_cast<ToolsPage*>(open.window().currentPage());
        page.findChild<QLineEdit*>("toolsFolderField")->setText(into);
        return page;
    }
    QString folderFor(const char* test)
    {
        const QString folder = filePath(QString::fromLatin1(test));
        QDir().mkpath(folder);
        return folder;
    }
    QString textOn(const ToolsPage& page) { return page.findChild<QPlainTextEdit*>("toolResult")->toPlainText(); }

private Q_SLOTS:
    void statusIsTheTextOfTheCommand();
    void soundStudyAndEachFaultAreShown();
    void everyFileIsMadeAndRecorded();
    void exportOfAnOpenKeyHoldsNoMeans();
    void nothingIsWrittenIntoTheStudyOrAMissingFolder();
    void faultIsShownAndLongWorkStops();
    void monitorOpensBesideThePage();
    void windowWithoutToolsShowsNoButton();
};

void AppToolsTest::statusIsTheTextOfTheCommand()
{
    const auto study = newStudy();
    OpenWindow open(study, options());
    auto& page = openTools(open, filePath("."));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_S);
    QTRY_VERIFY(!page.isBusy());
    const auto store = study::records::openStudy(open.window().study()->store().folder().folder);
    QCOMPARE(textOn(page), QString::fromStdString(study::records::textOf(study::records::statusOf(store, {}))));
    QVERIFY(!textOn(page).isEmpty());
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Escape);
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

void AppToolsTest::soundStudyAndEachFaultAreShown()
{
    const auto study = newStudy();
    OpenWindow open(study, options());
    auto& page = openTools(open, filePath("."));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_V);
    QTRY_VERIFY(!page.isBusy());
    const QString before = textOn(page);
    std::ofstream(study.folder / "stray.txt") << "a file that nobody recorded";
    QTest::keyClick(open.window().focusWidget(), Qt::Key_V);
    QTRY_VERIFY(!page.isBusy());
    QVERIFY2(textOn(page) != before && textOn(page).contains("stray.txt"), qPrintable(before + "\n" + textOn(page)));
    QCOMPARE(page.findChild<QLabel*>("toolsMessage")->property("role").toString(), QString("fault"));
}

void AppToolsTest::everyFileIsMadeAndRecorded()
{
    const auto study = newStudy();
    OpenWindow open(study, options());
    const QString into = folderFor("made");
    auto& page = openTools(open, into);
    const std::string name = study.folder.filename().string();
    const std::pair<int, std::string> made[] = {{Qt::Key_P, "-sheets"},         {Qt::Key_B, "-backup.tar"},
                                                {Qt::Key_E, "-export"},         {Qt::Key_R, "-report"},
                                                {Qt::Key_D, "-data-sheet.txt"}, {Qt::Key_B, "-backup-2.tar"}};
    for (const auto& [key, ending] : made) {
        QTest::keyClick(open.window().focusWidget(), static_cast<Qt::Key>(key));
        QTRY_VERIFY(!page.isBusy());
        const fs::path file = into.toStdString() / fs::path(name + ending);
        QVERIFY2(fs::exists(file), qPrintable(page.findChild<QLabel*>("toolsMessage")->text()));
        QCOMPARE(page.findChild<QLabel*>("toolsMessage")->text(), "Written: " + QString::fromStdString(file.string()));
    }
    QCOMPARE(QDir(into).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot).size(), 6);
    std::vector<std::string> kinds;
    for (const auto& act : database::actsOf(study::records::openStudy(study.folder))) {
        kinds.push_back(act.kind);
        QCOMPARE(act.who, std::string("Mai"));
    }
    QCOMPARE(kinds, (std::vector<std::string>{"backup", "export", "report", "backup"}));
}

/// The operator must not see scores. The command line writes them: who calls it there holds the open key anyway.
void AppToolsTest::exportOfAnOpenKeyHoldsNoMeans()
{
    constexpr int people = 14;
    const auto study = newStudy({.conditions = {"v_grey", "h&f"}, .participants = people});
    for (int one = 1; one <= people; ++one)
        tests::support::OpenSession(study, (one < 10 ? "S0" : "S") + std::to_string(one)).playToEnd();
    const auto store = study::records::openStudy(study.folder);
    const fs::path command = filePath("by-command").toStdString();
    QCOMPARE(study::exports::writeExport(store, command, {.format = "csv"}, {}).whyNoMeans, std::string());
    QVERIFY(fs::exists(command / "conditions.csv"));
    const fs::path into = folderFor("by-window").toStdString();
    const auto done =
        study::commands::studyTools("Mai")(StudyTool::Export, study.folder, into, [](double, const std::string&) {});
    QVERIFY(fs::exists(done.made / "progress.csv"));
    QVERIFY(!fs::exists(done.made / "conditions.csv"));
}

void AppToolsTest::nothingIsWrittenIntoTheStudyOrAMissingFolder()
{
    const auto study = newStudy();
    OpenWindow open(study, options());
    for (const QString& into : {QString::fromStdString(study.folder.string()), filePath("nowhere"), QString()}) {
        auto& page = openTools(open, into);
        QTest::keyClick(open.window().focusWidget(), Qt::Key_B);
        QTRY_VERIFY(!page.isBusy());
        const auto* message = page.findChild<QLabel*>("toolsMessage");
        QCOMPARE(message->property("role").toString(), QString("fault"));
        QVERIFY2(message->text().contains("nothing was written"), qPrintable(message->text()));
        page.findChild<QLineEdit*>("toolsFolderField")->setText("elsewhere");
        QVERIFY2(message->text().isEmpty(), "the message goes when its field changes");
        QTest::keyClick(open.window().focusWidget(), Qt::Key_Escape);
    }
    QVERIFY(database::actsOf(study::records::openStudy(study.folder)).empty());
}

void AppToolsTest::faultIsShownAndLongWorkStops()
{
    AppOptions slow;
    slow.useTool = [](StudyTool, const fs::path&, const fs::path&, const ToolProgress& progress) -> ToolOutcome {
        for (;;) {
            progress(0.5, "analysing");
            QThread::msleep(2);
        }
    };
    OpenWindow open(newStudy(), slow);
    auto& page = openTools(open, filePath("."));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_R);
    const auto* message = page.findChild<QLabel*>("toolsMessage");
    QTRY_COMPARE(message->text(), QString("analysing: 50 %"));
    QVERIFY(!page.findChild<QPushButton*>("toolBackupButton")->isEnabled());
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Escape);
    QTRY_VERIFY(!page.isBusy());
    QCOMPARE(message->text(), QString("Stopped. Nothing was written."));
    QCOMPARE(open.window().currentPage()->objectName(), QString("toolsPage"));
}

void AppToolsTest::monitorOpensBesideThePage()
{
    OpenWindow open(newStudy(), options());
    openTools(open, filePath("."));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_M);
    const auto monitors = [] {
        int shown = 0;
        for (const QWidget* top : QApplication::topLevelWidgets())
            if (qobject_cast<const MonitorWindow*>(top) && top->isVisible()) ++shown;
        return shown;
    };
    QCOMPARE(monitors(), 1);
    open.window().close();
    QCOMPARE(monitors(), 0);
}

void AppToolsTest::windowWithoutToolsShowsNoButton()
{
    OpenWindow open(newStudy());
    QVERIFY(!open.window().findChild<QPushButton*>("toolsButton")->isVisible());
    open.gui().pressKey(Qt::Key_F2);
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
}

QTEST_MAIN(AppToolsTest)
#include "app_tools_test.moc"
