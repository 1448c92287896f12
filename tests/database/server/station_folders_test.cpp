// The folders of a station when its server gets another name or address: entries that wait follow their study, and no other one.
#include "database/server/station_folders.h"

#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "database/disk/server_note.h"
#include "database/server/server_connection.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "protocols/files/whole_file.h"
#include "tests/support/error_text.h"
#include "tests/support/program.h"
#include "tests/support/server/cut_network.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using database::ServerAddress;
using database::StationStore;
using database::StudyFolder;

namespace {

namespace fs = std::filesystem;

ServerAddress addressOf(const std::string& text) { return database::serverAddressFrom(text); }

/// A session of P01 whose last answer waits in the folder when it is closed.
void leaveEntriesIn(const StudyFolder& place, CutNetwork& network)
{
    ServerSession session(place, "P01");
    session.playUntilAnswers(5);
    session.stepUntil("Presenting");
    network.cut();
    (void)errorOf([&] { session.step(); });
    QVERIFY(session.store.link().waiting > 0);
}

int foldersIn(const fs::path& stations)
{
    return static_cast<int>(std::distance(fs::directory_iterator(stations), fs::directory_iterator()));
}

}  // namespace

class StationFoldersTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void whatWaitsFollowsTheStudyToAnotherName_data();
    void whatWaitsFollowsTheStudyToAnotherName();
    void anotherStudyOfTheSameNameIsNotMixed();
    void whatWaitsInAFurtherFolderIsSentAtOnce();
    void aFolderFromAnEarlierVersionIsRefusedWhereItsStudyIsUnknown();
    void aFolderFollowsANewStudyOnlyWhereNothingWaits();
    void joinGivesAFolderItsNewAddress();

private:
    StudyFolder studyOn(const PrivateServer& server, const std::string& name, const StudyRecipe& recipe = {})
    {
        const StudyFolder folder = buildStudy(path(name + "-owner" + std::to_string(++m_made)), recipe);
        moveToServer(folder, addressOf(server.address(name)), "owner");
        return folder;
    }
    /// The address by which a relay leads to the server, and one of the server itself under another name.
    ServerAddress through(const CutNetwork& network, const std::string& study) const
    {
        return addressOf(m_server->address(study, "owner", network.port()));
    }
    ServerAddress renamed(const std::string& study) const
    {
        return addressOf("postgresql://owner@localhost:" + std::to_string(m_server->port()) + "/lab?study=" + study);
    }
    fs::path path(const std::string& name) const { return m_folder.filePath(QString::fromStdString(name)).toStdString(); }
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
    int m_made = 0;
};

void StationFoldersTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
}

void StationFoldersTest::whatWaitsFollowsTheStudyToAnotherName_data()
{
    QTest::addColumn<bool>("hasOtherHost");
    QTest::newRow("other-port") << false;
    QTest::newRow("other-host") << true;
}

void StationFoldersTest::whatWaitsFollowsTheStudyToAnotherName()
{
    QFETCH(const bool, hasOtherHost);
    const std::string name = QTest::currentDataTag();
    const StudyFolder owner = studyOn(*m_server, name);
    const fs::path stations = path("stations-" + name);
    CutNetwork network(m_server->port());
    const StudyFolder place{stationFolder(through(network, name), stations, "left")};
    leaveEntriesIn(place, network);
    const auto before = database::readServerNote(place.folder).value();
    QCOMPARE(before.study.size(), std::size_t{64});
    const ServerAddress now = hasOtherHost ? renamed(name) : addressOf(m_server->address(name));
    QCOMPARE(stationFolder(now, stations, "left").string(), place.folder.string());
    QCOMPARE(foldersIn(stations), 1);
    const auto after = database::readServerNote(place.folder).value();
    QCOMPARE(after.address, now.text);
    QCOMPARE(after.token, before.token);
    QVERIFY(database::entriesWaiting(place) > 0);  // they are sent when the folder is opened
    {
        ServerSession session(place, "P01");
        QCOMPARE(session.store.link().waiting, std::size_t{0});
        QCOMPARE(session.store.link().setAside, std::string());
        session.playToEnd();
    }
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
    QCOMPARE(stationFolder(now, stations, "left").string(), place.folder.string());
}

/// Both servers have the same host name, so that even the name of the folder is the same.
void StationFoldersTest::anotherStudyOfTheSameNameIsNotMixed()
{
    const PrivateServer otherServer;
    const StudyFolder owner = studyOn(*m_server, "pilot"), otherOwner = studyOn(otherServer, "pilot", {.fabrics = 4});
    const fs::path stations = path("stations-pilot");
    CutNetwork network(m_server->port());
    const StudyFolder place{stationFolder(through(network, "pilot"), stations, "left")};
    leaveEntriesIn(place, network);
    const std::size_t waiting = database::entriesWaiting(place);
    const auto note = database::readServerNote(place.folder).value();
    const QString refusal = errorOf([&] { takeAddress(addressOf(otherServer.address("pilot")), place); });
    QVERIFY2(refusal.contains("another study"), qPrintable(refusal));
    const StudyFolder other{stationFolder(addressOf(otherServer.address("pilot")), stations, "left")};
    QVERIFY(other.folder != place.folder);
    QCOMPARE(database::entriesWaiting(place), waiting);
    QCOMPARE(database::readServerNote(place.folder)->address, note.address);
    {
        ServerSession session(other, "P01");
        session.playUntilAnswers(2);
    }
    QCOMPARE(readStudy(otherOwner).answerCount(), std::size_t{2});
    const ServerAddress unnamed = addressOf("postgresql://owner@127.0.0.1:" + std::to_string(otherServer.port()) + "/lab");
    QCOMPARE(stationFolder(unnamed, stations, "left").string(), other.folder.string());
    network.mend();
    QCOMPARE(stationFolder(through(network, "pilot"), stations, "left").string(), place.folder.string());
    ServerSession(place, "P01").playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(otherOwner).answerCount(), std::size_t{2});
    QCOMPARE(foldersIn(stations), 2);
}

