// Page to inspect a data set before a study is made, with real files and by keys only.
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <QTreeWidget>

#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "study/app/pages/data_page.h"
#include "study/looking/look_at_data.h"
#include "tests/rendering/fabric_files.h"
#include "tests/support/open_window.h"

using namespace study::app;
using tests::support::ShownWindow;

namespace {

AppOptions lookingOptions()
{
    AppOptions options;
    options.lookAtData = study::looking::lookAtData();
    return options;
}

/// Sends a key as the keyboard does, so that shortcuts are handled before the focused control.
void press(ShownWindow& shown, Qt::Key key)
{
    QTest::keyClick(shown.window.focusWidget() ? shown.window.focusWidget() : &shown.window, key);
}

}  // namespace

class AppDataTest : public tests::support::WindowTest {
    Q_OBJECT

    std::filesystem::path dataset()
    {
        const std::filesystem::path folder = filePath("fabrics").toStdString();
        if (!std::filesystem::exists(folder)) {
            rendering::fabrics::ProceduralOptions options;
            options.fabrics = 2;
            options.samples = 3;
            rendering::fabrics::makeProceduralFabrics(folder, options);
        }
        return folder;
    }
    DataPage& openPage(ShownWindow& shown, const std::filesystem::path& folder)
    {
        shown.gui.click("lookAtDataButton");
        shown.gui.type(QString::fromStdString(folder.string()));
        press(shown, Qt::Key_Return);
        return *qobject_cast<DataPage*>(shown.window.currentPage());
    }
    QString sampleIn(const DataPage& page) { return page.findChild<QLabel*>("sampleLabel")->text(); }
    QString sheetIn(const DataPage& page) { return page.findChild<QLabel*>("dataSheet")->accessibleName(); }
    QString messageOn(const DataPage& page) { return page.findChild<QLabel*>("dataMessage")->text(); }

private Q_SLOTS:
    void fabricsAndSamplesAreChosenByKeys();
    void sheetOfAFabricShowsItsSignals();
    void faultyFilesAreListed();
    void unreadableFileLeavesTheOthersVisible();
    void stimuliOfAnOpenStudyAreRefused();
    void pageShowsWhyAFolderIsNotADataSet();
    void leavingStopsTheCheck();
    void pageIsSavedAsPicture();
};

void AppDataTest::fabricsAndSamplesAreChosenByKeys()
{
    ShownWindow shown(lookingOptions());
    QVERIFY(QTest::qWaitForWindowActive(&shown.window));
    auto& page = openPage(shown, dataset());
    QTRY_VERIFY(!page.isBusy());
    QCOMPARE(page.findChild<QTreeWidget*>("dataFabrics")->topLevelItemCount(), 2);
    QCOMPARE(sampleIn(page), QString("F01, sample 1 of 3"));
    press(shown, Qt::Key_PageDown);
    QCOMPARE(sampleIn(page), QString("F01, sample 2 of 3"));
    for (int more = 0; more < 5; ++more) press(shown, Qt::Key_PageDown);
    QCOMPARE(sampleIn(page), QString("F01, sample 3 of 3"));
    QTRY_VERIFY(!page.isBusy() && sheetIn(page).contains("F01 visual 002.png"));
    press(shown, Qt::Key_Down);
    QCOMPARE(sampleIn(page), QString("F02, sample 1 of 3"));
    press(shown, Qt::Key_PageUp);
    QTRY_VERIFY(!page.isBusy() && sheetIn(page).contains("F02 visual 000.png"));
    const auto* scroll = page.findChild<QScrollArea*>("dataArea")->verticalScrollBar();
    const int before = scroll->value();
    QVERIFY(scroll->maximum() > 0);
    QTest::keyClick(shown.window.focusWidget(), Qt::Key_Down, Qt::ControlModifier);
    QVERIFY(scroll->value() > before);
    QCOMPARE(sampleIn(page), QString("F02, sample 1 of 3"));
    press(shown, Qt::Key_Escape);
    QCOMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
}

void AppDataTest::sheetOfAFabricShowsItsSignals()
{
    ShownWindow shown(lookingOptions());
    auto& page = openPage(shown, dataset());
    QTRY_VERIFY(!page.isBusy());
    for (const char* signal : {"F01 visual 000.png", "F01 tactile 000.png", "F01 height 000.tiff", "F01 friction 000.csv"})
        QVERIFY2(sheetIn(page).contains(signal), signal);
    QVERIFY(page.findChild<QLabel*>("dataAbout")->text().contains("mm per pixel"));
    const QPixmap sheet = page.findChild<QLabel*>("dataSheet")->pixmap();
    QVERIFY(sheet.width() > 600 && sheet.width() <= shown.window.width());
    std::set<QRgb> colours;
    const QImage drawn = sheet.toImage();
    for (int x = 0; x < drawn.width(); x += 5)
        for (int y = 0; y < drawn.height(); y += 5) colours.insert(drawn.pixel(x, y));
    QVERIFY(colours.size() > 200);
}

