// Stations whose participant, server or address changed under them: no answer of another is touched, and nothing is lost unseen.
#include <QDir>
#include <QTcpServer>
#include <QTemporaryDir>
#include <QTest>

#include "database/disk/server_note.h"
#include "database/server/server_connection.h"
#include "database/server/server_link.h"
#include "database/server/server_progress.h"
#include "database/server/server_roles.h"
#include "database/server/station_folders.h"
#include "database/server/study_move.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/error_text.h"
#include "tests/support/program.h"
#include "tests/support/server/cut_network.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using namespace study::session;
using database::ServerConnection;
using database::StationStore;
using database::StudyFolder;

namespace {

const protocols::ParticipantId firstPerson("P01");

QStringList filesLike(const StudyFolder& folder, const QString& pattern)
{
    return QDir(QString::fromStdString(folder.folder.string())).entryList({pattern}, QDir::Files);
}

/// The server comes back from a backup that ends with this entry, as after a fail-over.
void loseEntriesAfter(const ServerConnection& server, qlonglong kept)
{
    for (const char* table : {"responses", "notes", "voids", "finger_samples", "server_received", "events"}) {
        const QString column = table == std::string("events") ? "sequence" : "event";
        server.run(QStringLiteral("ALTER TABLE @schema@.%1 DISABLE TRIGGER ALL").arg(table));
        server.run(QStringLiteral("DELETE FROM @schema@.%1 WHERE %2 > ?").arg(table, column), {kept});
        server.run(QStringLiteral("ALTER TABLE @schema@.%1 ENABLE TRIGGER ALL").arg(table));
    }
    for (const auto& [table, column] : {std::pair("participant_facts", "participant"), std::pair("participants", "id")})
        server.run(QStringLiteral("DELETE FROM @schema@.%1 WHERE %2 NOT IN (SELECT participant FROM @schema@.events)")
                       .arg(table, column));
}

/// The participant's session, opened again in the same program.
void openAgain(ServerSession& session)
{
    session.driver.reset();
    session.driver = std::make_unique<Driver>(session.store, firstPerson, database::ParticipantKind::Human, session.images,
                                              session.display, session.clock);
}

}  // namespace

class StaleSessionsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void aSessionThatAnotherStationContinuedStops();
    void aSessionWhoseServerLostEntriesStops();
    void aServerThatLostEntriesIsNoticedWhenTheStudyIsOpened();
    void aHeadIsComparedWithTheOneThatWasSeen_data();
    void aHeadIsComparedWithTheOneThatWasSeen();
    void aMoveOutAndBackLosesNothing();
    void aQueueOfAnEarlierVersionOpens();
    void aMemoryThatCannotBeKeptFailsNoAnswer();
    void theProgressOfBeforeIsShownWhileTheServerIsBusy();
    void aServerThatTakesNoEntryKeepsThemWaiting_data();
    void aServerThatTakesNoEntryKeepsThemWaiting();
    void aMonitorSeesWhatWaitsAtAStation();
    void aCallThatWasGivenUpIsNotMade();
    void aNewParticipantIsNobodyElse();
    void whoWithdrewIsNoNewParticipant();
    void aParticipantWhoseSessionWasLeftIsFree();
    void aCopiedFolderGetsATokenOfItsOwn();
    void aWrongClockIsNoticed();
    void aFolderTakesAnotherAddress();
    void theProgramEndsWhileAServerDoesNotAnswer();

private:
    StudyFolder studyOnServer(const std::string& name)
    {
        const StudyFolder folder = buildStudy(m_folder.filePath(QString::fromStdString(name)).toStdString());
        moveToServer(folder, database::serverAddressFrom(m_server->address(name)), "owner");
        return folder;
    }
    StudyFolder station(const std::string& study, const std::string& name, int port = 0)
    {
        const auto folder = m_folder.filePath(QString::fromStdString(study + "-" + name)).toStdString();
        return {joinStudy(database::serverAddressFrom(m_server->address(study, "owner", port)), folder, name).folder};
    }
    ServerConnection connection(const std::string& study) const
    {
        return ServerConnection(database::serverAddressFrom(m_server->address(study)));
    }
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
};

void StaleSessionsTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
}

