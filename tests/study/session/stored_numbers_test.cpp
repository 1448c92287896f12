// Every number that a session stores and shows: the rows of the database by a clock that ticks at each reading, the view by a
// session of known times, the clocks themselves.
#include <QDateTime>
#include <QTemporaryDir>
#include <QtTest>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <sstream>

#include "study/session/clock.h"
#include "study/session/driver.h"
#include "study/session/preparation.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace study::session;
using namespace tests::support;
using protocols::FabricId;
using protocols::QuestionId;
using protocols::Tenths;

namespace {

/// Goes on by 7 ns whenever it is read, so that each reading is a number of its own.
class TickingClock final : public Clock {
public:
    std::int64_t monotonicNs() const override { return m_now += 7; }
    std::string wallTime() const override { return "wall " + std::to_string(m_now); }
    void advance(std::int64_t ns) { m_now += ns; }

private:
    mutable std::int64_t m_now = 1000;
};

/// A session whose every event is accepted.
struct TickingSession {
    explicit TickingSession(const database::StudyFolder& folder)
        : store(folder, database::StudyStore::Access::Write),
          bank(folder.stimuli(), store.stimulusHashes()),
          driver(store, protocols::ParticipantId("S01"), database::ParticipantKind::Scripted, bank, display, clock)
    {
    }
    TickingSession& operator<<(const EventBody& body)
    {
        if (const auto refusal = driver.send(body)) qFatal("%s", refusal->reason.c_str());
        clock.advance(1000);
        return *this;
    }
    FabricId slot(std::size_t place) const { return driver.view().trayIds.at(place); }

    database::StudyStore store;
    rendering::StimulusBank bank;
    FakeDisplay display;
    TickingClock clock;
    Driver driver;
};

constexpr std::int64_t secondNs = 1'000'000'000;

/// Seven choices, then two presentations with two ratings each; a break after four.
Plan sevenChoices()
{
    Plan plan;
    const std::vector<FabricId> fabrics{FabricId("F01"), FabricId("F02")};
    plan.protocol.breakAfterPresentations = 4;
    plan.protocol.secondsPerPresentation = 30;
    protocols::Phase choice, rating;
    choice.task = protocols::ForcedChoice{2};
    choice.questions = {{QuestionId("Q1"), "Which?", choice.task}};
    rating.task = protocols::Rating{};
    rating.questions = {{QuestionId("Q2"), "How slippery?", rating.task}, {QuestionId("Q3"), "How textured?", rating.task}};
    plan.protocol.phases = {choice, rating};
    for (int number = 1; number <= 9; ++number) {
        const std::string digit = std::to_string(number);
        plan.trials.push_back({{number},
                               number <= 7 ? 0 : 1,
                               protocols::FileCode("file" + digit),
                               protocols::PresentationCode("COD" + digit),
                               number <= 7 ? fabrics : std::vector<FabricId>{fabrics[0]}});
    }
    plan.fabricNames = {{fabrics[0], "501"}, {fabrics[1], "502"}};
    plan.familiarisation = {{"jersey", protocols::FileCode("fam1")}};
    return plan;
}

std::string lineOf(const View& view)
{
    std::ostringstream text;
    text << nameOf(view.state) << " " << view.phaseName << " " << view.code.value;
    for (const std::string& piece : view.tray) text << " " << piece;
    text << (view.question ? " " + view.question->id.value : "") << " | " << view.presentation << " of " << view.presentations
         << " | " << view.answersStored << " of " << view.answersInAll << " | left " << view.minutesLeft << " sitting "
         << view.sittingMinutes << " break in " << view.presentationsToBreak << (view.sittingIsPrepared ? "" : " unprepared")
         << " | " << view.lastAnswer.value_or("-");
    return text.str();
}

/// Plays events at given seconds and writes down the view after each of them.
class Views {
public:
    Views& at(double seconds, const EventBody& body)
    {
        const std::int64_t ns = std::llround(seconds * 1e9);
        auto outcome = apply(m_plan, m_state, {body, ns});
        if (const auto* refusal = std::get_if<Refusal>(&outcome)) qFatal("%s", refusal->reason.c_str());
        m_state = std::get<SessionStep>(outcome).next;
        m_lines << QString::fromStdString(lineOf(viewOf(m_plan, m_state, protocols::ParticipantId("P01"), ns)));
        return *this;
    }
    QStringList lines() const { return m_lines; }

private:
    Plan m_plan = sevenChoices();
    State m_state;
    QStringList m_lines;
};

void compare(const QStringList& lines, const char* drawn)
{
    const QStringList expected = QString::fromUtf8(drawn).split('\n', Qt::SkipEmptyParts);
    if (lines != expected) fprintf(stdout, "%s\n", qPrintable(lines.join('\n')));
    QCOMPARE(lines, expected);
}

QStringList rowsOf(const database::StudyFolder& folder, const char* sql)
{
    QStringList rows;
    for (const std::string& row : RawSqlite(folder.database()).rows(sql)) rows << QString::fromStdString(row);
    return rows;
}

}  // namespace

class StoredNumbersTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void everyNumberOfAnAnswerIsStored()
    {
        QTemporaryDir place;
        StudyRecipe recipe;
        recipe.participants = 1;
        recipe.conditions = {"h"};
        const auto folder = buildStudy(place.filePath("study").toStdString(), recipe);
        {
            TickingSession session(folder);
            session << Begun{} << FamiliarisationDone{} << ScaleTrainingDone{} << TrayReady{} << Touched{};
            session << Answered{session.slot(1)} << TrayReady{} << Touched{TouchSource::Display, 300};
            session << Answered{session.slot(2)} << Voided{"wrong swatch"} << Noted{"a remark", true};
            session << TrayReady{} << Answered{session.slot(0)} << TrayReady{} << Touched{} << Answered{session.slot(0)};
            session << Corrected{QuestionId("Q1"), session.driver.plan().trials[1].alternatives[1], "misheard"};
        }
        TickingSession session(folder);
        session << BreakEnded{} << TrayReady{} << Touched{} << Answered{Tenths{54}} << Touched{} << Answered{Tenths{0}};
        session << Noted{"loud", false} << Answered{Tenths{100}} << Corrected{QuestionId("Q3"), Tenths{7}, ""};
        compare(
            rowsOf(folder,
                   "SELECT event, trial, attempt, question, CASE choice WHEN json_extract(alternatives, '$[0]') THEN 'A' WHEN "
                   "json_extract(alternatives, '$[1]') THEN 'B' WHEN json_extract(alternatives, '$[2]') THEN 'C' END, "
                   "rating_tenths, ready_at, touched_at, answered_at, stored_at, is_correction, touched_by FROM responses "
                   "ORDER BY id"),
            R"()");
        compare(rowsOf(folder,
                       "SELECT sequence, sitting, kind, at_ns, wall_time FROM events WHERE participant <> '' ORDER BY sequence"),
                R"()");
        compare(rowsOf(folder, "SELECT event, trial, attempt FROM voids"), R"()");
        compare(rowsOf(folder, "SELECT event, trial, attempt, question, text, is_flag FROM notes ORDER BY id"), R"()");
        compare(rowsOf(folder, "SELECT trial, question, seconds, corrections, voided FROM answers"), R"()");
    }

    void everyNumberOfTheViewIsShown()
    {
        Views views;
        views.at(10, SittingStarted{}).at(12, Begun{}).at(13, FamiliarisationDone{}).at(20, ScaleTrainingDone{});
        for (const double seconds : {21.0, 32.0, 45.0, 60.0})
            views.at(seconds, TrayReady{}).at(seconds + 10, Answered{FabricId("F02")});
        views.at(80, BreakEnded{}).at(85, TrayReady{}).at(97, Answered{FabricId("F01")});
        views.at(98, TrayReady{}).at(130, Answered{FabricId("F01")}).at(131, Voided{"noise"});
        views.at(132, TrayReady{}).at(133, Paused{}).at(134, Resumed{}).at(135, TrayReady{}).at(136, Answered{FabricId("F02")});
        views.at(140, SittingStarted{}).at(141, SittingPrepared{}).at(142, ScaleTrainingDone{});
        views.at(150, TrayReady{}).at(170, Answered{FabricId("F01")}).at(190, BreakEnded{});
        views.at(200, TrayReady{}).at(201, Answered{Tenths{55}}).at(202, Corrected{QuestionId("Q2"), Tenths{40}, ""});
        views.at(203, Answered{Tenths{100}}).at(204, TrayReady{}).at(205, Answered{Tenths{1}}).at(206, Answered{Tenths{2}});
        views.at(207, Debriefed{""});
        compare(views.lines(), R"()");
    }

    void whoWithdrewHasNothingLeft()
    {
        Views views;
        views.at(10, SittingStarted{}).at(20, Begun{}).at(25, WithdrawnEvent{"tired"});
        compare(views.lines(), R"()");
    }

    void theVirtualClockCountsFromTheYear2000()
    {
        VirtualClock clock;
        QCOMPARE(clock.monotonicNs(), std::int64_t{0});
        QCOMPARE(clock.wallTime(), std::string("2000-01-01T00:00:00.000Z"));
        clock.advanceSeconds(3661.0625);
        QCOMPARE(clock.monotonicNs(), 3661'062'500'000);
        QCOMPARE(clock.wallTime(), std::string("2000-01-01T01:01:01.062Z"));
        clock.advanceSeconds(2.6e-9);
        QCOMPARE(clock.monotonicNs(), 3661'062'500'003);
    }

    void theSystemClockNamesItsZone_data()
    {
        QTest::addColumn<QByteArray>("zone");
        QTest::addColumn<QString>("ending");
        QTest::addColumn<int>("offsetMinutes");
        // POSIX counts zones westwards.
        QTest::newRow("east") << QByteArray("XYZ-05:30") << "+05:30" << 330;
        QTest::newRow("west") << QByteArray("XYZ+03:15") << "-03:15" << -195;
        QTest::newRow("utc") << QByteArray("UTC0") << "+00:00" << 0;
    }

    void theSystemClockNamesItsZone()
    {
        QFETCH(const QByteArray, zone);
        QFETCH(const QString, ending);
        QFETCH(const int, offsetMinutes);
        const QByteArray before = qgetenv("TZ");
        qputenv("TZ", zone);
        ::tzset();
        const qint64 earlier = QDateTime::currentMSecsSinceEpoch();
        const QString text = QString::fromStdString(SystemClock().wallTime());
        const qint64 later = QDateTime::currentMSecsSinceEpoch();
        before.isEmpty() ? qunsetenv("TZ") : qputenv("TZ", before);
        ::tzset();
        QVERIFY2(text.endsWith(ending), qPrintable(text));
        QDateTime local = QDateTime::fromString(text.chopped(6), "yyyy-MM-ddTHH:mm:ss.zzz");
        local.setTimeSpec(Qt::UTC);
        const qint64 instant = local.toMSecsSinceEpoch() - offsetMinutes * 60'000LL;
        QVERIFY2(instant >= earlier && instant <= later, qPrintable(text));
    }

    void theSystemClockCountsNanoseconds()
    {
        const SystemClock clock;
        timespec before{}, after{};
        ::clock_gettime(CLOCK_MONOTONIC, &before);
        const std::int64_t now = clock.monotonicNs();
        ::clock_gettime(CLOCK_MONOTONIC, &after);
        QVERIFY(now >= before.tv_sec * secondNs + before.tv_nsec);
        QVERIFY(now <= after.tv_sec * secondNs + after.tv_nsec);
    }

    void aWillingParticipantGoesThroughThePreparation()
    {
        protocols::Protocol protocol;
        protocol.checklist = {"The mask is on", "The headphones are on"};
        const auto next = [&](const Stage& stage) {
            const auto event = nextOfPreparation(protocol, stage);
            return event ? kindOf(*event) + " " + payloadJson(*event) : std::string("-");
        };
        QCOMPARE(next(Enrolled{}), std::string("begun {}"));
        QCOMPARE(next(Consenting{}), std::string("consented {}"));
        QCOMPARE(next(AskingFacts{}), std::string(R"(facts_given {"given":[]})"));
        QCOMPARE(next(Familiarising{}), std::string("familiarisation_done {}"));
        QCOMPARE(next(ScaleTraining{}), std::string("scale_training_done {}"));
        QCOMPARE(next(CheckingList{}),
                 std::string(R"(checklist_done {"ticked":["The mask is on","The headphones are on"],"readings":{}})"));
        QCOMPARE(next(OnBreak{}), std::string("break_ended {}"));
        QCOMPARE(next(Debriefing{}), std::string("debriefed {}"));
        for (const Stage& stage : {Stage(PlacingTray{}), Stage(Presenting{}), Stage(Finished{}), Stage(Withdrawn{})})
            QCOMPARE(next(stage), std::string("-"));
    }

    void placesOnTheScaleAreTheSameOnEveryMachine()
    {
        Plan plan = sevenChoices();
        State state;
        state.sitting = 1;
        state.stage = ScaleTraining{};
        const auto places = [&] {
            QList<int> tenths;
            for (const Tenths placed : placesToName(plan, state)) tenths << placed.value;
            return tenths;
        };
        QCOMPARE(places(), (QList<int>{}));
        state.sitting = 2;
        QCOMPARE(places(), (QList<int>{}));
        state.stage = ScaleTraining{true, 0};
        QCOMPARE(places(), (QList<int>{}));
        state.stage = PlacingTray{};
        QCOMPARE(places(), QList<int>());
        // A scale of three steps from 1: a place within each third, never its lower end.
        protocols::RatingScale likert{Tenths{10}, Tenths{40}, Tenths{10}, 3, {}};
        plan.protocol.phases[1].task = protocols::Rating{likert};
        state.stage = ScaleTraining{};
        QList<int> sorted = places();
        std::sort(sorted.begin(), sorted.end());
        QCOMPARE(sorted, (QList<int>{20, 30, 40}));
    }
};

QTEST_GUILESS_MAIN(StoredNumbersTest)
#include "stored_numbers_test.moc"
