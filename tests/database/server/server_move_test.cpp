// A study moves to a server and back: nothing is lost, nothing is half-made, and every wrong address is one clear line.
#include <sys/stat.h>

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "database/disk/server_note.h"
#include "database/server/answer_queue.h"
#include "database/server/server_connection.h"
#include "database/server/server_progress.h"
#include "database/server/study_move.h"
#include "database/study_store.h"
#include "study/records/evidence/data_sheet.h"
#include "study/records/evidence/data_sheet_text.h"
#include "study/records/study_faults.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/whole_protocol.h"

using namespace tests::support;
using namespace study::session;
using database::ServerConnection;
using database::StudyFolder;
using database::StudyStore;

namespace {

/// Answers the question at hand and corrects the answer at once.
void correctOne(SessionHands& session)
{
    session.stepUntil("Presenting");
    const View asked = session.driver->view();
    session.send(Answered{responseTo(asked)});
    session.send(Corrected{asked.question->id, responseTo(asked), "misheard"});
}

/// Everything that a study's log can hold: two participants, a void, a correction, notes, a withdrawal and an erasure.
StudyFolder livedStudy(const std::filesystem::path& folder)
{
    const StudyFolder study = buildStudy(folder, wholeStudy());
    {
        OpenSession session(study, "P01");
        session.playUntilAnswers(5);
        session.send(Noted{"\xe5\xb8\x83 is \"soft\"\nand =1+1", true});
        session.stepUntil("Presenting");
        session.send(Voided{"the piece fell"});
        session.playUntilAnswers(9);
        correctOne(session);
    }
    {
        OpenSession session(study, "P02");
        session.playUntilAnswers(4);
        session.send(WithdrawnEvent{"no time"});
    }
    {
        OpenSession session(study, "P03");
        session.playUntilAnswers(6);
    }
    StudyStore store(study, StudyStore::Access::Write);
    store.erase({protocols::ParticipantId("P03"), true, "Ada", "asked for it", {}});
    return study;
}

}  // namespace

class ServerMoveTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void aStudyComesBackAsItWas();
    void aSessionGoesOnAfterTheMove();
    void aPresentationThatBeganGoesOnAfterBothMoves();
    void itsTimeOnTheServerIsOnRecord();
    void readersSeeTheStudyWhileItIsOnTheServer();
    void theOwnersFolderIsLookedAtItself();
    void anEnrolmentOnTheServerNamesTheLastAct();
    void anInterruptedMoveIsCompleted();
    void aSecondStudyOfTheNameIsRefused();
    void wrongAddressesAreOneLine_data();
    void wrongAddressesAreOneLine();
    void anAlteredRowOnTheServerIsFound();
    void aStationThatIsAwayIsNotForgotten();
    void whatAStationOwesOutlivesLaterJoins();
    void aStationThatGoesOnSettlesWhatAnotherOwed();
    void whoKeepsTheStudyBusyIsNamed();

private:
    StudyFolder folder(const char* name) const { return {m_folder.filePath(name).toStdString()}; }
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
};

void ServerMoveTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
}

void ServerMoveTest::aStudyComesBackAsItWas()
{
    const StudyFolder study = livedStudy(folder("lived").folder);
    const auto before = readStudy(study).head();
    const auto lines = linesOf(readStudy(study));
    const auto address = database::serverAddressFrom(m_server->address("lived"));
    QCOMPARE(moveToServer(study, address, "owner"), before);
    QVERIFY(!std::filesystem::exists(study.database()));
    QVERIFY(std::filesystem::exists(database::serverNoteOf(study.folder)));
    QCOMPARE(moveToFolder(address, study), before);
    QVERIFY(!std::filesystem::exists(database::serverNoteOf(study.folder)));
    const StudyStore store = readStudy(study);
    QCOMPARE(store.faults(), std::vector<std::string>());
    QCOMPARE(linesOf(store), lines);
    QCOMPARE(store.head(), before);
    QVERIFY(ServerConnection(address).studies().isEmpty());
}

