// Sessions at the stations of a study on a server: the same rows as in a folder, through kills, cuts and restarts.
#include <dlfcn.h>
#include <pthread.h>

#include <QElapsedTimer>
#include <QRandomGenerator>
#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <cerrno>
#include <functional>
#include <mutex>
#include <thread>

#include "database/disk/server_note.h"
#include "database/server/server_connection.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "tests/support/error_text.h"
#include "tests/support/server/cut_network.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/whole_protocol.h"

using namespace tests::support;
using namespace study::session;
using database::ServerConnection;
using database::StationStore;
using database::StudyFolder;
using database::StudyStore;

namespace {

thread_local bool startsNoThread = false;  ///< only this thread: the server and the network of the tests have others

/// With VIS2HAP_LONG=1 some tests are as long as a study is.
bool isLong() { return qEnvironmentVariableIntValue("VIS2HAP_LONG") > 0; }

/// 252 answers for each participant.
StudyRecipe longRecipe(int participants)
{
    return {.fabrics = 7,
            .conditions = {"v_grey", "v_shape", "f_g", "h_g", "h_g&f_g", "t_grey", "f", "h", "h&f"},
            .participants = participants};
}

/// What a tired operator does in a session: notes, voids, corrections, pauses.
void playEventfully(SessionHands& session)
{
    session.playUntilAnswers(3);
    session.send(Noted{"a note with \"quotes\" and \xc3\xa9", true});
    session.stepUntil("Presenting");
    session.send(Voided{"wrong piece"});
    session.send(Noted{"a remark on what was voided"});
    session.playUntilAnswers(8);
    session.stepUntil("Presenting");
    const View asked = session.driver->view();
    session.send(Answered{responseTo(asked)});
    session.send(Corrected{asked.question->id, responseTo(asked), "misheard"});
    session.send(Paused{});
    session.playToEnd();
}

/// Repeats what a busy study refuses, as an operator does.
void untilFree(const std::function<void()>& call)
{
    for (int tries = 0;; ++tries) try {
            return call();
        } catch (const database::ServerRefusal& refusal) {
            if (refusal.rule() != "VH302" || tries == 20) throw;
        }
}

/// Rows of a participant's log without what a second run must have anew: numbers, hashes, salts and wall times.
std::vector<std::string> logOf(const StudyStore& store, const std::string& participant)
{
    std::vector<std::string> lines;
    for (const auto& event : store.events(protocols::ParticipantId(participant))) {
        const auto at = event.payloadJson.find("\"facts_sha256\"");
        lines.push_back(event.kind + " " + std::to_string(event.sitting) + " " + std::to_string(event.atNs) + " " +
                        event.payloadJson.substr(0, at));
    }
    return lines;
}

}  // namespace

/// The linker prefers this definition to that of the C library.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* of) noexcept
{
    static const auto original = reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
    return startsNoThread ? EAGAIN : original(thread, attributes, run, of);
}

class StationsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void aSessionStoresTheRowsOfAFolder();
    void aStationGoesOnWhereAnotherWasLost();
    void aCutNetworkLosesAndDoublesNothing();
    void aCutAfterFactsOrADebriefingEndsNoSession();
    void factsThatWaitedWithoutASessionAreSent();
    void aLongAnswerInWordsIsStored();
    void aCutWhileWaitingEntriesAreSentLosesNothing();
    void aSilentNetworkStopsNobodyForLong();
    void aStationWithoutAThreadTriesAgain();
    void aSilentNetworkIsNoticedWithoutAnAnswer();
    void theServersDeathLosesNothing();
    void aHundredClaimsTakeAHundredPlaces();
    void whatWaitedTooLongIsKeptAside();
    void answersWaitWhileTheStudyIsBeingMoved();
    void nothingAheadIsGivenOut();
    void sixteenStationsAtOnce();

private:
    /// A study on the server, and its owner's folder.
    StudyFolder studyOnServer(const std::string& name, StudyRecipe recipe = {});
    StudyFolder station(const std::string& study, const std::string& name, int port = 0);
    /// The study's rows as they stand on the server.
    StudyStore rowsOf(const StudyFolder& owner) const { return readStudy(owner); }
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
};

void StationsTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
}

StudyFolder StationsTest::studyOnServer(const std::string& name, StudyRecipe recipe)
{
    const StudyFolder folder = buildStudy(m_folder.filePath(QString::fromStdString(name)).toStdString(), recipe);
    moveToServer(folder, database::serverAddressFrom(m_server->address(name)), "owner");
    return folder;
}

StudyFolder StationsTest::station(const std::string& study, const std::string& name, int port)
{
    const auto folder = m_folder.filePath(QString::fromStdString(study + "-" + name)).toStdString();
    return {joinStudy(database::serverAddressFrom(m_server->address(study, "owner", port)), folder, name).folder};
}

void StationsTest::aSessionStoresTheRowsOfAFolder()
{
    const StudyFolder file = buildStudy(m_folder.filePath("file").toStdString(), wholeStudy());
    const StudyFolder owner = studyOnServer("rows", wholeStudy());
    const StudyFolder place = station("rows", "left");
    {
        OpenSession direct(file, "P01", database::ParticipantKind::Human);
        playEventfully(direct);
        ServerSession served(place, "P01");
        playEventfully(served);
        QCOMPARE(served.display.calls, direct.display.calls);
        QCOMPARE(served.driver->view().answersStored, direct.driver->view().answersStored);
    }
    const StudyStore expected(file, StudyStore::Access::Read), stored = rowsOf(owner);
    QCOMPARE(linesOf(stored), linesOf(expected));
    QCOMPARE(logOf(stored, "P01"), logOf(expected, "P01"));
    QCOMPARE(stored.personalFacts(), expected.personalFacts());
    QCOMPARE(stored.flags().size(), expected.flags().size());
    QCOMPARE(stored.faults(), std::vector<std::string>());
    for (std::size_t i = 0; i < stored.answers().size(); ++i) {
        QCOMPARE(stored.answers()[i].record.answeredAtNs, expected.answers()[i].record.answeredAtNs);
        QCOMPARE(stored.answers()[i].record.note, expected.answers()[i].record.note);
    }
}

void StationsTest::aStationGoesOnWhereAnotherWasLost()
{
    const StudyFolder owner = studyOnServer("lost");
    const StudyFolder left = station("lost", "left"), right = station("lost", "right");
    auto lost = std::make_unique<ServerSession>(left, "P01");
    lost->playUntilAnswers(7);
    const QString refusal = errorOf([&] { ServerSession(right, "P01"); });
    QVERIFY2(refusal.contains("is at station left"), qPrintable(refusal));
    const QString sameName = errorOf([&] {
        const auto twin = m_folder.filePath("twin").toStdString();
        joinStudy(database::serverAddressFrom(m_server->address("lost")), twin, "left");
    });
    QVERIFY2(sameName.contains("another connection has joined as station left"), qPrintable(sameName));
    const QString busy = errorOf([&] { moveToFolder(database::serverAddressFrom(m_server->address("lost")), owner); });
    QVERIFY2(busy.contains("stations are in sessions: left"), qPrintable(busy));
    lost.reset();
    ServerSession found(right, "P01");
    found.playToEnd();
    QCOMPARE(rowsOf(owner).faults(), std::vector<std::string>());
    QCOMPARE(rowsOf(owner).answerCount(), std::size_t{24});
    QCOMPARE(found.store.slots().front().state, database::SlotState::Finished);
}

/// As an operator does who reads on the page that the server is away.
void waitForServer(ServerSession& session)
{
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().isUp && session.store.link().waiting == 0), 20000);
}

/// Plays on while the network comes and goes: a presentation that needs the server waits, an answer does not.
void playThroughCuts(ServerSession& session, const std::function<void()>& disturb)
{
    for (int steps = 0; steps < 5000; ++steps) {
        if (steps % 4 == 3) disturb();
        try {
            if (!session.step()) return;
        } catch (const protocols::Error&) {
            waitForServer(session);
        }
        session.store.refresh();
    }
    QFAIL("the session does not end");
}

