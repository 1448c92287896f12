// Speed and accuracy by instruction, for answers that were collected elsewhere: tables, JSON and figures of the factor.
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "reports/analysis/study_analysis.h"
#include "reports/data/answers_csv.h"
#include "reports/figures/report_figures.h"
#include "reports/json/results_json.h"
#include "reports/json/statistics_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"

namespace {

using Json = nlohmann::ordered_json;

/// 8 participants x 4 fabrics x 2 conditions under "speed" (2 s, half of the choices right) and "accuracy" (6 s, 7 of 8 right).
std::string trade()
{
    std::string text = "participant,fabric,condition,instruction,Q1_correct,Q1_seconds\n";
    for (int p = 0; p < 8; ++p)
        for (int f = 0; f < 4; ++f)
            for (int c = 0; c < 2; ++c)
                for (const bool fast : {true, false}) {
                    const int draw = (p * 3 + f * 5 + c * 7) % 8;
                    const double seconds = (fast ? 2.0 : 6.0) * (1 + 0.05 * p + 0.03 * draw);
                    text += "P" + std::to_string(p) + ",F" + std::to_string(f) + (c == 0 ? ",f" : ",h&f") +
                            (fast ? ",speed," : ",accuracy,") + (draw < (fast ? 4 : 7) ? "1," : "0,") + std::to_string(seconds) +
                            "\n";
                }
    return text;
}

std::filesystem::path written(const QTemporaryDir& folder, const std::string& text)
{
    const std::filesystem::path file = folder.filePath("answers.csv").toStdString();
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

reports::StudyAnalysis analysed(const std::string& text, const reports::AnswersCsvOptions& options = {})
{
    const QTemporaryDir folder;
    return reports::analyse(reports::readAnswersCsv(written(folder, text), options), {.depth = reports::Depth::Quick});
}

const reports::ReportTable* tableNamed(const std::vector<reports::ReportTable>& tables, const std::string& name)
{
    for (const auto& one : tables)
        if (one.table.name == name) return &one;
    return nullptr;
}

}  // namespace

class InstructionsReportTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theInstructionIsAFactor()
    {
        const auto analysis = analysed(trade());
        const auto& findings = reports::questionsWith<reports::ChoiceAnalysis>(analysis).front().findings;
        const auto& rows = findings.instructions.instructions;
        QCOMPARE(rows.size(), std::size_t(2));
        QCOMPARE(rows[0].instruction.id, std::string("speed"));
        QCOMPARE(*rows[0].speed.share, 0.5);
        QCOMPARE(*rows[1].speed.share, 0.875);
        QVERIFY(*rows[0].speed.medianSecondsCi95.high < *rows[1].speed.medianSecondsCi95.low);
        QVERIFY(*rows[0].speed.bitsPerSecondCi95.low <= *rows[0].speed.bitsPerSecond);
        const auto& contrast = findings.instructions.contrasts.front();
        QCOMPARE(findings.instructions.contrasts.size(), std::size_t(1));
        // The times differ by the factor 3 in every cell, so the ratio has no spread and no interval.
        QVERIFY(std::fabs(*contrast.tests.logSeconds.test.estimate - std::log(1.0 / 3)) < 1e-9);
        QVERIFY(std::fabs(*contrast.share.test.estimate + 0.375) < 1e-12);
        QCOMPARE(findings.instructions.shares.effects[1].name, std::string("instruction"));
        QCOMPARE(findings.instructions.shares.participants, std::size_t(8));
        // The whole study still has both instructions of a cell, as their mean.
        QCOMPARE(analysis.data.answersPerCell, std::size_t(2));
        QCOMPARE(findings.conditions[0].count.trials, std::size_t(64));
    }

    void tablesFilesAndFigureShowIt()
    {
        const auto analysis = analysed(trade());
        const auto tables = reports::reportTables(analysis);
        const auto* table = tableNamed(tables, "instructions_q1");
        QVERIFY(table != nullptr && table->section == reports::PageSection::Speed && table->onPage);
        QCOMPARE(table->table.rows.size(), std::size_t(2));
        for (const auto& row : table->table.rows) QCOMPARE(row.size(), table->table.columns.size());
        for (const char* name : {"instruction_contrasts_q1", "instruction_factors_q1", "instructions_by_condition_q1",
                                 "instruction_accuracy_q1", "speed_accuracy"})
            QVERIFY2(tableNamed(tables, name) != nullptr, name);
        std::vector<std::string> figures;
        for (const auto& figure : reports::reportFigures(analysis)) figures.push_back(figure.name);
        QVERIFY(std::ranges::find(figures, "instructions_Q1") != figures.end());
        QVERIFY(std::ranges::find(figures, "speed_accuracy_Q1") != figures.end());
        const Json statistics = reports::statisticsJson(analysis);
        const Json& part = statistics.at("q1_instructions");
        QCOMPARE(part.at("instructions").at(1).at("id"), "accuracy");
        QCOMPARE(part.at("instructions").at(1).at("proportion"), 0.875);
        QCOMPARE(part.at("instructions").at(0).at("conditions").size(), std::size_t(2));
        QCOMPARE(part.at("contrasts").size(), std::size_t(4));
        QVERIFY(part.at("instructions").at(0).at("median_seconds_ci95").is_array());
        const Json results = reports::resultsJson(analysis);
        const Json& speed = results.at("speed_accuracy").at("h&f");
        QVERIFY(speed.at("median_seconds_ci95").at(0) < speed.at("median_seconds"));
    }

