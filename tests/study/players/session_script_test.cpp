// A recorded session, exported as a script, stores the same rows when it is replayed on a twin of its study.
#include "study/players/session_script.h"

#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "study/players/script.h"
#include "study/players/scripted_participant.h"
#include "tests/support/error_text.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/server/engine_session.h"
#include "tests/support/study_builder.h"

using namespace study::session;
using namespace tests::support;
using protocols::ParticipantId;
using protocols::QuestionId;
using protocols::Tenths;

namespace {

/// A row of the view without its times.
std::vector<std::string> rowsOf(const database::StudyStore& store)
{
    std::vector<std::string> rows;
    for (const auto& answer : store.answers()) {
        const auto& record = answer.record;
        rows.push_back(answer.participant.value + " " + std::to_string(record.trial.value) + " " +
                       std::to_string(answer.attempt) + " " + record.question.value + " " + record.presentationCode.value + " " +
                       (record.answer ? *record.answer : std::to_string(record.rating->value)) + " " +
                       std::to_string(answer.seconds) + " touched " +
                       (record.touchedAtNs ? std::to_string(*record.touchedAtNs - record.readyAtNs) + record.touchedBy : "no") +
                       " corrections " + std::to_string(answer.corrections) + (answer.voided ? " void" : "") + " note '" +
                       record.note + "'");
    }
    for (const auto& flag : store.flags()) rows.push_back("flag " + std::to_string(flag.trial.value) + " " + flag.text);
    return rows;
}

/// A session with everything that an operator may do.
void playEventfully(EngineSession& session)
{
    session.playUntilAnswers(1);
    session.send(Noted{"sneezed", false});
    session.stepUntil("Presenting");
    session.send(Voided{"wrong swatch"});
    session.playUntilAnswers(3);
    session.send(Corrected{QuestionId("Q1"), session.driver->plan().trials[2].alternatives[0], "misheard"});
    session.stepUntil("Presenting");
    session.send(Touched{TouchSource::Display});
    session.send(Paused{});
    session.send(Resumed{});
    session.playUntilAnswers(9);
    session.send(Voided{"noise"});
    session.playUntilAnswers(12);
    session.send(Noted{"look at this", true});
    session.playUntilAnswers(14);
    session.send(Corrected{QuestionId("Q2"), Tenths{54}, "misheard"});
    session.playToEnd();
}

std::string scriptOf(const database::StudyStore& store, const std::filesystem::path& out)
{
    const auto protocol = study::records::protocolOf(store.facts());
    const auto naming = recordedUnblinding(store) ? study::records::namingOf(store, protocol, {}) : std::nullopt;
    study::players::writeScripts(store, naming ? &*naming : nullptr, out);
    return protocols::readWholeFile(out / "S01.json");
}

void replay(const std::string& text, EngineSession& session)
{
    const auto plan = readPlan(session.rows(), ParticipantId("S01"));  // a server gives no trial ahead
    const auto script = study::players::scriptFromJson(text, "exported", plan.protocol);
    study::players::DriverHands hands(*session.driver);
    const study::players::ScriptedTrials trials{
        plan.trials, readAllocationKeyForTestDriver(session.rows(), database::ParticipantKind::Scripted, {}), plan.protocol,
        plan.fabricNames};
    study::players::playScript(script, trials, {}, hands, session.clock);
}

}  // namespace

class SessionScriptTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    EngineUnderTest m_engine;

    std::filesystem::path newPath() { return m_place.filePath(QString("place%1").arg(++m_studies)).toStdString(); }

