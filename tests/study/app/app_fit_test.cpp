// Pages in windows of every size: content fills large windows, and in small ones nothing is cut and the main buttons are in view.
#include <QAbstractButton>
#include <QAbstractItemView>
#include <QLabel>
#include <QScreen>
#include <QTest>

#include "study/app/pieces/answer_entry.h"
#include "study/app/pieces/session_header.h"
#include "study/app/state/appearance.h"
#include "tests/study/app/every_page.h"
#include "tests/study/app/page_measures.h"
#include "tests/support/whole_protocol.h"

using namespace study::app;
using namespace study::session;
using tests::support::OpenWindow;

class AppFitTest : public tests::EveryPage {
    Q_OBJECT

private Q_SLOTS:
    void cleanup() { applyAppearance({}, m_font); }
    void noTextIsCut_data();
    void noTextIsCut();
    void contentFillsALargeScreen();
    void answersAreInView_data();
    void answersAreInView();
    void actionsAreInView_data();
    void actionsAreInView();
    void enlargedTextIsNotSmallerInALowWindow();
    void windowStartsOnTheScreen();
    void longFactsDoNotWidenTheHeader_data();
    void longFactsDoNotWidenTheHeader();
    void theDisplayGivesWayToTheParticipant();
};

namespace {

/// Pages of a session, whose text grows with the window. The others are lists and short forms that the operator sees once.
bool fillsTheWindow(const QString& page)
{
    const char* const kinds[] = {"choice",       "words",    "rating",       "likert",  "continuous", "same-different",
                                 "tray",         "break",    "introduction", "consent", "paused",     "welcome-back",
                                 "sitting-over", "finished", "withdrawn",    "facts",   "scale",      "familiarisation",
                                 "debriefing",   "void",     "note",         "flag",    "withdrawal"};
    return std::any_of(std::begin(kinds), std::end(kinds),
                       [&](const char* kind) { return page.startsWith(QLatin1String(kind)); });
}

/// Whether the widget takes the answer, or stores it.
bool isOfAnswer(const QWidget& widget)
{
    if (widget.objectName() == QLatin1String("storeButton")) return true;
    const QWidget* parent = &widget;
    while (parent && !qobject_cast<const AnswerEntry*>(parent)) parent = parent->parentWidget();
    const auto* list = qobject_cast<const QAbstractItemView*>(&widget);
    return parent && tests::isControl(widget) && !list;
}

}  // namespace

void AppFitTest::noTextIsCut_data()
{
    QTest::addColumn<int>("percent");
    QTest::newRow("usual size") << 100;
    QTest::newRow("twice as large") << 200;
}

void AppFitTest::noTextIsCut()
{
    QFETCH(int, percent);
    visitPages([&](QWidget& window, const char* page) {
        applyAppearance({Theme::Light, percent}, m_font, QSize(1100, 750));
        window.resize(1100, 750);
        const auto faults = [&] { return tests::cutTextsIn(window) + tests::wideAreasIn(window); };
        QTRY_VERIFY2_WITH_TIMEOUT(faults().isEmpty(), qPrintable(QString::fromLatin1(page) + ": " + faults().join(", ")), 2000);
        QVERIFY2(window.width() <= 1100 && window.height() <= 750, page);
    });
}

void AppFitTest::contentFillsALargeScreen()
{
    double sum = 0;
    int pages = 0;
    QStringList small;
    visitPages([&](QWidget& window, const char* page) {
        if (!qobject_cast<MainWindow*>(&window)) return;
        window.resize(1920, 1080);
        tests::settle(window);
        const auto faults = [&] { return tests::cutTextsIn(window) + tests::wideAreasIn(window); };
        QTRY_VERIFY2_WITH_TIMEOUT(faults().isEmpty(), qPrintable(QString::fromLatin1(page) + ": " + faults().join(", ")), 2000);
        const double atLeast = fillsTheWindow(QLatin1String(page)) ? 0.6 : 0.33;
        const double share = tests::shareOfContent(window);
        sum += share;
        ++pages;
        if (share < atLeast) small << QStringLiteral("%1: %2").arg(page).arg(share);
        if (qEnvironmentVariableIsSet("VIS2HAP_SHARES")) qInfo("%s %.2f", page, share);
    });
    QVERIFY2(small.isEmpty(), qPrintable(small.join(", ")));
    QVERIFY2(sum / pages >= 0.6, qPrintable(QString::number(sum / pages)));
}

void AppFitTest::answersAreInView_data()
{
    QTest::addColumn<QSize>("size");
    QTest::addColumn<int>("percent");
    for (const QSize size : {QSize(800, 480), QSize(1366, 768), QSize(1920, 1080), QSize(3840, 2160)})
        for (const int percent : {100, 200})
            QTest::addRow("%d x %d, %d %%", size.width(), size.height(), percent) << size << percent;
}

/// The controls of the answer and the button that stores it, without scrolling, on the page of every kind of question.
void AppFitTest::answersAreInView()
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

void AppFitTest::actionsAreInView_data()
{
    QTest::addColumn<QSize>("size");
    QTest::addColumn<int>("percent");
    for (const QSize size : {QSize(800, 480), QSize(1366, 768), QSize(1920, 1080)})
        for (const int percent : {100, 200})
            QTest::addRow("%d x %d, %d %%", size.width(), size.height(), percent) << size << percent;
}

/// Texts are complete and the main buttons are in view on every page, at every size of window and text. The six steps of the
/// page of photographs, with its lists and pictures, may scroll.
void AppFitTest::actionsAreInView()
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
            return tests::cutTextsIn(*main) + tests::wideAreasIn(*main) +
                   (mayScroll ? QStringList() : tests::hiddenActionsIn(*main));
        };
        if (!QTest::qWaitFor([&] { return main->size() == size && faultsNow().isEmpty(); }, 2000))
            faults << QString::fromLatin1(page) + QLatin1String(": ") + faultsNow().join(QLatin1String(", "));
    });
    QVERIFY2(faults.isEmpty(), qPrintable(faults.join(QLatin1Char('\n'))));
}

