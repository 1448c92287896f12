// The page that makes a data set from photographs, with real files: by keys alone and by mouse alone.
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QScrollBar>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "rendering/fabrics/dataset_check.h"
#include "rendering/images/image_png.h"
#include "study/app/pages/photographs/photograph_ruler.h"
#include "tests/study/app/photographs_fixture.h"
#include "tests/support/program.h"

using namespace study::app;
using tests::chooseInDialog;
using tests::pathOf;
using tests::photographOptions;
using tests::PhotographsTest;
using tests::support::ShownWindow;
namespace fs = std::filesystem;

class AppPhotographsTest : public PhotographsTest {
    Q_OBJECT

private Q_SLOTS:
    void wholeWayByKeysAlone();
    void wholeWayByMouseAlone();
    void theProtocolMakesAStudy();
    void foldersAreFabrics();
    void rulerGivesTheScale();
    void pageIsSavedAsPicture();
};

void AppPhotographsTest::wholeWayByKeysAlone()
{
    const fs::path place = photographs("keys");
    ShownWindow shown(photographOptions());
    QVERIFY(QTest::qWaitForWindowActive(&shown.window));
    tabTo(shown, "photographsButton");
    press(shown, Qt::Key_Return);
    auto& page = *qobject_cast<PhotographsPage*>(shown.window.currentPage());
    QTest::keyClicks(shown.window.focusWidget(), QString::fromStdString(place.string()));
    press(shown, Qt::Key_Return);
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 30000);
    QCOMPARE(column(page, 0), QStringList({"felt", "linen", "satin"}));
    tabTo(shown, "photographs");
    press(shown, Qt::Key_Return);  // leads to the name
    QCOMPARE(shown.window.focusWidget()->objectName(), QString("fabricNameField"));
    QTest::keyClicks(shown.window.focusWidget(), "felt grey");
    press(shown, Qt::Key_Return);  // leads to the next fabric
    QTest::keyClicks(shown.window.focusWidget(), "Leinen");
    QCOMPARE(column(page, 0), QStringList({"felt grey", "Leinen", "satin"}));
    tabTo(shown, "pixelWidthField");
    QTest::keyClicks(shown.window.focusWidget(), "0,05");
    QVERIFY(!page.findChild<QLabel*>("scaleResult")->text().contains("not known"));
    tabTo(shown, "checkPhotographsButton");
    press(shown, Qt::Key_Return);
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    QVERIFY2(!message(page, "photographCheckMessage").isEmpty(), "the check says nothing");
    tabTo(shown, "newDatasetField");
    QCOMPARE(page.findChild<QLineEdit*>("newDatasetField")->text(), QString::fromStdString(place.string() + "-fabrics"));
    press(shown, Qt::Key_Return);
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    const fs::path folder = place.string() + "-fabrics";
    const auto dataset = rendering::fabrics::readDataset(folder);
    QCOMPARE(dataset.cameraMmPerPixel, std::optional(0.05));
    QCOMPARE(dataset.fabrics.size(), std::size_t(3));
    QCOMPARE(dataset.fabrics[0].name, std::string("felt grey"));
    QCOMPARE(dataset.fabrics[1].name, std::string("Leinen"));
    QVERIFY(rendering::fabrics::faultsOfDataset(folder).empty());
    // The pixels of a lossless photograph are kept.
    const cv::Mat before = rendering::readPng(place / "linen.png");
    const cv::Mat after = rendering::fabrics::readPhotograph(dataset, dataset.fabrics[1].id, 0);
    QVERIFY(before.size() == after.size() && cv::norm(before, after, cv::NORM_INF) == 0);
    tabTo(shown, "photographsToStudyButton");
    press(shown, Qt::Key_Return);
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("newStudyPage"));
    QCOMPARE(shown.window.currentPage()->findChild<QLineEdit*>("datasetField")->text(), QString::fromStdString(folder.string()));
    const QString protocol = shown.window.currentPage()->findChild<QLineEdit*>("protocolField")->text();
    QCOMPARE(protocol, QString::fromStdString(folder.string() + "-protocol.json"));
    const auto planned = protocols::readProtocol(pathOf(protocol));
    QCOMPARE(planned.conditions, std::vector<protocols::ConditionId>{protocols::ConditionId("h_g&f_g")});
}