/// Earlier versions made a new folder for each name of the server.
void StationFoldersTest::whatWaitsInAFurtherFolderIsSentAtOnce()
{
    const StudyFolder owner = studyOn(*m_server, "twice");
    const fs::path stations = path("stations-twice");
    CutNetwork network(m_server->port());
    const StudyFolder first{stationFolder(through(network, "twice"), stations, "left")};
    leaveEntriesIn(first, network);
    const StudyFolder second{stations / "twice-lab-localhost"};
    // The server may need a moment to notice the cut.
    QTRY_VERIFY_WITH_TIMEOUT(std::filesystem::exists(database::serverNoteOf(second.folder)) ||
                                 errorOf([&] { joinStudy(renamed("twice"), second.folder, "left"); }).isEmpty(),
                             40000);
    const int answers = static_cast<int>(readStudy(owner).answerCount());
    QCOMPARE(stationFolder(renamed("twice"), stations, "left").string(), second.folder.string());
    QCOMPARE(database::entriesWaiting(first), std::size_t{0});
    QCOMPARE(static_cast<int>(readStudy(owner).answerCount()), answers + 1);
    ServerSession(second, "P01").playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

void StationFoldersTest::aFolderFromAnEarlierVersionIsRefusedWhereItsStudyIsUnknown()
{
    studyOn(*m_server, "early");
    const fs::path stations = path("stations-early");
    CutNetwork network(m_server->port());
    const StudyFolder place{stationFolder(through(network, "early"), stations, "left")};
    leaveEntriesIn(place, network);
    auto note = database::readServerNote(place.folder).value();
    note.study.clear();
    writeServerNote(place.folder, note);
    const std::string protocol = protocols::readIfPossible(place.protocol()).value();
    std::ofstream(place.protocol(), std::ios::binary) << "{}";
    const QString refusal = errorOf([&] { (void)stationFolder(renamed("early"), stations, "left"); });
    QVERIFY2(refusal.contains(" wait in the folder of this station") &&
                 refusal.contains(QString::fromStdString(place.folder.string())),
             qPrintable(refusal));
    QCOMPARE(foldersIn(stations), 1);
    std::ofstream(place.protocol(), std::ios::binary) << protocol;
    QCOMPARE(stationFolder(renamed("early"), stations, "left").string(), place.folder.string());
    QCOMPARE(StationStore(place).link().waiting, std::size_t{0});
}

void StationFoldersTest::aFolderFollowsANewStudyOnlyWhereNothingWaits()
{
    studyOn(*m_server, "again");
    CutNetwork network(m_server->port());
    const StudyFolder place{stationFolder(through(network, "again"), path("stations-again"), "left")};
    const auto ofAnotherStudy = [&] {
        auto note = database::readServerNote(place.folder).value();
        note.study = std::string(64, 'e');
        writeServerNote(place.folder, note);
    };
    ofAnotherStudy();
    {
        const StationStore store(place);
    }
    QVERIFY(database::readServerNote(place.folder)->study != std::string(64, 'e'));
    leaveEntriesIn(place, network);
    const std::size_t waiting = database::entriesWaiting(place);
    ofAnotherStudy();
    network.mend();
    const QString refusal = errorOf([&] { const StationStore store(place); });
    QVERIFY2(refusal.contains("the server has another study of this name"), qPrintable(refusal));
    QCOMPARE(database::entriesWaiting(place), waiting);
}

void StationFoldersTest::joinGivesAFolderItsNewAddress()
{
    const StudyFolder owner = studyOn(*m_server, "chosen");
    CutNetwork network(m_server->port());
    const StudyFolder place{joinStudy(through(network, "chosen"), path("chosen-place"), "left").folder};
    leaveEntriesIn(place, network);
    const auto result = support::runProgram(
        {"study", "join", QString::fromStdString(renamed("chosen").text), QString::fromStdString(place.folder.string())});
    QVERIFY2(result.exitCode == 0 && result.out.contains("uses the new address"), qPrintable(result.out + result.err));
    ServerSession(place, "P01").playToEnd();
    QCOMPARE(readStudy(owner).answerCount(), std::size_t{24});
}

QTEST_GUILESS_MAIN(StationFoldersTest)
#include "station_folders_test.moc"