void StationsTest::aCutNetworkLosesAndDoublesNothing()
{
    const StudyRecipe recipe = isLong() ? longRecipe(2) : StudyRecipe{.fabrics = 4};
    const StudyFolder file = buildStudy(m_folder.filePath("cut-file").toStdString(), recipe);
    const StudyFolder owner = studyOnServer("cut", recipe);
    CutNetwork network(m_server->port());
    const StudyFolder place = station("cut", "left", network.port());
    int cuts = 0;
    {
        ServerSession session(place, "P01");
        std::thread repair;
        playThroughCuts(session, [&] {
            if (repair.joinable()) repair.join();
            network.cut();
            ++cuts;
            repair = std::thread([&] {
                std::this_thread::sleep_for(std::chrono::milliseconds(QRandomGenerator::global()->bounded(1, 80)));
                network.mend();
            });
        });
        repair.join();
        waitForServer(session);
    }
    QVERIFY2(cuts >= (isLong() ? 50 : 10), qPrintable(QString::number(cuts)));
    qInfo("%d cuts in a session of %d answers", cuts, isLong() ? 252 : 32);
    const StudyStore stored = rowsOf(owner);
    {
        OpenSession direct(file, "P01", database::ParticipantKind::Human);
        direct.playToEnd();
    }
    QCOMPARE(linesOf(stored), linesOf(StudyStore(file, StudyStore::Access::Read)));
    QCOMPARE(stored.faults(), std::vector<std::string>());
    std::int64_t last = 0;  // in the order in which they were given
    for (const auto& event : stored.events(protocols::ParticipantId("P01"))) {
        if (event.kind != "answered") continue;
        QVERIFY(event.atNs > last);
        last = event.atNs;
    }
}

/// Cuts the network, waits until the station has noticed it, and mends it.
void cutAndMend(CutNetwork& network, ServerSession& session)
{
    network.cut();
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), !session.store.link().isUp), 20000);
    network.mend();
    waitForServer(session);
}

void requireSound(const ServerSession& session)
{
    QCOMPARE(session.store.link().stale, std::string());
    QCOMPARE(session.store.link().setAside, std::string());
}

/// The payload of these events holds hashes of the facts, which the station must hold, too.
void StationsTest::aCutAfterFactsOrADebriefingEndsNoSession()
{
    const StudyFolder owner = studyOnServer("facts", wholeStudy());
    CutNetwork network(m_server->port());
    ServerSession session(station("facts", "left", network.port()), "P01");
    session.stepUntil("AskingFacts");
    session.step();
    cutAndMend(network, session);
    requireSound(session);
    session.stepUntil("Presenting");
    network.cut();
    (void)errorOf([&] { session.step(); });
    QVERIFY(session.store.link().waiting > 0);
    network.mend();
    waitForServer(session);
    requireSound(session);
    session.stepUntil("Debriefing");
    network.cut();
    session.send(Debriefed{"the cloth was soft"});
    QCOMPARE(session.store.link().waiting, std::size_t{1});
    network.mend();
    waitForServer(session);
    requireSound(session);
    cutAndMend(network, session);
    requireSound(session);
    const StudyStore stored = rowsOf(owner);
    QCOMPARE(stored.answerCount(), static_cast<std::size_t>(answersOf({})));
    QCOMPARE(stored.enrolments().front().state, database::SlotState::Finished);
    QCOMPARE(stored.faults(), std::vector<std::string>());
}

