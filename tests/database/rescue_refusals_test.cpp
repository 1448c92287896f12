// Rescue files that do not belong to the folder, or would bring back what was erased; names of the folder under which its files
// are found; and erasures that were interrupted.
#include <unistd.h>

#include <QTemporaryDir>
#include <QTest>
#include <filesystem>

#include "database/disk/server_note.h"
#include "database/erasure.h"
#include "database/rescue_files.h"
#include "protocols/files/whole_file.h"
#include "study/records/erasure_certificate.h"
#include "study/records/study_faults.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace database;
using tests::support::errorOf;
using tests::support::OpenSession;
using tests::support::RawSqlite;

namespace {

namespace fs = std::filesystem;

const Erasure erasureOfS01{protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}};

void removeDatabase(const StudyFolder& folder)
{
    for (const char* ending : {"", "-wal", "-shm"}) fs::remove(folder.database().string() + ending);
}

/// A view of the table's columns whose query never ends.
void putEndlessView(const fs::path& database, const std::string& table)
{
    RawSqlite raw(database);
    raw.dropTriggers();
    std::string columns;
    for (const std::string& name : raw.rows("SELECT name FROM pragma_table_info('" + table + "')"))
        columns += (columns.empty() ? "i AS " : ", i AS ") + name;
    for (const std::string& sql :
         {std::string("PRAGMA foreign_keys = OFF"), std::string("DROP VIEW answers"), "DROP TABLE " + table,
          "CREATE VIEW " + table + " AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT " + columns +
              " FROM n WHERE i < 0"})
        if (const std::string fault = raw.run(sql); !fault.empty()) qFatal("%s", fault.c_str());
}

void copyDatabase(const StudyFolder& folder, const fs::path& to) { StudyStore(folder, StudyStore::Access::Read).copyTo(to); }

}  // namespace

class RescueRefusalsTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    /// In a folder of its own, so that nothing else lies beside it, and with keys of its own.
    StudyFolder newStudy(int answers)
    {
        const fs::path above = m_place.filePath(QString("%1").arg(++m_studies)).toStdString();
        fs::create_directory(above);
        const StudyFolder folder =
            tests::support::buildStudy(above / "study", {.keySeed = static_cast<std::uint64_t>(m_studies)});
        OpenSession(folder, "S01").playUntilAnswers(answers);
        return folder;
    }

