// The window at a station of a study on a server: joined by its address, and at every moment it says where the answers are.
#include <QLabel>
#include <QtTest>

#include "database/server/study_move.h"
#include "database/study_store.h"
#include "study/app/pages/start_page.h"
#include "tests/support/open_window.h"
#include "tests/support/played_session.h"
#include "tests/support/server/cut_network.h"
#include "tests/support/server/private_server.h"

using namespace tests::support;
using database::StudyStore;

class AppServerTest : public WindowTest {
    Q_OBJECT
private Q_SLOTS:
    void initTestCase();
    void anAddressOnTheStartPageJoinsTheStudy();
    void thePageSaysWhereTheAnswersAre();
    void aWrongAddressIsOneLineOnTheStartPage();

private:
    database::StudyFolder studyOnServer(const std::string& name)
    {
        const database::StudyFolder folder = newStudy();
        moveToServer(folder, database::serverAddressFrom(m_server->address(name)), "owner");
        return folder;
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

void AppServerTest::aWrongAddressIsOneLineOnTheStartPage()
{
    ShownWindow shown;
    Q_EMIT shown.window.startPage().openRequested(QString::fromStdString(m_server->address("nothing")));
    const QString text = shown.widget<QLabel>("startMessage").text();
    QVERIFY2(text.contains("no study nothing"), qPrintable(text));
    QVERIFY(!shown.window.study());
}

QTEST_MAIN(AppServerTest)
#include "app_server_test.moc"