/// As the queue of an earlier version holds them: nobody has the session open when they are sent.
void StationsTest::factsThatWaitedWithoutASessionAreSent()
{
    const StudyFolder owner = studyOnServer("waited", wholeStudy());
    CutNetwork network(m_server->port());
    const StudyFolder place = station("waited", "left", network.port());
    {
        ServerSession session(place, "P01");
        session.stepUntil("AskingFacts");
        network.cut();
        session.step();
        QCOMPARE(session.store.link().waiting, std::size_t{1});
    }
    network.mend();
    {
        const StationStore store(place);
        QCOMPARE(store.link().waiting, std::size_t{0});
        QCOMPARE(store.link().setAside, std::string());
    }
    QVERIFY(!rowsOf(owner).personalFacts().empty());
    ServerSession session(place, "P01");
    cutAndMend(network, session);
    requireSound(session);
    session.playToEnd();
    QCOMPARE(rowsOf(owner).faults(), std::vector<std::string>());
}

/// 334 characters of Chinese have more than 1,000 bytes.
void StationsTest::aLongAnswerInWordsIsStored()
{
    const StudyFolder owner = studyOnServer("words", wholeStudy());
    CutNetwork network(m_server->port());
    ServerSession session(station("words", "left", network.port()), "P01");
    const auto isAskedForWords = [&] {
        const View view = session.driver->view();
        return nameOf(view.state) == "Presenting" && std::holds_alternative<protocols::FreeText>(view.question->kind);
    };
    const std::string chinese = QString(400, QChar(0x8f6f)).toStdString(), longest(database::longestText, 'x');
    while (!isAskedForWords()) session.step();
    const auto refusal = session.driver->send(Answered{Words{longest + "x"}});
    QVERIFY(refusal && refusal->reason.find("longer than 100,000 bytes") != std::string::npos);
    session.send(Answered{Words{chinese}});
    for (const std::string& waiting : {chinese, longest}) {
        while (!isAskedForWords()) session.step();
        network.cut();
        (void)errorOf([&] { session.send(Answered{Words{waiting}}); });  // the answer waits; the next tray needs the server
        QVERIFY(session.store.link().waiting > 0);
        network.mend();
        waitForServer(session);
        requireSound(session);
    }
    session.playToEnd();
    const StudyStore stored = rowsOf(owner);
    const auto answers = stored.answers();
    for (const auto& [text, times] : {std::pair(chinese, 2), std::pair(longest, 1)})
        QCOMPARE(static_cast<int>(std::ranges::count_if(answers, [&](const auto& one) { return one.record.answer == text; })),
                 times);
    QCOMPARE(stored.faults(), std::vector<std::string>());
}

/// The network is cut again while many entries are on their way, and the operator goes on.
void StationsTest::aCutWhileWaitingEntriesAreSentLosesNothing()
{
    constexpr int notes = 150;
    const StudyFolder owner = studyOnServer("again");
    CutNetwork network(m_server->port());
    ServerSession session(station("again", "left", network.port()), "P01");
    session.stepUntil("Presenting");
    int noted = 0;
    const auto note = [&] { session.send(Noted{"note " + std::to_string(++noted), false}); };
    network.cut();
    for (int i = 0; i < notes; ++i) note();
    QCOMPARE(session.store.link().waiting, std::size_t{notes});
    network.mend();
    std::thread cutter([&] {
        const ServerConnection server(database::serverAddressFrom(m_server->address("again")));
        const auto arrived = [&] { return server.value("SELECT count(*) FROM @schema@.server_received").toInt(); };
        for (const int before = arrived(); arrived() < before + 5;) QThread::msleep(2);
        network.cut();
    });
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().waiting < notes && !session.store.link().isUp),
                             20000);
    cutter.join();
    QVERIFY(session.store.link().waiting > 0);
    note();
    note();
    network.mend();
    waitForServer(session);
    QVERIFY2(session.store.link().fault.empty(), session.store.link().fault.c_str());
    QCOMPARE(session.store.events(protocols::ParticipantId("P01")).size(),
             rowsOf(owner).events(protocols::ParticipantId("P01")).size());
    std::vector<std::string> expected, found;
    for (int i = 1; i <= noted; ++i) expected.push_back("note " + std::to_string(i));
    for (const auto& event : rowsOf(owner).events(protocols::ParticipantId("P01")))
        if (event.kind == "noted") found.push_back(nlohmann::json::parse(event.payloadJson).at("text").get<std::string>());
    QCOMPARE(found, expected);
    session.playToEnd();
    QCOMPARE(rowsOf(owner).answerCount(), std::size_t{24});
    QCOMPARE(rowsOf(owner).faults(), std::vector<std::string>());
}

