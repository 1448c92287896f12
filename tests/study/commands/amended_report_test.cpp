// The report of a study whose protocol was amended: sentences and languages are those that participants followed, and bounds
// count only if they stood before the first answer.
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/study_builder.h"

using nlohmann::json;
using support::mustRun;

namespace {

const std::string firstProtocol = R"({
  "schema": "vis2hap.protocol/1", "name": "Amended study", "participants": 2, "fabrics": ["F01", "F02", "F03"],
  "conditions": ["v_grey", "f", "h&f"],
  "phases": [{"questions": ["Q1"], "alternatives": 3, "instructions": [
               {"id": "quick", "aim": "speed", "text": "First words"}, {"id": "slow", "aim": "accuracy"}]},
             {"questions": ["Feel"], "scale": {"min": 0, "max": 10}}],
  "question_texts": {"Feel": "How close is the feeling?"}
})";

QString bytesOf(const QString& file)
{
    QFile opened(file);
    return opened.open(QIODevice::ReadOnly) ? QString::fromUtf8(opened.readAll()) : QString();
}

void write(const QString& file, const json& content)
{
    QFile opened(file);
    QVERIFY(opened.open(QIODevice::WriteOnly));
    opened.write(QByteArray::fromStdString(content.dump(1)));
}

json jsonOf(const QString& file) { return json::parse(bytesOf(file).toStdString()); }

/// The page with one blank between words, wherever its lines end.
QString pageOf(const QString& report) { return bytesOf(report + "/index.html").simplified(); }

QStringList deviationsOf(const json& results)
{
    QStringList items;
    for (const json& row : results["preregistration"]["deviations"]) items << QString::fromStdString(row["item"]);
    return items;
}

}  // namespace

class AmendedReportTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString newStudy()
    {
        const QString study = m_place.filePath(QString("study%1").arg(++m_studies));
        tests::support::buildStudy(study.toStdString(), {.designSeed = 2, .protocol = firstProtocol});
        return study;
    }

    static void play(const QString& study, const char* participant)
    {
        tests::support::OpenSession({study.toStdString()}, participant).playToEnd();
    }

    /// Takes over a protocol in German with another sentence and with bounds of 5. Returns what the command says.
    static QString amend(const QString& study)
    {
        json amended = json::parse(firstProtocol);
        amended["language"] = "de";
        amended["question_texts"]["Feel"] = "Wie nah ist das Gefühl?";
        amended["phases"][0]["instructions"][0]["text"] = "Later words";
        amended["equivalence_bounds"] = {-5, 5};
        write(study + "/protocol.json", amended);
        return mustRun({"study", "amend", study, "--who", "M", "--why", "pilot"}).out;
    }

    static QString reportOf(const QString& study)
    {
        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        mustRun({"report", study, "--out", study + "-report", "--quick"});
        return study + "-report";
    }

