// Erasures: what the log, the files and later certificates keep of a person, and who holds an erasure up.
#include "database/erasure.h"

#include <unistd.h>

#include <QTest>
#include <filesystem>

#include "database/sqlite_connection.h"
#include "protocols/files/byte_search.h"
#include "protocols/files/sha256.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "study/records/erasure_certificate.h"
#include "tests/support/error_text.h"
#include "tests/support/new_studies.h"
#include "tests/support/other_reader.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"

using tests::support::errorOf;
using namespace database;
using tests::support::OpenSession;
using tests::support::Reader;

class ErasureTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
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

    /// Its files would hold what the erasure removes, and no certificate would list them.
    void anErasureDoesNotPassACommandThatWritesFiles()
    {
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playUntilAnswers(3);
        const Erasure erasure{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};
        const StudyStore exporting(folder, StudyStore::Access::Read);
        auto state = exporting.readOneState();
        session.playUntilAnswers(4);
        QCOMPARE(exporting.answers().size(), 3u);
        const auto head = exporting.head();
        QVERIFY(errorOf([&] { session.store.erase(erasure); }).contains("nothing was erased"));
        QVERIFY(exporting.head() == head && session.store.answers().size() == 4u);
        state.reset();
        QCOMPARE(exporting.answers().size(), 4u);
        QCOMPARE(session.store.erase(erasure).answers, 4);
    }

    /// Reasons, readings and notes from before the first presentation.
    void whatTheLogAloneHoldsIsSearchedFor()
    {
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.send(study::session::Noted{"before the first tray", false});
            session.playUntilAnswers(2);
            session.send(study::session::WithdrawnEvent{"feels unwell since noon"});
        }
        protocols::writeWholeFile(folder.folder / "a.txt", "noted before the first tray");
        protocols::writeWholeFile(folder.folder / "b.txt", "S01 feels unwell since noon");
        protocols::writeWholeFile(folder.folder / "held-S01-2-1.json", "{}");  // of participant S01-2
        StudyStore store(folder, StudyStore::Access::Write);
        const auto record = store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        QCOMPARE(record.found, (std::vector<std::string>{"a.txt", "b.txt"}));
    }

    void shortTextsAreCountedAndNotSearchedFor()
    {
        const StudyFolder folder = newStudy();
        const Erasure erasure{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};
        OpenSession session(folder, "S01");
        session.playUntilAnswers(2);
        session.send(study::session::Noted{"Kr\u00FCger", false});
        const auto record = session.store.erase(erasure);
        QVERIFY(record.shortTexts >= 1);
        const auto text = protocols::readWholeFile(study::records::writeErasureCertificate(session.store, erasure, record));
        QVERIFY(QString::fromStdString(text).contains("because they have less than 8 bytes: "));
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

    /// Afterwards nobody could search it: what was removed is known no more.
    void aFileThatCannotBeReadHoldsAnErasureUp_data()
    {
        QTest::addColumn<bool>("isInFolder");
        QTest::newRow("a file") << false;
        QTest::newRow("a folder that may be listed and not entered") << true;
    }
    void aFileThatCannotBeReadHoldsAnErasureUp()
    {
        QFETCH(const bool, isInFolder);
        const StudyFolder folder = newStudy();
        const std::filesystem::path closed = folder.folder / "closed";
        const std::filesystem::path file = isInFolder ? closed / "notes.txt" : folder.folder / "notes.txt";
        if (isInFolder) std::filesystem::create_directory(closed);
        OpenSession session(folder, "S01");
        session.playUntilAnswers(3);
        protocols::writeWholeFile(file, "of another account");
        std::filesystem::permissions(isInFolder ? closed : file, std::filesystem::perms(isInFolder ? 0444 : 0));
        const auto erase = [&] {
            return session.store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        };
        const bool isRoot = ::geteuid() == 0;  // root may read every file
        if (isRoot) {
            std::vector<std::filesystem::path> own{folder.folder.parent_path()};
            for (const auto& entry : std::filesystem::recursive_directory_iterator(own.front())) own.push_back(entry.path());
            for (const auto& path : own)
                if (::lchown(path.c_str(), 65534, 65534) != 0) QSKIP("this file system knows no owners");
            if (!isInFolder) QCOMPARE(::chown(file.c_str(), 0, 0), 0);
            QCOMPARE(::seteuid(65534), 0);
        }
        const QString told = errorOf(erase);
        if (isRoot) QCOMPARE(::seteuid(0), 0);
        QVERIFY2(told.contains("notes.txt") && told.contains("nothing was erased"), qPrintable(told));
        QCOMPARE(session.store.answers().size(), 3u);
        if (isInFolder) std::filesystem::permissions(closed, std::filesystem::perms(0755));
        std::filesystem::remove(file);
        QCOMPARE(erase().answers, 3);
    }

    /// A program that was killed while it read the study of a server, or one of an earlier version.
    void aCopyThatAKilledProgramLeftIsFound()
    {
        const StudyFolder folder = newStudy();
        OpenSession session(folder, "S01");
        session.playUntilAnswers(3);
        const protocols::TemporaryFolder left;
        session.store.copyTo(left.path() / "study.db");
        const auto record = session.store.erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        QCOMPARE(record.found, std::vector<std::string>{(left.path() / "study.db").string()});
    }

    /// The texts are gone after the first erasure, and the file is not.
    void whatACertificateNamesCountsUntilItIsGone()
    {
        const StudyFolder folder = newStudy();
        const Erasure erasure{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};
        const std::filesystem::path copy = folder.folder / "notes" / "copy.txt";
        OpenSession session(folder, "S01");
        session.playUntilAnswers(2);
        session.send(study::session::Noted{"an unmistakable remark", false});
        std::filesystem::create_directory(copy.parent_path());
        protocols::writeWholeFile(copy, "he made an unmistakable remark today");
        protocols::writeWholeFile(folder.folder / "study.db.sql", "INSERT INTO notes VALUES ('an unmistakable remark')");
        for (int times = 0; times < 3; ++times) {
            const auto record = session.store.erase(erasure);
            QCOMPARE(record.found, (std::vector<std::string>{"notes/copy.txt", "study.db.sql"}));
            study::records::writeErasureCertificate(session.store, erasure, record);
        }
        std::filesystem::remove(copy);
        std::filesystem::remove(folder.folder / "study.db.sql");
        QCOMPARE(session.store.erase(erasure).found, std::vector<std::string>());
    }

    /// The log and the certificate cannot be changed later, so a name that holds a removed text may not stand in them.
    void aNameThatHoldsARemovedTextIsNotKept()
    {
        const StudyFolder folder = newStudy();
        const Erasure erasure{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};
        const std::filesystem::path letter = folder.folder / "letters" / "Anna-Maria Schmidt.txt";
        OpenSession session(folder, "S01");
        session.playUntilAnswers(2);
        session.send(study::session::Noted{"Anna-Maria Schmidt", false});
        std::filesystem::create_directory(letter.parent_path());
        protocols::writeWholeFile(letter, "Dear Anna-Maria Schmidt");
        const std::string shown = "a file whose name holds a removed text, with the SHA-256 " + protocols::sha256OfFile(letter);
        for (int times = 0; times < 2; ++times) {  // the second time nobody knows the text
            const auto record = session.store.erase(erasure);
            QCOMPARE(record.found, std::vector<std::string>{shown});
            const auto file = study::records::writeErasureCertificate(session.store, erasure, record);
            QVERIFY(!QString::fromStdString(protocols::readWholeFile(file)).contains("Anna"));
        }
        std::filesystem::rename(letter, folder.folder / "x.txt");
        QCOMPARE(session.store.erase(erasure).found, std::vector<std::string>{shown});
        QCOMPARE(protocols::searchFiles(folder.folder, {"Anna-Maria"}).found, std::vector<std::string>{"x.txt"});
        std::filesystem::remove(folder.folder / "x.txt");
        QVERIFY(session.store.erase(erasure).found.empty());
    }

    /// Rescue files take the names of earlier ones.
    void anotherDatabaseOfAnEarlierNameIsNoTrace()
    {
        const StudyFolder folder = newStudy();
        const Erasure erasure{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};
        OpenSession session(folder, "S01");
        session.playUntilAnswers(2);
        session.store.copyTo(folder.folder / "rescue-1.db");
        const auto first = session.store.erase(erasure);
        QCOMPARE(first.found, std::vector<std::string>{"rescue-1.db"});
        study::records::writeErasureCertificate(session.store, erasure, first);
        std::filesystem::remove(folder.folder / "rescue-1.db");
        session.store.copyTo(folder.folder / "rescue-1.db");
        QCOMPARE(session.store.erase(erasure).found, std::vector<std::string>());
        protocols::writeWholeFile(folder.folder / "held-S01-1.json", "{}");
        QCOMPARE(session.store.erase(erasure).found, std::vector<std::string>{"held-S01-1.json"});
    }

    /// What others said stays, and so do the protocol and the reason. The search for the same words would find them.
    void wordsThatOthersSaidAreNoTraces()
    {
        const StudyFolder folder = newStudy();
        const auto noted = [&](const char* person, const char* text) {
            OpenSession session(folder, person);
            session.playUntilAnswers(2);
            session.send(study::session::Noted{text, false});
        };
        noted("S01", "left-handed");
        noted("S02", "left-handed, retrained as a child");
        noted("S01", "the participant was uncertain about the first");
        noted("S02", "the participant was uncertain about the last");
        noted("S01", "the \"scratchy\" one, again");
        protocols::writeWholeFile(folder.folder / "copy.txt", "the participant was uncertain about the first");
        StudyStore store(folder, StudyStore::Access::Write);
        const auto record = store.erase({protocols::ParticipantId("S01"), true, "Ada", "noted: the \"scratchy\" one, again", {}});
        // A beginning that two notes share does not hide the rest of one.
        QCOMPARE(record.found, std::vector<std::string>{"copy.txt"});
        QCOMPARE(record.sharedTexts, std::size_t{2});
        QVERIFY(record.searchedTexts > 0);
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
    StudyFolder newStudy() { return m_studies.make(); }
    tests::support::NewStudies m_studies;
};

QTEST_GUILESS_MAIN(ErasureTest)
#include "erasure_test.moc"