void StationsTest::aSilentNetworkStopsNobodyForLong()
{
    const StudyFolder owner = studyOnServer("silent");
    CutNetwork network(m_server->port());
    const StudyFolder place = station("silent", "left", network.port());
    ServerSession session(place, "P01", database::ParticipantKind::Human, false, {});
    session.stepUntil("Presenting");
    network.silence();
    QElapsedTimer timer;
    timer.start();
    QVERIFY(errorOf([&] { session.step(); }).contains("server"));  // the answer goes into the queue, the next tray waits
    QVERIFY2(timer.elapsed() < 3000, qPrintable(QString::number(timer.elapsed())));
    QVERIFY(!session.store.link().isUp);
    QVERIFY(session.store.link().waiting > 0);
    QVERIFY(!session.store.link().fault.empty());
    timer.restart();
    for (int i = 0; i < 20; ++i) session.store.refresh();
    QVERIFY2(timer.elapsed() < 500, qPrintable(QString::number(timer.elapsed())));
    network.mend();
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), session.store.link().isUp), 20000);
    session.playToEnd();
    QCOMPARE(session.store.link().waiting, std::size_t{0});
    QCOMPARE(rowsOf(owner).answerCount(), std::size_t{24});
}

/// The window looks after its station every two seconds, by a timer that nobody can catch a fault of.
void StationsTest::aStationWithoutAThreadTriesAgain()
{
    const StudyFolder owner = studyOnServer("threads");
    CutNetwork network(m_server->port());
    ServerSession session(station("threads", "left", network.port()), "P01");
    session.stepUntil("Presenting");
    network.cut();
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), !session.store.link().isUp), 20000);
    const auto fault = [&] { return QString::fromStdString(session.store.link().fault); };
    startsNoThread = true;
    QTRY_VERIFY_WITH_TIMEOUT((session.store.refresh(), fault().contains("close other programs")), 20000);
    startsNoThread = false;
    QVERIFY(!session.store.link().isRefused);
    network.mend();
    waitForServer(session);
    session.playToEnd();
    QCOMPARE(rowsOf(owner).faults(), std::vector<std::string>());
}

void StationsTest::aSilentNetworkIsNoticedWithoutAnAnswer()
{
    const StudyFolder owner = studyOnServer("unanswered");
    CutNetwork network(m_server->port());
    const StudyFolder place = station("unanswered", "left", network.port());
    ServerSession session(place, "P01", database::ParticipantKind::Human, false, {});
    session.stepUntil("Presenting");
    network.silence();
    session.store.refresh();
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    session.store.refresh();
    QVERIFY(session.store.link().isUp);  // a slow reply is no lost server
    network.mend();
    QTRY_VERIFY((session.store.refresh(), session.store.link().isUp));
    QTest::qWait(300);
    session.store.refresh();  // takes the late reply and gives the next sign
    network.silence();
    QElapsedTimer timer;
    timer.start();
    while (session.store.link().isUp && timer.elapsed() < 5000) {
        QTest::qWait(100);
        session.store.refresh();
    }
    QVERIFY2(timer.elapsed() < 3000, qPrintable(QString::number(timer.elapsed())));
    QVERIFY2(session.store.link().fault.find("the server does not answer") != std::string::npos,
             session.store.link().fault.c_str());
    QCOMPARE(session.store.link().waiting, std::size_t{0});
    network.mend();
    waitForServer(session);
    QVERIFY(session.store.link().fault.empty());
    session.playToEnd();
    QCOMPARE(rowsOf(owner).answerCount(), std::size_t{24});
}

