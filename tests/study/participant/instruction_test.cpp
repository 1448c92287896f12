// What the participant sees, moment by moment. Two studies whose allocations differ give the same instructions at the same
// moments, and no instruction names a fabric, a piece, a code or a condition.
#include <QTemporaryDir>
#include <QTest>
#include <set>

#include "protocols/protocol_json.h"
#include "protocols/usual_texts.h"
#include "study/participant/session/present_instruction.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/study_builder.h"
#include "tests/support/whole_protocol.h"

using namespace study::participant;
using namespace study::session;
using protocols::Tenths;
using tests::support::OpenSession;

namespace {

/// The instruction at every step of a whole session, without the places on the line, which differ between participants.
struct Seen {
    std::vector<std::string> instructions;
    std::set<std::string> forbidden;  ///< everything that must not be seen
};

Instruction withoutPlaces(Instruction instruction)
{
    if (auto& scale = instruction.scale) {
        scale->asked.reset();
        scale->tap.clear();
        if (scale->last) *scale->last = {};
    }
    return instruction;
}

void forbidWhatIsPresented(Seen& seen, const View& view)
{
    seen.forbidden.insert(view.code.value);
    seen.forbidden.insert(view.tray.begin(), view.tray.end());
    for (const auto& fabric : view.trayIds) seen.forbidden.insert(fabric.value);
    for (const auto& name : view.familiarisation) seen.forbidden.insert(name);
    if (view.question) seen.forbidden.insert(view.question->text);
    seen.forbidden.erase("");
}

Seen seenIn(const database::StudyFolder& folder)
{
    OpenSession session(folder, "P01");
    Seen seen;
    const auto look = [&] {
        seen.instructions.push_back(
            jsonOf(withoutPlaces(instructionFor(session.driver->view(), session.driver->plan().protocol))));
        forbidWhatIsPresented(seen, session.driver->view());
    };
    look();
    session.stepUntil("Familiarising");
    session.send(FamiliarisationShown{1});
    look();
    session.stepUntil("ScaleTraining");
    for (int named = 0; named < 3; ++named) {
        look();
        session.send(ScalePlaced{*session.driver->view().placeToName, *session.driver->view().placeToName});
    }
    look();
    while (session.step()) look();
    return seen;
}

}  // namespace

class InstructionTest : public QObject {
    Q_OBJECT

    QTemporaryDir m_folder;
    database::StudyFolder study(const char* name, const tests::support::StudyRecipe& recipe)
    {
        return tests::support::buildStudy(m_folder.filePath(name).toStdString(), recipe);
    }
    static View at(const Stage& stage)
    {
        View view;
        view.state.stage = stage;
        return view;
    }
    static protocols::Protocol protocol()
    {
        return protocols::protocolFromJson(protocols::paperProtocolJson(), "the paper's protocol");
    }

private Q_SLOTS:
    void nothingDependsOnTheAllocation()
    {
        auto recipe = tests::support::wholeStudy();
        const Seen first = seenIn(study("first", recipe));
        recipe.designSeed = 77;
        recipe.keySeed = 78;
        const Seen other = seenIn(study("other", recipe));
        QVERIFY(first.instructions.size() > 60);
        QVERIFY(first.forbidden != other.forbidden);  // the allocations do differ
        QVERIFY(first.instructions == other.instructions);
        std::set<std::string> all = first.forbidden;
        all.insert(other.forbidden.begin(), other.forbidden.end());
        for (const auto* condition : {"v_grey", "h&f"}) all.insert(condition);
        for (const std::string& instruction : first.instructions)
            for (const std::string& word : all)
                QVERIFY2(instruction.find(word) == std::string::npos, (word + " in " + instruction).c_str());
    }

    void presentationsShowOnlyThatOneWaitsOrFeels()
    {
        const auto& texts = protocols::usualParticipantTexts();
        Instruction expected;
        expected.title = texts.find("wait_title")->second;
        QVERIFY(instructionFor(at(PlacingTray{3}), protocol()) == expected);
        QVERIFY(waiting(protocol()) == expected);
        expected.title = texts.find("feel_title")->second;
        QVERIFY(instructionFor(at(Presenting{3, 1, 5, 9, TouchSource::Operator}), protocol()) == expected);
    }

