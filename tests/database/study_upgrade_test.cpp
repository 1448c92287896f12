// A study of version 0.5.0 is upgraded whole or not at all, wherever the program is killed.
#include "database/disk/study_upgrade.h"

#include <sys/wait.h>
#include <unistd.h>

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QMap>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "database/disk/write_lock.h"
#include "database/study_store.h"
#include "protocols/files/canonical_bytes.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/records/log_heads.h"
#include "study/records/study_faults.h"
#include "tests/support/error_text.h"
#include "tests/support/raw_sqlite.h"

using namespace database;
using tests::support::RawSqlite;
using Access = StudyStore::Access;

namespace {

namespace fs = std::filesystem;

/// Numbers of the kept study `half`, from its README and its script.
constexpr std::size_t answersOfHalf = 17;
constexpr int stepsOfUpgrade = 8;

/// What `erase --answers` did in 0.5.0.
constexpr const char* removedBy050 =
    "DELETE FROM responses; DELETE FROM notes; DELETE FROM voids; UPDATE events SET payload = '{}' WHERE participant = 'S03'; "
    "UPDATE participants SET state = 'withdrawn'";

/// The entry that 0.5.0 wrote then, under its unsalted hash.
std::string entryOfErasure(RawSqlite& raw)
{
    const std::string payload = R"({"participant":"S03","answers_too":true,"who":"Ada","why":"wish"})";
    const std::string last = raw.rows("SELECT hash FROM events ORDER BY sequence DESC LIMIT 1").front();
    const std::string number = raw.rows("SELECT MAX(sequence) + 1 FROM events").front();
    const std::string time = "2026-01-01T10:00:00.000Z", empty;
    protocols::CanonicalBytes bytes;
    bytes << last << number << empty << 0 << std::string("erased") << payload << 0 << time;
    return "INSERT INTO events VALUES (" + number + ", '', 0, 'erased', '" + payload + "', 0, '" + time + "', '" + last + "', '" +
           bytes.hash() + "'); INSERT INTO erasures VALUES (" + number + ", 'S03', 1, 'Ada', 'wish', '" + time + "')";
}

/// Everything that an answer holds but its code, which the upgrade renames.
QStringList answersOf(const StudyStore& store)
{
    QStringList lines;
    for (const CurrentAnswer& answer : store.answers())
        lines << QString("%1 %2 %3 %4 %5 %6 %7 %8 %9")
                     .arg(QString::fromStdString(answer.participant.value))
                     .arg(answer.record.trial.value)
                     .arg(QString::fromStdString(answer.record.question.value),
                          QString::fromStdString(answer.record.answer.value_or("-")))
                     .arg(answer.record.rating ? answer.record.rating->value : -1)
                     .arg(answer.attempt)
                     .arg(answer.voided)
                     .arg(answer.storedAtNs)
                     .arg(QString::fromStdString(answer.wallTime + answer.record.note));
    return lines;
}

/// Names and bytes of every file but the shared memory of SQLite.
QMap<QString, QByteArray> contentOf(const fs::path& folder)
{
    QMap<QString, QByteArray> content;
    QDirIterator files(QString::fromStdString(folder.string()), QDir::Files | QDir::Hidden, QDirIterator::Subdirectories);
    while (files.hasNext()) {
        QFile file(files.next());
        if (!file.fileName().endsWith("-shm") && file.open(QIODevice::ReadOnly)) content[file.fileName()] = file.readAll();
    }
    return content;
}

/// Upgrades in a program of its own that ends without any cleaning at its `last`-th step. Returns its exit code.
int upgradeAndDie(const StudyFolder& folder, int last)
{
    const pid_t child = ::fork();
    if (child == 0) {
        int steps = 0;
        try {
            const WriteLock lock(folder);
            upgrade(folder, [&](const std::string&) {
                if (++steps == last) ::_exit(9);
            });
        } catch (const protocols::Error&) {
            ::_exit(1);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WEXITSTATUS(status);
}

/// Runs the statement with triggers and checks out of force.
void alter(const StudyFolder& folder, const QString& sql)
{
    RawSqlite raw(folder.database());
    raw.dropTriggers();
    const std::string fault = raw.run("PRAGMA ignore_check_constraints = 1; PRAGMA foreign_keys = 0; " + sql.toStdString());
    if (!fault.empty()) throw std::runtime_error(fault + ": " + sql.toStdString());
}

QString joined(const std::vector<std::string>& lines)
{
    QStringList texts;
    for (const std::string& line : lines) texts << QString::fromStdString(line);
    return texts.join('\n');
}

}  // namespace

class StudyUpgradeTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_place = std::make_unique<QTemporaryDir>();
        const QString kept = VIS2HAP_SOURCE_DIR "/tests/study/kept/studies-0.5.0.tar.gz";
        QCOMPARE(QProcess::execute("tar", {"xzf", kept, "-C", m_place->path()}), 0);
    }

