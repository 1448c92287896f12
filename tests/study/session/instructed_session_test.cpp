// A session whose blocks instruct speed, accuracy or a deadline: when the operator says what, and what is stored with each trial.
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <set>

#include "database/server/study_move.h"
#include "protocols/orders/counterbalancing.h"
#include "protocols/protocol_json.h"
#include "study/session/session_moves.h"
#include "tests/support/server/engine_session.h"

using namespace study::session;
using namespace tests::support;

namespace {

/// 3 fabrics x 2 conditions under two instructions, then six ratings without one; breaks after four presentations.
StudyRecipe instructedStudy()
{
    StudyRecipe recipe;
    recipe.protocol = R"({"schema": "vis2hap.protocol/1", "name": "Trade", "participants": 2, "fabrics": ["F01", "F02", "F03"],
        "conditions": ["v_grey", "h&f"], "dead_time_seconds": 0, "break_after": 4,
        "phases": [{"questions": ["Q1"], "alternatives": 3,
                    "instructions": [{"id": "speed", "aim": "speed"}, {"id": "slow", "text": "Take 1 s.", "deadline_seconds": 1}]},
                   {"questions": ["Q2"], "scale": {"min": 0, "max": 10}}]})";
    return recipe;
}

}  // namespace

class InstructedSessionTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        if (const QString why = EngineUnderTest::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    }

    void init() { m_place = std::make_unique<QTemporaryDir>(); }

    void eachBlockSaysItsInstruction()
    {
        EngineSession session(studyOf(), "S01");
        std::vector<std::string> said, breaks;
        bool wasSaid = false;
        do {
            const View view = session.driver->view();
            if (std::holds_alternative<PlacingTray>(view.state.stage) && view.instruction) {
                if (view.instructionBegins) said.push_back(view.instruction->id.value);
                wasSaid = true;
            }
            if (std::holds_alternative<Presenting>(view.state.stage) && view.phaseName == "Q1") QVERIFY(view.instruction);
            if (std::holds_alternative<OnBreak>(view.state.stage))
                breaks.push_back(view.instruction ? view.instruction->id.value : "");
            if (view.phaseName == "Q2") QVERIFY(!view.instruction);
        } while (session.step());
        QVERIFY(wasSaid);
        // 12 choices in blocks of 4, 2, 4 and 2; then ratings in blocks of 4 and 2.
        const std::string first = said.at(0), second = said.at(2);
        QVERIFY(first != second);
        QCOMPARE(said, (std::vector<std::string>{first, first, second, second}));
        QCOMPARE(breaks, (std::vector<std::string>{first, second, second, "", ""}));
        QCOMPARE(session.driver->plan().protocol.breaks(), 5);
    }

    /// The scale lies between the beginning of the sitting and its first tray.
    void aPreparedSittingInMidBlockSaysItAgain()
    {
        const auto folder = studyOf();
        EngineSession(folder, "S01").playUntilAnswers(2);
        EngineSession session(folder, "S01");
        session.clock.advanceSeconds(5);
        session.send(SittingPrepared{});
        QVERIFY(std::holds_alternative<ScaleTraining>(session.driver->state().stage));
        session.clock.advanceSeconds(60);
        session.stepUntil("PlacingTray");
        const View view = session.driver->view();
        QVERIFY(view.instruction && view.instructionBegins);
        session.playUntilAnswers(3);
        QVERIFY(!session.driver->view().instructionBegins);
    }

    /// What `protocol show` counts beforehand, for every example: several phases, instructions, catch trials and anchors.
    void aSessionMakesTheBreaksThatItsProtocolCounts()
    {
        namespace fs = std::filesystem;
        int examples = 0;
        for (const auto& file : fs::directory_iterator(fs::path(VIS2HAP_SOURCE_DIR) / "protocols" / "examples")) {
            if (file.path().extension() != ".json") continue;
            Plan plan;
            plan.protocol = protocols::readProtocol(file.path());
            const protocols::Design design = protocols::drawDesign(plan.protocol, 1);
            for (const protocols::DesignTrial& drawn : design.participants.front()) {
                protocols::BlindedTrial trial;
                trial.phase = drawn.phase;
                if (drawn.instruction) trial.instruction = protocols::InstructionId(std::to_string(*drawn.instruction));
                plan.trials.push_back(trial);
            }
            for (const int breakAfter : {1, 4, 20, 1000}) {
                plan.protocol.breakAfterPresentations = breakAfter;
                QVERIFY2(orderOf(plan).back().block == plan.protocol.breaks(), file.path().c_str());
            }
            ++examples;
        }
        QVERIFY(examples > 5);
    }

    void slotsGetTheInstructionsInDifferentOrders()
    {
        const auto folder = studyOf();
        const database::StudyStore store = database::readStudy(folder);
        QVERIFY(store.trials(1).front().instruction != store.trials(2).front().instruction);
        QVERIFY(store.faults().empty());
    }

    /// The last choice of the first instruction is voided in the break: it is presented again before the next instruction.
    void aVoidedTrialKeepsItsInstruction()
    {
        EngineSession session(studyOf(), "S01");
        session.playUntilAnswers(6);
        const auto first = session.driver->plan().trials.at(5).instruction;
        QVERIFY(std::holds_alternative<OnBreak>(session.driver->view().state.stage));
        session.send(Voided{"wrong swatch"});
        QCOMPARE(session.driver->view().instruction->id, first);
        session.playToEnd();
        for (const auto& answer : session.rows().answers())
            if (answer.voided) QCOMPARE(answer.record.trial.value, 6);
        QVERIFY(session.rows().faults().empty());
    }

    void theViewOfAnswersShowsInstructionAndLateness()
    {
        const auto folder = studyOf();
        {
            EngineSession session(folder, "S01");
            session.playToEnd();
        }
        QCOMPARE(
            rowsFound(
                folder,
                "SELECT COALESCE(instruction, 'none'), COUNT(*), COUNT(deadline_seconds) FROM answers GROUP BY 1 ORDER BY 1"),
            (std::vector<std::string>{"none|6|0", "slow|6|6", "speed|6|0"}));
        // A played session stamps no beginning of its answers, so nobody knows whether they were late.
        QCOMPARE(rowsFound(folder, "SELECT COUNT(*) FROM answers WHERE late IS NOT NULL"), std::vector<std::string>{"0"});
    }

    void answersAfterTheDeadlineAreLateAndKept()
    {
        const auto folder = studyOf();
        {
            EngineSession session(folder, "S01");
            for (bool goesOn = true; goesOn;) {
                const View view = session.driver->view();
                if (!std::holds_alternative<Presenting>(view.state.stage)) {
                    goesOn = session.step();
                    continue;
                }
                if (!std::get<Presenting>(view.state.stage).touchedAtNs) session.send(Touched{});
                session.clock.advanceSeconds(view.presentation % 2 == 0 ? 1.5 : 0.5);
                session.send(Answered{responseTo(view), {.begunAgoNs = 0}});
            }
        }
        QCOMPARE(
            rowsFound(folder,
                      "SELECT late, response_seconds, COUNT(*) FROM answers WHERE instruction = 'slow' GROUP BY 1, 2 ORDER BY 1"),
            (std::vector<std::string>{"0|0.5|3", "1|1.5|3"}));
        QCOMPARE(rowsFound(folder, "SELECT COUNT(*) FROM answers WHERE late IS NULL"), std::vector<std::string>{"12"});
    }

private:
    database::StudyFolder studyOf() { return m_engine.study(m_place->filePath("study").toStdString(), instructedStudy()); }
    std::unique_ptr<QTemporaryDir> m_place;
    EngineUnderTest m_engine;
};

QTEST_GUILESS_MAIN(InstructedSessionTest)
#include "instructed_session_test.moc"
