// The page that makes a data set from photographs, with every bad input and every fault of a step.
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QThread>
#include <atomic>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset_check.h"
#include "rendering/images/image_png.h"
#include "study/app/pages/photographs/step_work.h"
#include "study/app/pieces/pieces.h"
#include "tests/study/app/photographs_fixture.h"
#include "tests/support/program.h"

using namespace study::app;
using tests::chooseInDialog;
using tests::pathOf;
using tests::photographOptions;
using tests::PhotographsTest;
using tests::support::ShownWindow;
namespace fs = std::filesystem;

class AppPhotographFaultsTest : public PhotographsTest {
    Q_OBJECT

private Q_SLOTS:
    void badFilesAreNamedAndTheOthersStay();
    void badNamesAreRefused_data();
    void badNamesAreRefused();
    void badScalesAreRefused_data();
    void badScalesAreRefused();
    void existingFolderIsRefusedAndNothingIsLost();
    void fullDiskLeavesNothing();
    void stoppedWorkLeavesNothing();
    void warningsAreThoseOfRender();
    void aScaleThatMakesTheWeaveTooFineIsNamed();
    void filesOfAnOpenStudyAreRefused();
    void aControlThatVanishesDuringAStepIsNotMissed();
};

void AppPhotographFaultsTest::badFilesAreNamedAndTheOthersStay()
{
    const fs::path place = photographs("bad");
    std::ofstream(place / "notes.png") << "These are notes.";
    std::ofstream(place / "nothing.jpg").flush();
    fs::copy_file(place / "linen.png", place / "half.png");
    fs::resize_file(place / "half.png", fs::file_size(place / "half.png") / 2);
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, place);
    QCOMPARE(column(page, 1), QStringList({"felt.jpg", "linen.png", "satin.png"}));
    const QString said = message(page, "photographsMessage");
    for (const char* file : {"notes.png", "nothing.jpg", "half.png"}) QCOMPARE(said.count(QLatin1String(file)), 1);
    QCOMPARE(said.count(QLatin1Char('\n')), 2);
    QVERIFY2(said.contains("0 bytes"), qPrintable(said));

    std::ofstream(place / "words.txt") << "words";
    fs::create_directories(place / "empty");
    for (const auto& [typed, part] : {std::pair<fs::path, QString>(place / "words.txt", "file ending"),
                                      {place / "missing.png", "does not exist"},
                                      {place / "empty", "holds no file to import"}}) {
        addTo(page, typed);
        QVERIFY2(message(page, "photographsMessage").contains(part), qPrintable(message(page, "photographsMessage")));
        QCOMPARE(column(page, 0).size(), 3);
    }
    page.add("  ");
    QVERIFY(message(page, "photographsMessage").contains("No photograph is given"));
    // A file that is altered afterwards is found when the data set is written; nothing is half-made.
    fs::resize_file(place / "satin.png", 0);
    QVERIFY(!writesDataset(shown, page, pathOf(filePath("bad-set"))));
    QVERIFY2(message(page, "newDatasetMessage").contains("satin.png"), qPrintable(message(page, "newDatasetMessage")));
    QVERIFY(!fs::exists(pathOf(filePath("bad-set"))));
    QCOMPARE(column(page, 0).size(), 3);
}

void AppPhotographFaultsTest::badNamesAreRefused_data()
{
    QTest::addColumn<QString>("typed");
    QTest::addColumn<QString>("why");
    QTest::newRow("the name of another") << "satin"
                                         << "Two fabrics have the name \"satin\"";
    QTest::newRow("none") << " "
                          << "has no name";
    QTest::newRow("a dot first") << ".linen"
                                 << "dot";
    QTest::newRow("a path") << "../linen"
                            << "A name has";
    QTest::newRow("a list") << "linen,satin"
                            << "A name has";
    QTest::newRow("too long") << QString(65, 'n') << "A name has";
}

