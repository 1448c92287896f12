// Simulated participants in memory and through the store: the same rules and rows, whatever goes wrong; parts of a simulation
// hold the same bits as the whole; a batch that ends early leaves a sound study.
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <set>

#include "database/keys.h"
#include "protocols/files/errors.h"
#include "rendering/display/display.h"
#include "study/records/stored_study.h"
#include "study/session/driver.h"
#include "study/session/stimuli.h"
#include "study/simulation/simulate_through_store.h"
#include "study/simulation/simulation_analysis.h"
#include "study/simulation/simulation_files.h"
#include "tests/support/study_builder.h"

using namespace study::simulation;
using database::CurrentAnswer;
using database::ParticipantKind;
using database::StudyStore;
using protocols::ParticipantId;
using study::players::MishapRates;

namespace {

constexpr MishapRates often{
    .voids = 0.04, .corrections = 0.1, .refusals = 0.1, .pauses = 0.03, .notes = 0.05, .withdrawals = 0.2};
constexpr std::uint64_t seed = 7;

study::players::Percept drawnPercept(protocols::Random& random)
{
    study::players::Percept percept;
    percept.slipperiness = 0.3 * random.normal();
    for (double& band : percept.texture) band = 0.3 * random.normal();
    return percept;
}

/// A study folder and what a simulation needs of it.
struct SimulatedStudy {
    explicit SimulatedStudy(const database::StudyFolder& folder)
        : store(folder, StudyStore::Access::Write),
          key(readAllocationKeyForTestDriver(store, ParticipantKind::Simulated, {})),
          bank(study::session::stimuliOf(store))
    {
        protocols::Random random(3);
        percepts.stationKey = stationKeyOf(key.secret);
        for (const auto& fabric : store.facts().fabrics) percepts.fabrics[fabric] = drawnPercept(random);
        for (const auto& [code, entry] : key.entries) {
            percepts.stimuli[code] = percepts.fabrics.at(entry.fabric);
            percepts.stimuli[code].slipperiness += entry.condition.value == "h&f" ? 0.05 : 0.6;
        }
    }

    MemoryStudy inMemory() const { return memoryStudyOf(store, key, percepts); }
    void playIntoStore(std::size_t count, const MishapRates& mishaps)
    {
        simulateThroughStore(store, bank, percepts, store.nextParticipantIds("SIM", count), {.seed = seed, .mishaps = mishaps});
    }

    StudyStore store;
    protocols::AllocationKey key;
    rendering::StimulusBank bank;
    study::players::Percepts percepts;
};

template <class T>
std::string textOf(const std::optional<T>& value)
{
    if (!value) return "-";
    if constexpr (std::is_arithmetic_v<T>)
        return std::to_string(*value);
    else
        return *value;
}

/// Everything of a row but the number of its entry in the log.
std::string lineOf(const CurrentAnswer& answer)
{
    const auto& record = answer.record;
    std::string tray;
    for (const auto& fabric : record.alternatives) tray += fabric.value + ",";
    std::string line;
    for (const std::string& field : {answer.participant.value,
                                     std::to_string(record.trial.value),
                                     record.question.value,
                                     record.presentationCode.value,
                                     tray,
                                     textOf(record.answer),
                                     record.rating ? std::to_string(record.rating->value) : "-",
                                     std::to_string(record.readyAtNs),
                                     textOf(record.touchedAtNs),
                                     record.touchedBy,
                                     textOf(record.touchEndedAtNs),
                                     textOf(record.answerBegunAtNs),
                                     record.answerBegunBy,
                                     std::to_string(record.answeredAtNs),
                                     textOf(record.entries),
                                     record.note,
                                     std::to_string(record.isCorrection),
                                     std::to_string(answer.sitting),
                                     std::to_string(answer.attempt),
                                     std::to_string(answer.storedAtNs),
                                     std::to_string(answer.seconds),
                                     textOf(answer.responseSeconds),
                                     std::to_string(answer.corrections),
                                     std::to_string(answer.voided),
                                     answer.wallTime})
        line += field + "|";
    return line;
}

StudyStore::Append entryOf(const ParticipantId& participant, const std::string& kind)
{
    StudyStore::Append entry;
    entry.event = {0, participant, 1, kind, "{}", 1, "2000-01-01T00:00:00Z"};
    return entry;
}

std::vector<std::string> linesOf(const std::vector<CurrentAnswer>& answers)
{
    std::vector<std::string> lines;
    for (const CurrentAnswer& answer : answers) lines.push_back(lineOf(answer));
    return lines;
}

bool sameBits(const SimulatedAnswers& a, const SimulatedAnswers& b)
{
    return a.number == b.number && a.hasWithdrawn == b.hasWithdrawn && a.voided == b.voided && a.corrections == b.corrections &&
           a.refusals == b.refusals && a.values == b.values && a.wasSame == b.wasSame && a.seconds.size() == b.seconds.size() &&
           std::memcmp(a.seconds.data(), b.seconds.data(), a.seconds.size() * sizeof(double)) == 0;
}

}  // namespace

class SimulationTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    database::StudyFolder newStudy(int participants, int fabrics = 3)
    {
        return tests::support::buildStudy(m_place.filePath(QString("study%1").arg(++m_studies)).toStdString(),
                                          {.fabrics = fabrics, .participants = participants});
    }

    /// Simulates twelve participants both ways, and compares every value that the simulation in memory has.
    void compareWithTheReport(const database::StudyFolder& folder, reports::StudyAnalysis& simulated)
    {
        const MishapRates some{.voids = 0.05, .corrections = 0.1, .withdrawals = 0.15};
        SimulatedStudy study(folder);
        study.playIntoStore(12, some);
        const auto memory = study.inMemory();
        unblind(study.store, {"tester", "simulated", "2000-01-01T00:00:00Z"}, {});
        const auto data = study::records::studyData(study.store, {});
        const auto report = reports::analyse(*data, {.depth = reports::Depth::Quick});
        simulated = analysisOf(memory, simulateInMemory(memory, {.seed = seed, .count = 12, .mishaps = some}));
        QCOMPARE(simulated.data.participants, report.data.participants);
        QCOMPARE(simulated.questions.size(), report.questions.size());
        QCOMPARE(simulated.completeness.present, report.completeness.present);
        for (std::size_t q = 0; q < report.questions.size(); ++q) {
            const auto& is = comparisonsOf(simulated.questions[q]);
            const auto& expected = comparisonsOf(report.questions[q]);
            QCOMPARE(is.size(), expected.size());
            for (std::size_t i = 0; i < is.size(); ++i)
                QVERIFY(is[i].test.t == expected[i].test.t && is[i].test.p == expected[i].test.p &&
                        is[i].test.ci == expected[i].test.ci && is[i].pHolm == expected[i].pHolm);
            if (const auto* ratings = std::get_if<reports::RatingAnalysis>(&report.questions[q].findings)) {
                const auto& mine = std::get<reports::RatingAnalysis>(simulated.questions[q].findings);
                QVERIFY(mine.anova.f == ratings->anova.f && mine.friedman.q == ratings->friedman.q);
                for (std::size_t c = 0; c < ratings->conditions.size(); ++c)
                    QVERIFY(mine.conditions[c].ratings == ratings->conditions[c].ratings &&
                            mine.conditions[c].mean == ratings->conditions[c].mean &&
                            mine.conditions[c].meanOfParticipants == ratings->conditions[c].meanOfParticipants &&
                            mine.conditions[c].sd == ratings->conditions[c].sd &&
                            mine.conditions[c].ci95 == ratings->conditions[c].ci95 &&
                            mine.conditions[c].withinHalfWidth == ratings->conditions[c].withinHalfWidth);
                QVERIFY(mine.equivalences[0].test.p == ratings->equivalences[0].test.p);
                QCOMPARE(mine.equivalences[0].verdict, ratings->equivalences[0].verdict);
            } else if (const auto* choices = std::get_if<reports::ChoiceAnalysis>(&report.questions[q].findings)) {
                const auto& mine = std::get<reports::ChoiceAnalysis>(simulated.questions[q].findings);
                QVERIFY(mine.cochran.q == choices->cochran.q);
                for (std::size_t c = 0; c < choices->conditions.size(); ++c)
                    QVERIFY(mine.conditions[c].count.correct == choices->conditions[c].count.correct &&
                            mine.conditions[c].count.trials == choices->conditions[c].count.trials &&
                            mine.conditions[c].pHolm == choices->conditions[c].pHolm &&
                            mine.conditions[c].noChance == choices->conditions[c].noChance &&
                            mine.conditions[c].dPrime == choices->conditions[c].dPrime &&
                            mine.conditions[c].dPrimeSe == choices->conditions[c].dPrimeSe &&
                            mine.speed.conditions[c].bitsPerSecond == choices->speed.conditions[c].bitsPerSecond &&
                            mine.conditions[c].participantsAgainstChance.p ==
                                choices->conditions[c].participantsAgainstChance.p &&
                            simulated.speed[c].medianSeconds == report.speed[c].medianSeconds &&
                            simulated.speed[c].bitsPerSecondCi95 == report.speed[c].bitsPerSecondCi95 &&
                            simulated.speed[c].balancedIntegrationScore == report.speed[c].balancedIntegrationScore);
            }
        }
    }

