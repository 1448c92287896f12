// A head of the log that was written down outside the study: a log written anew, cut off or put back does not hold it. And rows
// that no session writes, in a log that was chained with them.
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <array>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "database/audit.h"
#include "database/event_chain.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "study/records/evidence/exported_samples.h"
#include "study/records/evidence/signed_head.h"
#include "study/records/log_heads.h"
#include "study/records/stored_study.h"
#include "tests/study/records/meddling.h"
#include "tests/support/played_session.h"
#include "tests/support/study_builder.h"

using database::LogHead;
using database::StudyFolder;
using database::StudyStore;
using tests::meddling::faultsOf;
using tests::meddling::meddle;
using tests::meddling::reading;
using tests::support::OpenSession;

namespace {

/// Computes commitments and hashes of the whole log anew, as somebody with this program's source could.
void chainAnew(const StudyFolder& folder)
{
    std::vector<std::pair<std::int64_t, std::array<std::string, 3>>> chained;
    {
        const database::SqliteConnection sqlite(folder.database(), database::SqliteConnection::Mode::Read);
        QSqlQuery row = sqlite.run(
            "SELECT sequence, participant, sitting, kind, payload, at_ns, wall_time, places, salt FROM events ORDER BY sequence");
        std::string previous;
        while (row.next()) {
            database::LogEntry entry;
            entry.event = {row.value(0).toLongLong(),      protocols::ParticipantId(database::fromQt(row.value(1))),
                           row.value(2).toInt(),           database::fromQt(row.value(3)),
                           database::fromQt(row.value(4)), row.value(5).toLongLong(),
                           database::fromQt(row.value(6))};
            QSqlQuery answer = sqlite.run(
                QString("SELECT %1 FROM responses WHERE event = ? ORDER BY id").arg(namesOf(database::ResponseColumns::OfTable)),
                {row.value(0)});
            while (answer.next()) entry.responses.push_back(rowFrom(answer, database::ResponseColumns::OfTable, 0));
            QSqlQuery finger = sqlite.run(
                "SELECT participant, trial, attempt, began_at, count, left_out, samples FROM finger_samples WHERE event = ?",
                {row.value(0)});
            while (finger.next())
                entry.finger.push_back({database::fromQt(finger.value(0)),
                                        finger.value(1).toInt(),
                                        finger.value(2).toInt(),
                                        finger.value(3).toLongLong(),
                                        finger.value(4).toInt(),
                                        finger.value(5).toInt(),
                                        {},
                                        protocols::sha256(database::fromQt(finger.value(6)))});
            const std::string commitment = commitmentOf(entry, database::fromQt(row.value(8)));
            const std::string hash = chainHash(previous, entry.event, database::fromQt(row.value(7)), commitment);
            chained.push_back({entry.event.sequence, {commitment, previous, hash}});
            previous = hash;
        }
    }
    std::string sql;
    for (const auto& [sequence, texts] : chained)
        sql += "UPDATE events SET commitment = '" + texts[0] + "', previous_hash = '" + texts[1] + "', hash = '" + texts[2] +
               "' WHERE sequence = " + std::to_string(sequence) + ";";
    meddle(folder, sql);
}

}  // namespace

class KnownHeadTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_place;
    int m_studies = 0;

    /// S01 finished, and the display told of two samples of the finger.
    StudyFolder studyWithFinger()
    {
        const auto folder = tests::support::buildStudy(m_place.filePath(QString("finger%1").arg(++m_studies)).toStdString());
        OpenSession session(folder, "S01");
        session.stepUntil("Presenting");
        for (const double xMm : {2.0, 3.0}) {
            session.clock.advanceSeconds(0.1);
            session.driver->addFinger({std::chrono::milliseconds(2), xMm, 20.0, 0.5});
        }
        session.playToEnd();
        return folder;
    }

