// Appearance of every page: names for screen readers, themes, text sizes. With VIS2HAP_SCREENSHOTS=FOLDER the test saves
// every page in this folder as PNG: light, dark, and with text at 200 %.
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTest>

#include "study/app/language/app_text.h"
#include "study/app/language/language.h"
#include "study/app/participant/instruction_view.h"
#include "study/app/participant/participant_side.h"
#include "study/app/pieces/pieces.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/appearance.h"
#include "study/app/state/recent_studies.h"
#include "tests/study/app/every_page.h"
#include "tests/study/app/page_measures.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using protocols::Tenths;
using tests::support::OpenWindow;

namespace {

QStringList namelessControlsIn(const QWidget& root)
{
    QStringList nameless;
    for (const QWidget* widget : root.findChildren<QWidget*>())
        if (tests::isControl(*widget) && (widget->accessibleName().trimmed().isEmpty() || widget->objectName().isEmpty()))
            nameless << QString::fromLatin1(widget->metaObject()->className()) + " " + widget->objectName();
    return nameless;
}

/// Bars whose text touches their border. A bar has a padding of at least 8 px.
QStringList tightBarsIn(const QWidget& window)
{
    QStringList tight;
    for (const auto* bar : window.findChildren<MessageBar*>())
        if (bar->isVisible() && !bar->rect().adjusted(8, 8, -8, -8).contains(bar->contentsRect())) tight << bar->objectName();
    return tight;
}

}  // namespace

class AppLooksTest : public tests::EveryPage {
    Q_OBJECT

private Q_SLOTS:
    void cleanup()
    {
        applyAppearance({}, m_font);
        QGuiApplication::setLayoutDirection(Qt::LeftToRight);
    }
    void themesCanBeRead_data();
    void themesCanBeRead();
    void everyControlHasANameForScreenReaders();
    void keysChangeTheAppearance();
    void noSizeIsStoredThatTheWindowCannotShow();
    void aFieldThatIsOffLooksOff();
    void messagesStandBesideTheirFieldAndGo();
    void wordsStandUnderTheirTicks_data();
    void wordsStandUnderTheirTicks();
    void slotsAndEndsKeepTheirSidesFromRightToLeft();
    void pagesAreSavedAsPictures();
};

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

/// So one Ctrl − is enough to make the largest text smaller.
void AppLooksTest::noSizeIsStoredThatTheWindowCannotShow()
{
    AppOptions options;
    options.settings = std::make_shared<QSettings>(filePath("sizes.ini"), QSettings::IniFormat);
    OpenWindow open(newStudy(), options);
    open.window().resize(1024, 600);
    QVERIFY(QTest::qWaitForWindowActive(&open.window()));
    tests::settle(open.window());
    const auto press = [&](Qt::Key key) { QTest::keyClick(&open.window(), key, Qt::ControlModifier); };
    for (int more = 0; more < 8; ++more) press(Qt::Key_Plus);
    const double largest = QApplication::font().pointSizeF();
    const int percent = rememberedAppearance(options.settings.get()).textPercent;
    QVERIFY2(textScaleOf(open.window().size(), percent - 25) < textScaleOf(open.window().size(), percent),
             qPrintable(QString::number(percent)));
    press(Qt::Key_Minus);
    QVERIFY(QApplication::font().pointSizeF() < largest);
    open.window().setAppearance({Theme::Light, 250});  // stored in a larger window
    press(Qt::Key_Minus);
    QVERIFY(QApplication::font().pointSizeF() < largest);
    open.window().setAppearance({});
}

void AppLooksTest::aFieldThatIsOffLooksOff()
{
    applyAppearance({}, m_font);
    QLineEdit line(QStringLiteral("P01"));
    line.resize(200, 40);
    const QColor on = line.grab().toImage().pixelColor(100, 20);
    line.setEnabled(false);
    QVERIFY(line.grab().toImage().pixelColor(100, 20) != on);
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
    next.setText("not/allowed");
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
    QTRY_VERIFY(isBeside("sessionMessage", open.widget<QPlainTextEdit>("reasonField")));
    open.gui().type("m");
    QVERIFY(open.message().isEmpty());
}

