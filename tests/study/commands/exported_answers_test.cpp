// Studies of several designs, played, exported and analysed again from answers.csv: the numbers are those of the study's own
// report, whatever the design is and whatever happened in the sessions.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/study/commands/psych_ds_files.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
#include "tests/support/study_builder.h"

using nlohmann::json;
using study::session::Presenting;
using support::mustRun;
using support::runProgram;
using namespace tests::support;

namespace {

std::string protocolOf(const json& phases)
{
    json protocol{{"schema", "vis2hap.protocol/1"},
                  {"name", "another lab"},
                  {"participants", 4},
                  {"conditions", {"v_grey", "f", "h&f"}},
                  {"phases", phases},
                  {"dead_time_seconds", 0},
                  {"fabrics", {"F01", "F02", "F03"}},
                  {"planned", json::array({json::array({"h&f", "v_grey"})})},
                  {"question_texts", json::object()}};
    for (const json& phase : phases)
        for (const json& question : phase["questions"]) protocol["question_texts"][question.get<std::string>()] = "How is it?";
    return protocol.dump();
}

json rating(const json& questions) { return {{"questions", questions}, {"scale", {{"min", 0}, {"max", 10}}}}; }
json choice(const char* question, int alternatives) { return {{"questions", {question}}, {"alternatives", alternatives}}; }

/// Answers one presentation as a person does: the first question is touched, each answer takes a time to type. Words are empty or
/// "NA"; nobody begins to type an empty answer.
void answer(OpenSession& session)
{
    const auto presenting = std::get<Presenting>(session.driver->state().stage);
    session.clock.advanceSeconds(1 + 0.25 * (session.driver->state().answersStored % 7));
    if (presenting.question == 0) session.send(study::session::Touched{});
    session.clock.advanceSeconds(2 + 0.5 * (session.driver->state().answersStored % 5));
    study::session::AnswerStamps stamps;
    stamps.begunAgoNs = 700'000'000;
    stamps.begunBy = study::session::BegunBy::Entry;
    study::session::GivenAnswer given = responseTo(session.driver->view());
    if (auto* words = std::get_if<study::session::Words>(&given)) {
        words->text = session.driver->state().answersStored % 2 == 0 ? "" : "NA";
        if (words->text.empty()) stamps.begunAgoNs.reset();
    }
    session.send(study::session::Answered{given, stamps});
}

void playUntilAnswers(OpenSession& session, int answers)
{
    while (session.driver->state().answersStored < answers)
        if (std::holds_alternative<Presenting>(session.driver->state().stage))
            answer(session);
        else if (!session.step())
            return;
}

/// A table of answers has no row of a presentation that was voided without one.
json withoutVoids(json flags)
{
    json others = json::array();
    for (const json& flag : flags)
        if (flag["flag"] != "voided_presentations") others.push_back(flag);
    return others;
}

std::string bytesOf(const QString& file)
{
    std::ifstream in(file.toStdString(), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

class ExportedAnswersTest : public QObject {
    Q_OBJECT
    QTemporaryDir m_place;
    int m_studies = 0;

    QString at(const QString& name) const { return m_place.filePath(name); }

    /// An unblinded study. P02 withdrew, P03 had a void and came a second day; four finished.
    QString study(const json& phases)
    {
        const QString folder = at(QString("study%1").arg(++m_studies));
        buildStudy(folder.toStdString(), {.protocol = protocolOf(phases)});
        constexpr int all = 1 << 20;
        for (const char* person : {"P01", "P02", "P03", "P04", "P05"}) {
            const std::string name = person;
            {
                OpenSession session({folder.toStdString()}, name);
                playUntilAnswers(session, name == "P02" || name == "P03" ? 5 : all);
                if (name == "P02") session.send(study::session::WithdrawnEvent{"wants to stop"});
            }
            if (name != "P03") continue;
            OpenSession again({folder.toStdString()}, name);
            again.stepUntil("Presenting");
            answer(again);
            if (std::holds_alternative<Presenting>(again.driver->state().stage))
                again.send(study::session::Voided{"the cloth slipped"});
            else
                again.stepUntil("Presenting"), again.send(study::session::Voided{"the cloth slipped"});
            playUntilAnswers(again, all);
        }
        mustRun({"unblind", folder, "--who", "M", "--why", "done"});
        return folder;
    }

    json resultsOf(const QStringList& arguments)
    {
        const QString out = at("report");
        QDir(out).removeRecursively();
        mustRun(QStringList{"report", "--out", out, "--page-only"} + arguments);
        return json::parse(bytesOf(out + "/results.json"));
    }

private Q_SLOTS:
    void theNumbersAreThoseOfTheOwnReport_data()
    {
        QTest::addColumn<QString>("phases");
        const auto row = [](const char* name, const json& phases) {
            QTest::newRow(name) << QString::fromStdString(phases.dump());
        };
        row("two pieces", {choice("Q1", 2), rating({"Q2", "Q3"})});
        row("three pieces", {choice("Q1", 3), rating({"Q2", "Q3"})});
        row("two and three pieces", {choice("Q1", 2), choice("Q2", 3)});
        row("same or different", {{{"questions", {"Q1"}}, {"same_different", true}}, rating({"Q2"})});
        json instructed = choice("Q1", 3);
        instructed["instructions"] = {{{"id", "speed"}, {"aim", "speed"}}, {{"id", "careful"}, {"deadline_seconds", 3}}};
        row("instructions in one phase", {instructed, rating({"Q2"})});
        json caught = choice("Q1", 3), rated = rating({"Q2"});
        caught["catch_trials"] = 5;
        rated["catch_trials"] = 4;
        row("more catch trials than fabrics", {caught, rated});
        row("questions like columns", {choice("session", 3), rating({"group", "my_answer"}), rating({"first_trial", "state"}),
                                       choice("feels_correct", 3), rating({"x_seconds", "repetition"})});
    }

    void theNumbersAreThoseOfTheOwnReport()
    {
        QFETCH(const QString, phases);
        const QString of = study(json::parse(phases.toStdString()));
        const QString out = of + "-exported";
        mustRun({"export", of, "--out", out});
        json own = resultsOf({of}), described = resultsOf({"--from", out + "/answers.csv", "--protocol", of + "/protocol.json"}),
             alone = resultsOf({"--from", out + "/answers.csv"});
        for (json* results : {&own, &described}) (*results)["quality"] = withoutVoids((*results)["quality"]);
        for (const char* part : {"conditions", "questions", "comparisons", "equivalence", "claims", "above_chance", "omnibus",
                                 "speed_accuracy", "quality"}) {
            QVERIFY2(own.contains(part), part);
            QCOMPARE(QString::fromStdString(described[part].dump(1)), QString::fromStdString(own[part].dump(1)));
        }
        // The file alone tells the kind of each answer.
        for (const char* part : {"questions", "above_chance", "speed_accuracy"})
            QCOMPARE(QString::fromStdString(alone[part].dump(1)), QString::fromStdString(own[part].dump(1)));
    }

    /// An empty answer in words is an answer. It has no stamp of its beginning, and takes no time from the choices and ratings.
    void slotsTimesAndEmptyWordsSurviveTheExport()
    {
        const QString of = study(
            {choice("Q1", 3), {{"questions", {"Q2", "Why"}}, {"scale", {{"min", 0}, {"max", 10}}}, {"free_text", {"Why"}}}});
        mustRun({"export", of, "--out", of + "-exported"});
        const auto numbersOf = [&](const QStringList& arguments) {
            const json results = resultsOf(arguments), statistics = json::parse(bytesOf(at("report/statistics.json")));
            return json{{"questions", results["questions"]},
                        {"quality", withoutVoids(results["quality"])},
                        {"speed", results["speed_accuracy"]},
                        {"slots", statistics["q1_confusion"]["slots"]},
                        {"missing", statistics["data"]["missing_responses"]}};
        };
        const json own = numbersOf({of});
        QVERIFY(QString::fromStdString(bytesOf(at("report/index.html"))).contains("to the beginning of the answer"));
        const json again = numbersOf({"--from", of + "-exported/answers.csv", "--protocol", of + "/protocol.json"});
        QCOMPARE(QString::fromStdString(again.dump(1)), QString::fromStdString(own.dump(1)));
        QVERIFY(own["slots"].size() > 1 && own["missing"] == 0);
        QVERIFY(own["questions"]["Why"]["f"]["answers"].get<int>() > 0);
    }

    /// The page of the study and that of its export say alike that no person answered.
    void whoAnsweredStandsInTheExport()
    {
        const QString of = study(json::array({rating({"Q2"})}));
        mustRun({"export", of, "--public", "--author", "A", "--out", of + "-public"});
        const Rows rows = *csvRows(bytesOf(of + "-public/answers.csv"));
        for (std::size_t row = 1; row < rows.size(); ++row) QCOMPARE(cellAt(rows, row, "kind"), std::string("scripted"));
        const json about = resultsOf({"--from", of + "-public/answers.csv"})["study"];
        QVERIFY(about["simulated"] == false && about["scripted"] == true && resultsOf({of})["study"]["scripted"] == true);
        QVERIFY(QString::fromStdString(bytesOf(at("report/index.html"))).contains("SCRIPTED participants"));
    }

    void answersOfWithdrawnPeopleAreMarkedAndNotPublished()
    {
        const QString of = study({choice("Q1", 3), rating({"Q2"})});
        mustRun({"export", of, "--out", of + "-exported"});
        const Rows rows = *csvRows(bytesOf(of + "-exported/answers.csv"));
        std::map<std::string, std::set<std::string>> states;
        std::set<std::string> sittings;
        bool hasMoved = false;
        for (std::size_t row = 1; row < rows.size(); ++row) {
            states[cellAt(rows, row, "state")].insert(cellAt(rows, row, "participant"));
            if (cellAt(rows, row, "participant") != "P03") continue;
            sittings.insert(cellAt(rows, row, "sitting"));
            hasMoved =
                hasMoved || (cellAt(rows, row, "attempt") == "2" && cellAt(rows, row, "place") != cellAt(rows, row, "trial"));
        }
        QCOMPARE(states["withdrawn"], std::set<std::string>{"P02"});
        QCOMPARE(states["finished"].size(), std::size_t(4));
        QCOMPARE(sittings.size(), std::size_t(2));
        QVERIFY(hasMoved);
        const auto said = mustRun({"report", "--from", of + "-exported/answers.csv", "--out", of + "-report", "--page-only"});
        QVERIFY2(said.err.contains("5 answers of participants who withdrew left out"), qPrintable(said.err));

        const auto published = mustRun({"export", of, "--public", "--author", "A", "--out", of + "-public"});
        QVERIFY2(published.out.contains("5 answers of participants who withdrew are left out"), qPrintable(published.out));
        QVERIFY(!QString::fromStdString(bytesOf(of + "-public/answers.csv")).contains("P02"));
        QVERIFY(QString::fromStdString(bytesOf(of + "-public/participants.csv")).contains("P02"));
    }

    /// A wrong piece is mostly seen before the answer. Such a void has no row in the table of answers, and a note says so.
    void aVoidBeforeTheAnswerCountsLikeAnyOther()
    {
        const QString of = at("voids");
        buildStudy(of.toStdString(), {.protocol = protocolOf({choice("Q1", 3), rating({"Q2"})})});
        for (const std::string person : {"P01", "P02", "P03"}) {
            OpenSession session({of.toStdString()}, person);
            playUntilAnswers(session, 1);
            session.send(study::session::Voided{"seen by the participant"});
            session.stepUntil("Presenting");
            session.send(study::session::Voided{"wrong piece"});
            if (person == "P02")
                session.send(study::session::WithdrawnEvent{"wants to stop"});
            else
                playUntilAnswers(session, 1 << 20);
        }
        const json status = json::parse(mustRun({"study", "status", of, "--json"}).out.toStdString());
        int voided = 0;
        for (const json& slot : status["slots"]) voided += slot.value("voided_presentations", 0);
        QCOMPARE(voided, 4);
        const QString flag = "4 presentations were voided and presented again; answers to them are kept and not analysed";
        mustRun({"export", of, "--out", of + "-blinded"});
        QVERIFY(QString::fromStdString(bytesOf(of + "-blinded/flags.csv")).contains(flag));

        mustRun({"unblind", of, "--who", "M", "--why", "done"});
        resultsOf({of});
        QCOMPARE(json::parse(bytesOf(at("report/statistics.json")))["data"]["voided_presentations"], json(voided));
        QVERIFY(QString::fromStdString(bytesOf(at("report/tables/quality.csv"))).contains(flag));
        QVERIFY(QString::fromStdString(bytesOf(at("report/tables/plan.csv"))).contains("4 presentations voided and presented"));
        QVERIFY(QString::fromStdString(bytesOf(at("report/index.html"))).simplified().contains("4 presentations were voided."));

        mustRun({"export", of, "--out", of + "-exported"});
        const auto again = mustRun({"report", "--from", of + "-exported/answers.csv", "--out", of + "-again", "--page-only"});
        // P01 and P03 had one void after the answer and one before it; P02 withdrew.
        QVERIFY2(again.err.contains("2 voided presentations left out; a table of answers has no row of those that were voided "
                                    "without an answer"),
                 qPrintable(again.err));
        QCOMPARE(json::parse(bytesOf(of + "-again/statistics.json"))["data"]["voided_presentations"], json(2));
        QVERIFY(QString::fromStdString(bytesOf(of + "-again/tables/quality.csv"))
                    .contains("2 presentations were voided and presented again; answers to them are kept and not analysed"));
        QVERIFY(bytesOf(of + "-exported/codebook.csv").find("those voided after an answer count") != std::string::npos);
    }

    /// P02 withdrew, and P04 was erased after the end: no answer of P04 is kept, and the place is empty.
    void erasedPeopleAreToldApart()
    {
        const QString of = study({choice("Q1", 3), rating({"Q2"})});
        mustRun({"erase", of, "--participant", "P04", "--who", "Ada", "--why", "on request", "--answers"});
        resultsOf({of});
        const QString page = QString::fromStdString(bytesOf(at("report/index.html"))).simplified();
        for (const char* sentence :
             {"In addition, 1 participant withdrew. Answers given before are kept and not analysed",
              "The answers of 1 participant were erased, and the place became free again.",
              "54 of 72 expected answers are analysed, 18 are missing, 18 of them of places that nobody has.",
              "Missing answers by condition, of the 3 participants analysed"})
            QVERIFY2(page.contains(sentence), sentence);
        QVERIFY(QString::fromStdString(bytesOf(at("report/tables/plan.csv"))).contains("withdrew: 1; answers erased: 1"));
        const json missing = json::parse(bytesOf(at("report/statistics.json")))["data"];
        QCOMPARE(missing["missing_responses"], json(18));
        QCOMPARE(missing["missing_by_condition"]["Q1"]["f"], json(0));
        mustRun({"export", of, "--format", "psych-ds", "--out", of + "-set"});
        mustRun({"export", of, "--format", "psych-ds", "--public", "--out", of + "-open"});
        QVERIFY(QString::fromStdString(bytesOf(of + "-set/README.md")).contains("by 4 participants (4 scripted)"));
        QVERIFY(QString::fromStdString(bytesOf(of + "-open/README.md")).contains("by 3 participants (3 scripted)"));
    }

    /// Two numbers of alternatives under one question cannot come from one study.
    void mixedAlternativesAreRefusedAlsoWithTheProtocol()
    {
        const QString of = study(json::array({choice("Q1", 2)}));
        mustRun({"export", of, "--out", of + "-exported"});
        std::string text = bytesOf(of + "-exported/answers.csv");
        const std::size_t list = text.find("\"[\"\"");
        text.insert(list + 2, "\"\"F09\"\",");
        std::ofstream(at("mixed.csv").toStdString()) << text;
        const auto said = runProgram({"report", "--from", at("mixed.csv"), "--out", at("mixed"), "--page-only"});
        QCOMPARE(said.exitCode, 2);
        QVERIFY2(said.err.contains("several numbers of alternatives"), qPrintable(said.err));
        const auto described = runProgram(
            {"report", "--from", at("mixed.csv"), "--protocol", of + "/protocol.json", "--out", at("mixed"), "--page-only"});
        QCOMPARE(described.exitCode, 2);
        QVERIFY2(described.err.contains("column alternatives: the tray of Q1 has 3 pieces, but by the protocol Q1 is a choice "
                                        "among 2"),
                 qPrintable(described.err));
    }

    /// A place that several trials share has an occurrence in the script of each.
    void scriptsOfSharedPlacesReplay()
    {
        json caught = choice("Q1", 3), rated = rating({"Q2"});
        caught["catch_trials"] = 5;
        rated["anchors"] = {{"mismatched", 7}};
        const QString of = study({caught, rated});
        mustRun({"export", of, "--out", of + "-scripts", "--format", "script"});
        const QString second = at("second");
        buildStudy(second.toStdString(), {.protocol = protocolOf({caught, rated})});
        for (const char* person : {"P01", "P02", "P03", "P04", "P05"})
            mustRun({"replay", second, of + "-scripts/" + person + ".json"});
        mustRun({"unblind", second, "--who", "M", "--why", "done"});
        mustRun({"export", of, "--out", of + "-exported"});
        mustRun({"export", second, "--out", second + "-exported"});
        const Rows first = *csvRows(bytesOf(of + "-exported/answers.csv")),
                   again = *csvRows(bytesOf(second + "-exported/answers.csv"));
        QCOMPARE(again.size(), first.size());
        for (std::size_t row = 1; row < first.size(); ++row)
            for (const char* column : {"participant", "trial", "question", "fabric", "condition", "answer", "rating", "voided"})
                QCOMPARE(cellAt(again, row, column), cellAt(first, row, column));
    }

    /// A shell sorts P10 before P8. A blinded script in another running order gave its answers to other images, without a word.
    void scriptsReplayInTheirRunningOrders()
    {
        const json rated = json::array({rating({"Q2"})});
        const QString of = study(rated), other = at("in-any-order"), alone = at("alone");
        mustRun({"export", of, "--out", of + "-scripts", "--format", "script"});
        for (const QString& folder : {other, alone}) buildStudy(folder.toStdString(), {.protocol = protocolOf(rated)});
        QStringList call{"replay", other};
        for (const char* person : {"P03", "P05", "P01", "P04", "P02"}) call << of + "-scripts/" + person + ".json";
        mustRun(call);
        for (const QString& folder : {of, other}) {
            mustRun({"unblind", folder, "--who", "M", "--why", "done"});
            mustRun({"export", folder, "--out", folder + "-open"});
        }
        const Rows first = *csvRows(bytesOf(of + "-open/answers.csv")), again = *csvRows(bytesOf(other + "-open/answers.csv"));
        QCOMPARE(again.size(), first.size());
        for (std::size_t row = 1; row < first.size(); ++row)
            for (const char* column : {"participant", "trial", "fabric", "condition", "rating"})
                QCOMPARE(cellAt(again, row, column), cellAt(first, row, column));
        // Nobody else's script is needed: that of an erased person is missing.
        mustRun({"replay", alone, of + "-scripts/P03.json"});
        mustRun({"verify", alone});
        const auto place = mustRun({"study", "status", alone, "--json"}).out;
        QCOMPARE(json::parse(place.toStdString())["slots"][1]["participant"], "P03");
        const auto refused = runProgram({"replay", alone, of + "-scripts/P02.json", of + "-scripts/P01.json"});
        QCOMPARE(refused.exitCode, 2);
        QVERIFY2(refused.err.contains("running order 2 is taken"), qPrintable(refused.err));
    }

    void theCodebookHasTheWordsOfALikertScale()
    {
        json likert = rating({"Q2"});
        likert["scale"] = {{"min", 1}, {"max", 3}, {"step", 1}, {"labels", {"not at all", "a little", "very"}}};
        const QString of = study(json::array({likert}));
        mustRun({"export", of, "--out", of + "-exported"});
        QVERIFY(QString::fromStdString(bytesOf(of + "-exported/codebook.csv"))
                    .contains("Q2: 1 to 3 (1 = not at all, 2 = a little, 3 = very)"));
    }
};

QTEST_MAIN(ExportedAnswersTest)
#include "exported_answers_test.moc"