void StationsTest::theServersDeathLosesNothing()
{
    const int lives = isLong() ? 100 : 4, answers = isLong() ? 252 : 24;
    const StudyFolder owner = studyOnServer("death", isLong() ? longRecipe(2) : StudyRecipe());
    const StudyFolder place = station("death", "left");
    int acknowledged = 0;
    for (int life = 0; life < lives; ++life) {
        std::unique_ptr<ServerSession> session;
        const QString fault = errorOf([&] { session = std::make_unique<ServerSession>(place, "P01"); });
        QVERIFY2(fault.isEmpty(), qPrintable(fault));
        QVERIFY(session->driver->state().answersStored >= acknowledged);
        session->playUntilAnswers(acknowledged + (isLong() ? 1 : 4));
        acknowledged = session->driver->state().answersStored;
        std::thread death([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(QRandomGenerator::global()->bounded(0, 30)));
            m_server->kill();
        });
        try {
            while (session->step()) acknowledged = session->driver->state().answersStored;
        } catch (const protocols::Error&) {
            acknowledged = session->driver->state().answersStored;
        }
        death.join();
        m_server->start();
    }
    ServerSession last(place, "P01");
    last.playToEnd();
    QCOMPARE(rowsOf(owner).answerCount(), static_cast<std::size_t>(answers));
    QCOMPARE(rowsOf(owner).faults(), std::vector<std::string>());
}

void StationsTest::aHundredClaimsTakeAHundredPlaces()
{
    const StudyFolder owner = studyOnServer("many", {.participants = 100});
    const auto address = database::serverAddressFrom(m_server->address("many"));
    std::vector<std::thread> stations;
    std::atomic<int> refused = 0;
    for (int number = 1; number <= 100; ++number)
        stations.emplace_back([&, number] {
            try {
                const ServerConnection server(address);
                const QString token = QString("%1").arg(number, 64, 10, QLatin1Char('0'));
                untilFree([&] { server.call("join_study", {QString("station %1").arg(number), token, "test"}); });
                untilFree([&] { server.call("claim", {QString("P%1").arg(number, 3, 10, QLatin1Char('0')), "human"}); });
            } catch (const protocols::Error&) {
                ++refused;
            }
        });
    for (std::thread& one : stations) one.join();
    QCOMPARE(refused.load(), 0);
    std::set<int> taken;
    for (const auto& one : rowsOf(owner).enrolments()) taken.insert(one.slot);
    QCOMPARE(taken.size(), std::size_t{100});
    const QString full = errorOf([&] { ServerSession(owner, "P101"); });
    QVERIFY2(full.contains("all slots of the study are taken"), qPrintable(full));
}

/// A station without network whose participant went on elsewhere: its answers are kept, and it says so.
void StationsTest::whatWaitedTooLongIsKeptAside()
{
    const StudyFolder owner = studyOnServer("late");
    CutNetwork network(m_server->port());
    const StudyFolder left = station("late", "left", network.port()), right = station("late", "right");
    {
        ServerSession session(left, "P01");
        session.playUntilAnswers(9);
        session.stepUntil("Presenting");
        network.cut();
        (void)errorOf([&] { session.step(); });  // the last answer to a presentation also asks for the next one
        QVERIFY(session.store.link().waiting > 0);
    }
    QTRY_VERIFY_WITH_TIMEOUT(errorOf([&] { ServerSession(right, "P01"); }).isEmpty(), 40000);
    {
        ServerSession session(right, "P01");
        session.playToEnd();
    }
    network.mend();
    const StationStore store(left);
    QCOMPARE(store.link().waiting, std::size_t{0});
    const QString kept = QString::fromStdString(store.link().setAside);
    QVERIFY2(kept.contains("P01") && kept.contains("not-sent-P01"), qPrintable(kept));
    QCOMPARE(rowsOf(owner).answerCount(), std::size_t{24});
    QCOMPARE(rowsOf(owner).faults(), std::vector<std::string>());
}