private Q_SLOTS:
    /// What was corrected before the first participant is what the report quotes and analyses by.
    void aCorrectionBeforeTheFirstAnswerCounts()
    {
        const QString study = newStudy();
        QVERIFY(!amend(study).contains("note:"));
        for (const char* participant : {"S01", "S02"}) play(study, participant);
        const QString report = reportOf(study), page = pageOf(report);
        QVERIFY(page.contains("Wie nah ist das Gefühl?") && !page.contains("How close is the feeling?"));
        QVERIFY(page.contains("the corrected wording in German, translation not reviewed"));
        QVERIFY(page.contains("The language of the participants is &#39;de&#39;"));
        QVERIFY(page.contains("The protocol was amended: all analysed participants followed version 2."));
        QVERIFY(page.contains("The plan is that of version 2 of its protocol, the last one before the first answer."));
        QVERIFY(page.contains("Version 2 of the protocol states their bounds: \u22125 and 5 scale points."));
        QVERIFY(!page.contains("They are not used"));
        const json statistics = jsonOf(report + "/statistics.json"), results = jsonOf(report + "/results.json");
        QCOMPARE(statistics["data"]["questions"][1]["text"].get<std::string>(), std::string("Wie nah ist das Gefühl?"));
        QVERIFY(!statistics["data"]["questions"][1].contains("wordings"));
        QCOMPARE(statistics["q1_instructions"]["instructions"][0]["text"].get<std::string>(), std::string("Later words"));
        QCOMPARE(results["preregistration"]["protocol_version"], 2);
        QCOMPARE(results["study"]["protocol_versions"][0]["participants"], 0);
        QCOMPARE(results["study"]["protocol_versions"][1]["participants"], 2);
        QVERIFY(!deviationsOf(results).contains("protocol (SHA-256)"));
        QVERIFY(bytesOf(report + "/tables/plan.csv").contains("bounds of equivalence,'-5 and 5,'-5 and 5,yes"));
    }

    /// Two instructions of one question and one of the other: 2 participants x 3 fabrics x 3 conditions x 3 answers.
    void everyInstructionBelongsToThePlannedAnswers()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        for (const char* participant : {"S01", "S02"}) play(study, participant);
        const QString report = reportOf(study);
        QVERIFY2(bytesOf(report + "/tables/plan.csv").contains("answers,54,54,yes"),
                 qPrintable(bytesOf(report + "/tables/plan.csv")));
        QVERIFY(pageOf(report).contains("Nothing differs from the plan."));
        mustRun({"export", study, "--out", study + "-exported"});
        mustRun({"report", "--from", study + "-exported/answers.csv", "--protocol", study + "/protocol.json", "--out",
                 study + "-again", "--quick", "--page-only"});
        QVERIFY(bytesOf(study + "-again/tables/plan.csv").contains("answers,54,54,yes"));
    }

    /// Each sentence stands with the participants who followed it. Bounds that were changed after answers do not count.
    void anAmendmentBetweenParticipantsShowsBoth()
    {
        const QString study = newStudy();
        play(study, "S01");
        const QString told = amend(study);
        QVERIFY2(told.contains("note: equivalence bounds changed after the first answer: reports keep those of the plan before"),
                 qPrintable(told));
        play(study, "S02");
        const QString report = reportOf(study), page = pageOf(report);
        QVERIFY(page.contains(
            "\u201CHow close is the feeling?\u201D (1 participant, version 1 of the protocol) and \u201CWie nah ist "
            "das Gefühl?\u201D (1 participant, version 2 of the protocol)"));
        QVERIFY(
            page.contains("The protocol was amended: 1 participant followed version 1 and 1 participant followed version 2."));
        QVERIFY(page.contains(
            "Their bounds are the default of this program: \u22120.5 and 0.5 scale points, a twentieth of the scale "
            "either way. Version 1 of the protocol states none. The latest version of the protocol has other "
            "bounds. They are not used"));
        const json statistics = jsonOf(report + "/statistics.json");
        QCOMPARE(statistics["data"]["questions"][1]["wordings"],
                 json::parse(R"([{"text":"How close is the feeling?","protocol_versions":[1],"participants":["S01"]},
                                 {"text":"Wie nah ist das Gefühl?","protocol_versions":[2],"participants":["S02"]}])"));
        QStringList languages;
        for (const json& stamp : statistics["data"]["stamps"])
            if (const QString text = QString::fromStdString(stamp); text.startsWith("The language")) languages << text;
        QCOMPARE(languages,
                 (QStringList{"The language of 1 participant is 'en'.",
                              "The language of 1 participant is 'de'; the program's own sentences in German: translation "
                              "not reviewed."}));
        QVERIFY(deviationsOf(jsonOf(report + "/results.json")).contains("protocol (SHA-256)"));
        QVERIFY(bytesOf(report + "/tables/plan.csv").contains("bounds of equivalence,'-0.5 and 0.5,'-0.5 and 0.5,yes"));
    }

    /// Registering other bounds after the answers does not make them planned.
    void aLateRegistrationOfOtherBoundsIsNotFollowed()
    {
        const QString study = newStudy();
        play(study, "S01");
        amend(study);
        mustRun({"study", "preregister", study});
        const QString report = reportOf(study);
        const json plan = jsonOf(report + "/results.json")["preregistration"];
        QVERIFY(plan["followed"].is_null() && plan["registered"] == true);
        QCOMPARE(plan["protocol_version"], 1);
        QVERIFY(deviationsOf(jsonOf(report + "/results.json")).contains("registration"));
        QVERIFY(bytesOf(report + "/tables/plan.csv").contains("bounds of equivalence,'-0.5 and 0.5,'-0.5 and 0.5,yes"));
        QVERIFY(pageOf(report).contains("This plan is not followed, because it changes what the protocol stated before"));
    }

    /// The erased answers were known when the bounds were changed.
    void anErasureMovesNoPlan()
    {
        const QString study = newStudy();
        play(study, "S01");
        database::StudyStore({study.toStdString()}, database::StudyStore::Access::Write)
            .erase({protocols::ParticipantId("S01"), true, "M", "asked for it", {}});
        QVERIFY(amend(study).contains("note: equivalence bounds changed after the first answer"));
        mustRun({"study", "preregister", study});  // no answer is there now, but one was
        play(study, "S02");
        const QString report = reportOf(study), page = pageOf(report);
        QVERIFY(page.contains("Wie nah ist das Gefühl?") && !page.contains("How close is the feeling?"));
        QVERIFY(bytesOf(report + "/tables/plan.csv").contains("bounds of equivalence,'-0.5 and 0.5,'-0.5 and 0.5,yes"));
        QCOMPARE(jsonOf(report + "/results.json")["preregistration"]["answers_before"], 27);
    }

    /// The bounds of the plan count, and participants read the later words.
    void aRewordedQuestionIsNamedBesideOtherBounds()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        json amended = json::parse(firstProtocol);
        amended["question_texts"]["Feel"] = "How near is the feeling?";
        amended["equivalence_bounds"] = {-5, 5};
        write(study + "/protocol.json", amended);
        mustRun({"study", "amend", study, "--who", "M", "--why", "pilot"});
        play(study, "S01");
        const QString report = reportOf(study), table = bytesOf(report + "/tables/plan.csv");
        QVERIFY2(table.contains("; changed: equivalence bounds; the plan is followed here; also changed: wording of Feel"),
                 qPrintable(table));
        QVERIFY2(table.contains("questions,2,2; reworded: Feel,no"), qPrintable(table));
        const QStringList deviations = deviationsOf(jsonOf(report + "/results.json"));
        QVERIFY(deviations.contains("questions") && deviations.contains("protocol (SHA-256)"));
        amended.erase("equivalence_bounds");
        amended["question_texts"]["Feel"] = "How close is the feeling?";
        amended["phases"][0]["instructions"][0]["text"] = "Later words";
        write(study + "/protocol.json", amended);
        mustRun({"study", "amend", study, "--who", "M", "--why", "pilot"});
        mustRun({"report", study, "--out", report, "--quick"});
        const QString later = bytesOf(report + "/tables/plan.csv");
        QVERIFY2(later.contains("; changed: wording of the instruction quick") && later.contains("; reworded: Feel"),
                 qPrintable(later));
        QVERIFY(!later.contains("the plan is followed here"));
    }

    void anAmendmentAfterARegistrationSaysWhatToDo()
    {
        const QString study = newStudy();
        mustRun({"study", "preregister", study});
        const QString told = amend(study);
        QVERIFY2(told.contains("note: the registered plan states other equivalence bounds") && told.contains("study preregister"),
                 qPrintable(told));
        play(study, "S01");
        QVERIFY(pageOf(reportOf(study)).contains("The registered plan states their bounds: \u22120.5 and 0.5 scale points."));
    }

    void aStudyWithoutAmendmentsSaysNothingOfVersions()
    {
        const QString study = newStudy();
        play(study, "S01");
        const QString report = reportOf(study), page = pageOf(report);
        QVERIFY(page.contains("The study was not preregistered. The plan is that of its first protocol."));
        QVERIFY(page.contains("a twentieth of the scale either way. The protocol states none."));
        QVERIFY(!page.contains("amended") && !page.contains("of the protocol states"));
        QVERIFY(!jsonOf(report + "/results.json")["study"].contains("protocol_versions"));
        QVERIFY(!jsonOf(report + "/results.json")["preregistration"].contains("protocol_version"));
    }
};

QTEST_GUILESS_MAIN(AmendedReportTest)
#include "amended_report_test.moc"