    void readersLeaveTheFolderAsItIs()
    {
        const StudyFolder folder = half();
        const auto before = contentOf(folder.folder);
        const StudyStore store(folder, Access::Read);
        QCOMPARE(store.answers().size(), answersOfHalf);
        QCOMPARE(joined(study::records::findingsOf(store).faults), QString());
        QCOMPARE(contentOf(folder.folder), before);
    }

    void aKilledUpgradeIsFinishedByTheNextOpening_data()
    {
        QTest::addColumn<int>("last");
        for (int step = 1; step <= stepsOfUpgrade; ++step) QTest::addRow("step %d", step) << step;
    }

    void aKilledUpgradeIsFinishedByTheNextOpening()
    {
        QFETCH(int, last);
        const StudyFolder folder = half();
        const QStringList expected = answersOf(StudyStore(folder, Access::Read));
        QCOMPARE(upgradeAndDie(folder, last), 9);
        {
            const StudyStore reader(folder, Access::Read);
            QCOMPARE(answersOf(reader), expected);
            // Where the new database is in its place, the folder waits for the rest.
            const QString faults = joined(study::records::findingsOf(reader).faults);
            const bool waits = !isOlder(folder) && hasUnfinishedUpgrade(folder);
            QVERIFY2(
                waits ? faults.startsWith(".upgrade: an upgrade was interrupted") && !faults.contains("\n") : faults.isEmpty(),
                qPrintable(faults));
        }
        const StudyStore store(folder, Access::Write);
        QCOMPARE(answersOf(store), expected);
        QCOMPARE(joined(study::records::findingsOf(store).faults), QString());
        QVERIFY(!fs::exists(folder.upgrade()) && !fs::exists(folder.maskedKey()) && !isOlder(folder));
        for (const auto& entry : fs::directory_iterator(folder.stimuli()))
            QCOMPARE(entry.path().extension(), fs::path(".sealed"));
        const StudyStore asItWas({folder.beforeUpgrade()}, Access::Read);
        QCOMPARE(answersOf(asItWas), expected);
    }

    void theListOfStepsIsWhole() { QCOMPARE(upgradeAndDie(half(), stepsOfUpgrade + 1), 0); }

    void whatAKilledPreparationLeftIsRemoved()
    {
        const StudyFolder folder = half();
        fs::create_directories(folder.upgrade() / "stimuli");
        QFile(QString::fromStdString((folder.upgrade() / "study.db").string())).open(QIODevice::WriteOnly);
        const StudyStore store(folder, Access::Write);
        QCOMPARE(store.answers().size(), answersOfHalf);
        QVERIFY(!fs::exists(folder.upgrade()));
    }

    void noOldFileCodeIsLeft()
    {
        const StudyFolder folder = half();
        std::vector<QByteArray> codes;
        for (const auto& entry : fs::directory_iterator(folder.stimuli()))
            codes.push_back(QByteArray::fromStdString(entry.path().stem().string()));
        QCOMPARE(codes.size(), 10u);
        StudyStore(folder, Access::Write).facts();
        fs::remove_all(folder.beforeUpgrade());
        const auto content = contentOf(folder.folder);
        for (auto file = content.begin(); file != content.end(); ++file)
            for (const QByteArray& code : codes)
                QVERIFY2(!file.key().contains(QString(code)) && !file.value().contains(code), qPrintable(file.key()));
    }