void AppDataTest::faultyFilesAreListed()
{
    const std::filesystem::path folder = filePath("faulty").toStdString();
    std::filesystem::copy(dataset(), folder, std::filesystem::copy_options::recursive);
    std::filesystem::remove(folder / "F02/tactile/001.png");
    std::filesystem::resize_file(folder / "F01/visual/001.png", 300);
    ShownWindow shown(lookingOptions());
    auto& page = openPage(shown, folder);
    QTRY_VERIFY(!page.isBusy());
    const QString listed = page.findChild<QPlainTextEdit*>("dataFaults")->toPlainText();
    QVERIFY2(listed.contains("F01/visual/001.png") && listed.contains("F02"), qPrintable(listed));
    QVERIFY(page.findChild<QLabel*>("dataChecked")->text().contains("Faults found in the files: 3"));
    // F01 has a truncated photograph. F02 has a height map, and a row of samples.csv, without their tactile frame.
    const auto* fabrics = page.findChild<QTreeWidget*>("dataFabrics");
    const int last = fabrics->columnCount() - 1;
    QCOMPARE(fabrics->topLevelItem(0)->text(last), QString("1"));
    QCOMPARE(fabrics->topLevelItem(1)->text(last), QString("1"));
}

void AppDataTest::unreadableFileLeavesTheOthersVisible()
{
    const std::filesystem::path folder = filePath("unreadable").toStdString();
    std::filesystem::copy(dataset(), folder, std::filesystem::copy_options::recursive);
    std::filesystem::resize_file(folder / "F01/visual/000.png", 300);
    ShownWindow shown(lookingOptions());
    auto& page = openPage(shown, folder);
    QTRY_VERIFY(!page.isBusy());
    QVERIFY2(messageOn(page).contains("000.png"), qPrintable(messageOn(page)));
    QVERIFY(sheetIn(page).contains("F01 tactile 000.png") && !sheetIn(page).contains("visual"));
}

void AppDataTest::stimuliOfAnOpenStudyAreRefused()
{
    const auto study = newStudy();
    ShownWindow shown(lookingOptions());
    auto& page = openPage(shown, study.folder);
    QTRY_VERIFY(!page.isBusy());
    QVERIFY2(messageOn(page).contains("not unblinded"), qPrintable(messageOn(page)));

    // A data set whose photographs are links to the stimuli shows none of them.
    const std::filesystem::path folder = filePath("disguised").toStdString();
    std::filesystem::copy(dataset(), folder, std::filesystem::copy_options::recursive);
    std::filesystem::remove(folder / "F01/visual/000.png");
    std::filesystem::create_symlink(std::filesystem::directory_iterator(study.stimuli())->path(), folder / "F01/visual/000.png");
    page.open(QString::fromStdString(folder.string()));
    QTRY_VERIFY(!page.isBusy());
    QVERIFY2(messageOn(page).contains("not unblinded"), qPrintable(messageOn(page)));
    QVERIFY(!sheetIn(page).contains("visual"));
}

void AppDataTest::pageShowsWhyAFolderIsNotADataSet()
{
    ShownWindow shown(lookingOptions());
    auto& page = openPage(shown, filePath("nothing-here").toStdString());
    QTRY_VERIFY(!page.isBusy());
    QVERIFY2(messageOn(page).contains("dataset.json"), qPrintable(messageOn(page)));
    QVERIFY(!page.findChild<QTreeWidget*>("dataFabrics")->isVisible());
    page.open("  ");
    QVERIFY(messageOn(page).contains("No folder is given"));
}

void AppDataTest::leavingStopsTheCheck()
{
    AppOptions options = lookingOptions();
    std::atomic<bool> isStopped = false;
    std::atomic<int> begun = 0;
    options.lookAtData.check = [&](const std::filesystem::path&, const std::function<void(double)>& progress) -> QStringList {
        ++begun;
        try {
            while (true) {
                progress(0.5);
                QThread::msleep(1);
            }
        } catch (...) {
            isStopped = true;
            throw;
        }
    };
    {
        ShownWindow shown(options);
        auto& page = openPage(shown, dataset());
        QTRY_VERIFY(page.findChild<QLabel*>("dataChecked")->text().contains("50 %"));
        page.open(QString::fromStdString(dataset().string()));
        QVERIFY(isStopped);
        isStopped = false;
        QTRY_COMPARE(begun.load(), 2);
    }
    QVERIFY(isStopped);
}

void AppDataTest::pageIsSavedAsPicture()
{
    const QString folder = qEnvironmentVariable("VIS2HAP_SCREENSHOTS");
    if (folder.isEmpty()) QSKIP("VIS2HAP_SCREENSHOTS names no folder, so no page is saved");
    const QFont font = QApplication::font();
    ShownWindow shown(lookingOptions());
    shown.window.resize(1300, 1150);
    auto& page = openPage(shown, dataset());
    for (const auto& [name, appearance] :
         {std::pair("light", Appearance{Theme::Light, 100}), std::pair("dark", Appearance{Theme::DarkRoom, 100}),
          std::pair("large", Appearance{Theme::Light, 200})}) {
        shown.window.setAppearance(appearance);
        QTest::qWait(400);
        QTRY_VERIFY(!page.isBusy());
        QVERIFY(shown.window.grab().save(QStringLiteral("%1/data-set-%2.png").arg(folder, QLatin1String(name))));
    }
    applyAppearance({}, font);
}

QTEST_MAIN(AppDataTest)
#include "app_data_test.moc"