void StaleSessionsTest::aSessionThatAnotherStationContinuedStops()
{
    const StudyFolder owner = studyOnServer("continued");
    CutNetwork network(m_server->port());
    const StudyFolder left = station("continued", "left", network.port()), right = station("continued", "right");
    ServerSession session(left, "P01");
    session.playUntilAnswers(9);
    session.stepUntil("Presenting");
    network.cut();
    (void)errorOf([&] { session.step(); });
    QVERIFY(session.store.link().waiting > 0);
    QTRY_VERIFY_WITH_TIMEOUT(errorOf([&] { ServerSession(right, "P01"); }).isEmpty(), 40000);
    {
        ServerSession other(right, "P01");
        other.playUntilAnswers(14);
    }
    const auto rows = linesOf(readStudy(owner));
    network.mend();
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().isUp && session.store.link().waiting == 0), 20000);
    const QString stale = QString::fromStdString(session.store.link().stale);
    QVERIFY2(stale.contains("the server gained entries of P01"), qPrintable(stale));
    QVERIFY(session.store.link().setAside.find("not-sent-P01") != std::string::npos);
    QCOMPARE(filesLike(left, "held-P01-*.json").size(), 1);
    for (const EventBody& step : {EventBody(Voided{"wrong piece"}), EventBody(Noted{"late", false}), EventBody(Resumed{})}) {
        const QString refusal = errorOf([&] { session.driver->send(step); });
        QVERIFY2(refusal.isEmpty() || refusal.contains("cannot go on"), qPrintable(refusal));
    }
    QVERIFY(errorOf([&] { session.store.dueTrial(1, protocols::TrialNumber(1)); }).contains("cannot go on"));
    QCOMPARE(linesOf(readStudy(owner)), rows);
    openAgain(session);
    QVERIFY(session.store.link().stale.empty());
    QVERIFY(!session.store.link().setAside.empty());  // as long as the study is open
    session.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

void StaleSessionsTest::aSessionWhoseServerLostEntriesStops()
{
    const StudyFolder owner = studyOnServer("older");
    CutNetwork network(m_server->port());
    const StudyFolder place = station("older", "left", network.port());
    ServerSession session(place, "P01");
    session.playUntilAnswers(2);
    const auto kept = static_cast<qlonglong>(session.store.head().sequence);
    session.playUntilAnswers(12);
    session.stepUntil("Presenting");
    const auto held = session.store.events(firstPerson).size();
    network.cut();
    loseEntriesAfter(connection("older"), kept);
    (void)errorOf([&] { session.step(); });
    network.mend();
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().isUp && session.store.link().waiting == 0), 20000);
    const QString stale = QString::fromStdString(session.store.link().stale);
    QVERIFY2(stale.contains("the server lost entries of P01"), qPrintable(stale));
    QVERIFY2(errorOf([&] { session.send(Noted{"late", false}); }).contains("cannot go on"), qPrintable(stale));
    const QStringList files = filesLike(place, "held-P01-*.json");
    QCOMPARE(files.size(), 1);
    QFile file(QString::fromStdString((place.folder / files[0].toStdString()).string()));
    QVERIFY(file.open(QIODevice::ReadOnly));
    QVERIFY(static_cast<std::size_t>(file.readAll().count('\n')) > held);  // with the one that waited
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{2});
    openAgain(session);
    session.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

/// No session is open while the server loses P02 and more, and the queue is empty.
void StaleSessionsTest::aServerThatLostEntriesIsNoticedWhenTheStudyIsOpened()
{
    studyOnServer("restored");
    const StudyFolder place = station("restored", "left");
    qlonglong kept = 0;
    {
        ServerSession session(place, "P01");
        session.playUntilAnswers(2);
        kept = session.store.head().sequence;
        session.playUntilAnswers(4);
    }
    ServerSession(place, "P02").playUntilAnswers(3);
    {
        const StationStore store(place);
        QVERIFY(!store.link().lostAfter);
        QCOMPARE(store.nextParticipantId().value, std::string("P03"));
    }
    loseEntriesAfter(connection("restored"), kept);
    for (int opening = 0; opening < 2; ++opening) {
        const StationStore store(place);
        QVERIFY(store.link().lostAfter == kept);
        QCOMPARE(store.link().fault, std::string());
        QCOMPARE(store.nextParticipantId().value, std::string("P03"));  // not the lost P02
    }
    ServerSession(place, "P01").playUntilAnswers(12);  // more entries than were lost
    StationStore store(place);
    QVERIFY(store.link().lostAfter == kept);
    const auto enrolled = [&](const char* id) {
        return errorOf([&] { store.enrolNew(protocols::ParticipantId(id), database::ParticipantKind::Human); });
    };
    QVERIFY2(enrolled("P03").contains("the server lost entries after entry " + QString::number(kept)),
             qPrintable(enrolled("P03")));
    QTest::qWait(1200);
    QVERIFY(enrolled("P04").contains("ask the study's owner"));  // agreed to is one code
    QVERIFY(enrolled("P03").contains("ask the study's owner"));
    QVERIFY(enrolled("P03").contains("ask the study's owner"));  // a key that bounced
    QTest::qWait(1200);
    QCOMPARE(enrolled("P03"), QString());
    QVERIFY(!store.link().lostAfter);
}

