// A database that somebody deletes, replaces or moves in mid-session: the session stops, and no acknowledged answer is lost. What
// is erased is gone from every file.
#include "database/rescue.h"

#include <sqlite3.h>

#include <QTemporaryDir>
#include <QTest>
#include <filesystem>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "tests/support/error_text.h"
#include "tests/support/folder_harm.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using tests::support::errorOf;
using namespace database;
using tests::support::OpenSession;

namespace {

/// Another program that reads the database and keeps its state.
class Reader {
public:
    explicit Reader(const std::filesystem::path& file)
    {
        if (sqlite3_open(file.c_str(), &m_database) != SQLITE_OK) qFatal("cannot open");
        sqlite3_exec(m_database, "BEGIN; SELECT COUNT(*) FROM responses", nullptr, nullptr, nullptr);
    }
    ~Reader() { sqlite3_close(m_database); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

private:
    sqlite3* m_database = nullptr;
};

/// Puts a copy of a database back, without the write-ahead log of the one that stood there.
void putInPlace(const std::filesystem::path& copy, const StudyFolder& folder)
{
    for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(folder.database().string() + ending);
    std::filesystem::copy_file(copy, folder.database());
}

}  // namespace

class RescueTest : public QObject {
    Q_OBJECT

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

    void erasedAnswersCannotBeGuessedFromTheLog()
    {
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playToEnd();
        const auto record = session.store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        QCOMPARE(record.answers, 24);
        QVERIFY(record.found.empty());
        QVERIFY(record.searchedFiles >= 9 && record.searchedTexts >= 24);
        QVERIFY(session.store.faults().empty());
        for (const auto& event : session.store.events(protocols::ParticipantId("S01"))) {
            QCOMPARE(event.payloadJson, std::string("{}"));
            QCOMPARE(event.atNs, 0);
            QVERIFY(event.wallTime.empty());
        }
    }

    void whatIsLeftBehindIsFound()
    {
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playUntilAnswers(2);
        session.send(study::session::Noted{"an unmistakable remark", false});
        std::filesystem::create_directory(folder.folder / "notes");
        protocols::writeWholeFile(folder.folder / "notes" / "copy.txt", "he made an unmistakable remark today");
        const auto record = session.store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        QCOMPARE(record.found, std::vector<std::string>{"notes/copy.txt"});
    }

    void aReaderHoldsAnErasureUp_data()
    {
        QTest::addColumn<bool>("logIsEmpty");
        QTest::newRow("who reads an older state of the log") << false;
        QTest::newRow("who began when the log was empty") << true;
    }
    void aReaderHoldsAnErasureUp()
    {
        QFETCH(bool, logIsEmpty);
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playUntilAnswers(logIsEmpty ? 3 : 2);
        if (logIsEmpty) tests::support::RawSqlite(folder.database()).rows("PRAGMA wal_checkpoint(TRUNCATE)");
        {
            const Reader reader(folder.database());
            session.playUntilAnswers(3);
            const QString told = errorOf([&] {
                session.store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
            });
            QVERIFY2(told.startsWith("3:") && told.contains("nothing was erased"), qPrintable(told));
            QCOMPARE(session.store.answers().size(), 3u);
        }
        QVERIFY(session.store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}}).found.empty());
        QVERIFY(session.store.answers().empty());
    }

private:
    StudyFolder newStudy()
    {
        return tests::support::buildStudy(m_place.filePath(QString("study%1").arg(++m_studies)).toStdString());
    }
    QTemporaryDir m_place;
    int m_studies = 0;
};

QTEST_GUILESS_MAIN(RescueTest)
#include "rescue_test.moc"
