// Blinding by rights: what an experimenter, a monitor and an analyst can learn from a study on a server, tried as each of them.
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "database/server/server_connection.h"
#include "database/server/server_progress.h"
#include "database/server/server_rights.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "protocols/files/errors.h"
#include "study/session/session_record.h"
#include "tests/support/error_text.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using database::ServerConnection;
using database::StudyFolder;
using database::StudyStore;

namespace {

const QString token = QString(64, QLatin1Char('a'));

bool isAmong(const std::vector<std::string>& texts, const char* wanted)
{
    return std::find(texts.begin(), texts.end(), wanted) != texts.end();
}

}  // namespace

class RolesTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void anExperimenterLearnsNothing();
    void anExperimenterRunsASession();
    void noTableCanBeReadOrWritten_data();
    void noTableCanBeReadOrWritten();
    void nothingIsStoredForAnybodyElse();
    void aSlotThatAStationHasSeenWaitsForTheOwner();
    void voidsInARowShowNothingAhead();
    void voidsBetweenAnswersHoldNobodyUp();
    void aStationCannotInventActsOrFacts();
    void anActOfAnotherFormIsRefused();
    void aRefusedEntryStaysOutOfTheLog();
    void theOwnerKeepsStatementsOutOfTheLog();
    void aLoginThatLogsStatementsIsNamed();
    void textsAreNeverStatements_data();
    void textsAreNeverStatements();
    void aMonitorSeesProgressAndStationsOnly();
    void anAnalystReadsTheRowsButNoKeys();
    void theOwnerIsToldWhatTheLoginLearns();
    void wrongGrantsAreOneLine();
    void rolesBringTheFunctionsOfThisProgram();
    void tablesOfAnEarlierVersionAreNamed();

private:
    database::ServerAddress as(const char* login, const char* study = "roles") const
    {
        return database::serverAddressFrom(m_server->address(study, login));
    }
    /// A study of its own on the server, where anna runs sessions.
    StudyFolder studyOfAnna(const char* name, StudyRecipe recipe) const;
    QTemporaryDir m_folder;
    StudyFolder m_owner;
    std::unique_ptr<PrivateServer> m_server;
};

void RolesTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
    m_owner = buildStudy(m_folder.filePath("owner").toStdString(), {.participants = 20});
    moveToServer(m_owner, as("owner"), "owner");
    {
        const ServerConnection server(as("owner"));
        for (const char* login : {"anna", "bert", "moni", "karl", "eve"}) server.run(QString("CREATE ROLE %1 LOGIN").arg(login));
    }
    const auto lines =
        makeRoles(as("owner"), {{"anna", "experimenter"}, {"bert", "experimenter"}, {"moni", "monitor"}, {"karl", "analyst"}});
    QCOMPARE(lines.size(), std::size_t{4});
    QVERIFY(lines[0].ends_with("experimenter: anna, bert"));
    QCOMPARE(makeRoles(as("owner"), {}), lines);
}

void RolesTest::anExperimenterLearnsNothing()
{
    const auto rights = rightsOf(as("anna"));
    QCOMPARE(rights.roles, std::vector<std::string>{"experimenter"});
    QCOMPARE(rights.learns, std::vector<std::string>());
    QVERIFY(rights.refused.size() >= 6);
    QVERIFY(isAmong(rights.may, "store") && isAmong(rights.may, "presentation"));
    QVERIFY(!isAmong(rights.may, "record_act"));
    const QString stranger = errorOf([&] { rightsOf(as("eve")); });
    QVERIFY2(stranger.contains("no study roles"), qPrintable(stranger));
}