void StaleSessionsTest::aHeadIsComparedWithTheOneThatWasSeen_data()
{
    QTest::addColumn<int>("lostBefore");  // -1: nothing was lost
    QTest::addColumn<int>("sequence");
    QTest::addColumn<char>("hash");
    QTest::addColumn<int>("lostAfter");
    QTest::newRow("the same") << -1 << 9 << 'a' << -1;
    QTest::newRow("longer") << -1 << 10 << 'b' << -1;
    QTest::newRow("shorter") << -1 << 8 << 'b' << 8;
    QTest::newRow("empty") << -1 << 0 << ' ' << 0;
    QTest::newRow("of no number") << -1 << -1 << 'b' << 0;
    QTest::newRow("another entry") << -1 << 9 << 'b' << 8;
    QTest::newRow("grown since the loss") << 8 << 11 << 'b' << 8;
    QTest::newRow("the newest backup") << 8 << 9 << 'a' << -1;
}

void StaleSessionsTest::aHeadIsComparedWithTheOneThatWasSeen()
{
    QFETCH(const int, lostBefore);
    QFETCH(const int, sequence);
    QFETCH(const char, hash);
    QFETCH(const int, lostAfter);
    database::SeenLog seen{"study", {9, std::string(64, 'a')}, {}};
    if (lostBefore >= 0) seen.lostAfter = lostBefore;
    const auto now = afterHead(seen, {sequence, sequence == 0 ? std::string() : std::string(64, hash)});
    QCOMPARE(static_cast<int>(now.lostAfter.value_or(-1)), lostAfter);
    QCOMPARE(static_cast<int>(now.head.sequence), lostAfter < 0 ? sequence : 9);
}

void StaleSessionsTest::aMoveOutAndBackLosesNothing()
{
    const StudyFolder owner = studyOnServer("travelled"), place = station("travelled", "left");
    ServerSession(place, "P01").playUntilAnswers(4);
    const std::string study = database::readServerNote(place.folder)->study;
    moveToFolder(database::serverAddressFrom(m_server->address("travelled")), owner);
    moveToServer(owner, database::serverAddressFrom(m_server->address("travelled")), "owner");
    const StationStore store(place);
    QVERIFY(!store.link().lostAfter);
    QCOMPARE(database::readServerNote(place.folder)->study, study);
}

void StaleSessionsTest::aQueueOfAnEarlierVersionOpens()
{
    const StudyFolder place{m_folder.filePath("earlier").toStdString()};
    std::filesystem::create_directory(place.folder);
    {
        const database::SqliteConnection file(place.queue(), database::SqliteConnection::Mode::Create);
        file.run(
            "CREATE TABLE entries(number INTEGER PRIMARY KEY AUTOINCREMENT, participant TEXT NOT NULL, kind TEXT NOT NULL, "
            "json TEXT NOT NULL) STRICT");
        file.run("INSERT INTO entries(participant, kind, json) VALUES ('P01', 'human', '{}')");
    }
    database::AnswerQueue queue(place);
    QCOMPARE(queue.size(), std::size_t{1});
    const database::SeenLog none{"study", {}, {}}, seen{"study", {7, std::string(64, 'a')}, 3};
    QVERIFY(queue.seenOf("study") == none);
    queue.keepSeen(seen);
    queue.keepEnrolled("P01");
    QVERIFY(queue.seenOf("study") == seen);
    QCOMPARE(queue.enrolledHere(), std::set<std::string>{"P01"});
    QVERIFY(queue.seenOf("another").head == database::LogHead());
    QVERIFY(queue.enrolledHere().empty());
}

