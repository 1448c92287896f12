// The state machine by itself: values in, values out.
#include <QTest>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

#include "study/session/preparation.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"
#include "study/session/view.h"

using namespace study::session;
using protocols::FabricId;
using protocols::QuestionId;
using protocols::SealedCode;
using protocols::Tenths;

namespace {

constexpr std::int64_t oneSecondNs = 1000000000;

/// Four choices among three fabrics, then three presentations with two ratings each; a break after three.
Plan smallPlan()
{
    Plan plan;
    plan.protocol.fabrics = {FabricId("F01"), FabricId("F02"), FabricId("F03")};
    plan.protocol.breakAfterPresentations = 3;
    protocols::Phase choice, rating;
    choice.task = protocols::ForcedChoice{3};
    choice.questions = {{QuestionId("Q1"), "Which?", choice.task}};
    rating.task = protocols::Rating{};
    rating.questions = {{QuestionId("Q2"), "How slippery?", rating.task}, {QuestionId("Q3"), "How textured?", rating.task}};
    plan.protocol.phases = {choice, rating};
    for (int number = 1; number <= 7; ++number) {
        const bool isChoice = number <= 4;
        const std::string digit = std::to_string(number);
        std::vector<FabricId> tray = plan.protocol.fabrics;
        if (!isChoice) tray.resize(1);
        plan.trials.push_back(
            {{number}, isChoice ? 0 : 1, SealedCode("file" + digit), protocols::PresentationCode("code" + digit), tray});
    }
    return plan;
}

/// The same plan with every stage of the preparation.
Plan fullPlan()
{
    Plan plan = smallPlan();
    plan.protocol.consent = "The participant agrees";
    plan.protocol.facts = {"age"};
    plan.protocol.checklist = {"The mask is on"};
    plan.familiarisation = {{"jersey", SealedCode("fam1")}, {"velvet", SealedCode("fam2")}};
    return plan;
}

/// Applies events that must be accepted.
class Session {
public:
    explicit Session(Plan plan = smallPlan()) : m_plan(std::move(plan)) {}
    void waitMinutes(int minutes) { m_nowNs += minutes * 60 * oneSecondNs; }
    const Plan& plan() const { return m_plan; }
    std::vector<int> order() const
    {
        std::vector<int> indices;
        for (const PlaceInOrder& place : m_state.order) indices.push_back(place.index);
        return indices;
    }
    Session& operator<<(const EventBody& body)
    {
        m_nowNs += oneSecondNs;
        auto outcome = apply(m_plan, m_state, {body, m_nowNs});
        if (const auto* refusal = std::get_if<Refusal>(&outcome))
            qFatal("%s in %s: %s", kindOf(body).c_str(), nameOf(m_state).c_str(), refusal->reason.c_str());
        m_state = std::get<SessionStep>(outcome).next;
        m_effects = std::get<SessionStep>(outcome).effects;
        return *this;
    }
    QString refusalOf(const EventBody& body) const
    {
        const auto outcome = apply(m_plan, m_state, {body, m_nowNs});
        return std::holds_alternative<Refusal>(outcome) ? QString::fromStdString(std::get<Refusal>(outcome).reason) : QString();
    }
    Session& choose(const char* fabric = "F01") { return *this << TrayReady{} << Answered{FabricId(fabric)}; }
    Session& rate(int tenths) { return *this << Answered{Tenths{tenths}}; }

