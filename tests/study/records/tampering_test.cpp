// What `vis2hap verify` finds: changes that a person with a shell and the tools of SQLite can make to a study. Each case leaves
// the triggers as they were, so that only the change itself shows.
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "database/event_chain.h"
#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/records/erasure_certificate.h"
#include "study/records/folder_audit.h"
#include "study/records/log_heads.h"
#include "study/records/study_faults.h"
#include "tests/study/records/meddling.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

namespace fs = std::filesystem;
using database::LogHead;
using database::StudyFolder;
using database::StudyStore;
using study::records::findingsOf;
using tests::meddling::faultsOf;
using tests::meddling::meddle;
using tests::meddling::reading;
using tests::support::OpenSession;
using tests::support::RawSqlite;

namespace {

/// Bytes that are flipped: VIS2HAP_FLIPS, or a few where it is not set.
int flipsWanted()
{
    bool isNumber = false;
    const int wanted = qEnvironmentVariableIntValue("VIS2HAP_FLIPS", &isNumber);
    return isNumber ? wanted : 100;
}

/// Every cell of every table, and the schema; a fault of SQLite where they cannot be read.
std::string contentOf(const fs::path& file)
{
    try {
        RawSqlite raw(file);
        std::string content;
        for (const auto& line : raw.rows("SELECT type, name, tbl_name, sql FROM sqlite_master ORDER BY name"))
            content += line + "\n";
        for (const auto& table : raw.rows("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")) {
            std::string cells;
            for (const auto& column : raw.rows("SELECT name FROM pragma_table_info('" + table + "')"))
                cells += (cells.empty() ? "quote(" : " || ',' || quote(") + column + ")";
            for (const auto& line : raw.rows("SELECT " + cells + " FROM " + table)) content += line + "\n";
        }
        return content;
    } catch (const std::exception& fault) {
        return std::string("unreadable: ") + fault.what();
    }
}

}  // namespace

class TamperingTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_place;
    StudyFolder m_study;
    int m_copies = 0;

    StudyFolder copy()
    {
        const fs::path to = m_place.filePath(QString("copy%1").arg(++m_copies)).toStdString();
        fs::copy(m_study.folder, to, fs::copy_options::recursive);
        return {to};
    }

