// The study database: who can open it, what the view shows, what verify finds.
#include "database/study_store.h"

#include <sys/stat.h>
#include <unistd.h>

#include <QCoreApplication>
#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <fstream>

#include "database/disk/finger_text.h"
#include "database/evidence/finger_records.h"
#include "database/evidence/operator_latency.h"
#include "protocols/files/errors.h"
#include "study/records/stored_study.h"
#include "study/records/study_faults.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace database;
using namespace tests::support;
using Access = StudyStore::Access;

namespace {

constexpr std::int64_t oneSecondNs = 1000000000;
const protocols::ParticipantId s01("S01");

QString childProgram() { return QCoreApplication::applicationDirPath() + "/session_child"; }

/// The last event of a session.
StudyStore::Append endOf(const protocols::ParticipantId& participant, const char* kind, SlotState state)
{
    StudyStore::Append entry;
    entry.event = {0, participant, 1, kind, "{}", 20 * oneSecondNs, "2026-01-01T10:00:10.000Z"};
    entry.slotState = state;
    return entry;
}

/// One answer to the first trial, at 10 s after a touch at 8 s.
StudyStore::Append answerOf(const StudyStore& store, const char* question, std::optional<int> tenths)
{
    const protocols::BlindedTrial trial = store.trials(1).front();
    StudyStore::Append entry;
    entry.event = {0, s01, 1, "answered", "{}", 10 * oneSecondNs, "2026-01-01T10:00:00.000Z"};
    AnswerRecord answer;
    answer.trial = trial.number;
    answer.question = protocols::QuestionId(question);
    answer.presentationCode = trial.presentationCode;
    answer.alternatives = trial.alternatives;
    if (tenths)
        answer.rating = protocols::Tenths{*tenths};
    else
        answer.answer = trial.alternatives.front().value;
    answer.readyAtNs = 5 * oneSecondNs;
    answer.touchedAtNs = 8 * oneSecondNs;
    answer.touchEndedAtNs = 9 * oneSecondNs;
    answer.answerBegunAtNs = 9500000000;
    answer.answerBegunBy = "entry";
    answer.entries = 2;
    answer.answeredAtNs = 10 * oneSecondNs;
    entry.answers.push_back(answer);
    entry.event.payloadJson = tenths ? "{\"tenths\":" + std::to_string(*tenths) + "}" : "{\"fabric\":\"" + *answer.answer + "\"}";
    entry.storedAtNs = 10 * oneSecondNs + 100;
    return entry;
}

}  // namespace

class StudyStoreTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    std::filesystem::path newPath() { return m_place.filePath(QString("study%1").arg(++m_studies)).toStdString(); }
    StudyFolder newStudy() { return buildStudy(newPath()); }