/// The server has the answer already when a station notes what it has seen of the log.
void StaleSessionsTest::aMemoryThatCannotBeKeptFailsNoAnswer()
{
    const StudyFolder place{m_folder.filePath("no-memory").toStdString()};
    std::filesystem::create_directory(place.folder);
    CountingVfs disk;
    database::AnswerQueue queue(place);
    const database::SqliteConnection other(place.queue(), database::SqliteConnection::Mode::Write);
    const QVariant table = other.value("SELECT sql FROM sqlite_schema WHERE name = 'seen'");
    other.run("PRAGMA writable_schema = ON");
    other.run("UPDATE sqlite_schema SET sql = 'CREATE TABLE seen(' WHERE name = 'seen'");
    other.run("PRAGMA schema_version = 100");
    queue.keepSeen({"study", {7, std::string(64, 'a')}, {}});
    queue.keepEnrolled("P01");
    QVERIFY(!errorOf([&] { queue.put({0, "P01", "human", "{}"}); }).isEmpty());
    other.run("UPDATE sqlite_schema SET sql = ? WHERE name = 'seen'", {table});
    other.run("PRAGMA schema_version = 101");
    const int before = disk.traffic().completedSyncs;
    queue.put({0, "P01", "human", "{}"});
    QVERIFY(disk.traffic().completedSyncs > before);
    QCOMPARE(queue.size(), std::size_t{1});
}

void StaleSessionsTest::theProgressOfBeforeIsShownWhileTheServerIsBusy()
{
    studyOnServer("busy");
    const StationStore store(station("busy", "left"));
    const auto before = store.slots();
    QVERIFY(!before.empty());
    const ServerConnection server = connection("busy");
    server.run("ALTER FUNCTION @schema@.overview() RENAME TO overview_kept");
    const auto refuseWith = [&](const QString& code) {
        server.run(
            "CREATE OR REPLACE FUNCTION @schema@.overview() RETURNS jsonb LANGUAGE plpgsql AS $$ BEGIN RAISE EXCEPTION "
            "USING ERRCODE = '" +
            code + "', MESSAGE = 'not now'; END $$");
    };
    for (const char* code : {"VH302", "VH206", "53100"}) {
        refuseWith(code);
        QCOMPARE(store.slots().size(), before.size());
    }
    refuseWith("42501");
    QVERIFY(errorOf([&] { (void)store.slots(); }).contains("this login may not do this"));
}

void StaleSessionsTest::aServerThatTakesNoEntryKeepsThemWaiting_data()
{
    QTest::addColumn<QString>("body");
    QTest::addColumn<QString>("fault");
    QTest::newRow("claim lost") << "RETURN '{\"refused\": {\"code\": \"VH205\", \"message\": \"no claim\"}}'::jsonb;"
                                << "no claim";
    QTest::newRow("disk full") << "RAISE EXCEPTION USING ERRCODE = '53100', MESSAGE = 'could not extend file';"
                               << "the disk of the server is full";
}

void StaleSessionsTest::aServerThatTakesNoEntryKeepsThemWaiting()
{
    QFETCH(const QString, body);
    QFETCH(const QString, fault);
    const std::string name = body.contains("VH205") ? "unclaimed" : "full";
    const StudyFolder owner = studyOnServer(name);
    CutNetwork network(m_server->port());
    const StudyFolder place = station(name, "left", network.port());
    ServerSession session(place, "P01");
    session.stepUntil("Presenting");
    network.cut();
    (void)errorOf([&] { session.step(); });
    const std::size_t waiting = session.store.link().waiting;
    QVERIFY(waiting > 0);
    const ServerConnection server = connection(name);
    server.run("ALTER FUNCTION @schema@.store(jsonb) RENAME TO store_kept");
    server.run("CREATE FUNCTION @schema@.store(entry jsonb) RETURNS jsonb LANGUAGE plpgsql AS $$ BEGIN " + body + " END $$");
    network.mend();
    const auto reason = [&] { return QString::fromStdString(session.store.link().fault); };
    QTRY_VERIFY2_WITH_TIMEOUT((session.store.refresh(), reason().contains(fault)), qPrintable(reason()), 20000);
    QVERIFY(!session.store.link().isUp);
    QVERIFY(session.store.link().isRefused);
    QCOMPARE(session.store.link().waiting, waiting);
    QCOMPARE(session.store.link().setAside, std::string());
    server.run("DROP FUNCTION @schema@.store(jsonb)");
    server.run("ALTER FUNCTION @schema@.store_kept(jsonb) RENAME TO store");
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().isUp && session.store.link().waiting == 0), 20000);
    QCOMPARE(filesLike(place, "not-sent-*"), QStringList());
    QCOMPARE(session.store.link().stale, std::string());
    session.playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

