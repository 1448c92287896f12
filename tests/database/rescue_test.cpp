// A database that somebody deletes, replaces or moves in mid-session: the session stops, and no acknowledged answer is lost.
#include "database/rescue.h"

#include <sys/stat.h>

#include <QTest>
#include <filesystem>
#include <fstream>
#include <memory>

#include "database/evidence/acts.h"
#include "database/rescue_files.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "tests/support/error_text.h"
#include "tests/support/folder_harm.h"
#include "tests/support/new_studies.h"
#include "tests/support/other_reader.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"

using tests::support::errorOf;
using namespace database;
using tests::support::OpenSession;
using tests::support::Reader;

namespace {

/// Puts a copy of a database back, without the write-ahead log of the one that stood there.
void putInPlace(const std::filesystem::path& copy, const StudyFolder& folder)
{
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(folder.database().string() + ending);
    std::filesystem::copy_file(copy, folder.database());
}

/// Gives a file another time and another mode, as a program for backups or rights may do.
void touch(const std::filesystem::path& file)
{
    std::filesystem::last_write_time(file, std::filesystem::file_time_type::clock::now());
    std::filesystem::permissions(file, std::filesystem::perms::group_read, std::filesystem::perm_options::add);
}

}  // namespace

class RescueTest : public QObject {
    Q_OBJECT

    /// A study.db of 3 answers in the folder, and a rescue file that goes on to 6.
    static void putOlderBesideRescue(const StudyFolder& folder)
    {
        const std::filesystem::path older = folder.folder.string() + "-older.db";
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(3);
            session.store.copyTo(older);
            session.playUntilAnswers(6);
            std::filesystem::remove(folder.database());
            errorOf([&] { session.playUntilAnswers(7); });
        }
        putInPlace(older, folder);
    }