void AppLooksTest::wordsStandUnderTheirTicks_data()
{
    QTest::addColumn<Qt::LayoutDirection>("direction");
    QTest::newRow("from left to right") << Qt::LeftToRight;
    QTest::newRow("from right to left") << Qt::RightToLeft;
}

void AppLooksTest::wordsStandUnderTheirTicks()
{
    QFETCH(const Qt::LayoutDirection, direction);
    QGuiApplication::setLayoutDirection(direction);
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
            most = std::max(
                most,
                std::abs(words[step]->mapTo(&open.window(), words[step]->rect().center()).x() -
                         line.mapTo(&open.window(), line.pointOf(Tenths{line.scale().min.value + step * line.scale().step.value}))
                             .x()));
        return most;
    };
    QTRY_VERIFY2(farthest() <= 3, qPrintable(QString::number(farthest())));
}

/// The line of a scale and the tray on the table lie the same way in every language.
void AppLooksTest::slotsAndEndsKeepTheirSidesFromRightToLeft()
{
    QGuiApplication::setLayoutDirection(Qt::RightToLeft);
    OpenWindow open(newStudy(tests::support::wholeStudy()));
    open.window().startSession(protocols::ParticipantId("P01"));
    const auto isLeftOf = [](const QWidget& left, const QWidget& right) {
        return left.mapTo(left.window(), left.rect().center()).x() < right.mapTo(right.window(), right.rect().center()).x();
    };
    open.playTo("ScaleTraining");
    QTRY_VERIFY(isLeftOf(open.widget<QLabel>("lowAnchor"), open.widget<QLabel>("highAnchor")));
    QVERIFY(open.widget<QLabel>("lowAnchor").alignment().testFlag(Qt::AlignAbsolute));  // else Arabic words go to the right
    InstructionView screen(open.window().participantSide(), nullptr);
    screen.resize(1280, 800);
    screen.show();
    const auto& low = *screen.findChild<QLabel*>("participantLow");
    const auto& high = *screen.findChild<QLabel*>("participantHigh");
    QTRY_VERIFY(low.isVisible() && isLeftOf(low, high));
    QVERIFY(low.alignment().testFlag(Qt::AlignAbsolute) && high.alignment().testFlag(Qt::AlignAbsolute));
    open.playTo("PlacingTray");
    QTRY_VERIFY(isLeftOf(open.widget<QFrame>("slotCardA"), open.widget<QFrame>("slotCardB")));
    QVERIFY(isLeftOf(open.widget<QFrame>("slotCardB"), open.widget<QFrame>("slotCardC")));
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
    LanguageInUse language("vis2hap 0.6.0");
    if (const QString tag = qEnvironmentVariable("VIS2HAP_SCREENSHOT_LANGUAGE"); !tag.isEmpty()) {
        language.use(tag);
        m_language = languageOfWindow().toStdString();
    }
    const QStringList wanted = qEnvironmentVariable("VIS2HAP_SCREENSHOT_PAGES").split(QLatin1Char(','), Qt::SkipEmptyParts);
    const QSize only = QSize(qEnvironmentVariableIntValue("VIS2HAP_SCREENSHOT_WIDTH"), 0);
    visitPages([&](QWidget& window, const char* page) {
        if (!wanted.isEmpty() && !wanted.contains(QLatin1String(page))) return;
        for (const QSize size : {QSize(800, 480), QSize(1366, 768), QSize(1920, 1080), QSize(3840, 2160)})
            for (const Variant& look : looks) {
                // The smallest window shows the limits, the larger ones show the themes.
                const bool isWanted = size.width() == 1920 || look.appearance.theme == Theme::Light;
                if (!isWanted || (only.width() > 0 && only.width() != size.width())) continue;
                if (auto* main = qobject_cast<MainWindow*>(&window))
                    main->setAppearance(look.appearance);
                else
                    applyAppearance(look.appearance, m_font, size);
                window.resize(size);
                tests::settle(window);
                window.resize(size);  // the larger text of the picture before may have kept the window large
                tests::settle(window);
                const QString file =
                    QStringLiteral("%1/%2-%3-%4.png").arg(folder, QString::fromLatin1(page), look.name).arg(size.width());
                QVERIFY2(window.grab().save(file), qPrintable(file));
            }
    });
}

QTEST_MAIN(AppLooksTest)
#include "app_looks_test.moc"
