// A study beside what else a server has: studies of other databases, groups of earlier ones, defaults and time limits.
#include <QTemporaryDir>
#include <QTest>

#include "database/disk/server_note.h"
#include "database/server/server_connection.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "database/study_store.h"
#include "tests/support/error_text.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using database::ServerConnection;
using database::StudyFolder;

class ServerSurroundingsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void aNameOfAnotherDatabaseIsRefused();
    void membersOfAnEarlierStudyAreNotThoseOfALaterOne();
    void defaultsOfTheDatabaseDoNotStrandAMove();
    void aMoveThatCannotEndComesBack();
    void rowsThatEndEarlyAreNoStudy();

private:
    StudyFolder folder(const char* name) const { return {m_folder.filePath(name).toStdString()}; }
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
};

void ServerSurroundingsTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
}

/// Groups belong to the whole server: members of those of one study could enter the other.
void ServerSurroundingsTest::aNameOfAnotherDatabaseIsRefused()
{
    const StudyFolder first = buildStudy(folder("groups").folder), second = buildStudy(folder("groups-2").folder, {.keySeed = 9});
    const auto elsewhere = [&](const std::string& study) {
        std::string text = m_server->address(study);
        return database::serverAddressFrom(text.replace(text.find("/lab?"), 5, "/lab2?"));
    };
    const auto address = database::serverAddressFrom(m_server->address("groups"));
    const ServerConnection server(address);
    server.run("CREATE DATABASE lab2");
    server.run("CREATE ROLE gina LOGIN");
    moveToServer(first, address, "owner");
    makeRoles(address, {{"gina", "experimenter"}});
    const QString expected = "another database of this server has a study of this name";
    QVERIFY(errorOf([&] { requireFreeName(elsewhere("groups")); }).contains(expected));
    const QString refusal = errorOf([&] { moveToServer(second, elsewhere("groups"), "owner"); });
    QVERIFY2(refusal.contains(expected) && refusal.contains("choose another study=NAME"), qPrintable(refusal));
    QVERIFY(std::filesystem::exists(second.database()) && !std::filesystem::exists(database::serverNoteOf(second.folder)));
    // The study was there before the other one had groups.
    moveToServer(second, elsewhere("late"), "owner");
    server.run("CREATE SCHEMA vis2hap_late");
    server.run("CREATE ROLE vis2hap_late_monitor");
    server.run("GRANT USAGE ON SCHEMA vis2hap_late TO vis2hap_late_monitor");
    const QString late = errorOf([&] { makeRoles(elsewhere("late"), {}); });
    QVERIFY2(late.contains(expected), qPrintable(late));
}

/// An owner who may not drop the groups leaves them behind when the study comes back.
void ServerSurroundingsTest::membersOfAnEarlierStudyAreNotThoseOfALaterOne()
{
    const StudyFolder study = buildStudy(folder("again").folder);
    const auto address = database::serverAddressFrom(m_server->address("again"));
    {
        const ServerConnection server(address);
        server.run("CREATE ROLE fred LOGIN");
        server.run("CREATE ROLE vis2hap_again_experimenter");
        server.run("GRANT vis2hap_again_experimenter TO fred");
    }
    const auto experimenters = [&](const std::vector<std::pair<std::string, std::string>>& logins) {
        return makeRoles(address, logins).front();
    };
    moveToServer(study, address, "owner");
    QCOMPARE(experimenters({}), std::string("vis2hap_again_experimenter: nobody yet"));
    QCOMPARE(experimenters({{"fred", "experimenter"}}), std::string("vis2hap_again_experimenter: fred"));
    QCOMPARE(experimenters({}), std::string("vis2hap_again_experimenter: fred"));
    moveToFolder(address, study);
    moveToServer(study, address, "owner");
    QCOMPARE(experimenters({}), std::string("vis2hap_again_experimenter: nobody yet"));
}

void ServerSurroundingsTest::defaultsOfTheDatabaseDoNotStrandAMove()
{
    const StudyFolder study = buildStudy(folder("defaults").folder);
    const auto address = database::serverAddressFrom(m_server->address("defaults"));
    {
        const ServerConnection server(address);
        server.run("ALTER DATABASE lab SET default_transaction_isolation = 'repeatable read'");
        server.run("ALTER DATABASE lab SET default_transaction_read_only = on");
    }
    const QString there = errorOf([&] { moveToServer(study, address, "owner"); });
    const QString session = errorOf([&] { ServerSession(study, "P01").playUntilAnswers(2); });
    const QString back = errorOf([&] { moveToFolder(address, study); });
    {
        const ServerConnection server(address);
        server.run("SET default_transaction_read_only = off");
        server.run("ALTER DATABASE lab RESET ALL");
    }
    QCOMPARE(there, QString());
    QCOMPARE(session, QString());
    QCOMPARE(back, QString());
    QVERIFY(readStudy(study).answerCount() >= 2);
}

/// Until the study is open on the server, its file stays, and the way back works.
void ServerSurroundingsTest::aMoveThatCannotEndComesBack()
{
    const StudyFolder study = buildStudy(folder("stranded").folder);
    const auto copy = folder("stranded-copy");
    std::filesystem::copy(study.folder, copy.folder, std::filesystem::copy_options::recursive);
    const auto address = database::serverAddressFrom(m_server->address("stranded"));
    const auto head = moveToServer(study, address, "owner");
    std::filesystem::copy(copy.database(), study.database());  // the program ended before it was removed
    {
        const ServerConnection server(address);
        server.run("UPDATE @schema@.server_study SET state = 'arriving'");
        server.run("ALTER TABLE @schema@.server_trials DISABLE TRIGGER USER");
        server.run("DELETE FROM @schema@.server_trials WHERE number = 1");
    }
    const QString refusal = errorOf([&] { moveToServer(study, address, "owner"); });
    QVERIFY2(refusal.contains("a presentation has no image"), qPrintable(refusal));
    QVERIFY(std::filesystem::exists(study.database()));
    QCOMPARE(moveToFolder(address, study), head);
    QVERIFY(ServerConnection(address).studies().filter("stranded").isEmpty());
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

/// A time limit of the server or a cut network in the middle of the last table.
void ServerSurroundingsTest::rowsThatEndEarlyAreNoStudy()
{
    const StudyFolder study = buildStudy(folder("early").folder);
    const auto address = database::serverAddressFrom(m_server->address("early"));
    moveToServer(study, address, "owner");
    {
        const ServerConnection server(address);
        server.run("ALTER TABLE @schema@.acts RENAME TO acts_kept");
        server.run(
            "CREATE FUNCTION @schema@.stop_at(n bigint) RETURNS text VOLATILE LANGUAGE plpgsql AS $$ BEGIN "
            "IF n = 3 THEN RAISE EXCEPTION USING ERRCODE = 'query_canceled', MESSAGE = 'stopped on purpose'; END IF; "
            "RETURN ''; END $$");
        server.run(
            "CREATE VIEW @schema@.acts AS SELECT g AS number, 'export' AS kind, '{}' AS details, "
            "@schema@.stop_at(g) AS wall_time, '' AS previous_hash, CAST(g AS text) AS hash "
            "FROM generate_series(CAST(1 AS bigint), 5) g ORDER BY g");
    }
    const QString refusal = errorOf([&] { (void)readStudy(study); });
    QVERIFY2(refusal.contains("stopped on purpose"), qPrintable(refusal));
}

QTEST_GUILESS_MAIN(ServerSurroundingsTest)
#include "server_surroundings_test.moc"