void AppPhotographsTest::wholeWayByMouseAlone()
{
    const fs::path place = photographs("mouse");
    ShownWindow shown(photographOptions());
    auto& page = openPage(shown);
    chooseInDialog(QString::fromStdString(place.string()));
    shown.gui.click("browsePhotographFolderButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy() && column(page, 0).size() == 3, 30000);
    auto& ruler = *page.findChild<PhotographRuler*>("photographRuler");
    QTRY_VERIFY(ruler.sizePx().width() > 0);
    const QSize size = ruler.sizePx();
    shown.gui.clickAt(ruler, ruler.placeOf({0.1 * size.width(), 0.5 * size.height()}));
    shown.gui.clickAt(ruler, ruler.placeOf({0.9 * size.width(), 0.5 * size.height()}));
    const double pitch = page.findChild<QLineEdit*>("pixelWidthField")->text().toDouble();
    QVERIFY2(std::abs(pitch - 10 / (0.8 * size.width())) < 0.02 * pitch, qPrintable(QString::number(pitch)));  // 10 mm by default
    shown.gui.click("checkPhotographsButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    shown.gui.click("writeDatasetButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    QVERIFY(fs::exists(place.string() + "-fabrics/dataset.json"));
    QVERIFY(!shown.widget<QLabel>("frictionImages").isVisible());
    shown.gui.click("conditionButton1");  // the grey photograph beside the generated signals
    shown.gui.click("drawFrictionImagesButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 120000);
    QVERIFY2(message(page, "frictionImagesMessage").isEmpty(), qPrintable(message(page, "frictionImagesMessage")));
    const QImage drawn = shown.widget<QLabel>("frictionImages").pixmap().toImage();
    std::set<QRgb> colours;
    for (int x = 0; x < drawn.width(); x += 5)
        for (int y = 0; y < drawn.height(); y += 5) colours.insert(drawn.pixel(x, y));
    QVERIFY(drawn.height() > 200 && colours.size() > 100);
    // A smaller window needs no scrolling sideways.
    shown.window.resize(800, 600);
    QTRY_COMPARE(page.findChild<QScrollArea*>("photographsArea")->horizontalScrollBar()->maximum(), 0);
    shown.gui.click("photographsToStudyButton");
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("newStudyPage"));
}

void AppPhotographsTest::theProtocolMakesAStudy()
{
    const fs::path place = photographs("planned"), set = pathOf(filePath("study-set"));
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, place);
    QVERIFY(writesDataset(shown, page, set));
    shown.gui.click("conditionButton5");
    shown.gui.click("photographsToStudyButton");
    QVERIFY(message(page, "frictionImagesMessage").contains("No condition is chosen"));
    for (int number = 1; number <= 5; ++number) shown.gui.click(QStringLiteral("conditionButton%1").arg(number));
    const fs::path other = set.string() + "-protocol.json";
    std::ofstream(other) << "mine";
    shown.gui.click("photographsToStudyButton");
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("newStudyPage"));
    const QString protocol = shown.window.currentPage()->findChild<QLineEdit*>("protocolField")->text();
    QCOMPARE(protocol, QString::fromStdString(set.string() + "-protocol-2.json"));
    QCOMPARE(fs::file_size(other), std::uintmax_t(4));  // a file that is there stays
    support::mustRun({"study", "new", filePath("study"), "--dataset", QString::fromStdString(set.string()), "--protocol",
                      protocol, "--participants", "2", "--no-passphrase"});
    support::mustRun({"verify", filePath("study")});

    // Two fabrics are too few for three alternatives; the page says so and stays.
    shown.gui.pressKey(Qt::Key_Escape);
    shown.gui.click("photographsButton");
    shown.gui.click("removePhotographButton");
    QVERIFY(writesDataset(shown, page, pathOf(filePath("two"))));
    shown.gui.click("photographsToStudyButton");
    QTRY_VERIFY(!page.isBusy());
    QVERIFY2(message(page, "photographsStudyMessage").contains("expected 3 or more"),
             qPrintable(message(page, "photographsStudyMessage")));
    QCOMPARE(shown.window.currentPage()->objectName(), QString("photographsPage"));
    QVERIFY(!fs::exists(filePath("two-protocol.json").toStdString()));
}

