// vis2hap study preregister: the plan as text and JSON, its hash in the log, amendments, late plans, and altered files.
#include <QDir>
#include <QFile>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "database/preregistrations.h"
#include "protocols/files/sha256.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"
#include "tests/support/study_builder.h"

using nlohmann::json;
using support::mustRun;
using support::runProgram;

namespace {

const std::string plannedProtocol = R"({
  "schema": "vis2hap.protocol/1", "name": "Planned study", "participants": 2, "fabrics": ["F01", "F02", "F03"],
  "conditions": ["v_grey", "f", "h&f"],
  "phases": [{"questions": ["Q1"], "alternatives": 3},
             {"questions": ["Feel"], "scale": {"min": 1, "max": 7, "step": 0.5, "sections": 1}},
             {"questions": ["Same"], "same_different": true}],
  "question_texts": {"Feel": "How close is it?", "Same": "Is it the same?"},
  "equivalence_bounds": [-0.8, 0.9],
  "planned": [["v_grey", "f"], ["h&f", "f"]],
  "primary": ["h&f", "f"]
})";

QString bytesOf(const QString& file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()) : QString();
}

json jsonOf(const QString& file) { return json::parse(bytesOf(file).toStdString()); }

void write(const QString& file, const QString& text)
{
    QFile opened(file);
    QVERIFY(opened.open(QIODevice::WriteOnly));
    opened.write(text.toUtf8());
}

}  // namespace

class PreregisterCommandTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString at(const QString& name) const { return m_place.filePath(name); }

    QString newStudy(const std::string& protocol = plannedProtocol)
    {
        const QString study = at(QString("study%1").arg(++m_studies));
        tests::support::buildStudy(study.toStdString(), {.designSeed = 2, .protocol = protocol});
        return study;
    }

    /// The scale from 1 to 7 has bounds of 0.3 then.
    static std::string withoutBounds()
    {
        return QString::fromStdString(plannedProtocol).remove("  \"equivalence_bounds\": [-0.8, 0.9],\n").toStdString();
    }

    static void erase(const QString& study, const char* participant)
    {
        database::StudyStore({study.toStdString()}, database::StudyStore::Access::Write)
            .erase({protocols::ParticipantId(participant), true, "M", "asked for it", {}});
    }

    static std::vector<database::PreregistrationRecord> registered(const QString& study)
    {
        const database::StudyStore store({study.toStdString()}, database::StudyStore::Access::Read);
        return preregistrationsOf(store);
    }

    static void answer(const QString& study, const char* participant, int answers)
    {
        tests::support::OpenSession session({study.toStdString()}, participant);
        session.playUntilAnswers(answers);
    }

    /// Other bounds of equivalence, taken over by `study amend`.
    static void amendBounds(const QString& study)
    {
        write(study + "/protocol.json", QString::fromStdString(plannedProtocol).replace("-0.8, 0.9", "-1.2, 1.2"));
        mustRun({"study", "amend", study, "--who", "M", "--why", "pilot"});
    }

