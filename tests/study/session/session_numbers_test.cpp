// Every number of a session's state after every event: times, counts, order, attempts, blocks, breaks, sittings. Times are in
// nanoseconds from small distinct numbers, so that no other sum or difference gives the same digits.
#include <QTest>
#include <sstream>

#include "study/session/session_moves.h"
#include "study/session/session_record.h"

using namespace study::session;
using protocols::FabricId;
using protocols::QuestionId;
using protocols::SealedCode;
using protocols::Tenths;

namespace {

constexpr std::int64_t minute = 60'000'000'000;

/// Four choices among three fabrics, then three presentations with two ratings each; a break after three.
Plan smallPlan()
{
    Plan plan;
    const std::vector<FabricId> fabrics{FabricId("F01"), FabricId("F02"), FabricId("F03")};
    plan.protocol.breakAfterPresentations = 3;
    plan.protocol.secondsPerPresentation = 24;
    protocols::Phase choice, rating;
    choice.task = protocols::ForcedChoice{3};
    choice.questions = {{QuestionId("Q1"), "Which?", choice.task}};
    rating.task = protocols::Rating{};
    rating.questions = {{QuestionId("Q2"), "How slippery?", rating.task}, {QuestionId("Q3"), "How textured?", rating.task}};
    plan.protocol.phases = {choice, rating};
    for (int number = 1; number <= 7; ++number) {
        const bool isChoice = number <= 4;
        const std::string digit = std::to_string(number);
        plan.trials.push_back({{number},
                               isChoice ? 0 : 1,
                               SealedCode("file" + digit),
                               protocols::PresentationCode("COD" + digit),
                               isChoice ? fabrics : std::vector<FabricId>{fabrics[2]}});
    }
    plan.fabricNames = {{fabrics[0], "501"}, {fabrics[1], "502"}, {fabrics[2], "503"}};
    plan.familiarisation = {{"jersey", SealedCode("fam1")}, {"velvet", SealedCode("fam2")}};
    return plan;
}

std::string written(const Stage& stage)
{
    std::ostringstream text;
    std::visit(protocols::Overloaded{
                   [&](const Familiarising& at) { text << " shown " << (at.shown ? std::to_string(*at.shown) : "-"); },
                   [&](const ScaleTraining& at) { text << " placed " << at.placed << (at.isRefresher ? " refresher" : ""); },
                   [&](const PlacingTray& at) { text << " " << at.index; },
                   [&](const Presenting& at) {
                       text << " " << at.index << "." << at.question << " ready " << at.readyAtNs << " touched "
                            << (at.touchedAtNs ? std::to_string(*at.touchedAtNs) : "-")
                            << (at.touchedBy == TouchSource::Display ? " by display" : "");
                   },
                   [&](const OnBreak& at) {
                       const char* const reasons[] = {"block", "phase", "time", "sitting over"};
                       text << " " << at.nextIndex << " " << reasons[static_cast<int>(at.reason)];
                   },
                   [&](const Withdrawn& at) { text << " " << at.why; },
                   [](const auto&) {},
               },
               stage);
    return text.str();
}

std::string written(const Effect& effect)
{
    return std::visit(protocols::Overloaded{[](const ShowStimulus& show) { return "show " + show.code.value; },
                                            [](const ClearDisplay&) { return std::string("clear"); },
                                            [](const Prefetch& ahead) { return "prefetch " + ahead.code.value; }},
                      effect);
}

/// "0/0 1/0 …": trials in the order of presentation, each with its block.
std::string writtenOrder(const State& state)
{
    std::string text;
    for (const PlaceInOrder& place : state.order) text += " " + std::to_string(place.index) + "/" + std::to_string(place.block);
    return text;
}

std::string writtenAnswers(const State& state)
{
    std::string text;
    for (const StoredAnswer& answer : state.answers)
        text += " " + std::to_string(answer.index) + "." + std::to_string(answer.question) + "=" + textOf(answer.response);
    return text;
}

/// Plays events that must be accepted and writes down what each of them changes.
class Transcript {
public:
    explicit Transcript(Plan plan) : m_plan(std::move(plan)) {}

