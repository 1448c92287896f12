// An answer is synced to the disk before the next prompt, and a failing disk stores nothing. kill -9 alone cannot test this,
// because the page cache survives the process.
#include <QTemporaryDir>
#include <QTest>

#include "database/sqlite_connection.h"
#include "protocols/files/errors.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace tests::support;
using database::StudyStore;

namespace {

constexpr int synchronousFull = 2;

/// A session at its first question.
struct AskedSession {
    QTemporaryDir place;
    database::StudyFolder folder = buildStudy(place.filePath("study").toStdString());
    OpenSession session{folder, "S01"};

    AskedSession() { session.stepUntil("Presenting"); }
    study::session::Answered answer() const { return {responseTo(session.driver->view())}; }
};

}  // namespace

class DurabilityTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyConnectionIsSynchronousFull()
    {
        QTemporaryDir place;
        const auto folder = buildStudy(place.filePath("study").toStdString());
        const StudyStore writer(folder, StudyStore::Access::Write);
        const StudyStore reader(folder, StudyStore::Access::Read);
        for (const StudyStore* store : {&writer, &reader})
            QCOMPARE(store->connection().value("PRAGMA synchronous").toInt(), synchronousFull);
    }

    void anAnswerIsSyncedBeforeTheNextPrompt()
    {
        const CountingVfs disk;
        AskedSession asked;
        const int before = asked.session.display.calls.size();
        QVERIFY(before > 0);
        int answers = 0;
        while (std::holds_alternative<study::session::Presenting>(asked.session.driver->state().stage) || asked.session.step()) {
            if (!std::holds_alternative<study::session::Presenting>(asked.session.driver->state().stage)) continue;
            const LogTraffic then = disk.traffic();
            asked.session.send(asked.answer());
            const LogTraffic now = disk.traffic();
            QVERIFY2(now.writes > then.writes, "the answer went to the log");
            QVERIFY2(now.completedSyncs > then.completedSyncs, "and the log was synced");
            QCOMPARE(now.writesSinceSync, 0);
            ++answers;
        }
        QCOMPARE(answers, 6 + 18);
    }

    void aStimulusIsShownOnlyAfterItsEventIsSynced()
    {
        const CountingVfs disk;
        AskedSession asked;
        int shown = 0;
        asked.session.display.onShow = [&] {
            QCOMPARE(disk.traffic().writesSinceSync, 0);
            QCOMPARE(asked.session.store.events(protocols::ParticipantId("S01")).back().kind, std::string("tray_ready"));
            ++shown;
        };
        asked.session.playToEnd();
        QCOMPARE(shown, 11);
    }

    void aFailingDiskStoresNothingAndSaysSo_data()
    {
        QTest::addColumn<int>("writeFault");
        QTest::addColumn<int>("syncFault");
        QTest::addColumn<QString>("said");
        QTest::newRow("disk full") << SQLITE_FULL << SQLITE_OK << "the disk is full; this step was not stored";
        QTest::newRow("write error") << SQLITE_IOERR_WRITE << SQLITE_OK << "the disk reported an error";
        QTest::newRow("sync error") << SQLITE_OK << SQLITE_IOERR_FSYNC << "the disk reported an error";
    }

    void aFailingDiskStoresNothingAndSaysSo()
    {
        QFETCH(int, writeFault);
        QFETCH(int, syncFault);
        QFETCH(QString, said);
        CountingVfs disk;
        AskedSession asked;
        asked.session.send(asked.answer());
        asked.session.stepUntil("Presenting");
        const study::session::State stateBefore = asked.session.driver->state();
        disk.letWritesFailWith(writeFault);
        disk.letSyncsFailWith(syncFault);
        try {
            asked.session.send(asked.answer());
            QFAIL("the answer cannot have been stored");
        } catch (const protocols::Error& fault) {
            QCOMPARE(fault.exitCode(), protocols::ExitCode::Environment);
            QVERIFY2(QString(fault.what()).contains(said), fault.what());
            QVERIFY2(QString(fault.what()).contains("study.db"), fault.what());
        }
        disk.letWritesFailWith(SQLITE_OK);
        disk.letSyncsFailWith(SQLITE_OK);
        QVERIFY(asked.session.driver->state() == stateBefore);
        QCOMPARE(asked.session.store.answers().size(), 1u);
        asked.session.send(asked.answer());
        QCOMPARE(asked.session.store.answers().size(), 2u);
        QVERIFY(asked.session.store.faults().empty());
    }

    void aStudyThatCannotBeMadeLeavesNoHalf()
    {
        QTemporaryDir place;
        CountingVfs disk;
        disk.letWritesFailWith(SQLITE_FULL);
        const std::filesystem::path folder = place.filePath("study").toStdString();
        QVERIFY_EXCEPTION_THROWN(buildStudy(folder), protocols::Error);
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            QVERIFY2(!entry.path().filename().string().starts_with("study.db"), entry.path().c_str());
    }
};

QTEST_GUILESS_MAIN(DurabilityTest)
#include "durability_test.moc"
