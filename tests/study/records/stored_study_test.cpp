// The answers of a stored study as the report gets them.
#include "study/records/stored_study.h"

#include <QTemporaryDir>
#include <QTest>
#include <map>

#include "protocols/files/whole_file.h"
#include "study/records/blinded_report.h"
#include "study/session/driver.h"
#include "study/session/stimuli.h"
#include "tests/support/played_session.h"
#include "tests/support/study_builder.h"

using tests::support::OpenSession;

class StoredStudyTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// Twelve presentations; the second is voided after its answer and takes its time all the same. The session is opened twice.
    void answersCarryTheirPlaceAndSitting()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString());
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(2);
            session.send(study::session::Voided{"wrong swatch"});
            session.playUntilAnswers(3);
        }
        OpenSession session(folder, "S01");
        session.playToEnd();
        const reports::StudyData data = *study::records::studyData(session.store, {});
        QCOMPARE(data.responses.size(), std::size_t(24));
        std::map<int, std::size_t> answersAt;
        std::map<std::string, std::map<int, int>> sittings;
        for (const reports::StudyResponse& response : data.responses) {
            ++answersAt[response.trial.value()];
            ++sittings[response.question][response.sitting.value()];
        }
        // Place 2 is that of the voided presentation; then six matches in all, and six presentations with three ratings each.
        const std::map<int, std::size_t> expected{{1, 1}, {3, 1}, {4, 1},  {5, 1},  {6, 1},  {7, 1},
                                                  {8, 3}, {9, 3}, {10, 3}, {11, 3}, {12, 3}, {13, 3}};
        QCOMPARE(answersAt, expected);
        QCOMPARE(sittings["Q1"][1] + sittings["Q1"][2], 6);
        QVERIFY(sittings["Q1"][1] >= 2 && sittings["Q1"][2] >= 3);
        QCOMPARE(sittings["Q2"], (std::map<int, int>{{2, 6}}));
    }

    void aBlindedReportHasTheHeadOfTheLogAndNoEmptyTable()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString());
        const database::StudyStore store(folder, database::StudyStore::Access::Read);
        const std::filesystem::path report = place.filePath("report").toStdString();
        reports::writeProgressReport(study::records::blindedReport(store), report);
        const std::string page = protocols::readWholeFile(report / "index.html");
        QVERIFY(page.find("Head of the log: " + textOf(store.head())) != std::string::npos);
        QVERIFY(page.find("The data have no flags.") != std::string::npos && page.find("Flags on the data") == std::string::npos);
        QCOMPARE(protocols::readWholeFile(report / "tables/flags.csv"), "participant,flag,reason\r\n");
    }

    void sittingsWithoutADisplayAreStated()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString(), {.participants = 3});
        const study::session::OperatedBy ada{"Ada", "vis2hap", "lab", false};
        const auto stampsNow = [&] {
            const database::StudyStore store(folder, database::StudyStore::Access::Read);
            return study::records::stampsOf(store, store.facts());
        };
        const auto play = [&](const char* participant, database::ParticipantKind kind, rendering::HapticDisplay& display) {
            database::StudyStore store(folder, database::StudyStore::Access::Write);
            rendering::StimulusBank bank(study::session::stimuliOf(store));
            study::session::VirtualClock clock;
            const study::session::Driver driver(store, protocols::ParticipantId(participant), kind, bank, display, clock, ada);
        };
        const auto none = rendering::openDisplay("none");
        const auto there = rendering::openDisplay("folder:" + place.filePath("shown").toStdString());
        const auto before = stampsNow();
        play("S01", database::ParticipantKind::Scripted, *none);
        play("P02", database::ParticipantKind::Human, *there);
        QCOMPARE(stampsNow(), before);
        play("P03", database::ParticipantKind::Human, *none);
        QCOMPARE(stampsNow().size(), before.size() + 1);
        QVERIFY(stampsNow().back().starts_with("1 sitting ran without a display:"));
        play("P03", database::ParticipantKind::Human, *none);
        play("P03", database::ParticipantKind::Human, *there);
        QVERIFY(stampsNow().back().starts_with("2 sittings ran without a display:"));
        const database::StudyStore store(folder, database::StudyStore::Access::Read);
        const std::string last = store.events(protocols::ParticipantId("P03")).back().payloadJson;
        QVERIFY2(last.find("\"display\":\"folder:") != std::string::npos, last.c_str());
    }

    void imagesThatLayOpenAreStated()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString());
        const auto kind = database::ParticipantKind::Scripted;
        OpenSession(folder, "S01", kind, {"Ada", "vis2hap", "lab", false}).playUntilAnswers(1);
        const database::StudyStore before(folder, database::StudyStore::Access::Read);
        QCOMPARE(study::records::stampsOf(before, before.facts()), before.facts().stamps);
        OpenSession(folder, "S01", kind, {"Ada", "vis2hap", "lab", true}).playUntilAnswers(2);
        const database::StudyStore store(folder, database::StudyStore::Access::Read);
        const auto stamps = study::records::sealedStudyData(store).stamps;
        QCOMPARE(stamps.size(), store.facts().stamps.size() + 2);
        QVERIFY(stamps.back().starts_with("The response of the display was not measured"));
        QVERIFY(
            stamps[stamps.size() - 2].starts_with("The display left its images as plain files in sessions of 1 participant "));
    }
};

QTEST_GUILESS_MAIN(StoredStudyTest)
#include "stored_study_test.moc"