private Q_SLOTS:
    /// S01 finished, S02 started, S03 erased, S04 finished without a word at the end; one act. A passphrase seals the key.
    void initTestCase()
    {
        tests::support::StudyRecipe recipe;
        recipe.participants = 4;
        recipe.passphrase = "four plain short words";
        tests::support::buildStudy(m_place.filePath("other").toStdString(), recipe);
        m_study = tests::support::buildStudy(m_place.filePath("study").toStdString(), recipe);
        {
            OpenSession session(m_study, "S01");
            session.playUntilAnswers(2);
            session.send(
                study::session::Corrected{protocols::QuestionId("Q1"), session.driver->view().trayIds.front(), "misheard"});
            session.playToEnd();
        }
        OpenSession(m_study, "S02").playUntilAnswers(3);
        {
            OpenSession silent(m_study, "S04");
            silent.stepUntil("Debriefing");
            silent.send(study::session::Debriefed{});
        }
        OpenSession session(m_study, "S03");
        session.playUntilAnswers(2);
        QCOMPARE(database::recordAct(m_study, {"backup", "Ada", "test", "here", "/copies/b.tar", session.store.head(), {}}),
                 std::nullopt);
        const database::Erasure erasure{protocols::ParticipantId("S03"), true, "Ada", "asked for it", {}};
        const auto certificate = study::records::writeErasureCertificate(session.store, erasure, session.store.erase(erasure));
        QVERIFY(protocols::readWholeFile(certificate).find("backup /copies/b.tar on here") != std::string::npos);
    }

    void anUntouchedStudyIsSound()
    {
        QCOMPARE(faultsOf(m_study), QString());
        for (const auto& note : findingsOf(reading(m_study)).notes)
            QVERIFY2(note.find("chmod") != std::string::npos, note.c_str());
    }

    /// JSON writes some signs in another way. Nothing of it is a fault.
    void answersWithSignsOfEveryKindAreSound()
    {
        tests::support::StudyRecipe recipe;
        recipe.fabricIds = {"Gr\u00F6\u00DFe 5\" canvas", "\u5E03 'a' & <b>", "50% wool; #2"};
        const auto folder = tests::support::buildStudy(m_place.filePath("signs").toStdString(), recipe);
        OpenSession(folder, "S01").playToEnd();
        const auto faults = database::StudyStore(folder, database::StudyStore::Access::Read).faults();
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults.front().c_str());
    }

    void aChangedDatabaseIsFound_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        QTest::newRow("view redefined")
            << "DROP VIEW answers; CREATE VIEW answers AS SELECT rating_tenths + 30 AS rating FROM responses"
            << "the view answers is not the one that this program makes";
        QTest::newRow("view dropped") << "DROP VIEW answers"
                                      << "the view answers is missing";
        QTest::newRow("index dropped") << "DROP INDEX one_first_answer"
                                       << "the index one_first_answer is missing";
        QTest::newRow("trigger added") << "CREATE TRIGGER more AFTER INSERT ON voids BEGIN DELETE FROM notes; END"
                                       << "the trigger more is unknown to this program";
        QTest::newRow("table added") << "CREATE TABLE extra(a)"
                                     << "the table extra is unknown to this program";
        QTest::newRow("started made finished") << "UPDATE participants SET state = 'finished' WHERE id = 'S02'"
                                               << "participant S02 is finished in the table and started in the log";
        QTest::newRow("finished made started") << "UPDATE participants SET state = 'started' WHERE id = 'S01'"
                                               << "participant S01 is started in the table and finished in the log";
        QTest::newRow("erased brought back") << "UPDATE participants SET state = 'started' WHERE id = 'S03'"
                                             << "participant S03 is started in the table and withdrawn in the log";
        QTest::newRow("protocol version") << "UPDATE participants SET protocol_version = 7 WHERE id = 'S01'"
                                          << "participant S01 follows version 7";
        QTest::newRow("fact inserted") << "INSERT INTO participant_facts(participant, fact, value) VALUES ('S01', 'mood', 'good')"
                                       << "the fact \"mood\" of participant S01 is not in the log";
        QTest::newRow("fact of an erased participant")
            << "INSERT INTO participant_facts(participant, fact, value) VALUES ('S03', 'debriefing', 'good')"
            << "the fact \"debriefing\" of participant S03 is not in the log";
        QTest::newRow("fact changed") << "UPDATE participant_facts SET value = 'awful' WHERE fact = 'debriefing'"
                                      << "the fact \"debriefing\" of participant S01 was altered";
        QTest::newRow("fact removed") << "DELETE FROM participant_facts WHERE fact = 'debriefing'"
                                      << "the fact \"debriefing\" of participant S01 is missing";
        QTest::newRow("debriefing forged")
            << "INSERT INTO participant_facts VALUES ('S04', 'debriefing', 'I knew the conditions', '')"
            << "the fact \"debriefing\" of participant S04 is not in the log";
        QTest::newRow("erasure without an entry") << "INSERT INTO erasures VALUES (3, 'S01', 1, 'Ada', 'no reason', '')"
                                                  << "the erasure of S01 (entry 3) is not in the log";
        QTest::newRow("erasure removed") << "DELETE FROM erasures"
                                         << "the erasure of S03";
        QTest::newRow("erasure by somebody else") << "UPDATE erasures SET who = 'Bob'"
                                                  << "the erasure of S03";
        QTest::newRow("entries emptied")
            << "DELETE FROM responses WHERE participant = 'S01'; DELETE FROM notes; UPDATE events SET payload = '{}', at_ns = 0, "
               "wall_time = '', salt = '' WHERE participant = 'S01'"
            << "the entry or its rows were altered";
        QTest::newRow("protocol added") << "INSERT INTO protocol_versions VALUES (2, 2, '{}', 'a', 'Ada', 'why', '')"
                                        << "the protocol's version 2 (entry 2) is not in the log";
        QTest::newRow("correction undone by order") << "UPDATE responses SET id = -id WHERE is_correction = 1"
                                                    << "does not follow the order of the log";
        QTest::newRow("act changed") << "UPDATE acts SET details = replace(details, 'b.tar', 'c.tar')"
                                     << "act 1 (backup): was altered";
        QTest::newRow("act removed") << "DELETE FROM acts"
                                     << "the acts end at number 0, 1 were written";
        QTest::newRow("acts cut off") << "DELETE FROM acts; DELETE FROM sqlite_sequence WHERE name = 'acts'"
                                      << "act 1, which entry";
        // The program reads 32 bits or yes and no, and SQL sees all of the number.
        QTest::newRow("answers hidden") << "UPDATE responses SET is_correction = 4294967296 WHERE is_correction = 0"
                                        << "hold numbers in is_correction";
        QTest::newRow("correction by another yes") << "UPDATE responses SET is_correction = 2 WHERE is_correction = 1"
                                                   << "1 rows of the table responses hold numbers in is_correction";
        QTest::newRow("correction undone") << "UPDATE responses SET attempt = attempt + 4294967296 WHERE is_correction = 1"
                                           << "hold numbers in attempt";
        QTest::newRow("rating off the scale") << "UPDATE responses SET rating_tenths = 990 WHERE rating_tenths IS NOT NULL"
                                              << "is none that the question can have";
        QTest::newRow("choice off the tray") << "UPDATE responses SET choice = 'F99' WHERE choice IS NOT NULL"
                                             << "is none that the question can have";
        QTest::newRow("rating far away") << "UPDATE responses SET rating_tenths = rating_tenths - 4294967296"
                                         << "hold numbers in rating_tenths";
        QTest::newRow("version far away") << "UPDATE participants SET protocol_version = protocol_version + 4294967296"
                                          << "hold numbers in protocol_version";
        QTest::newRow("last number") << "UPDATE responses SET id = 9223372036854775807 WHERE id = (SELECT MAX(id) FROM responses)"
                                     << "hold numbers in id";
        // The same letter in two bytes, which readers repair and SQL does not.
        QTest::newRow("overlong letter")
            << "UPDATE responses SET choice = CAST(X'C186' AS TEXT) || substr(choice, 2) WHERE choice LIKE 'F%'"
            << "the entry or its rows were altered";
        QTest::newRow("overlong letter of a fact")
            << "UPDATE participant_facts SET value = CAST(X'C1A9' AS TEXT) || substr(value, 2) WHERE fact = 'debriefing'"
            << "was altered";
        QTest::newRow("unknown sequence") << "INSERT INTO sqlite_sequence VALUES ('voids', 77)"
                                          << "the table sqlite_sequence has unknown rows";
        QTest::newRow("seed changed") << "UPDATE study SET design_seed = '8'"
                                      << "were altered after the study was made";
    }
    void aChangedDatabaseIsFound()
    {
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const auto folder = copy();
        meddle(folder, sql.toStdString());
        const QString faults = faultsOf(folder);
        QVERIFY2(faults.contains(said), qPrintable(faults));
    }

    void aDroppedTriggerIsFound()
    {
        const auto folder = copy();
        QCOMPARE(RawSqlite(folder.database()).run("DROP TRIGGER responses_no_UPDATE"), std::string());
        QCOMPARE(faultsOf(folder), QString("study.db: the trigger responses_no_UPDATE is missing"));
    }

    void aChangedFolderIsFound_data()
    {
        QTest::addColumn<QString>("harm");
        QTest::addColumn<QString>("said");
        QTest::newRow("stray file") << "printf x > notes.txt"
                                    << "notes.txt: does not belong to the study";
        QTest::newRow("stray folder") << "mkdir other"
                                      << "other: does not belong to the study";
        QTest::newRow("stray stimulus") << "cp stimuli/$(ls stimuli | head -1) stimuli/other.sealed"
                                        << "stimuli/other.sealed: does not belong to the study";
        QTest::newRow("stray link") << "ln -s /etc/passwd stimuli/link"
                                    << "stimuli/link: does not belong to the study";
        QTest::newRow("unregistered plan") << "printf x > preregistration.txt"
                                           << "preregistration.txt: does not belong to the study";
        QTest::newRow("link to a stimulus")
            << "f=stimuli/$(ls stimuli | head -1); mv $f ../$(basename $PWD).moved; ln -s ../../$(basename $PWD).moved $f"
            << "a link stands in the place of the file";
        QTest::newRow("link to the protocol")
            << "cp protocol.json ../$(basename $PWD).json; ln -sf ../$(basename $PWD).json protocol.json"
            << "protocol.json: a link stands in the place of the file";
        QTest::newRow("pipe for the protocol") << "rm protocol.json; mkfifo protocol.json"
                                               << "protocol.json: is no file";
        QTest::newRow("stimuli swapped") << "cd stimuli; a=$(ls | sed -n 1p); b=$(ls | sed -n 2p); mv $a x; mv $b $a; mv x $b"
                                         << "the stimulus was altered";
        QTest::newRow("stimulus removed") << "rm stimuli/$(ls stimuli | head -1)"
                                          << "the stimulus is missing";
        QTest::newRow("allocation key") << "printf x >> allocation-key.json"
                                        << "allocation-key.json";
        QTest::newRow("sealed key destroyed") << "echo garbage > allocation-key.sealed"
                                              << "the sealed allocation key is not the file that the log names";
        QTest::newRow("digits of the sealed key")
            << "sed -i 's/\"box\": \"................/\"box\": \"0123456789abcdef/' allocation-key.sealed"
            << "the sealed allocation key is not the file that the log names";
        QTest::newRow("sealed key of another study") << "cp ../other/allocation-key.sealed ."
                                                     << "the sealed allocation key is not the file that the log names";
        QTest::newRow("certificate rewritten") << "sed -i 's/^Rows removed.*/Rows removed: 0 answers/' erasures/*"
                                               << ".txt: was altered";
        QTest::newRow("certificate invented") << "cp erasures/* erasures/erasure-1.txt"
                                              << "erasures/erasure-1.txt: is of an erasure that the log does not have";
        QTest::newRow("certificates removed") << "rm -r erasures"
                                              << ".txt: is missing";
        QTest::newRow("rescue file of nothing") << "echo any text > rescue-1.db"
                                                << "rescue-1.db: is no database of this study";
        QTest::newRow("rescue file of another study") << "cp ../other/study.db rescue-2.db"
                                                      << "rescue-2.db: is no database of this study";
        QTest::newRow("log of no rescue file") << "printf x > rescue-9.db-wal"
                                               << "rescue-9.db-wal: does not belong to the study";
        QTest::newRow("copy of no upgrade") << "mkdir before-upgrade-9"
                                            << "before-upgrade-9: does not belong to the study";
        QTest::newRow("an upgrade invented") << "mkdir .upgrade"
                                             << ".upgrade: an upgrade was interrupted, or somebody made this folder";
        QTest::newRow("link behind an invented upgrade")
            << "mkdir .upgrade; mv protocol.json ../$(basename $PWD).p; ln -s ../$(basename $PWD).p protocol.json"
            << "protocol.json: a link stands in the place of the file";
        QTest::newRow("certificates removed behind an invented upgrade") << "mkdir .upgrade other; rm -r erasures"
                                                                         << ".txt: is missing";
        QTest::newRow("folder behind an invented upgrade") << "mkdir .upgrade other"
                                                           << "other: does not belong to the study";
        QTest::newRow("station key") << "printf x >> station-key.json"
                                     << "station-key.json";
        QTest::newRow("protocol") << "printf ' ' >> protocol.json"
                                  << "protocol.json: changed since";
    }
    void aChangedFolderIsFound()
    {
        QFETCH(QString, harm);
        QFETCH(QString, said);
        const auto folder = copy();
        QCOMPARE(std::system(("cd " + folder.folder.string() + " && " + harm.toStdString()).c_str()), 0);
        const QString faults = faultsOf(folder);
        QVERIFY2(faults.contains(said), qPrintable(faults));
    }

    void keptDatabasesAreNoted()
    {
        const auto folder = copy();
        const auto notes = [&] {
            QString text;
            for (const auto& note : findingsOf(reading(folder)).notes) text += QString::fromStdString(note) + "\n";
            return text;
        };
        reading(folder).copyTo(folder.folder / "rescue-1.db");
        fs::copy_file(folder.database(), folder.folder / "study-before-rescue-3.db");
        QVERIFY(notes().contains("study-before-rescue-3.db: kept aside") && notes().contains("its log is that of the study"));
        OpenSession(folder, "S02").playUntilAnswers(5);
        QVERIFY2(notes().contains("its log is the beginning of the study's"), qPrintable(notes()));
        QCOMPARE(faultsOf(folder), QString());
        fs::rename(folder.database(), folder.folder / "rescue-2.db");
        fs::copy_file(folder.folder / "rescue-1.db", folder.database());
        QVERIFY2(notes().contains("goes on where that of the study ends"), qPrintable(notes()));
        OpenSession(folder, "S02").playUntilAnswers(4);
        QVERIFY2(notes().contains("is apart from the study's"), qPrintable(notes()));
        std::ofstream(folder.folder / "study-before-rescue-7.db") << "any text";
        QVERIFY2(notes().contains("study-before-rescue-7.db: is no database of this study"), qPrintable(notes()));
        QCOMPARE(faultsOf(folder), QString());
        QVERIFY(!fs::exists(folder.folder / "study-before-rescue-3.db-shm"));
    }

    /// A killed program leaves it beside its place, and verify names it.
    void unfinishedFilesAreNoted()
    {
        const auto folder = copy();
        const std::string certificate = fs::directory_iterator(folder.folder / "erasures")->path().filename().string();
        std::ofstream(folder.folder / "erasures" / ("." + certificate + ".unfinished-lab-77")) << "x";
        QCOMPARE(faultsOf(folder), QString());
        QString notes;
        for (const auto& note : findingsOf(reading(folder)).notes) notes += QString::fromStdString(note) + "\n";
        QVERIFY2(notes.contains(".txt.unfinished-lab-77: left by a program that was killed"), qPrintable(notes));
        QCOMPARE(study::records::findingsInFolder(reading(folder)).unknownFiles.size(), 1u);
        std::ofstream(folder.folder / ".secret.unfinished-lab-77") << "x";
        QVERIFY(faultsOf(folder).contains(".secret.unfinished-lab-77: does not belong to the study"));
    }

    void modesAreNotedOnly()
    {
        const auto folder = copy();
        fs::permissions(folder.stationKey(), fs::perms(0644));
        const auto findings = findingsOf(reading(folder));
        QVERIFY(findings.faults.empty());
        QVERIFY(!findings.notes.empty() && findings.notes.front().find("chmod -R go-rwx") != std::string::npos);
        QCOMPARE(std::system(("chmod -R go-rwx " + folder.folder.string()).c_str()), 0);
        QVERIFY(findingsOf(reading(folder)).notes.empty());
    }

    void flippedBytesAreFoundOrLieOutsideTheData()
    {
        const auto folder = copy();
        std::string bytes = protocols::readWholeFile(folder.database());
        const std::string content = contentOf(folder.database());
        QVERIFY(content.size() > 10000 && !content.starts_with("unreadable"));
        const int flips = flipsWanted();
        std::mt19937 random(20260101);
        int found = 0, outside = 0;
        for (int flip = 0; flip < flips; ++flip) {
            const std::size_t place = random() % bytes.size();
            const char before = bytes[place];
            bytes[place] = static_cast<char>(before ^ static_cast<char>(1 + random() % 255));
            std::ofstream(folder.database(), std::ios::binary | std::ios::trunc) << bytes;
            bool isFound = true;
            try {
                isFound = !findingsOf(reading(folder)).faults.empty();
            } catch (const protocols::Error&) {
                // A database that cannot be read is a fault, too.
            }
            if (isFound)
                ++found;
            else if (contentOf(folder.database()) == content)
                ++outside;
            else
                QFAIL(qPrintable(QString("the flip at byte %1 changed the content and was not found").arg(place)));
            bytes[place] = before;
        }
        qInfo("%d flips: %d found, %d outside the data", flips, found, outside);
        QVERIFY(found > flips / 10);
    }

    void actsBeforeAKnownHeadCannotBeCutOff()
    {
        const auto folder = copy();
        for (const char* file : {"/copies/c.tar", "/copies/d.tar"})
            (void)database::recordAct(folder, {"export", "Ada", "test", "here", file, reading(folder).head(), {}});
        const LogHead acts = headOfActs(reading(folder));
        QVERIFY(acts.sequence == 3 && study::records::faultAgainst(reading(folder), acts).empty());
        const std::string cut = "DELETE FROM acts WHERE number > 1; UPDATE sqlite_sequence SET seq = 1 WHERE name = 'acts'";
        {
            const auto other = copy();  // without a later entry of the log, only their own head shows it
            for (int more = 0; more < 2; ++more)
                (void)database::recordAct(other, {"export", "Ada", "test", "here", "", reading(other).head(), {}});
            const LogHead end = headOfActs(reading(other));
            meddle(other, cut);
            QCOMPARE(faultsOf(other), QString());
            QVERIFY(!study::records::faultAgainst(reading(other), end).empty());
        }
        OpenSession(folder, "S02").playUntilAnswers(4);  // its sitting begins with an entry
        QCOMPARE(faultsOf(folder), QString());
        meddle(folder, cut);
        QVERIFY2(faultsOf(folder).contains("act 3, which entry"), qPrintable(faultsOf(folder)));
    }

    void anInventedUpgradeIsFound()
    {
        const auto folder = copy();
        {
            const database::SqliteConnection sqlite(folder.database(), database::SqliteConnection::Mode::Write);
            sqlite.run("INSERT INTO participant_facts VALUES ('S04', 'debriefing', 'I knew the conditions', '')");
            store(sqlite,
                  database::actOnStudy(
                      database::upgradedKind,
                      {{"schema", 3}, {"faults_before", nlohmann::json::array()}, {"fixed_sha256", hashOfFixedTables(sqlite)}},
                      "2026-01-01T00:00:00.000Z"));
        }
        QVERIFY2(faultsOf(folder).contains("(upgraded): the study had schema 3 before"), qPrintable(faultsOf(folder)));
    }

    void theCertificateNamesTheServerThatTheStudyWasOn()
    {
        const auto folder = copy();
        const std::string address = "postgresql://owner@server.lab/lab?study=pilot";
        QCOMPARE(database::recordAct(folder, {database::serverAct, "Ada", "test", "here", address, reading(folder).head(), {}}),
                 std::optional<std::string>());
        StudyStore store(folder, StudyStore::Access::Write);
        const database::Erasure erasure{protocols::ParticipantId("S02"), true, "Ada", "asked for it", {}};
        const auto text = protocols::readWholeFile(study::records::writeErasureCertificate(store, erasure, store.erase(erasure)));
        for (const char* said :
             {"server postgresql://owner@server.lab/lab?study=pilot on here", "write-ahead log", "pg_switch_wal"})
            QVERIFY2(text.find(said) != std::string::npos, text.c_str());
    }

    void anActHoldsTheHeadOfItsTime()
    {
        const auto folder = copy();
        meddle(folder,
               "UPDATE events SET hash = upper(hash) WHERE sequence = (SELECT json_extract(details, '$.entry') FROM acts)");
        QVERIFY(faultsOf(folder).contains("act 1 (backup): the log no longer has the head of that time"));
    }
};

QTEST_GUILESS_MAIN(TamperingTest)
#include "tampering_test.moc"