private Q_SLOTS:
    void aKnownHeadFindsALogWrittenAnew()
    {
        const StudyFolder folder = tests::support::buildStudy(m_place.filePath("anew").toStdString());
        LogHead early, end;
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(5);
            early = session.store.head();
            session.playToEnd();
            end = session.store.head();
        }
        for (const auto& head : {early, end, LogHead{0, early.hash}, LogHead{end.sequence, end.hash.substr(0, 16)}})
            QCOMPARE(study::records::faultAgainst(reading(folder), head), std::string());
        meddle(folder,
               "UPDATE responses SET rating_tenths = 100 WHERE rating_tenths IS NOT NULL;"
               "UPDATE events SET payload = '{\"tenths\":100}' WHERE payload LIKE '{\"tenths\":%'");
        QVERIFY(faultsOf(folder).contains("altered"));
        chainAnew(folder);
        QCOMPARE(faultsOf(folder), QString());  // nothing in the folder itself shows it
        QVERIFY(study::records::faultAgainst(reading(folder), end).find("written anew") != std::string::npos);
    }

    /// A login of a server that sends what it likes could store these. The server chains what it stores.
    void rowsThatNoSessionWritesAreFound_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        const auto told = "the answer in the table is not the one that the entry tells";
        QTest::newRow("another rating") << "UPDATE responses SET rating_tenths = (rating_tenths + 30) % 100" << told;
        QTest::newRow("another choice")
            << "UPDATE responses SET choice = json_extract(alternatives, CASE choice WHEN json_extract(alternatives, '$[0]') "
               "THEN '$[1]' ELSE '$[0]' END) WHERE choice IS NOT NULL"
            << told;
        QTest::newRow("a rating that is told twice")
            << "UPDATE events SET payload = replace(payload, '}', ',\"tenths\":33}') WHERE payload LIKE '{\"tenths\":%'" << told;
        QTest::newRow("a choice told as words")
            << "UPDATE events SET payload = replace(payload, '\"fabric\"', '\"words\"') WHERE payload LIKE '{\"fabric\":%'"
            << told;
        QTest::newRow("text after the end") << "UPDATE events SET payload = payload || 'x' WHERE payload LIKE '{\"tenths\":%'"
                                            << told;
        QTest::newRow("too deep for a session")
            << "UPDATE events SET payload = replace(payload, '}', ',\"x\":' || replace(hex(zeroblob(101)), '00', '[') || "
               "replace(hex(zeroblob(101)), '00', ']') || '}') WHERE payload LIKE '{\"tenths\":%'"
            << told;
        QTest::newRow("an answer of another kind") << "UPDATE events SET kind = 'paused' WHERE kind = 'answered'" << told;
        const auto stamps = "the stamps are not those of one clock";
        QTest::newRow("answered before ready") << "UPDATE responses SET answered_at = ready_at - 1" << stamps;
        QTest::newRow("touched before ready") << "UPDATE responses SET touched_at = ready_at - 1" << stamps;
        QTest::newRow("touch ended before it") << "UPDATE responses SET touch_ended_at = touched_at - 1" << stamps;
        QTest::newRow("begun after the answer") << "UPDATE responses SET answer_begun_at = answered_at + 1" << stamps;
        QTest::newRow("as far as numbers go")
            << "UPDATE responses SET ready_at = -9223372036854775807 - 1, answered_at = 9223372036854775807" << stamps;
        QTest::newRow("stored far away") << "UPDATE responses SET stored_at = 9223372036854775807" << stamps;
        QTest::newRow("touched by a formula") << "UPDATE responses SET touched_by = '=cmd'"
                                              << "touched_by is neither";
        QTest::newRow("begun by nobody") << "UPDATE responses SET answer_begun_by = 'x'"
                                         << "answer_begun_by is none of";
        QTest::newRow("entries below 0") << "UPDATE responses SET entries = -7"
                                         << "the number of entries is below 0";
        QTest::newRow("another code") << "UPDATE responses SET presentation_code = char(27) || '[2J'"
                                      << "stands under a code that the presentation does not have";
        QTest::newRow("sitting below 0") << "UPDATE events SET sitting = -9 WHERE kind = 'touched'"
                                         << "the number of the sitting is below 0";
        QTest::newRow("a time that colours")
            << "UPDATE events SET wall_time = wall_time || char(27) || '[31m' WHERE kind = 'touched'"
            << "wall_time is no line";
        QTest::newRow("a time far away") << "UPDATE events SET at_ns = 9223372036854775807 WHERE kind = 'touched'"
                                         << "at_ns is no time of a clock";
        QTest::newRow("a dash for samples") << "UPDATE finger_samples SET samples = '-'"
                                            << "the samples cannot be read";
        QTest::newRow("more samples") << "UPDATE finger_samples SET count = 77"
                                      << "count is 77, and there are 2 samples";
        QTest::newRow("fewer than none left out") << "UPDATE finger_samples SET left_out = -1"
                                                  << "left_out is below 0";
    }
    void rowsThatNoSessionWritesAreFound()
    {
        QFETCH(QString, sql);
        QFETCH(QString, said);
        const StudyFolder folder = studyWithFinger();
        QCOMPARE(faultsOf(folder), QString());
        meddle(folder, sql.toStdString());
        chainAnew(folder);
        const QString faults = faultsOf(folder);
        QVERIFY2(faults.contains(said), qPrintable(faults));
        QVERIFY2(!faults.contains("were altered"), qPrintable(faults));
        if (sql.contains("'paused'")) return;  // The states that the log tells are others, too.
        // The study can still be moved back from a server, and be rescued.
        const auto ofCopy = database::faultsOfCopy({folder.database(), database::SqliteConnection::Mode::Read});
        QVERIFY2(ofCopy.empty(), ofCopy.empty() ? "" : ofCopy.front().c_str());
    }

    void aReportSurvivesDamagedSamplesOfTheFinger()
    {
        const StudyFolder folder = studyWithFinger();
        const auto stampsNow = [&] {
            const auto data = study::records::studyData(reading(folder), {});
            QString text;
            for (const auto& stamp : data->stamps) text += QString::fromStdString(stamp) + "\n";
            return text;
        };
        QVERIFY(!stampsNow().contains("of the finger are damaged"));
        QCOMPARE(study::records::studyData(reading(folder), {})->touches.size(), std::size_t{1});
        meddle(folder, "UPDATE finger_samples SET samples = '-'");
        QVERIFY2(stampsNow().contains("The stored samples of the finger are damaged in 1 presentation:"),
                 qPrintable(stampsNow()));
        QVERIFY(study::records::studyData(reading(folder), {})->touches.empty());
        const std::string csv = study::records::fingerSamplesCsv(reading(folder), {}, std::nullopt);
        QVERIFY2(csv.ends_with(",1,0,,,,\n") || csv.ends_with(",1,0,,,,\r\n"), csv.c_str());
    }

    void aKnownHeadFindsEntriesThatWereCutOff()
    {
        const StudyFolder folder = tests::support::buildStudy(m_place.filePath("cut").toStdString());
        OpenSession(folder, "S01").playToEnd();
        const LogHead end = reading(folder).head();
        const std::string last = std::to_string(end.sequence - 50);
        meddle(folder, "DELETE FROM responses WHERE event > " + last + "; DELETE FROM events WHERE sequence > " + last +
                           "; UPDATE sqlite_sequence SET seq = " + last +
                           " WHERE name = 'events'; DELETE FROM participant_facts; UPDATE participants SET state = 'started'");
        QCOMPARE(faultsOf(folder), QString());
        QVERIFY(study::records::faultAgainst(reading(folder), end).find("entries were cut off") != std::string::npos);
        QVERIFY(!study::records::faultAgainst(reading(folder), {0, end.hash}).empty());
    }

    void aKnownHeadFindsAnOlderDatabase()
    {
        const StudyFolder folder = tests::support::buildStudy(m_place.filePath("older").toStdString());
        OpenSession(folder, "S01").playUntilAnswers(4);
        const std::string older = protocols::readWholeFile(folder.database());
        OpenSession(folder, "S01").playToEnd();
        const LogHead end = reading(folder).head();
        std::ofstream(folder.database(), std::ios::binary | std::ios::trunc) << older;
        QCOMPARE(faultsOf(folder), QString());
        QVERIFY(study::records::faultAgainst(reading(folder), end).find("an earlier database was put back") != std::string::npos);
    }

    void headsOutliveAnErasure()
    {
        const StudyFolder folder = tests::support::buildStudy(m_place.filePath("erased").toStdString());
        OpenSession(folder, "S01").playToEnd();
        const LogHead before = reading(folder).head();
        StudyStore(folder, StudyStore::Access::Write).erase({protocols::ParticipantId("S01"), true, "Ada", "asked for it", {}});
        QCOMPARE(faultsOf(folder), QString());
        QCOMPARE(study::records::faultAgainst(reading(folder), before), std::string());
    }

    void headsAreReadFromFiles()
    {
        const LogHead head{12, std::string(64, 'a')};
        using Heads = std::vector<LogHead>;
        QVERIFY(study::records::headsIn(textOf(head)).heads == Heads{head});
        QVERIFY(study::records::headsIn(head.hash).heads == (Heads{{0, head.hash}}));
        const LogHead shortHead{12, std::string(database::shortHeadLength, 'a')};
        QVERIFY(study::records::headsIn(shortTextOf(head)).heads == Heads{shortHead});
        QVERIFY_EXCEPTION_THROWN(study::records::headsIn(shortTextOf(head).substr(0, 18)), protocols::Error);
        const std::string file = m_place.filePath("heads.txt").toStdString();
        const std::string other = "7:" + std::string(64, 'b');
        std::ofstream(file) << "{\"log_head\":\"" << textOf(head) << "\",\"sha256\":\"" << head.hash
                            << "\",\"x\":\"sha256:" << head.hash << "\"} again " << textOf(head) << ", " << other << "c " << other
                            << "\n";
        QVERIFY(study::records::headsIn(file).heads == (Heads{head, {7, std::string(64, 'b')}}));
        std::ofstream(file) << "nothing";
        QVERIFY_EXCEPTION_THROWN(study::records::headsIn(file), protocols::Error);
        QVERIFY_EXCEPTION_THROWN(study::records::headsIn("no such file"), protocols::Error);
    }

    /// Each unknown head was compared with all others, and the acts were read for it anew.
    void thousandsOfUnknownHeadsAreComparedAtOnce()
    {
        const StudyFolder folder = tests::support::buildStudy(m_place.filePath("many").toStdString());
        constexpr int count = 30'000;
        const std::string file = m_place.filePath("many.txt").toStdString();
        {
            std::ofstream heads(file);
            for (int i = 0; i < 2 * count; ++i)
                heads << i % count + 1 << ":" << std::string(64 - std::to_string(i % count).size(), 'a') << i % count << "\n";
        }
        QElapsedTimer clock;
        clock.start();
        const auto given = study::records::headsIn(file);
        const StudyStore store(folder, StudyStore::Access::Read);
        study::records::HeadCheck check(store);
        for (const LogHead& head : given.heads) QVERIFY(!check.faultOf(head).empty());
        QVERIFY2(clock.elapsed() < 10'000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
        QCOMPARE(given.heads.size(), std::size_t{count});
    }

    /// The line ends were removed one by one, each with a copy of the rest: 4 MB took minutes.
    void aLongFileWithLineEndsOfWindowsIsReadAtOnce()
    {
        std::string text = "notes of the lab\r\n";
        for (int i = 0; i < 2'000'000; ++i) text += "\r\n";
        QElapsedTimer clock;
        clock.start();
        QVERIFY(!study::records::signedHeadIn(text, "notes.txt"));
        QVERIFY2(clock.elapsed() < 5000, qPrintable(QString("%1 ms").arg(clock.elapsed())));
    }

    /// In a notebook: capital letters and blanks are read; a missing digit is named; times and words are neither.
    void headsAreCopiedByHand()
    {
        using Heads = std::vector<LogHead>;
        const LogHead head{154, "f35b9b1ea1e528f0"};
        for (const char* text : {"154:F35B9B1EA1E528F0", "154: f35b9b1ea1e528f0", "154:\tF35b9b1EA1E528F0"})
            QVERIFY2(study::records::headsIn(text).heads == Heads{head}, text);
        const std::string file = m_place.filePath("notebook.txt").toStdString();
        std::ofstream(file)
            << "14:03:11 head 154: F35B9B1EA1E528F0\n-155:f35b9b1ea1e528f0\nstep 3: participants1 were here, 12:20261128T0102 "
               "too\n"
               "SHA-256: 5c0fa1b2c3d4e5f65c0fa1b2c3d4e5f65c0fa1b2c3d4e5f65c0fa1b2c3d4e5f6, fe80:1:8080a1b2c3d4e5\n"
               "7:abcdef01\n8: f35b9b1ea1e528fO\n9:f35b9b1ea1e528\n10: 12345678\n";
        const auto given = study::records::headsIn(file);
        QVERIFY(given.heads == (Heads{head, {155, head.hash}}));
        QVERIFY(given.unread == (std::vector<std::string>{"7:abcdef01", "8: f35b9b1ea1e528fO", "9:f35b9b1ea1e528"}));
    }
};

QTEST_GUILESS_MAIN(KnownHeadTest)
#include "known_head_test.moc"
