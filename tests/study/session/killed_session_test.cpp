// kill -9 at random instants of a session in its own process: every acknowledged answer is stored once, and the session continues
// at the right trial.
#include <QCoreApplication>
#include <QElapsedTimer>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <map>

#include "protocols/random.h"
#include "tests/support/server/engine_session.h"

using namespace tests::support;

namespace {

constexpr int answersInAll = 6 + 18;

/// The trial (from 0) of the next answer.
int trialAfter(int answers) { return answers < 6 ? answers : 6 + (answers - 6) / 3; }

/// Number of acknowledged answers, from the lines that the child wrote.
int acknowledged(QProcess& child, int before)
{
    int answers = before;
    for (const QByteArray& line : child.readAllStandardOutput().split('\n'))
        if (line.startsWith("answer ")) answers = line.mid(7).toInt();
    return answers;
}

/// Kills the child a time `wait` after it acknowledged `answers`, or lets it end. Returns the number of acknowledged answers.
int playAndKill(const database::StudyFolder& folder, int answers, int waitUs)
{
    QProcess child;
    child.start(QCoreApplication::applicationDirPath() + "/session_child",
                {"play", QString::fromStdString(folder.folder.string()), "S01"});
    QElapsedTimer patience;
    patience.start();
    int known = 0;
    bool open = false;
    while (patience.elapsed() < 60000 && child.state() != QProcess::NotRunning && (!open || known < answers)) {
        child.waitForReadyRead(100);
        while (child.canReadLine()) {
            const QByteArray line = child.readLine();
            open = open || line.startsWith("open ");
            if (line.startsWith("answer ")) known = line.mid(7).toInt();
        }
    }
    QThread::usleep(static_cast<unsigned long>(waitUs));
    child.kill();
    child.waitForFinished();
    return acknowledged(child, known);
}

}  // namespace

class KilledSessionTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    EngineUnderTest m_engine;
    std::vector<std::string> m_expected;

private Q_SLOTS:
    void initTestCase()
    {
        if (const QString why = EngineUnderTest::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
        const auto folder = m_engine.study(m_place.filePath("uninterrupted").toStdString());
        EngineSession session(folder, "S01");
        session.playToEnd();
        m_expected = linesOf(session.rows());
        QCOMPARE(static_cast<int>(m_expected.size()), answersInAll);
    }

    void everyAcknowledgedAnswerIsThereOnceAndTheNextTrialIsRight_data()
    {
        QTest::addColumn<int>("answers");
        QTest::addColumn<int>("waitUs");
        protocols::Random random(20260101);
        const int kills = qEnvironmentVariableIsSet("VIS2HAP_ALL_SEEDS") ? 1000 : EngineUnderTest::isServer() ? 8 : 20;
        for (int kill = 1; kill <= kills; ++kill) {
            const int answers = static_cast<int>(random.below(answersInAll));
            const int waitUs = static_cast<int>(random.below(3000));
            QTest::addRow("kill %d: %d us after answer %d", kill, waitUs, answers) << answers << waitUs;
        }
    }

    void everyAcknowledgedAnswerIsThereOnceAndTheNextTrialIsRight()
    {
        QFETCH(int, answers);
        QFETCH(int, waitUs);
        const auto folder = m_engine.study(m_place.filePath(QTest::currentDataTag()).toStdString());
        const int told = playAndKill(folder, answers, waitUs);
        QVERIFY(told >= answers);
        EngineSession session(folder, "S01");
        const int stored = session.driver->state().answersStored;
        QVERIFY2(stored == told || stored == told + 1, qPrintable(QString("%1 told, %2 stored").arg(told).arg(stored)));
        std::vector<std::string> expected = m_expected;
        expected.resize(static_cast<std::size_t>(stored));
        QCOMPARE(linesOf(session.rows()), expected);
        if (stored < answersInAll) {
            session.stepUntil("Presenting");
            QCOMPARE(std::get<study::session::Presenting>(session.driver->state().stage).index, trialAfter(stored));
        }
        session.playToEnd();
        QCOMPARE(linesOf(session.rows()), m_expected);
        QVERIFY(session.rows().faults().empty());
        std::filesystem::remove_all(folder.folder);
    }

    void oneSessionSurvivesManyKills()
    {
        const auto folder = m_engine.study(m_place.filePath("many").toStdString());
        int told = 0;
        for (int kill = 0; kill < 8; ++kill)
            told = std::max(told, playAndKill(folder, std::min(told + 2, answersInAll), 200 * kill));
        QVERIFY(told >= 16);
        EngineSession session(folder, "S01");
        session.playToEnd();
        QCOMPARE(linesOf(session.rows()), m_expected);
        QVERIFY(session.rows().faults().empty());
    }
};

QTEST_GUILESS_MAIN(KilledSessionTest)
#include "killed_session_test.moc"
