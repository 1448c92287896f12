// What the report says of a plan: planned beside done, and what the answers lack.
#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/protocol_json.h"
#include "reports/data/answers_csv.h"
#include "reports/formats/table_formats.h"
#include "reports/formats/tex_table.h"
#include "reports/json/results_json.h"
#include "reports/page/page.h"
#include "reports/tables/report_tables.h"
#include "reports/text/condition_label.h"
#include "tests/reports/study_builder.h"

using reports::Accord;
using reports::StudyData;

namespace {

/// Three conditions, of which "h&f - v_grey" is planned as the primary contrast.
StudyData plannedStudy(int participants = 3, int fabrics = 3)
{
    StudyData data = builders::study(
        participants, fabrics, {"v_grey", "f", "h&f"},
        {[](int p, int f, int c) { return (p + f + c) % 3 != 0; },
         [](int p, int f, int c, int q) { return 2.0 + c + (p * p + 2 * f + c * (p + 1) * (f + 2) + q * c) % 5; }});
    reports::PlannedDesign& design = data.plannedDesign.emplace();
    design.participants = 3;
    design.fabrics = 3;
    design.fabricIds = {"F01", "F02", "F03"};
    design.conditionIds = {"v_grey", "f", "h&f"};
    design.conditions = 3;
    design.questions = {"Q1", "Q2", "Q3", "Q4"};
    design.contrastPairs = {{"h&f", "v_grey"}, {"h&f", "f"}};
    design.contrasts = 2;
    design.protocolSha256 = data.protocolInUse = "00aa";
    data.planned = design.contrastPairs;
    data.hasLog = true;
    data.registrations = {{1, "2026-01-02T03:04:05.000Z", "ab12", 0, false, {}, true}};
    return data;
}

/// The study under K-labels, as records of a blinded study give it.
StudyData blinded(StudyData data)
{
    data.blinded = true;
    data.conditions = {"K1", "K2", "K3"};
    for (auto& one : data.responses) one.condition = one.condition == "f" ? "K1" : one.condition == "h&f" ? "K2" : "K3";
    data.planned.clear();
    data.plannedDesign->contrastPairs.clear();
    data.plannedDesign->conditionIds.clear();
    return data;
}

/// "participants: 3 | 2 (no)" of every row.
QStringList rowsOf(const reports::StudyAnalysis& analysis)
{
    QStringList rows;
    for (const reports::PlanRow& row : analysis.plan.rows)
        rows << QString::fromStdString(row.item + ": " + row.planned + " | " + row.done + " (" + nameOf(row.accord) + ")");
    return rows;
}

QStringList rowsOf(const StudyData& data) { return rowsOf(reports::analyse(data, {reports::Depth::Quick, {}})); }

QString pageOf(const StudyData& data)
{
    const auto analysis = reports::analyse(data, {reports::Depth::Quick, {}});
    return QString::fromStdString(reports::reportPage(analysis, reports::reportTables(analysis), {}));
}

nlohmann::ordered_json registrationIn(const StudyData& data)
{
    return reports::resultsJson(reports::analyse(data, {reports::Depth::Quick, {}}))["preregistration"];
}

std::filesystem::path shipped(const char* name) { return std::filesystem::path(VIS2HAP_SOURCE_DIR) / "protocols" / name; }

}  // namespace

class PlanComparisonTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyItemOfThePlanHasARow()
    {
        QCOMPARE(
            rowsOf(plannedStudy()),
            (QStringList{"registration: before the first answer | registered on 2026-01-02T03:04:05.000Z, before the first "
                         "answer (yes)",
                         "protocol (SHA-256): 00aa | 00aa (yes)", "participants: 3 | 3 (yes)", "fabrics: 3 | 3 (yes)",
                         "conditions: 3 | 3 (yes)", "questions: 4 | 4 (yes)",
                         "primary contrast: h&f - v_grey | tested in Q1, Q2, Q3 and Q4 (yes)",
                         "planned contrasts: 2 | 2 tested (yes)", "bounds of equivalence: -0.5 and 0.5 | -0.5 and 0.5 (yes)",
                         "excluded participants: nobody; flagged ones are left out beside the main analysis | nobody; nobody is "
                         "flagged (yes)",
                         "answers: 108 | 108 (yes)"}));
        const QString page = pageOf(plannedStudy());
        QVERIFY(
            page.contains("Preregistered on 2026-01-02T03:04:05.000Z, before the first answer, SHA-256 <code>ab12</code>. "
                          "Nothing differs from the plan."));
    }

    /// Documents typeset conditions and minus signs; the CSV keeps what JSON has.
    void planIsTypesetInDocuments()
    {
        const auto analysis = reports::analyse(plannedStudy(), {reports::Depth::Quick, {}});
        for (const reports::ReportTable& one : reports::reportTables(analysis)) {
            if (one.table.name != "plan") continue;
            const std::string html = reports::toHtml(one.table), csv = reports::toCsv(one.table), tex = reports::toTex(one.table);
            QVERIFY(html.find(reports::htmlLabel("h&f") + " \u2212 " + reports::htmlLabel("v_grey")) != std::string::npos);
            QVERIFY(html.find("\u22120.5 and 0.5") != std::string::npos && html.find("2026-01-02T") != std::string::npos);
            QVERIFY(tex.find(reports::texLabel("h&f") + " $-$ " + reports::texLabel("v_grey")) != std::string::npos);
            QVERIFY(csv.find("h&f - v_grey") != std::string::npos && csv.find("-0.5 and 0.5") != std::string::npos);
            return;
        }
        QFAIL("the plan has no table");
    }

    void whatTheAnswersLackIsNamed()
    {
        StudyData data = plannedStudy();
        std::erase_if(data.responses, [](const auto& one) { return one.condition == "f" || one.fabric == "F02"; });
        data.participants.emplace_back("P04");
        const QStringList rows = rowsOf(data);
        QVERIFY2(rows.contains("fabrics: 3 | 2; without answers: F02 (no)"), qPrintable(rows.join("\n")));
        QVERIFY(rows.contains("conditions: 3 | 2; without answers: f (no)"));
        QVERIFY(rows.contains("participants: 3 | 3 (yes)"));
        QVERIFY(rows.contains("planned contrasts: 2 | 1 tested, 1 not tested (no)"));
        QVERIFY(rows.contains("answers: 108 | 48 (no)"));
        const auto plan = registrationIn(data);
        QCOMPARE(plan["contrasts_not_tested"].dump(), std::string(R"([{"a":"h&f","b":"f","reason":"no answers under f"}])"));
        QCOMPARE(plan["deviations"].size(), std::size_t(4));
        const QString page = pageOf(data);
        QVERIFY(page.contains("1 of 2 planned contrasts was not tested: "));
        QVERIFY(page.contains("4 participants. 1 of them gave no analysed answer and is not counted as a participant."));
        QVERIFY(page.contains("Haptic rendering study: 3 participants"));
    }

    /// Nothing is kept of who was erased.
    void erasedParticipantsAreNotAmongTheWithdrawn()
    {
        StudyData data = plannedStudy();
        data.withdrawn = {"P08"};
        data.erased = {"P09"};
        QVERIFY2(rowsOf(data).contains("participants: 3 | 3; withdrew: 1; answers erased: 1 (yes)"),
                 qPrintable(rowsOf(data).join("\n")));
        const QString page = pageOf(data);
        QVERIFY(page.contains("In addition, 1 participant withdrew. Answers given before are kept and not analysed"));
        QVERIFY(page.contains("The answers of 1 participant were erased, and the place became free again."));
        data.withdrawn.clear();
        QVERIFY(!pageOf(data).contains("withdrew"));
    }

    /// The table of missing answers is that of the participants; whole sessions are missing beside it.
    void answersOfEmptyPlacesAreToldApart()
    {
        StudyData data = plannedStudy();
        data.responses.pop_back();
        data.expectedResponses = 4 * 36;
        data.expectedOfEmptyPlaces = 36;
        const QString page = pageOf(data);
        QVERIFY(
            page.contains("107 of 144 expected answers are analysed, 37 are missing, 36 of them of places that nobody has. "));
        QVERIFY(page.contains("Missing answers by condition, of the 3 participants analysed"));
        QVERIFY(pageOf(blinded(data)).contains("are stored, 37 are missing, 36 of them of places that nobody has. "));
        data.participants.emplace_back("P04");
        data.expectedOfEmptyPlaces = 0;
        QVERIFY(pageOf(data).contains("37 are missing. "));
        QVERIFY(pageOf(data).contains("of the 4 participants analysed (1 of them without an answer)"));
    }

    void aContrastIsPartlyTestedWhereAQuestionLacksAnswers()
    {
        StudyData data = plannedStudy();
        std::erase_if(data.responses, [](const auto& one) { return one.condition == "v_grey" && one.question == "Q3"; });
        const QStringList rows = rowsOf(data);
        QVERIFY2(rows.contains("primary contrast: h&f - v_grey | tested in Q1, Q2 and Q4; not in Q3: there are no values (no)"),
                 qPrintable(rows.join("\n")));
        QVERIFY(rows.contains("planned contrasts: 2 | 1 tested, 1 in part of the questions (no)"));
    }

    void oneParticipantTestsNothing()
    {
        const QStringList rows = rowsOf(plannedStudy(1));
        QVERIFY2(rows.filter("primary contrast").first().contains("not tested: there is one participant only"),
                 qPrintable(rows.join("\n")));
        QVERIFY(rows.contains("participants: 3 | 1 (no)"));
    }

    void oneFabricIsTestedForTheseFabrics()
    {
        QVERIFY(rowsOf(plannedStudy(3, 1)).contains("planned contrasts: 2 | 2 tested (yes)"));
    }

    void aBlindedStudyKeepsItsNames()
    {
        const StudyData data = blinded(plannedStudy());
        const QStringList rows = rowsOf(data);
        QVERIFY(rows.contains("primary contrast: left out while blinded | - (-)"));
        QVERIFY(rows.contains("planned contrasts: 2 | left out while blinded (-)"));
        QVERIFY(rows.contains("conditions: 3 | 3 (yes)"));
        QVERIFY(rows.contains("participants: 3 | 3 finished (yes)"));
        QVERIFY(!pageOf(data).contains("h&amp;f"));
        QCOMPARE(registrationIn(data)["deviations"].size(), std::size_t(0));
    }

    /// A blinded report has no analysis, and so none without the flagged participants.
    void aBlindedPlanLeavesNobodyOut()
    {
        const QString row =
            "excluded participants: nobody; flagged ones are left out beside the main analysis | no analysis while "
            "blinded; %1 by the rules that need no key (-)";
        StudyData data = blinded(plannedStudy(3, 4));
        int ratings = 0;
        for (auto& one : data.responses)
            if (std::holds_alternative<reports::RatedAnswer>(one.content)) one.content = reports::RatedAnswer{0.1 * ++ratings};
        QVERIFY2(rowsOf(data).contains(row.arg("nobody is flagged")), qPrintable(rowsOf(data).join("\n")));
        for (auto& one : data.responses)
            if (one.participant == "P01" && std::holds_alternative<reports::RatedAnswer>(one.content))
                one.content = reports::RatedAnswer{5};
        QVERIFY2(rowsOf(data).contains(row.arg("1 participant flagged")), qPrintable(rowsOf(data).join("\n")));
    }

    /// The first answers of a running session would name the fabric of its first trial.
    void aBlindedPlanIsComparedWithFinishedParticipantsOnly()
    {
        StudyData data = blinded(plannedStudy());
        data.finished.clear();
        data.responses.resize(1);
        const QStringList unfinished = rowsOf(data);
        for (const char* row : {"participants: 3 | 0 finished (no)", "fabrics: 3 | nobody has finished yet (-)",
                                "conditions: 3 | nobody has finished yet (-)", "questions: 4 | nobody has finished yet (-)"})
            QVERIFY2(unfinished.contains(row), qPrintable(unfinished.join("\n")));
        QVERIFY(unfinished.contains("answers: 108 | 0 (no)"));
        data = blinded(plannedStudy());
        data.finished.erase("P03");
        std::erase_if(data.responses, [](const auto& one) { return one.participant == "P03" && one.fabric != "F02"; });
        const QStringList before = rowsOf(data);
        QVERIFY2(before.contains("participants: 3 | 2 finished (no)"), qPrintable(before.join("\n")));
        for (auto& one : data.responses)
            if (one.participant == "P03") one.fabric = "F01";
        QCOMPARE(rowsOf(data), before);
    }

    void laterAmendmentsDeviate()
    {
        StudyData data = plannedStudy();
        data.registrations.push_back({2, "2026-01-09T00:00:00.000Z", "cd34", 40, false, {"equivalence_bounds"}, false});
        data.protocolInUse = "00bb";
        data.protocolChanges = {"equivalence bounds"};
        const QStringList rows = rowsOf(data);
        QVERIFY2(rows.contains("amendments: none after the first answer | registration 2 on 2026-01-09T00:00:00.000Z, after 40 "
                               "answers (equivalence_bounds; not followed here) (no)"),
                 qPrintable(rows.join("\n")));
        QVERIFY(rows.contains("protocol (SHA-256): 00aa | 00bb; changed: equivalence bounds; the plan is followed here (no)"));
        QVERIFY(pageOf(data).contains("This report follows registration 1."));
    }

    /// The bounds of the plan count, but participants were asked as the later version words it.
    void theReportFollowsNoPlannedWording()
    {
        StudyData data = plannedStudy();
        data.plannedDesign->texts = {{"wording of Q2", "How close?"}, {"wording of Q3", "How rough?"}};
        for (auto& question : data.questions) question.text = question.id == "Q3" ? "How rough?" : "How near?";
        QVERIFY(rowsOf(data).contains("questions: 4 | 4 (yes)"));  // without an amendment there is one wording
        data.protocolVersions = {{1, "00aa", 0}, {2, "00bb", 3}};
        data.protocolInUse = "00bb";
        data.protocolChanges = {"equivalence bounds"};
        data.changedTexts = {"wording of Q2"};
        QStringList rows = rowsOf(data);
        QVERIFY2(rows.contains("protocol (SHA-256): 00aa | 00bb; changed: equivalence bounds; the plan is followed here; also "
                               "changed: wording of Q2 (no)"),
                 qPrintable(rows.join("\n")));
        QVERIFY2(rows.contains("questions: 4 | 4; reworded: Q2 (no)"), qPrintable(rows.join("\n")));
        data.protocolChanges.clear();
        QVERIFY(rowsOf(data).contains("protocol (SHA-256): 00aa | 00bb; changed: wording of Q2 (no)"));
        for (auto& question : data.questions)
            if (question.id == "Q3") question.wordings = {{"How rough?", {1}, {"P01"}}, {"Rough?", {2}, {"P02", "P03"}}};
        rows = rowsOf(data);
        QVERIFY2(rows.contains("questions: 4 | 4; reworded: Q2 and Q3 (no)"), qPrintable(rows.join("\n")));
    }

    void aStudyWithoutRegistrationSaysSo()
    {
        StudyData data = plannedStudy();
        data.registrations.clear();
        QVERIFY(rowsOf(data).first() == "registration: - | not preregistered (-)");
        const auto plan = registrationIn(data);
        QCOMPARE(plan["registered"], false);
        QVERIFY(plan["sha256"].is_null() && plan["why"]["sha256"] == "the study was not preregistered");
        QVERIFY(plan["deviations"].is_array());
    }

    void answersWithoutAnyPlanHaveNoTable()
    {
        StudyData data = plannedStudy();
        data.registrations.clear();
        data.plannedDesign.reset();
        data.planned.clear();
        data.hasLog = false;
        QVERIFY(rowsOf(data).isEmpty());
        QVERIFY(pageOf(data).contains("no plan is known"));
        QVERIFY(registrationIn(data)["deviations"].is_null());
    }

    /// Each cell is answered once under each instruction.
    void answersUnderEachInstructionArePlanned()
    {
        StudyData data = plannedStudy();
        data.plannedDesign->answersPerRendering = 12;
        QVERIFY2(rowsOf(data).contains("answers: 324 | 108 (no)"), qPrintable(rowsOf(data).join("\n")));
    }

    /// More pairs than are compared unasked: a plan of all pairs is not kept by testing none.
    void aPlanOfAllPairsIsNotKeptByTestingNone()
    {
        std::vector<std::string> conditions;
        for (int c = 10; c < 57; ++c) conditions.push_back("c" + std::to_string(c));
        StudyData data = builders::study(3, 2, conditions,
                                         {[](int p, int f, int c) { return (p + f * c) % 3 == 0; },
                                          [](int p, int f, int c, int q) { return (p * f + c * q + p * c) % 11; }});
        std::erase_if(data.questions, [](const auto& question) { return question.id != "Q2"; });
        std::erase_if(data.responses, [](const auto& one) { return one.question != "Q2"; });
        data.plannedDesign.emplace().conditionIds = conditions;
        const auto usual = reports::analyse(data, {reports::Depth::Quick, {}});
        QVERIFY2(rowsOf(usual).contains("planned contrasts: none: all pairs | none tested (needs --pairs) (no)"),
                 qPrintable(rowsOf(usual).join("\n")));
        const QString page = QString::fromStdString(reports::reportPage(usual, {}, {}));
        QVERIFY(page.contains("no difference is tested, because all pairs are too many"));
        QVERIFY(!page.contains("All pairs of conditions are also compared") && !page.contains("The tables of all pairs"));
        data.everyPair = true;
        const auto every = reports::analyse(data, {reports::Depth::Quick, {}});
        QVERIFY(rowsOf(every).contains("planned contrasts: none: all pairs | all pairs (yes)"));
        QVERIFY(QString::fromStdString(reports::reportPage(every, {}, {})).contains("All pairs of conditions are also compared"));
    }

    /// Neither a protocol that states something else nor one that is not there may be named as the source.
    void thePageNamesWhatStatesBoundsAndContrasts()
    {
        StudyData data = plannedStudy();
        data.equivalenceBounds = {-0.2, 0.2};
        data.boundsFrom = data.plannedFrom = reports::PlanOrigin::Option;
        const QString both = pageOf(data).simplified();
        QVERIFY2(both.contains("The option <code>--bounds</code> states their bounds: \u22120.2 and 0.2 scale points. They "
                               "replace those of the protocol, \u22120.5 and 0.5."),
                 qPrintable(both.mid(both.indexOf("states their bounds") - 60, 200)));
        QVERIFY(both.contains("with the sign of the option <code>--planned</code>, the primary one first"));
        QVERIFY(rowsOf(data).contains("bounds of equivalence: -0.5 and 0.5 | -0.2 and 0.2 (no)"));
        data.plannedDesign.reset();
        data.registrations.clear();
        data.hasLog = false;
        const QString alone = pageOf(data);
        QVERIFY(alone.contains("Neither a registration nor a protocol came with the answers"));
        QVERIFY(!alone.contains("The protocol states") && !alone.contains("sign of the protocol") &&
                !alone.contains("They replace"));
    }

    void contrastsOfTheCallAreNoPlannedOnes()
    {
        StudyData data = plannedStudy();
        data.planned = {{"f", "v_grey"}};
        data.plannedFrom = reports::PlanOrigin::Option;
        const QStringList others = rowsOf(data);
        QVERIFY2(others.contains("primary contrast: h&f - v_grey | not tested: the option --planned names other contrasts (no)"),
                 qPrintable(others.join("\n")));
        data.plannedDesign->contrastPairs.clear();
        data.plannedDesign->contrasts = 0;
        QVERIFY(rowsOf(data).contains("planned contrasts: none: all pairs | 1 contrast of the option --planned (no)"));
    }

    void boundsThatNoProtocolStatesAreADefault()
    {
        StudyData data = plannedStudy();
        data.plannedDesign->hasUsualBounds = true;
        const QString page = pageOf(data).simplified();
        QVERIFY(
            page.contains("Their bounds are the default of this program: \u22120.5 and 0.5 scale points, a twentieth of the "
                          "scale either way. The protocol states none."));
        QVERIFY(!page.contains("The protocol states their bounds") && !page.contains("The protocol states the bounds"));
        std::get<protocols::Rating>(data.questions.back().kind).scale.max = protocols::Tenths{50};
        for (auto& one : data.responses)
            if (auto* rated = std::get_if<reports::RatedAnswer>(&one.content)) rated->rating /= 2;
        QVERIFY(pageOf(data).contains("a twentieth of the shortest scale either way"));
    }

    /// The published answers spell two of the nine conditions otherwise, as "h_f" and "hg_fg".
    void publishedAnswersLackContrastsOfTheShippedProtocol()
    {
        const auto file = builders::sharedFolder() / "oracle/study/public/study_a.csv";
        if (!std::filesystem::exists(file)) QSKIP("the published answers are not there");
        reports::AnswersCsvOptions options;
        options.protocol = protocols::readProtocol(shipped("vis2hap.json"));
        const StudyData data = reports::readAnswersCsv(file, options);
        const auto plan = registrationIn(data);
        QCOMPARE(plan["registered"], false);
        QCOMPARE(plan["why"]["time"], "the answers came without a registration");
        QCOMPARE(plan["contrasts_not_tested"].size(), std::size_t(4));
        QCOMPARE(plan["contrasts_not_tested"][0]["reason"], "no answers under h_g&f_g and h&f");
        QVERIFY(pageOf(data).contains("4 of 12 planned contrasts were not tested: "));
    }
};

QTEST_GUILESS_MAIN(PlanComparisonTest)
#include "plan_comparison_test.moc"