private Q_SLOTS:
    void initTestCase()
    {
        if (const QString why = EngineUnderTest::whyMissing(); !why.isEmpty()) QSKIP(qPrintable(why));
    }

    void aRecordedSessionReplaysToTheSameRows_data()
    {
        QTest::addColumn<bool>("unblinded");
        QTest::addColumn<double>("deadTimeSeconds");
        QTest::newRow("by trial, blinded") << false << 0.0;
        QTest::newRow("by rendering, unblinded") << true << 0.0;
        QTest::newRow("a dead time longer than a script's steps") << false << 5.0;
    }

    void aRecordedSessionReplaysToTheSameRows()
    {
        QFETCH(bool, unblinded);
        QFETCH(double, deadTimeSeconds);
        const StudyRecipe recipe{.deadTimeSeconds = deadTimeSeconds};
        EngineSession recorded(m_engine.study(newPath(), recipe), "S01");
        playEventfully(recorded);
        if (unblinded && EngineUnderTest::isServer()) QSKIP("a study is unblinded in its folder");
        if (unblinded)
            unblind(dynamic_cast<database::StudyStore&>(*recorded.store), {"Ada", "it is over", "2026-01-01T00:00:00Z"}, {});
        const auto out = newPath();
        std::filesystem::create_directory(out);
        const std::string text = scriptOf(recorded.rows(), out);
        QCOMPARE(text.find("v_grey") != std::string::npos, unblinded);
        EngineSession twin(m_engine.study(newPath(), recipe), "S01");
        replay(text, twin);
        const auto rows = rowsOf(recorded.rows()), again = rowsOf(twin.rows());
        QVERIFY(rows.size() > 24u);
        for (std::size_t i = 0; i < std::min(rows.size(), again.size()); ++i) QCOMPARE(again[i], rows[i]);
        QCOMPARE(again.size(), rows.size());
    }

    /// The log then belongs to a place without trials.
    void aParticipantMovedToAnotherSlotIsNamed()
    {
        if (EngineUnderTest::isServer()) QSKIP("the rows of a server are not altered here");
        const auto folder = buildStudy(newPath());
        OpenSession(folder, "S01").playToEnd();
        RawSqlite raw(folder.database());
        raw.dropTriggers();
        QCOMPARE(raw.run("PRAGMA foreign_keys = 0; PRAGMA ignore_check_constraints = 1;"
                         "UPDATE participants SET slot = 99 WHERE id = 'S01'"),
                 "");
        const auto out = newPath();
        std::filesystem::create_directory(out);
        const database::StudyStore store(folder, database::StudyStore::Access::Read);
        const QString said = errorOf([&] { study::players::writeScripts(store, nullptr, out); });
        QVERIFY2(said.startsWith("1: "), qPrintable(said));
    }

    void whatAScriptExpectsIsChecked_data()
    {
        QTest::addColumn<QString>("event");
        QTest::addColumn<QString>("fault");
        QTest::newRow("a stage that is") << R"({"after_answer":4,"do":"expect","stage":"OnBreak"})"
                                         << "";
        QTest::newRow("a stage that is not") << R"({"after_answer":3,"do":"expect","stage":"OnBreak"})"
                                             << "the stage is PlacingTray";
        QTest::newRow("a question that is asked") << R"({"before_answer":8,"do":"expect","question":"Q3","presentation":7})"
                                                  << "";
        QTest::newRow("a question that is not") << R"({"before_answer":8,"do":"expect","question":"Q2"})"
                                                << "the question is Q3";
        QTest::newRow("refused, as it must")
            << R"({"before_answer":8,"do":"answer","answer":11,"must_fail":true,"refusal":"not on the scale"})"
            << "";
        QTest::newRow("accepted, though it must fail") << R"({"before_answer":8,"do":"touch","must_fail":true})"
                                                       << "was accepted";
        QTest::newRow("refused for another reason")
            << R"({"before_answer":8,"do":"answer","answer":11,"must_fail":true,"refusal":"disk full"})"
            << "was refused with";
    }

    void whatAScriptExpectsIsChecked()
    {
        QFETCH(QString, event);
        QFETCH(QString, fault);
        EngineSession recorded(m_engine.study(newPath()), "S01");
        recorded.playToEnd();
        const auto out = newPath();
        std::filesystem::create_directory(out);
        auto script = nlohmann::ordered_json::parse(scriptOf(recorded.rows(), out));
        script["events"] = {nlohmann::ordered_json::parse(event.toStdString())};
        EngineSession twin(m_engine.study(newPath()), "S01");
        QString said;
        try {
            replay(script.dump(), twin);
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::WorkFailed);
            said = error.what();
        }
        QCOMPARE(said.isEmpty(), fault.isEmpty());
        QVERIFY2(said.contains(fault), qPrintable(said));
    }

    void aRefusedAnswerNamesItsTrial()
    {
        EngineSession recorded(m_engine.study(newPath()), "S01");
        recorded.playToEnd();
        const auto out = newPath();
        std::filesystem::create_directory(out);
        auto script = nlohmann::ordered_json::parse(scriptOf(recorded.rows(), out));
        script["answers"][7]["answer"] = 11;
        EngineSession twin(m_engine.study(newPath()), "S01");
        QString said;
        try {
            replay(script.dump(), twin);
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::BadInput);
            said = error.what();
        }
        QVERIFY2(said.contains("not on the scale") && said.contains(QRegularExpression("exported: S01, trial 7 \\(\\w+\\), Q3")),
                 qPrintable(said));
    }
};

QTEST_GUILESS_MAIN(SessionScriptTest)
#include "session_script_test.moc"