void AppPhotographFaultsTest::badNamesAreRefused()
{
    QFETCH(QString, typed);
    QFETCH(QString, why);
    const fs::path place = photographs(QTest::currentDataTag());
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, place);
    auto* list = page.findChild<QTreeWidget*>("photographs");
    list->setCurrentItem(list->topLevelItem(1));
    enter(shown, "fabricNameField", typed);
    QVERIFY2(message(page, "fabricNameMessage").contains(why), qPrintable(message(page, "fabricNameMessage")));
    list->setCurrentItem(list->topLevelItem(0));
    // The check and the data set lead back to the name.
    const fs::path folder = pathOf(filePath(QString("names %1").arg(QTest::currentDataTag())));
    QVERIFY(!writesDataset(shown, page, folder));
    QVERIFY(!fs::exists(folder));
    QVERIFY(message(page, "fabricNameMessage").contains(why));
    QCOMPARE(shown.window.focusWidget()->objectName(), QString("fabricNameField"));
    enter(shown, "fabricNameField", "another name");
    QCOMPARE(message(page, "fabricNameMessage"), QString());
    QVERIFY(writesDataset(shown, page, folder));
}

void AppPhotographFaultsTest::badScalesAreRefused_data()
{
    QTest::addColumn<QString>("field");
    QTest::addColumn<QString>("typed");
    QTest::addColumn<QString>("why");
    QTest::newRow("zero") << "pixelWidthField"
                          << "0"
                          << "not larger than 0";
    QTest::newRow("negative") << "pixelWidthField"
                              << "-0.05"
                              << "not larger than 0";
    QTest::newRow("words") << "pixelWidthField"
                           << "about 1"
                           << "not a number";
    QTest::newRow("not finite") << "pixelWidthField"
                                << "inf"
                                << "not a number";
    QTest::newRow("too fine") << "pixelWidthField"
                              << "0.00001"
                              << "expected 0.0005 to 1 mm";
    QTest::newRow("too coarse") << "pixelWidthField"
                                << "50"
                                << "expected 0.0005 to 1 mm";
    QTest::newRow("no width") << "photographWidthField"
                              << "0"
                              << "not larger than 0";
    QTest::newRow("width in metres") << "photographWidthField"
                                     << "0.03"
                                     << "expected 0.0005 to 1 mm";
}

void AppPhotographFaultsTest::badScalesAreRefused()
{
    QFETCH(QString, field);
    QFETCH(QString, typed);
    QFETCH(QString, why);
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, photographs(QTest::currentDataTag()));
    enter(shown, qPrintable(field), typed);
    QVERIFY2(message(page, "scaleMessage").contains(why), qPrintable(message(page, "scaleMessage")));
    const fs::path folder = pathOf(filePath(QString("scale %1").arg(QTest::currentDataTag())));
    QVERIFY(!writesDataset(shown, page, folder));
    QVERIFY(!fs::exists(folder));
    QCOMPARE(shown.window.focusWidget()->objectName(), field);
    const auto* bar = page.findChild<QLabel*>("scaleMessage");
    const auto* at = page.findChild<QLineEdit*>(field);
    const int below = bar->mapTo(&page, QPoint()).y() - at->mapTo(&page, QPoint(0, at->height())).y();
    QVERIFY2(below >= 0 && below < 2 * at->height(), qPrintable(QString::number(below)));
    enter(shown, "pixelWidthField", "0.05");
    QCOMPARE(message(page, "scaleMessage"), QString());
    QVERIFY(writesDataset(shown, page, folder));
    QCOMPARE(rendering::fabrics::readDataset(folder).cameraMmPerPixel, std::optional(0.05));
}