void RolesTest::anExperimenterRunsASession()
{
    const auto folder = m_folder.filePath("anna").toStdString();
    joinStudy(as("anna"), folder, "left");
    {
        ServerSession session(StudyFolder{folder}, "P01");
        session.playToEnd();
    }
    QCOMPARE(readStudy(m_owner).faults(), std::vector<std::string>());
    for (const auto& file : std::filesystem::directory_iterator(folder)) {
        const std::string name = file.path().filename().string();
        QVERIFY2(name == "server.json" || name == "protocol.json" || name == ".lock" || name.starts_with("queue.db"),
                 name.c_str());
    }
    const QString report = errorOf([&] { database::readStudy(StudyFolder{folder}); });
    QVERIFY2(report.contains("folder of a station"), qPrintable(report));
}

void RolesTest::noTableCanBeReadOrWritten_data()
{
    QTest::addColumn<QString>("login");
    QTest::addColumn<QString>("statement");
    const char* tables[] = {"study",           "fabrics",        "stimuli",           "trials",
                            "participants",    "events",         "responses",         "voids",
                            "notes",           "finger_samples", "swatches",          "familiarisation",
                            "erasures",        "acts",           "participant_facts", "server_study",
                            "server_images",   "server_trials",  "server_releases",   "server_fetches",
                            "server_stations", "server_owed",    "server_received",   "server_cleared",
                            "slots",           "unblindings",    "protocol_versions", "server_familiarisation"};
    for (const char* login : {"anna", "moni", "eve"})
        for (const char* table : tables)
            for (const char* statement : {"SELECT count(*) FROM @schema@.%1", "DELETE FROM @schema@.%1",
                                          "COPY @schema@.%1 TO STDOUT", "CREATE TABLE @schema@.%1_copy(x int)"})
                QTest::addRow("%s %.6s %s", login, statement, table) << login << QString(statement).arg(table);
    for (const char* statement :
         {"SELECT * FROM @schema@.released_image('1')", "SELECT @schema@.give_images_to('station')",
          "SELECT @schema@.server_salt()", "SELECT @schema@.finish_arrival()", "SELECT @schema@.begin_leaving()",
          "SELECT @schema@.server_append('', 0, 'unblinded', '{}', 0, '')", "SET ROLE owner", "SET SESSION AUTHORIZATION owner",
          "SELECT pg_read_file('postgresql.conf')", "SELECT lo_import('/etc/passwd')",
          "ALTER TABLE @schema@.events DISABLE TRIGGER ALL", "DROP SCHEMA @schema@ CASCADE",
          "CREATE FUNCTION @schema@.f() RETURNS int LANGUAGE sql AS 'SELECT 1'"})
        QTest::addRow("anna %.30s", statement) << "anna" << statement;
}

void RolesTest::noTableCanBeReadOrWritten()
{
    QFETCH(QString, login);
    QFETCH(QString, statement);
    ServerConnection server(as(login.toUtf8().constData()));
    const QString refusal = errorOf([&] { server.run(statement); });
    QVERIFY2(!refusal.isEmpty(), qPrintable(statement));
}

