// Appearance of every page: names for screen readers, themes, text sizes. With VIS2HAP_SCREENSHOTS=FOLDER the test saves
// every page in this folder as PNG: light, dark, and with text at 200 %.
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QScrollBar>
#include <QTest>

#include "study/app/pages/data_page.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/appearance.h"
#include "tests/support/open_window.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using protocols::Tenths;
using tests::support::OpenWindow;

namespace {

bool isControl(const QWidget& widget)
{
    return qobject_cast<const QAbstractButton*>(&widget) || qobject_cast<const QLineEdit*>(&widget) ||
           qobject_cast<const QComboBox*>(&widget) || qobject_cast<const QPlainTextEdit*>(&widget) ||
           qobject_cast<const ScaleLine*>(&widget) ||
           (qobject_cast<const QAbstractItemView*>(&widget) && widget.focusPolicy() != Qt::NoFocus);
}

QStringList namelessControlsIn(const QWidget& root)
{
    QStringList nameless;
    for (const QWidget* widget : root.findChildren<QWidget*>())
        if (isControl(*widget) && (widget->accessibleName().trimmed().isEmpty() || widget->objectName().isEmpty()))
            nameless << QString::fromLatin1(widget->metaObject()->className()) + " " + widget->objectName();
    return nameless;
}

/// A data set with one faulty file and a blank sheet.
LookAtData someData()
{
    LookAtData look;
    look.open = [](const std::filesystem::path&) {
        return DataOverview{"Fifteen fabrics",
                            "signals of different places; photographs 0.05 mm per pixel; CC0-1.0",
                            {{"F01", "Linen", "plain weave", 225, 225, 225, 225, 225}, {"F02", "Felt", "", 3, 0, 0, 2, 3}}};
    };
    look.draw = [](const DataSheetRequest& request) {
        QImage sheet(request.widthPx, 500, QImage::Format_RGB32);
        sheet.fill(Qt::gray);
        return DataSheet{sheet, "F01 visual 000.png: min 79, max 243", {}};
    };
    look.check = [](const std::filesystem::path&, const std::function<void(double)>&) {
        return QStringList{"fabrics/F02/visual/001.png: is truncated"};
    };
    return look;
}

/// Buttons and labels that are too small for their text.
QStringList cutTextsIn(const QWidget& page)
{
    QStringList cut;
    for (const QWidget* widget : page.findChildren<QWidget*>()) {
        if (!widget->isVisible()) continue;
        const auto* label = qobject_cast<const QLabel*>(widget);
        const bool isButton = qobject_cast<const QAbstractButton*>(widget);
        const bool isTooLow = label && label->wordWrap() && label->height() < label->heightForWidth(label->width());
        const bool isOneLine = isButton || (label && !label->wordWrap());
        const bool isTooSmall = isOneLine && widget->width() < widget->minimumSizeHint().width();
        const bool isOutside = (isButton || label) && !widget->parentWidget()->rect().contains(widget->geometry());
        if (isTooLow || isTooSmall || isOutside)
            cut << QStringLiteral("%1 (%2x%3, wants %4x%5)")
                       .arg(widget->objectName())
                       .arg(widget->width())
                       .arg(widget->height())
                       .arg(widget->minimumSizeHint().width())
                       .arg(widget->heightForWidth(widget->width()));
    }
    return cut;
}

/// Areas with content that is wider than themselves and would need sideways scrolling.
QStringList wideAreasIn(const QWidget& page)
{
    QStringList wide;
    for (const auto* area : page.findChildren<QAbstractScrollArea*>())
        if (area->isVisible() && area->horizontalScrollBar()->maximum() > 0)
            wide << QStringLiteral("%1 by %2 px").arg(area->objectName()).arg(area->horizontalScrollBar()->maximum());
    return wide;
}

}  // namespace

