// The driver: what it stores, when it performs effects, where a session continues.
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "database/evidence/clear_log.h"
#include "database/evidence/finger_records.h"
#include "protocols/files/errors.h"
#include "protocols/random.h"
#include "study/session/session_record.h"
#include "tests/support/server/engine_session.h"
#include "tests/support/whole_protocol.h"

using namespace study::session;
using namespace tests::support;
using database::CurrentAnswer;
using database::SlotState;
using protocols::ParticipantId;
using protocols::QuestionId;
using protocols::Tenths;

namespace {

/// An answer without its times.
std::string withoutTimes(const CurrentAnswer& answer)
{
    const auto& record = answer.record;
    return answer.participant.value + " " + std::to_string(record.trial.value) + " " + record.question.value + " " +
           record.presentationCode.value + " " + (record.answer ? *record.answer : std::to_string(record.rating->value)) +
           (answer.voided ? " void" : "");
}

std::vector<std::string> withoutTimes(const std::vector<CurrentAnswer>& answers)
{
    std::vector<std::string> lines;
    for (const CurrentAnswer& answer : answers) lines.push_back(withoutTimes(answer));
    return lines;
}

int count(const std::vector<CurrentAnswer>& answers, bool voided)
{
    return static_cast<int>(
        std::count_if(answers.begin(), answers.end(), [&](const CurrentAnswer& answer) { return answer.voided == voided; }));
}

}  // namespace

class DriverTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    EngineUnderTest m_engine;
    int m_studies = 0;

    database::StudyFolder newStudy(const StudyRecipe& recipe = {})
    {
        return m_engine.study(m_place.filePath(QString("study%1").arg(++m_studies)).toStdString(), recipe);
    }