void RolesTest::nothingIsStoredForAnybodyElse()
{
    const ServerConnection anna(as("anna")), bert(as("bert"));
    anna.call("join_study", {"one", token, "test"});
    bert.call("join_study", {"two", QString(64, QLatin1Char('b')), "test"});
    anna.call("claim", {"P10", "human"});
    bert.call("claim", {"P11", "human"});
    const auto send = [](const ServerConnection& server, const nlohmann::json& json) {
        return errorOf([&] { server.call("store", {QString::fromStdString(json.dump())}); });
    };
    QVERIFY(send(bert, sentEntry("P10", 0, "begun")).contains("not claimed"));
    QVERIFY(send(bert, sentEntry("P11", 0, "unblinded")).contains("kind"));
    QVERIFY(send(bert, sentEntry("P11", 7, "begun")).contains("another station went on"));
    const QString scripted = errorOf([&] { bert.call("claim", {"P12", "scripted"}); });
    QVERIFY2(scripted.contains("only the owner"), qPrintable(scripted));
    const QString missing = errorOf([&] { bert.call("claim", {"NaN", "human"}); });
    QVERIFY2(missing.contains("it stands for a missing value in tables"), qPrintable(missing));
    const QString taken = errorOf([&] { bert.call("claim", {"P10", "human"}); });
    QVERIFY2(taken.contains("is at station one"), qPrintable(taken));
    auto forged = sentEntry("P11", 0, "answered");
    forged["answers"].push_back({{"trial", 3},
                                 {"question", "Q1"},
                                 {"presentation_code", "AAA"},
                                 {"alternatives", "[\"F01\"]"},
                                 {"choice", "F01"},
                                 {"rating_tenths", nullptr},
                                 {"ready_at", 1},
                                 {"touched_at", nullptr},
                                 {"touched_by", nullptr},
                                 {"touch_ended_at", nullptr},
                                 {"answer_begun_at", nullptr},
                                 {"answer_begun_by", nullptr},
                                 {"answered_at", 2},
                                 {"entries", nullptr},
                                 {"is_correction", false},
                                 {"note", ""}});
    QVERIFY(send(bert, forged).contains("was not released"));
    for (const int number : {2, 3, 6, 0, -1, 2147483647})
        QVERIFY(errorOf([&] { bert.run("SELECT * FROM @schema@.presentation(?)", {number}); }).contains("not due"));
    bert.run("SELECT * FROM @schema@.presentation(?)", {1});
    QVERIFY(errorOf([&] { bert.run("SELECT * FROM @schema@.presentation(?)", {2}); }).contains("not due"));
    QCOMPARE(send(bert, sentEntry("P11", 0, "begun")), QString());
    QCOMPARE(readStudy(m_owner).faults(), std::vector<std::string>());
}

/// What only the server or another event states would keep the study from coming back, or change what people said of themselves.
void RolesTest::aStationCannotInventActsOrFacts()
{
    const StudyFolder study = studyOfAnna("inventions", {.participants = 2});
    const ServerConnection anna(as("anna", "inventions"));
    anna.call("join_study", {"one", token, "test"});
    anna.call("claim", {"P01", "human"});
    const auto refusalOf = [&](const char* kind, const char* payload, const nlohmann::json& facts) {
        auto entry = sentEntry("P01", 0, kind);
        entry["event"]["payload"] = payload;
        entry["facts"] = facts;
        return errorOf([&] { anna.call("store", {QString::fromStdString(entry.dump())}); });
    };
    const auto none = nlohmann::json::array();
    QVERIFY(refusalOf("noted", R"({"text":"x","acts":{"number":999,"sha256":"x"}})", none).contains("acts"));
    QVERIFY(refusalOf("noted", R"({"text":"x","facts_sha256":{"age":"0"}})", none).contains("facts"));
    QVERIFY(refusalOf("facts_given", R"({"facts_sha256":{"age":"0"}})", none).contains("facts_sha256"));
    QVERIFY(refusalOf("noted", R"({"text":"x"})", {{"age", "SEVENTY", std::string(64, 'd')}}).contains("facts"));
    const std::pair<const char*, const char*> unreadable[] = {
        {"noted", "{}"},
        {"noted", R"({"text":7})"},
        {"noted", R"({"text":"x","flag":"yes"})"},
        {"facts_given", R"({"given":["age",3]})"},
        {"familiarisation_shown", R"({"item":2147483648})"},
        {"scale_placed", R"({"shown":1.5,"spoken":10})"},
        {"checklist_done", R"({"ticked":[],"readings":{"lux":3}})"},
        {"touched", R"({"by":"display","ago_ns":1e3})"},
        {"tray_ready", R"({"pieces":null})"},
    };
    for (const auto& [kind, payload] : unreadable) {
        QVERIFY_THROWS_EXCEPTION(protocols::Error, study::session::eventFromRecord(kind, payload));
        QVERIFY2(refusalOf(kind, payload, none).contains("event.payload"), payload);
    }
    // PostgreSQL reads these texts, and this program does not, or reads another name than a simple search does.
    const std::string hash(64, 'e');
    for (const std::string& payload :
         {std::string(R"({"x":"\u0000"})"), std::string(R"({"x":"\u0000","f\u0061cts_sha256":{"age":"0"}})"),
          std::string(R"({"x":"\u0000","\u0061cts":{"number":9,"sha256":"x"}})"),
          std::string(R"({"\u0061cts":{"number":9,"sha256":"x"}})"), std::string(R"({"x":1e999})"),
          R"({"x":)" + std::string(300, '[') + std::string(300, ']') + "}", std::string(R"({"x":"\ud800"})")})
        QVERIFY2(refusalOf("paused", payload.c_str(), none).contains("event.payload"), payload.c_str());
    QVERIFY(refusalOf("facts_given", R"({"given":["age"],"facts_sha256":{"age":"0"}})", {{"age", "\ufeff7", hash}})
                .contains("facts"));
    QCOMPARE(refusalOf("noted", R"({"text":"acts and facts_sha256"})", none), QString());
    anna.call("leave", {});

    // The way back is open where an earlier version let such a name in, and the next verify tells it.
    const ServerConnection owner(as("owner", "inventions"));
    owner.run(
        "SELECT @schema@.server_append('P01', 1, 'noted', '{\"acts\":{\"number\":999,\"sha256\":\"x\"}}', 1, "
        "'2026-01-01T00:00:00Z')");
    owner.run(
        "SELECT @schema@.server_append('P01', 1, 'paused', '{\"facts_sha256\":{\"age\":\"0\"}}', 1, '2026-01-01T00:00:00Z')");
    QCOMPARE(errorOf([&] { moveToFolder(as("owner", "inventions"), study, {}, {"one"}); }), QString());
    auto faults = readStudy(study).faults();
    QCOMPARE(faults.size(), std::size_t{2});
    std::ranges::sort(faults);
    QVERIFY2(faults[1].starts_with("the fact \"age\" of participant P01 is missing"), faults[1].c_str());
    QVERIFY2(faults[0].starts_with("act 999, which entry"), faults[0].c_str());
}

