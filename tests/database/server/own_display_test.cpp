// A display with a login of its own: the images of presentations go past the station, so that nobody there can tell which
// presentations have the same image.
#include <QProcess>
#include <QRegularExpression>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>
#include <map>
#include <opencv2/core.hpp>
#include <random>
#include <utility>

#include "database/keys.h"
#include "database/server/server_connection.h"
#include "database/server/server_rights.h"
#include "database/server/server_roles.h"
#include "database/server/study_move.h"
#include "rendering/images/image_io.h"
#include "study/session/station_images.h"
#include "tests/support/error_text.h"
#include "tests/support/server/private_server.h"
#include "tests/support/server/server_session.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using database::ServerConnection;
using database::StudyFolder;

namespace {

/// The reference display, which keeps its image in the folder `device`.
QString referenceAt(const QString& device) { return "exec:" VIS2HAP_REFERENCE_DISPLAY " '" + device + "' --touch-after 5"; }

/// `vis2hap display serve` with this driver behind it.
class ServedDisplay {
public:
    ServedDisplay(const std::string& address, const QString& driver)
    {
        m_process.start(VIS2HAP_PROGRAM,
                        {"display", "serve", QString::fromStdString(address), "--port", "0", "--display", driver});
        while (m_process.state() != QProcess::NotRunning && !m_process.canReadLine()) m_process.waitForReadyRead(1000);
        specification = QRegularExpression("tcp:\\S+").match(QString::fromUtf8(m_process.readLine())).captured(0).toStdString();
    }
    ~ServedDisplay()
    {
        m_process.kill();
        m_process.waitForFinished();
        std::fputs(qPrintable(errorText()), stderr);
    }
    /// What it wrote to its standard error until now.
    const QString& errorText() { return m_errors += QString::fromUtf8(m_process.readAllStandardError()); }
    std::string specification;

private:
    QProcess m_process;
    QString m_errors;
};

/// What a station with a shell can note down about one presentation.
struct Noted {
    int trial = 0;
    bool isRating = false;  ///< its tray is the true fabric
    std::vector<protocols::FabricId> tray;
    std::set<std::string> texts;  ///< codes, and the bytes that came as the image
};

/// The piece that each choice is guessed to be: that of a rating with a text in common, else any of the tray.
int rightGuesses(const std::vector<Noted>& noted, const std::map<int, protocols::FabricId>& truth, std::mt19937& random)
{
    int right = 0;
    for (const Noted& choice : noted) {
        if (choice.isRating) continue;
        protocols::FabricId guess = choice.tray[random() % choice.tray.size()];
        for (const Noted& rating : noted)
            if (rating.isRating &&
                std::ranges::any_of(rating.texts, [&](const auto& text) { return choice.texts.contains(text); }))
                guess = rating.tray.front();
        right += guess == truth.at(choice.trial) ? 1 : 0;
    }
    return right;
}

}  // namespace

class OwnDisplayTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void theDeviceShowsTheImageThatTheStationNeverGets();
    void equalImagesTellNothingAtTheStation_data();
    void equalImagesTellNothingAtTheStation();
    void aTicketHoldsForThePresentPresentationOnly();
    void rolesAreKeptApart();
    void theWrongDisplayIsRefused();
    void theFirstTicketAfterAnEndedConnectionIsShown();
    void otherProgramsDoNotKeepTheStationOut();
    void anImageInPlaceOfATicketIsRefusedByName();
    void aDriverThatCannotStartIsNamedAtTheStation_data();
    void aDriverThatCannotStartIsNamedAtTheStation();

private:
    /// A study on the server whose images go to the display's login, and its owner's folder.
    StudyFolder studyOnServer(const std::string& name, const std::string& imagesTo, const StudyRecipe& recipe = {});
    database::ServerAddress as(const char* login, const std::string& study) const
    {
        return database::serverAddressFrom(m_server->address(study, login));
    }
    QTemporaryDir m_folder;
    std::unique_ptr<PrivateServer> m_server;
};