    void whatWasWrongBeforeIsStillFound()
    {
        const StudyFolder folder = half();
        {
            RawSqlite raw(folder.database());
            raw.dropTriggers();
            QCOMPARE(raw.run("UPDATE responses SET answered_at = answered_at + 1 WHERE id = 3"), std::string());
        }
        const StudyStore store(folder, Access::Write);
        const QString faults = joined(store.faults());
        QVERIFY2(faults.contains("before the upgrade: log entry") && faults.contains("the entry or its rows were altered"),
                 qPrintable(faults));
        QCOMPARE(store.faults().size(), 1u);
    }

    /// The older log only names facts, so the upgrade's entry says what they were.
    void factsOfOlderStudiesAreProtectedFromTheUpgradeOn()
    {
        const StudyFolder folder = at("finished");
        const auto change = [&](const std::string& sql) {
            RawSqlite raw(folder.database());
            QCOMPARE(raw.run(sql), std::string());
        };
        const auto faults = [&] { return joined(StudyStore(folder, Access::Read).faults()); };
        change("DELETE FROM participant_facts");
        change("INSERT INTO participant_facts(participant, fact, value) VALUES ('S01', 'debriefing', 'a good study')");
        QCOMPARE(joined(StudyStore(folder, Access::Write).faults()), QString());
        change("UPDATE participant_facts SET value = 'a bad study'");
        QCOMPARE(faults(), QString("the fact \"debriefing\" of participant S01 was altered"));
        change("DELETE FROM participant_facts; INSERT INTO participant_facts VALUES ('S02', 'debriefing', 'I knew', '')");
        const QString found = faults();
        QVERIFY2(found.contains("the fact \"debriefing\" of participant S02 is not in the log") &&
                     found.contains("the fact \"debriefing\" of participant S01 is missing"),
                 qPrintable(found));
    }

    /// Every copy of an older study is chained anew, so that two of them never have one head.
    void anOlderStudyGivesOutNoHead()
    {
        const StudyFolder folder = half();
        const StudyStore reader(folder, Access::Read);
        QVERIFY(!reader.hasLastingHead());
        QCOMPARE(reader.namedFolder(), folder.folder);
        QCOMPARE(study::records::headTextOf(reader), std::string("none before the upgrade of the study"));
        QVERIFY(tests::support::errorOf([&] { study::records::requireLastingHead(reader); }).contains("has no head that lasts"));
        const StudyStore upgraded(folder, Access::Write);
        QVERIFY(upgraded.hasLastingHead());
        QCOMPARE(study::records::headTextOf(upgraded), textOf(upgraded.head()));
    }

    /// A link would bring a file from elsewhere into the copies, from which the upgraded study is read.
    void filesBehindLinksAreNotCopied()
    {
        const StudyFolder folder = half();
        const fs::path elsewhere = m_place->filePath("elsewhere.txt").toStdString();
        protocols::writeWholeFile(elsewhere, "of somebody else");
        fs::create_symlink(elsewhere, folder.folder / "linked.txt");
        const StudyStore reader(folder, Access::Read);
        QVERIFY(!fs::exists(fs::symlink_status(reader.folder().folder / "linked.txt")));
        const StudyStore upgraded(folder, Access::Write);
        QVERIFY(fs::is_symlink(folder.folder / "linked.txt"));
        QVERIFY(!fs::exists(fs::symlink_status(folder.beforeUpgrade() / "linked.txt")));
    }

    void anErasureNamesTheCopyThatStillHoldsTheAnswers()
    {
        StudyStore store(half(), Access::Write);
        store.enrol(protocols::ParticipantId("S04"), ParticipantKind::Scripted);
        QCOMPARE(store.erase({protocols::ParticipantId("S03"), true, "Ada", "wish", {}}).found,
                 std::vector<std::string>{"before-upgrade/study.db"});
        QCOMPARE(store.erase({protocols::ParticipantId("S04"), true, "Ada", "wish", {}}).found, std::vector<std::string>());
        QVERIFY2(store.faults().empty(), qPrintable(joined(store.faults())));
    }

    void anOlderErasureStaysOneAndAFalseOneIsFound_data()
    {
        QTest::addColumn<bool>("recorded");
        QTest::newRow("recorded") << true;
        QTest::newRow("without an entry") << false;
    }