/// Presentations that the participant had before the move are known on the server.
void ServerMoveTest::aSessionGoesOnAfterTheMove()
{
    const StudyFolder study = buildStudy(folder("goes-on").folder);
    {
        OpenSession session(study, "S01");
        session.playUntilAnswers(5);
        session.stepUntil("Presenting");
        session.send(Voided{"the piece fell"});
        session.playUntilAnswers(7);
    }
    moveToServer(study, database::serverAddressFrom(m_server->address("goes-on")), "owner");
    {
        ServerSession session(study, "S01", database::ParticipantKind::Scripted);
        session.playToEnd();
    }
    const StudyStore store = readStudy(study);
    QCOMPARE(store.faults(), std::vector<std::string>());
    QCOMPARE(store.enrolments().front().state, database::SlotState::Finished);
}

/// A participant who stopped while a presentation was felt is not locked out by a move, in either direction.
void ServerMoveTest::aPresentationThatBeganGoesOnAfterBothMoves()
{
    const StudyFolder study = buildStudy(folder("felt").folder);
    const auto address = database::serverAddressFrom(m_server->address("felt"));
    for (const char* person : {"S01", "S02"}) {
        OpenSession session(study, person);
        if (person == std::string("S02")) session.playUntilAnswers(5);
        session.stepUntil("Presenting");
    }
    moveToServer(study, address, "owner");
    for (const char* person : {"S01", "S02"}) {
        ServerSession session(study, person, database::ParticipantKind::Scripted);
        session.playUntilAnswers(9);
        session.stepUntil("Presenting");
    }
    moveToFolder(address, study);
    for (const char* person : {"S01", "S02"}) OpenSession(study, person).playToEnd();
    const StudyStore store = readStudy(study);
    QCOMPARE(store.faults(), std::vector<std::string>());
    QCOMPARE(store.answerCount(), std::size_t{48});
}

/// The server's log and write-ahead log keep copies, so erasures must be able to name them.
void ServerMoveTest::itsTimeOnTheServerIsOnRecord()
{
    const StudyFolder study = livedStudy(folder("stay").folder);
    const auto address = database::serverAddressFrom(m_server->address("stay"));
    moveToServer(study, address, "owner");
    moveToFolder(address, study, {{}, "Ada", "test", "here", {}, {}, {}});
    const StudyStore store = readStudy(study);
    const auto copies = copiesSince(store, store.head().sequence);
    QCOMPARE(copies.size(), std::size_t{1});
    QCOMPARE(copies[0].kind, std::string(database::serverAct));
    QCOMPARE(copies[0].path, address.text);
    QCOMPARE(store.faults(), std::vector<std::string>());
    QCOMPARE(faultsOfActs(store), std::vector<std::string>());
}

void ServerMoveTest::readersSeeTheStudyWhileItIsOnTheServer()
{
    const StudyFolder study = livedStudy(folder("read").folder);
    const auto lines = linesOf(readStudy(study));
    moveToServer(study, database::serverAddressFrom(m_server->address("read")), "owner");
    const StudyStore store = readStudy(study);
    QCOMPARE(linesOf(store), lines);
    QCOMPARE(store.faults(), std::vector<std::string>());
    QCOMPARE(store.stimulusHashes().size(), std::size_t{8});
    const QString refusal = errorOf([&] { StudyStore(study, StudyStore::Access::Write); });
    QVERIFY2(refusal.contains("lies on a server") && refusal.contains("study move"), qPrintable(refusal));
}