void AppPhotographFaultsTest::existingFolderIsRefusedAndNothingIsLost()
{
    const fs::path place = photographs("there"), taken = pathOf(filePath("taken"));
    fs::create_directories(taken);
    std::ofstream(taken / "mine.txt") << "mine";
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, place);
    QVERIFY(!writesDataset(shown, page, taken));
    QVERIFY2(message(page, "newDatasetMessage").contains("exists already"), qPrintable(message(page, "newDatasetMessage")));
    QCOMPARE(std::distance(fs::directory_iterator(taken), {}), 1);
    QVERIFY(!writesDataset(shown, page, taken / "mine.txt" / "set"));
    QVERIFY(!message(page, "newDatasetMessage").isEmpty());
    shown.gui.focusOn("newDatasetField");
    shown.gui.clear();
    shown.gui.click("writeDatasetButton");
    QVERIFY(message(page, "newDatasetMessage").contains("No folder is given"));
    QVERIFY(!page.findChild<QPushButton*>("photographsToStudyButton")->isEnabled());
    QVERIFY(writesDataset(shown, page, pathOf(filePath("free"))));
    // The same photographs under another name need another folder; the first one stays.
    enter(shown, "fabricNameField", "cotton");
    QVERIFY(!page.findChild<QPushButton*>("photographsToStudyButton")->isEnabled());
    QVERIFY(fs::exists(pathOf(filePath("free")) / "dataset.json"));
    shown.gui.pressKey(Qt::Key_Escape);
    QCOMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
    shown.gui.click("photographsButton");
    QCOMPARE(column(page, 0).size(), 3);  // going back loses nothing
}

void AppPhotographFaultsTest::fullDiskLeavesNothing()
{
    const QString small = filePath("small");
    fs::create_directories(pathOf(small));
    if (QProcess::execute("mount", {"-t", "tmpfs", "-o", "size=96k", "tmpfs", small}) != 0)
        QSKIP("no right to mount a small file system: the full disk was not tried");
    {
        ShownWindow shown(photographOptions());
        auto& page = openWith(shown, photographs("full"));
        QVERIFY(!writesDataset(shown, page, pathOf(small) / "set"));
        QVERIFY2(message(page, "newDatasetMessage").contains("No space left", Qt::CaseInsensitive),
                 qPrintable(message(page, "newDatasetMessage")));
        QVERIFY(fs::is_empty(pathOf(small)));
        QVERIFY(writesDataset(shown, page, pathOf(filePath("roomy"))));
    }
    QCOMPARE(QProcess::execute("umount", {small}), 0);
}

void AppPhotographFaultsTest::stoppedWorkLeavesNothing()
{
    AppOptions options = photographOptions();
    std::atomic<bool> isWriting = false;
    // The real writer, which takes its time at its last photograph.
    options.photographs.write = [&isWriting, write = options.photographs.write](const PhotographSet& set, const fs::path& folder,
                                                                                const ToolProgress& progress) {
        write(set, folder, [&](double fraction, const std::string& what) {
            while (fraction > 0.5) {
                isWriting = true;
                progress(fraction, what);
                QThread::msleep(1);
            }
        });
    };
    const fs::path place = photographs("stopped"), folder = pathOf(filePath("stopped-set"));
    ShownWindow shown(options);
    auto& page = openWith(shown, place);
    enter(shown, "newDatasetField", QString::fromStdString(folder.string()));
    shown.gui.click("writeDatasetButton");
    QTRY_VERIFY(isWriting);
    press(shown, Qt::Key_Escape);
    QTRY_VERIFY(!page.isBusy());
    QVERIFY(message(page, "newDatasetMessage").contains("Nothing was written"));
    QVERIFY(!fs::exists(folder));
    for (const auto& entry : fs::directory_iterator(folder.parent_path()))
        QVERIFY2(entry.path().string().find("unfinished") == std::string::npos, entry.path().c_str());
    QCOMPARE(column(page, 0).size(), 3);
}

