// Every number of a session's state after every event: times, counts, order, attempts, blocks, breaks, sittings. Times are in
// nanoseconds from small distinct numbers, so that no other sum or difference gives the same digits.
#include <QtTest>
#include <sstream>

#include "study/session/session_moves.h"
#include "study/session/session_record.h"

using namespace study::session;
using protocols::FabricId;
using protocols::FileCode;
using protocols::QuestionId;
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
                               FileCode("file" + digit),
                               protocols::PresentationCode("COD" + digit),
                               isChoice ? fabrics : std::vector<FabricId>{fabrics[2]}});
    }
    plan.fabricNames = {{fabrics[0], "501"}, {fabrics[1], "502"}, {fabrics[2], "503"}};
    plan.familiarisation = {{"jersey", FileCode("fam1")}, {"velvet", FileCode("fam2")}};
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
        if (m_state.paceNs != before.paceNs)
            m_lines << QString("  pace %1: %2").arg(m_state.paceNs.back().first).arg(m_state.paceNs.back().second);
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
        for (const Tenths place : placesToName(session.plan(), session.state())) session.at(8, ScalePlaced{place, {50}});
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
        compare(session.lines(), R"()");
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
        compare(session.lines(), R"()");
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
        // One nanosecond short of two minutes since the sitting began, then two minutes.
        session.at(17, TrayReady{}).at(2 * minute + 2, Answered{FabricId("F01")});
        session.at(2 * minute + 2, TrayReady{}).at(2 * minute + 3, Answered{FabricId("F02")});
        session.at(2 * minute + 7, BreakEnded{})
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
        session.at(30 * minute, WithdrawnEvent{"tired"});
        compare(session.lines(), R"()");
    }

private:
    QList<int> attempts;
};

QTEST_GUILESS_MAIN(SessionNumbersTest)
#include "session_numbers_test.moc"