private Q_SLOTS:
    void aFileOfAnotherStudyIsRefused_data()
    {
        QTest::addColumn<QString>("present");
        QTest::newRow("no study.db") << "none";
        QTest::newRow("a damaged study.db") << "damaged";
        QTest::newRow("a sound study.db") << "sound";
    }
    void aFileOfAnotherStudyIsRefused()
    {
        QFETCH(const QString, present);
        const StudyFolder folder = newStudy(4), other = newStudy(6);
        // The folder of another study had this name before.
        const fs::path foreign = folder.folder.parent_path() / "study-rescue-1.db";
        copyDatabase(other, foreign);
        if (present != "sound") removeDatabase(folder);
        if (present == "damaged") protocols::writeWholeFile(folder.database(), "no database");
        QVERIFY(rescueFiles(folder).empty());
        const QString told = errorOf([&] { StudyStore::rescue(folder, foreign); });
        QVERIFY2(told.startsWith("2:") && told.contains(present == "sound" ? "of two studies" : "of another study"),
                 qPrintable(told));
        QVERIFY(fs::exists(foreign));
        QCOMPARE(fs::exists(folder.database()), present != "none");
    }

    /// An entry that the rescue file lacks has no hash, either.
    void aStudyWhoseLastHashIsGoneIsNotReplaced()
    {
        const StudyFolder folder = newStudy(3);
        const fs::path file = folder.folder / "rescue-1.db";
        copyDatabase(folder, file);
        OpenSession(folder, "S01").playUntilAnswers(5);
        {
            RawSqlite raw(folder.database());
            raw.dropTriggers();
            QCOMPARE(raw.run("UPDATE events SET hash = '' WHERE sequence = (SELECT MAX(sequence) FROM events)"), std::string());
        }
        const QString told = errorOf([&] { StudyStore::rescue(folder, file); });
        QVERIFY2(told.contains("every entry of the rescue file already"), qPrintable(told));
        QVERIFY(fs::exists(file));
    }

    void aFolderWithoutKeysIsNoPlaceForAStudy()
    {
        const StudyFolder folder = newStudy(3);
        const fs::path file = folder.folder.parent_path() / "kept.db", empty = folder.folder.parent_path() / "empty";
        copyDatabase(folder, file);
        fs::create_directory(empty);
        const QString told = errorOf([&] { StudyStore::rescue({empty}, file); });
        QVERIFY2(told.contains("has no station key"), qPrintable(told));
        QVERIFY(!fs::exists(empty / "study.db"));
    }

    void aStudyOnAServerIsRefused()
    {
        const StudyFolder folder = newStudy(3);
        const fs::path file = folder.folder / "rescue-1.db";
        copyDatabase(folder, file);
        removeDatabase(folder);
        writeServerNote(folder.folder, {"postgresql://owner@lab/lab?study=pilot", "owner", std::string(64, 'a'), true});
        const QString told = errorOf([&] { StudyStore::rescue(folder, file); });
        QVERIFY2(told.contains("lies on a server") && told.contains("study move"), qPrintable(told));
        QVERIFY(fs::exists(file) && !fs::exists(folder.database()));
    }

    /// Neither over the study, nor in the place of a study.db that is gone.
    void erasedAnswersAreNotBroughtBack()
    {
        const StudyFolder folder = newStudy(5);
        const fs::path file = folder.folder.parent_path() / "older.db";
        copyDatabase(folder, file);
        {
            StudyStore store(folder, StudyStore::Access::Write);
            const auto record = store.erase(erasureOfS01);
            study::records::writeErasureCertificate(store, erasureOfS01, record);
        }
        QString told = errorOf([&] { StudyStore::rescue(folder, file); });
        QVERIFY2(told.contains("has every entry of the rescue file already"), qPrintable(told));
        removeDatabase(folder);
        told = errorOf([&] { StudyStore::rescue(folder, file); });
        QVERIFY2(told.contains("from before the erasure of erasure-") && !fs::exists(folder.database()), qPrintable(told));
    }

    /// Where an older backup was put back, the log does not know the erasure, and a rescue file from before it goes on where that
    /// log ends.
    void anErasureThatTheLogLacksIsRemembered()
    {
        const StudyFolder folder = newStudy(4);
        const fs::path backup = folder.folder.parent_path() / "backup.db", rescue = folder.folder / "rescue-1.db";
        copyDatabase(folder, backup);
        tests::support::OpenSession(folder, "S01").playUntilAnswers(6);
        copyDatabase(folder, rescue);
        fs::path certificate;
        {
            StudyStore store(folder, StudyStore::Access::Write);
            certificate = study::records::writeErasureCertificate(store, erasureOfS01, store.erase(erasureOfS01));
        }
        const auto erased = protocols::readWholeFile(certificate);
        removeDatabase(folder);
        fs::copy_file(backup, folder.database());
        const auto findings = study::records::findingsOf(StudyStore(folder, StudyStore::Access::Read));
        const auto has = [](const std::vector<std::string>& lines, const char* said) {
            return std::ranges::any_of(lines, [&](const auto& line) { return line.find(said) != std::string::npos; });
        };
        QVERIFY(has(findings.faults, "is of an erasure that the log does not have"));
        QVERIFY(has(findings.notes, "an erasure came after it") && !has(findings.notes, "run vis2hap rescue"));
        const QString told = errorOf([&] { StudyStore::rescue(folder, rescue); });
        QVERIFY2(told.contains("from before the erasure of erasure-"), qPrintable(told));
        fs::remove(rescue);

        // Another erasure takes the same entry.
        StudyStore store(folder, StudyStore::Access::Write);
        const auto entry = fs::path(certificate).filename().string();
        const Erasure facts{protocols::ParticipantId("S01"), false, "Bob", "wish", {}};
        while (store.head().sequence + 1 < std::stoll(entry.substr(entry.find('-') + 1))) store.erase(facts);
        study::records::writeErasureCertificate(store, facts, store.erase(facts));
        QVERIFY(protocols::readWholeFile(certificate) != erased);
        QCOMPARE(protocols::readWholeFile(certificate.parent_path() / (certificate.stem().string() + "-of-another-log-1.txt")),
                 erased);
        QVERIFY(has(study::records::findingsOf(store).faults, "-of-another-log-1.txt: is of an erasure"));
    }

    /// Between the new name of study.db and the rescued one in its place.
    void anInterruptedRescueIsDoneAgain()
    {
        const StudyFolder folder = newStudy(2);
        const fs::path older = folder.folder.parent_path() / "older.db";
        copyDatabase(folder, older);
        tests::support::OpenSession(folder, "S01").playUntilAnswers(4);
        copyDatabase(folder, folder.folder / "rescue-1.db");
        removeDatabase(folder);
        fs::copy_file(older, folder.database());
        fs::create_hard_link(folder.database(), folder.folder / "study-before-rescue-1.db");
        const QString told = errorOf([&] { StudyStore(folder, StudyStore::Access::Write); });
        QVERIFY2(told.contains("a rescue was interrupted") && told.contains("run vis2hap rescue"), qPrintable(told));
        StudyStore::rescue(folder, folder.folder / "rescue-1.db");
        QCOMPARE(StudyStore(folder, StudyStore::Access::Write).answers().size(), 4u);
    }

    void filesOfOtherNamesOfTheFolderAreFound()
    {
        const StudyFolder folder = newStudy(4), other = newStudy(2);
        const fs::path place = folder.folder.parent_path(), elsewhere = m_place.filePath("links").toStdString();
        copyDatabase(folder, place / "study-rescue-1.db");
        copyDatabase(folder, place / "name-before-rescue-4.db");
        copyDatabase(other, place / "other-rescue-1.db");
        fs::create_directory(elsewhere);
        fs::create_directory_symlink(folder.folder, elsewhere / "link");
        const StudyFolder linked{elsewhere / "link"};
        QCOMPARE(rescueFiles(linked).size(), 2u);
        const auto record = StudyStore(linked, StudyStore::Access::Write).erase(erasureOfS01);
        auto found = record.found;
        std::ranges::sort(found);
        QVERIFY(found ==
                (std::vector<std::string>{(place / "name-before-rescue-4.db").string(), (place / "study-rescue-1.db").string()}));
    }

    /// study-before-rescue-N.db is what a rescue put aside, and a copy of the study leaves the files of the other one alone.
    void onlyRescueFilesOfTheFolderAreUsedUp()
    {
        const StudyFolder folder = newStudy(4);
        const fs::path inside = folder.folder / "rescue-1.db", beside = folder.folder.parent_path() / "study-rescue-1.db";
        copyDatabase(folder, inside);
        copyDatabase(folder, beside);
        QVERIFY(!StudyStore::rescue(folder, inside).earlier.empty());
        QVERIFY(!fs::exists(inside) && rescueFiles(folder) == std::vector<fs::path>{beside});
        const StudyFolder copy{folder.folder.parent_path() / "study-copy"};
        fs::copy(folder.folder, copy.folder, fs::copy_options::recursive);
        removeDatabase(copy);
        QCOMPARE(rescueFiles(copy), std::vector<fs::path>{beside});
        StudyStore::rescue(copy, beside);
        QVERIFY(fs::exists(beside));
        QCOMPARE(StudyStore(copy, StudyStore::Access::Read).answers().size(), 4u);
    }

    /// The texts that an interrupted erasure removed are no longer known: copies of the database are found by their rows, and the
    /// certificate says that nothing else could be searched.
    void anInterruptedErasureIsNoSearch()
    {
        const StudyFolder folder = newStudy(5);
        const fs::path file = folder.folder.parent_path() / "study-rescue-1.db";
        copyDatabase(folder, file);
        StudyStore store(folder, StudyStore::Access::Write);
        const auto first = store.erase(erasureOfS01);  // ends before its certificate
        QVERIFY(first.interrupted.empty());
        const auto second = store.erase(erasureOfS01);
        QCOMPARE(second.searchedTexts, std::size_t{0});
        QCOMPARE(second.interrupted, std::vector<std::int64_t>{first.event});
        QCOMPARE(second.found, std::vector<std::string>{file.string()});
        const auto certificate = study::records::writeErasureCertificate(store, erasureOfS01, second);
        const QString text = QString::fromStdString(protocols::readWholeFile(certificate));
        QVERIFY2(text.contains(QString("The erasure of entry %1 was interrupted").arg(first.event)), qPrintable(text));
        QVERIFY(store.erase(erasureOfS01).interrupted.empty());  // the certificate has told it
        QVERIFY2(text.contains("study-rescue-1.db") && text.contains("What stays: the code of the participant"),
                 qPrintable(text));
    }

    /// A view may never end: neither the study nor a file that bears the name of a rescue file may stop a command for ever.
    void aViewInThePlaceOfATableIsNotRead()
    {
        const StudyFolder folder = newStudy(5);
        const fs::path file = folder.folder.parent_path() / "study-rescue-1.db", copy = folder.folder.parent_path() / "copy";
        copyDatabase(folder, file);
        fs::copy(folder.folder, copy, fs::copy_options::recursive);
        putEndlessView(file, "study");
        // What its other tables hold is not read, so that it counts as found.
        for (const bool answersToo : {false, true})
            QCOMPARE(databasesAbout("S01", answersToo, folder), std::vector<std::string>{file.string()});
        QCOMPARE(StudyStore(folder, StudyStore::Access::Write).erase(erasureOfS01).found,
                 std::vector<std::string>{file.string()});
        QVERIFY(errorOf([&] { StudyStore::rescue(folder, file); }).contains("in the place of the table study"));

        putEndlessView(copy / "study.db", "Notes");
        for (const auto access : {StudyStore::Access::Read, StudyStore::Access::Write}) {
            const QString told = errorOf([&] { StudyStore({copy}, access); });
            QVERIFY2(told.startsWith("1:") && told.contains("in the place of the table Notes"), qPrintable(told));
        }
    }

    /// Anybody may put a file into the folder for temporary files, or beside a study in a shared folder.
    void filesOfOtherAccountsAreNamedAndNotOpened()
    {
        constexpr uid_t anotherAccount = 54321;
        const StudyFolder folder = newStudy(5);
        const fs::path file = folder.folder.parent_path() / "study-rescue-1.db";
        copyDatabase(folder, file);
        if (::chown(file.c_str(), anotherAccount, static_cast<gid_t>(-1)) != 0) QSKIP("only root can give a file away");
        const auto outside = rescueFilesOutside(folder), ofOthers = rescueFilesOfOthers(folder);
        QVERIFY(rescueFiles(folder).empty() && std::ranges::find(outside, file) == outside.end());
        QVERIFY(std::ranges::find(ofOthers, file) != ofOthers.end());
        StudyStore store(folder, StudyStore::Access::Write);
        const auto record = store.erase(erasureOfS01);
        QCOMPARE(record.found, std::vector<std::string>{file.string()});  // Its bytes are searched all the same.
        const QString text = QString::fromStdString(
            protocols::readWholeFile(study::records::writeErasureCertificate(store, erasureOfS01, record)));
        QVERIFY2(text.contains("another account owns it: " + QString::fromStdString(file.string())), qPrintable(text));
    }

    void nothingIsErasedWhereTheCertificateCannotBeWritten()
    {
        const StudyFolder folder = newStudy(5);
        protocols::writeWholeFile(folder.folder / "erasures", "no folder");
        StudyStore store(folder, StudyStore::Access::Write);
        QVERIFY(errorOf([&] { store.erase(erasureOfS01); }).contains("erasures"));
        QCOMPARE(store.answers().size(), 5u);
        QVERIFY(store.erasures().empty());
    }
};

QTEST_GUILESS_MAIN(RescueRefusalsTest)
#include "rescue_refusals_test.moc"
