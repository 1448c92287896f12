// Pages around a session: opening and creating studies, the list of participants, the checklist. Also typed numbers.
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTest>
#include <QThread>
#include <QTreeWidget>

#include "protocols/files/errors.h"
#include "study/app/pages/checklist_page.h"
#include "study/app/pieces/scale_line.h"
#include "study/app/state/rating_text.h"
#include "tests/support/open_window.h"

using namespace study::app;
using namespace study::session;
using protocols::Tenths;
using tests::support::OpenWindow;
using tests::support::ShownWindow;

class AppPagesTest : public tests::support::WindowTest {
    Q_OBJECT

private:
    /// Text of one row in the list of the study page.
    static QString placeAt(OpenWindow& open, int row);

private Q_SLOTS:
    void typedNumbersBecomeRatings_data();
    void typedNumbersBecomeRatings();
    void pointsOnTheLineBecomeSteps();
    void onlyAScaleOfWholeNumbersIsCalledOne();
    void startPageOpensAStudy();
    void startPageShowsWhyAFolderCannotBeOpened();
    void recentStudiesAreListed();
    void studyPageShowsEveryParticipant();
    void aNewParticipantBesideAnOpenSessionIsAskedTwice();
    void nextParticipantTakesThePlaceAfterAWithdrawal();
    void takenOrInvalidCodesAreNotEnrolled_data();
    void takenOrInvalidCodesAreNotEnrolled();
    void codesOfEveryScriptAreEnrolled_data();
    void codesOfEveryScriptAreEnrolled();
    void newStudyIsMadeOnAWorkerThread();
    void pageShowsWhyTheStudyCouldNotBeMade();
    void makingCanBeStopped();
    void incompleteFormShowsAHintAndMakesNothing();
    void checklistMustBeCompleteBeforeTheFirstPresentation();
    void aDoubtfulReadingIsAskedAboutOnce();
    void tabFollowsThePage();
};

void AppPagesTest::typedNumbersBecomeRatings_data()
{
    QTest::addColumn<QString>("typed");
    QTest::addColumn<int>("tenths");
    QTest::newRow("whole") << "5" << 50;
    QTest::newRow("point") << "5.4" << 54;
    QTest::newRow("comma") << "5,4" << 54;
    QTest::newRow("zero") << "0" << 0;
    QTest::newRow("top") << "10" << 100;
    QTest::newRow("top with decimal") << "10.0" << 100;
    QTest::newRow("spaces") << " 7.1 " << 71;
    QTest::newRow("leading zero") << "05" << 50;
    QTest::newRow("letters") << "5a" << -1;
    QTest::newRow("exponent") << "1e1" << -1;
    QTest::newRow("sign") << "+5" << -1;
    QTest::newRow("two signs") << "--5" << -1;
    QTest::newRow("only a point") << "." << -1;
    QTest::newRow("no whole part") << ".5" << -1;
    QTest::newRow("huge") << "99999999" << -1;
}

void AppPagesTest::typedNumbersBecomeRatings()
{
    QFETCH(QString, typed);
    QFETCH(int, tenths);
    const auto read = ratingFromText(typed, protocols::RatingScale{});
    const auto* rating = std::get_if<Tenths>(&read);
    QCOMPARE(rating ? rating->value : -1, tenths);
    if (!rating) QVERIFY(!std::get<NoRating>(read).why.isEmpty());
}

void AppPagesTest::pointsOnTheLineBecomeSteps()
{
    const protocols::RatingScale halves{Tenths{0}, Tenths{100}, Tenths{5}, 9, {}};
    QCOMPARE(ratingAt(0.0, halves).value, 0);
    QCOMPARE(ratingAt(0.52, halves).value, 50);
    QCOMPARE(ratingAt(0.53, halves).value, 55);
    QCOMPARE(ratingAt(1.7, halves).value, 100);
    QVERIFY(std::holds_alternative<NoRating>(ratingFromText("5.4", halves)));
    QCOMPARE(study::app::textOf(Tenths{-4}), QString("-0.4"));
}

/// The step alone does not tell: from 0.5 on, a step of 1 never meets a whole number.
void AppPagesTest::onlyAScaleOfWholeNumbersIsCalledOne()
{
    const auto range = [](int min, int max, int step) {
        return study::app::rangeText({Tenths{min}, Tenths{max}, Tenths{step}, 9, {}});
    };
    QCOMPARE(range(0, 100, 10), QString("from 0 to 10, whole numbers"));
    QCOMPARE(range(-30, 30, 10), QString("from -3 to 3, whole numbers"));
    QCOMPARE(range(5, 45, 10), QString("from 0.5 to 4.5 in steps of 1"));
    QCOMPARE(range(-5, 45, 10), QString("from -0.5 to 4.5 in steps of 1"));
    QCOMPARE(range(5, 45, 1), QString("from 0.5 to 4.5, one decimal"));
}

