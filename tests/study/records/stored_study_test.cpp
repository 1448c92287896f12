// The answers of a stored study as the report gets them.
#include "study/records/stored_study.h"

#include <QTemporaryDir>
#include <QTest>
#include <map>
#include <nlohmann/json.hpp>

#include "database/evidence/acts.h"
#include "database/preregistrations.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "reports/analysis/quality_flags.h"
#include "reports/write_report.h"
#include "study/records/blinded_report.h"
#include "study/records/shown_origin.h"
#include "study/records/study_faults.h"
#include "study/records/study_status.h"
#include "study/session/driver.h"
#include "study/session/stimuli.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using tests::support::OpenSession;

namespace {

/// Runs the statements with triggers and checks out of force.
void alter(const database::StudyFolder& folder, const std::string& sql)
{
    tests::support::RawSqlite raw(folder.database());
    raw.dropTriggers();
    const std::string fault = raw.run("PRAGMA ignore_check_constraints = 1; PRAGMA foreign_keys = 0; " + sql);
    if (!fault.empty()) throw std::runtime_error(fault + ": " + sql);
}

/// Reads the study as verify, status and report do. Returns what each of them was refused with.
std::string refusalsOf(const database::StudyFolder& folder)
{
    namespace records = study::records;
    std::string refusals;
    const auto tried = [&](const auto& read) {
        try {
            read(records::openStudy(folder.folder));
        } catch (const protocols::Error& fault) {
            refusals += std::string(fault.what()) + "\n";
        }
    };
    tried([](const auto& store) { records::findingsOf(store); });
    tried([](const auto& store) { records::textOf(records::statusOf(store, {})); });
    tried([](const auto& store) { records::sealedStudyData(store); });
    tried([](const auto& store) { records::blindedReport(store); });
    tried([](const auto& store) { records::shownMadeWith(store, store.facts()); });
    tried([](const auto& store) { preregistrationsOf(store); });
    tried([](const auto& store) { chainedActsOf(store); });
    return refusals;
}

/// Places for these participants, three fabrics, three conditions: 9 choices, then 9 presentations with three ratings. The key
/// lies open, which shows as much as its passphrase.
tests::support::StudyRecipe placesFor(int participants)
{
    return {.conditions = {"v_grey", "h&f", "f"}, .participants = participants};
}

/// The fewest who give 40 answers to each question under a label.
constexpr int enough = 14;

/// Three participants: choices, then a rating and words.
constexpr const char* withWords = R"({"schema": "vis2hap.protocol/1", "name": "Words", "participants": 3,
    "fabrics": ["F01", "F02", "F03"], "conditions": ["v_grey", "h&f"], "dead_time_seconds": 0,
    "question_texts": {"Why": "Why?"}, "phases": [{"questions": ["Q1"], "alternatives": 3},
               {"questions": ["Q2", "Why"], "scale": {"min": 0, "max": 10}, "free_text": ["Why"]}]})";

/// Plays to the end as a person does: choices and ratings are typed from 0.5 s before their entry on, words are empty.
void playTyped(OpenSession& session)
{
    namespace s = study::session;
    while (true) {
        const auto* presenting = std::get_if<s::Presenting>(&session.driver->state().stage);
        if (presenting == nullptr) {
            if (!session.step()) return;
            continue;
        }
        if (presenting->question == 0) session.send(s::Touched{});
        session.clock.advanceSeconds(2);
        const s::GivenAnswer answer = tests::support::responseTo(session.driver->view());
        if (std::holds_alternative<s::Words>(answer))
            session.send(s::Answered{s::Words{}});
        else
            session.send(s::Answered{answer, {.begunAgoNs = 500'000'000}});
    }
}

/// Two participants: 7 choices, of which one comes a second time, then 8 presentations with two ratings, of which two are catch
/// trials.
constexpr const char* withExtras = R"({"schema": "vis2hap.protocol/1", "name": "Extras", "participants": 2,
    "fabrics": ["F01", "F02", "F03"], "conditions": ["v_grey", "h&f"], "dead_time_seconds": 0,
    "phases": [{"questions": ["Q1"], "alternatives": 3, "anchors": {"repeated": 1}},
               {"questions": ["Q2", "Q3"], "scale": {"min": 0, "max": 10}, "catch_trials": 2}]})";