void StationsTest::answersWaitWhileTheStudyIsBeingMoved()
{
    const StudyFolder owner = studyOnServer("moving");
    CutNetwork network(m_server->port());
    const StudyFolder place = station("moving", "left", network.port());
    {
        ServerSession session(place, "P01");
        session.stepUntil("Presenting");
        network.cut();
        (void)errorOf([&] { session.step(); });
        QVERIFY(session.store.link().waiting > 0);
    }
    network.mend();
    const auto address = database::serverAddressFrom(m_server->address("moving"));
    ServerConnection(address).run("UPDATE @schema@.server_study SET state = 'leaving'");
    const QString refusal = errorOf([&] { const StationStore store(place); });
    QVERIFY2(refusal.contains("the study is being moved"), qPrintable(refusal));
    ServerConnection(address).run("UPDATE @schema@.server_study SET state = 'open'");
    const StationStore store(place);
    QCOMPARE(store.link().waiting, std::size_t{0});
    QVERIFY2(store.link().fault.empty(), store.link().fault.c_str());
    QCOMPARE(rowsOf(owner).answerCount(), std::size_t{1});
}

void StationsTest::nothingAheadIsGivenOut()
{
    studyOnServer("ahead");
    ServerSession session(station("ahead", "left"), "P01");
    session.playUntilAnswers(5);
    const int due = session.driver->view().presentation;
    const auto trials = session.store.trials(1);
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const bool isAhead = static_cast<int>(i) + 1 > due;
        QCOMPARE(trials[i].sealedCode.empty(), isAhead);
        QCOMPARE(trials[i].alternatives.empty(), isAhead);
        if (!isAhead) continue;
        const QString refusal = errorOf([&] { session.store.dueTrial(1, trials[i].number); });
        QVERIFY2(refusal.contains("not due yet"), qPrintable(refusal));
    }
}

/// With VIS2HAP_LONG=1: 10,080 answers, one a second at each station, and the time from the answer to the next presentation.
void StationsTest::sixteenStationsAtOnce()
{
    const StudyRecipe recipe = isLong() ? longRecipe(40) : StudyRecipe{.participants = 16};
    const StudyFolder owner = studyOnServer("busy", recipe);
    std::vector<StudyFolder> places;
    for (int number = 1; number <= 16; ++number) places.push_back(station("busy", "s" + std::to_string(number)));
    std::mutex mutex;
    std::vector<double> milliseconds;
    QStringList faults;
    std::vector<std::thread> operators;
    for (int number = 0; number < 16; ++number)
        operators.emplace_back([&, number] {
            for (int person = number + 1; person <= recipe.participants; person += 16) {
                const QString fault = errorOf([&] {
                    ServerSession session(places[static_cast<std::size_t>(number)], "P" + std::to_string(100 + person));
                    for (bool goesOn = true; goesOn;) {
                        const int before = session.driver->state().answersStored;
                        const auto began = std::chrono::steady_clock::now();
                        goesOn = session.step();
                        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - began;
                        if (session.driver->state().answersStored == before) continue;
                        {
                            const std::lock_guard lock(mutex);
                            milliseconds.push_back(took.count());
                        }
                        if (isLong()) std::this_thread::sleep_until(began + std::chrono::seconds(1));
                    }
                });
                const std::lock_guard lock(mutex);
                if (!fault.isEmpty()) faults << fault;
            }
        });
    for (std::thread& one : operators) one.join();
    QCOMPARE(faults, QStringList());
    const StudyStore stored = rowsOf(owner);
    QCOMPARE(stored.faults(), std::vector<std::string>());
    QCOMPARE(stored.answerCount(), milliseconds.size());
    QCOMPARE(stored.answerCount(), std::size_t(isLong() ? 10080 : 384));
    std::sort(milliseconds.begin(), milliseconds.end());
    const double median = milliseconds[milliseconds.size() / 2], p99 = milliseconds[milliseconds.size() * 99 / 100];
    qInfo("%zu answers at 16 stations: median %.1f ms, 99th percentile %.1f ms", milliseconds.size(), median, p99);
    if (isLong()) QVERIFY2(p99 <= 50, qPrintable(QString::number(p99)));
}

QTEST_GUILESS_MAIN(StationsTest)
#include "stations_test.moc"
