// The data of one person, as `vis2hap export STUDY --participant ID` gives them: before and after the unblinding, after erasures,
// and in the language of the study.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/usual_texts.h"
#include "tests/study/commands/evidence_study.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/raw_sqlite.h"

using nlohmann::json;
using support::mustRun;
using support::runProgram;
using tests::evidence::askingProtocol;
using tests::evidence::bytesOf;
using tests::evidence::cell;
using tests::evidence::jsonOf;
using tests::evidence::tableOf;
using tests::support::OpenSession;

class OwnDataCommandTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString at(const QString& name) const { return m_place.filePath(name); }

    QString playedStudy(const std::string& protocol = askingProtocol)
    {
        const QString study = at(QString("study%1").arg(++m_studies));
        tests::evidence::playStudy(study.toStdString(), protocol);
        return study;
    }

private Q_SLOTS:
    void aPersonGetsTheirData()
    {
        const QString study = playedStudy();
        const QString out = at("person");
        const auto run = mustRun({"export", study, "--participant", "P1", "--out", out});
        QVERIFY2(run.out.contains("blinded (no condition, no fabric"), qPrintable(run.out));
        const json data = jsonOf(out + "/your-data.json");
        QCOMPARE(data["schema"].get<std::string>(), "vis2hap.participant/1");
        QCOMPARE(data["consent"]["text"].get<std::string>(), "I agree to take part.");
        QVERIFY(data["consent"]["time"].is_string());
        QCOMPARE(data["facts"].size(), std::size_t{2});  // age and the debriefing
        QCOMPARE(data["facts"][1]["value"].get<std::string>(), "it was fun");
        QCOMPARE(data["notes"].size(), std::size_t{2});  // one of the operator, one of the void
        QCOMPARE(data["notes"][0]["text"].get<std::string>(), "smells of <glue>");
        QCOMPARE(data["state"].get<std::string>(), "finished");
        tests::support::RawSqlite raw(study.toStdString() + "/study.db");
        QCOMPARE(std::to_string(data["answers"].size()),
                 raw.rows("SELECT COUNT(*) FROM responses WHERE participant = 'P1'").front());
        std::set<std::string> letters, kinds;
        for (const auto& answer : data["answers"]) {
            kinds.insert(answer["question"]);
            if (answer["question"] == "Q1") letters.insert(answer["answer"]);
            if (answer["question"] == "Feel") QVERIFY(answer["rating"].is_number());
        }
        QVERIFY((kinds == std::set<std::string>{"Q1", "Feel", "Why", "Same"}));
        QVERIFY(std::ranges::includes(std::set<std::string>{"A", "B", "C"}, letters));
        const auto table = tableOf(out + "/your-answers.csv");
        QCOMPARE(table.rows.size(), data["answers"].size());
        QCOMPARE(cell(table, 0, "participant"), "P1");
        QCOMPARE(cell(table, 0, "answer_begun_by"), "entry");
        QCOMPARE(cell(table, 0, "response_seconds"), "2");
        QCOMPARE(cell(table, 0, "touching_seconds"), "2.5");
        const QString page = bytesOf(out + "/your-data.html");
        for (const char* text : {"Your data in the study A &lt;study&gt; of touch", "smells of &lt;glue&gt;", "it was fun",
                                 "I agree to take part.", "wrong piece", "You may ask for a new sheet after the study"})
            QVERIFY2(page.contains(text), text);
    }

    /// The sheet of a study in another language: nothing in it is English but what people wrote.
    void aSheetIsInTheLanguageOfTheStudy_data()
    {
        QTest::addColumn<QString>("language");
        QTest::addColumn<QStringList>("texts");
        QTest::newRow("de-AT") << "de-AT"
                               << QStringList{"<html lang=\"de-AT\">",
                                              "Ihre Daten in der Studie A &lt;study&gt; of touch",
                                              "Sie haben die Studie abgeschlossen.",
                                              "<td>gleich</td>",
                                              ",5</td>",
                                              "Eine Darbietung wurde für ungültig erklärt.",
                                              "Grund: wrong piece",
                                              "<td>Export</td>"};
        QTest::newRow("zh") << "zh"
                            << QStringList{"<html lang=\"zh\">", "您已完成本研究。", "<td>相同</td>", "原因：wrong piece"};
        QTest::newRow("fr") << "fr"
                            << QStringList{"<html lang=\"en\">", "You have finished the study.", "<td>same</td>", ".5</td>"};
    }
    void aSheetIsInTheLanguageOfTheStudy()
    {
        QFETCH(const QString, language);
        QFETCH(const QStringList, texts);
        std::string protocol = askingProtocol;
        const std::string scale = R"("min": 1, "max": 7, "step": 0.5)";
        protocol.replace(protocol.find(scale), scale.size(), R"("min": 1.5, "max": 6.5, "step": 1)");
        protocol.replace(protocol.find("\"facts\""), 0, "\"language\": \"" + language.toStdString() + "\", ");
        const QString study = playedStudy(protocol);
        mustRun({"export", study, "--out", at("before-" + language)});
        mustRun({"export", study, "--participant", "P1", "--out", at("sheet-" + language)});
        const QString page = bytesOf(at("sheet-" + language + "/your-data.html"));
        for (const QString& text : texts) QVERIFY2(page.contains(text), qPrintable(text + " is not in " + page));
        if (language == "fr") return;
        QVERIFY(language != "de-AT" || !page.contains(".5</td>"));
        for (const auto& [key, text] : protocols::usualTexts("en").ownData) {
            const QString whole = QString::fromStdString(text);
            if (whole.size() > 12 && !whole.contains('{')) QVERIFY2(!page.contains(whole), text.c_str());
        }
    }

    /// No fabric, no condition, nothing about right or wrong, and nothing about other people.
    void aBlindedSheetUnblindsNothing()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--participant", "P1", "--out", at("blind")});
        for (const char* file : {"your-data.html", "your-data.json", "your-answers.csv"}) {
            const QString text = bytesOf(at("blind/") + file);
            for (const char* word : {"F01", "F02", "F03", "v_grey", "h&f", "h&amp;f", "correct\"", "P2", "Ada", "K1", "fabric\""})
                QVERIFY2(!text.contains(word), qPrintable(QString(file) + " names " + word));
        }
    }

    void afterTheUnblindingThePersonSeesWhatWasRight()
    {
        const QString study = playedStudy();
        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        mustRun({"export", study, "--participant", "P1", "--out", at("open")});
        mustRun({"export", study, "--out", at("open-all"), "--format", "json"});
        const json data = jsonOf(at("open/your-data.json"));
        QVERIFY(!data["blinded"].get<bool>());
        const auto keyOf = [](const json& row) { return std::pair(row["trial"].get<int>(), row["question"].get<std::string>()); };
        std::map<std::pair<int, std::string>, json> expected;
        const json all = jsonOf(at("open-all/export.json"));
        for (const auto& row : all["answers"])
            if (row["participant"] == "P1" && row["voided"] == 0) expected[keyOf(row)] = row;
        int choices = 0;
        for (const auto& answer : data["answers"]) {
            if (answer["voided"].get<bool>()) continue;
            const json& row = expected.at(keyOf(answer));
            QCOMPARE(answer["fabric"], row["fabric"]);
            QCOMPARE(answer["condition"], row["condition"]);
            if (answer["question"] != "Q1") continue;
            ++choices;
            QCOMPARE(answer["answer_fabric"], row["answer"]);
            QCOMPARE(answer["correct"].get<bool>(), row["correct"] == 1);
            QCOMPARE(row["alternatives"][static_cast<std::size_t>(answer["answer"].get<std::string>()[0] - 'A')], row["answer"]);
        }
        QCOMPARE(choices, 6);
        QVERIFY(bytesOf(at("open/your-data.html")).contains("<th>condition</th>"));
    }

    void anErasedPersonGetsWhatIsLeft()
    {
        const QString study = playedStudy();
        mustRun({"erase", study, "--participant", "P1", "--who", "Ada", "--why", "on request", "--answers"});
        const auto run = mustRun({"export", study, "--participant", "P1", "--out", at("erased")});
        QVERIFY2(run.out.contains("0 answers, 0 facts, 0 notes") && run.out.contains("erased on "), qPrintable(run.out));
        const json data = jsonOf(at("erased/your-data.json"));
        QCOMPARE(data["erasures"].size(), std::size_t{1});
        QCOMPARE(data["erasures"][0]["who"].get<std::string>(), "Ada");
        QVERIFY(data["answers"].empty() && data["facts"].empty() && data["sittings"].empty());
        QVERIFY(data["consent"]["time"].is_null() && data["consent"]["why"]["time"].is_string());
        const QString page = bytesOf(at("erased/your-data.html"));
        QVERIFY(page.contains("Reason: on request") && !page.contains("glue") && !page.contains("it was fun"));
        const QStringList certificates = QDir(at("erased")).entryList({"erasure-*.txt"});
        QCOMPARE(certificates.size(), 1);
        QVERIFY(bytesOf(at("erased/") + certificates.front()).contains("Certificate of erasure"));
    }

    /// The folder is handed to the person: nothing of an earlier one may lie in it.
    void aHandOverHoldsOnePerson()
    {
        const QString study = playedStudy();
        const QStringList call{"export", study, "--participant", "P1", "--out", at("hand")};
        mustRun(call);
        QFile(at("hand/your-finger-samples.csv")).open(QIODevice::WriteOnly);
        mustRun(call);
        QVERIFY(!QFile::exists(at("hand/your-finger-samples.csv")));  // this export has none
        QFile other(at("hand/your-data.json"));
        QByteArray data = bytesOf(other.fileName()).toUtf8();
        QVERIFY(other.open(QIODevice::WriteOnly));
        other.write(data.replace("\"P1\"", "\"P2\""));
        other.close();
        const auto refused = support::runProgram(call);
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("need a folder of their own"), qPrintable(refused.err));
    }

    /// The folder holds nothing about anybody else, and its name may hold a person's.
    void aHandOverIsNoCopyOfOtherPeoplesData()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--participant", "P2", "--out", at("of P2, Anna")});
        const auto copiesOf = [&](const char* person) {
            const QString out = at(QString("copies of ") + person);
            mustRun({"export", study, "--participant", person, "--out", out});
            return QString::fromStdString(jsonOf(out + "/your-data.json")["copies"].dump());
        };
        QVERIFY(!copiesOf("P1").contains("Anna"));
        QVERIFY2(copiesOf("P2").contains("of P2, Anna"), qPrintable(copiesOf("P2")));
    }

    /// A replay of the folder would bring the answers back.
    void aScriptOfErasedAnswersLeavesTheFolder()
    {
        const QString study = playedStudy();
        const QStringList call{"export", study, "--format", "script", "--out", at("scripts")};
        mustRun(call);
        QVERIFY(QFile::exists(at("scripts/P1.json")));
        QFile mine(at("scripts/mine.json"));
        QVERIFY(mine.open(QIODevice::WriteOnly));
        mustRun({"erase", study, "--participant", "P1", "--who", "Ada", "--why", "on request", "--answers"});
        const auto run = mustRun(call);
        QVERIFY2(run.out.contains("removed P1.json of an earlier export"), qPrintable(run.out));
        QVERIFY(!QFile::exists(at("scripts/P1.json")) && QFile::exists(at("scripts/mine.json")));
    }

    /// What an earlier export wrote and this one does not is old, and may hold what was erased since.
    void filesOfAnEarlierExportAreNamed()
    {
        const QString study = playedStudy();
        mustRun({"export", study, "--with-log", "--out", at("twice")});
        const auto run = mustRun({"export", study, "--format", "json", "--out", at("twice")});
        QVERIFY2(run.out.contains("flags.csv, log.csv, acts.csv and log.txt, which this export did not write"),
                 qPrintable(run.out));
    }

    void factsAloneCanBeErased()
    {
        const QString study = playedStudy();
        mustRun({"erase", study, "--participant", "P1", "--who", "Ada", "--why", "on request"});
        mustRun({"export", study, "--participant", "P1", "--out", at("factless")});
        const json data = jsonOf(at("factless/your-data.json"));
        QVERIFY(data["facts"].empty() && data["answers"].size() > 10);
        QVERIFY(bytesOf(at("factless/your-data.html")).contains("Facts about you and your comments"));
        QVERIFY(bytesOf(at("factless/your-data.html")).contains("What is left: your answers, notes and times"));
    }

    /// The finger of P1 in every presentation that is answered.
    void samplesOfTheFingerLeaveTheStudyOnlyUnblinded()
    {
        const QString study = at(QString("study%1").arg(++m_studies));
        tests::support::buildStudy(study.toStdString(), {.protocol = askingProtocol});
        {
            OpenSession session({study.toStdString()}, "P1", database::ParticipantKind::Human);
            do {
                for (int sample = 0; sample < 60; ++sample) {
                    session.clock.advanceSeconds(0.01);
                    session.driver->addFinger({{}, 31.4159 + 0.7 * sample, 20.5, 0.4321});
                }
            } while (session.step());
        }
        const QString needle = "3142,2050,432";  // of the stored text
        tests::support::RawSqlite raw(study.toStdString() + "/study.db");
        QVERIFY(QString::fromStdString(raw.rows("SELECT samples FROM finger_samples LIMIT 1").front()).contains(needle));
        const auto run = runProgram({"export", study, "--out", at("too-early"), "--with-samples"});
        QCOMPARE(run.exitCode, 2);
        QVERIFY2(run.err.contains("after the unblinding only"), qPrintable(run.err));
        QVERIFY(!QFile::exists(at("too-early")));
        mustRun({"export", study, "--participant", "P1", "--out", at("own-blind")});
        const json blind = jsonOf(at("own-blind/your-data.json"));
        QVERIFY(blind["finger_samples"].get<int>() > 500);
        QVERIFY(!QFile::exists(at("own-blind/your-finger-samples.csv")));
        QVERIFY(bytesOf(at("own-blind/your-data.html")).contains("You get them with a new sheet after the study"));
        for (const char* format : {"csv", "json", "script"})
            mustRun({"export", study, "--out", at(QString("blind-%1").arg(format)), "--format", format, "--with-log"});
        mustRun({"report", study, "--out", at("blind-report")});
        // The key of this study lies open. Speed and force by label are left out all the same.
        QVERIFY(jsonOf(at("blind-report/results.json"))["touch"].is_null());

        mustRun({"unblind", study, "--who", "M", "--why", "done"});
        mustRun({"export", study, "--out", at("samples"), "--with-samples"});
        const auto table = tableOf(at("samples/finger_samples.csv"));
        QCOMPARE(static_cast<int>(table.rows.size()), blind["finger_samples"].get<int>());
        QCOMPARE(cell(table, 0, "x_mm"), "31.42");
        QCOMPARE(cell(table, 0, "force_n"), "0.432");
        QVERIFY(!cell(table, 0, "condition").isEmpty() && !cell(table, 0, "fabric").isEmpty());
        mustRun({"export", study, "--participant", "P1", "--out", at("own")});
        QCOMPARE(tableOf(at("own/your-finger-samples.csv")).rows.size(), table.rows.size());
        mustRun({"report", study, "--out", at("report"), "--quick"});
        const json touch = jsonOf(at("report/results.json"))["touch"];
        QVERIFY(touch["presentations"].get<int>() > 10);
        for (const auto& [condition, part] : touch["conditions"].items()) {
            QVERIFY2(std::abs(part["speed_mm_per_s"]["mean"].get<double>() - 70) < 0.5, condition.c_str());  // 0.7 mm in 10 ms
            QVERIFY(std::abs(part["force_n"]["mean"].get<double>() - 0.432) < 1e-9);
        }
        QVERIFY(bytesOf(at("report/tables/touch.csv")).startsWith("condition,measure,presentations"));
        QVERIFY(bytesOf(at("report/index.html")).contains("The finger on the display"));
        mustRun({"erase", study, "--participant", "P1", "--who", "Ada", "--why", "on request", "--answers"});
        const QStringList certificates = QDir(study + "/erasures").entryList({"erasure-*.txt"});
        QVERIFY(bytesOf(study + "/erasures/" + certificates.front()).contains(" samples of the finger on the display"));
        QCOMPARE(runProgram({"verify", study}).exitCode, 0);
    }

    void onlyKnownPeopleHaveData()
    {
        const auto run = runProgram({"export", playedStudy(), "--participant", "P9", "--out", at("nobody")});
        QCOMPARE(run.exitCode, 2);
        QVERIFY2(run.err.contains("unknown participant P9"), qPrintable(run.err));
        QVERIFY(!QFile::exists(at("nobody")));
    }
};

QTEST_GUILESS_MAIN(OwnDataCommandTest)
#include "own_data_command_test.moc"