    Transcript& at(std::int64_t ns, const EventBody& body)
    {
        auto outcome = apply(m_plan, m_state, {body, ns});
        if (const auto* refusal = std::get_if<Refusal>(&outcome))
            qFatal("%s in %s: %s", kindOf(body).c_str(), nameOf(m_state).c_str(), refusal->reason.c_str());
        const State before = m_state;
        m_state = std::get<SessionStep>(outcome).next;
        m_lines << QString::fromStdString(lineOf(body, ns, std::get<SessionStep>(outcome).effects));
        if (m_state.order != before.order) m_lines << QString::fromStdString("  order" + writtenOrder(m_state));
        if (m_state.answers != before.answers) m_lines << QString::fromStdString("  answers" + writtenAnswers(m_state));
        if (m_state.pace != before.pace)
            m_lines << QString("  pace %1: %2")
                           .arg(m_state.pace.back().phase)
                           .arg(m_state.pace.back().trayNs + m_state.pace.back().answersNs);
        return *this;
    }

    const Plan& plan() const { return m_plan; }
    const State& state() const { return m_state; }
    QStringList lines() const { return m_lines; }

private:
    std::string lineOf(const EventBody& body, std::int64_t ns, const std::vector<Effect>& effects) const
    {
        std::ostringstream text;
        text << ns << " " << kindOf(body) << ": " << nameOf(m_state) << written(m_state.stage) << " | @" << m_state.position
             << " stored " << m_state.answersStored << " | sitting " << m_state.sitting << " prepared " << m_state.preparedSitting
             << (m_state.sittingOverTold ? " over" : "") << " began " << m_state.sittingBeganAtNs << " rested "
             << m_state.restedAtNs << " tray " << m_state.trayAskedAtNs;
        for (std::size_t i = 0; i < effects.size(); ++i) text << (i == 0 ? " | " : ", ") << written(effects[i]);
        return text.str();
    }

    Plan m_plan;
    State m_state;
    QStringList m_lines;
};

/// A session that begins, with its preparation done, at 11 ns; the first tray is asked for at 11 ns.
Transcript begun(Plan plan)
{
    Transcript session(std::move(plan));
    session.at(3, SittingStarted{}).at(5, Begun{}).at(7, FamiliarisationDone{}).at(11, ScaleTrainingDone{});
    return session;
}

void compare(const QStringList& lines, const char* drawn)
{
    QStringList expected = QString::fromUtf8(drawn).split('\n', Qt::SkipEmptyParts);
    if (lines != expected) fprintf(stdout, "%s\n", qPrintable(lines.join('\n')));
    QCOMPARE(lines, expected);
}

}  // namespace

class SessionNumbersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyEventOfAPlainSession()
    {
        Transcript session(smallPlan());
        session.at(3, SittingStarted{}).at(5, Begun{});
        session.at(6, FamiliarisationShown{1}).at(7, FamiliarisationDone{});
        for (int place = 0; place < 3; ++place) session.at(8, ScalePlaced{*placeToName(session.plan(), session.state()), {50}});
        session.at(11, ScaleTrainingDone{});
        session.at(13, TrayReady{}).at(17, Touched{}).at(29, Answered{FabricId("F02")});
        session.at(31, TrayReady{}).at(41, Touched{TouchSource::Display, 4}).at(53, Answered{FabricId("F03")});
        session.at(59, TrayReady{}).at(71, Answered{FabricId("F01")});
        session.at(83, BreakEnded{});
        session.at(89, TrayReady{}).at(101, Answered{FabricId("F02")});
        session.at(113, BreakEnded{});
        session.at(127, TrayReady{}).at(131, Touched{TouchSource::Display, 40}).at(149, Answered{Tenths{54}});
        session.at(151, Touched{}).at(163, Answered{Tenths{5}});
        session.at(167, TrayReady{}).at(179, Answered{Tenths{100}}).at(191, Answered{Tenths{0}});
        session.at(193, TrayReady{}).at(197, Answered{Tenths{11}}).at(199, Corrected{QuestionId("Q2"), Tenths{12}, "misheard"});
        session.at(211, Answered{Tenths{13}}).at(223, Debriefed{"soft"});
        compare(session.lines(), R"(
3 sitting_started: Enrolled | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | clear
  order 0/0 1/0 2/0 3/1 4/2 5/2 6/2
5 begun: Familiarising shown - | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3
6 familiarisation_shown: Familiarising shown 1 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | show fam2
7 familiarisation_done: ScaleTraining placed 0 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | clear
8 scale_placed: ScaleTraining placed 1 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3
8 scale_placed: ScaleTraining placed 2 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3
8 scale_placed: ScaleTraining placed 3 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3
11 scale_training_done: PlacingTray 0 | @0 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 11 | prefetch file1
13 tray_ready: Presenting 0.0 ready 13 touched - | @0 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 11 | show file1, prefetch file2
17 touched: Presenting 0.0 ready 13 touched 17 | @0 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 11
29 answered: PlacingTray 1 | @1 stored 1 | sitting 1 prepared 1 began 3 rested 3 tray 29 | clear, prefetch file2
  answers 0.0=F02
  pace 0: 18
31 tray_ready: Presenting 1.0 ready 31 touched - | @1 stored 1 | sitting 1 prepared 1 began 3 rested 3 tray 29 | show file2, prefetch file3
41 touched: Presenting 1.0 ready 31 touched 37 by display | @1 stored 1 | sitting 1 prepared 1 began 3 rested 3 tray 29
53 answered: PlacingTray 2 | @2 stored 2 | sitting 1 prepared 1 began 3 rested 3 tray 53 | clear, prefetch file3
  answers 0.0=F02 1.0=F03
  pace 0: 24
59 tray_ready: Presenting 2.0 ready 59 touched - | @2 stored 2 | sitting 1 prepared 1 began 3 rested 3 tray 53 | show file3, prefetch file4
71 answered: OnBreak 3 block | @3 stored 3 | sitting 1 prepared 1 began 3 rested 3 tray 53 | clear
  answers 0.0=F02 1.0=F03 2.0=F01
  pace 0: 18
83 break_ended: PlacingTray 3 | @3 stored 3 | sitting 1 prepared 1 began 3 rested 83 tray 83 | prefetch file4
89 tray_ready: Presenting 3.0 ready 89 touched - | @3 stored 3 | sitting 1 prepared 1 began 3 rested 83 tray 83 | show file4, prefetch file5
101 answered: OnBreak 4 phase | @4 stored 4 | sitting 1 prepared 1 began 3 rested 83 tray 83 | clear
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02
  pace 0: 18
113 break_ended: PlacingTray 4 | @4 stored 4 | sitting 1 prepared 1 began 3 rested 113 tray 113 | prefetch file5
127 tray_ready: Presenting 4.0 ready 127 touched - | @4 stored 4 | sitting 1 prepared 1 began 3 rested 113 tray 113 | show file5, prefetch file6
131 touched: Presenting 4.0 ready 127 touched 127 by display | @4 stored 4 | sitting 1 prepared 1 began 3 rested 113 tray 113
149 answered: Presenting 4.1 ready 149 touched - | @4 stored 5 | sitting 1 prepared 1 began 3 rested 113 tray 113
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4
151 touched: Presenting 4.1 ready 149 touched 151 | @4 stored 5 | sitting 1 prepared 1 began 3 rested 113 tray 113
163 answered: PlacingTray 5 | @5 stored 6 | sitting 1 prepared 1 began 3 rested 113 tray 163 | clear, prefetch file6
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4 4.1=0.5
  pace 1: 50
167 tray_ready: Presenting 5.0 ready 167 touched - | @5 stored 6 | sitting 1 prepared 1 began 3 rested 113 tray 163 | show file6, prefetch file7
179 answered: Presenting 5.1 ready 179 touched - | @5 stored 7 | sitting 1 prepared 1 began 3 rested 113 tray 163
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4 4.1=0.5 5.0=10.0
191 answered: PlacingTray 6 | @6 stored 8 | sitting 1 prepared 1 began 3 rested 113 tray 191 | clear, prefetch file7
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4 4.1=0.5 5.0=10.0 5.1=0.0
  pace 1: 28
193 tray_ready: Presenting 6.0 ready 193 touched - | @6 stored 8 | sitting 1 prepared 1 began 3 rested 113 tray 191 | show file7
197 answered: Presenting 6.1 ready 197 touched - | @6 stored 9 | sitting 1 prepared 1 began 3 rested 113 tray 191
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4 4.1=0.5 5.0=10.0 5.1=0.0 6.0=1.1
199 corrected: Presenting 6.1 ready 197 touched - | @6 stored 9 | sitting 1 prepared 1 began 3 rested 113 tray 191
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4 4.1=0.5 5.0=10.0 5.1=0.0 6.0=1.2
211 answered: Debriefing | @7 stored 10 | sitting 1 prepared 1 began 3 rested 113 tray 191 | clear
  answers 0.0=F02 1.0=F03 2.0=F01 3.0=F02 4.0=5.4 4.1=0.5 5.0=10.0 5.1=0.0 6.0=1.2 6.1=1.3
  pace 1: 20
223 debriefed: Finished | @7 stored 10 | sitting 1 prepared 1 began 3 rested 113 tray 191
)");
    }

    void voidsLengthenTheOrderAndAttemptsCount()
    {
        Transcript session = begun(smallPlan());
        session.at(13, TrayReady{}).at(17, Voided{"wrong swatch"});
        session.at(19, TrayReady{}).at(23, Answered{FabricId("F01")}).at(29, Voided{"seen"});
        session.at(31, TrayReady{}).at(37, Answered{FabricId("F02")});
        session.at(41, TrayReady{}).at(43, Answered{FabricId("F03")});
        QCOMPARE(attemptAt(session.state(), 2), 1);
        QCOMPARE(attemptAt(session.state(), 3), 2);
        session.at(47, TrayReady{}).at(53, Answered{FabricId("F01")});
        session.at(59, Voided{"late"});
        session.at(61, BreakEnded{}).at(67, TrayReady{}).at(71, Answered{FabricId("F01")});
        session.at(73, TrayReady{}).at(79, Answered{FabricId("F02")});
        session.at(83, Voided{"late again"});
        session.at(89, BreakEnded{}).at(97, TrayReady{}).at(101, Answered{FabricId("F03")});
        for (int place = 0; place < static_cast<int>(session.state().order.size()); ++place)
            attempts << attemptAt(session.state(), place);
        session.at(103, BreakEnded{}).at(107, TrayReady{}).at(109, Answered{Tenths{1}}).at(113, Voided{"between questions"});
        session.at(127, TrayReady{})
            .at(131, Answered{Tenths{2}})
            .at(137, Paused{})
            .at(139, Resumed{})
            .at(149, Voided{"on the tray"});
        session.at(151, TrayReady{}).at(157, Answered{Tenths{3}}).at(163, Answered{Tenths{4}});
        session.at(167, TrayReady{}).at(173, Answered{Tenths{5}}).at(179, Answered{Tenths{6}});
        session.at(181, TrayReady{}).at(191, Answered{Tenths{7}}).at(193, Answered{Tenths{8}});
        session.at(197, Voided{"at the debriefing"})
            .at(199, TrayReady{})
            .at(211, Answered{Tenths{9}})
            .at(223, Answered{Tenths{10}});
        compare(session.lines(), R"(
3 sitting_started: Enrolled | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | clear
  order 0/0 1/0 2/0 3/1 4/2 5/2 6/2
5 begun: Familiarising shown - | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3
7 familiarisation_done: ScaleTraining placed 0 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | clear
11 scale_training_done: PlacingTray 0 | @0 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 11 | prefetch file1
13 tray_ready: Presenting 0.0 ready 13 touched - | @0 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 11 | show file1, prefetch file2
17 voided: PlacingTray 1 | @1 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 17 | clear, prefetch file2
  order 0/0 1/0 2/0 0/0 3/1 4/2 5/2 6/2
  pace 0: 6
19 tray_ready: Presenting 1.0 ready 19 touched - | @1 stored 0 | sitting 1 prepared 1 began 3 rested 3 tray 17 | show file2, prefetch file3
23 answered: PlacingTray 2 | @2 stored 1 | sitting 1 prepared 1 began 3 rested 3 tray 23 | clear, prefetch file3
  answers 1.0=F01
  pace 0: 6
29 voided: PlacingTray 2 | @2 stored 1 | sitting 1 prepared 1 began 3 rested 3 tray 29 | prefetch file3
  order 0/0 1/0 2/0 0/0 1/0 3/1 4/2 5/2 6/2
  answers
31 tray_ready: Presenting 2.0 ready 31 touched - | @2 stored 1 | sitting 1 prepared 1 began 3 rested 3 tray 29 | show file3, prefetch file1
37 answered: PlacingTray 0 | @3 stored 2 | sitting 1 prepared 1 began 3 rested 3 tray 37 | clear, prefetch file1
  answers 2.0=F02
  pace 0: 8
41 tray_ready: Presenting 0.0 ready 41 touched - | @3 stored 2 | sitting 1 prepared 1 began 3 rested 3 tray 37 | show file1, prefetch file2
43 answered: PlacingTray 1 | @4 stored 3 | sitting 1 prepared 1 began 3 rested 3 tray 43 | clear, prefetch file2
  answers 2.0=F02 0.0=F03
  pace 0: 6
47 tray_ready: Presenting 1.0 ready 47 touched - | @4 stored 3 | sitting 1 prepared 1 began 3 rested 3 tray 43 | show file2, prefetch file4
53 answered: OnBreak 3 block | @5 stored 4 | sitting 1 prepared 1 began 3 rested 3 tray 43 | clear
  answers 2.0=F02 0.0=F03 1.0=F01
  pace 0: 10
59 voided: OnBreak 3 block | @5 stored 4 | sitting 1 prepared 1 began 3 rested 3 tray 43
  order 0/0 1/0 2/0 0/0 1/0 3/1 1/1 4/2 5/2 6/2
  answers 2.0=F02 0.0=F03
61 break_ended: PlacingTray 3 | @5 stored 4 | sitting 1 prepared 1 began 3 rested 61 tray 61 | prefetch file4
67 tray_ready: Presenting 3.0 ready 67 touched - | @5 stored 4 | sitting 1 prepared 1 began 3 rested 61 tray 61 | show file4, prefetch file2
71 answered: PlacingTray 1 | @6 stored 5 | sitting 1 prepared 1 began 3 rested 61 tray 71 | clear, prefetch file2
  answers 2.0=F02 0.0=F03 3.0=F01
  pace 0: 10
73 tray_ready: Presenting 1.0 ready 73 touched - | @6 stored 5 | sitting 1 prepared 1 began 3 rested 61 tray 71 | show file2, prefetch file5
79 answered: OnBreak 4 phase | @7 stored 6 | sitting 1 prepared 1 began 3 rested 61 tray 71 | clear
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F02
  pace 0: 8
83 voided: OnBreak 1 phase | @7 stored 6 | sitting 1 prepared 1 began 3 rested 61 tray 71
  order 0/0 1/0 2/0 0/0 1/0 3/1 1/1 1/1 4/2 5/2 6/2
  answers 2.0=F02 0.0=F03 3.0=F01
89 break_ended: PlacingTray 1 | @7 stored 6 | sitting 1 prepared 1 began 3 rested 89 tray 89 | prefetch file2
97 tray_ready: Presenting 1.0 ready 97 touched - | @7 stored 6 | sitting 1 prepared 1 began 3 rested 89 tray 89 | show file2, prefetch file5
101 answered: OnBreak 4 phase | @8 stored 7 | sitting 1 prepared 1 began 3 rested 89 tray 89 | clear
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03
  pace 0: 12
103 break_ended: PlacingTray 4 | @8 stored 7 | sitting 1 prepared 1 began 3 rested 103 tray 103 | prefetch file5
107 tray_ready: Presenting 4.0 ready 107 touched - | @8 stored 7 | sitting 1 prepared 1 began 3 rested 103 tray 103 | show file5, prefetch file6
109 answered: Presenting 4.1 ready 109 touched - | @8 stored 8 | sitting 1 prepared 1 began 3 rested 103 tray 103
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 4.0=0.1
113 voided: PlacingTray 5 | @9 stored 8 | sitting 1 prepared 1 began 3 rested 103 tray 113 | clear, prefetch file6
  order 0/0 1/0 2/0 0/0 1/0 3/1 1/1 1/1 4/2 5/2 6/2 4/2
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03
  pace 1: 10
127 tray_ready: Presenting 5.0 ready 127 touched - | @9 stored 8 | sitting 1 prepared 1 began 3 rested 103 tray 113 | show file6, prefetch file7
131 answered: Presenting 5.1 ready 131 touched - | @9 stored 9 | sitting 1 prepared 1 began 3 rested 103 tray 113
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 5.0=0.2
137 paused: PlacingTray (paused) 5 | @9 stored 9 | sitting 1 prepared 1 began 3 rested 103 tray 113 | clear
139 resumed: PlacingTray 5 | @9 stored 9 | sitting 1 prepared 1 began 3 rested 139 tray 139 | prefetch file6
149 voided: PlacingTray 6 | @10 stored 9 | sitting 1 prepared 1 began 3 rested 139 tray 149 | clear, prefetch file7
  order 0/0 1/0 2/0 0/0 1/0 3/1 1/1 1/1 4/2 5/2 6/2 4/2 5/2
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03
  pace 1: 10
151 tray_ready: Presenting 6.0 ready 151 touched - | @10 stored 9 | sitting 1 prepared 1 began 3 rested 139 tray 149 | show file7, prefetch file5
157 answered: Presenting 6.1 ready 157 touched - | @10 stored 10 | sitting 1 prepared 1 began 3 rested 139 tray 149
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3
163 answered: PlacingTray 4 | @11 stored 11 | sitting 1 prepared 1 began 3 rested 139 tray 163 | clear, prefetch file5
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4
  pace 1: 14
167 tray_ready: Presenting 4.0 ready 167 touched - | @11 stored 11 | sitting 1 prepared 1 began 3 rested 139 tray 163 | show file5, prefetch file6
173 answered: Presenting 4.1 ready 173 touched - | @11 stored 12 | sitting 1 prepared 1 began 3 rested 139 tray 163
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5
179 answered: PlacingTray 5 | @12 stored 13 | sitting 1 prepared 1 began 3 rested 139 tray 179 | clear, prefetch file6
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5 4.1=0.6
  pace 1: 16
181 tray_ready: Presenting 5.0 ready 181 touched - | @12 stored 13 | sitting 1 prepared 1 began 3 rested 139 tray 179 | show file6
191 answered: Presenting 5.1 ready 191 touched - | @12 stored 14 | sitting 1 prepared 1 began 3 rested 139 tray 179
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5 4.1=0.6 5.0=0.7
193 answered: Debriefing | @13 stored 15 | sitting 1 prepared 1 began 3 rested 139 tray 179 | clear
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5 4.1=0.6 5.0=0.7 5.1=0.8
  pace 1: 14
197 voided: PlacingTray 5 | @13 stored 15 | sitting 1 prepared 1 began 3 rested 139 tray 197 | prefetch file6
  order 0/0 1/0 2/0 0/0 1/0 3/1 1/1 1/1 4/2 5/2 6/2 4/2 5/2 5/2
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5 4.1=0.6
199 tray_ready: Presenting 5.0 ready 199 touched - | @13 stored 15 | sitting 1 prepared 1 began 3 rested 139 tray 197 | show file6
211 answered: Presenting 5.1 ready 211 touched - | @13 stored 16 | sitting 1 prepared 1 began 3 rested 139 tray 197
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5 4.1=0.6 5.0=0.9
223 answered: Debriefing | @14 stored 17 | sitting 1 prepared 1 began 3 rested 139 tray 197 | clear
  answers 2.0=F02 0.0=F03 3.0=F01 1.0=F03 6.0=0.3 6.1=0.4 4.0=0.5 4.1=0.6 5.0=0.9 5.1=1.0
  pace 1: 26
)");
        QCOMPARE(attempts, (QList<int>{1, 1, 1, 2, 2, 1, 3, 4, 1, 1, 1}));
    }

    void pausesAndSittingsRestartTheClocks()
    {
        Plan plan = smallPlan();
        plan.protocol.breakAfterMinutes = 2;
        plan.protocol.sittingMinutes = 10;
        plan.protocol.checklist = {"The mask is on"};
        Transcript session(plan);
        session.at(3, SittingStarted{}).at(5, Begun{}).at(7, FamiliarisationShown{0}).at(8, Paused{}).at(9, Resumed{});
        session.at(10, FamiliarisationDone{}).at(11, ScaleTrainingDone{}).at(13, ChecklistDone{{"The mask is on"}, {}});
        // One nanosecond short of two minutes since the pause ended, then two minutes.
        session.at(17, TrayReady{}).at(2 * minute + 8, Answered{FabricId("F01")});
        session.at(2 * minute + 8, TrayReady{}).at(2 * minute + 9, Answered{FabricId("F02")});
        session.at(2 * minute + 13, BreakEnded{})
            .at(3 * minute, TrayReady{})
            .at(3 * minute + 1, Touched{})
            .at(3 * minute + 5, Paused{});
        session.at(4 * minute, Resumed{}).at(4 * minute + 1, TrayReady{}).at(6 * minute - 1, Answered{FabricId("F03")});
        session.at(6 * minute + 3, SittingStarted{}).at(6 * minute + 5, SittingPrepared{});
        session.at(6 * minute + 7, ScaleTrainingDone{}).at(6 * minute + 11, ChecklistDone{{}, {}});
        session.at(7 * minute, TrayReady{}).at(7 * minute + 1, Answered{FabricId("F01")});
        session.at(7 * minute + 13, Paused{}).at(8 * minute, Resumed{}).at(8 * minute + 17, BreakEnded{});
        session.at(9 * minute, TrayReady{}).at(9 * minute + 1, Answered{Tenths{1}});
        // One nanosecond short of ten minutes since the sitting began, then ten minutes.
        session.at(16 * minute + 2, Answered{Tenths{2}});
        session.at(16 * minute + 2, BreakEnded{}).at(16 * minute + 2, TrayReady{}).at(16 * minute + 3, Answered{Tenths{3}});
        session.at(16 * minute + 3, Answered{Tenths{4}}).at(16 * minute + 4, BreakEnded{}).at(17 * minute, TrayReady{});
        session.at(18 * minute, SittingStarted{}).at(30 * minute, WithdrawnEvent{"tired"});
        compare(session.lines(), R"(
3 sitting_started: Enrolled | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | clear
  order 0/0 1/0 2/0 3/1 4/2 5/2 6/2
5 begun: Familiarising shown - | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3
7 familiarisation_shown: Familiarising shown 0 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | show fam1
8 paused: Familiarising (paused) shown - | @0 stored 0 | sitting 1 prepared 0 began 3 rested 3 tray 3 | clear
9 resumed: Familiarising shown - | @0 stored 0 | sitting 1 prepared 0 began 3 rested 9 tray 3
10 familiarisation_done: ScaleTraining placed 0 | @0 stored 0 | sitting 1 prepared 0 began 3 rested 9 tray 3 | clear
11 scale_training_done: CheckingList | @0 stored 0 | sitting 1 prepared 0 began 3 rested 9 tray 3
13 checklist_done: PlacingTray 0 | @0 stored 0 | sitting 1 prepared 1 began 3 rested 9 tray 13 | prefetch file1
17 tray_ready: Presenting 0.0 ready 17 touched - | @0 stored 0 | sitting 1 prepared 1 began 3 rested 9 tray 13 | show file1, prefetch file2
120000000008 answered: PlacingTray 1 | @1 stored 1 | sitting 1 prepared 1 began 3 rested 9 tray 120000000008 | clear, prefetch file2
  answers 0.0=F01
  pace 0: 119999999995
120000000008 tray_ready: Presenting 1.0 ready 120000000008 touched - | @1 stored 1 | sitting 1 prepared 1 began 3 rested 9 tray 120000000008 | show file2, prefetch file3
120000000009 answered: OnBreak 2 time | @2 stored 2 | sitting 1 prepared 1 began 3 rested 9 tray 120000000008 | clear
  answers 0.0=F01 1.0=F02
  pace 0: 1
120000000013 break_ended: PlacingTray 2 | @2 stored 2 | sitting 1 prepared 1 began 3 rested 120000000013 tray 120000000013 | prefetch file3
180000000000 tray_ready: Presenting 2.0 ready 180000000000 touched - | @2 stored 2 | sitting 1 prepared 1 began 3 rested 120000000013 tray 120000000013 | show file3, prefetch file4
180000000001 touched: Presenting 2.0 ready 180000000000 touched 180000000001 | @2 stored 2 | sitting 1 prepared 1 began 3 rested 120000000013 tray 120000000013
180000000005 paused: PlacingTray (paused) 2 | @2 stored 2 | sitting 1 prepared 1 began 3 rested 120000000013 tray 120000000013 | clear
240000000000 resumed: PlacingTray 2 | @2 stored 2 | sitting 1 prepared 1 began 3 rested 240000000000 tray 240000000000 | prefetch file3
240000000001 tray_ready: Presenting 2.0 ready 240000000001 touched - | @2 stored 2 | sitting 1 prepared 1 began 3 rested 240000000000 tray 240000000000 | show file3, prefetch file4
359999999999 answered: OnBreak 3 block | @3 stored 3 | sitting 1 prepared 1 began 3 rested 240000000000 tray 240000000000 | clear
  answers 0.0=F01 1.0=F02 2.0=F03
  pace 0: 119999999999
360000000003 sitting_started: OnBreak 3 block | @3 stored 3 | sitting 2 prepared 1 began 360000000003 rested 360000000003 tray 360000000003 | clear
360000000005 sitting_prepared: ScaleTraining placed 0 refresher | @3 stored 3 | sitting 2 prepared 1 began 360000000003 rested 360000000005 tray 360000000003
360000000007 scale_training_done: CheckingList | @3 stored 3 | sitting 2 prepared 1 began 360000000003 rested 360000000005 tray 360000000003
360000000011 checklist_done: PlacingTray 3 | @3 stored 3 | sitting 2 prepared 2 began 360000000003 rested 360000000005 tray 360000000011 | prefetch file4
420000000000 tray_ready: Presenting 3.0 ready 420000000000 touched - | @3 stored 3 | sitting 2 prepared 2 began 360000000003 rested 360000000005 tray 360000000011 | show file4, prefetch file5
420000000001 answered: OnBreak 4 phase | @4 stored 4 | sitting 2 prepared 2 began 360000000003 rested 360000000005 tray 360000000011 | clear
  answers 0.0=F01 1.0=F02 2.0=F03 3.0=F01
  pace 0: 59999999990
420000000013 paused: OnBreak (paused) 4 phase | @4 stored 4 | sitting 2 prepared 2 began 360000000003 rested 360000000005 tray 360000000011 | clear
480000000000 resumed: OnBreak 4 phase | @4 stored 4 | sitting 2 prepared 2 began 360000000003 rested 480000000000 tray 360000000011
480000000017 break_ended: PlacingTray 4 | @4 stored 4 | sitting 2 prepared 2 began 360000000003 rested 480000000017 tray 480000000017 | prefetch file5
540000000000 tray_ready: Presenting 4.0 ready 540000000000 touched - | @4 stored 4 | sitting 2 prepared 2 began 360000000003 rested 480000000017 tray 480000000017 | show file5, prefetch file6
540000000001 answered: Presenting 4.1 ready 540000000001 touched - | @4 stored 5 | sitting 2 prepared 2 began 360000000003 rested 480000000017 tray 480000000017
  answers 0.0=F01 1.0=F02 2.0=F03 3.0=F01 4.0=0.1
960000000002 answered: OnBreak 5 time | @5 stored 6 | sitting 2 prepared 2 began 360000000003 rested 480000000017 tray 480000000017 | clear
  answers 0.0=F01 1.0=F02 2.0=F03 3.0=F01 4.0=0.1 4.1=0.2
  pace 1: 479999999985
960000000002 break_ended: PlacingTray 5 | @5 stored 6 | sitting 2 prepared 2 began 360000000003 rested 960000000002 tray 960000000002 | prefetch file6
960000000002 tray_ready: Presenting 5.0 ready 960000000002 touched - | @5 stored 6 | sitting 2 prepared 2 began 360000000003 rested 960000000002 tray 960000000002 | show file6, prefetch file7
960000000003 answered: Presenting 5.1 ready 960000000003 touched - | @5 stored 7 | sitting 2 prepared 2 began 360000000003 rested 960000000002 tray 960000000002
  answers 0.0=F01 1.0=F02 2.0=F03 3.0=F01 4.0=0.1 4.1=0.2 5.0=0.3
960000000003 answered: OnBreak 6 sitting over | @6 stored 8 | sitting 2 prepared 2 over began 360000000003 rested 960000000002 tray 960000000002 | clear
  answers 0.0=F01 1.0=F02 2.0=F03 3.0=F01 4.0=0.1 4.1=0.2 5.0=0.3 5.1=0.4
  pace 1: 1
960000000004 break_ended: PlacingTray 6 | @6 stored 8 | sitting 2 prepared 2 over began 360000000003 rested 960000000004 tray 960000000004 | prefetch file7
1020000000000 tray_ready: Presenting 6.0 ready 1020000000000 touched - | @6 stored 8 | sitting 2 prepared 2 over began 360000000003 rested 960000000004 tray 960000000004 | show file7
1080000000000 sitting_started: PlacingTray 6 | @6 stored 8 | sitting 3 prepared 2 began 1080000000000 rested 1080000000000 tray 1080000000000 | clear
1800000000000 withdrawn: Withdrawn tired | @6 stored 8 | sitting 3 prepared 2 began 1080000000000 rested 1080000000000 tray 1080000000000 | clear
)");
    }

private:
    QList<int> attempts;
};

QTEST_GUILESS_MAIN(SessionNumbersTest)
#include "session_numbers_test.moc"