private Q_SLOTS:
    void whatWasFixedReadsBack()
    {
        const StudyFolder folder = newStudy();
        const StudyStore store(folder, Access::Read);
        const StudyFacts facts = store.facts();
        QCOMPARE(facts.name, std::string("Small study"));
        QCOMPARE(facts.protocolJson, protocolText({}));
        QCOMPARE(facts.designSeed, 1u);
        QCOMPARE(facts.fabricNames.at(protocols::FabricId("F02")), std::string("fabric 02"));
        QVERIFY(facts.datasetProcedural);
        QCOMPARE(store.stimulusHashes().size(), 6u);
        QCOMPARE(store.slots().size(), 2u);
        QCOMPARE(store.trials(2).size(), 12u);
        QCOMPARE(store.trials(2).front().alternatives.size(), 3u);
        QVERIFY(store.faults().empty());
        for (const char* left : {"study.db-wal", "study.db.partial"})
            QVERIFY2(!std::filesystem::exists(folder.folder / "study.db.partial"), left);
    }

    void aStudyIsNotMadeTwice()
    {
        const StudyFolder folder = newStudy();
        const StudyFacts facts = StudyStore(folder, Access::Read).facts();
        QVERIFY(errorOf([&] { StudyStore::create(folder, facts, {}, {}); }).startsWith("2:"));
        QCOMPARE(StudyStore(folder, Access::Read).slots().size(), 2u);
    }

    /// Under another name the same file has another lock and another write-ahead log: answers of one of them would vanish.
    void aDatabaseWithTwoNamesIsNotWritten()
    {
        namespace fs = std::filesystem;
        const StudyFolder folder = newStudy();
        const fs::path other = folder.folder.string() + "-other.db";
        fs::create_hard_link(folder.database(), other);
        QVERIFY(errorOf([&] { StudyStore(folder, Access::Write); }).contains("hard link"));
        QCOMPARE(StudyStore(folder, Access::Read).slots().size(), 2u);
        const auto faults = study::records::findingsOf(StudyStore(folder, Access::Read)).faults;
        QVERIFY(std::ranges::any_of(faults, [](const auto& fault) { return fault.starts_with("study.db: is the same file"); }));
        fs::remove(folder.database());
        fs::create_symlink(other, folder.database());
        for (const auto access : {Access::Read, Access::Write})
            QVERIFY(errorOf([&] { StudyStore(folder, access); }).contains("is a link to another file"));
    }

    /// The main fact about blinding stands in every report.
    void whatCameAfterTheUnblindingIsCounted()
    {
        const StudyFolder folder = newStudy();
        OpenSession(folder, "S01").playUntilAnswers(2);
        {
            StudyStore store(folder, Access::Write);
            store.recordUnblinding({"Ada", "all answers are there", {}});
            QCOMPARE(study::records::afterUnblindingSentence(store), std::string());
        }
        OpenSession(folder, "S01").playUntilAnswers(4);
        StudyStore store(folder, Access::Write);
        store.erase({protocols::ParticipantId("S01"), false, "Ada", "wish", {}});
        const std::string said = "After the unblinding came 2 answers and 1 erasure: who knew the conditions could steer them.";
        QCOMPARE(study::records::afterUnblindingSentence(store), said);
        const auto stamps = study::records::stampsOf(store, store.facts());
        QVERIFY(std::ranges::find(stamps, said) != stamps.end());
    }

    void whatIsNoStudyIsRefused_data()
    {
        QTest::addColumn<QString>("content");
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        QTest::newRow("no study.db") << QString() << QString() << "no study folder";
        QTest::newRow("a text") << "not a database, but long enough to be looked at" << QString() << "no SQLite database";
        QTest::newRow("an empty file") << "" << QString() << "belongs to another program";
        QTest::newRow("another program's") << "study"
                                           << "PRAGMA application_id = 7"
                                           << "belongs to another program";
        QTest::newRow("a newer study") << "study"
                                       << "PRAGMA user_version = 99"
                                       << "newer version of this program made the study (schema 99)";
        QTest::newRow("a development version's") << "study"
                                                 << "ALTER TABLE responses RENAME COLUMN answer_begun_at TO another"
                                                 << "development version";
        QTest::newRow("a later development version's") << "study"
                                                       << "DROP TABLE finger_samples"
                                                       << "development version";
    }

    void whatIsNoStudyIsRefused()
    {
        QFETCH(QString, content);
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const StudyFolder folder = content == "study" ? newStudy() : StudyFolder{newPath()};
        std::filesystem::create_directory(folder.folder);
        if (!sql.isEmpty())
            RawSqlite(folder.database()).run(sql.toStdString());
        else if (!content.isNull())
            std::ofstream(folder.database()) << content.toStdString();
        for (const Access access : {Access::Read, Access::Write}) {
            const QString error = errorOf([&] { StudyStore(folder, access); });
            QVERIFY2(error.startsWith("2:") && error.contains(said), qPrintable(error));
        }
    }

    void aSecondWriterIsRefusedAndALockDiesWithItsProcess()
    {
        const StudyFolder folder = newStudy();
        QProcess holder;
        holder.start(childProgram(), {"hold", QString::fromStdString(folder.folder.string())});
        QVERIFY(holder.waitForReadyRead(20000));
        QCOMPARE(holder.readLine().trimmed(), QByteArray("held"));
        const QString error = errorOf([&] { StudyStore(folder, Access::Write); });
        QVERIFY2(error.startsWith("3:") && error.contains(QString("(process %1 on ").arg(holder.processId())), qPrintable(error));
        QCOMPARE(StudyStore(folder, Access::Read).slots().size(), 2u);
        holder.kill();
        QVERIFY(holder.waitForFinished(20000));
        StudyStore writer(folder, Access::Write);
        QVERIFY(errorOf([&] { StudyStore(folder, Access::Write); }).startsWith("3:"));
    }

    void aReaderSeesWhatAWriterHasStored()
    {
        const StudyFolder folder = newStudy();
        StudyStore writer(folder, Access::Write);
        writer.enrol(s01, ParticipantKind::Scripted);
        const StudyStore reader(folder, Access::Read);
        QVERIFY(reader.answers().empty());
        writer.append(answerOf(writer, "Q1", std::nullopt));
        QCOMPARE(reader.answers().size(), 1u);
        QCOMPARE(reader.slots().front().participant, s01);
    }

    void aFolderThatCannotBeWrittenCanBeRead_data()
    {
        QTest::addColumn<bool>("closed");
        QTest::newRow("study closed") << true;
        QTest::newRow("log left by a crash") << false;
    }

    void aFolderThatCannotBeWrittenCanBeRead()
    {
        QFETCH(bool, closed);
        const StudyFolder folder = newStudy();
        auto writer = std::make_unique<StudyStore>(folder, Access::Write);
        writer->enrol(s01, ParticipantKind::Scripted);
        writer->append(answerOf(*writer, "Q1", std::nullopt));
        const StudyFolder kept{newPath()};
        if (closed) writer.reset();
        std::filesystem::copy(folder.folder, kept.folder, std::filesystem::copy_options::recursive);
        for (const char* file : {"study.db", "study.db-wal", "study.db-shm", ".lock"})
            ::chmod((kept.folder / file).c_str(), 0444);
        ::chmod(m_place.path().toLocal8Bit().constData(), 0755);
        ::chmod(kept.folder.c_str(), 0555);
        QProcess looker;
        looker.start(childProgram(), {"look", QString::fromStdString(kept.folder.string())});
        QVERIFY(looker.waitForFinished(20000));
        ::chmod(kept.folder.c_str(), 0755);
        const QString said = looker.readAllStandardOutput();
        if (said.startsWith("still root")) QSKIP("this root may not become another user, and may write everywhere");
        QVERIFY2(said.startsWith("read 1 synchronous 2\n"), qPrintable(said));
        QVERIFY2(said.contains("write exit 3 "), qPrintable(said));
    }

    void placesAreTakenInOrderAndOnce()
    {
        StudyStore store(newStudy(), Access::Write);
        QCOMPARE(store.nextParticipantId().value, std::string("P01"));
        QCOMPARE(store.enrol(protocols::ParticipantId("P01"), ParticipantKind::Human).number, 1);
        QCOMPARE(store.nextParticipantId().value, std::string("P02"));
        QCOMPARE(store.enrol(s01, ParticipantKind::Scripted).number, 2);
        QCOMPARE(store.enrol(s01, ParticipantKind::Scripted).number, 2);
        QVERIFY(errorOf([&] { store.enrol(s01, ParticipantKind::Human); }).startsWith("2:"));
        QVERIFY(errorOf([&] { store.enrol(protocols::ParticipantId(), ParticipantKind::Human); }).startsWith("2:"));
        QVERIFY(errorOf([&] {
                    store.enrol(protocols::ParticipantId("S02"), ParticipantKind::Scripted);
                }).contains("all slots of the study are taken"));
        store.append(endOf(s01, "debriefed", SlotState::Finished));
        QCOMPARE(store.slots()[1].state, SlotState::Finished);
        QVERIFY(errorOf([&] {
                    store.append(endOf(protocols::ParticipantId("nobody"), "debriefed", SlotState::Finished));
                }).startsWith("2:"));
        QCOMPARE(store.faults(), std::vector<std::string>{"participant S01 is finished without 24 answers of the list"});
    }

    /// Tables read such a code as a missing value. Whom an earlier version enrolled can go on.
    void wordsForMissingValuesEnrolNobodyNew()
    {
        const StudyFolder study = newStudy();
        {
            StudyStore store(study, Access::Write);
            for (const char* code : {"NA", "NaN", "null", "None"}) {
                const QString error = errorOf([&] { store.enrol(protocols::ParticipantId(code), ParticipantKind::Scripted); });
                QVERIFY2(error.startsWith("2:") && error.contains("it stands for a missing value in tables"), qPrintable(error));
            }
            store.enrol(s01, ParticipantKind::Scripted);
        }
        {
            RawSqlite raw(study.database());
            raw.dropTriggers();
            QCOMPARE(raw.run("UPDATE participants SET id = 'NA' WHERE id = 'S01'"), std::string());
        }
        StudyStore store(study, Access::Write);
        QCOMPARE(store.enrol(protocols::ParticipantId("NA"), ParticipantKind::Scripted).number, 1);
    }

    void whoWithdrawsFreesTheSlotForTheNext()
    {
        StudyStore store(newStudy(), Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        store.append(endOf(s01, "withdrawn", SlotState::Withdrawn));
        QCOMPARE(store.slots()[0].state, SlotState::Free);
        const protocols::ParticipantId s02("S02");
        QCOMPARE(store.enrol(s02, ParticipantKind::Scripted).number, 1);
        const auto enrolments = store.enrolments();
        QCOMPARE(enrolments.size(), 2u);
        QCOMPARE(enrolments[0].state, SlotState::Withdrawn);
        QCOMPARE(enrolments[1].participant, s02);
        using Ids = std::vector<protocols::ParticipantId>;
        QVERIFY(store.nextParticipantIds("S", 2) == (Ids{protocols::ParticipantId("S03"), protocols::ParticipantId("S04")}));
        QCOMPARE(store.enrol(s01, ParticipantKind::Scripted).state, SlotState::Withdrawn);
        QVERIFY(store.faults().empty());
    }

    void aStateThatTheLogDoesNotTellIsFound()
    {
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, Access::Write);
            store.enrol(s01, ParticipantKind::Scripted);
        }
        QCOMPARE(RawSqlite(folder.database()).run("UPDATE participants SET state = 'withdrawn'"), std::string());
        const auto faults = StudyStore(folder, Access::Read).faults();
        QCOMPARE(faults.size(), 1u);
        QCOMPARE(faults[0], std::string("participant S01 is withdrawn in the table and started in the log"));
    }

    void aChangedProtocolHoldsForParticipantsToCome()
    {
        StudyStore store(newStudy(), Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        QVERIFY(errorOf([&] { store.takeProtocol("{}", "", "why"); }).startsWith("2:"));
        store.takeProtocol("{\"changed\":true}", "Ada", "a better wording");
        store.enrol(protocols::ParticipantId("S02"), ParticipantKind::Scripted);
        QCOMPARE(store.enrolments()[0].protocolVersion, 1);
        QCOMPARE(store.enrolments()[1].protocolVersion, 2);
        const auto versions = store.protocolVersions();
        QCOMPARE(versions.size(), 2u);
        QCOMPARE(versions[1].who, std::string("Ada"));
        QCOMPARE(store.facts().protocolJson, protocolText({}));
        QVERIFY(store.faults().empty());
    }

    void erasingFactsLeavesAnswersAndTheLog()
    {
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, Access::Write);
            store.enrol(s01, ParticipantKind::Scripted);
            StudyStore::Append entry = answerOf(store, "Q1", std::nullopt);
            entry.facts = {{"age", "24 unmistakably"}};
            store.append(entry);
            QCOMPARE(store.personalFacts().at(s01).at("age"), std::string("24 unmistakably"));
            store.erase({s01, false, "Ada", "asked for it", {}});
            QVERIFY(store.personalFacts().empty());
            QCOMPARE(store.answers().size(), 1u);
            QCOMPARE(store.erasures().size(), 1u);
            QVERIFY(store.faults().empty());
        }
        for (const char* file : {"study.db", "study.db-wal"}) {
            QFile stored(QString::fromStdString((folder.folder / file).string()));
            if (stored.open(QIODevice::ReadOnly)) QVERIFY2(!stored.readAll().contains("unmistakably"), file);
        }
    }

    void samplesOfTheFingerReadBackAsTheyWere()
    {
        const std::vector<protocols::FingerSample> samples{{7 * oneSecondNs, 31.25, 20.0, 0.412},
                                                           {7 * oneSecondNs + 5000000, 31.5, {}, -0.003},
                                                           {7 * oneSecondNs + 12300000, {}, 19.99, {}},
                                                           {9 * oneSecondNs, -4.0, 0.0, 0.0}};
        QCOMPARE(fingerTextOf(samples), std::string("0,3125,2000,412;50,25,,-415;73,,-1,;19877,-3550,-1999,3"));
        QCOMPARE(fingerSamplesFrom(fingerTextOf(samples), 7 * oneSecondNs), std::optional(samples));
        QCOMPARE(fingerSamplesFrom("", 5), std::optional(std::vector<protocols::FingerSample>()));
        for (const char* damaged : {"0", "0,1,2", ",1,2,3", "0,1,2,3;", "0,1,2,3;x,1,2,3", "0,1,2,3 5,1,2,3", "-5,1,2,3",
                                    "0,99999999999999999999,2,3", "0,1,2,3,4", "0,1099511627776,,;1,1099511627776,,"})
            QVERIFY2(!fingerSamplesFrom(damaged, 0), damaged);

        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        StudyStore::Append first = answerOf(store, "Q2", 54), second = answerOf(store, "Q3", 40);
        first.finger = {first.answers[0].trial, {samples[0], samples[1]}, 3};
        second.finger = {first.answers[0].trial, {samples[2], samples[3]}, 1};
        store.append(first);
        store.append(second);
        std::vector<FingerRecord> records;
        eachFingerRecord(store, {}, [&](const FingerRecord& record) { records.push_back(record); });
        QCOMPARE(records.size(), 1u);
        QCOMPARE(records[0].samples, samples);
        QCOMPARE(records[0].leftOut, 4);
        QVERIFY(!records[0].voided && records[0].attempt == 1);
        QCOMPARE(fingerSampleCount(store, s01), 4);

        // The next sitting went on with the presentation, on a computer whose clock starts lower: its samples vanished.
        StudyStore::Append later = answerOf(store, "Q4", 30);
        const std::vector<protocols::FingerSample> restarted{{5000000, 1.0, 2.0, 0.5}, {12300000, 1.5, 2.5, 0.5}};
        later.event.sitting = 2;
        later.finger = {later.answers[0].trial, restarted, 0};
        store.append(later);
        records.clear();
        eachFingerRecord(store, {}, [&](const FingerRecord& record) { records.push_back(record); });
        QCOMPARE(records.size(), 2u);
        QVERIFY(records[0].samples == samples && records[1].samples == restarted);
        QCOMPARE(fingerSampleCount(store, protocols::ParticipantId("S02")), 0);
        QVERIFY(store.faults().empty());
        QVERIFY(RawSqlite(folder.database()).run("UPDATE finger_samples SET count = 1").find("append-only") != std::string::npos);
    }

    void alteredSamplesOfTheFingerAreFound_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::newRow("a sample") << "UPDATE finger_samples SET samples = '0,1,2,3'";
        QTest::newRow("their time") << "UPDATE finger_samples SET began_at = began_at + 1";
        QTest::newRow("their number") << "UPDATE finger_samples SET left_out = 7";
        QTest::newRow("another trial") << "UPDATE finger_samples SET trial = trial + 1";
        QTest::newRow("taken out") << "DELETE FROM finger_samples";
        QTest::newRow("put in")
            << "INSERT INTO finger_samples SELECT 77, 1, participant, trial, attempt, began_at, count, left_out, "
               "samples FROM finger_samples";
    }
    void alteredSamplesOfTheFingerAreFound()
    {
        QFETCH(QString, sql);
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, Access::Write);
            store.enrol(s01, ParticipantKind::Scripted);
            StudyStore::Append entry = answerOf(store, "Q2", 54);
            entry.finger = {entry.answers[0].trial, {{7 * oneSecondNs, 1.0, 2.0, 0.5}}, 0};
            store.append(entry);
        }
        RawSqlite raw(folder.database());
        const auto triggers = raw.rows("SELECT sql FROM sqlite_master WHERE type = 'trigger'");
        raw.dropTriggers();
        QCOMPARE(raw.run("PRAGMA foreign_keys = 0; " + sql.toStdString()), std::string());
        for (const auto& trigger : triggers) raw.run(trigger);
        const auto faults = StudyStore(folder, Access::Read).faults();
        QVERIFY(!faults.empty());
        QVERIFY2(QString::fromStdString(faults[0]).contains("were altered"), faults[0].c_str());
    }

    void erasingAnswersRemovesTheSamplesOfTheFinger()
    {
        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        StudyStore::Append entry = answerOf(store, "Q1", std::nullopt);
        entry.finger = {entry.answers[0].trial, {}, 0};
        for (int i = 0; i < 3000; ++i)  // more than a page of the file
            entry.finger->samples.push_back({(7000 + 5LL * i) * 1000000, 31.41592 * (i % 7), 27.18281 + i, 0.57721 * (i % 3)});
        const std::string text = fingerTextOf(entry.finger->samples);
        store.append(entry);
        const ErasureRecord record = store.erase({s01, true, "Ada", "asked for it", {}});
        QCOMPARE(record.fingerSamples, 3000);
        QVERIFY(record.found.empty());
        QCOMPARE(fingerSampleCount(store, s01), 0);
        QVERIFY(store.faults().empty());
        for (const char* file : {"study.db", "study.db-wal"}) {
            QFile stored(QString::fromStdString((folder.folder / file).string()));
            if (!stored.open(QIODevice::ReadOnly)) continue;
            const QByteArray bytes = stored.readAll();
            for (const std::size_t from : {std::size_t(0), std::size_t(6000), text.size() - 200})
                QVERIFY2(!bytes.contains(QByteArray::fromStdString(text.substr(from, 100))), file);
        }
    }

    void aCopyWithSamplesIsFoundByTheSearch()
    {
        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        StudyStore::Append entry = answerOf(store, "Q1", std::nullopt);
        entry.finger = {entry.answers[0].trial, {{7 * oneSecondNs, 31.41592, 27.18281, 0.57721}}, 0};
        store.append(entry);
        std::ofstream(folder.folder / "forgotten.txt") << "copied: " << fingerTextOf(entry.finger->samples);
        QCOMPARE(store.erase({s01, true, "Ada", "asked for it", {}}).found, std::vector<std::string>{"forgotten.txt"});
    }

    void latenciesOfOperatorsAreEntriesOfTheLog()
    {
        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        const OperatorLatency run{"Ada", "tone", 120, 38, 1, 2, 215.5, 190.0, 250.25, {}, 0};
        recordOperatorLatency(store, run);
        recordOperatorLatency(store, {"Bob", "flash", 120, 0, 40, 0, {}, {}, {}, {}, 0});
        const auto runs = operatorLatenciesOf(store);
        QCOMPARE(runs.size(), 2u);
        OperatorLatency expected = run;
        expected.wallTime = runs[0].wallTime;
        expected.entry = runs[0].entry;
        QVERIFY(runs[0] == expected);
        QVERIFY(!runs[0].wallTime.empty() && runs[1].entry == runs[0].entry + 1);
        QVERIFY(!runs[1].medianMs && runs[1].misses == 40);
        QVERIFY(errorOf([&] { recordOperatorLatency(store, {}); }).contains("needs the operator's name"));
        QVERIFY(store.faults().empty());
    }

    void erasingAnswersEmptiesTheEntriesAndKeepsTheChain()
    {
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, Access::Write);
            store.enrol(s01, ParticipantKind::Scripted);
            StudyStore::Append entry = answerOf(store, "Q1", std::nullopt);
            entry.note = {entry.answers[0].trial, "an unmistakable remark", false};
            store.append(entry);
            store.erase({s01, true, "Ada", "asked for it", {}});
            QVERIFY(store.answers().empty());
            QCOMPARE(store.slots()[0].state, SlotState::Free);
            QVERIFY(errorOf([&] { store.enrol(s01, ParticipantKind::Scripted); }).contains("was erased"));
            const auto faults = store.faults();
            QVERIFY2(faults.empty(), faults.empty() ? "" : faults[0].c_str());
        }
        QFile stored(QString::fromStdString(folder.database().string()));
        QVERIFY(stored.open(QIODevice::ReadOnly));
        QVERIFY(!stored.readAll().contains("unmistakable"));
        // An entry that is emptied without a recorded erasure is a fault.
        RawSqlite raw(folder.database());
        raw.dropTriggers();
        QCOMPARE(raw.run("DELETE FROM erasures"), std::string());
        QCOMPARE(raw.run("UPDATE events SET payload = '{}' WHERE kind = 'erased'"), std::string());
        QVERIFY(StudyStore(folder, Access::Read).faults().size() >= 2);
    }

    void aCopyIsWholeWhileTheStudyIsOpen()
    {
        const StudyFolder folder = newStudy();
        StudyStore writer(folder, Access::Write);
        writer.enrol(s01, ParticipantKind::Scripted);
        writer.append(answerOf(writer, "Q1", std::nullopt));
        const StudyFolder copy{newPath()};
        std::filesystem::create_directory(copy.folder);
        StudyStore(folder, Access::Read).copyTo(copy.database());
        const StudyStore copied(copy, Access::Read);
        QCOMPARE(copied.answers().size(), 1u);
        QVERIFY(copied.faults().empty());
        QVERIFY(errorOf([&] { writer.copyTo(copy.database()); }).startsWith("2:"));
    }

    void aStudyOfTheFirstVersionIsBroughtUpToDate()
    {
        const StudyFolder folder{newPath()};
        std::filesystem::create_directory(folder.folder);
        {
            QFile made(folder.database());
            QVERIFY(made.open(QIODevice::WriteOnly));
        }
        QFile dump(QFINDTESTDATA("database/study_version_1.sql"));
        QVERIFY(dump.open(QIODevice::ReadOnly));
        QCOMPARE(RawSqlite(folder.database()).run(dump.readAll().toStdString()), std::string());
        QCOMPARE(StudyStore(folder, Access::Read).answers().size(), 24u);
        QCOMPARE(RawSqlite(folder.database()).rows("PRAGMA user_version"), std::vector<std::string>{"1"});
        StudyStore store(folder, Access::Write);
        QCOMPARE(store.answers().size(), 24u);
        QVERIFY(std::filesystem::exists(folder.beforeUpgrade() / "study.db"));
        QCOMPARE(store.enrolments().size(), 1u);
        QCOMPARE(store.enrolments()[0].state, SlotState::Finished);
        const auto faults = store.faults();
        QVERIFY2(faults.empty(), faults.empty() ? "" : faults[0].c_str());
        QCOMPARE(store.enrol(protocols::ParticipantId("S02"), ParticipantKind::Scripted).number, 2);
    }

    void theViewIsAsDocumented()
    {
        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        store.append(answerOf(store, "Q1", std::nullopt));
        RawSqlite raw(folder.database());
        std::string columns;
        for (const std::string& name : raw.rows("SELECT name FROM pragma_table_info('answers')"))
            columns += (columns.empty() ? "" : ", ") + name;
        QCOMPARE(
            columns,
            std::string("participant, trial, question, presentation_code, alternatives, answer, rating, ready_at, touched_at, "
                        "answered_at, stored_at, seconds, corrections, voided, wall_time, note, touch_ended_at, "
                        "answer_begun_at, answer_begun_by, entries, response_seconds, instruction, deadline_seconds, late"));
        const auto trial = store.trials(1).front();
        const std::string expected = "S01|1|Q1|" + trial.presentationCode.value + "|[\"" + trial.alternatives[0].value + "\",\"" +
                                     trial.alternatives[1].value + "\",\"" + trial.alternatives[2].value + "\"]|" +
                                     trial.alternatives[0].value +
                                     "||5000000000|8000000000|10000000000|10000000100|2.0|0|0|2026-01-01T10:00:00.000Z||"
                                     "9000000000|9500000000|entry|2|1.5|||";
        QCOMPARE(raw.rows("SELECT * FROM answers"), std::vector<std::string>{expected});
    }

    void everyRatingInTenthsReadsBackAsItself()
    {
        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        for (int tenths = 0; tenths <= 100; ++tenths)
            store.append(answerOf(store, ("R" + std::to_string(tenths)).c_str(), tenths));
        RawSqlite raw(folder.database());
        QCOMPARE(raw.rows("SELECT rating, rating = 5.4 FROM answers WHERE question = 'R54'"), std::vector<std::string>{"5.4|1"});
        const auto answers = store.answers();
        QCOMPARE(answers.size(), 101u);
        for (int tenths = 0; tenths <= 100; ++tenths) {
            QCOMPARE(answers[static_cast<std::size_t>(tenths)].record.rating->value, tenths);
            const QByteArray literal = QByteArray::number(tenths / 10) + "." + QByteArray::number(tenths % 10);
            QCOMPARE(raw.rows("SELECT rating = " + literal.toStdString() + " FROM answers WHERE question = 'R" +
                              std::to_string(tenths) + "'"),
                     std::vector<std::string>{"1"});
        }
    }

    void anAnswerIsStoredOnceAndACorrectionKeepsTheOldOne()
    {
        const StudyFolder folder = newStudy();
        StudyStore store(folder, Access::Write);
        store.enrol(s01, ParticipantKind::Scripted);
        auto corrected = answerOf(store, "Q2", 40);
        corrected.answers.front().isCorrection = true;
        corrected.answers.front().note = "misheard";
        corrected.answers.front().answeredAtNs = 77;
        QVERIFY(errorOf([&] { store.append(corrected); }).contains("no answer to correct"));
        store.append(answerOf(store, "Q2", 54));
        QVERIFY(errorOf([&] { store.append(answerOf(store, "Q2", 55)); }).contains("stored already"));
        store.append(corrected);
        QCOMPARE(store.answers().size(), 1u);
        const CurrentAnswer now = store.answers().front();
        QCOMPARE(now.record.rating->value, 40);
        QCOMPARE(now.corrections, 1);
        QCOMPARE(now.record.note, std::string("misheard"));
        QCOMPARE(now.seconds, 2.0);
        QCOMPARE(RawSqlite(folder.database()).rows("SELECT rating_tenths FROM responses ORDER BY id"),
                 (std::vector<std::string>{"54", "40"}));
        QCOMPARE(store.events(s01).size(), 2u);
    }

    void whatIsLoggedCannotBeChanged_data()
    {
        QTest::addColumn<QString>("sql");
        for (const char* table : {"study", "fabrics", "stimuli", "slots", "trials", "events", "responses"})
            QTest::newRow(table) << QString("DELETE FROM %1").arg(table);
        QTest::newRow("a rating") << "UPDATE responses SET rating_tenths = 100";
        QTest::newRow("a hash") << "UPDATE events SET hash = 'x' || sequence";
    }

    void whatIsLoggedCannotBeChanged()
    {
        QFETCH(QString, sql);
        const StudyFolder folder = newStudy();
        {
            StudyStore store(folder, Access::Write);
            store.enrol(s01, ParticipantKind::Scripted);
            store.append(answerOf(store, "Q2", 54));
        }
        const std::string refusal = RawSqlite(folder.database()).run(sql.toStdString());
        QVERIFY2(QString::fromStdString(refusal).contains("append-only"), refusal.c_str());
    }

    void meddlingIsFound_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        QTest::newRow("a rating") << "UPDATE responses SET rating_tenths = 99 WHERE trial = 8 AND question = 'Q3'"
                                  << "(answered of S01): the entry or its rows were altered";
        QTest::newRow("a time") << "UPDATE responses SET answered_at = answered_at + 1 WHERE id = 3"
                                << "were altered";
        QTest::newRow("an answer taken out") << "DELETE FROM responses WHERE id = 5"
                                             << "were altered";
        QTest::newRow("an answer put in")
            << "INSERT INTO responses SELECT 999, event, participant, 77, attempt, question, presentation_code, alternatives, "
               "choice, "
               "rating_tenths, ready_at, touched_at, answered_at, stored_at, 0, touched_by, touch_ended_at, answer_begun_at, "
               "answer_begun_by, entries FROM responses WHERE id = 4"
            << "were altered";
        QTest::newRow("an event's payload") << "UPDATE events SET payload = '{\"fabric\":\"F99\"}' WHERE sequence = 9"
                                            << "log entry 9 (";
        QTest::newRow("an event taken out") << "PRAGMA foreign_keys = 0; DELETE FROM events WHERE sequence = 4"
                                            << "log entries from 4 to 4 are missing";
        QTest::newRow("the end cut off")
            << "DELETE FROM events WHERE sequence = (SELECT MAX(sequence) FROM events WHERE kind <> 'answered')"
               "; DELETE FROM responses WHERE event > (SELECT MAX(event) - 1 FROM responses)"
               "; DELETE FROM events WHERE sequence > (SELECT MAX(event) FROM responses)"
            << "the log ends at entry";
        QTest::newRow("a trial list") << "UPDATE trials SET sealed_code = sealed_code || '0' WHERE slot = 2"
                                      << "were altered after the study was made";
        QTest::newRow("a stimulus hash")
            << "UPDATE stimuli SET sha256 = 'aa' WHERE file_code = (SELECT MIN(file_code) FROM stimuli)"
            << "were altered after the study was made";
        QTest::newRow("a participant's place") << "UPDATE participants SET kind = 'human'"
                                               << "S01 in slot 1 (human) is not in the log";
        QTest::newRow("a void put in") << "INSERT INTO voids VALUES (12, 'S01', 1, 1)"
                                       << "were altered";
    }

    void meddlingIsFound()
    {
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const StudyFolder folder = newStudy();
        {
            OpenSession session(folder, "S01");
            session.playToEnd();
            QVERIFY(session.store.faults().empty());
        }
        {
            RawSqlite raw(folder.database());
            raw.dropTriggers();
            QCOMPARE(raw.run(sql.toStdString()), std::string());
        }
        QStringList faults;
        for (const std::string& fault : StudyStore(folder, Access::Read).faults()) faults << QString::fromStdString(fault);
        QVERIFY2(faults.join('\n').contains(said), qPrintable(faults.join('\n')));
    }
};

QTEST_GUILESS_MAIN(StudyStoreTest)
#include "study_store_test.moc"
