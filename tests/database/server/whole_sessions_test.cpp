// What a login of a station cannot do by statements of its own: end a session that was not held, and take back what it has seen.
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "database/server/server_connection.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "tests/support/error_text.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using database::ServerConnection;
using database::StudyFolder;

namespace {

const QString tokenOfOne = QString(64, QLatin1Char('a'));

QString stored(const ServerConnection& server, const nlohmann::json& entry)
{
    return errorOf([&] { server.call("store", {QString::fromStdString(entry.dump())}); });
}

}  // namespace

class WholeSessionsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void onlyTheEndOfASessionFinishesIt_data();
    void onlyTheEndOfASessionFinishesIt();
    void aSessionWithoutAnAnswerIsNotFinished();
    void aFinishedSessionGetsNoVoid();
    void answersThatNoSessionWritesAreRefused();
    void aReleaseThatIsTakenBackGivesNoImage();
    void theRecordOfAReleaseIsOnTheDisk();
    void anImageIsForItsOwnStation();
    void aBusyStudyIsRefusedBeforeTheStationGivesUp();

private:
    database::ServerAddress as(const char* login, const std::string& study) const
    {
        return database::serverAddressFrom(m_server->address(study, login));
    }
    StudyFolder studyOfAnna(const std::string& name, const StudyRecipe& recipe = {}) const;
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
};

void WholeSessionsTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
    const ServerConnection server(as("owner", "none"));
    for (const char* login : {"anna", "bert"}) server.run(QString("CREATE ROLE %1 LOGIN").arg(login));
    studyOfAnna("kinds");
}

StudyFolder WholeSessionsTest::studyOfAnna(const std::string& name, const StudyRecipe& recipe) const
{
    const StudyFolder folder = buildStudy(m_folder.filePath(QString::fromStdString(name)).toStdString(), recipe);
    moveToServer(folder, as("owner", name), "owner");
    makeRoles(as("owner", name), {{"anna", "experimenter"}, {"bert", "experimenter"}});
    return folder;
}

void WholeSessionsTest::onlyTheEndOfASessionFinishesIt_data()
{
    QTest::addColumn<QString>("kind");
    QTest::addColumn<QString>("state");
    QTest::addColumn<QString>("expected");
    QTest::newRow("debriefed without a state") << "debriefed"
                                               << ""
                                               << "finished with the event debriefed";
    QTest::newRow("a note that finishes") << "noted"
                                          << "finished"
                                          << "finished with the event debriefed";
    QTest::newRow("a note that withdraws") << "noted"
                                           << "withdrawn"
                                           << "withdrawn with the event withdrawn";
    QTest::newRow("withdrawn without a state") << "withdrawn"
                                               << ""
                                               << "withdrawn with the event withdrawn";
    QTest::newRow("debriefed that withdraws") << "debriefed"
                                              << "withdrawn"
                                              << "finished with the event debriefed";
    QTest::newRow("debriefed without answers") << "debriefed"
                                               << "finished"
                                               << "have no answer yet";
}