/// The rows come from the server; files, links and modes are those of the owner's folder.
void ServerMoveTest::theOwnersFolderIsLookedAtItself()
{
    namespace fs = std::filesystem;
    const StudyFolder study = livedStudy(folder("owned").folder);
    moveToServer(study, database::serverAddressFrom(m_server->address("owned")), "owner");
    const auto faults = [&] {
        QString text;
        for (const auto& fault : study::records::findingsOf(readStudy(study)).faults)
            text += QString::fromStdString(fault) + "\n";
        return text;
    };
    QCOMPARE(faults(), QString());
    const auto sheet = study::records::dataSheetOf(readStudy(study));
    QCOMPARE(sheet["place"]["folder"], fs::absolute(study.folder).string());
    const std::string text = study::records::textOfDataSheet(sheet);
    for (const char* said : {"server.json, mode 0600", "monitors, by their login", "not-sent-"})
        QVERIFY2(text.find(said) != std::string::npos, said);

    // A session on the owner's computer leaves its queue; a pipe below a folder must not stop a reader.
    database::AnswerQueue(study).put({0, "P01", "human", "{}"});
    fs::create_directory(study.folder / "prompts");
    QCOMPARE(::mkfifo((study.folder / "prompts" / "pipe").c_str(), 0600), 0);
    QVERIFY2(!faults().contains("queue.db"), qPrintable(faults()));
    fs::remove_all(study.folder / "prompts");
    QCOMPARE(faults(), QString());

    const fs::path photographs = folder("photographs").folder;
    fs::create_directory(photographs);
    fs::permissions(photographs, fs::perms::owner_all | fs::perms::group_read | fs::perms::others_read);
    const auto mode = fs::status(photographs).permissions();
    fs::create_directory_symlink("../photographs", study.folder / "linked");
    fs::permissions(study.folder / "station-key.json", fs::perms::owner_read | fs::perms::others_read);
    QVERIFY2(faults().contains("linked: does not belong to the study"), qPrintable(faults()));
    QCOMPARE(fs::status(photographs).permissions(), mode);
    const auto notes = study::records::findingsOf(readStudy(study)).notes;
    const auto isOpen = [](const std::string& note) { return note.find("other users may read") != std::string::npos; };
    QVERIFY(std::ranges::any_of(notes, isOpen));

    // What waited there follows a server that is no more.
    fs::remove(study.folder / "linked");
    fs::permissions(study.folder / "station-key.json", fs::perms::owner_read | fs::perms::owner_write);
    moveToFolder(database::serverAddressFrom(m_server->address("owned")), study, {});
    QVERIFY(!fs::exists(study.queue()) && fs::exists(study.folder / "not-sent-P01-1.json"));
    QCOMPARE(faults(), QString());
}

/// Acts that are cut off while the study is on a server, or after it, are missed by the next verify.
void ServerMoveTest::anEnrolmentOnTheServerNamesTheLastAct()
{
    const StudyFolder study = buildStudy(folder("acts").folder);
    const auto address = database::serverAddressFrom(m_server->address("acts"));
    moveToServer(study, address, "owner");
    QCOMPARE(recordActOnServer(study, {"export", "Ada", "test", "here", "/out", readStudy(study).head(), {}}), std::nullopt);
    {
        const ServerConnection station(address);
        station.call("join_study", {"left", QString(64, QLatin1Char('a')), "test"});
        station.call("claim", {"P01", "human"});
        station.call("leave", {});
    }
    QCOMPARE(errorOf([&] { moveToFolder(address, study, {}, {"left"}); }), QString());
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
    RawSqlite raw(study.database());
    raw.dropTriggers();
    QCOMPARE(raw.run("DELETE FROM acts"), std::string());
    const auto faults = readStudy(study).faults();
    QVERIFY(std::ranges::any_of(faults, [](const std::string& one) { return one.find("act 1, which entry") == 0; }));
}