void OwnDisplayTest::initTestCase()
{
    if (const QString why = PrivateServer::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    m_server = std::make_unique<PrivateServer>();
    ServerConnection server(as("owner", "none"));
    for (const char* login : {"hand", "device", "twohats"}) server.run(QString("CREATE ROLE %1 LOGIN").arg(login));
}

StudyFolder OwnDisplayTest::studyOnServer(const std::string& name, const std::string& imagesTo, const StudyRecipe& recipe)
{
    const StudyFolder folder = buildStudy(m_folder.filePath(QString::fromStdString(name)).toStdString(), recipe);
    moveToServer(folder, as("owner", name), "owner");
    makeRoles(as("owner", name),
              {{"hand", "experimenter"}, {"device", "display"}, {"twohats", "experimenter"}, {"twohats", "display"}});
    giveImagesTo(as("owner", name), imagesTo);
    return folder;
}

void OwnDisplayTest::theDeviceShowsTheImageThatTheStationNeverGets()
{
    const StudyFolder owner = studyOnServer("shown", "display", {.familiarisationImages = 1});
    const StudyFolder place{joinStudy(as("hand", "shown"), m_folder.filePath("shown-place").toStdString(), "left").folder};
    const QString device = m_folder.filePath("device");
    const ServedDisplay served(m_server->address("shown", "device"), referenceAt(device));
    ServerSession hands(place, "P01", database::ParticipantKind::Human, true);
    hands.driver.reset();
    const auto display = rendering::openDisplay(served.specification);
    QVERIFY(display->fetchesImages());
    int touches = 0;
    display->onTouched([&](const rendering::Touch&) { ++touches; });
    hands.driver = std::make_unique<study::session::Driver>(
        hands.store, protocols::ParticipantId("P01"), database::ParticipantKind::Human, hands.images, *display, hands.clock);
    std::set<int> seen;
    int presentations = 0;
    do {
        const auto* presenting = std::get_if<study::session::Presenting>(&hands.driver->state().stage);
        if (presenting == nullptr) continue;
        const cv::Mat felt = rendering::readPgm((device + "/current.pgm").toStdString());
        QCOMPARE(felt.cols, 16);
        QVERIFY(felt.at<unsigned char>(0, 0) > 0);
        seen.insert(felt.at<unsigned char>(0, 0));
        const auto ticket =
            hands.store.image(hands.driver->plan().trials.at(static_cast<std::size_t>(presenting->index)).sealedCode);
        QVERIFY(ticket.key.empty());
        QCOMPARE(ticket.sealed.size(), std::size_t{64});
        QTRY_VERIFY_WITH_TIMEOUT((display->processMessages(), touches > 0), 5000);
        if (++presentations == 3) hands.send(study::session::Voided{"wrong piece"});  // it comes again later
    } while (hands.step());
    QCOMPARE(seen.size(), std::size_t{6});
    QVERIFY(presentations >= 12);
    ServerConnection server(as("owner", "shown"));
    QVERIFY(server.value("SELECT count(DISTINCT release) FROM @schema@.server_fetches WHERE login = 'device'").toInt() >= 12);
    QCOMPARE(readStudy(owner).faults(), std::vector<std::string>());
}

void OwnDisplayTest::equalImagesTellNothingAtTheStation_data()
{
    QTest::addColumn<bool>("isApart");
    QTest::newRow("images at the station") << false;
    QTest::newRow("images at the display") << true;
}

/// 90 choices among three pieces, guessed by whoever notes down all that a station gets.
void OwnDisplayTest::equalImagesTellNothingAtTheStation()
{
    QFETCH(bool, isApart);
    const std::string study = isApart ? "apart" : "near";
    const StudyRecipe recipe{.fabrics = 5, .conditions = {"v_grey", "h&f", "t_grey"}, .participants = 6};
    const StudyFolder owner = studyOnServer(study, isApart ? "display" : "station", recipe);
    const StudyFolder place{
        joinStudy(as("hand", study), m_folder.filePath(QString::fromStdString(study + "-place")).toStdString(), "left").folder};
    std::mt19937 random(5);
    int right = 0, choices = 0;
    for (int person = 1; person <= recipe.participants; ++person) {
        ServerSession session(place, "P0" + std::to_string(person), database::ParticipantKind::Human, isApart);
        session.playToEnd();
        std::vector<Noted> noted;
        const int slot = session.store.slots()[static_cast<std::size_t>(person) - 1].number;
        for (const auto& trial : session.store.trials(slot)) {
            const auto image = session.images.image(trial.sealedCode);
            const std::string bytes(reinterpret_cast<const char*>(image.data), image.total());
            noted.push_back({trial.number.value,
                             trial.alternatives.size() == 1,
                             trial.alternatives,
                             {trial.sealedCode.value, trial.presentationCode.value, bytes}});
        }
        std::map<int, protocols::FabricId> truth;
        const auto rows = readStudy(owner);
        const auto key = readAllocationKeyForTestDriver(rows, database::ParticipantKind::Scripted, {});
        for (const auto& trial : rows.trials(slot)) truth[trial.number.value] = key.entryOf(trial).fabric;
        right += rightGuesses(noted, truth, random);
        choices += recipe.fabrics * 3;
    }
    QCOMPARE(choices, 90);
    qInfo("%d of %d true pieces guessed", right, choices);
    // By chance 30; 44 and more have a probability of .001.
    QCOMPARE(right < 44, isApart);
    if (!isApart) QCOMPARE(right, choices);
}

void OwnDisplayTest::aTicketHoldsForThePresentPresentationOnly()
{
    const StudyFolder owner = studyOnServer("tickets", "display");
    const StudyFolder place{joinStudy(as("hand", "tickets"), m_folder.filePath("tickets-place").toStdString(), "left").folder};
    const ServerConnection device(as("device", "tickets")), server(as("owner", "tickets"));
    const auto fetched = [&](const QString& ticket) {
        return errorOf([&] { (void)device.value("SELECT key FROM @schema@.released_image(?)", {ticket}); });
    };
    const auto last = [&] {
        return server.value("SELECT ticket FROM @schema@.server_releases ORDER BY number DESC LIMIT 1").toString();
    };
    QString first;
    {
        ServerSession session(place, "P01", database::ParticipantKind::Human, true);
        session.stepUntil("Presenting");
        first = last();
        QCOMPARE(fetched(first), QString());
        session.playUntilAnswers(1);
        session.stepUntil("Presenting");
        QVERIFY(fetched(first).contains("no present presentation"));
        QCOMPARE(fetched(last()), QString());
    }
    QVERIFY(fetched(last()).contains("no present presentation"));  // the station is gone
    for (const char* made : {"", "1", "familiarisation 1", "' OR true --"})
        QVERIFY2(fetched(made).contains("no present presentation"), made);
}

void OwnDisplayTest::rolesAreKeptApart()
{
    studyOnServer("rights", "display");
    // The same image needs the same blocks again, so these counters would tell it.
    const auto open = rightsOf(as("hand", "rights")).learns;
    QVERIFY(open.size() == 1 && open.front().find("pg_statio_all_tables") != std::string::npos);
    QCOMPARE(closeReadCounters(as("hand", "rights")).size(), std::size_t{4});
    QCOMPARE(closeReadCounters(as("owner", "rights")), std::vector<std::string>());
    QVERIFY(!errorOf([&] {
                 (void)ServerConnection(as("hand", "rights")).value("SELECT toast_blks_hit FROM pg_statio_all_tables LIMIT 1");
             }).isEmpty());
    const auto hand = rightsOf(as("hand", "rights")), device = rightsOf(as("device", "rights"));
    QCOMPARE(hand.learns, std::vector<std::string>());
    QCOMPARE(hand.imagesTo, std::string("display"));
    QVERIFY(std::ranges::find(hand.may, "released_image") == hand.may.end());
    QCOMPARE(device.learns, std::vector<std::string>());
    QCOMPARE(device.may, std::vector<std::string>{"released_image"});
    const auto both = rightsOf(as("twohats", "rights")).learns;
    QCOMPARE(both.size(), std::size_t{1});
    QVERIFY2(both.front().find("has the role display") != std::string::npos, both.front().c_str());
    for (const char* login : {"hand", "device"})
        QVERIFY(errorOf([&] { giveImagesTo(as(login, "rights"), "station"); }).contains("may not do this"));
    QVERIFY(errorOf([&] {
                (void)ServerConnection(as("hand", "rights")).value("SELECT key FROM @schema@.released_image('1')");
            }).contains("may not do this"));
}

void OwnDisplayTest::theWrongDisplayIsRefused()
{
    studyOnServer("wrong", "display");
    const StudyFolder place{joinStudy(as("hand", "wrong"), m_folder.filePath("wrong-place").toStdString(), "left").folder};
    const QString plain = errorOf([&] { ServerSession(place, "P01"); });
    QVERIFY2(plain.contains("display's own login only") && plain.contains("vis2hap display serve"), qPrintable(plain));
    QVERIFY(errorOf([&] { giveImagesTo(as("owner", "wrong"), "printer"); }).contains("images_to"));
    {
        const database::StationStore open(place);
        QVERIFY(errorOf([&] { giveImagesTo(as("owner", "wrong"), "station"); }).contains("stations have the study open: left"));
    }
    giveImagesTo(as("owner", "wrong"), "station");
    ServerSession session(place, "P01");
    session.display.isFetching = true;
    const QString fetching = errorOf([&] {
        study::session::Driver(session.store, protocols::ParticipantId("P01"), database::ParticipantKind::Human, session.images,
                               session.display, session.clock);
    });
    QVERIFY2(fetching.contains("--images display"), qPrintable(fetching));
}

/// A server that starts again at night, or that ends idle sessions, ends the connection of the display but not the display.
void OwnDisplayTest::theFirstTicketAfterAnEndedConnectionIsShown()
{
    studyOnServer("rested", "display");
    const StudyFolder place{joinStudy(as("hand", "rested"), m_folder.filePath("rested-place").toStdString(), "left").folder};
    const ServedDisplay served(m_server->address("rested", "device"), referenceAt(m_folder.filePath("rested-device")));
    ServerSession session(place, "P01", database::ParticipantKind::Human, true);
    session.stepUntil("Presenting");
    const auto index = std::get<study::session::Presenting>(session.driver->state().stage).index;
    const cv::Mat ticket = session.images.image(session.driver->plan().trials.at(static_cast<std::size_t>(index)).sealedCode);
    const auto display = rendering::openDisplay(served.specification);
    const ServerConnection server(as("owner", "rested"));
    const auto connections = [&] {
        return server.value("SELECT count(*) FROM pg_stat_activity WHERE usename = 'device'").toInt();
    };
    for (int night = 0; night < 2; ++night) {
        QCOMPARE(errorOf([&] { display->show(ticket); }), QString());
        display->clear();
        QVERIFY(connections() > 0);
        server.run("SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE usename = 'device'");
        QTRY_COMPARE(connections(), 0);
    }
    QCOMPARE(errorOf([&] { display->show(ticket); }), QString());
}

/// Any program of the computer can connect to the port. It gets nothing, and the station comes in after it.
void OwnDisplayTest::otherProgramsDoNotKeepTheStationOut()
{
    studyOnServer("crowded", "display");
    ServedDisplay served(m_server->address("crowded", "device"), referenceAt(m_folder.filePath("crowded-device")));
    const auto port = QString::fromStdString(served.specification.substr(served.specification.rfind(':') + 1)).toUShort();
    const QByteArray nested = R"({"type":"show","bytes":1,"id":)" + QByteArray(30000, '[') + QByteArray(30000, ']') + "}\n";
    for (const auto& [bytes, end] :
         {std::pair{nested, "sends what is no message"}, std::pair{QByteArray(200000, 'x'), "sends a line that is too long"}}) {
        QTcpSocket other;
        other.connectToHost("127.0.0.1", port);
        other.write(bytes);
        QTRY_COMPARE(other.state(), QAbstractSocket::UnconnectedState);
        QTRY_VERIFY2(served.errorText().contains(end), qPrintable(served.errorText()));
    }
    QTcpSocket silent;
    silent.connectToHost("127.0.0.1", port);
    QVERIFY(silent.waitForConnected());
    std::unique_ptr<rendering::HapticDisplay> display;
    QCOMPARE(errorOf([&] { display = rendering::openDisplay(served.specification); }), QString());
    QVERIFY(display->fetchesImages());
}

/// As a test pattern is: its bytes are passed over, and the connection stays.
void OwnDisplayTest::anImageInPlaceOfATicketIsRefusedByName()
{
    studyOnServer("patterned", "display");
    const QString device = m_folder.filePath("patterned-device");
    const ServedDisplay served(m_server->address("patterned", "device"), referenceAt(device));
    const auto display = rendering::openDisplay(served.specification);
    for (const cv::Size size : {cv::Size(1280, 800), cv::Size(60, 40)}) {
        const QString refusal = errorOf([&] { display->show(cv::Mat(size, CV_8UC1, cv::Scalar('\n'))); });
        QVERIFY2(refusal.contains("the display refuses: this display takes tickets only"), qPrintable(refusal));
        QVERIFY2(!refusal.contains("tried"), qPrintable(refusal));
        QCOMPARE(errorOf([&] { display->processMessages(); }), QString());
        QCOMPARE(errorOf([&] { display->clear(); }), QString());
    }
    QCOMPARE(cv::countNonZero(rendering::readPgm((device + "/current.pgm").toStdString())), 0);
}

void OwnDisplayTest::aDriverThatCannotStartIsNamedAtTheStation_data()
{
    studyOnServer("driverless", "display");  // one for all rows
    QTest::addColumn<QString>("driver");
    QTest::addColumn<QStringList>("told");
    QTest::newRow("no such program") << "exec:/no/such/driver" << QStringList{"ended with exit code 127", "/no/such/driver"};
    QTest::newRow("ends at hello, with a text that is not UTF-8")
        << "exec:read hello; printf 'no amplifier \\344\\n' >&2; exit 3"
        << QStringList{"ended with exit code 3; its error text: no amplifier"};
    QTest::newRow("a long reason") << "exec:printf '%01999d' 5 >&2; exit 3" << QStringList{"its error text: 0000"};
    QTest::newRow("nobody listens") << "tcp:127.0.0.1:1" << QStringList{"cannot be reached (Connection refused)"};
}

/// The standard error of `display serve` has the reason, too, but it belongs to another account.
void OwnDisplayTest::aDriverThatCannotStartIsNamedAtTheStation()
{
    QFETCH(QString, driver);
    QFETCH(QStringList, told);
    told << "the display's driver does not start: the device's driver ";
    const ServedDisplay served(m_server->address("driverless", "device"), driver);
    for (int attempt = 0; attempt < 2; ++attempt) {  // the next connection gets it, too
        const QString fault = errorOf([&] { (void)rendering::openDisplay(served.specification); });
        for (const QString& part : told) QVERIFY2(fault.contains(part), qPrintable(fault));
        QVERIFY2(fault.size() < 600, qPrintable(fault));
    }
}

QTEST_GUILESS_MAIN(OwnDisplayTest)
#include "own_display_test.moc"
