// The page that makes a data set from photographs, with real files: by keys alone, by mouse alone, and with every bad input.
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>
#include <QTimer>
#include <QTreeWidget>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/protocol_json.h"
#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/images/image_png.h"
#include "study/app/pages/photographs/photograph_ruler.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/photographs/photograph_steps.h"
#include "tests/support/open_window.h"
#include "tests/support/program.h"

using namespace study::app;
using tests::support::ShownWindow;
namespace fs = std::filesystem;

namespace {

AppOptions photographOptions()
{
    AppOptions options;
    options.photographs = study::photographs::photographSteps();
    options.makeStudy = [](const NewStudyRequest&, const MakingProgress&) {};
    return options;
}

fs::path pathOf(const QString& text) { return text.toStdString(); }

/// Chooses in the dialog that opens next, as a click on its button does.
void chooseInDialog(const QString& path)
{
    QTimer::singleShot(0, [path] {
        QFileDialog* dialog = nullptr;
        QTRY_VERIFY((dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget())) != nullptr);
        dialog->findChild<QLineEdit*>("fileNameEdit")->setText(path);
        QPushButton* accept = nullptr;
        for (const auto role : {QDialogButtonBox::Open, QDialogButtonBox::Save})
            if (!accept) accept = dialog->findChild<QDialogButtonBox*>()->button(role);
        QTest::mouseClick(accept, Qt::LeftButton);
    });
}

}  // namespace

class AppPhotographsTest : public tests::support::WindowTest {
    Q_OBJECT

    /// Photographs of three procedural fabrics: linen.png, satin.png (a lighter crop), felt.jpg.
    fs::path photographs(const char* folder)
    {
        const fs::path made = pathOf(filePath("procedural")), place = pathOf(filePath(QString::fromLatin1(folder)));
        if (!fs::exists(made)) {
            rendering::fabrics::ProceduralOptions options;
            options.fabrics = 3;
            options.samples = 2;
            rendering::fabrics::makeProceduralFabrics(made, options);
        }
        fs::create_directories(place);
        fs::copy_file(made / "F01/visual/000.png", place / "linen.png");
        fs::copy_file(made / "F02/visual/000.png", place / "satin.png");
        QImage(QString::fromStdString((made / "F03/visual/000.png").string()))
            .save(QString::fromStdString((place / "felt.jpg").string()), "JPG", 95);
        return place;
    }
    PhotographsPage& openPage(ShownWindow& shown)
    {
        shown.gui.click("photographsButton");
        return *qobject_cast<PhotographsPage*>(shown.window.currentPage());
    }
    PhotographsPage& openWith(ShownWindow& shown, const fs::path& place)
    {
        auto& page = openPage(shown);
        addTo(page, place);
        return page;
    }
    void addTo(PhotographsPage& page, const fs::path& place)
    {
        page.add(QString::fromStdString(place.string()));
        QTRY_VERIFY_WITH_TIMEOUT(!page.isBusy(), 30000);
    }
    static QString message(const PhotographsPage& page, const char* name)
    {
        const auto* bar = page.findChild<QLabel*>(QLatin1String(name));
        return bar->isVisible() ? bar->text() : QString();
    }
    static QStringList column(const PhotographsPage& page, int number)
    {
        QStringList texts;
        const auto* list = page.findChild<QTreeWidget*>("photographs");
        for (int row = 0; row < list->topLevelItemCount(); ++row) texts << list->topLevelItem(row)->text(number);
        return texts;
    }
    /// Types into a field of the page as the operator does.
    static void enter(ShownWindow& shown, const char* name, const QString& text)
    {
        shown.gui.focusOn(QString::fromLatin1(name));
        shown.gui.clear();
        shown.gui.type(text);
    }
    /// Moves the focus by the Tab key.
    static void tabTo(ShownWindow& shown, const char* name)
    {
        for (int press = 0; press < 80; ++press) {
            if (shown.window.focusWidget() && shown.window.focusWidget()->objectName() == QLatin1String(name)) return;
            QTest::keyClick(shown.window.focusWidget() ? shown.window.focusWidget() : &shown.window, Qt::Key_Tab);
        }
        QFAIL(qPrintable(QStringLiteral("Tab does not lead to %1").arg(QLatin1String(name))));
    }
    static void press(ShownWindow& shown, Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QTest::keyClick(shown.window.focusWidget(), key, modifiers);
    }
    bool writesDataset(ShownWindow& shown, PhotographsPage& page, const fs::path& folder)
    {
        enter(shown, "newDatasetField", QString::fromStdString(folder.string()));
        shown.gui.click("writeDatasetButton");
        return QTest::qWaitFor([&] { return !page.isBusy(); }, 30000) && fs::exists(folder / "dataset.json");
    }

private Q_SLOTS:
    void wholeWayByKeysAlone();
    void wholeWayByMouseAlone();
    void theProtocolMakesAStudy();
    void foldersAreFabrics();
    void badFilesAreNamedAndTheOthersStay();
    void badNamesAreRefused_data();
    void badNamesAreRefused();
    void badScalesAreRefused_data();
    void badScalesAreRefused();
    void rulerGivesTheScale();
    void existingFolderIsRefusedAndNothingIsLost();
    void fullDiskLeavesNothing();
    void stoppedWorkLeavesNothing();
    void warningsAreThoseOfRender();
    void aScaleThatMakesTheWeaveTooFineIsNamed();
    void filesOfAnOpenStudyAreRefused();
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

void AppPhotographsTest::badFilesAreNamedAndTheOthersStay()
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

void AppPhotographsTest::badNamesAreRefused_data()
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

void AppPhotographsTest::badNamesAreRefused()
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

void AppPhotographsTest::badScalesAreRefused_data()
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

void AppPhotographsTest::badScalesAreRefused()
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

void AppPhotographsTest::existingFolderIsRefusedAndNothingIsLost()
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

void AppPhotographsTest::fullDiskLeavesNothing()
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

void AppPhotographsTest::stoppedWorkLeavesNothing()
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

void AppPhotographsTest::warningsAreThoseOfRender()
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

void AppPhotographsTest::aScaleThatMakesTheWeaveTooFineIsNamed()
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

void AppPhotographsTest::filesOfAnOpenStudyAreRefused()
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
