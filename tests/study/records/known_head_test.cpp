// A head of the log that was written down outside the study: a log written anew, cut off or put back does not hold it.
#include <QTemporaryDir>
#include <QTest>
#include <array>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "database/event_chain.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/records/log_heads.h"
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