/// A low window takes a smaller type where the whole page would not fit. Text at 200 % must not become smaller than at 100 %; on
/// pages that are fuller than the familiarisation it may by a little, because the bars around them grow, too.
void AppFitTest::enlargedTextIsNotSmallerInALowWindow()
{
    // One visit for each size of text: a change of it lays out every page anew.
    const auto smallestAt = [&](int percent) {
        std::vector<std::pair<QString, double>> smallest;  // a page may be visited more than once
        visitPages([&](QWidget& window, const char* page) {
            auto* main = qobject_cast<MainWindow*>(&window);
            if (!main) return;
            main->setAppearance({Theme::Light, percent});
            main->resize(800, 480);
            tests::settle(*main);
            double& least = smallest.emplace_back(QString::fromLatin1(page), 1000).second;
            for (const auto* text : main->currentPage()->findChildren<QLabel*>())
                if (text->isVisible() && !text->text().isEmpty()) least = std::min(least, text->font().pointSizeF());
        });
        return smallest;
    };
    const auto usual = smallestAt(100), enlarged = smallestAt(200);
    QVERIFY(!usual.empty());
    QCOMPARE(enlarged.size(), usual.size());
    QStringList faults;
    for (std::size_t visit = 0; visit < usual.size(); ++visit) {
        const auto& [page, size] = usual[visit];
        QCOMPARE(enlarged[visit].first, page);
        const double larger = enlarged[visit].second;
        if (larger < size * (page.startsWith(QLatin1String("familiar")) ? 1 : 0.9))
            faults << QStringLiteral("%1: %2 pt, %3 pt at 100 %").arg(page).arg(larger).arg(size);
    }
    QVERIFY2(faults.isEmpty(), qPrintable(faults.join(QLatin1Char('\n'))));
}

void AppFitTest::windowStartsOnTheScreen()
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

void AppFitTest::longFactsDoNotWidenTheHeader_data()
{
    QTest::addColumn<QString>("display");
    QTest::addColumn<QString>("participant");
    QTest::addColumn<QString>("phase");
    const QString name = QStringLiteral("a long name ").repeated(15) + QString(90, QLatin1Char('x'));
    QTest::newRow("display") << name << "P01"
                             << "Q1";
    QTest::newRow("participant") << "glass" << name << "Q1";
    QTest::newRow("phase") << "glass"
                           << "P01" << name;
}

/// The fact stays one line, is readable from its beginning, and its tooltip has the whole text.
void AppFitTest::longFactsDoNotWidenTheHeader()
{
    QFETCH(QString, display);
    QFETCH(QString, participant);
    QFETCH(QString, phase);
    applyAppearance({}, m_font);
    SessionHeader header(nullptr);
    View view;
    view.participant = participant.toStdString();
    view.phaseName = phase.toStdString();
    view.presentation = 1;
    SessionFacts facts;
    facts.displayName = display;
    header.begin(facts);
    header.resize(400, 1000);  // high, so that no fact is left out
    header.show();
    header.present(view);
    tests::settle(header);
    QCOMPARE(header.width(), 400);
    QVERIFY2(header.minimumSizeHint().width() < 300, qPrintable(QString::number(header.minimumSizeHint().width())));
    int longFacts = 0;
    for (const auto* label : header.findChildren<QLabel*>()) {
        if (!label->isVisible()) continue;
        QVERIFY2(label->geometry().right() < 400, qPrintable(label->objectName()));
        if (!label->text().contains(QLatin1String("a long name"))) continue;
        ++longFacts;
        QVERIFY2(label->width() < label->sizeHint().width(), qPrintable(label->objectName()));
        QVERIFY2(label->toolTip().contains(QString(90, QLatin1Char('x'))), qPrintable(label->toolTip()));
    }
    QCOMPARE(longFacts, 1);
}

/// In a low window the display's name is shortened before the participant and the progress go.
void AppFitTest::theDisplayGivesWayToTheParticipant()
{
    const QSize size(1024, 600);
    applyAppearance({Theme::Light, 200}, m_font, size);
    QWidget window;
    window.resize(size);
    auto& header = *new SessionHeader(&window);
    View view;
    view.participant = "P01";
    view.phaseName = "Q2-Q4";
    view.state.stage = Presenting{};
    view.presentation = 13;
    view.presentations = 126;
    view.answersInAll = 252;
    view.minutesLeft = 95;
    SessionFacts facts;
    facts.displayName = "reference display with a second name (exec:/opt/lab/driver --device /dev/serial/by-id/usb-0)";
    header.begin(facts);
    header.setGeometry(0, 0, size.width(), 90);
    window.show();
    header.present(view);
    tests::settle(window);
    for (const char* name : {"participantFact", "presentationFact", "answersFact", "timeLeftFact"}) {
        const auto& fact = *header.findChild<QLabel*>(QLatin1String(name));
        QVERIFY2(fact.isVisible() && fact.width() >= fact.sizeHint().width(), name);
    }
    const auto& display = *header.findChild<QLabel*>("displayFact");
    QCOMPARE(display.text(), QString("Display on: reference display with a second name"));
    QVERIFY(display.toolTip().contains("/opt/lab/driver"));
    QVERIFY(!display.isVisible() || display.geometry().right() < size.width());
    QVERIFY(header.findChild<QLabel*>("participantFact")->x() < display.x() || !display.isVisible());
}

QTEST_MAIN(AppFitTest)
#include "app_fit_test.moc"
