// The window at a station of a study on a server: joined by its address, and at every moment it says where the answers are. The
// monitor of such a study: its stations, also while the server is away.
#include <QCryptographicHash>
#include <QElapsedTimer>
#include <QFrame>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRegularExpression>
#include <QTest>
#include <QTimer>
#include <QTreeWidget>
#include <algorithm>
#include <thread>

#include "database/server/server_connection.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "database/study_store.h"
#include "study/app/pages/monitor_window.h"
#include "study/app/pages/start_page.h"
#include "study/app/pages/study_page.h"
#include "study/app/server_bar.h"
#include "study/records/stored_study.h"
#include "study/records/study_status.h"
#include "tests/support/error_text.h"
#include "tests/support/open_window.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/server/cut_network.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"

using namespace tests::support;
using database::ServerConnection;
using database::StudyStore;
using study::app::MonitorWindow;

namespace {

/// A station that is played by calls of the server.
struct PlayedStation {
    PlayedStation(const std::string& address, const QString& name, const QString& participant = {})
        : server(database::serverAddressFrom(address))
    {
        const QString token = QCryptographicHash::hash(name.toUtf8(), QCryptographicHash::Sha256).toHex();
        server.call("join_study", {name, token, "test"});
        if (!participant.isEmpty()) server.call("claim", {participant, "human"});
    }
    void giveSign(int waiting) const { server.call("sign_of_life", {waiting}); }

    ServerConnection server;
};

/// The cells of a table, a row a line, joined by "|".
QStringList rowsOf(const MonitorWindow& monitor, const char* table)
{
    const auto& tree = *monitor.findChild<QTreeWidget*>(table);
    QStringList rows;
    for (int row = 0; row < tree.topLevelItemCount(); ++row) {
        QStringList cells;
        for (int column = 0; column < tree.columnCount(); ++column) cells << tree.topLevelItem(row)->text(column);
        rows << cells.join('|');
    }
    return rows;
}

/// The row whose first cell is this station; empty if there is none.
QString stationRow(const MonitorWindow& monitor, const QString& station)
{
    for (const QString& row : rowsOf(monitor, "stationRows"))
        if (row.startsWith(station + '|')) return row;
    return {};
}

QString placeRow(const MonitorWindow& monitor, int place) { return rowsOf(monitor, "monitorRows").value(place - 1); }

QString messageIn(const MonitorWindow& monitor)
{
    const auto* message = monitor.findChild<QLabel*>("monitorMessage");
    return message->isVisible() ? message->text() : QString();
}

constexpr int waitMs = 15000;

}  // namespace

class AppServerTest : public WindowTest {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void anAddressOnTheStartPageJoinsTheStudy();
    void thePageSaysWhereTheAnswersAre();
    void thePageNoticesASilentServerByItself();
    void aSessionThatAnotherStationContinuedEndsOnThePage();
    void theSecondStationDoesNotEnrolTheSameCode();
    void aPlaceThatWaitsForTheOwnerIsShown();
    void aWithdrawalAtAStationLeavesThePlaceToTheOwner();
    void aStationOffersNoRehearsal();
    void theBarSaysWhyTheServerTakesNothing();
    void aServerUnderAnotherNameGetsWhatWaits();
    void aWrongAddressIsOneLineOnTheStartPage();
    void theMonitorShowsStationsAtWorkLostAndWithEntries();
    void theMonitorShowsEntriesOfAnEarlierConnection();
    void theMonitorFollowsSessionsAtTheStations();
    void aMonitorNeedsNoFolder();
    void aLoginWithoutTheRoleIsOneLineInTheMonitor();
    void theMonitorOutlivesTheServer();
    void aSilentServerDoesNotStopTheMonitor_data();
    void aSilentServerDoesNotStopTheMonitor();
    void rowsThatComeLateDoNotStopTheMonitor();
    void theProgramOfAStationIsShownWhereTheServerGivesIt();

private:
    database::StudyFolder studyOnServer(const std::string& name)
    {
        const database::StudyFolder folder = newStudy();
        moveToServer(folder, database::serverAddressFrom(m_server->address(name)), "owner");
        return folder;
    }
    void makeLogin(const char* login, const char* role, const std::string& study)
    {
        const auto address = database::serverAddressFrom(m_server->address(study));
        ServerConnection(address).run(
            QStringLiteral("DO $$ BEGIN CREATE ROLE %1 LOGIN; EXCEPTION WHEN duplicate_object THEN NULL; END $$").arg(login));
        makeRoles(address, {{login, role}});
    }
    std::unique_ptr<PrivateServer> m_server;
};

void AppServerTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    qputenv("XDG_DATA_HOME", filePath("data").toUtf8());
    m_server = std::make_unique<PrivateServer>();
}

void AppServerTest::anAddressOnTheStartPageJoinsTheStudy()
{
    const database::StudyFolder owner = studyOnServer("joined");
    OpenWindow open({m_server->address("joined")});
    QVERIFY(open.window().study());
    QVERIFY(open.window().findChild<QLabel*>("serverBar")->text().contains("every answer is on the server"));
    open.enrolAndBegin();
    open.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

void AppServerTest::thePageSaysWhereTheAnswersAre()
{
    const database::StudyFolder owner = studyOnServer("cut");
    CutNetwork network(m_server->port());
    OpenWindow open({m_server->address("cut", "owner", network.port())});
    auto* bar = open.window().findChild<QLabel*>("serverBar");
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    network.cut();
    open.perform(open.nextEvent());  // touched
    open.perform(open.nextEvent());  // answered
    QVERIFY2(bar->isVisible() && bar->text().contains("cannot be reached") && bar->text().contains("wait on this computer: "),
             qPrintable(bar->text()));
    network.mend();
    QTRY_VERIFY_WITH_TIMEOUT(bar->text().contains("every answer is on the server"), 20000);
    open.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
}

void AppServerTest::thePageNoticesASilentServerByItself()
{
    const database::StudyFolder owner = studyOnServer("hushed");
    CutNetwork network(m_server->port());
    OpenWindow open({m_server->address("hushed", "owner", network.port())});
    const auto* bar = open.window().findChild<QLabel*>("serverBar");
    open.enrolAndBegin();
    QVERIFY(bar->text().contains("every answer is on the server"));
    network.silence();
    QTRY_VERIFY_WITH_TIMEOUT(bar->text().contains("cannot be reached. No entry waits on this computer"), 8000);
    network.mend();
    QTRY_VERIFY_WITH_TIMEOUT(bar->text().contains("every answer is on the server"), 20000);
    open.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
}

void AppServerTest::aSessionThatAnotherStationContinuedEndsOnThePage()
{
    const database::StudyFolder owner = studyOnServer("continued");
    CutNetwork network(m_server->port());
    OpenWindow open({m_server->address("continued", "owner", network.port())});
    const auto* bar = open.window().findChild<QLabel*>("serverBar");
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    network.cut();
    open.perform(open.nextEvent());  // touched
    open.perform(open.nextEvent());  // answered
    {
        const QString place = filePath("continued-other");
        const database::StudyFolder other{
            joinStudy(database::serverAddressFrom(m_server->address("continued")), place.toStdString(), "other").folder};
        QTRY_VERIFY_WITH_TIMEOUT(errorOf([&] { ServerSession(other, "P01"); }).isEmpty(), 40000);
        ServerSession(other, "P01").playUntilAnswers(6);
    }
    const std::size_t answers = readStudy(owner).answerCount();
    network.mend();
    QTRY_VERIFY_WITH_TIMEOUT(!open.window().session(), 20000);
    QVERIFY2(open.message("studyMessage").contains("so this session cannot go on"), qPrintable(open.message("studyMessage")));
    QTRY_VERIFY2_WITH_TIMEOUT(bar->text().startsWith("The server refused answers of P01") && bar->text().contains("not-sent-P01"),
                              qPrintable(bar->text()), 8000);
    QCOMPARE(readStudy(owner).answerCount(), answers);
    open.window().startSession(protocols::ParticipantId("P01"));
    open.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
    QVERIFY(bar->text().contains("not-sent-P01"));
}

/// Both pages propose P01. The list of the second is older than the enrolment at the first.
void AppServerTest::theSecondStationDoesNotEnrolTheSameCode()
{
    studyOnServer("twice");
    OpenWindow open({m_server->address("twice")});
    {
        const QString place = filePath("twice-other");
        ServerSession other(
            {joinStudy(database::serverAddressFrom(m_server->address("twice")), place.toStdString(), "other").folder}, "P01");
        other.playUntilAnswers(2);
    }
    QCOMPARE(open.widget<QLineEdit>("participantField").text(), QString("P01"));
    open.gui().click("enrolButton");
    QVERIFY(!open.window().session());
    QVERIFY2(open.message("studyMessage").contains("P01 is already enrolled"), qPrintable(open.message("studyMessage")));
    open.window().requestSession(protocols::ParticipantId("P01"), study::app::MainWindow::Enrolment::NewOnly);
    QTRY_VERIFY2(open.message("studyMessage").contains("P01 was enrolled at another station"),
                 qPrintable(open.message("studyMessage")));
    QVERIFY(!open.window().session());
}

/// Both places were seen at a station, so that nobody gets them before the owner has looked.
void AppServerTest::aPlaceThatWaitsForTheOwnerIsShown()
{
    const database::StudyFolder owner = studyOnServer("held");
    makeLogin("anna", "experimenter", "held");
    const std::string address = m_server->address("held", "anna");
    {
        const QString place = filePath("held-other");
        const database::StudyFolder other{joinStudy(database::serverAddressFrom(address), place.toStdString(), "other").folder};
        for (const char* person : {"P01", "P02"}) {
            ServerSession session(other, person);
            session.playUntilAnswers(2);
            session.send(study::session::WithdrawnEvent{"no time"});
        }
    }
    const auto statesIn = [](OpenWindow& open) {
        const auto& places = open.widget<QTreeWidget>("placesList");
        QStringList states;
        for (int row = 0; row < places.topLevelItemCount(); ++row)
            states << places.topLevelItem(row)->text(1) + " " + places.topLevelItem(row)->text(2);
        return states;
    };
    const auto statusOfOwner = [&] {
        return QString::fromStdString(
            study::records::textOf(study::records::statusOf(study::records::openStudy(owner.folder), {})));
    };
    const QStringList serverStatus{"server", "status", QString::fromStdString(m_server->address("held"))};
    const QString wait =
        "places of participants who withdrew wait for the owner: 2; `vis2hap server roles ADDRESS --release-held`";
    QVERIFY2(statusOfOwner().contains("slot  1  waits for the owner"), qPrintable(statusOfOwner()));
    QVERIFY(support::mustRun(serverStatus).out.contains(wait));
    MonitorWindow monitor(owner.folder, {});
    monitor.show();
    {
        OpenWindow open({address});
        QCOMPARE(statesIn(open), QStringList({"P01 withdrawn, waits for the owner", "P02 withdrawn, waits for the owner"}));
        QVERIFY(!open.widget<QPushButton>("enrolButton").isEnabled());
        const auto& hint = *open.widget<QFrame>("enrolCard").findChild<QLabel*>("cardHint");
        QVERIFY(QString(hint.text()).remove(QChar(0x2060)).contains("vis2hap server roles ADDRESS --release-held"));
        QVERIFY2(!hint.text().contains("--"), "a line could end within the option");
        open.window().resize(800, 600);
        qobject_cast<study::app::StudyPage*>(open.window().currentPage())->focusFirst();
        QTRY_COMPARE(hint.visibleRegion().boundingRect(), hint.rect());
        open.window().requestSession(protocols::ParticipantId("P01"), study::app::MainWindow::Enrolment::NewOnly);
        QTRY_VERIFY2(open.message("studyMessage").contains("participant P01 has withdrawn"),
                     qPrintable(open.message("studyMessage")));
    }
    QTRY_VERIFY_WITH_TIMEOUT(placeRow(monitor, 1).startsWith("1|P01|withdrawn, waits for the owner|"), waitMs);
    QTRY_COMPARE_WITH_TIMEOUT(rowsOf(monitor, "monitorRows").size(), 2, waitMs);
    QCOMPARE(releaseHeld(database::serverAddressFrom(m_server->address("held"))).size(), std::size_t{2});
    QVERIFY2(statusOfOwner().contains("slot  1  free"), qPrintable(statusOfOwner()));
    QVERIFY(!support::mustRun(serverStatus).out.contains("wait for the owner"));
    OpenWindow open({address});
    QCOMPARE(statesIn(open), QStringList({"P01 withdrawn, place freed", "– free", "P02 withdrawn, place freed", "– free"}));
    QVERIFY(open.widget<QPushButton>("enrolButton").isEnabled());
    QVERIFY(!open.widget<QFrame>("enrolCard").findChild<QLabel*>("cardHint")->text().contains("server roles"));
    QTRY_COMPARE_WITH_TIMEOUT(rowsOf(monitor, "monitorRows").size(), 4, waitMs);
    QVERIFY(placeRow(monitor, 1).startsWith("1|P01|withdrawn|"));
}

/// The next participant at the station does not get the place.
void AppServerTest::aWithdrawalAtAStationLeavesThePlaceToTheOwner()
{
    const database::StudyFolder owner = studyOnServer("left-place");
    makeLogin("anna", "experimenter", "left-place");
    OpenWindow open({m_server->address("left-place", "anna")});
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    const auto isShown = [&](const QString& words) {
        return std::ranges::any_of(textsIn(*open.window().currentPage()),
                                   [&](const QString& text) { return text.contains(words); });
    };
    open.gui().pressKey(Qt::Key_W);
    QVERIFY(isShown("the study's owner gives the place out again"));
    QVERIFY(!isShown("another participant can take the place"));
    QTest::keyClick(open.window().focusWidget(), Qt::Key_Escape);
    open.perform(study::session::WithdrawnEvent{"no time"});
    QVERIFY(isShown("The study's owner gives this place out again."));
    QVERIFY(!isShown("Another participant can take this place."));
}

/// A station knows neither the images nor the codes of the pieces, and their names would tell the operator the fabrics.
void AppServerTest::aStationOffersNoRehearsal()
{
    StudyRecipe recipe;
    recipe.hasSwatchCodes = true;
    const database::StudyFolder owner = newStudy(recipe);
    moveToServer(owner, database::serverAddressFrom(m_server->address("unrehearsed")), "owner");
    int made = 0;
    study::app::AppOptions options;
    options.makeRehearsal = [&](const std::filesystem::path&) {
        ++made;
        return std::shared_ptr<const std::filesystem::path>();
    };
    OpenWindow open({m_server->address("unrehearsed")}, options);
    const auto& button = open.widget<QPushButton>("rehearsalButton");
    QVERIFY(!button.isEnabled());
    open.gui().pressKey(Qt::Key_F8);
    QCOMPARE(open.window().currentPage()->objectName(), QString("studyPage"));
    QVERIFY2(open.message("studyMessage").contains("no rehearsal at a station"), qPrintable(open.message("studyMessage")));
    QCOMPARE(button.toolTip(), QString("<span>%1</span>").arg(open.message("studyMessage")));  // so that it breaks
    QCOMPARE(made, 0);
    QCOMPARE(open.window().study()->codesOnPieces(), QStringList());
}

void AppServerTest::theBarSaysWhyTheServerTakesNothing()
{
    study::app::ServerBar bar(nullptr);
    database::StationStore::Link link;
    link.isUp = true;
    link.waiting = 2;
    link.station = "left";
    const auto textFor = [&] {
        bar.present(link);
        return bar.text();
    };
    QCOMPARE(textFor(), QString("Station left: entries wait on this computer: 2. They are being sent."));
    link.isUp = false;
    link.isRefused = true;
    link.fault = "participant P02 is at station right";
    QVERIFY2(textFor().startsWith("Station left: the server takes nothing from this station now. Entries that wait on this "
                                  "computer: 2."),
             qPrintable(textFor()));
    QVERIFY(textFor().endsWith("Reason: participant P02 is at station right"));
    QVERIFY(!textFor().contains("every answer is on the server"));
    link.setAside = "The server refused answers of P01 that waited here (why). They are kept in not-sent-P01-1.json.";
    QVERIFY(textFor().startsWith("The server refused answers of P01"));
    link = {};
    link.isUp = true;
    link.station = "left";
    link.clockAhead = std::chrono::seconds(-61);
    QVERIFY2(textFor().contains("61 s behind the server's clock"), qPrintable(textFor()));
    link.lostAfter = 95;
    QVERIFY2(textFor().startsWith("The server lost entries after entry 95 that this station had seen. Ask the study's owner"),
             qPrintable(textFor()));
    link.lostAfter.reset();
    link.clockAhead = std::chrono::seconds(59);
    QCOMPARE(textFor(), QString("Station left: every answer is on the server."));
}

/// The old name is gone for good, and an answer waits that no page shows any more.
void AppServerTest::aServerUnderAnotherNameGetsWhatWaits()
{
    const database::StudyFolder owner = studyOnServer("renamed");
    CutNetwork network(m_server->port());
    {
        OpenWindow open({m_server->address("renamed", "owner", network.port())});
        open.enrolAndBegin();
        open.playTo("Presenting", "Q2");
        network.cut();
        open.perform(open.nextEvent());  // touched
        open.perform(open.nextEvent());  // answered
        QVERIFY(open.window().findChild<QLabel*>("serverBar")->text().contains("wait on this computer: "));
    }
    const std::size_t answers = readStudy(owner).answerCount();
    OpenWindow open({"postgresql://owner@localhost:" + std::to_string(m_server->port()) + "/lab?study=renamed"});
    QVERIFY(open.window().findChild<QLabel*>("serverBar")->text().contains("every answer is on the server"));
    QCOMPARE(readStudy(owner).answerCount(), answers + 1);
    open.window().startSession(protocols::ParticipantId("P01"));
    open.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

void AppServerTest::aWrongAddressIsOneLineOnTheStartPage()
{
    ShownWindow shown;
    Q_EMIT shown.window.startPage().openRequested(QString::fromStdString(m_server->address("nothing")));
    const QString text = shown.widget<QLabel>("startMessage").text();
    QVERIFY2(text.contains("no study nothing"), qPrintable(text));
    QVERIFY(!shown.window.study());
}

void AppServerTest::theMonitorShowsStationsAtWorkLostAndWithEntries()
{
    const database::StudyFolder owner = studyOnServer("watched");
    const std::string address = m_server->address("watched");
    const PlayedStation left(address, "left", "P01"), right(address, "right"), quiet(address, "quiet"), slow(address, "slow");
    std::make_unique<PlayedStation>(address, "gone", "P02").reset();
    MonitorWindow monitor(owner.folder, {});
    monitor.show();
    left.giveSign(0);
    right.giveSign(3);
    quiet.giveSign(2);
    left.server.run("UPDATE @schema@.server_stations SET last_seen = last_seen - interval '30 seconds' WHERE station = 'quiet'");
    left.server.run("UPDATE @schema@.server_stations SET last_seen = last_seen - interval '8 seconds' WHERE station = 'slow'");
    monitor.refresh();
    const auto begins = [&](const QString& station, const QString& cells) {
        return stationRow(monitor, station).startsWith(station + '|' + cells);
    };
    QTRY_VERIFY_WITH_TIMEOUT(begins("left", "connected|P01|just now|0|"), waitMs);
    QTRY_VERIFY2_WITH_TIMEOUT(begins("right", "connected|–|just now|3|"), qPrintable(stationRow(monitor, "right")), waitMs);
    QTRY_VERIFY_WITH_TIMEOUT(begins("gone", "lost|P02|just now|0 at that time|"), waitMs);
    QTRY_VERIFY2_WITH_TIMEOUT(begins("quiet", "lost|–|3"), qPrintable(stationRow(monitor, "quiet")), waitMs);
    QVERIFY2(stationRow(monitor, "quiet").contains(" s ago|2 at that time|"), qPrintable(stationRow(monitor, "quiet")));
    static const QRegularExpression stillConnected("^slow\\|connected\\|–\\|(8|9|1\\d) s ago\\|0\\|");
    QTRY_VERIFY2_WITH_TIMEOUT(stationRow(monitor, "slow").contains(stillConnected), qPrintable(stationRow(monitor, "slow")),
                              waitMs);
    QVERIFY(monitor.findChild<QTreeWidget*>("stationRows")->isVisible());
    QCOMPARE(messageIn(monitor), QString());
    QTRY_VERIFY_WITH_TIMEOUT(placeRow(monitor, 1).startsWith("1|P01|welcome|"), waitMs);
}

/// A new connection has the row of the station, and what waits is that of the connection before it.
void AppServerTest::theMonitorShowsEntriesOfAnEarlierConnection()
{
    const database::StudyFolder owner = studyOnServer("owed");
    const PlayedStation left(m_server->address("owed"), "left");
    left.giveSign(0);
    left.server.run(
        "INSERT INTO @schema@.server_owed(token, participant, station, login, queue_length) VALUES "
        "(repeat('e', 64), 'P02', 'left', 'owner', 3), (repeat('f', 64), '', 'right', 'owner', 2)");
    MonitorWindow monitor(owner.folder, {});
    monitor.show();
    QTRY_COMPARE_WITH_TIMEOUT(rowsOf(monitor, "stationRows").size(), qsizetype{3}, waitMs);
    QVERIFY2(stationRow(monitor, "left").startsWith("left|connected|–|"), qPrintable(stationRow(monitor, "left")));
    QCOMPARE(rowsOf(monitor, "stationRows").mid(1), QStringList({"left|lost|P02||may wait|", "right|lost|–||may wait|"}));
}

void AppServerTest::theMonitorFollowsSessionsAtTheStations()
{
    const database::StudyFolder owner = studyOnServer("followed");
    study::app::AppOptions options;
    options.readFlags = [](const StudyStore& store) {
        return std::vector<study::app::MonitorFlag>{{"", "too_fast", std::to_string(store.answers().size()) + " answers"}};
    };
    MonitorWindow monitor(owner.folder, options);
    monitor.show();
    const auto* flags = monitor.findChild<QLabel*>("flags");
    QTRY_COMPARE_WITH_TIMEOUT(flags->text(), QString("too fast: 0 answers"), waitMs);
    QCOMPARE(rowsOf(monitor, "stationRows").value(0), QString("none is connected|||||"));
    OpenWindow open({m_server->address("followed")});
    open.enrolAndBegin();
    open.playTo("Presenting", "Q2");
    QTRY_VERIFY_WITH_TIMEOUT(placeRow(monitor, 1).startsWith("1|P01|question Q2|"), waitMs);
    QTRY_VERIFY_WITH_TIMEOUT(rowsOf(monitor, "stationRows").value(0).contains("|connected|P01|"), waitMs);
    QTRY_VERIFY_WITH_TIMEOUT(!flags->text().contains(" 0 answers"), waitMs);
    open.window().close();
}

void AppServerTest::aMonitorNeedsNoFolder()
{
    const database::StudyFolder owner = studyOnServer("looked");
    makeLogin("moni", "monitor", "looked");
    const PlayedStation left(m_server->address("looked"), "left", "P01");
    ShownWindow shown;
    shown.widget<QLineEdit>("studyFolderField").setText(QString::fromStdString(m_server->address("looked", "moni")));
    shown.gui.click("monitorButton");
    const MonitorWindow* monitor = nullptr;
    for (const QWidget* top : QApplication::topLevelWidgets())
        if (const auto* found = qobject_cast<const MonitorWindow*>(top)) monitor = found;
    QVERIFY(monitor && monitor->isVisible());
    QTRY_COMPARE_WITH_TIMEOUT(placeRow(*monitor, 1), QString("1|P01|in progress||0|||"), waitMs);
    QCOMPARE(placeRow(*monitor, 2), QString("2|–|free|||||"));
    QVERIFY2(stationRow(*monitor, "left").startsWith("left|connected|P01|"), qPrintable(stationRow(*monitor, "left")));
    QVERIFY(monitor->windowTitle().startsWith("looked"));
    QCOMPARE(monitor->findChild<QLabel*>("monitorSummary")->text(), QString("Answers: 0"));
    QVERIFY(!monitor->findChild<QLabel*>("flags")->isVisible());  // they need the owner's folder
    const auto& rows = *monitor->findChild<QTreeWidget*>("monitorRows");
    for (const int unknown : {3, 5, 6, 7}) QVERIFY(rows.isColumnHidden(unknown));
    QVERIFY(!monitor->findChild<QLabel*>("monitorHint")->text().contains("Missing"));
    shown.window.close();
}

void AppServerTest::aLoginWithoutTheRoleIsOneLineInTheMonitor()
{
    const database::StudyFolder owner = studyOnServer("refused");
    makeLogin("anna", "experimenter", "refused");
    MonitorWindow monitor(m_server->address("refused", "anna"), {});
    monitor.show();
    QTRY_VERIFY_WITH_TIMEOUT(messageIn(monitor).contains("this login may not do this"), waitMs);
    QVERIFY(!messageIn(monitor).contains('\n'));
    QVERIFY_EXCEPTION_THROWN(MonitorWindow("postgresql://anna:secret@host/lab", {}), protocols::Error);
}

void AppServerTest::theMonitorOutlivesTheServer()
{
    const database::StudyFolder owner = studyOnServer("stopped");
    const PlayedStation left(m_server->address("stopped"), "left", "P01");
    MonitorWindow monitor(owner.folder, {});
    monitor.show();
    QTRY_VERIFY_WITH_TIMEOUT(stationRow(monitor, "left").startsWith("left|connected|P01|"), waitMs);
    QTRY_VERIFY_WITH_TIMEOUT(placeRow(monitor, 1).startsWith("1|P01|welcome|"), waitMs);
    m_server->stop();
    QTRY_VERIFY_WITH_TIMEOUT(messageIn(monitor).contains("cannot be reached"), waitMs);
    QVERIFY2(stationRow(monitor, "left").startsWith("left|unknown|P01|"), qPrintable(stationRow(monitor, "left")));
    QVERIFY(placeRow(monitor, 1).startsWith("1|P01|welcome|"));  // as it was read last
    m_server->start();
    QTRY_COMPARE_WITH_TIMEOUT(messageIn(monitor), QString(), waitMs);
    QVERIFY2(stationRow(monitor, "left").startsWith("left|lost|P01|"), qPrintable(stationRow(monitor, "left")));
    const PlayedStation back(m_server->address("stopped"), "left", "P01");
    QTRY_VERIFY_WITH_TIMEOUT(stationRow(monitor, "left").startsWith("left|connected|P01|just now|"), waitMs);
}

void AppServerTest::aSilentServerDoesNotStopTheMonitor_data()
{
    QTest::addColumn<bool>("isSilentAtFirst");
    QTest::newRow("silent from the beginning") << true;
    QTest::newRow("silent later") << false;
}

void AppServerTest::aSilentServerDoesNotStopTheMonitor()
{
    QFETCH(bool, isSilentAtFirst);
    const std::string name = isSilentAtFirst ? "mute" : "muted";
    CutNetwork network(m_server->port());
    const database::StudyFolder owner = newStudy();
    moveToServer(owner, database::serverAddressFrom(m_server->address(name, "owner", network.port())), "owner");
    const PlayedStation left(m_server->address(name), "left", "P01");
    const qint64 longestMs = 1500;
    QElapsedTimer timer;
    timer.start();
    qint64 longestPauseMs = 0;
    QTimer beat;
    connect(&beat, &QTimer::timeout, this, [&] { longestPauseMs = std::max(longestPauseMs, timer.restart()); });
    beat.start(10);
    if (isSilentAtFirst) network.silence();
    auto monitor = std::make_unique<MonitorWindow>(owner.folder, study::app::AppOptions());
    monitor->show();
    if (!isSilentAtFirst) {
        QTRY_VERIFY_WITH_TIMEOUT(stationRow(*monitor, "left").startsWith("left|connected|"), waitMs);
        left.server.call("claim", {"P02", "human"});  // so that the monitor fetches the rows again
        network.silence();
    }
    QTRY_VERIFY_WITH_TIMEOUT(messageIn(*monitor).contains("cannot be reached"), waitMs);
    monitor->refresh();
    QTest::qWait(100);
    QVERIFY2(longestPauseMs < longestMs, qPrintable(QString::number(longestPauseMs)));
    if (isSilentAtFirst) {
        network.mend();
        QTRY_VERIFY_WITH_TIMEOUT(stationRow(*monitor, "left").startsWith("left|connected|"), waitMs);
        QTRY_COMPARE_WITH_TIMEOUT(messageIn(*monitor), QString(), waitMs);
        network.silence();
    }
    timer.restart();
    monitor.reset();
    QVERIFY2(timer.elapsed() < longestMs, qPrintable(QString::number(timer.elapsed())));
}

void AppServerTest::rowsThatComeLateDoNotStopTheMonitor()
{
    const database::StudyFolder owner = studyOnServer("late");
    const PlayedStation left(m_server->address("late"), "left", "P01");
    MonitorWindow monitor(owner.folder, {});
    monitor.show();
    QTRY_VERIFY_WITH_TIMEOUT(placeRow(monitor, 1).startsWith("1|P01|welcome|"), waitMs);
    const PlayedStation right(m_server->address("late"), "right", "P02");
    std::jthread blocker([&] {  // progress() does not read this table
        const ServerConnection server(database::serverAddressFrom(m_server->address("late")));
        server.run("BEGIN");
        server.run("LOCK TABLE @schema@.notes IN ACCESS EXCLUSIVE MODE");
        std::this_thread::sleep_for(std::chrono::seconds(9));
        server.run("COMMIT");
    });
    QElapsedTimer pause, whole;
    qint64 longestPauseMs = 0;
    QTimer beat;
    connect(&beat, &QTimer::timeout, this, [&] { longestPauseMs = std::max(longestPauseMs, pause.restart()); });
    beat.start(10);
    pause.start();
    for (whole.start(); whole.elapsed() < 8000;) {
        QTest::qWait(100);
        if (whole.elapsed() > 4000)
            QVERIFY2(stationRow(monitor, "right").startsWith("right|connected|P02|"), qPrintable(stationRow(monitor, "right")));
    }
    blocker.join();
    QVERIFY2(longestPauseMs < 1500, qPrintable(QString::number(longestPauseMs)));
    QTRY_VERIFY_WITH_TIMEOUT(placeRow(monitor, 2).startsWith("2|P02|welcome|"), waitMs);
}

void AppServerTest::theProgramOfAStationIsShownWhereTheServerGivesIt()
{
    const database::StudyFolder owner = studyOnServer("versions");
    const PlayedStation left(m_server->address("versions"), "left");
    left.server.run("ALTER FUNCTION @schema@.progress() RENAME TO progress_without");
    left.server.run(
        "CREATE FUNCTION @schema@.progress() RETURNS jsonb LANGUAGE sql AS "
        "$$ SELECT jsonb_set(@schema@.progress_without(), '{stations,0,program}', '\"vis2hap 9.9\"') $$");
    MonitorWindow monitor(owner.folder, {});
    monitor.show();
    QTRY_VERIFY_WITH_TIMEOUT(stationRow(monitor, "left").endsWith("|vis2hap 9.9"), waitMs);
    QVERIFY(!monitor.findChild<QTreeWidget*>("stationRows")->isColumnHidden(5));
}

QTEST_MAIN(AppServerTest)
#include "app_server_test.moc"