void AppPagesTest::startPageOpensAStudy()
{
    const auto folder = newStudy();
    ShownWindow shown;
    auto* line = &shown.widget<QLineEdit>("studyFolderField");
    QVERIFY(line->hasFocus() || shown.window.focusWidget() == line);
    QTest::keyClicks(line, QString::fromStdString(folder.folder.string()));
    QTest::keyClick(line, Qt::Key_Return);
    QCOMPARE(shown.window.currentPage()->objectName(), QString("studyPage"));
    QVERIFY(shown.window.windowTitle().contains("Small study"));
}

void AppPagesTest::startPageShowsWhyAFolderCannotBeOpened()
{
    ShownWindow shown;
    const auto message = [&] { return &shown.widget<QLabel>("startMessage"); };
    shown.gui.click("openButton");
    QVERIFY(message()->isVisible());
    shown.widget<QLineEdit>("studyFolderField").setText(filePath("not-there"));
    shown.gui.click("openButton");
    QCOMPARE(shown.window.currentPage()->objectName(), QString("startPage"));
    QVERIFY(message()->isVisible());
    QVERIFY2(message()->text().contains("not-there"), qPrintable(message()->text()));
}

void AppPagesTest::recentStudiesAreListed()
{
    const auto first = newStudy(), second = newStudy();
    AppOptions options;
    options.settings = std::make_shared<QSettings>(filePath("recent.ini"), QSettings::IniFormat);
    {
        MainWindow window(options);
        window.openStudy(first.folder);
        window.openStudy(second.folder);
        window.openStudy(first.folder);
    }
    MainWindow window(options);
    const auto* list = window.findChild<QListWidget*>("recentList");
    QCOMPARE(list->count(), 2);
    QCOMPARE(list->item(0)->text().toStdString(), first.folder.string());
    QCOMPARE(list->item(1)->text().toStdString(), second.folder.string());
}

QString AppPagesTest::placeAt(OpenWindow& open, int row)
{
    const auto& places = open.widget<QTreeWidget>("placesList");
    QStringList texts;
    for (int column = 0; column < 4; ++column) texts << places.topLevelItem(row)->text(column);
    return texts.join('|');
}

