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
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTest>

#include "protocols/files/errors.h"
#include "study/app/pages/data_page.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/photographs/photographs_page.h"
#include "study/app/pages/tools/tools_page.h"
#include "study/app/pieces/answer_entry.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/appearance.h"
#include "study/app/state/recent_studies.h"
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

/// Two photographs, one with a warning, and a blank picture of friction images.
PhotographSteps somePhotographs()
{
    PhotographSteps steps;
    steps.find = [](const std::filesystem::path& place) {
        return std::vector<std::filesystem::path>{place / "linen.jpg", place / "felt, from the museum.jpg"};
    };
    steps.see = [](const std::filesystem::path&, int) {
        QImage picture(800, 600, QImage::Format_RGB32);
        picture.fill(Qt::gray);
        return SeenPhotograph{picture, QSize(4000, 3000)};
    };
    steps.check = [](const PhotographSet&, const ToolProgress&) {
        return std::vector<QStringList>{{},
                                        {"photograph 0 of felt is unusual for cloth (one drawn cloth in twenty is like it); its "
                                         "height and friction are doubtful"}};
    };
    steps.write = [](const PhotographSet&, const std::filesystem::path&, const ToolProgress&) {};
    steps.draw = [](const FrictionPictureRequest& request, const ToolProgress&) {
        QImage picture(request.widthPx, 500, QImage::Format_RGB32);
        picture.fill(Qt::gray);
        return picture;
    };
    steps.plan = [](const std::filesystem::path&, const std::vector<std::string>&) -> std::filesystem::path {
        throw protocols::badInput({"the data set has too few fabrics for the paper's questions", "2 fabrics", "3 or more",
                                   "add photographs, or make a new study with a protocol of your own"});
    };
    return steps;
}

/// Buttons and labels that are too small for their text.
QStringList cutTextsIn(const QWidget& page)
{
    QStringList cut;
    for (const QWidget* widget : page.findChildren<QWidget*>()) {
        if (!widget->isVisible()) continue;
        const auto* label = qobject_cast<const QLabel*>(widget);
        const bool isBar = widget->property("role").toString() == QLatin1String("bar");
        if (isBar && widget->height() < widget->heightForWidth(widget->width())) cut << widget->objectName();
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
    void visitPhotographs(OpenWindow& open, const Look& look);
    static void visitRehearsal(OpenWindow& open, const Look& look);
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
    void contentFillsALargeScreen();
    void answersAreInView_data();
    void answersAreInView();
    void actionsAreInView_data();
    void actionsAreInView();
    void windowStartsOnTheScreen();
    void messagesStandBesideTheirFieldAndGo();
    void wordsStandUnderTheirTicks();
    void pagesAreSavedAsPictures();
};

void AppLooksTest::visitPages(const Look& look)
{
    AppOptions options;
    options.makeStudy = [](const NewStudyRequest&, const MakingProgress&) {};
    options.lookAtData = someData();
    options.photographs = somePhotographs();
    options.useTool = [](StudyTool, const std::filesystem::path&, const std::filesystem::path&, const ToolProgress&) {
        return ToolOutcome{};
    };
    options.makeRehearsal = [](const std::filesystem::path&) -> std::shared_ptr<const std::filesystem::path> {
        throw protocols::workFailed({"the station key is missing", "station-key.json", "the file of the study", "restore it"});
    };
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
    open.perform(ScalePlaced{*open.view().placeToName, Tenths{50}});
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
    open.gui().click("participantScreenButton");
    look(open.window(), "participant");
    open.gui().click("startPageButton");
    QTRY_VERIFY(open.window().currentPage()->findChild<QLabel*>("pageAddress")->isVisible());
    look(open.window(), "participant-page");
    open.gui().click("startPageButton");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("studyKeysButton");
    open.gui().click("assignKeyButton");
    look(open.window(), "keys");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().click("latencyTaskButton");
    look(open.window(), "latency");
    open.gui().pressKey(Qt::Key_Escape);
    open.gui().pressKey(Qt::Key_Escape);
    visitRehearsal(open, look);
    open.widget<QLineEdit>("participantField").setText("not allowed!");
    open.gui().click("enrolButton");
    look(open.window(), "study-hint");
    open.gui().pressKey(Qt::Key_F2);
    look(open.window(), "tools");
    open.gui().pressKey(Qt::Key_S);
    auto& tools = *qobject_cast<ToolsPage*>(open.window().currentPage());
    QTRY_VERIFY(!tools.isBusy());
    look(open.window(), "tools-status");
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
    visitPhotographs(open, look);
    open.gui().click("displayButton");
    look(open.window(), "display");
    open.gui().click("connectDisplayButton");
    open.gui().click("pattern2Button");
    look(open.window(), "display-pattern");
}

void AppLooksTest::visitRehearsal(OpenWindow& open, const Look& look)
{
    open.gui().click("rehearsalButton");
    look(open.window(), "rehearsal");
    auto& field = open.widget<QLineEdit>("rehearsalPieceField");
    field.setText("000");
    QTest::keyClick(&field, Qt::Key_Return);
    look(open.window(), "rehearsal-wrong-piece");
    open.gui().pressKey(Qt::Key_F5);
    look(open.window(), "rehearsal-fault");
    open.gui().pressKey(Qt::Key_Escape);
}

void AppLooksTest::visitPhotographs(OpenWindow& open, const Look& look)
{
    open.gui().click("photographsButton");
    look(open.window(), "photographs");
    auto& page = *qobject_cast<PhotographsPage*>(open.window().currentPage());
    page.add(filePath("photographs"));
    QTRY_VERIFY(!page.isBusy());
    open.widget<QLineEdit>("fabricNameField").setFocus();
    look(open.window(), "photographs-name-refused");  // an id has no comma
    open.gui().clear();
    open.gui().type("felt");
    open.gui().focusOn("pixelWidthField");
    open.gui().type("40");
    look(open.window(), "photographs-scale-refused");
    open.gui().clear();
    open.gui().type("0.05");
    open.gui().click("checkPhotographsButton");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "photographs-checked");
    open.gui().click("writeDatasetButton");
    QTRY_VERIFY(!page.isBusy());
    open.gui().click("drawFrictionImagesButton");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "photographs-rendered");
    open.gui().click("photographsToStudyButton");
    QTRY_VERIFY(!page.isBusy());
    look(open.window(), "photographs-too-few");
    open.gui().pressKey(Qt::Key_Escape);
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
    QTest::newRow("high contrast") << Theme::HighContrast;
}