class AppLooksTest : public tests::support::WindowTest {
    Q_OBJECT

private:
    /// Receives the window on each page, with the name of the page.
    using Look = std::function<void(QWidget& window, const char* page)>;
    /// Calls `look` on every page of the window.
    void visitPages(const Look& look);
    void visitPreparation(OpenWindow& open, const Look& look);
    void visitQuestions(OpenWindow& open, const Look& look);
    void visitPanels(OpenWindow& open, const Look& look);
    void visitAround(OpenWindow& open, const Look& look);
    void visitMonitor(OpenWindow& open, const Look& look);
    QFont m_font = QApplication::font();

private Q_SLOTS:
    void cleanup() { applyAppearance({}, m_font); }
    void themesCanBeRead_data();
    void themesCanBeRead();
    void everyControlHasANameForScreenReaders();
    void noTextIsCut_data();
    void noTextIsCut();
    void keysChangeTheAppearance();
    void pagesAreSavedAsPictures();
};

void AppLooksTest::visitPages(const Look& look)
{
    AppOptions options;
    options.makeStudy = [](const NewStudyRequest&, const MakingProgress&) {};
    options.lookAtData = someData();
    options.settings = std::make_shared<QSettings>(filePath("pages.ini"), QSettings::IniFormat);
    OpenWindow open(newStudy(tests::support::wholeStudy()), options);
    open.window().startSession(protocols::ParticipantId("P01"));
    open.playTo("Debriefing");
    open.gui().type("One felt sticky, the others dry.");
    look(open.window(), "debriefing");
    open.playToEnd();
    look(open.window(), "finished");
    open.gui().pressKey(Qt::Key_Return);
    QTest::qWait(1);
    open.window().startSession(protocols::ParticipantId("P02"));
    visitPreparation(open, look);
    visitQuestions(open, look);
    visitPanels(open, look);
    visitAround(open, look);
}

void AppLooksTest::visitPreparation(OpenWindow& open, const Look& look)
{
    look(open.window(), "introduction");
    open.playTo("Consenting");
    look(open.window(), "consent");
    open.playTo("AskingFacts");
    open.gui().focusOn("fact1");
    open.gui().type("31");
    look(open.window(), "facts");
    open.playTo("Familiarising");
    look(open.window(), "familiarisation");
    open.gui().pressKey(Qt::Key_2);
    look(open.window(), "familiarisation-shown");
    open.playTo("ScaleTraining");
    look(open.window(), "scale-training");
    open.perform(ScalePlaced{open.view().placesToName.front(), Tenths{50}});
    look(open.window(), "scale-training-named");
    open.playTo("CheckingList");
    open.gui().focusOn("check1");
    open.gui().pressKey(Qt::Key_Space);
    open.gui().pressKey(Qt::Key_Space);  // the focus has moved to the next box
    look(open.window(), "checklist");
    open.gui().pressKey(Qt::Key_Return);
    look(open.window(), "checklist-refused");
}

void AppLooksTest::visitQuestions(OpenWindow& open, const Look& look)
{
    open.playTo("PlacingTray");
    look(open.window(), "tray-first");
    open.playTo("Presenting");
    look(open.window(), "choice");
    open.gui().pressKey(Qt::Key_B);
    look(open.window(), "choice-read-back");
    open.playTo("Presenting", "W1");
    open.gui().type("Like paper,\nbut softer.");
    look(open.window(), "words");
    open.playTo("PlacingTray");
    look(open.window(), "tray");
    open.playTo("OnBreak");
    look(open.window(), "break");
    open.playTo("Presenting", "S1");
    open.gui().pressKey(Qt::Key_D);
    look(open.window(), "same-different");
    open.playTo("Presenting", "Q2");
    look(open.window(), "rating");
    open.gui().type("5,4");
    look(open.window(), "rating-read-back");
    open.gui().type("9");
    open.gui().pressKey(Qt::Key_Return);
    look(open.window(), "rating-refused");
    open.widget<QLineEdit>("ratingField").clear();
    open.playTo("Presenting", "L1");
    open.gui().type("4");
    look(open.window(), "likert");
    open.playTo("Presenting", "C1");
    open.gui().type("7.2");
    look(open.window(), "continuous");
}