void AppPagesTest::nextParticipantTakesThePlaceAfterAWithdrawal()
{
    OpenWindow open(newStudy({.participants = 1}));
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    open.perform(WithdrawnEvent{"tired"});
    open.gui().pressKey(Qt::Key_Return);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QCOMPARE(placeAt(open, 0), QString("1|P01|withdrawn, place freed|6 of 24"));
    QCOMPARE(placeAt(open, 1), QString("1|–|free|"));
    open.gui().click("enrolButton");
    open.gui().pressKey(Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QCOMPARE(placeAt(open, 0), QString("1|P01|withdrawn, place freed|6 of 24"));
    QCOMPARE(placeAt(open, 1), QString("1|P02|in progress|0 of 24"));
}

void AppPagesTest::studyPageShowsEveryParticipant()
{
    OpenWindow open(newStudy({.participants = 3}));
    open.enrolAndBegin();
    open.playToEnd();
    open.window().startSession(protocols::ParticipantId("P02"));
    open.playTo("Presenting", "Q2");
    open.gui().pressKey(Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QCOMPARE(placeAt(open, 0), QString("1|P01|finished|24 of 24"));
    QCOMPARE(placeAt(open, 1), QString("2|P02|in progress|6 of 24"));
    QCOMPARE(placeAt(open, 2), QString("3|–|free|"));
    QCOMPARE(open.widget<QLineEdit>("participantField").text(), QString("P03"));
}

void AppPagesTest::aNewParticipantBesideAnOpenSessionIsAskedTwice()
{
    OpenWindow open(newStudy({.participants = 3}));
    open.enrolAndBegin();
    open.gui().pressKey(Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    QVERIFY2(open.message("studyMessage").contains("P02 as a new participant"), qPrintable(open.message("studyMessage")));
    open.widget<QLineEdit>("participantField").setText("P07");  // another code is another decision
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    open.gui().click("enrolButton");
    QVERIFY(open.window().session());
    QCOMPARE(open.view().participant, std::string("P07"));
}

void AppPagesTest::takenOrInvalidCodesAreNotEnrolled_data()
{
    QTest::addColumn<QString>("participant");
    QTest::newRow("taken") << "P01";
    QTest::newRow("taken in small letters") << "p01";
    QTest::newRow("taken in full-width letters") << QStringLiteral("Ｐ０１");
    QTest::newRow("empty") << "";
    QTest::newRow("a list") << "P02,P03";
    QTest::newRow("too long") << QString(65, 'n');
    QTest::newRow("a path") << "../P02";
}

void AppPagesTest::takenOrInvalidCodesAreNotEnrolled()
{
    QFETCH(QString, participant);
    OpenWindow open(newStudy());
    open.enrolAndBegin();
    open.gui().pressKey(Qt::Key_Q);
    QTRY_COMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    open.widget<QLineEdit>("participantField").setText(participant);
    for (int click = 0; click < 2; ++click) open.gui().click("enrolButton");  // a good code would ask once
    QVERIFY(!open.window().session());
    QVERIFY(!open.message("studyMessage").isEmpty());
}

void AppPagesTest::codesOfEveryScriptAreEnrolled_data()
{
    QTest::addColumn<QString>("participant");
    QTest::newRow("umlaut") << QStringLiteral("Müller");
    QTest::newRow("Japanese") << QStringLiteral("参加者一");
    QTest::newRow("64 letters") << QString(64, 'n');
}

/// As `replay` takes them.
void AppPagesTest::codesOfEveryScriptAreEnrolled()
{
    QFETCH(QString, participant);
    OpenWindow open(newStudy());
    open.widget<QLineEdit>("participantField").setText("." + participant.left(60));
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    QVERIFY2(open.message("studyMessage").contains("begins with a dot"), qPrintable(open.message("studyMessage")));
    open.widget<QLineEdit>("participantField").setText("NA");  // it has no more than 64 letters
    open.gui().click("enrolButton");
    QVERIFY2(open.message("studyMessage").endsWith("Type another code, such as P01."), qPrintable(open.message("studyMessage")));
    open.widget<QLineEdit>("participantField").setText(participant);
    open.gui().click("enrolButton");
    QVERIFY(open.window().session());
}

namespace {

constexpr const char* passphrase = "four plain short words";

void typePassphrase(ShownWindow& shown)
{
    for (const char* line : {"passphraseField", "passphraseAgainField"}) {
        shown.gui.focusOn(line);
        shown.gui.type(passphrase);
    }
}

}  // namespace

void AppPagesTest::newStudyIsMadeOnAWorkerThread()
{
    const auto made = newStudy();
    AppOptions options;
    NewStudyRequest asked;
    QThread* thread = nullptr;
    options.makeStudy = [&](const NewStudyRequest& request, const MakingProgress& progress) {
        asked = request;
        thread = QThread::currentThread();
        progress(0.5, "drawing the running orders");
        std::vector<std::string> remarks(9, "the image of F02 under f has one level: no participant can feel a texture on it");
        remarks.front() = "<b>photograph 3</b>\x1b of F01 is cut " + std::string(400, 'x');
        return remarks;
    };
    ShownWindow shown(options);
    shown.gui.click("newStudyButton");
    shown.gui.type(QString::fromStdString(made.folder.string()));
    shown.gui.focusOn("datasetField");
    shown.gui.type("/data/fabrics");
    shown.gui.focusOn("seedField");
    shown.widget<QLineEdit>("seedField").clear();
    shown.gui.type("42");
    shown.gui.focusOn("participantsField");
    shown.gui.type("4");
    // A whole line that was copied: no terminal and no file gives the end of a line back.
    for (const char* line : {"passphraseField", "passphraseAgainField"})
        shown.widget<QLineEdit>(line).setText(passphrase + QString("\n"));
    shown.gui.focusOn("protocolField");
    shown.gui.pressKey(Qt::Key_Return);
    QTRY_COMPARE(shown.window.currentPage()->objectName(), QString("studyPage"));
    QCOMPARE(asked, (NewStudyRequest{made.folder, "/data/fabrics", std::nullopt, 4, 42, passphrase}));
    QVERIFY(thread != QThread::currentThread());
    const QString remarks = shown.widget<QLabel>("studyRemarks").text();
    QVERIFY(shown.widget<QLabel>("studyRemarks").isVisible());
    QCOMPARE(remarks.count('\n'), 6);
    QVERIFY2(remarks.contains("before the first session") && remarks.contains("<b>photograph 3</b>\\x1b of F01 is cut") &&
                 remarks.contains("has one level") && remarks.endsWith("And 4 more."),
             qPrintable(remarks));
}

void AppPagesTest::pageShowsWhyTheStudyCouldNotBeMade()
{
    AppOptions options;
    options.makeStudy = [](const NewStudyRequest& request, const MakingProgress&) -> std::vector<std::string> {
        throw protocols::badInput({.what = "no photographs", .where = request.dataset.string(), .expected = {}, .nextStep = {}});
    };
    ShownWindow shown(options);
    shown.gui.click("newStudyButton");
    shown.gui.type("/tmp/new-study");
    shown.gui.focusOn("datasetField");
    shown.gui.type("/data/poor");
    typePassphrase(shown);
    shown.gui.click("makeButton");
    const auto* message = &shown.widget<QLabel>("newStudyMessage");
    QTRY_VERIFY(message->isVisible());
    QVERIFY(message->text().contains("no photographs"));
    QVERIFY(message->text().contains("/data/poor"));
    QCOMPARE(shown.window.currentPage()->objectName(), QString("newStudyPage"));
    QCOMPARE(shown.widget<QLineEdit>("datasetField").text(), QString("/data/poor"));  // nothing typed is lost
    QVERIFY(shown.widget<QPushButton>("makeButton").isEnabled());
    QCOMPARE(shown.window.focusWidget()->objectName(), QString("datasetField"));  // that the message names
}

/// Tab visits the page from its top to its bottom and from left to right.
void AppPagesTest::tabFollowsThePage()
{
    const auto namesFrom = [](QWidget& first, int count) {
        QStringList names;
        for (QWidget* widget = &first; names.size() < count; widget = widget->nextInFocusChain())
            if (widget->focusPolicy() & Qt::TabFocus && widget->isVisible()) names << widget->objectName();
        return names;
    };
    AppOptions options;
    options.makeStudy = [](const NewStudyRequest&, const MakingProgress&) { return std::vector<std::string>(); };
    ShownWindow shown(options);
    shown.gui.click("newStudyButton");
    const QStringList wanted{"newStudyFolderField",
                             "newStudyFolderFieldBrowse",
                             "datasetField",
                             "datasetFieldBrowse",
                             "protocolField",
                             "protocolFieldBrowse",
                             "participantsLanguageList",
                             "participantsField",
                             "seedField",
                             "passphraseField",
                             "passphraseAgainField",
                             "makeButton",
                             "editProtocolButton",
                             "backButton"};
    QCOMPARE(namesFrom(shown.widget<QLineEdit>("newStudyFolderField"), static_cast<int>(wanted.size())), wanted);
    OpenWindow open(newStudy());
    const QStringList order = namesFrom(open.widget<QPushButton>("studyKeysButton"), 5);
    QVERIFY2(order.contains("closeStudyButton"), qPrintable(order.join(' ')));
    QVERIFY2(!order.contains("toolsButton") || order.indexOf("toolsButton") < order.indexOf("closeStudyButton"),
             qPrintable(order.join(' ')));
}

void AppPagesTest::makingCanBeStopped()
{
    AppOptions options;
    std::atomic<bool> isUnwound = false;
    options.makeStudy = [&](const NewStudyRequest&, const MakingProgress& progress) -> std::vector<std::string> {
        struct Unwinding {
            std::atomic<bool>& flag;
            ~Unwinding() { flag = true; }
        } unwinding{isUnwound};
        for (;;) {
            progress(0.1, "working");
            QThread::msleep(1);
        }
    };
    ShownWindow shown(options);
    shown.gui.click("newStudyButton");
    shown.gui.type("/tmp/new-study");
    shown.gui.focusOn("datasetField");
    shown.gui.type("/data/fabrics");
    typePassphrase(shown);
    shown.gui.pressKey(Qt::Key_Return);
    QTRY_COMPARE(shown.widget<QLabel>("makingText").text(), QString("working"));
    shown.gui.pressKey(Qt::Key_Escape);
    QTRY_VERIFY(isUnwound);
    QTRY_VERIFY(shown.widget<QLabel>("newStudyMessage").isVisible());
    QVERIFY(shown.widget<QLabel>("newStudyMessage").text().contains("stopped"));
}

void AppPagesTest::incompleteFormShowsAHintAndMakesNothing()
{
    AppOptions options;
    bool isMade = false;
    options.makeStudy = [&](const NewStudyRequest&, const MakingProgress&) {
        isMade = true;
        return std::vector<std::string>();
    };
    ShownWindow shown(options);
    shown.gui.click("newStudyButton");
    const auto* message = &shown.widget<QLabel>("newStudyMessage");
    const auto messageAfterEnter = [&] {
        shown.gui.pressKey(Qt::Key_Return);
        return message->isVisible() ? message->text() : QString();
    };
    QVERIFY(messageAfterEnter().contains("study folder"));
    shown.gui.type("/tmp/s");
    QVERIFY(messageAfterEnter().contains("data set"));
    shown.gui.type("/tmp/d");
    shown.widget<QLineEdit>("seedField").setText("-3");
    QVERIFY(messageAfterEnter().contains("seed"));
    shown.widget<QLineEdit>("seedField").setText("3");
    QVERIFY(messageAfterEnter().contains("passphrase is too short"));
    for (const auto& [typed, fault] : {std::pair{"ääääããã", "too short"},  // 14 bytes
                                       {"          ", "only blanks"},
                                       {"four words\tof wool", "nobody can type"},
                                       {"four words of wool\n\n", "nobody can type"}}) {
        shown.widget<QLineEdit>("passphraseField").setText(QString::fromUtf8(typed));
        shown.widget<QLineEdit>("passphraseAgainField").setText(QString::fromUtf8(typed));
        QVERIFY2(messageAfterEnter().contains(fault), typed);
    }
    shown.widget<QLineEdit>("passphraseAgainField").clear();
    shown.widget<QLineEdit>("passphraseField").setText(passphrase);
    QVERIFY(messageAfterEnter().contains("passphrases differ"));
    shown.widget<QLineEdit>("passphraseAgainField").setText(passphrase);
    shown.widget<QLineEdit>("participantsField").setText("0");
    QVERIFY(messageAfterEnter().contains("number of participants"));
    QTest::qWait(20);
    QVERIFY(!isMade);
}

void AppPagesTest::checklistMustBeCompleteBeforeTheFirstPresentation()
{
    QWidget window;
    ChecklistPage& page = *new ChecklistPage(&window);
    window.show();
    SessionFacts facts;
    facts.checklist = QStringList{"hands are washed", "the mask is on"};
    facts.readings = QStringList{"temperature in °C", "relative humidity in %"};
    page.begin(facts);
    std::optional<ChecklistDone> done;
    QString hint;
    connect(&page, &StagePage::eventRequested, this, [&](const EventBody& event) { done = std::get<ChecklistDone>(event); });
    connect(&page, &StagePage::hinted, this, [&](const QString& text) { hint = text; });
    const auto boxes = page.findChildren<QCheckBox*>();
    QCOMPARE(boxes.size(), qsizetype(2));
    boxes[0]->click();
    page.pressKey(Qt::Key_Return);
    QVERIFY(hint.contains("the mask is on"));
    QVERIFY(!done);
    boxes[1]->click();
    page.findChild<QLineEdit*>("reading1")->setText("21.5");
    page.pressKey(Qt::Key_Return);
    QVERIFY(!done);
    QVERIFY2(hint.contains("“relative humidity in %”"), qPrintable(hint));
    page.pressKey(Qt::Key_Return);
    QVERIFY(done.has_value());
    QCOMPARE(done->ticked, (std::vector<std::string>{"hands are washed", "the mask is on"}));
    QCOMPARE(done->readings, (std::map<std::string, std::string>{{"temperature in °C", "21.5"}}));
}

void AppPagesTest::aDoubtfulReadingIsAskedAboutOnce()
{
    QWidget window;
    ChecklistPage& page = *new ChecklistPage(&window);
    window.show();
    SessionFacts facts;
    facts.readings = QStringList{"temperature in °C", "the weather"};
    page.begin(facts);
    std::optional<ChecklistDone> done;
    QString hint;
    connect(&page, &StagePage::eventRequested, this, [&](const EventBody& event) { done = std::get<ChecklistDone>(event); });
    connect(&page, &StagePage::hinted, this, [&](const QString& text) { hint = text; });
    auto& temperature = *page.findChild<QLineEdit*>("reading1");
    temperature.setText("hot");
    page.findChild<QLineEdit*>("reading2")->setText("dull");  // names no unit
    page.pressKey(Qt::Key_Return);
    QVERIFY(!done);
    QCOMPARE(hint, QString("“hot” is not a number. Press Enter again to store it."));
    temperature.setText("warm");  // another text is asked about again
    page.pressKey(Qt::Key_Return);
    QVERIFY(!done && hint.startsWith("“warm”"));
    page.pressKey(Qt::Key_Return);
    QVERIFY(done.has_value());
    QCOMPARE(done->readings, (std::map<std::string, std::string>{{"temperature in °C", "warm"}, {"the weather", "dull"}}));
    for (const char* number : {"21", "21.5", "21,5", "-3", "21.5 °C"}) {
        done.reset();
        temperature.setText(number);
        page.pressKey(Qt::Key_Return);
        QVERIFY2(done.has_value(), number);
    }
}

QTEST_MAIN(AppPagesTest)
#include "app_pages_test.moc"