std::string personAt(int number) { return (number < 10 ? "S0" : "S") + std::to_string(number); }

/// As many as `finished` play to the end, one more gives `answers` answers.
database::StudyFolder played(const std::filesystem::path& place, int places, int finished, int answers)
{
    const auto folder = tests::support::buildStudy(place, placesFor(places));
    for (int one = 1; one <= finished; ++one) OpenSession(folder, personAt(one)).playToEnd();
    if (answers > 0) OpenSession(folder, personAt(finished + 1)).playUntilAnswers(answers);
    return folder;
}

reports::StudyData maskedData(const database::StudyFolder& folder)
{
    return *study::records::studyData(study::records::openStudy(folder.folder), {});
}

/// The files of the report that the key makes, by their names.
std::map<std::string, std::string> reportFiles(const database::StudyFolder& folder, const std::filesystem::path& out)
{
    reports::writeReport(reports::analyse(maskedData(folder)), out);
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(out))
        if (entry.is_regular_file())
            files[entry.path().lexically_relative(out).string()] = protocols::readWholeFile(entry.path());
    return files;
}

std::set<std::string> namesOf(const std::map<std::string, std::string>& files)
{
    std::set<std::string> names;
    for (const auto& [name, text] : files) names.insert(name);
    return names;
}

/// Exact mean ratings under K-labels, of one participant and of all, that no rounded number looks like: "5.6666".
std::set<std::string> exactMeans(const reports::StudyData& data)
{
    std::map<std::tuple<std::string, std::string, std::string>, std::pair<double, int>> sums;
    for (const auto& response : data.responses)
        if (const auto* rated = std::get_if<reports::RatedAnswer>(&response.content))
            for (const std::string& participant : {response.participant, std::string("all")}) {
                auto& [sum, n] = sums[{participant, response.question, response.condition}];
                sum += rated->rating;
                ++n;
            }
    std::set<std::string> means;
    for (const auto& [of, sum] : sums)
        if (const std::string text = protocols::shortest(sum.first / sum.second); text.size() > 6)
            means.insert(text.substr(0, 6));
    return means;
}

}  // namespace

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

    /// Nobody begins to type an empty answer in words. A sitting without any stamp was run by an earlier version.
    void anEmptyAnswerTakesNoTimeFromTheOthers()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString(), {.protocol = withWords});
        {
            OpenSession session(folder, "P01");
            playTyped(session);
        }
        const reports::StudyData data = maskedData(folder);
        QVERIFY(data.times == reports::TimesTaken::ToBeginning);
        for (const reports::StudyResponse& response : data.responses) {
            const bool isInWords = std::holds_alternative<reports::WordedAnswer>(response.content);
            QVERIFY2(isInWords != response.seconds.has_value(), response.question.c_str());
            if (response.question == "Q1") QCOMPARE(*response.seconds, 1.5);
        }
        OpenSession(folder, "P02").playToEnd();
        const auto old = maskedData(folder);
        QVERIFY(old.times == reports::TimesTaken::ToEntry);
        QVERIFY(std::ranges::all_of(old.responses, [](const auto& response) { return response.seconds.has_value(); }));
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

    /// Who holds two reports and study.db learns the K-label of a trial from any number by condition that its answer changes, and
    /// from any count that it raises and an answer to a catch trial does not.
    void oneAnswerOfARunningSessionChangesNoFileOfABlindedReport()
    {
        QTemporaryDir place;
        const std::filesystem::path root = place.path().toStdString();
        const auto folder = played(root / "study", 4, 3, 15);
        const auto before = reportFiles(folder, root / "before");
        QVERIFY(!before.contains("tables/overview.csv"));
        alter(folder,
              "UPDATE responses SET rating_tenths = (rating_tenths + 50) % 101 WHERE id = (SELECT max(id) FROM responses WHERE "
              "participant = 'S04' AND rating_tenths IS NOT NULL)");
        const auto after = reportFiles(folder, root / "after");
        QCOMPARE(namesOf(after), namesOf(before));
        for (const auto& [name, text] : before) QVERIFY2(after.at(name) == text, name.c_str());
        OpenSession(folder, "S04").playUntilAnswers(16);
        const auto later = reportFiles(folder, root / "later");
        const auto withoutProgress = [](const std::string& text) {
            auto statistics = nlohmann::json::parse(text);
            for (const char* count : {"responses", "missing_responses"}) statistics["data"].erase(count);
            return statistics;
        };
        QCOMPARE(withoutProgress(later.at("statistics.json")), withoutProgress(before.at("statistics.json")));
        QCOMPARE(nlohmann::json::parse(later.at("results.json"))["questions"],
                 nlohmann::json::parse(before.at("results.json"))["questions"]);
    }

    void noFileOfABlindedReportHoldsAnExactMean()
    {
        QTemporaryDir place;
        const std::filesystem::path root = place.path().toStdString();
        const auto folder = played(root / "study", enough, enough, 0);
        const auto means = exactMeans(maskedData(folder));
        QVERIFY(means.size() > 15);
        const auto files = reportFiles(folder, root / "report");
        for (const auto& [name, text] : files)
            for (const std::string& mean : means) QVERIFY2(text.find(mean) == std::string::npos, (name + ": " + mean).c_str());
        const auto results = nlohmann::json::parse(files.at("results.json"));
        for (const auto& [label, row] : results["questions"]["Q2"].items()) {
            QCOMPARE(row["n"].get<int>(), enough * 3);
            const double tenths = row["mean"].get<double>() * 10;
            QVERIFY2(std::abs(tenths - std::round(tenths)) < 1e-9, label.c_str());
        }
        QVERIFY(results["claims"].is_null() && !results["why"]["claims"].get<std::string>().empty());
        QVERIFY(files.at("index.html").find("by condition after the unblinding.") != std::string::npos);
    }

    void aBlindedReportOfTwoFinishedParticipantsSaysWhyItHasNoMeans()
    {
        QTemporaryDir place;
        const std::filesystem::path root = place.path().toStdString();
        const auto folder = played(root / "study", 4, 2, 15);
        const auto files = reportFiles(folder, root / "report");
        const std::string why = "There are no means under K-labels yet: 2 participants have finished, and at least 3 are needed.";
        QVERIFY(files.at("index.html").find(why) != std::string::npos);
        const auto results = nlohmann::json::parse(files.at("results.json"));
        QVERIFY(results["questions"].is_null());
        QCOMPARE(results["why"]["questions"].get<std::string>(), why);
        QVERIFY(!files.contains("tables/overview.csv"));
    }

    /// Two sets of means that differ by one participant would name the labels of that participant.
    void exportedMeansWaitForTheEndOfTheLastSession()
    {
        QTemporaryDir place;
        const auto folder = played(place.filePath("study").toStdString(), enough, enough - 1, 0);
        const auto aggregates = [&] { return study::records::aggregatesOf(maskedData(folder)); };
        const std::string why = "There are no means under K-labels yet: 1 place of the study is not finished.";
        QVERIFY(aggregates().rows.empty() && aggregates().why.starts_with(why));
        {
            OpenSession session(folder, personAt(enough));
            session.stepUntil("Debriefing");
            QVERIFY(aggregates().rows.empty() && aggregates().why.starts_with(why));
            session.playToEnd();
        }
        const auto after = aggregates();
        QCOMPARE(after.why, std::string());
        QCOMPARE(after.rows.size(), std::size_t{4 * 3});
        for (const auto& row : after.rows) {
            QCOMPARE(row["n"].get<int>(), enough * 3);
            QCOMPARE(row["share"].is_null(), row["question"] != "Q1");
            QCOMPARE(row["mean"].is_null(), row["question"] == "Q1");
        }
        // Means with another person in this place would differ by one person from those above.
        OpenSession(folder, personAt(enough)).send(study::session::WithdrawnEvent{"asked for it later"});
        QVERIFY(aggregates().rows.empty() && !aggregates().why.empty());
        OpenSession replaced(folder, "replacement");
        replaced.playToEnd();
        QVERIFY(aggregates().rows.empty() && aggregates().why.starts_with(why));
    }

    /// Who is erased after the end was in the means that were given out, as somebody who withdrew was.
    void anErasureAfterTheEndLeavesNoMeans()
    {
        QTemporaryDir place;
        const auto folder = played(place.filePath("study").toStdString(), enough, enough, 0);
        const auto aggregates = [&] { return study::records::aggregatesOf(maskedData(folder)); };
        QVERIFY(!aggregates().rows.empty());
        database::StudyStore(folder, database::StudyStore::Access::Write)
            .erase({protocols::ParticipantId(personAt(enough)), true, "Ada", "asked for it", {}});
        QVERIFY(aggregates().rows.empty());
        OpenSession(folder, "replacement").playToEnd();
        QVERIFY(aggregates().rows.empty() && !aggregates().why.empty());
    }

    /// A station that sends what it likes may end a session early. Its participant counts nowhere, and `verify` names them.
    void whoIsFinishedWithoutEveryAnswerDoesNotCount()
    {
        QTemporaryDir place;
        const auto folder = played(place.filePath("study").toStdString(), 4, 3, 0);
        QCOMPARE(maskedData(folder).finished.size(), std::size_t{3});
        OpenSession(folder, "S04").playUntilAnswers(35);
        {
            database::StudyStore store(folder, database::StudyStore::Access::Write);
            QVERIFY(store.faults().empty());
            database::StudyStore::Append end;
            end.event = {0, protocols::ParticipantId("S04"), 1, "debriefed", "{}", 1, "2026-01-01T10:00:00.000Z"};
            end.slotState = database::SlotState::Finished;
            store.append(end);
            QCOMPARE(store.faults(), std::vector<std::string>{"participant S04 is finished without 1 answer of the list"});
        }
        const reports::StudyData data = maskedData(folder);
        QCOMPARE(data.finished, (std::set<std::string>{"S01", "S02", "S03"}));
        QCOMPARE(data.openPlaces, std::size_t{1});
        QCOMPARE(reports::finishedPart(data).participants.size(), std::size_t{3});
    }

    /// Answers to catch trials and repetitions count like the others, and flags are those of who has no key.
    void countsAndFlagsOfABlindedReportNeedNoKey()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString(), {.protocol = withExtras});
        constexpr int answers = 7 + 8 * 2;
        for (int given = 1; given <= answers; ++given) {
            OpenSession(folder, "S01").playUntilAnswers(given);
            const auto analysis = reports::analyse(maskedData(folder));
            QCOMPARE(analysis.completeness.present, static_cast<std::size_t>(given));
            QCOMPARE(analysis.completeness.expected, std::size_t{2 * answers});
            const auto flags = reports::qualityFlags(study::records::sealedStudyData(study::records::openStudy(folder.folder)));
            QCOMPARE(analysis.flags.size(), flags.size());
            for (std::size_t i = 0; i < flags.size(); ++i) QCOMPARE(analysis.flags[i].why, flags[i].why);
        }
    }

    /// Nobody without the key can tell catch trials and repetitions from the others. The last presentation of S01 is voided after
    /// one answer and given again; S02 lacks it.
    void flagsOfASealedStudyCountEveryPresentation()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString(), {.protocol = withExtras});
        constexpr int answers = 7 + 8 * 2;
        {
            OpenSession session(folder, "S01");
            session.playUntilAnswers(answers - 1);
            session.send(study::session::Voided{"wrong swatch"});
            session.playToEnd();
        }
        OpenSession(folder, "S02").playUntilAnswers(answers - 2);
        const database::StudyStore store(folder, database::StudyStore::Access::Read);
        const reports::StudyData data = study::records::sealedStudyData(store);
        QCOMPARE(data.responses.size(), std::size_t{2 * answers - 2});
        QCOMPARE(data.voided, std::size_t{1});
        QStringList missing;
        for (const reports::QualityFlag& flag : reports::qualityFlags(data))
            if (flag.kind == reports::FlagKind::MissingAnswers)
                missing << QString::fromStdString(flag.participant.value_or("all") + ": " + flag.why);
        QCOMPARE(missing, QStringList{"S02: answers missing: Q2: 1 of 8, Q3: 1 of 8"});
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

    void aCodeInNoSlotIsRefused_data()
    {
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("said");
        const QString move = "UPDATE swatches SET slot = %1 WHERE slot = 1 AND fabric = 'F01'";
        for (const char* slot : {"0", "-1", "3", "2000000000", "4000000000000000000"})
            QTest::newRow(slot) << move.arg(slot) << QString("stands in slot %1; expected a code for each").arg(slot);
        QTest::newRow("a code is missing") << "DELETE FROM swatches WHERE slot = 2 AND fabric = 'F02'"
                                           << "is missing for fabric F02";
    }

    void aCodeInNoSlotIsRefused()
    {
        QFETCH(QString, sql);
        QFETCH(QString, said);
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString(), {.hasSwatchCodes = true});
        QCOMPARE(refusalsOf(folder), std::string());
        alter(folder, sql.toStdString());
        const QString refusals = QString::fromStdString(refusalsOf(folder));
        QVERIFY2(refusals.contains(said), qPrintable(refusals));
    }

    /// `verify` says that the study was altered; its status is told all the same.
    void answersWithOneEntryOfTheLogEndNoCommand()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString());
        OpenSession(folder, "S01").playUntilAnswers(5);
        alter(folder, "UPDATE responses SET event = (SELECT MIN(event) FROM responses)");
        QCOMPARE(refusalsOf(folder), std::string());
    }

    void deeplyNestedJsonEndsNoCommand_data()
    {
        QTest::addColumn<QString>("place");
        for (const char* fact : {"made_with", "signals_json", "stamps", "planned_balance", "protocol_json"})
            QTest::addRow("%s", fact) << QString("study SET %1 = ").arg(fact);
        QTest::newRow("tray") << "trials SET alternatives = ";
        QTest::newRow("tray of an answer") << "responses SET alternatives = ";
        QTest::newRow("every entry of the log") << "events SET payload = ";
        QTest::newRow("act") << "acts SET details = ";
    }

    void deeplyNestedJsonEndsNoCommand()
    {
        QFETCH(QString, place);
        constexpr std::size_t depth = 200'000;
        QTemporaryDir disk;
        const auto folder = tests::support::buildStudy(disk.filePath("study").toStdString());
        OpenSession(folder, "S01").playUntilAnswers(2);
        QCOMPARE(database::recordAct(folder, {"backup", "Ada", "test", "here", "b.tar", {}, {}}), std::nullopt);
        for (const std::string& json : {std::string(depth, '[') + std::string(depth, ']'),
                                        R"({"who":)" + std::string(depth, '[') + std::string(depth, ']') + "}"}) {
            alter(folder, "UPDATE " + place.toStdString() + "'" + json + "'");
            (void)refusalsOf(folder);
            try {
                OpenSession session(folder, "S01");
            } catch (const protocols::Error&) {
                // A session may be refused; it may not end the program.
            }
        }
    }

    void anAlteredDisplayResponseIsStillReported()
    {
        QTemporaryDir place;
        const auto folder = tests::support::buildStudy(place.filePath("study").toStdString());
        OpenSession(folder, "P01", database::ParticipantKind::Human).playUntilAnswers(1);
        alter(folder, R"(UPDATE study SET made_with = '{"display_response":{"date":5,"display":[],"load_n":"x","finger":{}}}')");
        QCOMPARE(refusalsOf(folder), std::string());
        alter(folder, R"(UPDATE events SET payload = '{"display":7}' WHERE kind = 'sitting_started')");
        QCOMPARE(refusalsOf(folder), std::string());
    }
};

QTEST_GUILESS_MAIN(StoredStudyTest)
#include "stored_study_test.moc"