    void speedIsThatOfEveryChoiceQuestion()
    {
        const QTemporaryDir folder;
        const auto pageOf = [](const reports::StudyData& data) {
            const auto analysis = reports::analyse(data, {.depth = reports::Depth::Quick});
            return QString::fromStdString(reports::reportPage(analysis, {}, {}));
        };
        auto data = reports::readAnswersCsv(written(folder,
                                                    "participant,fabric,condition,Q1_correct,Q1_seconds,S1_correct,S1_seconds\n"
                                                    "P1,F1,f,1,3,0,4\nP1,F2,f,0,4,1,5\nP2,F1,f,1,5,1,3\nP2,F2,f,1,4,0,3\n"));
        const QString same = pageOf(data);
        QVERIFY(same.contains("</b> are those of Q1 and S1. The table by condition is about Q1. "));
        QVERIFY(same.contains("the information of one choice among m = 3 divided by the mean time."));
        data.questions[1].kind = protocols::ForcedChoice{2};
        QVERIFY(pageOf(data).contains("of one choice among m answers (3 for Q1 and 2 for S1) divided by the mean time."));
        data.questions.pop_back();
        std::erase_if(data.responses, [](const auto& response) { return response.question == "S1"; });
        const QString one = pageOf(data);
        QVERIFY(one.contains("</b> are those of Q1. ") && !one.contains("The table by condition is about"));
    }

    void withoutInstructionsNothingIsAdded()
    {
        const auto analysis =
            analysed("participant,fabric,condition,Q1_correct,Q1_seconds\nP1,F1,f,1,3\nP1,F2,f,0,4\nP2,F1,f,1,5\n");
        const auto tables = reports::reportTables(analysis);
        QVERIFY(tableNamed(tables, "instructions_q1") == nullptr);
        QVERIFY(!reports::statisticsJson(analysis).contains("q1_instructions"));
    }

    /// The file's own deadlines are those of the protocol; answers after them count like all others.
    void deadlinesOfAProtocolMarkLateAnswers()
    {
        protocols::Protocol protocol;
        protocol.name = "Deadline";
        protocol.fabricCount = 2;
        protocol.conditions = {protocols::ConditionId("f")};
        protocol.phases.push_back(
            {{{protocols::QuestionId("Q1"), "Which?", protocols::ForcedChoice{3}}}, protocols::ForcedChoice{3}});
        protocol.phases[0].instructions = {{protocols::InstructionId("deadline"), protocols::SpeedAim::None, 4.0, "Within 4 s."}};
        for (const char* table :
             {"participant,fabric,condition,instruction,Q1_correct,Q1_seconds\nP1,F1,f,deadline,1,3\nP1,F2,f,deadline,0,4.5\n"
              "P2,F1,f,deadline,1,\nP2,F2,f,deadline,1,5\n",
              "participant,fabric,condition,instruction,question,correct,seconds\nP1,F1,f,deadline,Q1,1,3\n"
              "P1,F2,f,deadline,Q1,0,4.5\nP2,F1,f,deadline,Q1,1,\nP2,F2,f,deadline,Q1,1,5\n"}) {
            const auto analysis = analysed(table, {protocol, "", 3});
            const auto& row =
                reports::questionsWith<reports::ChoiceAnalysis>(analysis).front().findings.instructions.instructions.at(0);
            QCOMPARE(row.answers, std::size_t(4));
            QCOMPARE(row.timed, std::size_t(3));
            QCOMPARE(row.late, std::size_t(2));
            QCOMPARE(*row.speed.share, 0.75);
        }
    }

    void oneParticipantAndMissingTimesHaveReasonsAndNoNumbers()
    {
        const auto analysis =
            analysed("participant,fabric,condition,instruction,Q1_correct\nP1,F1,f,speed,1\nP1,F1,f,accuracy,0\nP1,F2,f,,1\n");
        const auto& findings = reports::questionsWith<reports::ChoiceAnalysis>(analysis).front().findings;
        const auto& row = findings.instructions.instructions.at(0);
        QCOMPARE(row.answers, std::size_t(1));
        QVERIFY(!row.speed.medianSeconds.exists() && !row.speed.shareCi95.low.exists());
        QVERIFY(!findings.instructions.contrasts.at(0).share.test.why.empty());
        QVERIFY(!reports::statisticsJson(analysis).empty());
        for (const auto& figure : reports::reportFigures(analysis)) QVERIFY(figure.name != "instructions_Q1");
    }
};

QTEST_GUILESS_MAIN(InstructionsReportTest)
#include "instruction_factor_test.moc"