/// The study is being moved, so that the station reaches the server but cannot send.
void StaleSessionsTest::aMonitorSeesWhatWaitsAtAStation()
{
    studyOnServer("reported");
    const auto address = database::serverAddressFrom(m_server->address("reported"));
    CutNetwork network(m_server->port());
    const StudyFolder place = station("reported", "left", network.port());
    {
        ServerSession session(place, "P01");
        session.stepUntil("Presenting");
        network.cut();
        (void)errorOf([&] { session.step(); });
        const std::size_t waiting = session.store.link().waiting;
        QVERIFY(waiting > 0);
        connection("reported").run("UPDATE @schema@.server_study SET state = 'leaving'");
        network.mend();
        for (int tries = 0; !session.store.link().isRefused && tries < 400; ++tries) {
            QTest::qWait(50);
            session.store.refresh();
        }
        QVERIFY(session.store.link().isRefused);
        const auto seen = progressOf(address).stations;
        QCOMPARE(seen.size(), std::size_t{1});
        QCOMPARE(seen[0].waiting, static_cast<int>(waiting));
        connection("reported").run("UPDATE @schema@.server_study SET state = 'open'");
        QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().isUp && session.store.link().waiting == 0),
                                 20000);
        QCOMPARE(progressOf(address).stations.at(0).waiting, 0);
    }
    QVERIFY(progressOf(address).owed.empty());
}

/// A join that arrives late would take the place of the station's newer connection.
void StaleSessionsTest::aCallThatWasGivenUpIsNotMade()
{
    studyOnServer("given-up");
    CutNetwork network(m_server->port());
    network.silence();
    {
        database::ServerLink link(database::serverAddressFrom(m_server->address("given-up", "owner", network.port())));
        (void)link.start("join_study", {"late", QString(64, 'a'), "test"});
        QTest::qWait(300);
    }
    QVERIFY(!database::haveLinksEnded(std::chrono::milliseconds(50)));
    network.mend();
    QVERIFY(database::haveLinksEnded(std::chrono::seconds(30)));
    QCOMPARE(connection("given-up").value("SELECT count(*) FROM @schema@.server_stations").toInt(), 0);
}

void StaleSessionsTest::aNewParticipantIsNobodyElse()
{
    studyOnServer("newcomers");
    const StudyFolder left = station("newcomers", "left"), right = station("newcomers", "right");
    StationStore other(right);
    {
        ServerSession session(left, "P01");
        session.playUntilAnswers(3);
        const QString busy = errorOf([&] { other.enrolNew(firstPerson, database::ParticipantKind::Human); });
        QVERIFY2(busy.contains("is at station left"), qPrintable(busy));
    }
    const QString known = errorOf([&] { other.enrolNew(firstPerson, database::ParticipantKind::Human); });
    QVERIFY2(known.contains("was enrolled at another station in the meantime"), qPrintable(known));
    QCOMPARE(errorOf([&] { other.enrolNew(protocols::ParticipantId("P02"), database::ParticipantKind::Human); }), QString());
    ServerSession(left, "P01").playToEnd();  // the refused one does not hold the participant
}

void StaleSessionsTest::whoWithdrewIsNoNewParticipant()
{
    studyOnServer("gone");
    const StudyFolder place = station("gone", "left");
    {
        ServerSession session(place, "P01");
        session.playUntilAnswers(3);
        session.send(WithdrawnEvent{"no time"});
    }
    StationStore store(place);
    const QString refusal = errorOf([&] { store.enrolNew(firstPerson, database::ParticipantKind::Human); });
    QVERIFY2(refusal.contains("participant P01 has withdrawn") && !refusal.contains("in the list"), qPrintable(refusal));
}

void StaleSessionsTest::aParticipantWhoseSessionWasLeftIsFree()
{
    const StudyFolder owner = studyOnServer("left-over");
    const StudyFolder left = station("left-over", "left"), right = station("left-over", "right");
    ServerSession session(left, "P01");
    session.playUntilAnswers(3);
    session.driver.reset();
    session.store.leaveParticipant();
    ServerSession(right, "P01").playToEnd();
    QVERIFY(session.store.link().isUp);
    QCOMPARE(session.store.enrol(protocols::ParticipantId("P02"), database::ParticipantKind::Human).number, 2);
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
}