void AppPhotographsTest::foldersAreFabrics()
{
    const fs::path place = photographs("sorted");
    for (const char* name : {"linen", "satin"}) {
        fs::create_directories(place / "by-fabric" / name);
        fs::copy_file(place / (std::string(name) + ".png"), place / "by-fabric" / name / "1.png");
        fs::copy_file(place / (std::string(name) + ".png"), place / "by-fabric" / name / "2.png");
    }
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, place / "by-fabric");
    // As files, "1" and "2" exist twice, and the page says so at once.
    QVERIFY2(message(page, "fabricNameMessage").contains("Two fabrics have the name \"1\""),
             qPrintable(message(page, "fabricNameMessage")));
    shown.gui.click("byFolderButton");
    QCOMPARE(message(page, "fabricNameMessage"), QString());
    QCOMPARE(column(page, 0), QStringList({"linen", "linen", "satin", "satin"}));
    QVERIFY(page.findChild<QLabel*>("photographCount")->text().startsWith("4 photographs, 2 fabrics"));
    QVERIFY(writesDataset(shown, page, pathOf(filePath("sorted-set"))));
    const auto dataset = rendering::fabrics::readDataset(pathOf(filePath("sorted-set")));
    QCOMPARE(sampleIndices(dataset, dataset.fabrics[1].id, rendering::fabrics::Modality::Visual), (std::vector<int>{0, 1}));
    QVERIFY(!dataset.cameraMmPerPixel);
}

void AppPhotographsTest::rulerGivesTheScale()
{
    ShownWindow shown(photographOptions());
    auto& page = openWith(shown, photographs("ruler"));
    auto& ruler = *page.findChild<PhotographRuler*>("photographRuler");
    auto& scale = *page.findChild<QLineEdit*>("pixelWidthField");
    QTRY_VERIFY(ruler.sizePx().width() > 0);
    // By keys: two points that lie ten steps of 2 % of the width apart.
    shown.gui.focusOn("photographRuler");
    for (int step = 0; step < 5; ++step) press(shown, Qt::Key_Left);
    press(shown, Qt::Key_Space);
    QVERIFY(scale.text().isEmpty());
    press(shown, Qt::Key_Space);
    QVERIFY2(message(page, "scaleMessage").contains("same place"), qPrintable(message(page, "scaleMessage")));
    press(shown, Qt::Key_Space);
    for (int step = 0; step < 10; ++step) press(shown, Qt::Key_Right);
    press(shown, Qt::Key_Space);
    const double lengthPx = 0.2 * ruler.sizePx().width();
    QVERIFY(std::abs(*ruler.lengthPx() - lengthPx) < 1e-6);
    QVERIFY(message(page, "scaleMessage").isEmpty());
    QVERIFY(std::abs(scale.text().toDouble() - 10 / lengthPx) < 1e-3 * scale.text().toDouble());
    enter(shown, "rulerDistanceField", "5");
    QVERIFY(std::abs(scale.text().toDouble() - 5 / lengthPx) < 1e-3 * scale.text().toDouble());
    // The width of the photograph counts when it is typed later.
    enter(shown, "photographWidthField", "12.8");
    QVERIFY(std::abs(scale.text().toDouble() - 12.8 / ruler.sizePx().width()) < 1e-3 * scale.text().toDouble());
}

void AppPhotographsTest::pageIsSavedAsPicture()
{
    const QString folder = qEnvironmentVariable("VIS2HAP_SCREENSHOTS");
    if (folder.isEmpty()) QSKIP("VIS2HAP_SCREENSHOTS names no folder, so no page is saved");
    ShownWindow shown(photographOptions());
    shown.window.resize(1400, 3000);
    auto& page = openWith(shown, photographs("pictures"));
    auto& ruler = *page.findChild<PhotographRuler*>("photographRuler");
    QTRY_VERIFY(ruler.sizePx().width() > 0);
    for (const double x : {0.2, 0.8})
        shown.gui.clickAt(ruler, ruler.placeOf({x * ruler.sizePx().width(), 0.6 * ruler.sizePx().height()}));
    shown.gui.click("checkPhotographsButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 60000);
    QVERIFY(writesDataset(shown, page, pathOf(filePath("pictures-set"))));
    shown.gui.click("conditionButton3");
    shown.gui.click("conditionButton4");
    shown.gui.click("drawFrictionImagesButton");
    QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 120000);
    QTest::qWait(200);
    QVERIFY(shown.window.grab().save(folder + "/photographs-real.png"));
}

QTEST_MAIN(AppPhotographsTest)
#include "app_photographs_test.moc"