void ServerMoveTest::anInterruptedMoveIsCompleted()
{
    const StudyFolder study = livedStudy(folder("broken").folder);
    const auto copy = folder("broken-copy");
    std::filesystem::copy(study.folder, copy.folder, std::filesystem::copy_options::recursive);
    const auto address = database::serverAddressFrom(m_server->address("broken"));
    const auto head = moveToServer(study, address, "owner");

    // The program ended before the database was removed and before the study was opened on the server.
    std::filesystem::copy(copy.database(), study.database());
    ServerConnection(address).run("UPDATE @schema@.server_study SET state = 'arriving'");
    QCOMPARE(moveToServer(study, address, "owner"), head);
    QVERIFY(!std::filesystem::exists(study.database()));
    QCOMPARE(ServerConnection(address).value("SELECT state FROM @schema@.server_study").toString(), QString("open"));

    // It ended before the note was written: the folder is whole, and the next move begins anew.
    std::filesystem::remove(database::serverNoteOf(study.folder));
    std::filesystem::copy(copy.database(), study.database());
    ServerConnection(address).run("UPDATE @schema@.server_study SET state = 'arriving'");
    QCOMPARE(moveToServer(study, address, "owner"), head);

    // On the way back it ended after the arrival, and once more after the server's copy was gone.
    ServerConnection(address).run("UPDATE @schema@.server_study SET state = 'leaving'");
    std::filesystem::copy(copy.database(), study.database());
    const auto note = database::readServerNote(study.folder).value();
    QCOMPARE(moveToFolder(address, study), head);
    database::writeServerNote(study.folder, note);
    QCOMPARE(moveToFolder(address, study), head);
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

void ServerMoveTest::aSecondStudyOfTheNameIsRefused()
{
    const StudyFolder first = buildStudy(folder("first").folder), second = buildStudy(folder("second").folder, {.keySeed = 9});
    const auto address = database::serverAddressFrom(m_server->address("same"));
    moveToServer(first, address, "owner");
    const QString refusal = errorOf([&] { moveToServer(second, address, "owner"); });
    QVERIFY2(refusal.contains("has a study of this name already"), qPrintable(refusal));
    QVERIFY(std::filesystem::exists(second.database()));
    QVERIFY(!std::filesystem::exists(database::serverNoteOf(second.folder)));
    const QString wrong = errorOf([&] { moveToFolder(database::serverAddressFrom(m_server->address("other")), first); });
    QVERIFY2(wrong.contains("belongs to another study"), qPrintable(wrong));
}

void ServerMoveTest::wrongAddressesAreOneLine_data()
{
    QTest::addColumn<QString>("address");
    QTest::addColumn<QString>("expected");
    const QString port = QString::number(m_server ? m_server->port() : 1);
    QTest::newRow("nobody answers") << "postgresql://owner@127.0.0.1:1/lab?study=a"
                                    << "cannot be reached";
    QTest::newRow("unknown user") << "postgresql://nobody@127.0.0.1:" + port + "/lab?study=a"
                                  << "refused this login";
    QTest::newRow("unknown database") << "postgresql://owner@127.0.0.1:" + port + "/none?study=a"
                                      << "refused this login";
    QTest::newRow("a password") << "postgresql://owner:secret@127.0.0.1/lab?study=a"
                                << "holds a password";
    QTest::newRow("a password as a setting") << "postgresql://owner@127.0.0.1/lab?study=a&password=secret"
                                             << "holds a password";
    QTest::newRow("an unknown setting") << "postgresql://owner@127.0.0.1/lab?study=a&options=-csearch_path%3Dx"
                                        << "is unknown in an address";
    QTest::newRow("no database") << "postgresql://owner@127.0.0.1?study=a"
                                 << "names no database";
    QTest::newRow("a study with a quote") << "postgresql://owner@127.0.0.1/lab?study=a%22b"
                                          << "cannot name a study";
    QTest::newRow("a capital letter") << "postgresql://owner@127.0.0.1/lab?study=Pilot"
                                      << "cannot name a study";
    QTest::newRow("another scheme") << "mysql://owner@127.0.0.1/lab?study=a"
                                    << "no address of a server";
}

void ServerMoveTest::wrongAddressesAreOneLine()
{
    QFETCH(QString, address);
    QFETCH(QString, expected);
    static const StudyFolder study = buildStudy(folder("kept").folder);
    const QString refusal = errorOf([&] { moveToServer(study, database::serverAddressFrom(address.toStdString()), "owner"); });
    QVERIFY2(refusal.contains(expected), qPrintable(refusal));
    QVERIFY2(!refusal.contains("secret") && !refusal.contains('\n'), qPrintable(refusal));
    QVERIFY(!std::filesystem::exists(database::serverNoteOf(study.folder)));
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

/// Who keeps the server can write anything there; the chain tells it when the study comes back, and by every verify.
void ServerMoveTest::anAlteredRowOnTheServerIsFound()
{
    const StudyFolder study = livedStudy(folder("altered").folder);
    const auto address = database::serverAddressFrom(m_server->address("altered"));
    moveToServer(study, address, "owner");
    {
        const ServerConnection server(address);
        server.run("ALTER TABLE @schema@.responses DISABLE TRIGGER ALL");
        server.run("UPDATE @schema@.responses SET choice = 'F01' WHERE choice IN ('F02', 'F03')");
    }
    QVERIFY(!readStudy(study).faults().empty());
    const QString refusal = errorOf([&] { moveToFolder(address, study); });
    QVERIFY2(refusal.contains("did not arrive whole"), qPrintable(refusal));
    QVERIFY(!std::filesystem::exists(study.database()));
    QCOMPARE(ServerConnection(address).value("SELECT state FROM @schema@.server_study").toString(), QString("open"));
}

/// Its answers may wait in its queue. Only the owner's word gives them up.
void ServerMoveTest::aStationThatIsAwayIsNotForgotten()
{
    const StudyFolder study = buildStudy(folder("away").folder);
    const auto address = database::serverAddressFrom(m_server->address("away"));
    moveToServer(study, address, "owner");
    const QString token(64, QLatin1Char('a'));
    {
        const ServerConnection station(address);
        station.call("join_study", {"left", token, "test"});
        station.call("claim", {"P01", "human"});
    }
    const ServerConnection server(address);
    QTRY_COMPARE(server.call("progress", {}).at("stations").at(0).at("live").get<bool>(), false);
    // A station that joins later clears the list of those that are gone for days, but not of this one.
    server.run("UPDATE @schema@.server_stations SET last_seen = clock_timestamp() - interval '3 days'");
    server.call("join_study", {"right", QString(64, QLatin1Char('b')), "test"});
    const QString refusal = errorOf([&] { moveToFolder(address, study); });
    QVERIFY2(refusal.contains("answers may wait at stations that are away: left (P01)"), qPrintable(refusal));
    QVERIFY2(refusal.contains("--lose-answers-at"), qPrintable(refusal));
    QVERIFY(errorOf([&] { moveToFolder(address, study, {}, {"right"}); }).contains("left (P01)"));
    QVERIFY(!std::filesystem::exists(study.database()));
    QCOMPARE(errorOf([&] { moveToFolder(address, study, {}, {"left"}); }), QString());
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
    const QString gone = errorOf([&] { server.call("join_study", {"right", token, "test"}); });
    QVERIFY2(gone.contains("the study is no longer on this server") && !gone.contains("may not"), qPrintable(gone));
}

/// Somebody takes the name of a lost station, and the station comes back and is cut before it has sent anything.
void ServerMoveTest::whatAStationOwesOutlivesLaterJoins()
{
    const StudyFolder study = buildStudy(folder("owes").folder);
    const auto address = database::serverAddressFrom(m_server->address("owes"));
    moveToServer(study, address, "owner");
    const QString token(64, QLatin1Char('a')), other(64, QLatin1Char('b'));
    const auto joined = [&](const QString& with) {
        auto station = std::make_unique<ServerConnection>(address);
        station->call("join_study", {"left", with, "test"});
        return station;
    };
    const auto moveBack = [&] { return errorOf([&] { moveToFolder(address, study); }); };
    const QString owed = "answers may wait at stations that are away: left (P01, 3 entries)";
    {
        const auto station = joined(token);
        station->call("claim", {"P01", "human"});
        station->call("sign_of_life", {3});
    }
    const ServerConnection server(address);
    QTRY_COMPARE(server.call("progress", {}).at("stations").at(0).at("live").get<bool>(), false);
    QVERIFY(moveBack().contains(owed));
    joined(other)->call("leave", {});
    QVERIFY2(moveBack().contains(owed), qPrintable(moveBack()));
    const auto seen = progressOf(address);
    QCOMPARE(seen.owed.size(), std::size_t{1});
    QCOMPARE(seen.owed[0].station + " " + seen.owed[0].participant, std::string("left P01"));
    QCOMPARE(seen.owed[0].waiting, 3);
    joined(token).reset();
    QVERIFY2(moveBack().contains(owed), qPrintable(moveBack()));
    QVERIFY(errorOf([&] { moveToFolder(address, study, {}, {"right"}); }).contains(owed));
    server.run("SELECT @schema@.begin_leaving('[\"left\"]')");  // --lose-answers-at left
    server.run("SELECT @schema@.cancel_leaving()");
    joined(token)->call("sign_of_life", {0});
    QCOMPARE(moveBack(), QString());
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

/// From its first entry on, nothing that waits elsewhere for this participant can be stored.
void ServerMoveTest::aStationThatGoesOnSettlesWhatAnotherOwed()
{
    const StudyFolder study = buildStudy(folder("settles").folder);
    const auto address = database::serverAddressFrom(m_server->address("settles"));
    moveToServer(study, address, "owner");
    {
        const ServerConnection left(address);
        left.call("join_study", {"left", QString(64, QLatin1Char('a')), "test"});
        left.call("claim", {"P01", "human"});
    }
    const ServerConnection right(address);
    const auto takeUp = [&] {
        return errorOf([&] {
            right.call("join_study", {"right", QString(64, QLatin1Char('b')), "test"});
            right.call("claim", {"P01", "human"});
        });
    };
    QTRY_COMPARE(takeUp(), QString());
    right.call("leave", {});
    const QString refusal = errorOf([&] { moveToFolder(address, study); });
    QVERIFY2(refusal.contains("away: left (P01)"), qPrintable(refusal));
    QCOMPARE(takeUp(), QString());
    right.call("store", {QString::fromStdString(sentEntry("P01", 0, "begun").dump())});
    right.call("leave", {});
    QCOMPARE(errorOf([&] { moveToFolder(address, study); }), QString());
}

/// An analyst whose transaction stays open holds locks on what was read.
void ServerMoveTest::whoKeepsTheStudyBusyIsNamed()
{
    const StudyFolder study = buildStudy(folder("busy").folder);
    const auto address = database::serverAddressFrom(m_server->address("busy"));
    moveToServer(study, address, "owner");
    auto analyst = std::make_unique<ServerConnection>(address);
    analyst->run("BEGIN");
    (void)analyst->value("SELECT count(*) FROM @schema@.responses");
    const QString process = analyst->value("SELECT pg_backend_pid()").toString();
    const QString refusal = errorOf([&] { moveToFolder(address, study); });
    QVERIFY2(refusal.contains("owner (process " + process), qPrintable(refusal));
    QVERIFY2(refusal.contains("close these, then run the same command again"), qPrintable(refusal));
    analyst.reset();
    QCOMPARE(errorOf([&] { moveToFolder(address, study); }), QString());
    QVERIFY(ServerConnection(address).studies().isEmpty() || !ServerConnection(address).studies().contains("busy"));
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

QTEST_GUILESS_MAIN(ServerMoveTest)
#include "server_move_test.moc"