    const State& state() const { return m_state; }
    const std::vector<Effect>& effects() const { return m_effects; }
    std::string name() const { return nameOf(m_state); }
    int index() const
    {
        if (const auto* tray = std::get_if<PlacingTray>(&m_state.stage)) return tray->index;
        if (const auto* rest = std::get_if<OnBreak>(&m_state.stage)) return rest->nextIndex;
        return std::get<Presenting>(m_state.stage).index;
    }

private:
    Plan m_plan;
    State m_state;
    std::vector<Effect> m_effects;
    std::int64_t m_nowNs = 0;
};

Session atFirstTray() { return Session() << SittingStarted{} << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{}; }
Session atFirstRating()
{
    Session session = atFirstTray();
    session.choose().choose().choose();
    session << BreakEnded{};
    session.choose();
    return session << BreakEnded{} << TrayReady{};
}
Session debriefing()
{
    Session session = atFirstRating();
    session.rate(10).rate(20);
    for (int i = 0; i < 2; ++i) (session << TrayReady{}).rate(30).rate(40);
    return session;
}
Session finished() { return debriefing() << Debriefed{"liked the silk"}; }
Session familiarising()
{
    return Session(fullPlan()) << SittingStarted{} << Begun{} << Consented{} << FactsGiven{{{"age", "24"}}};
}

std::vector<std::pair<std::string, Session>> gridStates()
{
    std::vector<std::pair<std::string, Session>> states;
    states.emplace_back("Enrolled", Session(fullPlan()) << SittingStarted{});
    states.emplace_back("Consenting", Session(fullPlan()) << SittingStarted{} << Begun{});
    states.emplace_back("AskingFacts", Session(fullPlan()) << SittingStarted{} << Begun{} << Consented{});
    states.emplace_back("Familiarising", familiarising());
    states.emplace_back("ScaleTraining", familiarising() << FamiliarisationDone{});
    states.emplace_back("CheckingList", familiarising() << FamiliarisationDone{} << ScaleTrainingDone{});
    states.emplace_back("PlacingTray, the first", atFirstTray());
    states.emplace_back("PlacingTray, the second", atFirstTray().choose());
    states.emplace_back("Presenting Q1", atFirstTray().choose() << TrayReady{});
    states.emplace_back("Presenting Q2, touched", atFirstRating() << Touched{});
    states.emplace_back("Presenting Q3", atFirstRating().rate(50));
    states.emplace_back("OnBreak", atFirstTray().choose().choose().choose());
    states.emplace_back("Debriefing", debriefing());
    states.emplace_back("Finished", finished());
    states.emplace_back("Withdrawn", atFirstTray().choose() << WithdrawnEvent{"tired"});
    states.emplace_back("Enrolled, paused", Session() << SittingStarted{} << Paused{});
    states.emplace_back("PlacingTray, paused", atFirstTray().choose() << Paused{});
    states.emplace_back("OnBreak, paused", atFirstTray().choose().choose().choose() << Paused{});
    states.emplace_back("PlacingTray, sitting 2", atFirstTray().choose() << SittingStarted{});
    states.emplace_back("paused, sitting 2", atFirstTray().choose() << Paused{} << SittingStarted{});
    return states;
}

/// The participant's number for the present place, this far off.
ScalePlaced placed(const Session& session, int tenthsOff)
{
    const Tenths shown = *placeToName(session.plan(), session.state());
    // Where the number would leave the scale, the error goes the other way.
    const bool fits = protocols::RatingScale{}.holds({shown.value + tenthsOff});
    return {shown, {shown.value + (fits ? tenthsOff : -tenthsOff)}};
}

/// The first two letters of the next stage, p if paused; "." if refused.
std::string cell(const Session& session, EventBody body)
{
    const Plan& plan = session.plan();
    if (auto* placed = std::get_if<ScalePlaced>(&body))
        if (const auto place = placeToName(plan, session.state())) placed->shown = *place;
    const auto* presenting = std::get_if<Presenting>(&session.state().stage);
    if (std::holds_alternative<Answered>(body) && presenting && presenting->index >= 4) body = Answered{Tenths{54}};
    const auto outcome = apply(plan, session.state(), {body, 1});
    if (std::holds_alternative<Refusal>(outcome)) return ".";
    const State& next = std::get<SessionStep>(outcome).next;
    return nameOf(next).substr(0, 2) + (next.paused ? "p" : "");
}

std::string printedGrid()
{
    const std::vector<EventBody> events = {SittingStarted{},
                                           Begun{},
                                           Consented{},
                                           FactsGiven{},
                                           FamiliarisationShown{1},
                                           FamiliarisationDone{},
                                           ScalePlaced{},
                                           ScaleTrainingDone{},
                                           ChecklistDone{},
                                           SittingPrepared{},
                                           TrayReady{},
                                           Touched{},
                                           Answered{FabricId("F02")},
                                           Corrected{QuestionId("Q1"), FabricId("F03"), "misheard"},
                                           Voided{"wrong swatch"},
                                           BreakEnded{},
                                           Paused{},
                                           Resumed{},
                                           WithdrawnEvent{"tired"},
                                           Noted{"a remark", false},
                                           Debriefed{"all well"}};
    std::ostringstream grid;
    for (const auto& [name, session] : gridStates()) {
        std::string line;
        std::ostringstream row;
        row << std::left << std::setw(24) << name;
        for (const EventBody& body : events) row << std::setw(5) << cell(session, body);
        line = row.str();
        grid << line.substr(0, line.find_last_not_of(' ') + 1) << "\n";
    }
    return grid.str();
}

//                      sitt begu cons fact fsho fami spla scal chec prep tray touc answ corr void brea paus resu with note debr
const char* const drawnGrid =
    "Enrolled                En   Co   .    .    .    .    .    .    .    .    .    .    .    .    .    .    Enp  .    Wi   En   "
    ".\n"
    "Consenting              Co   .    As   .    .    .    .    .    .    .    .    .    .    .    .    .    Cop  .    Wi   Co   "
    ".\n"
    "AskingFacts             As   .    .    Fa   .    .    .    .    .    .    .    .    .    .    .    .    Asp  .    Wi   As   "
    ".\n"
    "Familiarising           Fa   .    .    .    Fa   Sc   .    .    .    .    .    .    .    .    .    .    Fap  .    Wi   Fa   "
    ".\n"
    "ScaleTraining           Sc   .    .    .    .    .    Sc   Ch   .    .    .    .    .    .    .    .    Scp  .    Wi   Sc   "
    ".\n"
    "CheckingList            Ch   .    .    .    .    .    .    .    Pl   .    .    .    .    .    .    .    Chp  .    Wi   Ch   "
    ".\n"
    "PlacingTray, the first  Pl   .    .    .    .    .    .    .    .    .    Pr   .    .    .    .    .    Plp  .    Wi   Pl   "
    ".\n"
    "PlacingTray, the second Pl   .    .    .    .    .    .    .    .    .    Pr   .    .    Pl   Pl   .    Plp  .    Wi   Pl   "
    ".\n"
    "Presenting Q1           Pl   .    .    .    .    .    .    .    .    .    .    Pr   Pl   Pr   Pl   .    Plp  .    Wi   Pr   "
    ".\n"
    "Presenting Q2, touched  Pl   .    .    .    .    .    .    .    .    .    .    .    Pr   Pr   Pl   .    Plp  .    Wi   Pr   "
    ".\n"
    "Presenting Q3           Pl   .    .    .    .    .    .    .    .    .    .    Pr   Pl   Pr   Pl   .    Plp  .    Wi   Pr   "
    ".\n"
    "OnBreak                 On   .    .    .    .    .    .    .    .    .    .    .    .    On   On   Pl   Onp  .    Wi   On   "
    ".\n"
    "Debriefing              De   .    .    .    .    .    .    .    .    .    .    .    .    De   Pl   .    Dep  .    Wi   De   "
    "Fi\n"
    "Finished                Fi   .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    Wi   Fi   "
    ".\n"
    "Withdrawn               Wi   .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    Wi   "
    ".\n"
    "Enrolled, paused        Enp  .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    .    En   Wi   Enp  "
    ".\n"
    "PlacingTray, paused     Plp  .    .    .    .    .    .    .    .    .    .    .    .    Plp  .    .    .    Pl   Wi   Plp  "
    ".\n"
    "OnBreak, paused         Onp  .    .    .    .    .    .    .    .    .    .    .    .    Onp  .    .    .    On   Wi   Onp  "
    ".\n"
    "PlacingTray, sitting 2  Pl   .    .    .    .    .    .    .    .    Sc   Pr   .    .    Pl   Pl   .    Plp  .    Wi   Pl   "
    ".\n"
    "paused, sitting 2       Plp  .    .    .    .    .    .    .    .    Sc   .    .    .    Plp  .    .    .    Pl   Wi   Plp  "
    ".\n";

}  // namespace

class SessionTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theGridOfStatesAndEventsIsTheDrawnOne()
    {
        const std::string grid = printedGrid();
        if (grid != drawnGrid) std::cout << grid;
        QCOMPARE(QString::fromStdString(grid).split('\n'), QString(drawnGrid).split('\n'));
    }

    void aWholeSessionRunsThroughItsBreaksToTheEnd()
    {
        Session session = finished();
        QCOMPARE(session.name(), std::string("Finished"));
        QCOMPARE(session.state().answersStored, 4 + 6);
        QCOMPARE(session.state().position, 7);
        QCOMPARE(debriefing().effects(), std::vector<Effect>{ClearDisplay{}});
    }

    void aConfirmedTrayShowsItsStimulusAndReadsTheNextAhead()
    {
        Session session = atFirstTray();
        QCOMPARE(session.effects(), std::vector<Effect>{Prefetch{SealedCode("file1")}});
        session << TrayReady{};
        QCOMPARE(session.effects(), (std::vector<Effect>{ShowStimulus{SealedCode("file1")}, Prefetch{SealedCode("file2")}}));
        session << Answered{FabricId("F02")};
        QCOMPARE(session.effects(), (std::vector<Effect>{ClearDisplay{}, Prefetch{SealedCode("file2")}}));
    }

    void laterQuestionsAreReadyWhenTheOneBeforeIsAnswered()
    {
        Session session = atFirstRating() << Touched{};
        QVERIFY(std::get<Presenting>(session.state().stage).touchedAtNs.has_value());
        session.rate(54);
        const Presenting second = std::get<Presenting>(session.state().stage);
        QCOMPARE(second.question, 1);
        QVERIFY(!second.touchedAtNs.has_value());
        const std::int64_t answeredAt = second.readyAtNs;
        session << Touched{};
        QCOMPARE(*std::get<Presenting>(session.state().stage).touchedAtNs, answeredAt + oneSecondNs);
        QVERIFY(session.refusalOf(Touched{}).contains("already"));
    }

    void aKeyThatBouncesArmsNoPresentation()
    {
        Session session = Session() << SittingStarted{700000000} << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{};
        session.choose();
        QCOMPARE(session.name(), std::string("PlacingTray"));
        QVERIFY(session.refusalOf(TrayReady{}).contains("only just"));
        session << TrayReady{};  // a second later
        QCOMPARE(session.name(), std::string("Presenting"));
        session << Answered{FabricId("F01")} << Paused{} << Resumed{};
        QVERIFY(session.refusalOf(TrayReady{}).contains("only just"));
    }

    void everyPieceOnTheTrayIsConfirmed()
    {
        Plan plan = smallPlan();
        plan.protocol.confirmPieces = true;
        plan.fabricNames = {{FabricId("F01"), "795"}, {FabricId("F02"), "829"}, {FabricId("F03"), "663"}};
        Session session = Session(plan) << SittingStarted{} << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{};
        QCOMPARE(session.refusalOf(TrayReady{}), QString("The piece in slot A is not confirmed. It must be 795."));
        QCOMPARE(session.refusalOf(TrayReady{{"795", "663", "829"}}), QString("Slot B holds 663. It must be 829."));
        QCOMPARE(session.refusalOf(TrayReady{{"795", "829", "663", "795"}}),
                 QString("More pieces were confirmed than the tray has slots."));
        const TrayReady right{{"795", "829", "663"}};
        session << right;
        QCOMPARE(session.name(), std::string("Presenting"));
        QCOMPARE(std::get<TrayReady>(eventFromRecord("tray_ready", payloadJson(right))).pieces, right.pieces);
        QCOMPARE(trayReadyOf(plan.protocol, plan.trials[0].alternatives, plan.fabricNames).pieces, right.pieces);
    }

    void anImpossibleAnswerIsRefusedWithItsReason_data()
    {
        QTest::addColumn<bool>("rating");
        QTest::addColumn<QString>("given");
        QTest::addColumn<QString>("reason");
        QTest::newRow("not on the tray") << false << "F09"
                                         << "F09 is not on the tray (F01, F02, F03).";
        QTest::newRow("a number for a choice") << false << "54"
                                               << "Q1 asks for one of the fabrics on the tray, not for a number on the scale.";
        QTest::newRow("a fabric for a number") << true << "F01"
                                               << "Q2 asks for a number on the scale, not for one of the fabrics on the tray.";
        QTest::newRow("above the scale") << true << "101"
                                         << "10.1 is not on the scale: from 0 to 10 in steps of 0.1.";
        QTest::newRow("below the scale") << true << "-3"
                                         << "-0.3 is not on the scale: from 0 to 10 in steps of 0.1.";
    }

    void anImpossibleAnswerIsRefusedWithItsReason()
    {
        QFETCH(bool, rating);
        QFETCH(QString, given);
        QFETCH(QString, reason);
        Session session = rating ? atFirstRating() : atFirstTray() << TrayReady{};
        bool isNumber = false;
        const int tenths = given.toInt(&isNumber);
        const GivenAnswer response = isNumber ? GivenAnswer(Tenths{tenths}) : GivenAnswer(FabricId(given.toStdString()));
        QCOMPARE(session.refusalOf(Answered{response}), reason);
    }

    void pausedSessionRepeatsTheInterruptedTrial()
    {
        Session session = atFirstTray().choose() << TrayReady{} << Touched{} << Paused{};
        QCOMPARE(session.effects(), std::vector<Effect>{ClearDisplay{}});
        QVERIFY(session.refusalOf(Answered{FabricId("F01")}).contains("paused"));
        session << Resumed{};
        QCOMPARE(session.name(), std::string("PlacingTray"));
        QCOMPARE(session.index(), 1);
        session << TrayReady{};
        QVERIFY(!std::get<Presenting>(session.state().stage).touchedAtNs.has_value());
    }

    void anInterruptedPresentationGoesOnAtItsNextUnansweredQuestion_data()
    {
        QTest::addColumn<bool>("crashed");
        QTest::newRow("paused and resumed") << false;
        QTest::newRow("a new sitting") << true;
    }

    void anInterruptedPresentationGoesOnAtItsNextUnansweredQuestion()
    {
        QFETCH(bool, crashed);
        Session session = atFirstRating().rate(54);
        if (crashed)
            session << SittingStarted{};
        else
            session << Paused{} << Resumed{};
        QCOMPARE(session.state().sitting, crashed ? 2 : 1);
        QCOMPARE(session.index(), 4);
        session << TrayReady{};
        QCOMPARE(std::get<Presenting>(session.state().stage).question, 1);
        QCOMPARE(session.state().answers.back().response, GivenAnswer(Tenths{54}));
        session.rate(60);
        QCOMPARE(session.index(), 5);
    }

    void aPauseOutlivesTheSitting()
    {
        Session session = atFirstTray() << Paused{} << SittingStarted{};
        QCOMPARE(session.name(), std::string("PlacingTray (paused)"));
    }

    void aCorrectionChangesTheLatestAnswerToThatQuestion()
    {
        Session session = atFirstRating().rate(54).rate(60);
        session << Corrected{QuestionId("Q2"), Tenths{40}, "misheard"};
        const auto& answers = session.state().answers;
        QCOMPARE(answers[answers.size() - 2].response, GivenAnswer(Tenths{40}));
        QCOMPARE(answers.back().response, GivenAnswer(Tenths{60}));
        QCOMPARE(session.state().answersStored, 6);
        QVERIFY(session.refusalOf(Corrected{QuestionId("Q3"), Tenths{101}, ""}).contains("not on the scale"));
        QVERIFY(session.refusalOf(Corrected{QuestionId("Q9"), Tenths{10}, ""}).contains("no answer to Q9"));
        session << Corrected{QuestionId("Q1"), FabricId("F03"), "far back"};
        QCOMPARE(session.state().answers[3].response, GivenAnswer(FabricId("F03")));
    }

    /// A finished participant's answers count in the means of a blinded report, so they stay. Logs of 0.5.0 may hold a
    /// correction.
    void aFinishedSessionTakesNoCorrectionButItsLogMay()
    {
        const Corrected correction{QuestionId("Q3"), Tenths{70}, "misheard"};
        Session session = debriefing() << correction;
        QCOMPARE(session.state().answers.back().response, GivenAnswer(Tenths{70}));
        session = finished();
        QCOMPARE(session.refusalOf(correction),
                 QString("The session is finished. Answers can be corrected until the debriefing is stored."));
        const auto replayed = apply(session.plan(), session.state(), {correction, 0, EventSource::Log});
        QVERIFY(std::holds_alternative<SessionStep>(replayed));
        QCOMPARE(std::get<SessionStep>(replayed).next.answers.back().response, GivenAnswer(Tenths{70}));
    }

    void aVoidPresentationComesAgainAtTheEndOfItsBlock()
    {
        Session session = atFirstTray() << TrayReady{} << Voided{"wrong swatch"};
        QCOMPARE(session.order(), (std::vector<int>{0, 1, 2, 0, 3, 4, 5, 6}));
        QCOMPARE(session.index(), 1);
        QCOMPARE(session.effects(), (std::vector<Effect>{ClearDisplay{}, Prefetch{SealedCode("file2")}}));
        session.choose();
        session << Voided{"seen by the participant"};
        QCOMPARE(session.order(), (std::vector<int>{0, 1, 2, 0, 1, 3, 4, 5, 6}));
        QCOMPARE(session.index(), 2);
        QVERIFY(session.state().answers.empty());
        QCOMPARE(session.state().answersStored, 1);
        QVERIFY(session.refusalOf(Voided{"again"}).contains("void already"));
        session.choose().choose().choose();
        QCOMPARE(session.name(), std::string("OnBreak"));
        QCOMPARE(session.index(), 3);
    }

    void aPresentationVoidedWhenItsBlockIsOverComesAtTheEndOfTheNext()
    {
        Session session = atFirstTray().choose().choose().choose() << Voided{"wrong swatch"};
        QCOMPARE(session.order(), (std::vector<int>{0, 1, 2, 3, 2, 4, 5, 6}));
        (session << BreakEnded{}).choose();
        QCOMPARE(session.name(), std::string("PlacingTray"));
        QCOMPARE(session.index(), 2);
        session.choose();
        QCOMPARE(session.name(), std::string("OnBreak"));
    }

    void theLastPresentationCanBeVoidedAtTheDebriefing()
    {
        Session session = debriefing() << Voided{"wrong swatch"};
        QCOMPARE(session.name(), std::string("PlacingTray"));
        (session << TrayReady{}).rate(30).rate(40);
        QCOMPARE(session.name(), std::string("Debriefing"));
        QCOMPARE(session.state().answers.size(), 4u + 6u);
    }

    void aBreakIsDueByTimeToo()
    {
        Plan plan = smallPlan();
        plan.protocol.breakAfterMinutes = 5;
        plan.protocol.breakAfterPresentations = 100;
        Session session(plan);
        session << SittingStarted{} << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{};
        session.choose();
        QCOMPARE(session.name(), std::string("PlacingTray"));
        session.waitMinutes(5);
        session.choose();
        QCOMPARE(std::get<OnBreak>(session.state().stage).reason, BreakReason::Time);
        (session << BreakEnded{}).choose();
        QCOMPARE(session.name(), std::string("PlacingTray"));
    }

    void theEndOfASittingIsToldOnce()
    {
        Plan plan = smallPlan();
        plan.protocol.sittingMinutes = 60;
        Session session(plan);
        session << SittingStarted{} << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{};
        session.waitMinutes(60);
        session.choose();
        QCOMPARE(std::get<OnBreak>(session.state().stage).reason, BreakReason::SittingOver);
        (session << BreakEnded{}).choose();
        QCOMPARE(session.name(), std::string("PlacingTray"));
    }

    void aBreakAtTheEndOfASittingIsAnotherOneInTheNextSitting_data()
    {
        QTest::addColumn<bool>("endsAPhase");
        QTest::newRow("within a phase") << false;
        QTest::newRow("between two phases") << true;
    }
    void aBreakAtTheEndOfASittingIsAnotherOneInTheNextSitting()
    {
        QFETCH(const bool, endsAPhase);
        Plan plan = smallPlan();
        plan.protocol.sittingMinutes = 60;
        Session session(plan);
        session << SittingStarted{} << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{};
        if (endsAPhase) session.choose().choose().choose() << BreakEnded{};
        session.waitMinutes(60);
        session.choose();
        const auto reason = [&] { return std::get<OnBreak>(session.state().stage).reason; };
        const auto beginsPhase = [&] {
            return viewOf(session.plan(), session.state(), protocols::ParticipantId("P01"), 0).phaseBegins;
        };
        QCOMPARE(reason(), BreakReason::SittingOver);
        QCOMPARE(beginsPhase(), endsAPhase);
        session << Paused{} << Resumed{};
        QCOMPARE(reason(), BreakReason::SittingOver);  // it is the same sitting
        session << Paused{} << SittingStarted{};
        QCOMPARE(reason(), endsAPhase ? BreakReason::Phase : BreakReason::Block);
        QCOMPARE(beginsPhase(), endsAPhase);
    }

    void newQuestionsBeginOnceAfterTheLastOfTheOldOnes()
    {
        Session session = atFirstTray();
        const auto beginsPhase = [&] {
            return viewOf(session.plan(), session.state(), protocols::ParticipantId("P01"), 0).phaseBegins;
        };
        QVERIFY(!beginsPhase());
        session.choose().choose().choose() << BreakEnded{};
        session.choose();
        QVERIFY(beginsPhase());
        session << Voided{"wrong swatch"};  // one of the old questions comes back
        QVERIFY(!beginsPhase());
        (session << BreakEnded{}).choose() << BreakEnded{};
        QVERIFY(beginsPhase());
        session << TrayReady{} << Answered{Tenths{50}} << Paused{} << Resumed{};
        QVERIFY(!beginsPhase());  // they are known by now
    }

    void aLaterSittingBeginsWithTheRefresherAndTheChecklist()
    {
        Session session = familiarising() << FamiliarisationDone{} << ScaleTrainingDone{}
                                          << ChecklistDone{{"The mask is on"}, {}};
        QVERIFY(session.refusalOf(SittingPrepared{}).contains("prepared already"));
        session.choose();
        session << Paused{} << SittingStarted{} << SittingPrepared{};
        QVERIFY(std::get<ScaleTraining>(session.state().stage).isRefresher);
        // One place is enough if it is right, and the operator may end the training at any time.
        session << placed(session, 60);
        QVERIFY(placeToName(session.plan(), session.state()));
        session << placed(session, 0);
        QVERIFY(!placeToName(session.plan(), session.state()));
        session << ScaleTrainingDone{};
        QCOMPARE(session.name(), std::string("CheckingList"));
        session << ChecklistDone{};
        QCOMPARE(session.name(), std::string("PlacingTray"));
        QCOMPARE(session.index(), 1);
    }

    void familiarisationShowsItsOwnImages()
    {
        Session session = familiarising() << FamiliarisationShown{1};
        QCOMPARE(session.effects(), std::vector<Effect>{ShowStimulus{SealedCode("fam2")}});
        QVERIFY(!session.refusalOf(FamiliarisationShown{2}).isEmpty());
        session << FamiliarisationDone{};
        QCOMPARE(session.effects(), std::vector<Effect>{ClearDisplay{}});
    }

    void placesAreNamedUntilThreeAreRightInARow()
    {
        Session session = familiarising() << FamiliarisationDone{};
        const auto inARow = [&] { return std::get<ScaleTraining>(session.state().stage).rightInARow; };
        const Tenths first = *placeToName(session.plan(), session.state());
        QVERIFY(protocols::RatingScale{}.holds(first));
        QVERIFY(!session.refusalOf(ScalePlaced{{first.value + 1}, {50}}).isEmpty());
        session << placed(session, 0) << placed(session, 5);
        QCOMPARE(inARow(), 2);
        session << placed(session, -6);  // more than a twentieth of the line
        QCOMPARE(inARow(), 0);
        const auto last = std::get<ScaleTraining>(session.state().stage).last;
        QVERIFY(last && !last->isRight && last->named.value == last->shown.value - 6);
        std::set<int> asked;
        for (int right = 1; right <= 3; ++right) {
            asked.insert(placeToName(session.plan(), session.state())->value);
            session << placed(session, 0);
            QCOMPARE(inARow(), right);
        }
        QCOMPARE(asked.size(), std::size_t(3));
        QVERIFY(!placeToName(session.plan(), session.state()));
        QVERIFY(!session.refusalOf(ScalePlaced{first, first}).isEmpty());
        session << ScaleTrainingDone{};
        QCOMPARE(session.name(), std::string("CheckingList"));
    }

    void onAScaleWithWordsOnlyTheSameStepIsRight()
    {
        const protocols::RatingScale likert{Tenths{10}, Tenths{70}, Tenths{10}, 6, {}};
        QVERIFY(isRightPlace(likert, Tenths{30}, Tenths{30}));
        QVERIFY(!isRightPlace(likert, Tenths{30}, Tenths{40}));
    }

    void theClockOfABreakRunsFromItsBeginning()
    {
        Session session = atFirstTray().choose().choose().choose();
        const auto secondsAt = [&](std::int64_t ns) {
            return viewOf(session.plan(), session.state(), protocols::ParticipantId("P01"), ns).breakSeconds;
        };
        const std::int64_t began = session.state().breakBeganAtNs;
        QCOMPARE(secondsAt(began + 90'500'000'000), 90.5);
        session << Voided{"wrong swatch"};  // another tray may be next, but the break goes on
        QCOMPARE(secondsAt(began + 90'500'000'000), 90.5);
        session << BreakEnded{};
        QCOMPARE(secondsAt(began + 90'500'000'000), 0.0);
    }

    void questionsMayBeAnsweredBySameOrDifferentAndInWords()
    {
        Plan plan = smallPlan();
        protocols::Phase same;
        same.task = protocols::SameDifferent{};
        same.questions = {{QuestionId("S1"), "The same?", same.task},
                          {QuestionId("N1"), "What was it like?", protocols::FreeText{}}};
        plan.protocol.phases = {same};
        plan.trials.resize(1);
        plan.trials[0].alternatives.resize(1);
        Session session(plan);
        session << SittingStarted{} << Begun{} << FamiliarisationDone{} << TrayReady{};
        QCOMPARE(session.refusalOf(Answered{FabricId("F01")}),
                 QString("S1 asks for same or different, not for one of the fabrics on the tray."));
        session << Answered{Sameness{true}};
        QCOMPARE(session.refusalOf(Answered{Sameness{true}}), QString("N1 asks for words, not for same or different."));
        session << Answered{Words{"like felt"}};
        QCOMPARE(session.name(), std::string("Debriefing"));
        QCOMPARE(textOf(session.state().answers[0].response), std::string("same"));
        QCOMPARE(textOf(session.state().answers[1].response), std::string("like felt"));
    }

    void voidingTheLastOfAPhaseOnTheBreakBringsItBackAfterTheBreak()
    {
        Session session = atFirstTray();
        session.choose().choose().choose();
        session << BreakEnded{};
        session.choose();
        QCOMPARE(session.name(), std::string("OnBreak"));
        QCOMPARE(session.index(), 4);
        session << Voided{"wrong swatch"};
        QCOMPARE(session.index(), 3);
        (session << BreakEnded{}).choose();
        QCOMPARE(session.index(), 4);
        QCOMPARE(session.name(), std::string("OnBreak"));
    }

    void aPresentationVoidedBetweenItsQuestionsLosesTheAnswersItHad()
    {
        Session session = atFirstRating().rate(54);
        session << Voided{"noise"};
        QCOMPARE(session.state().answers.size(), 4u);
        QCOMPARE(session.index(), 5);
        (session << TrayReady{}).rate(1).rate(2);
        (session << TrayReady{}).rate(3).rate(4);
        QCOMPARE(session.index(), 4);
        session << TrayReady{};
        QCOMPARE(std::get<Presenting>(session.state().stage).question, 0);
        session.rate(5).rate(6);
        QCOMPARE(session.name(), std::string("Debriefing"));
        QCOMPARE(session.state().answers.size(), 4u + 6u);
    }

    void eventsSurviveTheLog_data()
    {
        QTest::addColumn<QString>("payload");
        QTest::newRow("sitting_started") << "{}";
        QTest::newRow("begun") << "{}";
        QTest::newRow("familiarisation_done") << "{}";
        QTest::newRow("scale_training_done") << "{}";
        QTest::newRow("tray_ready") << "{}";
        QTest::newRow("consented") << "{}";
        QTest::newRow("facts_given") << R"({"given":["age","gender"]})";
        QTest::newRow("familiarisation_shown") << R"({"item":1})";
        QTest::newRow("scale_placed") << R"({"shown":25,"spoken":30})";
        QTest::newRow("checklist_done") << R"({"ticked":["The mask is on"],"readings":{"humidity":"41 %"}})";
        QTest::newRow("sitting_prepared") << "{}";
        QTest::newRow("debriefed") << "{}";
        QTest::newRow("touched") << R"({"by":"operator"})";
        QTest::newRow("answered") << R"({"fabric":"F01"})";
        QTest::newRow("corrected") << R"({"question":"Q2","tenths":54,"why":"misheard: 5, not 9"})";
        QTest::newRow("voided") << R"({"why":"wrong swatch"})";
        QTest::newRow("break_ended") << "{}";
        QTest::newRow("paused") << "{}";
        QTest::newRow("resumed") << "{}";
        QTest::newRow("withdrawn") << R"({"why":""})";
        QTest::newRow("noted") << R"({"text":"zwölf µm"})";
    }

    void eventsSurviveTheLog()
    {
        QFETCH(QString, payload);
        const EventBody body = eventFromRecord(QTest::currentDataTag(), payload.toStdString());
        QCOMPARE(kindOf(body), std::string(QTest::currentDataTag()));
        QCOMPARE(QString::fromStdString(payloadJson(body)), payload);
    }

    void whatIsPersonalStaysOutOfTheLog()
    {
        QCOMPARE(payloadJson(FactsGiven{{{"age", "24"}}}), std::string(R"({"given":["age"]})"));
        QCOMPARE(payloadJson(Debriefed{"I have arthritis"}), std::string("{}"));
    }

    void whatCannotBeReadFromTheLogIsAnError()
    {
        QVERIFY_EXCEPTION_THROWN(eventFromRecord("teleported", "{}"), std::exception);
        QVERIFY_EXCEPTION_THROWN(eventFromRecord("answered", "{}"), std::exception);
        QVERIFY_EXCEPTION_THROWN(eventFromRecord("noted", "{"), std::exception);
    }
};

QTEST_GUILESS_MAIN(SessionTest)
#include "session_test.moc"