private Q_SLOTS:
    void fiftyParticipantsHaveTheSameRowsInMemoryAndInTheStore()
    {
        SimulatedStudy study(newStudy(50));
        study.playIntoStore(50, often);
        std::map<ParticipantId, std::vector<std::string>> stored;
        int corrections = 0, voided = 0, remarks = 0;
        for (const CurrentAnswer& answer : study.store.answers()) {
            stored[answer.participant].push_back(lineOf(answer));
            corrections += answer.corrections;
            voided += answer.voided;
            remarks += !answer.record.note.empty();
        }
        const auto memory = study.inMemory();
        const SimulationRequest request{.seed = seed, .count = 50, .mishaps = often};
        const auto places = placesOf(memory, request);
        int refusals = 0, withdrawals = 0;
        for (int number = 1; number <= 50; ++number) {
            const auto session = simulateSession(memory, request, number, places[static_cast<std::size_t>(number) - 1]);
            QCOMPARE(linesOf(session.answers), stored[session.participant]);
            refusals += session.refusals;
            withdrawals += session.hasWithdrawn;
        }
        int withdrawn = 0;
        for (const auto& enrolment : study.store.enrolments()) withdrawn += enrolment.state == database::SlotState::Withdrawn;
        QCOMPARE(withdrawals, withdrawn);
        for (const int happened : {corrections, voided, remarks, refusals, withdrawals}) QVERIFY(happened > 4);
        QCOMPARE(study.store.faults(), std::vector<std::string>());
    }

    void aBatchStoresTheRowsOfTheOneByOnePath()
    {
        SimulatedStudy batched(newStudy(6)), single(newStudy(6));
        batched.playIntoStore(6, often);
        const auto display = rendering::openDisplay("none");
        for (const auto& id : single.store.nextParticipantIds("SIM", 6)) {
            study::session::VirtualClock clock;
            study::session::Driver driver(single.store, id, ParticipantKind::Simulated, single.bank, *display, clock);
            study::players::DriverHands hands(driver);
            study::players::SimulatedParticipant participant(single.percepts, seed, id.value);
            study::players::Mishaps mishaps(often, seed, id, driver.plan().protocol.answersPerParticipant());
            playSession(judgeOf(participant), mishaps, driver.plan(), hands, clock);
        }
        QCOMPARE(linesOf(batched.store.answers()), linesOf(single.store.answers()));
        QCOMPARE(batched.store.head().sequence, single.store.head().sequence);
        for (const auto& id : {ParticipantId("SIM01"), ParticipantId("SIM06")}) {
            const auto a = batched.store.events(id), b = single.store.events(id);
            QCOMPARE(a.size(), b.size());
            for (std::size_t i = 0; i < a.size(); ++i)
                QVERIFY(a[i].sequence == b[i].sequence && a[i].kind == b[i].kind && a[i].payloadJson == b[i].payloadJson &&
                        a[i].atNs == b[i].atNs && a[i].sitting == b[i].sitting);
        }
        QCOMPARE(batched.store.faults(), std::vector<std::string>());
    }

    void aBatchThatEndsEarlyLeavesASoundStudyThatGoesOn()
    {
        SimulatedStudy study(newStudy(3));
        study.playIntoStore(1, {});
        const auto head = study.store.head();
        const auto rows = linesOf(study.store.answers());
        {
            StudyStore::Batch batch(study.store);
            study.store.enrol(ParticipantId("SIM02"), ParticipantKind::Simulated);
            study.store.append(entryOf(ParticipantId("SIM02"), "begun"));
        }
        QVERIFY(study.store.head() == head);
        QCOMPARE(study.store.enrolments().size(), std::size_t(1));
        QCOMPARE(linesOf(study.store.answers()), rows);
        study.playIntoStore(2, {});
        QCOMPARE(study.store.answers().size(), 3 * rows.size());
        QCOMPARE(study.store.faults(), std::vector<std::string>());
    }

    void aBatchTakesNobodyButSimulatedParticipants()
    {
        SimulatedStudy study(newStudy(3));
        study.store.enrol(ParticipantId("P01"), ParticipantKind::Human);
        const auto head = study.store.head();
        {
            StudyStore::Batch batch(study.store);
            QVERIFY_THROWS_EXCEPTION(protocols::Error, study.store.enrol(ParticipantId("P02"), ParticipantKind::Human));
            QVERIFY_THROWS_EXCEPTION(protocols::Error, study.store.enrol(ParticipantId("S01"), ParticipantKind::Scripted));
            QVERIFY_THROWS_EXCEPTION(protocols::Error, study.store.append(entryOf(ParticipantId("P01"), "begun")));
        }
        QVERIFY(study.store.head() == head);
        study.store.append(entryOf(ParticipantId("P01"), "begun"));
        QCOMPARE(study.store.head().sequence, head.sequence + 1);
    }

    void aBatchWithAFailedPartStoresNothing()
    {
        SimulatedStudy study(newStudy(3));
        const auto head = study.store.head();
        const ParticipantId id("SIM01");
        {
            StudyStore::Batch batch(study.store);
            study.store.enrol(id, ParticipantKind::Simulated);
            database::AnswerRecord record;
            record.trial = {1};
            record.question = protocols::QuestionId("Q1");
            record.answer = "F01";
            record.isCorrection = true;
            auto correction = entryOf(id, "corrected");
            correction.answers = {record};
            QVERIFY_THROWS_EXCEPTION(protocols::Error, study.store.append(correction));
            QVERIFY_THROWS_EXCEPTION(protocols::Error, batch.commit());
        }
        QVERIFY(study.store.head() == head);
        QVERIFY(study.store.enrolments().empty());
    }

    void partsOfASimulationHoldTheBitsOfTheWhole()
    {
        const SimulatedStudy study(newStudy(4));
        const auto memory = study.inMemory();
        const auto whole = simulateInMemory(memory, {.seed = seed, .first = 1, .count = 45, .mishaps = often, .threads = 1});
        QCOMPARE(whole.size(), std::size_t(45));
        for (const auto& [first, count] : {std::pair(1, 13), std::pair(14, 1), std::pair(15, 31)}) {
            const auto part =
                simulateInMemory(memory, {.seed = seed, .first = first, .count = count, .mishaps = often, .threads = 3});
            QCOMPARE(part.size(), static_cast<std::size_t>(count));
            for (int i = 0; i < count; ++i)
                QVERIFY(sameBits(part[static_cast<std::size_t>(i)], whole[static_cast<std::size_t>(first - 1 + i)]));
        }
        QVERIFY(!sameBits(whole[0], simulateInMemory(memory, {.seed = seed + 1, .count = 1, .mishaps = often})[0]));
    }

    void placesBeyondTheStudyAreAsBalancedAsItsOwn()
    {
        const SimulatedStudy study(newStudy(4, 4));
        const auto memory = study.inMemory();
        /// How often each condition and fabric follows each other, and how often the true fabric lies in each slot: sorted,
        /// because an exchange moves the counts.
        const auto countsOf = [&](std::size_t set) {
            std::map<std::string, int> counts;
            for (std::size_t place = 4 * set; place < 4 * set + 4; ++place) {
                const auto list = listOf(memory, place, seed);
                std::set<std::string> shown;
                const protocols::AllocationKey::Entry* before = nullptr;
                for (const auto& trial : list) {
                    const auto& entry = memory.images.at(protocols::FileCode(trial.sealedCode.value));
                    const auto slot = std::ranges::find(trial.alternatives, entry.fabric) - trial.alternatives.begin();
                    Q_ASSERT(slot < static_cast<std::ptrdiff_t>(trial.alternatives.size()));
                    if (trial.phase == 0) ++counts["slot " + std::to_string(slot)];
                    if (before) ++counts["after " + before->condition.value + before->fabric.value + " " + entry.fabric.value];
                    before = &entry;
                    shown.insert(std::to_string(trial.phase) + trial.sealedCode.value);
                }
                Q_ASSERT(shown.size() == list.size());
            }
            std::vector<int> sorted;
            for (const auto& [name, count] : counts) sorted.push_back(count);
            std::ranges::sort(sorted);
            return sorted;
        };
        QCOMPARE(countsOf(1), countsOf(0));
        QCOMPARE(countsOf(17), countsOf(0));
        QVERIFY(listOf(memory, 4, seed) != listOf(memory, 0, seed));
        QVERIFY(listOf(memory, 4, seed) != listOf(memory, 8, seed));
        QVERIFY(listOf(memory, 4, seed) == listOf(memory, 4, seed));
        QVERIFY(listOf(memory, 3, seed) == memory.places[3]);
    }

    void theAnalysisHasTheValuesOfTheReport()
    {
        reports::StudyAnalysis simulated;
        compareWithTheReport(newStudy(12), simulated);
        QVERIFY(!simulated.data.withdrawn.empty());
        QCOMPARE(simulated.designLimits.size(), std::size_t(2));
    }

    /// Each instruction repeats the list of its phase: no answer may take the place of another.
    void everyAnswerUnderEachInstructionCounts()
    {
        tests::support::StudyRecipe recipe;
        recipe.protocol = R"({"schema": "vis2hap.protocol/1", "name": "Trade", "participants": 12,
            "fabrics": ["F01", "F02", "F03"], "conditions": ["v_grey", "h&f"], "dead_time_seconds": 0,
            "question_texts": {"S1": "Do you see what you touch?"},
            "phases": [{"questions": ["Q1"], "alternatives": 3,
                        "instructions": [{"id": "speed", "aim": "speed"}, {"id": "accuracy", "aim": "accuracy"},
                                         {"id": "deadline", "deadline_seconds": 4}]},
                       {"questions": ["Q2", "Q3"], "scale": {"min": 0, "max": 10},
                        "instructions": [{"id": "slow", "text": "Take 1 s."}, {"id": "speed", "aim": "speed"}]},
                       {"questions": ["Q4"], "scale": {"min": 0, "max": 10}},
                       {"questions": ["S1"], "same_different": true,
                        "instructions": [{"id": "slow", "text": "Take 1 s."}, {"id": "speed", "aim": "speed"}]}]})";
        reports::StudyAnalysis simulated;
        compareWithTheReport(tests::support::buildStudy(m_place.filePath("trade").toStdString(), recipe), simulated);
        const std::size_t people = simulated.data.participants.size(), cells = people * 3;
        const auto trialsOf = [&](std::size_t question, std::size_t condition) {
            const auto& findings = simulated.questions[question].findings;
            if (const auto* choices = std::get_if<reports::ChoiceAnalysis>(&findings))
                return choices->conditions[condition].count.trials;
            return std::get<reports::RatingAnalysis>(findings).conditions[condition].ratings;
        };
        for (const std::size_t condition : {0U, 1U}) {
            QCOMPARE(trialsOf(0, condition), 3 * cells);
            QCOMPARE(trialsOf(1, condition), 2 * cells);
            QCOMPARE(trialsOf(2, condition), 2 * cells);
            QCOMPARE(trialsOf(3, condition), cells);
            QCOMPARE(trialsOf(4, condition), 2 * cells);
            QVERIFY(std::get<reports::ChoiceAnalysis>(simulated.questions[4].findings).conditions[condition].dPrime.exists());
        }
        QCOMPARE(simulated.completeness.present, 2 * 10 * cells);
        QCOMPARE(simulated.completeness.expected, simulated.completeness.present);
        QVERIFY(simulated.designLimits.back().find("under each of them") != std::string::npos);
    }

    void everyFileSaysThatItIsSimulated()
    {
        const SimulatedStudy study(newStudy(4));
        const auto memory = study.inMemory();
        const auto analysis = analysisOf(memory, simulateInMemory(memory, {.seed = seed, .count = 30}));
        const std::filesystem::path out = m_place.filePath("simulated").toStdString();
        writeSimulation(analysis, "{}", out);
        writeSimulation(analysis, "{}", out);  // replaces that of the earlier run
        int files = 0;
        for (const auto& file : std::filesystem::directory_iterator(out / "tables")) {
            QVERIFY2(file.path().filename().string().starts_with("simulated_"), file.path().c_str());
            ++files;
        }
        QVERIFY(files >= 20);
        const auto results = QJsonDocument::fromJson([&] {
                                 QFile file(m_place.filePath("simulated/results.json"));
                                 return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
                             }())
                                 .object();
        QVERIFY(results["study"].toObject()["simulated"].toBool());
        QCOMPARE(results["study"].toObject()["participants"].toInt(), 30);
        QVERIFY(results["design"].toObject()["left_out"].toArray().size() >= 2);
        QCOMPARE(results["comparisons"].toArray().size(), 4);
        QFile(m_place.filePath("simulated/index.html")).open(QIODevice::WriteOnly);
        QVERIFY_THROWS_EXCEPTION(protocols::Error, writeSimulation(analysis, "{}", out));
        const std::filesystem::path other = m_place.filePath("other").toStdString();
        std::filesystem::create_directory(other);
        std::ofstream(other / "results.json") << R"({"study":{"simulated":5}})";
        QVERIFY_THROWS_EXCEPTION(protocols::Error, writeSimulation(analysis, "{}", other));
    }
};

QTEST_GUILESS_MAIN(SimulationTest)
#include "simulation_test.moc"
