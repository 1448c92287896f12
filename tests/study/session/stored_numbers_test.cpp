// Every number that a session stores and shows: the rows of the database by a clock that ticks at each reading, the view by a
// session of known times, the clocks themselves.
#include <QDateTime>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <sstream>

#include "study/session/clock.h"
#include "study/session/driver.h"
#include "study/session/preparation.h"
#include "study/session/session_moves.h"
#include "study/session/session_record.h"
#include "study/session/stimuli.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using namespace study::session;
using namespace tests::support;
using protocols::FabricId;
using protocols::QuestionId;
using protocols::Tenths;

namespace {

/// Advances by 7 ns at every reading, so that all readings differ.
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
          bank(stimuliOf(store)),
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
                               protocols::SealedCode("file" + digit),
                               protocols::PresentationCode("COD" + digit),
                               number <= 7 ? fabrics : std::vector<FabricId>{fabrics[0]}});
    }
    plan.fabricNames = {{fabrics[0], "501"}, {fabrics[1], "502"}};
    plan.familiarisation = {{"jersey", protocols::SealedCode("fam1")}};
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
            session << Begun{} << Consented{} << FamiliarisationDone{} << ScaleTrainingDone{} << TrayReady{} << Touched{};
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
            R"(
10|1|1|Q1|B||5077|6091|7112|7119|0|operator
13|2|1|Q1|C||8126|8840|10161|10168|0|display
17|3|1|Q1|A||13203||14224|14231|0|
20|2|2|Q1|A||15238|16252|17273|17280|0|operator
21|2|2|Q1|B||15238|16252|17273|18294|1|
26|4|1|Q2||54|2035|3049|4063|4070|0|operator
28|4|1|Q3||0|4063|5077|6091|6098|0|operator
30|4|1|Q4||100|6091||8119|8126|0|
31|4|1|Q3||7|4063|5077|6091|9140|1|
)");
        compare(rowsOf(folder,
                       "SELECT sequence, sitting, kind, at_ns, wall_time FROM events WHERE participant <> '' ORDER BY sequence"),
                R"(
3|1|sitting_started|1007|wall 1007
4|1|begun|1021|wall 1021
5|1|consented|2035|wall 2035
6|1|familiarisation_done|3049|wall 3049
7|1|scale_training_done|4063|wall 4063
8|1|tray_ready|5077|wall 5077
9|1|touched|6091|wall 6091
10|1|answered|7112|wall 7112
11|1|tray_ready|8126|wall 8126
12|1|touched|9140|wall 9140
13|1|answered|10161|wall 10161
14|1|voided|11175|wall 11175
15|1|noted|12189|wall 12189
16|1|tray_ready|13203|wall 13203
17|1|answered|14224|wall 14224
18|1|tray_ready|15238|wall 15238
19|1|touched|16252|wall 16252
20|1|answered|17273|wall 17273
21|1|corrected|18287|wall 18287
22|2|sitting_started|1007|wall 1007
23|2|break_ended|1021|wall 1021
24|2|tray_ready|2035|wall 2035
25|2|touched|3049|wall 3049
26|2|answered|4063|wall 4063
27|2|touched|5077|wall 5077
28|2|answered|6091|wall 6091
29|2|noted|7105|wall 7105
30|2|answered|8119|wall 8119
31|2|corrected|9133|wall 9133
)");
        compare(rowsOf(folder, "SELECT event, trial, attempt FROM voids"), R"(
14|2|1
)");
        compare(rowsOf(folder, "SELECT event, trial, attempt, question, text, is_flag FROM notes ORDER BY id"), R"(
14|2|1||wrong swatch|0
15|2|1||a remark|1
21|2|2|Q1|misheard|0
29|4|1||loud|0
)");
        compare(rowsOf(folder, "SELECT trial, question, seconds, corrections, voided FROM answers"), R"(
1|Q1|1.021e-06|0|0
2|Q1|1.321e-06|0|1
2|Q1|1.021e-06|1|0
3|Q1|1.021e-06|0|0
4|Q2|1.014e-06|0|0
4|Q3|1.014e-06|1|0
4|Q4|2.028e-06|0|0
)");
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
        compare(views.lines(), R"(
Enrolled Q1  | 1 of 9 | 0 of 11 | left 4.5 sitting 0 break in 4 | -
Familiarising Q1  | 1 of 9 | 0 of 11 | left 4.5 sitting 0.0333333 break in 4 | -
ScaleTraining Q1  | 1 of 9 | 0 of 11 | left 4.5 sitting 0.05 break in 4 | -
PlacingTray Q1 COD1 501 502 Q1 | 1 of 9 | 0 of 11 | left 4.5 sitting 0.166667 break in 4 | -
Presenting Q1 COD1 501 502 Q1 | 1 of 9 | 0 of 11 | left 4.5 sitting 0.183333 break in 4 | -
PlacingTray Q1 COD2 501 502 Q1 | 2 of 9 | 1 of 11 | left 4 sitting 0.35 break in 3 | Q1: 502
Presenting Q1 COD2 501 502 Q1 | 2 of 9 | 1 of 11 | left 4 sitting 0.366667 break in 3 | Q1: 502
PlacingTray Q1 COD3 501 502 Q1 | 3 of 9 | 2 of 11 | left 3.5 sitting 0.533333 break in 2 | Q1: 502
Presenting Q1 COD3 501 502 Q1 | 3 of 9 | 2 of 11 | left 3.5 sitting 0.583333 break in 2 | Q1: 502
PlacingTray Q1 COD4 501 502 Q1 | 4 of 9 | 3 of 11 | left 3 sitting 0.75 break in 1 | Q1: 502
Presenting Q1 COD4 501 502 Q1 | 4 of 9 | 3 of 11 | left 3 sitting 0.833333 break in 1 | Q1: 502
OnBreak Q1  | 5 of 9 | 4 of 11 | left 2.5 sitting 1 break in 3 | Q1: 502
PlacingTray Q1 COD5 501 502 Q1 | 5 of 9 | 4 of 11 | left 2.5 sitting 1.16667 break in 3 | Q1: 502
Presenting Q1 COD5 501 502 Q1 | 5 of 9 | 4 of 11 | left 2.5 sitting 1.25 break in 3 | Q1: 502
PlacingTray Q1 COD6 501 502 Q1 | 6 of 9 | 5 of 11 | left 1.46667 sitting 1.45 break in 2 | Q1: 501
Presenting Q1 COD6 501 502 Q1 | 6 of 9 | 5 of 11 | left 1.46667 sitting 1.46667 break in 2 | Q1: 501
PlacingTray Q1 COD7 501 502 Q1 | 7 of 9 | 6 of 11 | left 1.21667 sitting 2 break in 1 | Q1: 501
PlacingTray Q1 COD7 501 502 Q1 | 7 of 10 | 6 of 12 | left 1.43333 sitting 2.01667 break in 2 | Q1: 501
Presenting Q1 COD7 501 502 Q1 | 7 of 10 | 6 of 12 | left 1.43333 sitting 2.03333 break in 2 | Q1: 501
PlacingTray (paused) Q1 COD7 501 502 Q1 | 7 of 10 | 6 of 12 | left 1.43333 sitting 2.05 break in 2 | Q1: 501
PlacingTray Q1 COD7 501 502 Q1 | 7 of 10 | 6 of 12 | left 1.43333 sitting 2.06667 break in 2 | Q1: 501
Presenting Q1 COD7 501 502 Q1 | 7 of 10 | 6 of 12 | left 1.43333 sitting 2.08333 break in 2 | Q1: 501
PlacingTray Q1 AYMP 501 502 Q1 | 8 of 10 | 7 of 12 | left 1.2 sitting 2.1 break in 1 | Q1: 502
PlacingTray Q1 AYMP 501 502 Q1 | 8 of 10 | 7 of 12 | left 1.2 sitting 0 break in 1 unprepared | Q1: 502
ScaleTraining Q1  | 8 of 10 | 7 of 12 | left 1.2 sitting 0.0166667 break in 1 unprepared | Q1: 502
PlacingTray Q1 AYMP 501 502 Q1 | 8 of 10 | 7 of 12 | left 1.2 sitting 0.0333333 break in 1 | Q1: 502
Presenting Q1 AYMP 501 502 Q1 | 8 of 10 | 7 of 12 | left 1.2 sitting 0.166667 break in 1 | Q1: 502
OnBreak Q2-Q3  | 9 of 10 | 8 of 12 | left 1 sitting 0.5 break in 2 | Q1: 501
PlacingTray Q2-Q3 COD8 501 Q2 | 9 of 10 | 8 of 12 | left 1 sitting 0.833333 break in 2 | Q1: 501
Presenting Q2-Q3 COD8 501 Q2 | 9 of 10 | 8 of 12 | left 1 sitting 1 break in 2 | Q1: 501
Presenting Q2-Q3 COD8 501 Q3 | 9 of 10 | 9 of 12 | left 1 sitting 1.01667 break in 2 | Q2: 5.5
Presenting Q2-Q3 COD8 501 Q3 | 9 of 10 | 9 of 12 | left 1 sitting 1.03333 break in 2 | Q2: 4.0
PlacingTray Q2-Q3 COD9 501 Q2 | 10 of 10 | 10 of 12 | left 0.5 sitting 1.05 break in 1 | Q3: 10.0
Presenting Q2-Q3 COD9 501 Q2 | 10 of 10 | 10 of 12 | left 0.5 sitting 1.06667 break in 1 | Q3: 10.0
Presenting Q2-Q3 COD9 501 Q3 | 10 of 10 | 11 of 12 | left 0.5 sitting 1.08333 break in 1 | Q2: 0.1
Debriefing   | 10 of 10 | 12 of 12 | left 0 sitting 1.1 break in 0 | Q3: 0.2
Finished   | 10 of 10 | 12 of 12 | left 0 sitting 1.11667 break in 0 | Q3: 0.2
)");
    }

    void whoWithdrewHasNothingLeft()
    {
        Views views;
        views.at(10, SittingStarted{}).at(20, Begun{}).at(25, WithdrawnEvent{"tired"});
        compare(views.lines(), R"(
Enrolled Q1  | 1 of 9 | 0 of 11 | left 4.5 sitting 0 break in 4 | -
Familiarising Q1  | 1 of 9 | 0 of 11 | left 4.5 sitting 0.166667 break in 4 | -
Withdrawn Q1  | 1 of 9 | 0 of 11 | left 0 sitting 0.25 break in 0 | -
)");
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

    void everyAnswerIsWrittenExactly_data()
    {
        QTest::addColumn<QString>("payload");
        QTest::addColumn<QString>("text");
        QTest::newRow("fabric") << R"({"fabric":"F02"})"
                                << "F02";
        QTest::newRow("same") << R"({"same":true})"
                              << "same";
        QTest::newRow("different") << R"({"same":false})"
                                   << "different";
        QTest::newRow("words") << R"({"words":"like felt"})"
                               << "like felt";
        QTest::newRow("no words") << R"({"words":""})"
                                  << "";
        QTest::newRow("0.0") << R"({"tenths":0})"
                             << "0.0";
        QTest::newRow("0.7") << R"({"tenths":7})"
                             << "0.7";
        QTest::newRow("10.0") << R"({"tenths":100})"
                              << "10.0";
        QTest::newRow("-0.3") << R"({"tenths":-3})"
                              << "-0.3";
        QTest::newRow("-12.5") << R"({"tenths":-125})"
                               << "-12.5";
    }

    void everyAnswerIsWrittenExactly()
    {
        QFETCH(const QString, payload);
        QFETCH(const QString, text);
        const EventBody body = eventFromRecord("answered", payload.toStdString());
        QCOMPARE(QString::fromStdString(payloadJson(body)), payload);
        const GivenAnswer given = std::get<Answered>(body).response;
        QCOMPARE(QString::fromStdString(textOf(given)), text);
        database::AnswerRecord record;
        putInto(record, given);
        const auto* tenths = std::get_if<Tenths>(&given);
        QCOMPARE(record.rating.has_value(), tenths != nullptr);
        QCOMPARE(record.answer.has_value(), tenths == nullptr);
        if (tenths)
            QCOMPARE(record.rating->value, tenths->value);
        else
            QCOMPARE(QString::fromStdString(*record.answer), text);
    }

    void eventsWithNumbersAreWrittenExactly_data()
    {
        QTest::addColumn<QString>("payload");
        QTest::newRow("touched") << R"({"by":"display"})";
        QTest::newRow("touched ") << R"({"by":"operator","ago_ns":1234567890123})";
        QTest::newRow("noted") << R"({"text":"odd","flag":true})";
        QTest::newRow("corrected") << R"({"question":"Q1","fabric":"F03","why":""})";
        QTest::newRow("corrected ") << R"({"question":"S1","same":false,"why":"misheard"})";
        QTest::newRow("scale_placed") << R"({"shown":-25,"spoken":7})";
    }

    void eventsWithNumbersAreWrittenExactly()
    {
        QFETCH(const QString, payload);
        const std::string kind = QString(QTest::currentDataTag()).trimmed().toStdString();
        QCOMPARE(QString::fromStdString(payloadJson(eventFromRecord(kind, payload.toStdString()))), payload);
    }

    void aRefusedRatingNamesTheScale()
    {
        const protocols::RatingScale scale{Tenths{-5}, Tenths{100}, Tenths{5}, 3, {}};
        const protocols::Question question{QuestionId("L1"), "How warm?", protocols::Rating{scale}};
        const auto fault = [&](int tenths) { return faultOf(GivenAnswer(Tenths{tenths}), question, {}, {}).value_or("-"); };
        QCOMPARE(fault(-5), std::string("-"));
        QCOMPARE(fault(100), std::string("-"));
        QCOMPARE(fault(45), std::string("-"));
        QCOMPARE(fault(-3), std::string("-0.3 is not on the scale: from -0.5 to 10 in steps of 0.5."));
        QCOMPARE(fault(-10), std::string("-1 is not on the scale: from -0.5 to 10 in steps of 0.5."));
        QCOMPARE(fault(105), std::string("10.5 is not on the scale: from -0.5 to 10 in steps of 0.5."));
    }

    /// An altered log may hold any number of 64 bits.
    void noNumberOfAnAlteredLogOverflows()
    {
        using Limits = std::numeric_limits<std::int64_t>;
        constexpr std::int64_t ready = 5 * secondNs, now = 9 * secondNs;
        QCOMPARE(stampOf(now, secondNs, ready), 8 * secondNs);
        QCOMPARE(stampOf(now, 7 * secondNs, ready), ready);
        QCOMPARE(stampOf(now, -secondNs, ready), now);
        QCOMPARE(stampOf(now, Limits::min(), ready), now);
        QCOMPARE(stampOf(now, Limits::max(), ready), ready);
        QCOMPARE(stampOf(ready, 0, now), now);  // the clock went back
        QVERIFY(isStamp(0) && isStamp(-now) && !isStamp(Limits::max()) && !isStamp(Limits::min()));
        const protocols::RatingScale scale{Tenths{0}, Tenths{100}, Tenths{1}, 10, {}};
        QVERIFY(isRightPlace(scale, Tenths{50}, Tenths{55}) && !isRightPlace(scale, Tenths{50}, Tenths{56}));
        for (const int named : {std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
            QVERIFY(!isRightPlace(scale, Tenths{50}, Tenths{named}));
        const auto outcome = apply(sevenChoices(), {}, {SittingStarted{}, Limits::max(), EventSource::Log});
        QVERIFY(std::holds_alternative<Refusal>(outcome));
    }

    /// Computed with the draws of tests/protocols/random_reference.py.
    void placesOnTheScaleAreTheSameOnEveryMachine()
    {
        Plan plan = sevenChoices();
        State state;
        state.sitting = 1;
        state.stage = ScaleTraining{};
        const auto places = [&] {
            QList<int> tenths;
            auto* training = std::get_if<ScaleTraining>(&state.stage);
            for (int placed = 0; training && placed < 3; ++placed) {
                training->placed = placed;
                tenths << placeToName(plan, state)->value;
            }
            if (!training && placeToName(plan, state)) tenths << -1;
            return tenths;
        };
        QCOMPARE(places(), (QList<int>{53, 11, 89}));
        state.sitting = 2;
        QCOMPARE(places(), (QList<int>{19, 73, 41}));
        state.stage = ScaleTraining{true, 0};
        QCOMPARE(places(), (QList<int>{19, 73, 41}));
        state.stage = PlacingTray{};
        QCOMPARE(places(), QList<int>());
        // A scale of three steps from 1 to 4: one place in each third, never its lower end.
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