/// The details of an act are shown and listed by many commands.
void RolesTest::anActOfAnotherFormIsRefused()
{
    const ServerConnection karl(as("karl"));
    const auto head = readStudy(m_owner).head();
    nlohmann::json details{{"who", "x"},  {"program", "x"},         {"host", "x"},
                           {"path", "x"}, {"entry", head.sequence}, {"hash", head.hash}};
    details["note"] = 5;
    const auto record = [&] { karl.call("record_act", {"export", QString::fromStdString(details.dump()), ""}); };
    QVERIFY(errorOf(record).contains("note"));
    details["note"] = "a fault";
    for (const char* unread : {R"("who":1e999,)", R"("x":1e999,)", R"("x":"\u0000",)"}) {
        const QString text = "{" + QString(unread) + QString::fromStdString(details.dump()).mid(1);
        QVERIFY2(errorOf([&] { karl.call("record_act", {"export", text, ""}); }).contains("details"), unread);
    }
    QCOMPARE(errorOf(record), QString());
}

StudyFolder RolesTest::studyOfAnna(const char* name, StudyRecipe recipe) const
{
    const StudyFolder folder = buildStudy(m_folder.filePath(name).toStdString(), recipe);
    moveToServer(folder, as("owner", name), "owner");
    makeRoles(as("owner", name), {{"anna", "experimenter"}});
    return folder;
}