void AppLooksTest::visitPanels(OpenWindow& open, const Look& look)
{
    open.playTo("PlacingTray");
    const auto visit = [&](Qt::Key key, const char* page) {
        open.gui().pressKey(key);
        look(open.window(), page);
        open.gui().pressKey(Qt::Key_Escape);
    };
    visit(Qt::Key_L, "correction-of-rating");
    open.gui().pressKey(Qt::Key_L);
    open.gui().click("answerToQ1");
    look(open.window(), "correction-of-choice");
    open.gui().pressKey(Qt::Key_Escape);
    visit(Qt::Key_V, "void");
    visit(Qt::Key_N, "note");
    visit(Qt::Key_F, "flag");
    visit(Qt::Key_W, "withdrawal");
    open.playTo("Presenting");
    open.perform(Noted{"", true});
    look(open.window(), "flagged");
    open.perform(Paused{});
    look(open.window(), "paused");
    open.display().fault = "the display does not answer";
    open.perform(Resumed{});
    open.gui().pressKey(Qt::Key_Return);
    look(open.window(), "display-fault");
    open.display().fault.clear();
}

void AppLooksTest::visitAround(OpenWindow& open, const Look& look)
{
    const auto leave = [&] {
        open.gui().pressKey(Qt::Key_Q);
        QTest::qWait(1);
    };
    leave();
    open.window().startSession(protocols::ParticipantId("P02"));
    look(open.window(), "welcome-back");
    open.perform(SittingPrepared{});
    look(open.window(), "scale-refresher");
    open.playTo("PlacingTray");
    open.clock().advanceSeconds(61 * 60);
    open.playTo("OnBreak");
    look(open.window(), "sitting-over");
    visitMonitor(open, look);
    leave();
    open.window().startSession(protocols::ParticipantId("P03"));
    open.perform(WithdrawnEvent{"tired"});
    look(open.window(), "withdrawn");
    open.gui().pressKey(Qt::Key_Return);
    QTest::qWait(1);
    look(open.window(), "study");
    open.gui().click("studyKeysButton");
    open.gui().click("assignKeyButton");
    look(open.window(), "keys");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("latencyTaskButton");
    look(open.window(), "latency");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().pressKey(Qt::Key_Escape);
    look(open.window(), "start");
    open.widget<QLineEdit>("studyFolderField").setText(filePath("nothing-here"));
    open.gui().click("openButton");
    look(open.window(), "start-fault");
    open.gui().click("newStudyButton");
    look(open.window(), "new-study");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("lookAtDataButton");
    look(open.window(), "data");
    auto& page = *qobject_cast<DataPage*>(open.window().currentPage());
    page.open("fabrics");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "data-open");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("displayButton");
    look(open.window(), "display");
    open.gui().click("connectDisplayButton");
    open.gui().click("pattern2Button");
    look(open.window(), "display-pattern");
}

void AppLooksTest::visitMonitor(OpenWindow& open, const Look& look)
{
    AppOptions options;
    options.clock = std::shared_ptr<Clock>(std::shared_ptr<Clock>(), &open.clock());
    options.settings = std::make_shared<QSettings>(filePath("monitor.ini"), QSettings::IniFormat);
    options.readFlags = [](const database::StudyStore&) {
        return std::vector<MonitorFlag>{
            {"P01", "too_fast", "9 of 42 answers (21 %) came within 0.5 s of the touch"},
            {"P02", "straight_lining",
             "Q2: 12 of 18 ratings are 5; a participant who feels no difference also gives such ratings"}};
    };
    MonitorWindow monitor(open.window().study()->store().folder().folder, options);
    monitor.show();
    QTRY_VERIFY(monitor.findChild<QLabel*>("flags")->text().contains("also gives such ratings"));
    look(monitor, "monitor");
}

void AppLooksTest::themesCanBeRead_data()
{
    QTest::addColumn<Theme>("theme");
    QTest::newRow("light") << Theme::Light;
    QTest::newRow("dark room") << Theme::DarkRoom;
}