void WholeSessionsTest::onlyTheEndOfASessionFinishesIt()
{
    QFETCH(QString, kind);
    QFETCH(QString, state);
    QFETCH(QString, expected);
    const ServerConnection anna(as("anna", "kinds"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    const auto given = state.isEmpty() ? nlohmann::json() : nlohmann::json(state.toStdString());
    const QString refusal = stored(anna, sentEntry("P01", 0, kind.toStdString(), given));
    QVERIFY2(refusal.contains(expected), qPrintable(refusal));
    QCOMPARE(ServerConnection(as("owner", "kinds")).value("SELECT state FROM @schema@.participants").toString(),
             QString("started"));
}

void WholeSessionsTest::aSessionWithoutAnAnswerIsNotFinished()
{
    const StudyFolder owner = studyOfAnna("answers");
    const StudyFolder place{joinStudy(as("anna", "answers"), m_folder.filePath("answers-place").toStdString(), "one").folder};
    int events = 0;
    {
        ServerSession session(place, "P01");
        session.playUntilAnswers(23);  // of 24
        events = static_cast<int>(session.store.events(protocols::ParticipantId("P01")).size());
    }
    {
        const ServerConnection anna(as("anna", "answers"));
        anna.call("join_study", {"one", tokenOfOne, "test"});
        anna.call("claim", {"P01", "human"});
        const QString refusal = stored(anna, sentEntry("P01", events, "debriefed", "finished"));
        QVERIFY2(refusal.contains("presentations of P01 have no answer yet"), qPrintable(refusal));
    }
    ServerSession session(place, "P01");
    session.stepUntil("Presenting");
    session.send(study::session::Voided{"wrong piece"});  // its answers so far do not count
    session.playToEnd();
    QCOMPARE(session.store.slots().front().state, database::SlotState::Finished);
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

void WholeSessionsTest::aFinishedSessionGetsNoVoid()
{
    studyOfAnna("ended");
    const StudyFolder place{joinStudy(as("anna", "ended"), m_folder.filePath("ended-place").toStdString(), "one").folder};
    int events = 0;
    {
        ServerSession session(place, "P01");
        session.playToEnd();
        events = static_cast<int>(session.store.events(protocols::ParticipantId("P01")).size());
    }
    const ServerConnection anna(as("anna", "ended"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    auto voided = sentEntry("P01", events, "voided");
    voided["voids"] = 3;
    QVERIFY2(stored(anna, voided).contains("has finished"), qPrintable(stored(anna, voided)));
    auto hidden = sentEntry("P01", events, "noted");
    hidden["voids"] = 3;
    QVERIFY(stored(anna, hidden).contains("a trial with the event voided"));
    QCOMPARE(stored(anna, sentEntry("P01", events, "noted")), QString());
}

/// The log keeps what it has stored. What no report could use must not come into it.
void WholeSessionsTest::answersThatNoSessionWritesAreRefused()
{
    using nlohmann::json;
    const StudyFolder study = studyOfAnna("rows");
    const ServerConnection anna(as("anna", "rows")), owner(as("owner", "rows"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    anna.run("SELECT * FROM @schema@.presentation(1)");
    const auto planned = [&](const char* column) {
        const QString first =
            "SELECT t.%1 FROM @schema@.trials t JOIN @schema@.participants p ON p.slot = t.slot WHERE t.number = 1";
        return owner.value(first.arg(column)).toString().toStdString();
    };
    const std::string tray = planned("alternatives"), choice = json::parse(tray).at(0);
    json sound = sentEntry("P01", 0, "answered");
    sound["event"]["payload"] = json{{"fabric", choice}, {"entries", 2}}.dump();
    sound["finger"] = {{"trial", 1}, {"began_at", 2}, {"count", 2}, {"left_out", 0}, {"samples", "0,3120,2005,420;50,-12,,-3"}};
    sound["answers"].push_back({{"trial", 1},
                                {"question", "Q1"},
                                {"presentation_code", planned("presentation_code")},
                                {"alternatives", tray},
                                {"choice", choice},
                                {"rating_tenths", nullptr},
                                {"ready_at", 1},
                                {"touched_at", 2},
                                {"touched_by", "display"},
                                {"touch_ended_at", 3},
                                {"answer_begun_at", 3},
                                {"answer_begun_by", "entry"},
                                {"answered_at", 4},
                                {"entries", 2},
                                {"is_correction", false},
                                {"note", ""}});
    const std::int64_t most = std::numeric_limits<std::int64_t>::max();
    const std::tuple<const char*, json, const char*> changes[] = {
        {"/finger/samples", "-", "finger.samples"},
        {"/finger/samples", "0,1,2,3;5,1", "finger.samples"},
        {"/finger/samples", "0,1099511627776,,;1,1099511627776,,", "finger.samples"},
        {"/finger/count", 3, "finger.samples"},
        {"/finger/began_at", most, "finger.began_at"},
        {"/answers/0/ready_at", -most, "answers[0].ready_at"},
        {"/answers/0/answered_at", most, "answers[0].answered_at"},
        {"/answers/0/answered_at", 0, "answers[0].answered_at"},
        {"/answers/0/touched_at", 0, "answers[0].answered_at"},
        {"/answers/0/touch_ended_at", 1, "answers[0].answered_at"},
        {"/answers/0/answer_begun_at", 5, "answers[0].answered_at"},
        {"/answers/0/touched_by", "=cmd|' /C calc'!A0\u202e", "answers[0].touched_by"},
        {"/answers/0/answer_begun_by", "nobody", "answers[0].answer_begun_by"},
        {"/answers/0/entries", -7, "answers[0].entries"},
        {"/answers/0/presentation_code", "\x1b[2J", "answers[0].presentation_code"},
        {"/answers/0/is_correction", true, "there is no answer to correct"},
        {"/event/payload", R"({"fabric":"F99"})", "the answer that the payload of the event tells"},
        {"/event/payload", R"({"tenths":54})", "the answer that the payload of the event tells"},
        {"/event/payload", "{}", "the answer that the payload of the event tells"},
        {"/event/kind", "noted", "one answer with the events answered and corrected"},
        {"/answers", json::array(), "one answer with the events answered and corrected"},
        {"/event/wall_time", "292277026596-12-04T15:30:08Z\x1b[31m", "event.wall_time"},
        {"/event/at_ns", most, "event.at_ns"},
        {"/stored_at", most, "stored_at"},
    };
    for (const auto& [place, value, said] : changes) {
        json changed = sound;
        changed[json::json_pointer(place)] = value;
        const QString refusal = stored(anna, changed);
        QVERIFY2(refusal.contains(said), qPrintable(QString("%1: %2").arg(place, refusal)));
    }
    QCOMPARE(stored(anna, sound), QString());

    json corrected = sound;  // as the program sends it, without stamps
    corrected["id"] = sentEntry("P01", 1, "corrected")["id"];
    corrected["after"] = 1;
    corrected["event"]["kind"] = "corrected";
    corrected["event"]["payload"] = json{{"question", "Q2"}, {"fabric", choice}, {"why", "misheard"}}.dump();
    corrected["finger"] = nullptr;
    json& answer = corrected["answers"][0];
    for (const char* none : {"touched_at", "touched_by", "touch_ended_at", "answer_begun_at", "answer_begun_by", "entries"})
        answer[none] = nullptr;
    answer["ready_at"] = answer["answered_at"] = 0;
    answer["is_correction"] = true;
    QVERIFY(stored(anna, corrected).contains("the answer that the payload of the event tells"));
    corrected["event"]["payload"] = json{{"question", "Q1"}, {"fabric", choice}, {"why", "misheard"}}.dump();
    QCOMPARE(stored(anna, corrected), QString());
    QCOMPARE(readStudy(study).faults(), std::vector<std::string>());
}

/// Nobody could see afterwards that the station had had the image.
void WholeSessionsTest::aReleaseThatIsTakenBackGivesNoImage()
{
    studyOfAnna("back");
    const ServerConnection anna(as("anna", "back")), owner(as("owner", "back"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    const auto presented = [&] {
        QSqlQuery row = anna.run("SELECT image, key FROM @schema@.presentation(1)");
        return row.next() ? std::pair(row.value(0).toByteArray(), row.value(1).toString()) : std::pair<QByteArray, QString>();
    };
    const auto image = [&](const QByteArray& ticket) {
        return anna.value("SELECT key FROM @schema@.presented_image(?)", {QString::fromLatin1(ticket)}).toString();
    };
    anna.run("BEGIN");
    const auto [taken, key] = presented();
    QCOMPARE(key, QString());
    QCOMPARE(taken.size(), 64);
    const QString early = errorOf([&] { (void)image(taken); });
    QVERIFY2(early.contains("the transaction has written already"), qPrintable(early));
    anna.run("ROLLBACK");
    QCOMPARE(owner.value("SELECT count(*) FROM @schema@.server_releases").toInt(), 0);
    const QString late = errorOf([&] { (void)image(taken); });
    QVERIFY2(late.contains("no present presentation"), qPrintable(late));
    const auto [ticket, none] = presented();
    QCOMPARE(image(ticket).size(), 64);
    QCOMPARE(owner.value("SELECT count(*) FROM @schema@.server_releases").toInt(), 1);
    QCOMPARE(owner.value("SELECT login FROM @schema@.server_fetches").toString(), QString("anna"));
}

/// A server that crashes must not forget a presentation whose image went out.
void WholeSessionsTest::theRecordOfAReleaseIsOnTheDisk()
{
    studyOfAnna("disk");
    const ServerConnection owner(as("owner", "disk"));
    owner.run("ALTER DATABASE lab SET synchronous_commit = off");
    const ServerConnection anna(as("anna", "disk"));
    owner.run("ALTER DATABASE lab RESET synchronous_commit");
    QCOMPARE(anna.value("SHOW synchronous_commit").toString(), QString("off"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    anna.run("BEGIN");
    const QString ticket = anna.value("SELECT image FROM @schema@.presentation(1)").toString();
    QCOMPARE(anna.value("SHOW synchronous_commit").toString(), QString("on"));
    anna.run("COMMIT");
    anna.run("BEGIN");
    (void)anna.value("SELECT key FROM @schema@.presented_image(?)", {ticket});
    QCOMPARE(anna.value("SHOW synchronous_commit").toString(), QString("on"));
    anna.run("COMMIT");
}

void WholeSessionsTest::anImageIsForItsOwnStation()
{
    studyOfAnna("own");
    const ServerConnection anna(as("anna", "own")), bert(as("bert", "own")), owner(as("owner", "own"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    bert.call("join_study", {"two", QString(64, QLatin1Char('b')), "test"});
    bert.call("claim", {"P02", "human"});
    anna.run("SELECT * FROM @schema@.presentation(1)");
    const QString ticket = owner.value("SELECT ticket FROM @schema@.server_releases").toString();
    const QString other = errorOf([&] { (void)bert.value("SELECT key FROM @schema@.presented_image(?)", {ticket}); });
    QVERIFY2(other.contains("no present presentation"), qPrintable(other));
    owner.run("UPDATE @schema@.server_study SET images_to = 'display'");
    const QString display = errorOf([&] { (void)anna.value("SELECT key FROM @schema@.presented_image(?)", {ticket}); });
    QVERIFY2(display.contains("display's own login only"), qPrintable(display));
}

void WholeSessionsTest::aBusyStudyIsRefusedBeforeTheStationGivesUp()
{
    studyOfAnna("crowd");
    const ServerConnection anna(as("anna", "crowd")), owner(as("owner", "crowd"));
    anna.call("join_study", {"one", tokenOfOne, "test"});
    anna.call("claim", {"P01", "human"});
    owner.run("BEGIN");
    owner.run("SELECT * FROM @schema@.server_study FOR UPDATE");
    owner.run("SELECT * FROM @schema@.server_stations FOR UPDATE");
    const std::function<void()> steps[] = {[&] {
                                               anna.call("join_study", {"one", tokenOfOne, "test"});
                                           },
                                           [&] {
                                               anna.call("claim", {"P01", "human"});
                                           },
                                           [&] { anna.run("SELECT * FROM @schema@.presentation(1)"); }};
    for (const auto& step : steps) {
        QElapsedTimer timer;
        timer.start();
        const QString refusal = errorOf(step);
        QVERIFY2(refusal.contains("keeps the study busy") && refusal.contains("within 3 seconds"), qPrintable(refusal));
        QVERIFY2(timer.elapsed() < database::ServerPatience().presentation.count(), qPrintable(QString::number(timer.elapsed())));
    }
    owner.run("ROLLBACK");
}

QTEST_GUILESS_MAIN(WholeSessionsTest)
#include "whole_sessions_test.moc"