/// Somebody who holds the login of a station enrols nobody, looks at a slot, and leaves it to the next participant.
void RolesTest::aSlotThatAStationHasSeenWaitsForTheOwner()
{
    const StudyFolder study = studyOfAnna("peek", {.participants = 2});
    const ServerConnection anna(as("anna", "peek"));
    anna.call("join_study", {"one", token, "test"});
    QCOMPARE(anna.call("claim", {"FAKE", "human"}).at("slot").get<int>(), 1);
    anna.run("SELECT * FROM @schema@.presentation(1)");
    auto leaves = sentEntry("FAKE", 0, "withdrawn");
    leaves["state"] = "withdrawn";
    anna.call("store", {QString::fromStdString(leaves.dump())});
    QCOMPARE(anna.call("claim", {"P02", "human"}).at("slot").get<int>(), 2);
    const QString full = errorOf([&] { anna.call("claim", {"P03", "human"}); });
    QVERIFY2(full.contains("all slots") && full.contains("--release-held"), qPrintable(full));

    QVERIFY(errorOf([&] { releaseHeld(as("anna", "peek")); }).contains("may not do this"));
    const auto released = releaseHeld(as("owner", "peek"));
    QCOMPARE(released.size(), std::size_t{1});
    QVERIFY2(released[0].starts_with("slot 1 is free again, after FAKE (presentations: 1,"), released[0].c_str());
    QVERIFY2(released[0].ends_with("login anna)"), released[0].c_str());
    QCOMPARE(releaseHeld(as("owner", "peek")), std::vector<std::string>());
    QCOMPARE(anna.call("claim", {"P03", "human"}).at("slot").get<int>(), 1);
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

void RolesTest::voidsInARowShowNothingAhead()
{
    studyOfAnna("voids", {.participants = 2});
    const ServerConnection anna(as("anna", "voids"));
    anna.call("join_study", {"one", token, "test"});
    anna.call("claim", {"P01", "human"});
    for (const int number : {1, 2, 3}) {
        anna.run("SELECT * FROM @schema@.presentation(?)", {number});
        auto voided = sentEntry("P01", number - 1, "voided");
        voided["voids"] = number;
        anna.call("store", {QString::fromStdString(voided.dump())});
    }
    const QString refusal = errorOf([&] { anna.run("SELECT * FROM @schema@.presentation(4)"); });
    QVERIFY2(refusal.contains("three presentations in a row are void"), qPrintable(refusal));
    const auto released = releaseHeld(as("owner", "voids"));
    QCOMPARE(released.size(), std::size_t{1});
    QVERIFY2(released[0].starts_with("the next presentation is due for P01"), released[0].c_str());
    anna.run("SELECT * FROM @schema@.presentation(4)");
}

void RolesTest::voidsBetweenAnswersHoldNobodyUp()
{
    const StudyFolder study = studyOfAnna("mishaps", {.participants = 2});
    const auto folder = m_folder.filePath("anna-mishaps").toStdString();
    joinStudy(as("anna", "mishaps"), folder, "left");
    {
        ServerSession session(StudyFolder{folder}, "P01");
        for (const int answers : {1, 4, 7, 10}) {
            session.playUntilAnswers(answers);
            for (int mishap = 0; mishap < 2; ++mishap) {
                session.stepUntil("Presenting");
                session.send(study::session::Voided{"wrong piece"});
            }
        }
        session.playToEnd();
    }
    const StudyStore rows = readStudy(study);
    QCOMPARE(rows.faults(), std::vector<std::string>());
    QCOMPARE(rows.enrolments().front().state, database::SlotState::Finished);
}

/// PostgreSQL writes the statement of every error into its log. An entry that another station overtook must not be one.
void RolesTest::aRefusedEntryStaysOutOfTheLog()
{
    const ServerConnection anna(as("anna"));
    const QString secret = QString(64, QLatin1Char('c'));
    anna.call("join_study", {"late", secret, "test"});
    anna.call("claim", {"P14", "human"});
    auto late = sentEntry("P14", 9, "noted");
    late["note"] = {{"trial", 1}, {"text", "SPOKEN ALOUD"}, {"is_flag", false}};
    late["facts"] = {{"age", "SEVENTY", std::string(64, 'd')}};
    const QString refusal = errorOf([&] { anna.call("store", {QString::fromStdString(late.dump())}); });
    QVERIFY2(refusal.contains("another station went on"), qPrintable(refusal));
    QVERIFY(errorOf([&] {
                ServerConnection(as("bert")).call("join_study", {"late", QString(64, QLatin1Char('e')), "test"});
            }).contains("another connection has joined"));
    (void)errorOf([&] { anna.run("SELECT * FROM @schema@.presentation(?)", {99}); });
    const QByteArray log = m_server->log();
    QVERIFY(log.contains("the presentation is not due yet") && log.contains("STATEMENT"));
    for (const char* text : {"SPOKEN ALOUD", "SEVENTY", "dddddddd", "cccccccc", "eeeeeeee"}) QVERIFY2(!log.contains(text), text);
}

void RolesTest::theOwnerKeepsStatementsOutOfTheLog()
{
    const auto commands = keepLogQuiet(as("eve"));
    QVERIFY(isAmong(commands, "ALTER DATABASE \"lab\" SET log_min_error_statement = panic"));
    QCOMPARE(keepLogQuiet(as("owner")), std::vector<std::string>());
    QCOMPARE(keepLogQuiet(as("eve")), std::vector<std::string>());
    const ServerConnection anna(as("anna"));
    QCOMPARE(anna.value("SHOW log_min_error_statement").toString(), QString("panic"));
    (void)errorOf([&] { anna.run("SELECT CAST(? AS int)", {"WHISPERED"}); });
    QVERIFY(!m_server->log().contains("STATEMENT:  EXECUTE qpsqlpstmt_1 ('WHISPERED"));
    // The server names the last statement of a process that is killed, where it knows one.
    QCOMPARE(anna.value("SHOW track_activities").toString(), QString("off"));
}

/// What a login has of its own goes before the settings of the database.
void RolesTest::aLoginThatLogsStatementsIsNamed()
{
    (void)keepLogQuiet(as("owner"));
    const ServerConnection owner(as("owner"));
    owner.run("ALTER ROLE bert SET log_statement = 'all'");
    const std::vector<std::string> expected{"ALTER ROLE \"bert\" IN DATABASE \"lab\" SET log_statement = none"};
    QCOMPARE(keepLogQuiet(as("eve")), expected);
    QCOMPARE(keepLogQuiet(as("owner")), std::vector<std::string>());
    QCOMPARE(keepLogQuiet(as("eve")), std::vector<std::string>());
    QCOMPARE(ServerConnection(as("bert")).value("SHOW log_statement").toString(), QString("none"));
}

void RolesTest::textsAreNeverStatements_data()
{
    QTest::addColumn<QString>("text");
    QTest::newRow("quote") << "x'); DROP SCHEMA public; --";
    QTest::newRow("dollar") << "$$; SELECT 1; $$";
    QTest::newRow("backslash") << "\\'; DELETE FROM events; --";
    QTest::newRow("format") << "%I %s %1$s";
    QTest::newRow("placeholder") << "? :v1 $1";
}

void RolesTest::textsAreNeverStatements()
{
    QFETCH(QString, text);
    const ServerConnection server(as("anna"));
    server.call("join_study", {"injector", token, text});
    (void)errorOf([&] { server.call("join_study", {text, token, "test"}); });
    (void)errorOf([&] { server.call("claim", {text, text}); });
    (void)errorOf([&] { server.call("claim", {text, "human"}); });
    auto json = sentEntry(text.toStdString(), 0, text.toStdString());
    (void)errorOf([&] { server.call("store", {QString::fromStdString(json.dump())}); });
    QCOMPARE(readStudy(m_owner).faults(), std::vector<std::string>());
}

void RolesTest::aMonitorSeesProgressAndStationsOnly()
{
    const ServerConnection anna(as("anna"));
    anna.call("join_study", {"seen", token, "test"});
    anna.call("claim", {"P15", "human"});
    anna.call("sign_of_life", {3});
    const auto progress = progressOf(as("moni"));
    const auto seen =
        std::find_if(progress.stations.begin(), progress.stations.end(), [](const auto& one) { return one.station == "seen"; });
    QVERIFY(seen != progress.stations.end());
    QCOMPARE(seen->participant, std::string("P15"));
    QCOMPARE(seen->waiting, 3);
    QVERIFY(seen->isLive && seen->lastSeenSeconds < 30);
    QCOMPARE(progress.free + progress.started + progress.finished, 20);
    QCOMPARE(rightsOf(as("moni")).may, std::vector<std::string>{"progress"});
    QCOMPARE(rightsOf(as("moni")).learns, std::vector<std::string>());
    QVERIFY(errorOf([&] { progressOf(as("anna")); }).contains("may not do this"));
}

void RolesTest::anAnalystReadsTheRowsButNoKeys()
{
    const ServerConnection server(as("karl"));
    QVERIFY(server.value("SELECT count(*) FROM @schema@.responses").toInt() > 0);
    for (const char* table : {"participant_facts", "server_images", "server_trials", "server_releases"})
        QVERIFY(errorOf([&] { server.run(QString("SELECT * FROM @schema@.%1").arg(table)); }).contains("may not do this"));
    QVERIFY(errorOf([&] { server.run("UPDATE @schema@.responses SET choice = 'F01'"); }).contains("may not do this"));
}

void RolesTest::theOwnerIsToldWhatTheLoginLearns()
{
    const auto rights = rightsOf(as("owner"));
    QVERIFY(isAmong(rights.roles, "owner"));
    QVERIFY(isAmong(rights.learns, "SELECT on the table server_trials"));
    QVERIFY(isAmong(rights.learns, "everything: the login is a superuser"));
}

void RolesTest::wrongGrantsAreOneLine()
{
    QVERIFY(errorOf([&] { makeRoles(as("owner"), {{"nobody", "monitor"}}); }).contains("knows no login"));
    QVERIFY(errorOf([&] { makeRoles(as("owner"), {{"anna", "boss"}}); }).contains("no role \"boss\""));
    const QString refusal = errorOf([&] { makeRoles(as("anna"), {}); });
    QVERIFY2(refusal.contains("may not do this") || refusal.contains("cannot make the groups"), qPrintable(refusal));
}

/// An earlier version moved the study there, and its functions refuse more.
void RolesTest::rolesBringTheFunctionsOfThisProgram()
{
    const StudyFolder study = studyOfAnna("renewed", {.participants = 2});
    const auto lines = makeRoles(as("owner", "renewed"), {});
    const ServerConnection owner(as("owner", "renewed")), anna(as("anna", "renewed"));
    owner.run(
        "CREATE OR REPLACE FUNCTION @schema@.server_fault_of_payload(its_kind text, payload text) RETURNS text "
        "LANGUAGE sql IMMUTABLE AS $$ SELECT 'an older rule' $$");
    anna.call("join_study", {"one", token, "test"});
    anna.call("claim", {"P01", "human"});
    const QString entry = QString::fromStdString(sentEntry("P01", 0, "noted").dump());
    const auto refusal = [&] { return errorOf([&] { anna.call("store", {entry}); }); };
    QVERIFY2(refusal().contains("an older rule"), qPrintable(refusal()));
    QVERIFY(!errorOf([&] { makeRoles(as("anna", "renewed"), {}); }).isEmpty());
    QVERIFY(refusal().contains("an older rule"));
    QCOMPARE(makeRoles(as("owner", "renewed"), {}), lines);
    QCOMPARE(refusal(), QString());
    const auto rights = rightsOf(as("anna", "renewed"));
    QCOMPARE(rights.learns, std::vector<std::string>());
    QVERIFY(isAmong(rights.may, "store") && !isAmong(rights.may, "record_act"));
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

void RolesTest::tablesOfAnEarlierVersionAreNamed()
{
    (void)studyOfAnna("early", {.participants = 2});
    ServerConnection(as("owner", "early")).run("DROP TABLE @schema@.server_owed CASCADE");
    const QString refusal = errorOf([&] { makeRoles(as("owner", "early"), {}); });
    QVERIFY2(refusal.startsWith("2: ") && refusal.contains("tables of an earlier version"), qPrintable(refusal));
    QVERIFY2(refusal.contains("move the study back"), qPrintable(refusal));
}

QTEST_GUILESS_MAIN(RolesTest)
#include "roles_test.moc"