    void anOlderErasureStaysOneAndAFalseOneIsFound()
    {
        QFETCH(bool, recorded);
        const StudyFolder folder = half();
        {
            RawSqlite raw(folder.database());
            raw.dropTriggers();
            QCOMPARE(raw.run(removedBy050), std::string());
            if (recorded) QCOMPARE(raw.run(entryOfErasure(raw)), std::string());
        }
        const StudyStore store(folder, Access::Write);
        QVERIFY(store.answers().empty());
        QCOMPARE(store.erasures().size(), recorded ? 1u : 0u);
        QVERIFY2(store.faults().empty() == recorded, qPrintable(joined(store.faults())));
    }

    void aStudyWithAnotherKeyIsNotUpgraded()
    {
        const StudyFolder folder = half();
        fs::copy_file(at("finished").allocationKey(), folder.allocationKey(), fs::copy_options::overwrite_existing);
        QVERIFY_EXCEPTION_THROWN(StudyStore(folder, Access::Write), protocols::Error);
        QCOMPARE(RawSqlite(folder.database()).rows("PRAGMA user_version"), std::vector<std::string>{"2"});
        QVERIFY(fs::exists(folder.maskedKey()) && !fs::exists(folder.beforeUpgrade()));
    }

    void aDamagedStudyIsRefusedAndLeavesNoOpenCopy_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        QTest::newRow("slot") << "UPDATE slots SET number = 4000000000000000000 WHERE number = 1"
                              << "a slot has the number";
        QTest::newRow("slot of a trial") << "UPDATE trials SET slot = 4000000000000000000 WHERE slot = 1 AND number = 1"
                                         << "a trial belongs to slot 4000000000000000000";
        QTest::newRow("stimulus of a trial") << "UPDATE trials SET file_code = 'other' WHERE slot = 1 AND number = 1"
                                             << "a trial shows stimulus other, which the study does not have";
        QTest::newRow("code of a piece") << "INSERT INTO swatches VALUES (0, 'F01', '100')"
                                         << "stands in slot 0";
    }

    void aDamagedStudyIsRefusedAndLeavesNoOpenCopy()
    {
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const StudyFolder folder = half();
        alter(folder, sql);
        for (const Access access : {Access::Write, Access::Write, Access::Read}) {
            const QString error = tests::support::errorOf([&] { StudyStore(folder, access); });
            QVERIFY2(error.contains(said), qPrintable(error));
        }
        for (const auto& entry : fs::directory_iterator(folder.folder))
            QVERIFY2(!entry.path().filename().string().starts_with("before-upgrade"), entry.path().c_str());
        QVERIFY(fs::exists(folder.maskedKey()));
    }

    void alteredPayloadsAreNamedByTheUpgradedStudy()
    {
        for (const char* payload : {R"({"schema":"x","fixed_sha256":5})", R"({"schema":[]})", "[]", ""}) {
            init();
            const StudyFolder folder = half();
            alter(folder, QString("UPDATE events SET payload = '%1' WHERE sequence = 1").arg(payload));
            alter(folder,
                  R"(UPDATE events SET kind = 'erased', participant = '', payload = '{"answers_too":7,"participant":[]}' )"
                  "WHERE sequence = (SELECT MAX(sequence) FROM events)");
            const QString faults = joined(StudyStore(folder, Access::Write).faults());
            QVERIFY2(faults.contains("were altered after the study was made"), qPrintable(faults));
        }
    }

    void aReaderOfTheOlderFileIsWaitedForAndThenNamed()
    {
        const StudyFolder folder = half();
        RawSqlite reader(folder.database());
        QCOMPARE(reader.run("BEGIN"), std::string());
        QCOMPARE(reader.rows("SELECT COUNT(*) FROM study"), std::vector<std::string>{"1"});
        QVERIFY_EXCEPTION_THROWN(StudyStore(folder, Access::Write), protocols::Error);
        QVERIFY(!fs::exists(folder.beforeUpgrade()));  // it lies open, and the study is not upgraded
        QCOMPARE(reader.run("COMMIT"), std::string());
        QCOMPARE(reader.rows("PRAGMA user_version"), std::vector<std::string>{"2"});
    }

private:
    StudyFolder at(const char* name) const { return {m_place->filePath(name).toStdString()}; }
    StudyFolder half() const { return at("half"); }
    std::unique_ptr<QTemporaryDir> m_place;
};

QTEST_GUILESS_MAIN(StudyUpgradeTest)
#include "study_upgrade_test.moc"