    void everyStageHasItsInstruction_data()
    {
        QTest::addColumn<QString>("stage");
        QTest::addColumn<QString>("title");
        QTest::addColumn<int>("task");
        const auto row = [](const char* stage, const char* title, Task task) {
            QTest::newRow(stage) << stage << title << int(task);
        };
        row("enrolled", "Welcome", Task::Read);
        row("consenting", "Consent", Task::Consent);
        row("facts", "About you", Task::Facts);
        row("familiarising", "Get to know the display", Task::Read);
        row("scale", "Learn the scale", Task::Scale);
        row("checklist", "Put on the blindfold and the headphones", Task::Read);
        row("break", "Break", Task::Read);
        row("debriefing", "Almost done", Task::Read);
        row("finished", "Thank you", Task::Read);
        row("withdrawn", "Thank you", Task::Read);
        row("paused", "Pause", Task::Read);
    }
    void everyStageHasItsInstruction()
    {
        QFETCH(QString, stage);
        const std::map<QString, Stage> stages{{"enrolled", Enrolled{}},
                                              {"consenting", Consenting{}},
                                              {"facts", AskingFacts{}},
                                              {"familiarising", Familiarising{}},
                                              {"scale", ScaleTraining{}},
                                              {"checklist", CheckingList{}},
                                              {"break", OnBreak{}},
                                              {"debriefing", Debriefing{}},
                                              {"finished", Finished{}},
                                              {"withdrawn", Withdrawn{}},
                                              {"paused", Presenting{2, 0, 0, {}, TouchSource::Operator}}};
        View view = at(stages.at(stage));
        view.state.paused = stage == "paused";
        const Instruction instruction = instructionFor(view, protocol());
        QTEST(QString::fromStdString(instruction.title), "title");
        QTEST(int(instruction.task), "task");
        QVERIFY(instructionFromJson(jsonOf(instruction), "JSON") == instruction);
        if (stage == "consenting") QCOMPARE(instruction.statement, protocol().consent);
        if (stage == "facts") QVERIFY(instruction.questions == protocol().facts);
    }

    void theScaleAsksAndAnswersUntilThreeAreRight()
    {
        View view = at(ScaleTraining{false, 4, 1, NamedPlace{{35}, {38}, true}});
        view.placeToName = Tenths{72};
        const auto scale = instructionFor(view, protocol()).scale.value();
        QCOMPARE(scale.low, std::string("0 unrelated"));
        QCOMPARE(scale.high, std::string("10 totally the same"));
        QCOMPARE(scale.tap, std::string("Tap the place of 7.2."));
        QCOMPARE(scale.count, std::string("1 of 3 right in a row"));
        QCOMPARE(scale.last.value().text, std::string("Right. Your answer was 3.8, and the place is 3.5."));
        view.state.stage = ScaleTraining{false, 5, 0, NamedPlace{{72}, {40}, false}};
        QCOMPARE(instructionFor(view, protocol()).scale.value().last.value().text,
                 std::string("Your answer was 4. The place is 7.2."));
        view.placeToName.reset();
        const Instruction complete = instructionFor(view, protocol());
        QVERIFY(!complete.scale.value().asked && complete.scale.value().tap.empty());
        QCOMPARE(complete.lines.front(), std::string("You know the scale now. The experimenter continues."));
    }

    void aScaleWithWordsIsAskedByItsWords()
    {
        protocols::Protocol likert = protocol();
        likert.phases.back().task = protocols::Rating{{Tenths{10}, Tenths{30}, Tenths{10}, 9, {"no", "perhaps", "yes"}}};
        View view = at(ScaleTraining{});
        view.placeToName = Tenths{20};
        const auto scale = instructionFor(view, likert).scale.value();
        QCOMPARE(scale.tap, std::string("Tap the place of 2, perhaps."));
        QCOMPARE(scale.high, std::string("3, yes"));
        QCOMPARE(scale.scale.sections, 2);  // one mark a word, as in the window and on the card
    }