private Q_SLOTS:
    void initTestCase()
    {
        if (const QString why = EngineUnderTest::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    }

    void aWholeSessionIsStoredAndFinishesItsSlot()
    {
        EngineSession session(newStudy(), "S01");
        session.playToEnd();
        const auto answers = session.rows().answers();
        QCOMPARE(answers.size(), 6u + 18u);
        QCOMPARE(session.store->slots()[0].state, SlotState::Finished);
        QCOMPARE(session.driver->view().logHead, shortTextOf(session.store->head()));
        QCOMPARE(session.store->slots()[1].state, SlotState::Free);
        QCOMPARE(answers.front().seconds, 2.5);
        QCOMPARE(answers.front().record.readyAtNs + 1250000000, *answers.front().record.touchedAtNs);
        const CurrentAnswer& third = answers[8];
        QCOMPARE(third.record.question.value, std::string("Q4"));
        QVERIFY(!third.record.touchedAtNs);
        QCOMPARE(third.record.readyAtNs, answers[7].record.answeredAtNs);
        QCOMPARE(third.seconds, 3.75);
        QVERIFY(session.rows().faults().empty());
    }

    void theTimesOfAnAnswerAreItsOwn()
    {
        EngineSession session(newStudy(), "S01");
        session.stepUntil("Presenting");
        const auto answer = [&](const AnswerStamps& stamps) {
            session.clock.advanceSeconds(6);
            session.send(
                Answered{std::get<Answered>(*nextEvent(session.driver->view(), session.driver->plan())).response, stamps});
            return session.rows().answers().back();
        };
        constexpr std::int64_t second = 1000000000;
        session.clock.advanceSeconds(1);
        session.send(Touched{TouchSource::Display});
        CurrentAnswer stored = answer({.begunAgoNs = 4 * second, .begunBy = BegunBy::Spoken, .touchEndedAgoNs = 5 * second});
        QCOMPARE(stored.responseSeconds, std::optional(2.0));
        QCOMPARE(stored.seconds, 6.0);
        QCOMPARE(stored.record.answerBegunBy, std::string("spoken"));
        QCOMPARE(*stored.record.touchEndedAtNs, *stored.record.touchedAtNs + second);

        const protocols::QuestionId question = stored.record.question;  // a correction keeps every time of the answer
        session.send(Corrected{question, session.driver->plan().trials[0].alternatives[0], "misheard"});
        const auto corrected = database::answersGivenBy(session.rows(), protocols::ParticipantId("S01")).back();
        QVERIFY(corrected.record.isCorrection);
        QCOMPARE(corrected.responseSeconds, std::optional(2.0));
        QCOMPARE(corrected.record.touchEndedAtNs, stored.record.touchEndedAtNs);

        session.stepUntil("Presenting");
        stored = answer({.begunAgoNs = 4 * second});  // nobody stamped the touch
        QVERIFY(!stored.responseSeconds);
        QCOMPARE(stored.seconds, 6.0);

        session.stepUntil("Presenting");
        session.clock.advanceSeconds(3);
        session.send(Touched{});  // the operator stamped the touch after the first key of the answer
        stored = answer({.begunAgoNs = 8 * second});
        QVERIFY(!stored.responseSeconds);

        session.stepUntil("Presenting");
        stored = answer({.begunAgoNs = 0, .begunBy = BegunBy::Script});  // a script states one time
        QCOMPARE(stored.responseSeconds, std::optional(stored.seconds));

        session.stepUntil("Presenting");
        stored = answer({.begunAgoNs = 1000 * second, .touchEndedAgoNs = 1000 * second});  // ages from outside may be anything
        QCOMPARE(*stored.record.answerBegunAtNs, stored.record.readyAtNs);
        QVERIFY(session.rows().faults().empty());
    }

    void theDisplayShowsEachTrialsOwnStimulusAndIsClearBetween()
    {
        EngineSession session(newStudy(), "S01");
        session.playToEnd();
        std::vector<std::string> expected{"clear", "clear"};  // at the start of the sitting, and for familiarisation
        for (const auto& trial : session.driver->plan().trials) {
            const int value = session.images->image(trial.sealedCode).at<unsigned char>(0, 0);
            expected.push_back("show " + std::to_string(value));
            expected.push_back("clear");
        }
        QCOMPARE(session.display.calls, expected);
    }

    void theViewCarriesTheTrialAndNoKey()
    {
        EngineSession session(newStudy(), "S01");
        QVERIFY(session.driver->view().code.empty());
        session.stepUntil("PlacingTray");
        View view = session.driver->view();
        const auto& trial = session.driver->plan().trials.front();
        QCOMPARE(view.code, trial.presentationCode);
        QVERIFY(view.code.value != trial.sealedCode.value);
        QCOMPARE(view.tray.size(), 3u);
        QCOMPARE(view.tray.front(), "fabric " + trial.alternatives.front().value.substr(1));
        QCOMPARE(view.question->id.value, std::string("Q1"));
        QVERIFY(view.question->kind == protocols::AnswerKind(protocols::ForcedChoice{3}));
        QVERIFY(!view.lastAnswer);
        QCOMPARE(view.phaseName, std::string("Q1"));
        QCOMPARE(view.presentation, 1);
        QCOMPARE(view.presentations, 12);
        QCOMPARE(view.answersInAll, 24);
        QCOMPARE(view.minutesLeft, 6.0);
        QCOMPARE(view.presentationsToBreak, 4);
        session.playUntilAnswers(4);
        QVERIFY(session.driver->view().code.empty());
        QCOMPARE(session.driver->view().presentationsToBreak, 2);
        session.playUntilAnswers(7);
        view = session.driver->view();
        QCOMPARE(view.phaseName, std::string("Q2-Q4"));
        QCOMPARE(view.question->id.value, std::string("Q3"));
        QVERIFY(view.question->kind == protocols::AnswerKind(protocols::Rating{}));
        QCOMPARE(view.minutesLeft, 3.0);
        const int tenths = std::get<Tenths>(session.driver->state().answers.back().response).value;
        QCOMPARE(*view.lastAnswer, "Q2: " + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10));
        session.playToEnd();
        QCOMPARE(session.driver->view().minutesLeft, 0.0);
        QCOMPARE(session.driver->view().presentation, 12);
    }

    void aSessionGoesOnWhereTheLastOneStopped()
    {
        const auto whole = newStudy();
        EngineSession uninterrupted(whole, "S01");
        uninterrupted.playToEnd();
        const auto folder = newStudy();
        for (int answers = 1; answers <= 24; ++answers) {
            EngineSession session(folder, "S01");
            QCOMPARE(session.driver->state().sitting, answers);
            QCOMPARE(session.driver->state().answersStored, answers - 1);
            session.playUntilAnswers(answers);
        }
        EngineSession session(folder, "S01");
        QCOMPARE(session.display.calls, std::vector<std::string>{"clear"});
        QCOMPARE(nameOf(session.driver->state()), std::string("Debriefing"));
        QVERIFY(session.step());
        QVERIFY(!session.step());
        QCOMPARE(withoutTimes(session.rows().answers()), withoutTimes(uninterrupted.rows().answers()));
    }

    void aRefusedEventIsNotStored()
    {
        EngineSession session(newStudy(), "S01");
        session.stepUntil("Presenting");
        const auto events = session.store->events(ParticipantId("S01")).size();
        const auto refusal = session.driver->send(Answered{protocols::FabricId("F99")});
        QVERIFY(refusal && refusal->reason.find("is not on the tray") != std::string::npos);
        QCOMPARE(session.store->events(ParticipantId("S01")).size(), events);
        QVERIFY(session.rows().answers().empty());
    }

    void aCorrectionKeepsTheOldValueInTheLog()
    {
        const auto folder = newStudy();
        EngineSession session(folder, "S01");
        session.playUntilAnswers(9);
        const CurrentAnswer before = session.rows().answers()[7];
        session.clock.advanceSeconds(60);
        session.send(Corrected{QuestionId("Q3"), Tenths{54}, "misheard"});
        const CurrentAnswer now = session.rows().answers()[7];
        QCOMPARE(now.record.question.value, std::string("Q3"));
        QCOMPARE(now.record.rating->value, 54);
        QCOMPARE(now.corrections, 1);
        QCOMPARE(now.record.note, std::string("misheard"));
        QCOMPARE(now.seconds, before.seconds);
        QVERIFY(now.storedAtNs > before.storedAtNs);
        QCOMPARE(rowsFound(folder, "SELECT rating_tenths FROM responses WHERE trial = 7 AND question = 'Q3' ORDER BY id"),
                 (std::vector<std::string>{std::to_string(before.record.rating->value), "54"}));
        QCOMPARE(rowsFound(folder, "SELECT rating FROM answers WHERE trial = 7 AND question = 'Q3'"),
                 std::vector<std::string>{"5.4"});
    }

    void aVoidPresentationIsKeptAndPresentedAgain()
    {
        const auto folder = newStudy();
        {
            EngineSession session(folder, "S01");
            session.playUntilAnswers(2);
            session.send(Voided{"wrong swatch"});
            QCOMPARE(session.driver->view().presentations, 13);
            session.send(Noted{"wet finger", true});  // before the next tray: it concerns what was voided
        }
        EngineSession session(folder, "S01");
        session.playToEnd();
        const auto answers = session.rows().answers();
        QCOMPARE(count(answers, true), 1);
        QCOMPARE(count(answers, false), 24);
        const CurrentAnswer& first = answers[1];
        const CurrentAnswer& second = answers[2];
        QCOMPARE(first.record.trial.value, 2);
        QVERIFY(first.voided && !second.voided);
        QCOMPARE(second.record.trial.value, 2);
        QCOMPARE(second.attempt, 2);
        QCOMPARE(first.record.note, std::string("wrong swatch; wet finger"));
        QCOMPARE(session.rows().flags().at(0).trial.value, 2);
        QCOMPARE(answers[0].record.note, std::string());
        QCOMPARE(second.record.note, std::string());
        QVERIFY(session.rows().faults().empty());
    }

    void aNoteIsFoundAtItsTrial()
    {
        EngineSession session(newStudy(), "S01");
        session.playUntilAnswers(3);
        session.send(Noted{"sneezed"});
        session.stepUntil("Presenting");
        session.send(Noted{"a phone rang"});
        session.playUntilAnswers(5);
        const auto answers = session.rows().answers();
        QCOMPARE(answers[1].record.note, std::string());
        QCOMPARE(answers[2].record.note, std::string("sneezed"));
        QCOMPARE(answers[3].record.note, std::string("a phone rang"));
        QCOMPARE(answers[4].record.note, std::string());
    }

    /// NUL ends texts, and SQLite drops or replaces the others, so that the log would never agree with its hashes again.
    void aTextThatIsNotStoredAsItIsIsRefused()
    {
        EngineSession session(newStudy(), "S01");
        session.playUntilAnswers(1);
        const auto events = session.store->events(ParticipantId("S01")).size();
        for (const std::string& text : {std::string("soft\0ware", 9),
                                        std::string("\xEF\xBB\xBF"
                                                    "soft"),
                                        std::string("a\xEF\xBF\xBF"), std::string("\xEF\xBF\xBE\x62")}) {
            const auto refusal = session.driver->send(Noted{text});
            QVERIFY(refusal && refusal->reason.find("not stored as it is") != std::string::npos);
        }
        QCOMPARE(session.store->events(ParticipantId("S01")).size(), events);
        QVERIFY(!session.driver->send(Noted{"the six characters \\u0000 are a text"}));
        QVERIFY(!session.driver->send(Noted{"a backslash \\"}));
        session.stepUntil("Debriefing");
        QVERIFY(
            session.driver->send(Debriefed{"\xEF\xBB\xBF"
                                           "fine"}));
        QVERIFY(!session.driver->send(Debriefed{"fine \xF0\x9F\x91\x8D"}));
    }

    /// What waits in a queue must be an entry that the server takes; a folder has the same bounds.
    void aTextThatNoServerTakesIsRefused()
    {
        const auto folder = newStudy();
        const std::string longest(database::longestText, 'x');
        {
            EngineSession session(folder, "S01");
            session.playUntilAnswers(1);
            const auto events = session.store->events(ParticipantId("S01")).size();
            const QuestionId question = session.driver->plan().protocol.phases.front().questions.front().id;
            const GivenAnswer right = session.driver->state().answers.back().response;
            for (const EventBody& body :
                 {EventBody(Noted{longest + "x"}), EventBody(Voided{longest + "x"}), EventBody(WithdrawnEvent{longest + "x"}),
                  EventBody(Corrected{question, right, longest + "x"})}) {
                const auto refusal = session.driver->send(body);
                QVERIFY(refusal && refusal->reason.find("longer than 100,000 bytes") != std::string::npos);
            }
            QCOMPARE(session.store->events(ParticipantId("S01")).size(), events);
            session.send(Noted{longest});
            if (EngineUnderTest::isServer()) return;
            database::SessionStore::Append earlier;  // from a version without the bounds
            earlier.event = session.store->events(ParticipantId("S01")).back();
            earlier.event.payloadJson = "{\"text\":\"" + longest + longest + "\"}";
            session.store->append(earlier);
        }
        EngineSession session(folder, "S01");
        session.playToEnd();
        QVERIFY(session.rows().faults().empty());
    }

    /// No text of these entries is too long. The hashes of facts come into a payload only when it is stored.
    void anEntryThatNoServerTakesIsRefused()
    {
        EngineSession session(newStudy(wholeStudy()), "S01");
        const auto isRefused = [&](const EventBody& body) {
            const auto refusal = session.driver->send(body);
            return refusal && refusal->reason.find("The entry is too long") != std::string::npos;
        };
        FactsGiven given;
        for (int fact = 0; fact < 6000; ++fact) given.facts[std::to_string(fact) + std::string(80, 'x')] = "right";
        QVERIFY(payloadJson(given).size() < database::longestPayload);
        ChecklistDone read;
        for (int reading = 0; reading < 9; ++reading) read.readings[std::to_string(reading)] = std::string(99'000, 'x');
        session.stepUntil("AskingFacts");
        QVERIFY(isRefused(given));
        session.stepUntil("CheckingList");
        ChecklistDone more = read;
        for (int reading = 9; reading < 11; ++reading) more.readings[std::to_string(reading)] = std::string(99'000, 'x');
        QVERIFY(isRefused(more));
        session.send(read);
        session.playToEnd();
        QVERIFY(session.rows().faults().empty());
    }

    void aDisplayThatFailsPausesTheSessionAndLosesNothing()
    {
        const auto folder = newStudy();
        EngineSession session(folder, "S01");
        session.playUntilAnswers(2);
        session.display.fault = "cable out";
        try {
            session.stepUntil("Presenting");
            QFAIL("the fault did not reach the caller");
        } catch (const protocols::Error& fault) {
            QVERIFY(QString(fault.what()).contains("cable out"));
        }
        QCOMPARE(nameOf(session.driver->state()), std::string("PlacingTray (paused)"));
        QCOMPARE(session.store->events(ParticipantId("S01")).back().kind, std::string("paused"));
        session.display.fault.clear();
        session.playToEnd();
        QCOMPARE(session.rows().answers().size(), 24u);
    }

    void aMissingStimulusIsToldBeforeTheSession()
    {
        if (EngineUnderTest::isServer()) QSKIP("a server holds the images in its tables");
        const auto folder = newStudy();
        const auto file = std::filesystem::directory_iterator(folder.stimuli())->path();
        std::filesystem::rename(file, folder.folder / "aside");
        QVERIFY_EXCEPTION_THROWN(EngineSession(folder, "S01"), protocols::Error);
        std::filesystem::rename(folder.folder / "aside", file);
        EngineSession session(folder, "S01");
        std::filesystem::remove(file);  // all files are read when the session opens
        session.playToEnd();
        QCOMPARE(session.rows().answers().size(), 24u);
    }

    void whoWithdrawsLeavesTheirAnswersAndTheSession()
    {
        const auto folder = newStudy();
        {
            EngineSession session(folder, "P01", database::ParticipantKind::Human);
            session.playUntilAnswers(3);
            session.send(WithdrawnEvent{"unwell"});
            QCOMPARE(session.store->slots()[0].state, SlotState::Free);
            QCOMPARE(session.store->enrolments()[0].state, SlotState::Withdrawn);
        }
        EngineSession session(folder, "P01", database::ParticipantKind::Human);
        QVERIFY(!session.step());
        QCOMPARE(session.rows().answers().size(), 3u);
    }

    void aPresentationGivenAgainHasAnotherCode()
    {
        EngineSession session(newStudy(), "S01");
        session.stepUntil("Presenting");
        const protocols::PresentationCode first = session.driver->view().code;
        session.send(Voided{"noise"});
        std::set<std::string> seen{first.value};
        for (int presentation = 2; presentation <= 4; ++presentation) {
            session.stepUntil("Presenting");
            QVERIFY(seen.insert(session.driver->view().code.value).second);
            session.step();
            session.step();
            if (presentation < 4) session.stepUntil("PlacingTray");
        }
        QCOMPARE(seen.size(), 4u);
    }

    void aChangedProtocolIsRefusedUntilItIsTakenOver()
    {
        if (EngineUnderTest::isServer()) QSKIP("a study is amended in its folder");
        const auto folder = newStudy();
        EngineSession(folder, "S01").playUntilAnswers(2);
        StudyRecipe recipe;
        recipe.breakAfter = 3;
        const std::string changed = protocolText(recipe);
        std::ofstream(folder.protocol(), std::ios::binary) << changed;
        try {
            EngineSession session(folder, "S01");
            QFAIL("the session continued with a changed protocol");
        } catch (const protocols::Error& fault) {
            QCOMPARE(fault.exitCode(), protocols::ExitCode::BadInput);
            QVERIFY2(QString(fault.what()).contains("study amend"), fault.what());
        }
        database::StudyStore(folder, database::StudyStore::Access::Write).takeProtocol(changed, "Ada", "shorter blocks");
        QCOMPARE(EngineSession(folder, "S01").driver->plan().protocol.breakAfterPresentations, 4);
        QCOMPARE(EngineSession(folder, "S02").driver->plan().protocol.breakAfterPresentations, 3);
    }

    void factsAndDebriefingLieOutsideTheLog()
    {
        const auto folder = newStudy();
        {
            EngineSession session(folder, "S01");
            session.stepUntil("Debriefing");
            session.send(Debriefed{"cold hands"});
            QCOMPARE(session.rows().personalFacts().at(ParticipantId("S01")).at(debriefingFact), std::string("cold hands"));
        }
        QCOMPARE(rowsFound(folder, "SELECT COUNT(*) FROM events WHERE payload LIKE '%cold hands%'"),
                 std::vector<std::string>{"0"});
    }

    void aFlagIsFoundWithItsPresentation()
    {
        EngineSession session(newStudy(), "S01");
        QVERIFY(session.driver->send(Noted{"", true}).has_value());
        session.playUntilAnswers(3);
        session.send(Noted{"odd", true});
        const auto flags = session.rows().flags();
        QCOMPARE(flags.size(), 1u);
        QCOMPARE(flags[0].trial.value, 3);
        QCOMPARE(flags[0].text, std::string("odd"));
        QVERIFY(session.rows().faults().empty());
    }

    void theTimeLeftFollowsTheParticipantsOwnPace()
    {
        tests::support::StudyRecipe recipe;
        recipe.designSeed = 3;  // the last tray of the choices has the first piece of the ratings in another slot
        EngineSession session(m_engine.study(m_place.filePath("pace").toStdString(), recipe), "S01");
        session.playUntilAnswers(4);
        QCOMPARE(session.driver->view().minutesLeft, 8 * 30.0 / 60);
        session.playUntilAnswers(6);
        session.stepUntil("PlacingTray");
        QCOMPARE(session.driver->view().minutesLeft, 6 * 30.0 / 60);
        for (int i = 1; i <= 5; ++i) {
            session.stepUntil("PlacingTray");
            session.clock.advanceSeconds(i);
            session.playUntilAnswers(6 + i * 3);
        }
        const auto& pace = session.driver->state().pace;
        QCOMPARE(pace.size(), 11u);
        std::vector<double> answers, perPiece;
        for (std::size_t i = 6; i < pace.size(); ++i) {
            // One piece lies on the tray in this phase, and it changes every time.
            QCOMPARE(pace[i].pieces, 1);
            answers.push_back(static_cast<double>(pace[i].answersNs));
            perPiece.push_back(static_cast<double>(pace[i].trayNs));
        }
        std::sort(answers.begin(), answers.end());
        std::sort(perPiece.begin(), perPiece.end());
        QCOMPARE(perPiece, (std::vector<double>{1e9, 2e9, 3e9, 4e9, 5e9}));
        QCOMPARE(session.driver->view().minutesLeft, (answers[2] + perPiece[2]) / 6e10);
    }

    void aLogThatDoesNotHoldTogetherIsRefused()
    {
        const auto folder = newStudy();
        EngineSession(folder, "S01").playUntilAnswers(2);
        m_engine.meddle(folder, "events", "SET kind = 'touched', payload = '{}' WHERE kind = 'tray_ready'");
        try {
            EngineSession session(folder, "S01");
            QFAIL("a broken log cannot be resumed");
        } catch (const protocols::Error& fault) {
            QCOMPARE(fault.exitCode(), protocols::ExitCode::WorkFailed);
            QVERIFY2(QString(fault.what()).contains("is inconsistent"), fault.what());
        }
    }

    void theFingerIsStoredWithTheNextAnswer()
    {
        EngineSession session(newStudy(), "S01");
        const auto move = [&](double seconds, double xMm) {
            session.clock.advanceSeconds(seconds);
            session.driver->addFinger({std::chrono::milliseconds(2), xMm, 20.0, 0.5});
        };
        const auto recordsNow = [&] {
            std::vector<database::FingerRecord> records;
            database::eachFingerRecord(session.rows(), {}, [&](const auto& record) { records.push_back(record); });
            return records;
        };
        session.stepUntil("PlacingTray");
        move(0.1, 1);  // nothing is felt yet
        session.stepUntil("Presenting");
        move(0.1, 2);
        move(0.002, 3);  // closer than 5 ms
        move(0.006, 4);
        session.driver->addFinger({{}, std::nan(""), INFINITY, std::nullopt});  // empty
        session.step();
        const auto first = recordsNow();
        QCOMPARE(first.size(), 1u);
        QCOMPARE(first[0].samples.size(), 2u);
        QCOMPARE(first[0].leftOut, 2);
        QCOMPARE(*first[0].samples[1].xMm, 4.0);
        QCOMPARE(first[0].samples[1].atNs - first[0].samples[0].atNs, 8000000);
        QVERIFY(first[0].samples[0].atNs > session.rows().answers().front().record.readyAtNs);

        session.stepUntil("Presenting");
        move(0.1, 5);
        session.send(Paused{});  // the presentation begins again, and nothing of it was answered
        move(0.1, 6);
        session.send(Resumed{});
        session.stepUntil("Presenting");
        session.step();
        QCOMPARE(recordsNow().size(), 1u);

        session.stepUntil("Presenting");
        move(0.1, 7);
        session.send(Voided{"the hand slipped"});
        const auto voided = recordsNow();
        QCOMPARE(voided.size(), 2u);
        QVERIFY(voided[1].voided && !voided[0].voided);
        QCOMPARE(*voided[1].samples.at(0).xMm, 7.0);
        session.playToEnd();
        QCOMPARE(recordsNow().size(), 2u);
        QVERIFY(session.rows().faults().empty());
    }

    void aFloodOfTheFingerIsBounded()
    {
        FingerRecording recording;
        for (std::int64_t ms = 0; ms < 300000; ++ms) recording.add({ms * 1000000, 1.0, {}, {}});
        recording.add({0, 1.0, {}, {}});  // a clock that goes back
        const auto stretch = recording.unstored({1});
        QCOMPARE(stretch->samples.size(), std::size_t(FingerRecording::mostSamples));
        QCOMPARE(stretch->leftOut, 300001 - FingerRecording::mostSamples);
        // The second sample comes 2 ms early, and each of the others 5 ms after the one before.
        QCOMPARE(stretch->samples.back().atNs, (FingerRecording::mostSamples - 1) * FingerRecording::leastGapNs - 2000000);
        recording.markStored();
        recording.add({400000000000, 1.0, {}, {}});
        QVERIFY(!recording.unstored({1}));  // the bound holds for the whole presentation
        recording.restart();
        recording.add({1, 1.0, {}, {}});
        QVERIFY(recording.unstored({1}));
    }

    /// A driver may send 200 samples a second, and no clock gives them exactly.
    void aSourceOfTheHighestRateLosesNoSample()
    {
        protocols::Random random(7);
        for (const std::int64_t jitterNs : {0, 3'000, 400'000, 1'200'000}) {
            FingerRecording recording;
            for (std::int64_t i = 0; i < 2000; ++i) {
                const auto off = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(2 * jitterNs + 1))) - jitterNs;
                recording.add({1'000'000'000 + i * 5'000'000 + off, 1.0, {}, {}});
            }
            QCOMPARE(recording.unstored({1})->samples.size(), 2000u);
            QCOMPARE(recording.unstored({1})->leftOut, 0);
        }
        for (const std::int64_t everyNs : {4'990'000, 4'000'000, 2'600'000, 1'000'000, 7'000}) {
            FingerRecording recording;
            for (std::int64_t atNs = 0; atNs < 10'000'000'000; atNs += everyNs) recording.add({atNs, 1.0, {}, {}});
            const auto kept = recording.unstored({1})->samples.size();
            QVERIFY2(kept <= 2001 && kept > 1600, qPrintable(QString::number(kept)));
        }
    }

    /// An event of a log without operator reads back like one that names it.
    void sittingsCorrectionsAndVoidsNameTheOperator()
    {
        const auto folder = newStudy();
        EngineSession session(folder, "S01");
        session.driver =
            std::make_unique<Driver>(*session.store, protocols::ParticipantId("S01"), database::ParticipantKind::Scripted,
                                     *session.images, session.display, session.clock, OperatedBy{"Ada", "vis2hap test", "lab-1"});
        session.playUntilAnswers(2);
        session.send(Corrected{protocols::QuestionId("Q1"), session.driver->view().trayIds.front(), "misheard"});
        session.send(Voided{"wrong swatch"});
        std::map<std::string, std::string> last;
        for (const auto& event : session.store->events(protocols::ParticipantId("S01"))) last[event.kind] = event.payloadJson;
        QCOMPARE(last["sitting_started"],
                 std::string(R"({"operator":"Ada","program":"vis2hap test","host":"lab-1","display":"fake"})"));
        QVERIFY(last["corrected"].ends_with(R"("why":"misheard","operator":"Ada"})"));
        QCOMPARE(last["voided"], std::string(R"({"why":"wrong swatch","operator":"Ada"})"));
        const auto state = session.driver->state();
        session.driver =
            std::make_unique<Driver>(*session.store, protocols::ParticipantId("S01"), database::ParticipantKind::Scripted,
                                     *session.images, session.display, session.clock);
        QCOMPARE(session.driver->state().answersStored, state.answersStored);
    }
};

QTEST_GUILESS_MAIN(DriverTest)
#include "driver_test.moc"
