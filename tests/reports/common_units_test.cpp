// Comparisons take what was answered on both of their sides: a missing answer makes no difference of conditions, of instructions
// or of groups. Where nothing is missing, every answer counts.
#include "reports/cells/common_units.h"

#include <QTest>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/cells/crossed_answers.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "tests/reports/study_builder.h"

namespace {

using reports::AnswerCells;
using reports::AnswersOfMeans;
using reports::CommonUnits;
using reports::StudyData;
using reports::StudyResponse;
using reports::UnitMark;

constexpr const char* speed = "speed";
constexpr const char* accuracy = "accuracy";

/// An answer as it is stored: its repetition is its instruction.
StudyResponse instructed(StudyResponse response, const std::string& instruction)
{
    response.instruction = response.repetition = instruction;
    return response;
}

/// Answers under two instructions that depend on the instruction, and next to nothing on the condition: 3 or 7 points, a quarter
/// or four fifths of the choices right. `isMissing`: of participant, fabric, condition and instruction, which count from 0.
StudyData instructedStudy(const std::function<bool(int p, int f, int c, bool isFast)>& isMissing)
{
    StudyData data =
        builders::emptyStudy(8, 4, {"A", "B"}, {{"Q1", "Which?", builders::amongThree}, {"Q2", "How alike?", builders::onScale}});
    data.answersPerCell = 2;
    for (reports::QuestionInfo& question : data.questions)
        for (const char* id : {speed, accuracy}) question.instructions.push_back({id});
    for (int p = 0; p < 8; ++p)
        for (int f = 0; f < 4; ++f)
            for (int c = 0; c < 2; ++c)
                for (const bool isFast : {true, false}) {
                    if (isMissing(p, f, c, isFast)) continue;
                    const std::string &participant = data.participants[static_cast<std::size_t>(p)],
                                      &fabric = data.fabrics[static_cast<std::size_t>(f)],
                                      &condition = data.conditions[static_cast<std::size_t>(c)];
                    const bool isRight = isFast ? (p + 3 * f + 2 * c) % 7 == 0 : (p + f + 3 * c) % 8 != 0;
                    StudyResponse match = builders::right(participant, fabric, condition, "Q1", isRight);
                    match.seconds = (isFast ? 2 : 6) * (1 + 0.03 * ((p * 3 + f * 5 + c * 2) % 7));
                    data.responses.push_back(instructed(match, isFast ? speed : accuracy));
                    data.responses.push_back(
                        instructed(builders::rated(participant, fabric, condition, "Q2",
                                                   (isFast ? 3 : 7) + 0.1 * ((p * 3 + f * 2 + c * 4 + p * f) % 5)),
                                   isFast ? speed : accuracy));
                }
    return data;
}

StudyData completeInstructions()
{
    return instructedStudy([](int, int, int, bool) { return false; });
}

/// Two of three answers to B under "speed" are missing.
StudyData missingSpeed()
{
    return instructedStudy([](int p, int f, int c, bool isFast) { return isFast && c == 1 && (p + f) % 3 != 0; });
}

/// Choices of 8 participants about 5 fabrics whose times depend on the fabric only: 20 s for the last one, about 3 s for others.
StudyData fabricTimes()
{
    StudyData data = builders::emptyStudy(8, 5, {"A", "B"}, {{"Q1", "Which?", builders::amongThree}});
    for (int p = 0; p < 8; ++p)
        for (int f = 0; f < 5; ++f)
            for (int c = 0; c < 2; ++c) {
                data.responses.push_back(
                    builders::right(data.participants[static_cast<std::size_t>(p)], data.fabrics[static_cast<std::size_t>(f)],
                                    data.conditions[static_cast<std::size_t>(c)], "Q1", (p + f + c) % 3 != 0));
                data.responses.back().seconds = f == 4 ? 20 : 2 + 0.5 * f + 0.125 * p;
            }
    return data;
}

const reports::ChoiceAnalysis& choicesOf(const reports::StudyAnalysis& analysis)
{
    return reports::questionsWith<reports::ChoiceAnalysis>(analysis).front().findings;
}

bool isAbout(const stats::Value& value, double expected, double tolerance)
{
    return value.exists() && std::fabs(*value - expected) <= tolerance;
}

std::string pageOf(const reports::StudyAnalysis& analysis)
{
    return reports::reportPage(analysis, reports::reportTables(analysis), {});
}

/// Three participants in each of two groups, whose ratings depend on the fabric only. `isAnswered`: of group and fabric.
StudyData groupedStudy(const std::function<bool(int group, int fabric)>& isAnswered)
{
    StudyData data = builders::emptyStudy(6, 3, {"A", "B"}, {{"Q2", "How alike?", builders::onScale}});
    for (int p = 0; p < 6; ++p) {
        const std::string& participant = data.participants[static_cast<std::size_t>(p)];
        data.groupOf[participant] = p < 3 ? "lab1" : "lab2";
        for (int f = 0; f < 3; ++f)
            for (int c = 0; c < 2 && isAnswered(p / 3, f); ++c)
                data.responses.push_back(builders::rated(participant, data.fabrics[static_cast<std::size_t>(f)],
                                                         data.conditions[static_cast<std::size_t>(c)], "Q2",
                                                         2 + 3 * f + 0.25 * (p % 3) + 0.5 * c * ((p + f) % 2)));
    }
    return data;
}

}  // namespace

class CommonUnitsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aMissingAnswerTakesItsPartnerWithIt()
    {
        StudyData data = builders::emptyStudy(1, 2, {"A", "B"}, {{"Q2", "", builders::onScale}});
        const auto add = [&](const char* fabric, const char* condition, const char* instruction, double rating) {
            data.responses.push_back(instructed(builders::rated("P01", fabric, condition, "Q2", rating), instruction));
        };
        add("F01", "A", speed, 1);
        add("F01", "A", accuracy, 5);
        add("F01", "B", accuracy, 7);
        add("F02", "A", speed, 2);
        add("F02", "A", accuracy, 6);
        add("F02", "B", speed, 3);
        add("F02", "B", accuracy, 8);
        const AnswerCells cells(data);
        const CommonUnits units(cells, "Q2", {"A", "B"});
        QVERIFY(units.mark() == UnitMark::Repetition && units.leavesOutAnswers("P01"));
        QCOMPARE(units.means("P01"), (std::vector<double>{(5 + 4) / 2.0, (7 + 5.5) / 2}));
        QCOMPARE(cells.pairedMeans("Q2", "A", "B").a, std::vector<double>{4.5});
        QCOMPARE(cells.pairedMeans("Q2", "A", "B", AnswersOfMeans::All).a, std::vector<double>{3.5});
        QVERIFY(cells.haveUnequalAnswers("Q2"));
        QCOMPARE(cells.completeBlocks("Q2").table.values, (std::vector<double>{4.5, 6.25}));
        QCOMPARE(reports::crossedCells(data, cells, "Q2").values, (std::vector<double>{5, 4, 7, 5.5}));
        QCOMPARE(reports::crossedAnswers(data, cells, "Q2").values.size(), std::size_t(6));
    }

    /// P01 gave 4 answers under B; the first one of 4 under A is missing. Of B it takes its partner, or nothing.
    void repetitionsAreMatchedWhereConditionsShareThem_data()
    {
        QTest::addColumn<QStringList>("underA");  // repetition, and the instruction after a blank
        QTest::addColumn<QStringList>("underB");
        QTest::addColumn<bool>("isByName");
        QTest::addColumn<int>("leftOfB");
        QTest::newRow("blocks") << QStringList{"1", "2"} << QStringList{"1", "2"} << true << 3;
        QTest::newRow("instructions") << QStringList{"x speed", "y accuracy"} << QStringList{"x speed", "y accuracy"} << true
                                      << 3;
        QTest::newRow("a session for each condition")
            << QStringList{"monday", "tuesday"} << QStringList{"friday", "saturday"} << false << 4;
        QTest::newRow("instructions in sessions of one condition")
            << QStringList{"1 speed", "2 accuracy"} << QStringList{"3 accuracy", "4 speed"} << false << 3;
        QTest::newRow("sessions that share one condition") << QStringList{"1", "3"} << QStringList{"1", "2"} << false << 4;
        QTest::newRow("row numbers") << QStringList{"1", "4"} << QStringList{"2", "3"} << false << 4;
    }
    void repetitionsAreMatchedWhereConditionsShareThem()
    {
        QFETCH(const QStringList, underA);
        QFETCH(const QStringList, underB);
        QFETCH(const bool, isByName);
        QFETCH(const int, leftOfB);
        StudyData data = builders::emptyStudy(3, 2, {"A", "B"}, {{"Q2", "", builders::onScale}});
        int number = 0;
        for (const std::string& participant : data.participants)
            for (const std::string& fabric : data.fabrics)
                for (const char* condition : {"A", "B"})
                    for (const QString& name : *condition == 'A' ? underA : underB) {
                        data.responses.push_back(builders::rated(participant, fabric, condition, "Q2", ++number % 11));
                        data.responses.back().repetition = name.toStdString();
                        data.responses.back().instruction = name.section(' ', 1).toStdString();
                    }
        {
            const AnswerCells cells(data);
            QCOMPARE(CommonUnits(cells, "Q2", {"A", "B"}).mark() == UnitMark::Repetition, isByName);
            QVERIFY(!cells.haveUnequalAnswers("Q2"));
            QCOMPARE(cells.pairedMeans("Q2", "A", "B").b, cells.pairedMeans("Q2", "A", "B", AnswersOfMeans::All).b);
        }
        data.responses.erase(data.responses.begin());
        const AnswerCells cells(data);
        const CommonUnits units(cells, "Q2", {"A", "B"});
        QCOMPARE(units.mark() == UnitMark::Repetition, isByName);
        QCOMPARE(units.answers("P01")[1].size(), static_cast<std::size_t>(leftOfB));
        QCOMPARE(units.pairedAnswers("P01")[1].size(), std::size_t(3));
        QCOMPARE(units.answers("P02")[1].size(), std::size_t(4));
    }

    void missingInstructionsMakeNoDifferenceOfConditions()
    {
        const auto analysis = reports::analyse(missingSpeed(), {.depth = reports::Depth::Quick});
        for (const auto& question : analysis.questions) {
            // Means over all answers differ by -0.22 and -1.3.
            const double most = question.question.id == "Q1" ? 0.1 : 0.15;
            for (const reports::ContrastFinding& finding : reports::claimsOf(question)->contrasts) {
                QVERIFY2(isAbout(finding.claim.mean.estimate, 0, most),
                         qPrintable(QString::number(*finding.claim.mean.estimate)));
                for (const stats::Value& onFabric : finding.byFabric) QVERIFY(isAbout(onFabric, 0, 0.3));
                QVERIFY2(finding.claim.difference.p.orElse(0) > 0.2, finding.claim.difference.p.why().c_str());
            }
            for (const reports::OmnibusFinding& finding : reports::claimsOf(question)->omnibus)
                QVERIFY2(finding.test.p.orElse(0) > 0.2, finding.test.why.c_str());
            QVERIFY(isAbout(reports::comparisonsOf(question).front().test.estimate, 0, most));
        }
        // Every comparison of answers under both: 11 of the 32 cells have both instructions.
        const reports::AnswerCells cells(analysis.data);
        QCOMPARE(cells.completeSuccesses("Q1").blocks, std::size_t(32 + 11));
        // The names of the reference keep its definition: means over all answers.
        const auto statistics = reports::statisticsJson(analysis);
        QVERIFY(statistics["Q2"].contains("on_common_fabrics"));
        QVERIFY(statistics["Q2"]["pairwise_t_participant_means"][0]["diff"].get<double>() < -1);
    }

    /// Times and shares depend on the instruction by a factor of 3 in every cell, also where B's slow answers alone are left.
    void missingConditionsMakeNoDifferenceOfInstructions()
    {
        const auto analysis = reports::analyse(missingSpeed(), {.depth = reports::Depth::Quick});
        const auto& contrast = choicesOf(analysis).instructions.contrasts.front();
        QCOMPARE(contrast.tests.logSeconds.test.n, std::size_t(8));
        QVERIFY(isAbout(contrast.tests.logSeconds.test.estimate, std::log(1.0 / 3), 1e-12));
        QVERIFY(!choicesOf(analysis).instructions.isComplete);
    }

    void everybodyAnsweredIsSaidWhereItIsTrue()
    {
        const std::string everybody = "everybody answered every condition and fabric under each of them";
        const std::string whole = pageOf(reports::analyse(completeInstructions(), {.depth = reports::Depth::Quick}));
        QVERIFY(whole.find(": " + everybody) != std::string::npos);
        const std::string some = pageOf(reports::analyse(missingSpeed(), {.depth = reports::Depth::Quick}));
        QVERIFY(some.find(": " + everybody) == std::string::npos && some.find("Not " + everybody) != std::string::npos);
    }

    /// A list that was split between two instructions has nothing in common: all of its choices are compared, as before.
    void instructionsOfASplitListAreComparedOnAllChoices()
    {
        const auto analysis =
            reports::analyse(instructedStudy([](int p, int f, int c, bool isFast) { return ((p + f + c) % 2 == 0) == isFast; }),
                             {.depth = reports::Depth::Quick});
        QCOMPARE(choicesOf(analysis).instructions.contrasts.front().share.test.n, std::size_t(8));
    }

    void completeRepetitionsKeepEveryNumber()
    {
        const StudyData data = completeInstructions();
        const AnswerCells cells(data);
        for (const char* question : {"Q1", "Q2"}) {
            const auto common = cells.pairedMeans(question, "A", "B"),
                       all = cells.pairedMeans(question, "A", "B", AnswersOfMeans::All);
            QVERIFY(common.a == all.a && common.b == all.b && common.a.size() == 8);
            QVERIFY(cells.completeBlocks(question).table.values ==
                    cells.completeBlocks(question, AnswersOfMeans::All).table.values);
            QVERIFY(!cells.haveUnequalAnswers(question));
            std::vector<double> means;
            for (const char* condition : {"A", "B"})
                for (const AnswerCells::CellMean& cell : cells.cellMeans(question, condition)) means.push_back(cell.mean);
            QVERIFY(reports::crossedCells(data, cells, question).values == means);
            QCOMPARE(reports::crossedAnswers(data, cells, question).values.size(), std::size_t(128));
        }
        // Speed: the cells of all choices, as the table by condition has them.
        std::vector<stats::ConditionSpeedCells> conditions;
        for (const char* condition : {"A", "B"}) conditions.push_back(reports::speedUnder(cells, "Q1", condition).cells);
        const auto whole =
            stats::speedContrasts(conditions, stats::scoresOf(conditions), std::vector{stats::ContrastPair(0, 1)}, 3);
        const auto analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const auto& tests = choicesOf(analysis).speed.contrasts.front().tests;
        QCOMPARE(*tests.bitsPerSecond.test.estimate, *whole[0].bitsPerSecond.test.estimate);
        QCOMPARE(*tests.score.test.p, *whole[0].score.test.p);
        QCOMPARE(*tests.logSeconds.test.p, *whole[0].logSeconds.test.p);
    }

    void missingFabricsMakeNoDifferenceOfSpeed_data()
    {
        QTest::addColumn<bool>("isTimeOnly");  // the answer is there, its time is not
        QTest::newRow("no answer") << false;
        QTest::newRow("no time") << true;
    }
    void missingFabricsMakeNoDifferenceOfSpeed()
    {
        QFETCH(const bool, isTimeOnly);
        StudyData data = fabricTimes();
        const auto isSlowUnderB = [](const StudyResponse& one) { return one.fabric == "F05" && one.condition == "B"; };
        if (isTimeOnly)
            for (StudyResponse& response : data.responses) {
                if (isSlowUnderB(response)) response.seconds.reset();
            }
        else
            std::erase_if(data.responses, isSlowUnderB);
        const auto analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        const auto& tests = choicesOf(analysis).speed.contrasts.front().tests;
        QVERIFY(isAbout(tests.logSeconds.test.estimate, 0, 1e-12));  // A / B was 1.45
        // Shares and times are those of the same four fabrics.
        std::erase_if(data.responses, [](const StudyResponse& one) { return one.fabric == "F05"; });
        const auto rest = reports::analyse(data, {.depth = reports::Depth::Quick});
        const auto& expected = choicesOf(rest).speed.contrasts.front().tests;
        QCOMPARE(*tests.bitsPerSecond.test.estimate, *expected.bitsPerSecond.test.estimate);
        QCOMPARE(*tests.score.test.estimate, *expected.score.test.estimate);
        // The table by condition describes all answers.
        QVERIFY(*choicesOf(analysis).speed.conditions[0].bitsPerSecond != *choicesOf(rest).speed.conditions[0].bitsPerSecond);
    }

    void aTimeWithoutLogarithmTakesItsPartnerWithIt()
    {
        StudyData data = fabricTimes();
        for (StudyResponse& response : data.responses)
            if (response.fabric == "F05" && response.condition == "B") response.seconds = 0;
        const auto analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
        QVERIFY(isAbout(choicesOf(analysis).speed.contrasts.front().tests.logSeconds.test.estimate, 0, 1e-12));
    }

    void groupsAreComparedOnTheFabricsOfEveryGroup()
    {
        const auto analysis = reports::analyse(groupedStudy([](int group, int fabric) { return group == 0 || fabric < 2; }),
                                               {.depth = reports::Depth::Quick});
        const reports::GroupedQuestion& rated = analysis.groups.questions.front();
        QVERIFY(isAbout(rated.overall.difference, 0, 0.2));  // on all three fabrics of lab1: 1.5 and more
        QCOMPARE(rated.overall.fabricsLeftOut, std::vector<std::string>{"F03"});
        QCOMPARE(rated.contrasts.front().test.fabricsLeftOut, std::vector<std::string>{"F03"});
        for (const std::size_t c : {0U, 1U}) {
            QVERIFY(isAbout(rated.means[0][c], *rated.means[1][c], 0.5));
            QCOMPARE(rated.fabricsLeftOut[c], std::vector<std::string>{"F03"});
        }
        QVERIFY(pageOf(analysis).find("Not every group answered F03.") != std::string::npos);
        const auto statistics = reports::statisticsJson(analysis);
        QVERIFY(statistics["groups"]["questions"]["Q2"]["overall"]["fabrics_left_out"].dump() == R"(["F03"])");
        for (const auto& one : reports::reportTables(analysis))
            if (one.table.name == "group_tests" || one.table.name == "group_means")
                for (const auto& row : one.table.rows) QCOMPARE(QString::fromStdString(row.back().csv), "F03");
    }

    void groupsWithoutACommonFabricAreNotCompared()
    {
        const auto analysis = reports::analyse(groupedStudy([](int group, int fabric) { return (group == 0) == (fabric == 0); }),
                                               {.depth = reports::Depth::Quick});
        const reports::GroupTest& test = analysis.groups.questions.front().overall;
        QCOMPARE(test.why, std::string("no fabric was answered in every group"));
        QVERIFY(!test.p.exists() && !test.difference.exists() && !test.means[0].exists());
        QCOMPARE(test.fabricsLeftOut.size(), std::size_t(3));
    }

    void groupsThatAnsweredEverythingHaveNoColumnOfFabrics()
    {
        const auto analysis = reports::analyse(groupedStudy([](int, int) { return true; }), {.depth = reports::Depth::Quick});
        for (const auto& one : reports::reportTables(analysis))
            if (one.table.name == "group_tests" || one.table.name == "group_means") {
                QVERIFY(one.table.columns.back().name != "fabrics left out");
                for (const auto& row : one.table.rows) QCOMPARE(row.size(), one.table.columns.size());
            }
        QVERIFY(pageOf(analysis).find("Not every group answered") == std::string::npos);
        QVERIFY(!reports::statisticsJson(analysis)["groups"]["questions"]["Q2"]["overall"].contains("fabrics_left_out"));
    }
};

QTEST_GUILESS_MAIN(CommonUnitsTest)
#include "common_units_test.moc"