private Q_SLOTS:
    void aVanishedDatabaseStopsTheSessionAndLosesNothing_data()
    {
        QTest::addColumn<int>("harm");
        for (const auto& [harm, name] : tests::support::folderHarms()) QTest::newRow(name) << static_cast<int>(harm);
    }
    void aVanishedDatabaseStopsTheSessionAndLosesNothing()
    {
        QFETCH(int, harm);
        const auto folderHarm = static_cast<tests::support::FolderHarm>(harm);
        const StudyFolder folder = newStudy();
        int acknowledged = 0;
        QString told;
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(5);
            acknowledged = session.driver->state().answersStored;
            doHarm(folderHarm, folder);
            told = errorOf([&] { session.playUntilAnswers(6); });
            QVERIFY2(told.startsWith("3:") && told.contains("vis2hap rescue"), qPrintable(told));
            QCOMPARE(session.driver->state().answersStored, acknowledged);
            QVERIFY(errorOf([&] { session.playUntilAnswers(6); }).contains("vis2hap rescue"));
        }
        putRight(folderHarm, folder);
        const auto files = rescueFiles(folder);
        QCOMPARE(files.size(), 1u);
        StudyStore::rescue(folder, files.front());
        OpenSession session(folder, "S01");
        QVERIFY(session.store.faults().empty());
        QVERIFY(static_cast<int>(session.store.answers().size()) >= acknowledged);
        session.playToEnd();
        QCOMPARE(session.store.answers().size(), 24u);
        QVERIFY(session.store.faults().empty());
    }

    /// Where nothing can be written beside the study, the file lies in the folder for temporary files, and the command names it.
    void theCommandThatIsToldFindsTheFile()
    {
        const StudyFolder folder = newStudy();
        const std::filesystem::path above = folder.folder.string() + "-above", moved = above.string() + "-moved";
        std::filesystem::create_directory(above);
        std::filesystem::rename(folder.folder, above / "study");
        const StudyFolder inside{above / "study"};
        QString told;
        {
            OpenSession session(inside, "S01");
            session.playUntilAnswers(5);
            std::filesystem::rename(above, moved);
            told = errorOf([&] { session.playUntilAnswers(6); });
        }
        std::filesystem::rename(moved, above);
        QVERIFY(rescueFiles(inside).empty());
        const auto at = told.indexOf(" --from ");
        QVERIFY2(at > 0, qPrintable(told));
        const std::filesystem::path named = told.mid(at + 8).trimmed().toStdString();
        StudyStore::rescue(inside, named);
        QCOMPARE(StudyStore(inside, StudyStore::Access::Read).answers().size(), 5u);
        std::filesystem::remove(named);
    }

    void anOlderDatabaseIsContinuedAndAnotherOneIsNot()
    {
        const StudyFolder folder = newStudy();
        const std::filesystem::path older = folder.folder.string() + "-older.db", other = folder.folder.string() + "-other.db";
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(3);
            session.store.copyTo(older);
        }
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(6);
            std::filesystem::remove(folder.database());
            errorOf([&] { session.playUntilAnswers(7); });
        }
        const auto rescue = rescueFiles(folder).front();
        putInPlace(older, folder);
        {
            OpenSession session(folder, "S01");  // the older one goes its own way
            session.playUntilAnswers(4);
            session.store.copyTo(other);
        }
        QVERIFY(errorOf([&] { StudyStore::rescue(folder, rescue); }).contains("answers that the rescue file lacks"));
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 4u);
        putInPlace(older, folder);
        const auto done = StudyStore::rescue(folder, rescue);
        QVERIFY(done.events > 0 && std::filesystem::exists(done.earlier));
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 6u);
    }

    /// Somebody exports from an older study.db while the rescue file waits. A later certificate of erasure must name this copy.
    void actsOfTheReplacedDatabaseAreKept()
    {
        const StudyFolder folder = newStudy();
        const auto act = [&](const char* path) {
            const auto head = StudyStore(folder, StudyStore::Access::Read).head();
            QCOMPARE(recordAct(folder, {"export", "Ada", "test", "here", path, head, {}}), std::nullopt);
        };
        act("/first");
        putOlderBesideRescue(folder);
        act("/second");
        const auto known = headOfActs(StudyStore(folder, StudyStore::Access::Read));
        QCOMPARE(StudyStore::rescue(folder, rescueFiles(folder).front()).acts, std::size_t{1});
        const StudyStore store(folder, StudyStore::Access::Read);
        QVERIFY(headOfActs(store) == known);  // `verify --against` knows it
        QCOMPARE(actsOf(store).back().path, std::string("/second"));
        QCOMPARE(faultsOfActs(store), std::vector<std::string>());
        QCOMPARE(store.faults(), std::vector<std::string>());
        QCOMPARE(store.answers().size(), 6u);
    }

    /// The answers are what a rescue is for.
    void damagedActsDoNotKeepTheAnswersAway_data()
    {
        QTest::addColumn<QString>("harm");
        QTest::newRow("a table that is gone") << "DROP TABLE acts";
        QTest::newRow("an altered act") << "UPDATE acts SET details = '{}'";
    }
    void damagedActsDoNotKeepTheAnswersAway()
    {
        QFETCH(const QString, harm);
        const StudyFolder folder = newStudy();
        putOlderBesideRescue(folder);
        const auto head = StudyStore(folder, StudyStore::Access::Read).head();
        QCOMPARE(recordAct(folder, {"export", "Ada", "test", "here", "/out", head, {}}), std::nullopt);
        {
            tests::support::RawSqlite raw(folder.database());
            raw.dropTriggers();
            QCOMPARE(raw.run(harm.toStdString()), std::string());
        }
        const auto done = StudyStore::rescue(folder, rescueFiles(folder).front());
        QVERIFY(done.lacksActs && done.acts == 0);
        const StudyStore store(folder, StudyStore::Access::Read);
        QCOMPARE(store.answers().size(), 6u);
        QCOMPARE(store.faults(), std::vector<std::string>());
    }

    void theWriteAheadLogOfARescueFileIsBroughtBackToo()
    {
        const StudyFolder folder = newStudy();
        const std::filesystem::path copy = folder.folder.string() + "-copy.db", older = folder.folder.string() + "-older.db";
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(2);
            session.store.copyTo(older);
            session.playUntilAnswers(7);
            // As `cp study.db* elsewhere` does: the newest answers are in the log only.
            std::filesystem::copy_file(folder.database(), copy);
            std::filesystem::copy_file(folder.database().string() + "-wal", copy.string() + "-wal");
        }
        putInPlace(older, folder);
        QVERIFY(StudyStore::rescue(folder, copy).events > 0);
        QVERIFY(std::filesystem::exists(copy));
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 7u);
        QVERIFY(StudyStore(folder, StudyStore::Access::Read).faults().empty());
    }

    void aPipeIsNoRescueFile()
    {
        const StudyFolder folder = newStudy();
        const std::filesystem::path pipe = folder.folder.string() + "-pipe";
        QCOMPARE(::mkfifo(pipe.c_str(), 0600), 0);
        const QString told = errorOf([&] { StudyStore::rescue(folder, pipe); });
        QVERIFY2(told.startsWith("2:") && told.contains("no regular file"), qPrintable(told));
        QVERIFY(errorOf([&] { StudyStore::rescue(folder, folder.folder / "none.db"); }).contains("no such file"));
    }

    void whatOthersMayDoStopsNoSession_data()
    {
        QTest::addColumn<int>("act");
        QTest::newRow("a reader keeps an old state") << 1;
        QTest::newRow("a backup is made") << 2;
        QTest::newRow("another SQLite moves the log into the database") << 3;
        QTest::newRow("another SQLite empties the log") << 4;
        QTest::newRow("a program changes times and modes") << 5;
        QTest::newRow("another process records acts and empties the log") << 6;
        QTest::newRow("another process records acts, empties the log and goes on") << 7;
    }
    void whatOthersMayDoStopsNoSession()
    {
        QFETCH(int, act);
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            for (int answers = 2; answers <= 24; answers += 2) {
                const std::unique_ptr<Reader> reader = act == 1 ? std::make_unique<Reader>(folder.database()) : nullptr;
                session.playUntilAnswers(answers);
                if (act == 2) {
                    const StudyStore seen(folder, StudyStore::Access::Read);
                    QVERIFY(seen.faults().empty());
                    seen.copyTo(folder.folder.string() + "-backup" + std::to_string(answers));
                }
                if (act == 3) tests::support::RawSqlite(folder.database()).rows("PRAGMA wal_checkpoint(PASSIVE)");
                if (act == 4) tests::support::RawSqlite(folder.database()).rows("PRAGMA wal_checkpoint(TRUNCATE)");
                if (act == 6 || act == 7) {
                    const database::Act exported{"export", "Ada", "test", "here", "/copies/a.csv", {}, {}};
                    QCOMPARE(database::recordAct(folder, exported), std::nullopt);
                    tests::support::RawSqlite(folder.database()).rows("PRAGMA wal_checkpoint(TRUNCATE)");
                    if (act == 7) QCOMPARE(database::recordAct(folder, exported), std::nullopt);
                }
                if (act == 5)
                    for (const char* ending : {"", "-wal"}) touch(folder.database().string() + ending);
            }
            session.playToEnd();
            QCOMPARE(session.store.answers().size(), 24u);
            QVERIFY(session.store.faults().empty());
        }
        QVERIFY(rescueFiles(folder).empty());
    }

    /// The other process moves the write-ahead log into the database, so that the copy in memory is older than the act.
    void actsOfAnotherProcessOutliveTheDatabase()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(3);
            const database::Act exported{"export", "Ada", "test", "here", "/copies/a.csv", session.store.head(), {}};
            QCOMPARE(database::recordAct(folder, exported), std::nullopt);
            std::filesystem::remove(folder.database());
            QVERIFY(!errorOf([&] { session.playUntilAnswers(5); }).isEmpty());
        }
        const auto files = rescueFiles(folder);
        QCOMPARE(files.size(), 1u);
        StudyStore::rescue(folder, files.front());
        const StudyStore store(folder, StudyStore::Access::Read);
        QVERIFY(store.faults().empty());
        QCOMPARE(store.answers().size(), 3u);
        QCOMPARE(actsOf(store).size(), 1u);
    }

    /// keepAside() puts them there where the folder of the study is gone.
    void whatIsErasedIsSearchedForInRescueFilesOutside()
    {
        const StudyFolder folder = newStudy();
        OpenSession(folder, "S01").playUntilAnswers(3);
        const std::filesystem::path outside = folder.folder.string() + "-rescue-1.db";
        {
            const StudyStore store(folder, StudyStore::Access::Read);
            store.copyTo(outside);
            store.copyTo(folder.folder.parent_path() / "other-rescue-1.db");
        }
        // What others put there under such a name hinders nothing.
        std::filesystem::create_directory(folder.folder.string() + "-rescue-2.db");
        std::filesystem::create_symlink("/dev/zero", folder.folder.string() + "-rescue-3.db");
        StudyStore store(folder, StudyStore::Access::Write);
        const auto record = store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        // The third is of this study, too: its folder may have had another name.
        const std::filesystem::path other = folder.folder.parent_path() / "other-rescue-1.db";
        auto found = record.found;
        std::ranges::sort(found);
        std::vector<std::string> expected{outside.string(), other.string()};
        std::ranges::sort(expected);
        QVERIFY(found == expected);
    }

    void anotherStudyThatWasCopiedOverTheDatabaseStaysAsItIs()
    {
        const StudyFolder folder = newStudy(), other = newStudy();
        {
            OpenSession(folder, "S02").playToEnd();
            OpenSession(other, "X01").playUntilAnswers(3);
        }
        const std::string otherBytes = protocols::readWholeFile(other.database());
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(5);
            std::filesystem::copy_file(other.database(), folder.database(), std::filesystem::copy_options::overwrite_existing);
            const QString told = errorOf([&] { session.playUntilAnswers(6); });
            QVERIFY2(told.startsWith("3:") && told.contains("vis2hap rescue"), qPrintable(told));
            QCOMPARE(session.driver->state().answersStored, 5);
            (void)session.driver->view();  // the window shows the state once more, with the fault
        }
        QVERIFY(protocols::readWholeFile(folder.database()) == otherBytes);
        const auto rescue = rescueFiles(folder).front();
        QVERIFY(errorOf([&] { StudyStore::rescue(folder, rescue); }).contains("are of two studies"));
        std::filesystem::remove(folder.database());
        StudyStore::rescue(folder, rescue);
        QVERIFY(rescueFiles(folder).empty());
        const StudyStore store(folder, StudyStore::Access::Read);
        QVERIFY(store.faults().empty());
        QCOMPARE(store.answers().size(), 24u + 5u);
    }

    /// SQLite takes pages from the database file as soon as they were moved there, so an older file under them loses answers.
    void anEarlierCopyPutBackInPlaceStopsTheSession_data()
    {
        QTest::addColumn<bool>("isRead");
        QTest::newRow("nobody reads") << false;
        QTest::newRow("a reader keeps the log as it is") << true;
    }
    void anEarlierCopyPutBackInPlaceStopsTheSession()
    {
        QFETCH(bool, isRead);
        const StudyFolder folder = newStudy();
        const std::filesystem::path earlier = folder.folder.string() + "-earlier.db";
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(6);
            tests::support::RawSqlite(folder.database()).rows("PRAGMA wal_checkpoint(TRUNCATE)");
            std::filesystem::copy_file(folder.database(), earlier);
            session.playUntilAnswers(15);
            const std::unique_ptr<Reader> reader = isRead ? std::make_unique<Reader>(folder.database()) : nullptr;
            tests::support::RawSqlite(folder.database()).rows("PRAGMA wal_checkpoint(PASSIVE)");
            std::filesystem::copy_file(earlier, folder.database(), std::filesystem::copy_options::overwrite_existing);
            QVERIFY(errorOf([&] { session.playUntilAnswers(16); }).contains("overwritten or moved"));
        }
        std::filesystem::remove(folder.database());
        StudyStore::rescue(folder, rescueFiles(folder).front());
        const StudyStore store(folder, StudyStore::Access::Read);
        QVERIFY(store.faults().empty());
        QCOMPARE(store.answers().size(), 15u);
    }

    void theLastScreenTellsOfAnEmptiedDatabase()
    {
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playToEnd();
        doHarm(tests::support::FolderHarm::BothEmptied, folder);
        const QString told = errorOf([&] { (void)session.driver->view(); });
        QVERIFY2(told.contains("vis2hap rescue"), qPrintable(told));
        QVERIFY(!session.driver->view().logHead.empty());
    }

    /// As for a study that is too large for the copy in memory.
    void withoutACopyTheLogIsLeftAlone()
    {
        const StudyFolder folder = newStudy();
        const std::filesystem::path log = folder.database().string() + "-wal";
        {
            OpenSession session(folder, "S01");
            StudyStore::Batch{session.store};  // which lets the copy go
            session.playUntilAnswers(5);
            std::ofstream(folder.database(), std::ios::binary | std::ios::trunc);
            const QString told = errorOf([&] { session.playUntilAnswers(6); });
            QVERIFY2(told.contains("keep study.db-wal"), qPrintable(told));
        }
        const auto bytes = std::filesystem::file_size(log);
        QVERIFY(bytes > 0 && std::filesystem::file_size(folder.database()) == 0);
        const QString told = errorOf([&] { StudyStore(folder, StudyStore::Access::Read); });
        QVERIFY2(told.contains("its write-ahead log holds answers"), qPrintable(told));
        QCOMPARE(std::filesystem::file_size(log), bytes);
    }

    void aDatabaseThatIsOverwrittenAfterTheLastAnswerIsKeptAside()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playToEnd();
            doHarm(tests::support::FolderHarm::BothEmptied, folder);
        }
        const auto done = StudyStore::rescue(folder, rescueFiles(folder).front());
        QVERIFY(std::filesystem::exists(done.earlier));
        QVERIFY(done.lacksActs);  // nobody can read which there were
        QCOMPARE(StudyStore(folder, StudyStore::Access::Read).answers().size(), 24u);
    }

private:
    StudyFolder newStudy() { return m_studies.make(); }
    tests::support::NewStudies m_studies;
};

QTEST_GUILESS_MAIN(RescueTest)
#include "rescue_test.moc"