void AppLooksTest::themesCanBeRead()
{
    QFETCH(Theme, theme);
    const Colours c = coloursOf(theme);
    QVERIFY(contrastOf(Qt::black, Qt::white) > 20.9);
    for (const auto& [front, back] :
         {std::pair(c.text, c.background), std::pair(c.text, c.surface), std::pair(c.quietText, c.background),
          std::pair(c.quietText, c.surface), std::pair(c.onAccent, c.accent), std::pair(c.onAttention, c.attention),
          std::pair(c.onFault, c.fault), std::pair(c.text, c.line)})
        QVERIFY2(contrastOf(front, back) >= 4.5, qPrintable(front.name() + " on " + back.name()));
}

void AppLooksTest::everyControlHasANameForScreenReaders()
{
    int pages = 0;
    visitPages([&](QWidget& window, const char* page) {
        const QStringList nameless = namelessControlsIn(window);
        QVERIFY2(nameless.isEmpty(), qPrintable(QString::fromLatin1(page) + ": " + nameless.join(", ")));
        ++pages;
    });
    QVERIFY(pages > 35);
}

void AppLooksTest::noTextIsCut_data()
{
    QTest::addColumn<int>("percent");
    QTest::newRow("usual size") << 100;
    QTest::newRow("twice as large") << 200;
}

void AppLooksTest::noTextIsCut()
{
    QFETCH(int, percent);
    visitPages([&](QWidget& window, const char* page) {
        applyAppearance({Theme::Light, percent}, m_font);
        window.resize(1100, 750);
        const auto faults = [&] { return cutTextsIn(window) + wideAreasIn(window); };
        QTRY_VERIFY2_WITH_TIMEOUT(faults().isEmpty(), qPrintable(QString::fromLatin1(page) + ": " + faults().join(", ")), 500);
        QVERIFY2(window.width() <= 1100 && window.height() <= 750, page);
    });
}

void AppLooksTest::keysChangeTheAppearance()
{
    AppOptions options;
    options.settings = std::make_shared<QSettings>(filePath("looks.ini"), QSettings::IniFormat);
    OpenWindow open(newStudy(), options);
    const double before = QApplication::font().pointSizeF();
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    QTest::keyClick(&open.window(), Qt::Key_Plus, Qt::ControlModifier);
    QVERIFY(QApplication::font().pointSizeF() > before);
    QVERIFY(open.widget<QLabel>("studyTitle").font().pointSizeF() > before * 2.2);
    QTest::keyClick(&open.window(), Qt::Key_D, Qt::ControlModifier);
    QVERIFY(QApplication::palette().color(QPalette::Window).lightness() < 60);
    QTest::keyClick(&open.window(), Qt::Key_0, Qt::ControlModifier);
    QCOMPARE(QApplication::font().pointSizeF(), before);
    QCOMPARE(options.settings->value("darkRoom").toBool(), true);
}

void AppLooksTest::pagesAreSavedAsPictures()
{
    const QString folder = qEnvironmentVariable("VIS2HAP_SCREENSHOTS");
    if (folder.isEmpty()) QSKIP("VIS2HAP_SCREENSHOTS names no folder, so no page is saved");
    QVERIFY(QDir().mkpath(folder));
    struct Variant {
        const char* name;
        Appearance appearance;
    };
    const Variant looks[] = {{"light", {Theme::Light, 100}}, {"dark", {Theme::DarkRoom, 100}}, {"large", {Theme::Light, 200}}};
    visitPages([&](QWidget& window, const char* page) {
        for (const Variant& look : looks) {
            applyAppearance(look.appearance, m_font);
            window.resize(1100, 750);
            QTest::qWait(150);
            const QString file = QStringLiteral("%1/%2-%3.png").arg(folder, QString::fromLatin1(page), look.name);
            QVERIFY2(window.grab().save(file), qPrintable(file));
        }
    });
}

QTEST_MAIN(AppLooksTest)
#include "app_looks_test.moc"