    void aNumberThatDoesNotFitIsRefused_data()
    {
        QTest::addColumn<QString>("number");
        for (const char* number : {"18446744073709551615", "9223372036854775808", "4294967297", "-9223372036854775808", "1.5"})
            QTest::newRow(number) << number;
    }

    /// 2^64 - 1 became -1.
    void aNumberThatDoesNotFitIsRefused()
    {
        QFETCH(QString, number);
        const std::string text = R"({"task":"read","title":"Break","lines":[],"break_seconds":)" + number.toStdString() + "}";
        const QString error = tests::support::errorOf([&] { (void)instructionFromJson(text, "JSON"); });
        QVERIFY2(error.startsWith("2: ") && error.contains("break_seconds is no whole number"), qPrintable(error));
    }

    void theStudySpeaksItsOwnLanguage()
    {
        protocols::Protocol own = protocol();
        own.participantTexts = {{"break_title", "休憩"}, {"break_clock", "{time} 経過"}};
        View view = at(OnBreak{});
        view.breakSeconds = 61.9;
        const Instruction instruction = instructionFor(view, own);
        QCOMPARE(instruction.title, std::string("休憩"));
        QCOMPARE(instruction.breakClock, std::string("{time} 経過"));
        QCOMPARE(instruction.breakSeconds.value(), 61);
    }

    void anActIsTheEventThatTheOperatorWouldSend()
    {
        const auto kind = [](const std::optional<EventBody>& event) {
            return event ? kindOf(*event) + " " + payloadJson(*event) : std::string("-");
        };
        const View consenting = at(Consenting{}), facts = at(AskingFacts{});
        View scale = at(ScaleTraining{});
        scale.placeToName = Tenths{72};
        const ParticipantAct agrees{1, Agreement{true}}, tapped{1, PlaceTapped{{70}}};
        const ParticipantAct told{1, FactsTold{{"31", "", "left", ""}}};
        QCOMPARE(kind(eventOf(agrees, consenting, protocol())), std::string(R"(consented {"by":"participant"})"));
        QVERIFY(kind(eventOf({1, Agreement{false}}, consenting, protocol())).starts_with("noted "));  // It ends nothing.
        QCOMPARE(kind(eventOf(told, facts, protocol())),
                 std::string(R"(facts_given {"given":["age","handedness"],"by":"participant"})"));
        QCOMPARE(kind(eventOf(tapped, scale, protocol())),
                 std::string(R"(scale_placed {"shown":72,"spoken":70,"by":"participant"})"));
        // What the session does not ask for now is no event.
        QCOMPARE(kind(eventOf(agrees, facts, protocol())), std::string("-"));
        QCOMPARE(kind(eventOf(tapped, consenting, protocol())), std::string("-"));
        QCOMPARE(kind(eventOf({1, PlaceTapped{{101}}}, scale, protocol())), std::string("-"));
        QCOMPARE(kind(eventOf({1, FactsTold{{"31"}}}, facts, protocol())), std::string("-"));
        scale.placeToName.reset();
        QCOMPARE(kind(eventOf(tapped, scale, protocol())), std::string("-"));
    }

    void theLogSaysWhoAgreed()
    {
        const auto folder = study("logged", tests::support::wholeStudy());
        OpenSession session(folder, "P01");
        session.stepUntil("Consenting");
        session.send(*eventOf({1, Agreement{true}}, session.driver->view(), session.driver->plan().protocol));
        const auto last = session.store.events(protocols::ParticipantId("P01")).back();
        const EventBody event = eventFromRecord(last.kind, last.payloadJson);
        QVERIFY(std::get<Consented>(event).by == EnteredBy::Participant);
    }
};

QTEST_GUILESS_MAIN(InstructionTest)
#include "instruction_test.moc"