void AppPhotographFaultsTest::warningsAreThoseOfRender()
{
    // Names equal to the ids that the data set gives, so that the lines can be compared.
    const fs::path place = photographs("strange"), renamed = pathOf(filePath("strange-photos"));
    fs::create_directories(renamed);
    fs::copy_file(place / "linen.png", renamed / "F01.png");
    cv::Mat dots(300, 400, CV_8UC3), patches = rendering::readPng(place / "satin.png");
    cv::randu(dots, 0, 255);
    rendering::writePng(renamed / "F02.png", dots);
    for (int row = 0; row < patches.rows; row += 40)  // dyed stripes
        patches.rowRange(row, std::min(row + 20, patches.rows)) = cv::Scalar(220, 20, 20);
    rendering::writePng(renamed / "F03.png", patches);
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, renamed);
    enter(shown, "pixelWidthField", "0.05");
    shown.gui.click("checkPhotographsButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    const QStringList shownLines = page.findChild<QPlainTextEdit*>("photographWarnings")->toPlainText().split('\n');
    const fs::path set = pathOf(filePath("strange-set"));
    QVERIFY(writesDataset(shown, page, set));
    const auto rendered = support::mustRun(
        {"render", QString::fromStdString(set.string()), "--condition", "v_shape,h_g", "--out", filePath("strange-images")});
    QStringList printed;
    for (const QString& line : rendered.err.split('\n'))
        if (line.startsWith("warning: ")) printed << line.mid(9);
    QVERIFY2(printed.filter("varies in colour").size() >= 1, qPrintable(rendered.err));
    for (const QString& line : printed)
        QVERIFY2(shownLines.contains(line), qPrintable(line + " not in:\n" + shownLines.join('\n')));
    QVERIFY2(shownLines.size() <= printed.size() + 3, qPrintable(shownLines.join('\n')));
    QVERIFY(column(page, 3).at(1).contains("warning"));
}

void AppPhotographFaultsTest::aScaleThatMakesTheWeaveTooFineIsNamed()
{
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, photographs("fine"));
    enter(shown, "pixelWidthField", "0.005");
    shown.gui.click("checkPhotographsButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    const QString lines = page.findChild<QPlainTextEdit*>("photographWarnings")->toPlainText();
    QVERIFY2(lines.contains("finer than cloth is (0.15 mm); check the scale"), qPrintable(lines));
    enter(shown, "pixelWidthField", "0.05");
    shown.gui.click("checkPhotographsButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    QVERIFY(!page.findChild<QPlainTextEdit*>("photographWarnings")->toPlainText().contains("check the scale"));
}

void AppPhotographFaultsTest::filesOfAnOpenStudyAreRefused()
{
    const auto study = newStudy();
    const fs::path place = photographs("hidden");
    fs::copy_file(place / "linen.png", study.folder / "linen.png");
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, study.folder / "linen.png");
    QVERIFY2(message(page, "photographsMessage").contains("not unblinded"), qPrintable(message(page, "photographsMessage")));
    QVERIFY(column(page, 0).isEmpty());
    addTo(page, place);
    QVERIFY(!writesDataset(shown, page, study.folder / "set"));
    QVERIFY(message(page, "newDatasetMessage").contains("not unblinded"));
}

void AppPhotographFaultsTest::aControlThatVanishesDuringAStepIsNotMissed()
{
    QWidget page;
    page.setFocusPolicy(Qt::StrongFocus);
    MessageBar message("stepMessage", &page);
    auto* line = new QLineEdit(&page);
    page.show();
    QVERIFY(QTest::qWaitForWindowActive(&page));
    line->setFocus();
    StepWork work(page);
    std::atomic<bool> mayEnd = false;
    work.run(message, "working", [&](const ToolProgress&) -> InBackground::Then {
        while (!mayEnd) QThread::msleep(1);
        throw std::runtime_error("the step failed");
    });
    delete line;
    const std::vector<char> inItsPlace(sizeof(QLineEdit), 'x');  // the memory is used again
    mayEnd = true;
    QTRY_VERIFY2(message.text().contains("the step failed"), qPrintable(message.text()));
    QVERIFY(!work.isBusy());
}

QTEST_MAIN(AppPhotographFaultsTest)
#include "app_photograph_faults_test.moc"