void StaleSessionsTest::aCopiedFolderGetsATokenOfItsOwn()
{
    studyOnServer("copied");
    const StudyFolder place = station("copied", "left");
    const auto first = database::readServerNote(place.folder).value();
    QCOMPARE(first.computer, database::hashOfThisComputer());
    {
        const StationStore store(place);
    }
    QCOMPARE(database::readServerNote(place.folder)->token, first.token);
    auto note = first;
    note.computer.clear();  // from an earlier version
    writeServerNote(place.folder, note);
    {
        const StationStore store(place);
    }
    QCOMPARE(database::readServerNote(place.folder)->token, first.token);
    note.computer = "another";
    writeServerNote(place.folder, note);
    {
        const StationStore store(place);
    }
    const auto own = database::readServerNote(place.folder).value();
    QVERIFY(own.token != first.token);
    QCOMPARE(own.token.size(), first.token.size());
    QCOMPARE(own.computer, first.computer);
}

void StaleSessionsTest::aWrongClockIsNoticed()
{
    studyOnServer("clock");
    StationStore store(station("clock", "left"));
    const auto takeSigns = [&] {
        for (int i = 0; i < 6; ++i) {
            store.refresh();
            QTest::qWait(100);
        }
    };
    takeSigns();
    QCOMPARE(store.link().clockAhead.count(), 0);
    for (const int hours : {2, -3}) {
        connection("clock").run(QStringLiteral("CREATE OR REPLACE FUNCTION @schema@.server_wall_time() RETURNS text LANGUAGE sql "
                                               "VOLATILE AS $$ SELECT to_char(clock_timestamp() AT TIME ZONE 'UTC' - interval "
                                               "'%1 hours', 'YYYY-MM-DD\"T\"HH24:MI:SS.MS\"Z\"') $$")
                                    .arg(hours));
        takeSigns();
        const auto seconds = store.link().clockAhead.count();
        QVERIFY2(std::abs(seconds - hours * 3600) < 30, qPrintable(QString::number(seconds)));
    }
}

void StaleSessionsTest::aFolderTakesAnotherAddress()
{
    studyOnServer("addressed");
    CutNetwork network(m_server->port());
    const StudyFolder place = station("addressed", "left");
    const auto direct = database::serverAddressFrom(m_server->address("addressed"));
    const auto other = database::serverAddressFrom(m_server->address("addressed", "owner", network.port()));
    takeAddress(other, place);
    QCOMPARE(database::readServerNote(place.folder)->address, other.text);
    const QString nobody =
        errorOf([&] { takeAddress(database::serverAddressFrom("postgresql://owner@127.0.0.1:1/lab?study=addressed"), place); });
    QVERIFY2(nobody.contains("cannot be reached"), qPrintable(nobody));
    QCOMPARE(database::readServerNote(place.folder)->address, other.text);
    {
        ServerSession session(place, "P01");
        session.stepUntil("Presenting");
        network.cut();
        (void)errorOf([&] { session.step(); });
    }
    QVERIFY(database::entriesWaiting(place) > 0);
    takeAddress(direct, place);
    QCOMPARE(database::readServerNote(place.folder)->address, direct.text);
    const StationStore store(place);  // sends them
    QCOMPARE(store.link().waiting, std::size_t{0});
    QCOMPARE(store.link().setAside, std::string());
}

/// The first of two hosts takes connections and says nothing, so that a thread still waits for it when the program ends.
void StaleSessionsTest::theProgramEndsWhileAServerDoesNotAnswer()
{
    studyOnServer("ended");
    QTcpServer silent;
    QVERIFY(silent.listen(QHostAddress("127.0.0.2"), static_cast<quint16>(m_server->port())));
    const QString address =
        QString("postgresql://owner@/lab?study=ended&host=127.0.0.2,127.0.0.1&port=%1&sslmode=disable").arg(m_server->port());
    const auto result = support::runProgram({"study", "join", address, m_folder.filePath("ended-place")});
    QVERIFY2(result.exitCode == 0 || result.exitCode == 3, qPrintable(QString::number(result.exitCode) + result.err));
    QVERIFY2(result.exitCode == 0 || result.err.contains("the server does not answer"), qPrintable(result.err));
}

QTEST_GUILESS_MAIN(StaleSessionsTest)
#include "stale_sessions_test.moc"