void AppLooksTest::themesCanBeRead()
{
    QFETCH(Theme, theme);
    const double atLeast = theme == Theme::HighContrast ? 7 : 4.5;
    const Colours c = coloursOf(theme);
    QVERIFY(contrastOf(Qt::black, Qt::white) > 20.9);
    for (const auto& [front, back] :
         {std::pair(c.text, c.background), std::pair(c.text, c.surface), std::pair(c.quietText, c.background),
          std::pair(c.quietText, c.surface), std::pair(c.onAccent, c.accent), std::pair(c.onAttention, c.attention),
          std::pair(c.onFault, c.fault), std::pair(c.text, c.line)})
        QVERIFY2(contrastOf(front, back) >= atLeast, qPrintable(front.name() + " on " + back.name()));
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
        applyAppearance({Theme::Light, percent}, m_font, QSize(1100, 750));
        window.resize(1100, 750);
        const auto faults = [&] { return cutTextsIn(window) + wideAreasIn(window); };
        QTRY_VERIFY2_WITH_TIMEOUT(faults().isEmpty(), qPrintable(QString::fromLatin1(page) + ": " + faults().join(", ")), 2000);
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
    QTest::keyClick(&open.window(), Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(QApplication::palette().color(QPalette::Window), QColor(Qt::black));
    QCOMPARE(rememberedAppearance(options.settings.get()).theme, Theme::HighContrast);
    for (int more = 0; more < 2; ++more) QTest::keyClick(&open.window(), Qt::Key_D, Qt::ControlModifier);
    QTest::keyClick(&open.window(), Qt::Key_0, Qt::ControlModifier);
    QCOMPARE(QApplication::font().pointSizeF(), before);
    open.gui().click("largerTextButton");
    QVERIFY(QApplication::font().pointSizeF() > before);
    open.gui().click("smallerTextButton");
    QCOMPARE(QApplication::font().pointSizeF(), before);
    open.gui().click("themeButton");
    QCOMPARE(rememberedAppearance(options.settings.get()).theme, Theme::HighContrast);
    for (int more = 0; more < 2; ++more) open.gui().click("themeButton");
    QCOMPARE(options.settings->value("darkRoom").toBool(), true);
}

/// Smallest rectangle around the visible texts, fields, buttons, lists and pictures in `root`, in coordinates of the window.
QRect contentOf(const QWidget& root)
{
    QRect content;
    for (const QWidget* widget : root.findChildren<QWidget*>()) {
        const auto* label = qobject_cast<const QLabel*>(widget);
        const bool isShown = isControl(*widget) || (label && !(label->text().isEmpty() && label->pixmap().isNull()));
        if (!widget->isVisible() || !isShown) continue;
        // A label may be wider than its text.
        const int textWidth = label ? label->fontMetrics().horizontalAdvance(label->text()) : widget->width();
        const bool isText = label && !label->text().isEmpty();
        const int width = isText ? std::min(label->width(), textWidth) : widget->width();
        content |= QRect(widget->mapTo(root.window(), QPoint()), QSize(width, widget->height()));
    }
    return content & root.window()->rect();
}

/// Share of the window that content covers. Header, page and footer count one by one, so that the gaps between them do not.
double shareOfContent(const QWidget& window)
{
    double covered = 0;
    const auto add = [&](const QWidget& part) {
        const QRect content = contentOf(part);
        covered += 1.0 * content.width() * content.height();
    };
    for (const auto* area : window.findChildren<QScrollArea*>())
        if (area->isVisible()) add(*area);
    for (const char* bar : {"sessionHeader", "sessionFooter"})
        if (const auto* found = window.findChild<QWidget*>(QLatin1String(bar)); found && found->isVisible()) add(*found);
    return covered / (1.0 * window.width() * window.height());
}

/// Pages on which nearly all of a session is spent, and guides, whose text grows with the window. The others are short forms.
bool fillsTheWindow(const QString& page)
{
    const char* const kinds[] = {"choice",         "words",        "rating",       "likert",       "continuous",
                                 "same-different", "tray",         "break",        "introduction", "consent",
                                 "paused",         "welcome-back", "sitting-over", "finished",     "withdrawn"};
    return std::any_of(std::begin(kinds), std::end(kinds),
                       [&](const char* kind) { return page.startsWith(QLatin1String(kind)); });
}

void AppLooksTest::contentFillsALargeScreen()
{
    double sum = 0;
    int pages = 0;
    QStringList small;
    visitPages([&](QWidget& window, const char* page) {
        if (!qobject_cast<MainWindow*>(&window)) return;
        window.resize(1920, 1080);
        const auto faults = [&] { return cutTextsIn(window) + wideAreasIn(window); };
        QTRY_VERIFY2_WITH_TIMEOUT(faults().isEmpty(), qPrintable(QString::fromLatin1(page) + ": " + faults().join(", ")), 2000);
        const double share = shareOfContent(window);
        sum += share;
        ++pages;
        const double atLeast = fillsTheWindow(QLatin1String(page)) ? 0.6 : 0.33;
        if (share < atLeast) small << QStringLiteral("%1: %2").arg(page).arg(share);
        if (qEnvironmentVariableIsSet("VIS2HAP_SHARES")) qInfo("%s %.2f", page, share);
    });
    QVERIFY2(small.isEmpty(), qPrintable(small.join(", ")));
    QVERIFY2(sum / pages >= 0.6, qPrintable(QString::number(sum / pages)));
}

void AppLooksTest::answersAreInView_data()
{
    QTest::addColumn<QSize>("size");
    QTest::addColumn<int>("percent");
    for (const QSize size : {QSize(800, 480), QSize(1366, 768), QSize(1920, 1080), QSize(3840, 2160)})
        for (const int percent : {100, 200})
            QTest::addRow("%d x %d, %d %%", size.width(), size.height(), percent) << size << percent;
}

/// Whether the widget takes the answer, or stores it.
bool isOfAnswer(const QWidget& widget)
{
    if (widget.objectName() == QLatin1String("storeButton")) return true;
    const QWidget* parent = &widget;
    while (parent && !qobject_cast<const AnswerEntry*>(parent)) parent = parent->parentWidget();
    const auto* list = qobject_cast<const QAbstractItemView*>(&widget);
    return parent && isControl(widget) && !list;
}

/// The controls of the answer and the button that stores it, without scrolling, on the page of every kind of question.
void AppLooksTest::answersAreInView()
{
    QFETCH(QSize, size);
    QFETCH(int, percent);
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    open.window().setAppearance({Theme::Light, percent});
    open.window().resize(size);
    open.enrolAndBegin();
    for (const char* question : {"Q1", "W1", "S1", "Q2", "L1", "C1"}) {
        open.playTo("Presenting", question);
        const auto hidden = [&] {
            QStringList names;
            for (const QWidget* widget : open.window().currentPage()->findChildren<QWidget*>())
                if (widget->isVisible() && isOfAnswer(*widget) && widget->visibleRegion().boundingRect() != widget->rect())
                    names << widget->objectName();
            return names.join(QLatin1Char(' '));
        };
        QTRY_VERIFY2_WITH_TIMEOUT(hidden().isEmpty(), qPrintable(QLatin1String(question) + ": " + hidden()), 1000);
    }
    open.window().setAppearance({});
}

void AppLooksTest::actionsAreInView_data()
{
    QTest::addColumn<QSize>("size");
    QTest::addColumn<int>("percent");
    for (const QSize size : {QSize(800, 480), QSize(1366, 768), QSize(1920, 1080)})
        for (const int percent : {100, 200})
            QTest::addRow("%d x %d, %d %%", size.width(), size.height(), percent) << size << percent;
}

/// Main buttons that can be pressed and of which a part is hidden. Without scrolling, pages show them in full.
QStringList hiddenActionsIn(const QWidget& page)
{
    QStringList hidden;
    for (const auto* button : page.findChildren<QAbstractButton*>())
        if (button->isVisible() && button->isEnabled() && button->property("role").toString() == QLatin1String("main") &&
            button->visibleRegion().boundingRect() != button->rect())
            hidden << button->objectName();
    return hidden;
}

/// Texts are complete and the main buttons are in view on every page, at every size of window and text. The six steps of the
/// page of photographs, with its lists and pictures, may scroll.
void AppLooksTest::actionsAreInView()
{
    QFETCH(QSize, size);
    QFETCH(int, percent);
    QStringList faults;
    visitPages([&](QWidget& window, const char* page) {
        auto* main = qobject_cast<MainWindow*>(&window);
        if (!main) return;
        main->setAppearance({Theme::Light, percent});
        main->resize(size);
        const bool mayScroll = QLatin1String(page).startsWith(QLatin1String("photographs"));
        const auto faultsNow = [&] {
            return cutTextsIn(*main) + wideAreasIn(*main) + (mayScroll ? QStringList() : hiddenActionsIn(*main));
        };
        if (!QTest::qWaitFor([&] { return main->size() == size && faultsNow().isEmpty(); }, 2000))
            faults << QString::fromLatin1(page) + QLatin1String(": ") + faultsNow().join(QLatin1String(", "));
    });
    QVERIFY2(faults.isEmpty(), qPrintable(faults.join(QLatin1Char('\n'))));
}

void AppLooksTest::windowStartsOnTheScreen()
{
    tests::support::ShownWindow shown;
    shown.window.setAppearance({Theme::Light, 250});
    QTest::qWait(50);
    const QRect room = shown.window.screen()->availableGeometry();
    const QRect frame = shown.window.frameGeometry();
    QVERIFY2(room.contains(frame),
             qPrintable(QStringLiteral("%1x%2+%3+%4").arg(frame.width()).arg(frame.height()).arg(frame.x()).arg(frame.y())));
    shown.window.resize(800, 480);
    QTest::qWait(50);
    QCOMPARE(shown.window.size(), QSize(800, 480));
    shown.window.setAppearance({});
}

/// Bars whose text touches their border. A bar has a padding of at least 8 px.
QStringList tightBarsIn(const QWidget& window)
{
    QStringList tight;
    for (const auto* bar : window.findChildren<MessageBar*>())
        if (bar->isVisible() && !bar->rect().adjusted(8, 8, -8, -8).contains(bar->contentsRect())) tight << bar->objectName();
    return tight;
}

void AppLooksTest::messagesStandBesideTheirFieldAndGo()
{
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    open.window().resize(1100, 750);
    const auto distance = [&](const char* message, const QWidget& field) {
        const auto* bar = open.window().currentPage()->findChild<MessageBar*>(QLatin1String(message));
        return bar->mapTo(&open.window(), QPoint()).y() - field.mapTo(&open.window(), QPoint(0, field.height())).y();
    };
    const auto isBeside = [&](const char* message, const QWidget& field) {
        return !open.message(message).isEmpty() && tightBarsIn(open.window()).isEmpty() && distance(message, field) >= 0 &&
               distance(message, field) < 2 * field.height();
    };
    // the study page
    auto& next = open.widget<QLineEdit>("participantField");
    next.setText("not allowed!");
    open.gui().click("enrolButton");
    QTRY_VERIFY(isBeside("studyMessage", next));
    next.setText("P01");
    QVERIFY(open.message("studyMessage").isEmpty());
    // a rating
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    open.gui().type("99");
    open.gui().pressKey(Qt::Key_Return);
    auto& rating = open.widget<QLineEdit>("ratingField");
    QTRY_VERIFY(!open.message().isEmpty() && tightBarsIn(open.window()).isEmpty());
    QTRY_VERIFY(distance("sessionMessage", open.widget<ScaleLine>("scaleLine")) < 40);
    const QString said = open.message();
    int times = 0;
    for (const auto* text : open.window().currentPage()->findChildren<QLabel*>())
        times += text->isVisible() && text->text().contains(said) ? 1 : 0;
    QCOMPARE(times, 1);
    rating.setText("9");
    QVERIFY(open.message().isEmpty());
    QVERIFY(open.widget<QLabel>("readBack").text().contains("9"));
    rating.clear();
    // a reason
    open.playTo("PlacingTray");
    open.gui().pressKey(Qt::Key_V);
    open.gui().pressKey(Qt::Key_Return);
    QTRY_VERIFY(isBeside("sessionMessage", open.widget<QLineEdit>("reasonField")));
    open.gui().type("m");
    QVERIFY(open.message().isEmpty());
}

void AppLooksTest::wordsStandUnderTheirTicks()
{
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    open.window().resize(1366, 768);
    open.enrolAndBegin();
    open.playTo("Presenting", "L1");
    const auto& line = open.widget<ScaleLine>("scaleLine");
    const auto words = line.parentWidget()->findChildren<QLabel*>("scaleLabel");
    QVERIFY(words.size() > 2);
    const auto farthest = [&] {
        int most = 0;
        for (int step = 0; step < words.size(); ++step)
            most = std::max(most, std::abs(words[step]->geometry().center().x() - line.x() -
                                           line.pointOf(Tenths{line.scale().min.value + step * line.scale().step.value}).x()));
        return most;
    };
    QTRY_VERIFY2(farthest() <= 3, qPrintable(QString::number(farthest())));
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
    const Variant looks[] = {{"light", {Theme::Light, 100}},
                             {"dark", {Theme::DarkRoom, 100}},
                             {"contrast", {Theme::HighContrast, 100}},
                             {"large", {Theme::Light, 200}}};
    const QSize only = QSize(qEnvironmentVariableIntValue("VIS2HAP_SCREENSHOT_WIDTH"), 0);
    visitPages([&](QWidget& window, const char* page) {
        for (const QSize size : {QSize(800, 480), QSize(1366, 768), QSize(1920, 1080), QSize(3840, 2160)})
            for (const Variant& look : looks) {
                // The smallest window shows the limits, the larger ones show the themes.
                const bool isWanted = size.width() == 1920 || look.appearance.theme == Theme::Light;
                if (!isWanted || (only.width() > 0 && only.width() != size.width())) continue;
                window.resize(size);
                QTest::qWait(20);
                applyAppearance(look.appearance, m_font, size);
                QTest::qWait(100);
                const QString file =
                    QStringLiteral("%1/%2-%3-%4.png").arg(folder, QString::fromLatin1(page), look.name).arg(size.width());
                QVERIFY2(window.grab().save(file), qPrintable(file));
            }
    });
}

QTEST_MAIN(AppLooksTest)
#include "app_looks_test.moc"