private Q_SLOTS:
    /// Editors of Windows write it, and the database does not keep it.
    void aMarkOfTheByteOrderBreaksNoAmendment()
    {
        const QString study = newStudy(), amended = QString::fromStdString(plannedProtocol).replace("-0.8, 0.9", "-1.2, 1.2");
        write(study + "/protocol.json", QChar(0xFEFF) + amended);
        mustRun({"study", "amend", study, "--who", "M", "--why", "pilot"});
        QCOMPARE(bytesOf(study + "/protocol.json"), amended);
        QVERIFY(mustRun({"verify", study}).out.contains("sound"));
        write(study + "/protocol.json", QChar(0xFEFF) + amended);
        QVERIFY(mustRun({"study", "amend", study, "--who", "M", "--why", "pilot"}).out.contains("unchanged"));
        QCOMPARE(bytesOf(study + "/protocol.json"), amended);
    }

    void textsOfAnyScriptStandInThePlanAsTheyAre()
    {
        const QString study = newStudy();
        const auto amended = [&](const QString& text) {
            write(study + "/protocol.json", QString::fromStdString(plannedProtocol).replace("How close is it?", text));
            return runProgram({"study", "amend", study, "--who", "M", "--why", "words"});
        };
        const auto refused = amended("a\\u001b[2Jb");
        QVERIFY2(refused.exitCode == 2 && refused.err.contains("question_texts.Feel: the text holds the character U+001B"),
                 qPrintable(refused.err));
        const QString hebrew = QString::fromUtf8("כמה קרוב \u2066F01\u2069?");
        QCOMPARE(amended(hebrew + "\\n\\tSay it.").exitCode, 0);
        mustRun({"study", "preregister", study});
        QVERIFY(bytesOf(study + "/preregistration.txt").contains("- Feel: \"" + hebrew + "  Say it.\" Answer:"));
        QCOMPARE(amended(QString::fromUtf8("turned \u2066F01?")).exitCode, 0);
        mustRun({"study", "preregister", study});
        QVERIFY(bytesOf(study + "/preregistration-2.txt").contains("- Feel: \"turned \\xe2\\x81\\xa6F01?\" Answer:"));
    }

    void copiesGoIntoANewFolder()
    {
        const QString study = newStudy(), copies = at("new/copies");
        mustRun({"study", "preregister", study, "--out", copies});
        QVERIFY(QFile::exists(copies + "/preregistration.txt") && QFile::exists(copies + "/preregistration.json"));
        QCOMPARE(registered(study).size(), std::size_t(1));
    }

    void theTextSaysWhatTheProtocolSays()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study, "--who", "Ada Müller"});
        const QString text = bytesOf(study + "/preregistration.txt");
        QVERIFY(!text.contains("mismatch_rated_high"));  // only of anchors
        for (const char* line :
             {"STUDY PLAN: Planned study\n", " by Ada Müller, before the first answer.\n",
              "- Q1: under each condition, the share of right answers is above chance, 1/3 (one-sided).\n",
              "- Feel, primary: the mean rating differs between h&f and f (two-sided).\n",
              "- Feel: for each planned contrast, the difference of the mean ratings lies within -0.8 and 0.9 (equivalence).\n",
              "- Feel: \"How close is it?\" Answer: a number from 1 to 7; scored as it is.\n",
              "one of 2 answers is right; scored 1 or 0; chance is 1/2", "Conditions (3): v_grey, f, h&f.\n",
              "Fabrics (3): F01 (fabric 01), F02 (fabric 02), F03 (fabric 03).\n", "Primary contrast: h&f - f. It belongs",
              "first minus second):\n- h&f - f\n- v_grey - f\n", "The claim for fabrics like these decides.", "alpha = 0.05",
              "Correction: Holm's", "The main analysis excludes no participant", "- too_fast: more than 5 %",
              "2 participants. Data collection stops when this number have finished."})
            QVERIFY2(text.contains(QString::fromUtf8(line)), line);
        const json plan = jsonOf(study + "/preregistration.json");
        QCOMPARE(plan["schema"].get<std::string>(), std::string("vis2hap.preregistration/1"));
        QCOMPARE(plan["plan"]["equivalence_bounds"], json::parse("[-0.8, 0.9]"));
        QCOMPARE(plan["plan"]["planned"],
                 json::parse(R"([{"a":"h&f","b":"f","primary":true},{"a":"v_grey","b":"f","primary":false}])"));
        QCOMPARE(plan["plan"]["questions"][2]["chance"], 0.5);
        QCOMPARE(plan["answers_before"], 0);
        QCOMPARE(plan["study"]["protocol_sha256"].get<std::string>(), protocols::sha256(plannedProtocol));
    }

    /// An earlier version wrote other sentences. Before the answers a plan takes the new ones; afterwards it would be a late one.
    void rulesOfAnEarlierVersionAreNoLateAmendment()
    {
        const QString study = newStudy(), early = newStudy(), other = newStudy();
        mustRun({"study", "preregister", other});
        auto record = registered(other)[0];
        auto plan = nlohmann::ordered_json::parse(record.json);
        auto& rules = plan["plan"]["exclusions"]["rules"];
        rules.erase(rules.size() - 1);
        record.json = plan.dump(2) + "\n";
        for (const QString& one : {study, early})
            recordPreregistration({{one.toStdString()}, database::StudyStore::Access::Write}, record);
        answer(study, "S01", 5);
        QVERIFY(mustRun({"study", "preregister", study}).out.contains("nothing has changed"));
        QCOMPARE(registered(study).size(), std::size_t(1));
        mustRun({"verify", study});
        mustRun({"study", "preregister", early});
        QVERIFY(bytesOf(early + "/preregistration-2.txt").contains("since registration 1: exclusions.\n"));
        mustRun({"verify", early});
    }

    /// R: power.t.test(n = 2, delta = 0.6, sd = sqrt(2*(.15 + .85/3))*0.6, type = "paired", strict = TRUE): the scale from 1 to 7
    /// has six tenths of the length of 0 to 10.
    void thePowerIsThatOfTheDesign()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        const json power = jsonOf(study + "/preregistration.json")["power"];
        QCOMPARE(power.size(), std::size_t(3));
        QCOMPARE(power[1]["question"], "Feel");
        const json& claim = power[1]["claims"][2];
        QCOMPARE(claim["true_difference"], 0.6);
        QCOMPARE(claim["generalises_to"], "these_fabrics");
        QCOMPARE(claim["power"], 0.098);
        QVERIFY(claim["power_first_step_of_holm"] < claim["power"]);
    }

    void nothingInThePlanTellsWhatAStimulusIs()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        const QString both = bytesOf(study + "/preregistration.txt") + bytesOf(study + "/preregistration.json");
        const auto stimuli = QDir(study + "/stimuli").entryInfoList(QDir::Files);
        QCOMPARE(stimuli.size(), 9);
        for (const auto& stimulus : stimuli) QVERIFY(!both.contains(stimulus.completeBaseName()));
        QVERIFY(!both.contains(QRegularExpression("\\bK[0-9]\\b")));
    }

    void theLogHoldsTheHashOfBothFiles()
    {
        const QString study = newStudy();
        const json said = json::parse(mustRun({"study", "preregister", study, "--json"}).out.toStdString());
        const auto records = registered(study);
        QCOMPARE(records.size(), std::size_t(1));
        QCOMPARE(records[0].jsonSha256(), protocols::sha256OfFile((study + "/preregistration.json").toStdString()));
        QCOMPARE(records[0].textSha256(), protocols::sha256OfFile((study + "/preregistration.txt").toStdString()));
        QCOMPARE(jsonOf(study + "/preregistration.json")["text_sha256"].get<std::string>(), records[0].textSha256());
        QCOMPARE(said["sha256"].get<std::string>(), records[0].jsonSha256());
        QCOMPARE(jsonOf(study + "/preregistration.json")["registered_at"].get<std::string>(), records[0].wallTime);
        mustRun({"verify", study});
        const auto status = mustRun({"study", "status", study});
        QVERIFY(status.out.contains("before the first answer, SHA-256 " + QString::fromStdString(records[0].jsonSha256())));
    }

    /// Also the state after a crash between the log and the files.
    void theSameCallWritesMissingFilesAgain()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        const QString text = bytesOf(study + "/preregistration.txt"), plan = bytesOf(study + "/preregistration.json");
        QVERIFY(QFile::remove(study + "/preregistration.txt") && QFile::remove(study + "/preregistration.json"));
        const auto missing = runProgram({"verify", study});
        QCOMPARE(missing.exitCode, 1);
        QVERIFY(missing.out.contains("preregistration.txt: missing") && missing.out.contains("preregistration.json: missing"));
        const auto again = mustRun({"study", "preregister", study, "--out", at("copies")});
        QVERIFY(again.out.contains("nothing has changed"));
        QCOMPARE(bytesOf(study + "/preregistration.txt"), text);
        QCOMPARE(bytesOf(study + "/preregistration.json"), plan);
        QCOMPARE(bytesOf(at("copies/preregistration.txt")), text);
        QCOMPARE(registered(study).size(), std::size_t(1));
        mustRun({"verify", study});
    }

    void anAlteredFileIsAFault()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        write(study + "/preregistration.txt", bytesOf(study + "/preregistration.txt").replace("h&f - f", "f - h&f"));
        const auto found = runProgram({"verify", study});
        QCOMPARE(found.exitCode, 1);
        QVERIFY(found.out.contains("preregistration.txt: differs from the plan that was registered on"));
        const auto refused = runProgram({"study", "preregister", study});
        QCOMPARE(refused.exitCode, 2);
        QCOMPARE(refused.messages().size(), 1);
        QVERIFY2(refused.err.contains("preregistration.txt") && refused.err.contains("move the file away"),
                 qPrintable(refused.err));
    }

    void anAlteredEntryOfTheLogIsAFault()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        tests::support::RawSqlite sqlite((study + "/study.db").toStdString());
        sqlite.dropTriggers();
        QCOMPARE(sqlite.run("UPDATE events SET payload = replace(payload, '-0.8', '-1.8') WHERE kind = 'preregistered'"),
                 std::string());
        const auto found = runProgram({"verify", study});
        QCOMPARE(found.exitCode, 1);
        QVERIFY2(found.out.contains("(preregistered): the registered plan does not have its own hash"), qPrintable(found.out));
    }

    void foreignFilesAndUntakenEditsAreRefused()
    {
        const QString study = newStudy();
        write(study + "/preregistration.txt", "mine");
        QCOMPARE(runProgram({"study", "preregister", study}).exitCode, 2);
        QVERIFY(QFile::remove(study + "/preregistration.txt"));
        QVERIFY(QDir().mkpath(at("full")));
        write(at("full/preregistration.json"), "mine");
        QCOMPARE(runProgram({"study", "preregister", study, "--out", at("full")}).exitCode, 2);
        QCOMPARE(bytesOf(at("full/preregistration.json")), QString("mine"));
        write(study + "/protocol.json", QString::fromStdString(plannedProtocol).replace("-0.8", "-0.7"));
        const auto edited = runProgram({"study", "preregister", study});
        QCOMPARE(edited.exitCode, 2);
        QVERIFY2(edited.err.contains("study amend"), qPrintable(edited.err));
        QVERIFY(registered(study).empty());
        QVERIFY(!QFile::exists(study + "/preregistration.txt"));
        QCOMPARE(runProgram({"study", "preregister", at("nowhere")}).exitCode, 2);
    }

    void anAmendmentNamesTheEarlierPlan()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        const QString first = QString::fromStdString(registered(study)[0].jsonSha256());
        amendBounds(study);
        mustRun({"study", "preregister", study});
        QCOMPARE(registered(study).size(), std::size_t(2));
        const QString text = bytesOf(study + "/preregistration-2.txt");
        QVERIFY(text.contains("This is registration 2, an amendment.\nRegistration 1 has the SHA-256 " + first));
        QVERIFY(text.contains("since registration 1: equivalence_bounds.\n"));
        QVERIFY(bytesOf(study + "/preregistration.txt").contains("-0.8 and 0.9"));
        mustRun({"verify", study});
        // Both were registered before the first answer: the report follows the later one.
        answer(study, "S01", 27);
        mustRun({"report", study, "--out", at("amended")});
        const json results = jsonOf(at("amended/results.json"));
        QVERIFY(bytesOf(at("amended/tables/plan.csv")).contains("bounds of equivalence,'-1.2 and 1.2,'-1.2 and 1.2,yes"));
        const json& plan = results["preregistration"];
        QCOMPARE(plan["followed"], 2);
        QCOMPARE(plan["amendments"][0]["changes"], json::parse(R"(["equivalence_bounds"])"));
    }

    void aLatePlanSaysHowManyAnswersThereWere()
    {
        const QString study = newStudy();
        answer(study, "S01", 5);
        QVERIFY(mustRun({"study", "preregister", study}).out.contains("after 5 answers"));
        QVERIFY(bytesOf(study + "/preregistration.txt").contains("5 answers were stored before this plan was registered."));
        QCOMPARE(jsonOf(study + "/preregistration.json")["timing"], "after 5 answers");
        mustRun({"report", study, "--out", at("late")});
        const json plan = jsonOf(at("late/results.json"))["preregistration"];
        QCOMPARE(plan["answers_before"], 5);
        QCOMPARE(plan["deviations"][0]["item"], "registration");
        QVERIFY(bytesOf(at("late/index.html")).contains(", after 5 answers, SHA-256"));
        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        amendBounds(study);
        mustRun({"study", "preregister", study});
        QVERIFY(bytesOf(study + "/preregistration-2.txt").contains("after 5 answers and after the unblinding"));
    }

    /// Who saw the answers before they were erased knew them.
    void erasedAnswersCameBeforeALatePlan()
    {
        const QString study = newStudy();
        answer(study, "S01", 5);
        erase(study, "S01");
        QVERIFY(mustRun({"study", "preregister", study}).out.contains("after 5 answers"));
        QVERIFY(bytesOf(study + "/preregistration.txt")
                    .contains("5 answers were stored before this plan was registered; 5 of them had already been erased."));
        QVERIFY(mustRun({"study", "status", study}).out.contains("after 5 answers"));
        answer(study, "S02", 27);
        mustRun({"report", study, "--out", at("erased")});
        QCOMPARE(jsonOf(at("erased/results.json"))["preregistration"]["deviations"][0]["item"], "registration");
        QVERIFY(bytesOf(at("erased/tables/plan.csv")).contains(", after 5 answers\",no"));
    }

    /// Earlier versions counted the answers that were still there, and so none.
    void anOlderPlanAfterErasedAnswersIsLate()
    {
        const QString study = newStudy(), other = newStudy();
        mustRun({"study", "preregister", other});
        answer(study, "S01", 5);
        erase(study, "S01");
        recordPreregistration({{study.toStdString()}, database::StudyStore::Access::Write}, registered(other)[0]);
        QCOMPARE(registered(study)[0].answersBefore, std::size_t(5));
        answer(study, "S02", 27);
        mustRun({"report", study, "--out", at("older")});
        QVERIFY(bytesOf(at("older/index.html")).contains(", after 5 answers, SHA-256"));
        QVERIFY(!bytesOf(at("older/index.html")).contains("Nothing differs from the plan."));
    }

    void aPlanWithoutBoundsTakesTheDefaultAndSaysSo()
    {
        const QString study = newStudy(withoutBounds());
        mustRun({"study", "preregister", study});
        const QString text = bytesOf(study + "/preregistration.txt");
        QVERIFY(text.contains("the difference of the mean ratings lies within -0.3 and 0.3 (equivalence).\n"));
        QVERIFY(
            text.contains("at the bounds -0.3 and 0.3 scale points. The protocol states none: they are the default of this "
                          "program, a twentieth of the scale either way.\n"));
        QCOMPARE(jsonOf(study + "/preregistration.json")["plan"]["equivalence_bounds"], json::parse("[-0.3, 0.3]"));
        QVERIFY(mustRun({"study", "preregister", study}).out.contains("nothing has changed"));
        answer(study, "S01", 27);
        mustRun({"report", study, "--out", at("usual")});
        QVERIFY(bytesOf(at("usual/tables/plan.csv")).contains("bounds of equivalence,'-0.3 and 0.3,'-0.3 and 0.3,yes"));
    }

    /// Earlier versions took half a point on every scale. What was registered stays.
    void registeredBoundsOfAnEarlierDefaultStay()
    {
        const QString study = newStudy(withoutBounds()), other = newStudy(withoutBounds());
        mustRun({"study", "preregister", other});
        auto record = registered(other)[0];
        auto plan = nlohmann::ordered_json::parse(record.json);
        plan["plan"]["equivalence_bounds"] = {-0.5, 0.5};
        record.json = plan.dump(2) + "\n";
        recordPreregistration({{study.toStdString()}, database::StudyStore::Access::Write}, record);
        QVERIFY(mustRun({"study", "preregister", study}).out.contains("nothing has changed"));
        write(study + "/protocol.json",
              QString::fromStdString(withoutBounds()).replace("How close is it?", "How close does it feel?"));
        mustRun({"study", "amend", study, "--who", "M", "--why", "clearer words"});
        mustRun({"study", "preregister", study});
        QCOMPARE(registered(study).size(), std::size_t(2));
        QVERIFY(!bytesOf(study + "/preregistration-2.txt").contains("since registration 1: equivalence_bounds"));
        QCOMPARE(jsonOf(study + "/preregistration-2.json")["plan"]["equivalence_bounds"], json::parse("[-0.5, 0.5]"));
        answer(study, "S01", 27);
        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        mustRun({"report", study, "--out", at("half")});
        const QString table = bytesOf(at("half/tables/plan.csv"));
        QVERIFY2(table.contains("bounds of equivalence,'-0.5 and 0.5,'-0.5 and 0.5,yes") && !table.contains("changed:"),
                 qPrintable(table));
        QVERIFY(bytesOf(at("half/index.html"))
                    .simplified()
                    .contains("The registered plan states their bounds: \u22120.5 and 0.5 scale points."));
    }

    /// A plan that is changed after answers is shown, and the report follows the one before them.
    void theReportFollowsThePlanBeforeTheAnswers()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        answer(study, "S01", 27);
        amendBounds(study);
        mustRun({"study", "preregister", study});
        mustRun({"report", study, "--out", at("kept")});
        const json results = jsonOf(at("kept/results.json"));
        QVERIFY(bytesOf(at("kept/tables/plan.csv")).contains("bounds of equivalence,'-0.8 and 0.9,'-0.8 and 0.9,yes"));
        QCOMPARE(results["preregistration"]["followed"], 1);
        QStringList items;
        for (const json& row : results["preregistration"]["deviations"]) items << QString::fromStdString(row["item"]);
        QCOMPARE(items, (QStringList{"amendments", "protocol (SHA-256)", "participants", "answers"}));
        QVERIFY(bytesOf(at("kept/tables/plan.csv")).contains("not followed here"));
    }

    void aBlindedReportNamesNoCondition()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        for (const char* participant : {"S01", "S02"})
            tests::support::OpenSession({study.toStdString()}, participant).playToEnd();
        mustRun({"report", study, "--out", at("blinded")});
        for (const char* file : {"blinded/results.json", "blinded/statistics.json", "blinded/tables/plan.csv"})
            for (const char* condition : {"v_grey", "h&f", "\"f\""}) QVERIFY2(!bytesOf(at(file)).contains(condition), file);
        QVERIFY(bytesOf(at("blinded/tables/plan.csv")).contains("planned contrasts,2,left out while blinded,-"));
        QVERIFY(bytesOf(at("blinded/tables/plan.csv")).contains("participants,2,2 finished,yes"));
        QVERIFY(!QFile::exists(at("blinded/tables/plan_contrasts.csv")));
        QCOMPARE(jsonOf(at("blinded/results.json"))["preregistration"]["deviations"], json::array());
        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        mustRun({"report", study, "--out", at("open")});
        QVERIFY(bytesOf(at("open/tables/plan.csv")).contains("primary contrast,h&f - f,\"tested in Q1, Feel and Same\",yes"));
        QVERIFY(bytesOf(at("open/tables/plan_contrasts.csv")).contains("v_grey,f,,\"Q1, Feel and Same\",,"));
    }

    void aStudyWithoutAPlanSaysSo()
    {
        const QString study = newStudy();
        answer(study, "S01", 27);
        mustRun({"report", study, "--out", at("none")});
        const json plan = jsonOf(at("none/results.json"))["preregistration"];
        QCOMPARE(plan["registered"], false);
        QVERIFY(plan["time"].is_null() && plan["why"]["time"] == "the study was not preregistered");
        QVERIFY(bytesOf(at("none/index.html")).contains("The study was not preregistered."));
        QVERIFY(mustRun({"study", "status", study}).out.contains("not preregistered"));
    }
};

QTEST_GUILESS_MAIN(PreregisterCommandTest)
#include "preregister_command_test.moc"
