// Answers collected elsewhere: the values that are read, and the message of each fault.
#include "reports/data/answers_csv.h"

#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>

#include "protocols/files/errors.h"
#include "tests/support/error_text.h"

using tests::support::errorOf;

namespace {

std::filesystem::path written(const QTemporaryDir& folder, const std::string& text)
{
    const std::filesystem::path file = std::filesystem::path(folder.path().toStdString()) / "answers.csv";
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

const std::string header = "participant,fabric,condition,Q1_correct,Q2\n";

/// The columns of answers.csv that the reader uses, and those that only an export has together.
const std::string exported =
    "participant,trial,question,fabric,condition,alternatives,answer,correct,rating,seconds,response_seconds,touched_by,"
    "answer_begun_at,stored_at,corrections,voided,sitting,state,kind,late\n";

/// A row of it; an empty `response` has no stamp of the beginning of the answer.
std::string exportedRow(int trial, const std::string& question, const std::string& answer, const std::string& response = "2",
                        const std::string& sitting = "1")
{
    const bool isChoice = question == "Q1", isRating = question == "Q2";
    return "P1," + std::to_string(trial) + "," + question + ",F01,c" + std::to_string(trial) +
           R"(,"[""F02"",""F01"",""F03""]",)" +
           (isRating ? ",," + answer : answer + "," + (isChoice ? (answer == "F01" ? "1," : "0,") : ",")) + ",3," + response +
           ",display," + (response.empty() ? "" : "5") + ",9,0,0," + sitting + ",finished,human,\n";
}

/// A protocol of one question.
protocols::Protocol protocolAsking(const std::string& question, const protocols::AnswerKind& kind)
{
    protocols::Protocol protocol;
    protocol.phases = {{{{protocols::QuestionId(question), "Which?", kind}}, kind}};
    return protocol;
}

/// The notes on this table, one a line.
QString notesOn(const std::filesystem::path& file)
{
    QString notes;
    reports::AnswersCsvOptions options;
    options.alternatives = 3;
    options.note = [&](const std::string& sentence) { notes += QString::fromStdString(sentence) + "\n"; };
    reports::readAnswersCsv(file, options);
    return notes;
}

}  // namespace

class AnswersCsvTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void rowsBecomeResponsesInTheOrderOfTheirAppearance()
    {
        QTemporaryDir folder;
        const auto file = written(folder,
                                  "\xEF\xBB\xBFparticipant,fabric,condition,Q1_correct,Q2,Q1_seconds,Q1_answer\r\n"
                                  "P2,F9,h_g+f_g,1,5.4,3.25,F9\r\n"
                                  "\"P1, the first\",F1,zeta,0,NA,,\r\n"
                                  "P2,F1,zeta,,NaN,,\r\n");
        const auto data = reports::readAnswersCsv(file);
        QCOMPARE(data.conditions, (std::vector<std::string>{"h_g&f_g", "zeta"}));
        QCOMPARE(data.participants, (std::vector<std::string>{"P2", "P1, the first"}));
        QCOMPARE(data.responses.size(), std::size_t{3});
        const auto first = std::get<reports::ChosenAnswer>(data.responses[0].content);
        QCOMPARE(first.correct, true);
        QCOMPARE(*first.answer, std::string("F9"));
        QCOMPARE(*data.responses[0].seconds, 3.25);
        QCOMPARE(std::get<reports::RatedAnswer>(data.responses[1].content).rating, 5.4);
        QCOMPARE(std::get<reports::ChosenAnswer>(data.responses[2].content).correct, false);
        QCOMPARE(data.expectedResponses, std::size_t{16});
        QVERIFY(!data.blinded);
        QCOMPARE(data.questions[0].id, std::string("Q1"));
        QVERIFY(data.questions[0].kind == protocols::AnswerKind(protocols::ForcedChoice{3}));
        QVERIFY(data.questions[1].kind == protocols::AnswerKind(protocols::Rating{}));
    }

    /// Of a table of one question such a column is the question; beside others it is something else, such as a mood.
    void aColumnCalledRatingTakesNoPlaceOfQuestions()
    {
        QTemporaryDir folder;
        const auto file = written(folder,
                                  "participant,fabric,condition,Q1_correct,Q2,rating\nP1,F1,a,1,5,70\nP1,F2,b,0,4,80\n"
                                  "P2,F1,a,1,6,60\nP2,F2,b,1,3,90\n");
        const auto data = reports::readAnswersCsv(file);
        QCOMPARE(data.questions.size(), std::size_t{2});
        QVERIFY(data.questions[0].id == "Q1" && data.questions[1].id == "Q2");
        QCOMPARE(data.responses.size(), std::size_t{8});
        QVERIFY2(notesOn(file).contains("not analysed: rating"), qPrintable(notesOn(file)));
        const auto one = written(folder, "participant,fabric,condition,rating\nP1,F1,a,7\nP2,F1,a,8\n");
        QCOMPARE(reports::readAnswersCsv(one).questions.size(), std::size_t{1});
    }

    /// Of a question its own column counts, then that of the row, then the order of the sessions.
    void trialsAndSittingsAreRead()
    {
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(written(folder,
                                                          "participant,fabric,condition,trial,sitting,Q1_correct,Q2,Q2_trial\n"
                                                          "P1,F1,a,7,1,1,5,64\nP1,F2,a,,2,1,5,NA\n"));
        QVERIFY(data.responses[0].trial == 7 && data.responses[1].trial == 64);
        QVERIFY(!data.responses[2].trial && !data.responses[3].trial);
        QVERIFY(data.responses[0].sitting == 1 && data.responses[3].sitting == 2);
        const auto sessions = reports::readAnswersCsv(written(folder,
                                                              "participant,fabric,condition,session,Q2\n"
                                                              "P1,F1,a,b,5\nP1,F1,a,a,6\nP2,F1,a,a,5\nP2,F1,a,b,5\n"));
        std::vector<int> sittings;
        for (const auto& response : sessions.responses) sittings.push_back(response.sitting.value_or(0));
        QCOMPARE(sittings, (std::vector<int>{1, 2, 1, 2}));
    }

    void faultsNameTheirRow_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QStringList>("parts");
        const QString head = QString::fromStdString(header);
        QTest::newRow("no number") << head + "P1,F1,a,1,5\nP2,F1,a,1,five\n" << QStringList{"line 3", "Q2", "five"};
        QTest::newRow("comma as decimal point") << head + "P1,F1,a,1,\"5,4\"\n" << QStringList{"line 2", "5,4"};
        QTest::newRow("number with a tail") << head + "P1,F1,a,1,5.4x\n" << QStringList{"line 2", "5.4x"};
        const QString german = "participant;fabric;condition;Q2;Q2_seconds\nP1;F1;a;5,5;3,2\nP2;F1;a;6,5;4,1\n";
        QTest::newRow("a word among decimal commas") << german + "P3;F1;a;6,2;k.A.\n"
                                                     << QStringList{"line 4", "Q2_seconds: \"k.A.\" is not", "3,2", "NA"};
        QTest::newRow("a point among decimal commas")
            << german + "P3;F1;a;6.2;4,0\n"
            << QStringList{"line 4", "column Q2:", "\"6.2\" is not a number with a decimal comma"};
        QTest::newRow("a comma among points") << QString(german).replace(',', '.') + "P3;F1;a;6,2;4.0\n"
                                              << QStringList{"line 4", "column Q2:", "\"6,2\" is not a number"};
        QTest::newRow("a word among decimal commas of a long table")
            << "participant;fabric;condition;question;rating\nP1;F1;a;Q2;5,5\nP1;F1;a;Q3;6,5\nP2;F1;a;Q3;k.A.\n"
            << QStringList{"line 4", "rating: \"k.A.\" is not"};
        QTest::newRow("a lost comma") << head + "P1,F1,a,1,6.2\nP2,F1,a,1,62\n"
                                      << QStringList{"line 3", "column Q2", "62", "0 to 10", "--scale LOW,HIGH"};
        QTest::newRow("below the scale") << head + "P1,F1,a,1,-1\n" << QStringList{"line 2", "-1", "--scale LOW,HIGH"};
        QTest::newRow("yes in German") << head + "P1,F1,a,ja,5\n" << QStringList{"line 2", "\"ja\"", "wahr/falsch", "yes/no"};
        QTest::newRow("German headers") << "Teilnehmer;Stoff;Bedingung;Q2\nP1;F1;a;5\n"
                                        << QStringList{"participant", "--map participant=COLUMN"};
        QTest::newRow("infinite") << head + "P1,F1,a,1,inf\n" << QStringList{"line 2", "inf"};
        QTest::newRow("trial 0") << "participant,fabric,condition,trial,Q2\nP1,F1,a,0,5\n"
                                 << QStringList{"line 2", "column trial", "a whole number from 1"};
        QTest::newRow("half a sitting") << "participant,fabric,condition,Q2_sitting,Q2\nP1,F1,a,1.5,5\n"
                                        << QStringList{"line 2", "Q2_sitting", "1.5"};
        QTest::newRow("neither right nor wrong") << head + "P1,F1,a,2,5\n" << QStringList{"line 2", "Q1_correct", "0 or 1"};
        QTest::newRow("doubled") << head + "P1,F1,a,1,5\nP1,F1,a,0,6\n" << QStringList{"line 3", "twice"};
        QTest::newRow("short row") << head + "P1,F1,a,1\n" << QStringList{"line 2", "4 cells"};
        QTest::newRow("no name") << head + ",F1,a,1,5\n" << QStringList{"line 2", "participant"};
        QTest::newRow("open quote") << head + "\"P1,F1,a,1,5\n" << QStringList{"line 2", "quote"};
        QTest::newRow("misspelt column") << QString("participant,fabric,condition,Q2,Q2_second\nP1,F1,a,5,3\n")
                                         << QStringList{"Q2_second", "_seconds"};
        QTest::newRow("doubled answer of a long table")
            << QString("participant,fabric,condition,question,rating\nP1,F1,a,Q2,5\nP1,F1,a,Q2,6\n")
            << QStringList{"line 3", "twice", "--map repetition=COLUMN"};
        QTest::newRow("a choice and its confidence in one row")
            << QString("participant,fabric,condition,question,correct,rating\nP1,F1,a,Q1,1,7\n")
            << QStringList{"line 2", "the question Q1 has both a choice (correct) and a rating", "another question id"};
        QTest::newRow("a rating among choices")
            << QString("participant,fabric,condition,question,correct,rating\nP1,F1,a,Q1,1,\nP1,F1,b,Q1,,7\n")
            << QStringList{"line 3", "the question Q1 has both"};
        QTest::newRow("a negative time") << QString("participant,fabric,condition,Q2,Q2_seconds\nP1,F1,a,5,3\nP2,F1,a,5,-999\n")
                                         << QStringList{"line 3", "column Q2_seconds", "the time -999 is negative", "empty"};
        QTest::newRow("a negative time of a long table")
            << QString("participant,fabric,condition,question,rating,seconds\nP1,F1,a,Q2,5,-1\n")
            << QStringList{"line 2", "the time -1 is negative"};
        QTest::newRow("a word for void")
            << QString("participant,fabric,condition,question,rating,voided\nP1,F1,a,Q2,5,0\nP1,F1,b,Q2,5,slipped\n")
            << QStringList{"line 3", "column voided", "\"slipped\" is neither voided nor valid", "true/false"};
        QTest::newRow("doubled column") << QString("participant,fabric,condition,Q2,Q2\n") << QStringList{"Q2", "twice"};
        QTest::newRow("missing column") << QString("participant,fabric,Q2\nP1,F1,5\n") << QStringList{"condition"};
        QTest::newRow("no question") << QString("participant,fabric,condition\nP1,F1,a\n") << QStringList{"no question"};
        QTest::newRow("nothing") << QString() << QStringList{"empty"};
        QTest::newRow("no rows") << head << QStringList{"no answers"};
    }

    void faultsNameTheirRow()
    {
        QFETCH(QString, text);
        QFETCH(QStringList, parts);
        QTemporaryDir folder;
        try {
            reports::readAnswersCsv(written(folder, text.toStdString()));
            QFAIL("the faulty table was accepted");
        } catch (const protocols::Error& error) {
            QCOMPARE(error.exitCode(), protocols::ExitCode::BadInput);
            for (const QString& part : parts) QVERIFY2(QString(error.what()).contains(part), error.what());
            QVERIFY2(QString(error.what()).contains("answers.csv"), error.what());
        }
    }

    void protocolBringsBoundsScaleAndContrasts()
    {
        protocols::Protocol protocol;
        protocol.name = "Ours";
        protocol.equivalenceBounds = {-0.3, 0.4};
        protocol.planned = {{protocols::ConditionId("a"), protocols::ConditionId("b")}};
        const protocols::AnswerKind choice = protocols::ForcedChoice{4}, rating = protocols::Rating{};
        protocol.phases = {{{{protocols::QuestionId("Q1"), "Which?", choice}}, choice},
                           {{{protocols::QuestionId("Q2"), "How?", rating}}, rating}};
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(written(folder, header + "P1,F1,a,1,5\nP1,F1,b,0,6\n"), {protocol, "ab", 3});
        QVERIFY(data.questions[0].kind == protocols::AnswerKind(protocols::ForcedChoice{4}));
        QCOMPARE(data.equivalenceBounds.first, -0.3);
        QCOMPARE(data.planned.size(), std::size_t{1});
        QCOMPARE(data.questions[1].text, std::string("How?"));
        QVERIFY_EXCEPTION_THROWN(reports::readAnswersCsv(written(folder, header + "P1,F1,a,1,10.5\n"), {protocol, "", 3}),
                                 protocols::Error);
    }

    /// Answers on another scale need its name. An export was checked against its protocol, so it needs none.
    void otherScalesAreNamed()
    {
        QTemporaryDir folder;
        QStringList notes;
        reports::AnswersCsvOptions options;
        options.note = [&](const std::string& sentence) { notes << QString::fromStdString(sentence); };
        options.scale.emplace().max = protocols::Tenths{1000};
        const auto lost = written(folder, header + "P1,F1,a,1,62\nP1,F1,b,0,6\n");
        QCOMPARE(std::get<reports::RatedAnswer>(reports::readAnswersCsv(lost, options).responses[1].content).rating, 62.0);
        options.scale.reset();
        QVERIFY_EXCEPTION_THROWN(reports::readAnswersCsv(lost, options), protocols::Error);
        for (const std::string times : {"answer_begun_at,wall_time,", ""}) {
            notes.clear();
            const std::string cells = times.empty() ? "" : ",,";
            const auto data = reports::readAnswersCsv(
                written(folder, "participant,fabric,condition,alternatives,touched_by,stored_at,corrections," + times +
                                    "question,rating\nP1,F1,f,[],,1,0," + cells + "Q2,62\nP1,F1,h,[],,1,0," + cells + "Q2,6\n"),
                options);
            QCOMPARE(data.responses.size(), std::size_t{2});
            QVERIFY2(notes.join('\n').contains("outside 0 to 10; name their scale by --scale"), qPrintable(notes.join('\n')));
        }
    }

    /// Blanks, tabs and no-break spaces at the ends of a name make nobody else of it.
    void blanksAroundNamesAreNoPartOfThem()
    {
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(written(
            folder,
            "participant,fabric,condition,instruction,Q1_correct,Q1_answer\n"
            "P01,F1,a,fast,1,F1\nP01 ,F2,a,fast ,0,F1 \n\tP01,\u00A0F1\u00A0,b,fast,1,\u00A0F1\nP0 1,F2, b\t,fast,1,F2\n"));
        QCOMPARE(data.participants, (std::vector<std::string>{"P01", "P0 1"}));
        QCOMPARE(data.fabrics, (std::vector<std::string>{"F1", "F2"}));
        QCOMPARE(data.conditions, (std::vector<std::string>{"a", "b"}));
        QCOMPARE(data.questions[0].instructions.size(), std::size_t{1});
        for (const std::size_t i : {0U, 1U, 2U})
            QCOMPARE(*std::get<reports::ChosenAnswer>(data.responses[i].content).answer, std::string("F1"));
        const auto rows = reports::readAnswersCsv(written(folder,
                                                          "participant,fabric,condition,question,rating\n"
                                                          "P1,F1,a,Q2,5\nP1 ,F1,a,Q3 ,6\nP1,F1,b,Q3,6\n"));
        QCOMPARE(rows.participants.size(), std::size_t{1});
        QCOMPARE(rows.questions.size(), std::size_t{2});
    }

    /// Of a pair only the word and its score are known: another word would make "different" of "SAME".
    void sameAndDifferentAreTheOnlyWords()
    {
        protocols::Protocol protocol;
        const protocols::AnswerKind kind = protocols::SameDifferent{};
        protocol.phases = {{{{protocols::QuestionId("Q1"), "Same?", kind}}, kind}};
        const std::string head = "participant,fabric,condition,Q1_correct,Q1_answer\n";
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(
            written(folder, head + "P1,F1,a,1,Same\nP1,F2,a,0, SAME \nP1,F3,a,1,Different\nP1,F4,a,1,\n"), {protocol, "ab"});
        QStringList words;
        for (const auto& response : data.responses)
            words << QString::fromStdString(std::get<reports::ChosenAnswer>(response.content).answer.value_or("none"));
        QCOMPARE(words, (QStringList{"same", "same", "different", "none"}));
        try {
            reports::readAnswersCsv(written(folder, head + "P1,F1,a,1,same\nP1,F2,a,0,gleich\n"), {protocol, "ab"});
            QFAIL("another word was read");
        } catch (const protocols::Error& error) {
            for (const char* part :
                 {"line 3", "column Q1_answer", "\"gleich\" is neither same nor different", "same or different"})
                QVERIFY2(QString(error.what()).contains(part), error.what());
        }
    }

    void theDefaultNumberOfAlternativesIsNamed()
    {
        QTemporaryDir folder;
        QStringList notes;
        reports::AnswersCsvOptions options;
        options.scale = protocols::RatingScale{};
        options.note = [&](const std::string& sentence) { notes << QString::fromStdString(sentence); };
        const auto wide = written(folder, header + "P1,F1,a,1,5\nP1,F1,b,0,6\n");
        QVERIFY(reports::readAnswersCsv(wide, options).questions[0].alternativesAssumed);
        QCOMPARE(notes.size(), 1);
        QVERIFY2(notes[0].contains("the choices of Q1 are tested against 1/3, the default of this program") &&
                     notes[0].contains("--alternatives"),
                 qPrintable(notes[0]));
        options.alternatives = 4;
        const auto stated = reports::readAnswersCsv(wide, options);
        QVERIFY(!stated.questions[0].alternativesAssumed && notes.size() == 1);
        QVERIFY(stated.questions[0].kind == protocols::AnswerKind(protocols::ForcedChoice{4}));
        options.alternatives.reset();
        const auto rows = written(folder, "participant,fabric,condition,question,correct\nP1,F1,a,match,1\nP1,F1,b,match,0\n");
        QVERIFY(reports::readAnswersCsv(rows, options).questions[0].alternativesAssumed);
        QVERIFY2(notes.size() == 2 && notes[1].contains("the choices of match"), qPrintable(notes.join('\n')));
        protocols::Protocol protocol;
        const protocols::AnswerKind choice = protocols::ForcedChoice{3};
        protocol.phases = {{{{protocols::QuestionId("match"), "Which?", choice}}, choice}};
        options.protocol = protocol;
        QVERIFY(!reports::readAnswersCsv(rows, options).questions[0].alternativesAssumed && notes.size() == 2);
    }

    void extraColumnsAreNamedAndNotAnalysed()
    {
        QTemporaryDir folder;
        QStringList notes;
        reports::AnswersCsvOptions options;
        options.alternatives = 3;
        options.scale = protocols::RatingScale{};
        options.note = [&](const std::string& sentence) { notes << QString::fromStdString(sentence); };
        const auto data = reports::readAnswersCsv(
            written(
                folder,
                "participant;fabric;condition;age;Q1_correct;Q2;weather\nP1;F1;a;24;WAHR;5,5;rain\nP1;F1;b;24;FALSCH;6;sun\n"),
            options);
        QCOMPARE(data.responses.size(), std::size_t{4});
        QVERIFY(std::get<reports::ChosenAnswer>(data.responses[0].content).correct);
        QVERIFY(!std::get<reports::ChosenAnswer>(data.responses[2].content).correct);
        QCOMPARE(std::get<reports::RatedAnswer>(data.responses[1].content).rating, 5.5);
        QCOMPARE(notes.size(), 2);
        QVERIFY2(notes[0].endsWith("read with semicolons, decimal commas, UTF-8"), qPrintable(notes[0]));
        QVERIFY2(notes[1].endsWith("not analysed: age and weather"), qPrintable(notes[1]));
    }

    /// One row an answer, with the names of another lab.
    void longTablesAreRead()
    {
        QTemporaryDir folder;
        reports::AnswersCsvOptions options;
        options.rows.names = {{"participant", "subject"}, {"condition", "render"}, {"correct", "hit"}};
        options.equivalenceBounds = {-1, 1};
        options.planned = {{"a", "b"}};
        const auto data = reports::readAnswersCsv(written(folder,
                                                          "subject,fabric,render,question,hit,rating,answer,seconds,trial\n"
                                                          "S1,F1,a,match,TRUE,,F1,3.5,2\n"
                                                          "S1,F1,a,realism,,7.5,,4,3\n"
                                                          "S1,F1,b,match,false,,F2,2,1\n"
                                                          "S1,F1,b,realism,,6,,5,4\n"),
                                                  options);
        QCOMPARE(data.questions.size(), std::size_t{2});
        QCOMPARE(data.questions[0].id, std::string("match"));
        QVERIFY(std::get<reports::ChosenAnswer>(data.responses[0].content).correct);
        QCOMPARE(*std::get<reports::ChosenAnswer>(data.responses[0].content).answer, std::string("F1"));
        QCOMPARE(std::get<reports::RatedAnswer>(data.responses[1].content).rating, 7.5);
        QVERIFY(data.responses[1].seconds == 4.0 && data.responses[1].trial == 3);
        QCOMPARE(data.planned.size(), std::size_t{1});
        QCOMPARE(data.equivalenceBounds.second, 1.0);
        options.planned = {{"a", "c"}};
        QVERIFY_EXCEPTION_THROWN(
            reports::readAnswersCsv(written(folder, "subject,fabric,render,hit\nS1,F1,a,1\nS1,F1,b,0\n"), options),
            protocols::Error);
    }

    /// Other programs write the column in their own way: R as TRUE and FALSE, pandas as 1.0 and 0.0.
    void voidedIsReadInAnyUsualForm()
    {
        std::string text = "participant,fabric,condition,question,rating,voided\n";
        int row = 0;
        for (const char* voided : {"0", "no", "FALSE", "0.0", "", "NA", "1", "yes", "TRUE", "1.0"})
            text += "P1,F" + std::to_string(++row) + ",a,Q2,5," + voided + "\n";
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(written(folder, text));
        QCOMPARE(data.responses.size(), std::size_t{6});
        QCOMPARE(data.voided, std::size_t{4});
    }

    void theSlotsOfAnExportAreRead()
    {
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(
            written(folder, exported + exportedRow(1, "Q1", "F01") + exportedRow(2, "Q1", "F02") + exportedRow(3, "Q1", "F03")));
        std::vector<int> slots;
        for (const auto& response : data.responses)
            slots.push_back(std::get<reports::ChosenAnswer>(response.content).slot.value_or(-1));
        QCOMPARE(slots, (std::vector<int>{1, 0, 2}));
    }

    /// A column with gaps that pandas saved again holds 1.0 and 0.0.
    void lateAnswersOfAnExportStayLate()
    {
        const std::pair<const char*, std::optional<bool>> forms[] = {{"1", true},    {"0", false}, {"1.0", true}, {"0.0", false},
                                                                     {"True", true}, {"NA", {}},   {"", {}}};
        std::string text = exported;
        int trial = 0;
        for (const auto& [late, meaning] : forms) {
            text += exportedRow(++trial, "Q2", "5");
            text.insert(text.size() - 1, late);
        }
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(written(folder, text));
        QCOMPARE(data.responses.size(), std::size(forms));
        for (std::size_t i = 0; i < std::size(forms); ++i) QVERIFY2(data.responses[i].late == forms[i].second, forms[i].first);
        std::string other = exported + exportedRow(1, "Q2", "5");
        other.insert(other.size() - 1, "2");
        try {
            reports::readAnswersCsv(written(folder, other));
            QFAIL("2 was read as late or in time");
        } catch (const protocols::Error& error) {
            QVERIFY2(QString(error.what()).contains("\"2\" is neither late nor in time"), error.what());
        }
    }

    /// Who said nothing has answered, and "NA" may be a word. In a table of another lab they are missing values.
    void emptyWordsOfAnExportAreAnswers()
    {
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(
            written(folder, exported + exportedRow(1, "Why", "") + exportedRow(2, "Why", "NA") + exportedRow(3, "Why", "soft")));
        QStringList words;
        for (const auto& response : data.responses)
            words << QString::fromStdString(std::get<reports::WordedAnswer>(response.content).words);
        QCOMPARE(words, (QStringList{"", "NA", "soft"}));
        const auto other = reports::readAnswersCsv(written(folder,
                                                           "participant,fabric,condition,question,answer\n"
                                                           "P1,F1,a,Why,\nP1,F2,a,Why,NA\nP1,F3,a,Why,soft\n"));
        QCOMPARE(other.responses.size(), std::size_t{1});
    }

    /// Earlier versions enrolled a participant NA. An export names everything, so only an empty cell names nothing.
    void aNameInAnExportMayMeanMissingElsewhere()
    {
        QTemporaryDir folder;
        const QString rows = QString::fromStdString(exported + exportedRow(1, "Q1", "F01") + exportedRow(2, "Q2", "7"));
        const auto table = [&](const char* participant, const char* fabric) {
            return written(
                folder, QString(rows).replace("\nP1,", QString("\n%1,").arg(participant)).replace("F01", fabric).toStdString());
        };
        const auto data = reports::readAnswersCsv(table("NA", "nan"));
        QCOMPARE(data.participants, std::vector<std::string>{"NA"});
        QCOMPARE(data.fabrics, std::vector<std::string>{"nan"});
        const auto& choice = std::get<reports::ChosenAnswer>(data.responses[0].content);
        QVERIFY(choice.answer == "nan" && choice.slot == 1);
        QVERIFY_THROWS_EXCEPTION(protocols::Error, reports::readAnswersCsv(table("", "nan")));
        QVERIFY_THROWS_EXCEPTION(protocols::Error,
                                 reports::readAnswersCsv(written(folder, "participant,fabric,condition,Q2\nNA,F1,a,5\n")));
    }

    /// The export need not be whole: its column `state` alone tells who withdrew.
    void whoWithdrewIsLeftOutOfEveryTable()
    {
        const std::string rows = "P1,F1,a,Q2,5,finished\nP2,F1,a,Q2,9,withdrawn\nP2,F1,b,Q2,9,withdrawn\nP1,F1,b,Q2,6,finished\n";
        QTemporaryDir folder;
        const auto file = written(folder, "participant,fabric,condition,question,rating,state\n" + rows);
        QCOMPARE(reports::readAnswersCsv(file).participants, std::vector<std::string>{"P1"});
        QVERIFY2(notesOn(file).contains("2 answers of participants who withdrew left out"), qPrintable(notesOn(file)));
        QVERIFY2(!notesOn(file).contains("not analysed"), qPrintable(notesOn(file)));
        const auto wide = written(folder, "participant,fabric,condition,Q2,state\nP1,F1,a,5,started\nP2,F1,a,9,withdrawn\n");
        QCOMPARE(reports::readAnswersCsv(wide).participants, std::vector<std::string>{"P1"});
        QVERIFY2(notesOn(wide).contains("1 row of participants who withdrew left out"), qPrintable(notesOn(wide)));
        // Another lab's column of this name means something else.
        const auto other = written(folder, "participant,fabric,condition,Q2,state\nP1,F1,a,5,withdrawn\nP2,F1,a,9,Ohio\n");
        QCOMPARE(reports::readAnswersCsv(other).participants.size(), std::size_t{2});
        QVERIFY2(notesOn(other).contains("not analysed: state"), qPrintable(notesOn(other)));
    }

    /// Without some of its technical columns, too: blank glass is no condition, and the trays tell the alternatives.
    void anExportMayLackTechnicalColumns()
    {
        const std::string tray = R"("[""F1"",""F2""]")";
        QTemporaryDir folder;
        const auto file = written(folder,
                                  "participant,trial,question,fabric,condition,alternatives,answer,correct,state\n"
                                  "P1,1,Q1,F1,f," +
                                      tray + ",F1,1,finished\nP1,2,Q1,F2,catch," + tray + ",F1,0,finished\nP1,3,Q1,F2,h," + tray +
                                      ",F1,0,finished\nP2,1,Q1,F2,h," + tray + ",F1,0,withdrawn\n");
        const auto data = reports::readAnswersCsv(file);
        QCOMPARE(data.conditions, (std::vector<std::string>{"f", "h"}));
        QCOMPARE(data.catchResponses.size(), std::size_t{1});
        QVERIFY(data.questions[0].kind == protocols::AnswerKind(protocols::ForcedChoice{2}));
        QCOMPARE(data.participants, std::vector<std::string>{"P1"});
    }

    void theColumnKindTellsWhoAnswered()
    {
        QTemporaryDir folder;
        const auto tableOf = [&](const char* first, const char* second) {
            return written(
                folder, std::string("participant,fabric,condition,Q2,kind\nP1,F1,a,5,") + first + "\nP2,F1,a,6," + second + "\n");
        };
        const auto simulated = reports::readAnswersCsv(tableOf("human", "simulated"));
        QVERIFY(simulated.knowsKinds && simulated.simulated && !simulated.scripted);
        const auto people = reports::readAnswersCsv(tableOf("human", "human"));
        QVERIFY(people.knowsKinds && !people.simulated);
        QVERIFY(!notesOn(tableOf("human", "scripted")).contains("not analysed"));
        const auto other = tableOf("human", "robot");
        QVERIFY(!reports::readAnswersCsv(other).knowsKinds);
        QVERIFY2(notesOn(other).contains("not analysed: kind"), qPrintable(notesOn(other)));
        const auto unknown = reports::readAnswersCsv(written(folder, header + "P1,F1,a,1,5\n"));
        QVERIFY(!unknown.knowsKinds && !unknown.simulated);
    }

    /// An answer without the stamp of its beginning has no time; it decides nothing about the others.
    void oneMissingStampLosesOneTime()
    {
        QTemporaryDir folder;
        const std::string whole = exportedRow(1, "Q1", "F01") + exportedRow(2, "Q2", "5") + exportedRow(3, "Why", "", "");
        const auto data = reports::readAnswersCsv(written(folder, exported + whole + exportedRow(4, "Q2", "6", "")));
        QVERIFY(data.times == reports::TimesTaken::ToBeginning);
        QCOMPARE(data.responses.size(), std::size_t{4});
        QVERIFY(data.responses[0].seconds == 2.0 && data.responses[1].seconds == 2.0);
        QVERIFY(!data.responses[2].seconds && !data.responses[3].seconds);
        // A sitting without any stamp is that of an earlier version: two definitions must not meet.
        const auto old = reports::readAnswersCsv(
            written(folder, exported + whole + exportedRow(4, "Q2", "6", "", "2") + exportedRow(5, "Q2", "6", "", "2")));
        QVERIFY(old.times == reports::TimesTaken::ToEntry);
        for (const auto& response : old.responses) QVERIFY(response.seconds == 3.0);
    }

    /// Words beside the ratings of a question are no ratings.
    void answersWithoutTheirNumberAreCounted()
    {
        QTemporaryDir folder;
        const auto file =
            written(folder, "participant,fabric,condition,question,rating,answer\nP1,F1,a,Q2,5,\nP1,F1,b,Q2,,no idea\n");
        QVERIFY2(notesOn(file).contains("1 answer without correct or rating left out"), qPrintable(notesOn(file)));
    }

    /// Bounds of half a point would cover the whole of a scale from 0 to 1.
    void usualBoundsAreATwentiethOfTheScale()
    {
        QTemporaryDir folder;
        const auto file = written(folder, "participant,fabric,condition,rating\nS1,F1,a,1\nS1,F1,b,0\n");
        reports::AnswersCsvOptions options;
        QCOMPARE(reports::readAnswersCsv(file, options).equivalenceBounds, std::pair(-0.5, 0.5));
        options.scale.emplace().max = protocols::Tenths{10};
        QCOMPARE(reports::readAnswersCsv(file, options).equivalenceBounds, std::pair(-0.05, 0.05));
        options.equivalenceBounds = {-0.1, 0.2};
        QCOMPARE(reports::readAnswersCsv(file, options).equivalenceBounds, std::pair(-0.1, 0.2));
    }

    /// The page names what states the bounds, so the origin comes with them.
    void boundsAndContrastsSayWhoStatesThem()
    {
        using reports::PlanOrigin;
        QTemporaryDir folder;
        const auto file = written(folder, "participant,fabric,condition,rating\nS1,F1,a,1\nS1,F1,b,0\n");
        reports::AnswersCsvOptions options;
        QCOMPARE(reports::readAnswersCsv(file, options).boundsFrom, PlanOrigin::Program);
        protocols::RatingScale scale;
        scale.max = protocols::Tenths{10};
        const protocols::AnswerKind unit = protocols::Rating{scale};
        protocols::Protocol protocol;
        protocol.phases = {{{{protocols::QuestionId("rating"), "How?", unit}}, unit}};
        protocol.equivalenceBounds = usualBoundsOf(protocol.phases);
        protocol.hasUsualBounds = true;
        options.protocol = protocol;
        const auto usual = reports::readAnswersCsv(file, options);
        QVERIFY(usual.boundsFrom == PlanOrigin::Program && usual.equivalenceBounds == std::pair(-0.05, 0.05));
        QVERIFY(usual.plannedDesign->hasUsualBounds && usual.plannedDesign->equivalenceBounds == std::pair(-0.05, 0.05));
        options.protocol->hasUsualBounds = false;
        const auto stated = reports::readAnswersCsv(file, options);
        QVERIFY(stated.boundsFrom == PlanOrigin::Protocol && stated.plannedFrom == PlanOrigin::Protocol);
        options.equivalenceBounds = {-0.2, 0.2};
        options.planned = {{"a", "b"}};
        const auto called = reports::readAnswersCsv(file, options);
        QVERIFY(called.boundsFrom == PlanOrigin::Option && called.plannedFrom == PlanOrigin::Option);
        QCOMPARE(called.equivalenceBounds, std::pair(-0.2, 0.2));
        QCOMPARE(called.plannedDesign->equivalenceBounds, std::pair(-0.05, 0.05));
    }

    /// Chance is that of the trays. A protocol of other answers would make guessers better than chance.
    void aProtocolThatContradictsTheFileIsRefused_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("question");
        QTest::addColumn<int>("kind");  // above 0: alternatives; 0: rating; -1: same or different; -2: words
        QTest::addColumn<QStringList>("parts");
        const QString trays = QString::fromStdString(exported + exportedRow(1, "Q1", "F01") + exportedRow(2, "Q1", "F02"));
        const QString word = QString::fromStdString(exported + exportedRow(1, "Why", "soft"));
        const QString start = "participant,fabric,condition,", row = "P1,F1,a,";
        QTest::newRow("fewer alternatives") << trays << "Q1" << 2
                                            << QStringList{"line 2", "column alternatives: the tray of Q1 has 3 pieces",
                                                           "by the protocol Q1 is a choice among 2", "a tray of 2 pieces"};
        QTest::newRow("more alternatives") << trays << "Q1" << 5 << QStringList{"3 pieces", "a choice among 5"};
        QTest::newRow("a pair") << trays << "Q1" << -1 << QStringList{"3 pieces", "Q1 is same or different", "1 piece"};
        QTest::newRow("a choice that is rated")
            << trays << "Q1" << 0
            << QStringList{"\"correct of Q1\" holds answers that are right or wrong", "Q1 is a rating from 0 to 10"};
        QTest::newRow("0 and 1 under the plain name")
            << start + "Q1\n" + row + "1\nP1,F1,b,0\n"
            << "Q1" << 3
            << QStringList{"the column \"Q1\" holds ratings or words", "Q1 is a choice among 3", "--map Q1_correct=COLUMN"};
        QTest::newRow("scores of a rating") << start + "Q2_correct\n" + row + "1\n"
                                            << "Q2" << 0
                                            << QStringList{"\"Q2_correct\" holds answers that are right or wrong", "--map Q2="};
        QTest::newRow("words of a choice") << start + "question,answer\n" + row + "Q1,F1\n"
                                           << "Q1" << 3 << QStringList{"\"answer of Q1\" holds words", "--map correct=COLUMN"};
        QTest::newRow("ratings of a question in words")
            << start + "question,rating\n" + row + "Why,3\n"
            << "Why" << -2 << QStringList{"\"rating of Why\" holds ratings", "Why is answered in words"};
        QTest::newRow("words of an export that are rated")
            << word << "Why" << 0 << QStringList{"\"answer of Why\" holds words", "a rating from 0 to 10"};
    }
    void aProtocolThatContradictsTheFileIsRefused()
    {
        QFETCH(QString, text);
        QFETCH(QString, question);
        QFETCH(int, kind);
        QFETCH(QStringList, parts);
        const protocols::AnswerKind asked = kind > 0     ? protocols::AnswerKind(protocols::ForcedChoice{kind})
                                            : kind == 0  ? protocols::AnswerKind(protocols::Rating{})
                                            : kind == -1 ? protocols::AnswerKind(protocols::SameDifferent{})
                                                         : protocols::AnswerKind(protocols::FreeText{});
        QTemporaryDir folder;
        const QString fault = errorOf([&] {
            reports::readAnswersCsv(written(folder, text.toStdString()), {protocolAsking(question.toStdString(), asked), "ab"});
        });
        QVERIFY2(fault.startsWith("2: "), qPrintable(fault));
        for (const QString& part : parts) QVERIFY2(fault.contains(part), qPrintable(fault));
    }

    /// Numbers in `answer` are ratings where the protocol says so, and a column without answers says nothing.
    void aProtocolTellsWhatTheFileLeavesOpen()
    {
        QTemporaryDir folder;
        const auto rated =
            reports::readAnswersCsv(written(folder, "participant,fabric,condition,question,answer\nP1,F1,a,Q2,5\n"),
                                    {protocolAsking("Q2", protocols::Rating{}), "ab"});
        QCOMPARE(std::get<reports::RatedAnswer>(rated.responses[0].content).rating, 5.0);
        const auto empty = reports::readAnswersCsv(written(folder, "participant,fabric,condition,Q1,Q2\nP1,F1,a,,5\n"),
                                                   {protocolAsking("Q1", protocols::ForcedChoice{3}), "ab"});
        QCOMPARE(empty.responses.size(), std::size_t{1});
    }

    void traysOfCatchTrialsAndAnchorsMayDiffer()
    {
        const auto row = [](const char* fabric, const char* condition, const char* tray, const char* answer) {
            return std::string("P1,Q1,") + fabric + "," + condition + ",\"" + tray + "\"," + answer + ",finished\n";
        };
        QTemporaryDir folder;
        const auto file = written(folder, "participant,question,fabric,condition,alternatives,answer,correct,anchor,state\n" +
                                              row("F1", "f", R"([""F1"",""F2"",""F3""])", "F1,1,") +
                                              row("F2", "catch", R"([""F1"",""F2""])", "F1,0,") +
                                              row("F1", "f", R"([""F1"",""F2"",""F3"",""F4""])", "F2,0,repeated"));
        const protocols::AnswerKind choice = protocols::ForcedChoice{3};
        QVERIFY(reports::readAnswersCsv(file).questions[0].kind == choice);
        const auto data = reports::readAnswersCsv(file, {protocolAsking("Q1", choice), "ab"});
        QVERIFY(data.questions[0].kind == choice && !data.questions[0].alternativesAssumed);
        QCOMPARE(data.responses.size() + data.catchResponses.size() + data.repeatedResponses.size(), std::size_t{3});
    }

    /// The protocol gives each of its questions a scale, and the caller names that of the others. Each refuses what lies outside.
    void aNamedScaleIsThatOfRatingsBesideTheProtocol()
    {
        QTemporaryDir folder;
        const std::string head = "participant,fabric,condition,Q2,Q3\n";
        const auto file = written(folder, head + "P1,F1,a,5,62\nP1,F1,b,6,100\n");
        reports::AnswersCsvOptions options;
        options.protocol = protocolAsking("Q2", protocols::Rating{});
        options.scale.emplace().max = protocols::Tenths{1000};
        const auto data = reports::readAnswersCsv(file, options);
        QVERIFY(data.questions[0].kind == protocols::AnswerKind(protocols::Rating{}));
        QVERIFY(data.questions[1].kind == protocols::AnswerKind(protocols::Rating{*options.scale}));
        QCOMPARE(data.equivalenceBounds, options.protocol->equivalenceBounds);
        const auto faultOf = [&](const std::string& row) {
            return errorOf([&] { reports::readAnswersCsv(written(folder, head + row), options); });
        };
        QVERIFY2(faultOf("P1,F1,a,50,62\n").contains("column Q2: the rating 50 is outside the scale; expected 0 to 10"),
                 qPrintable(faultOf("P1,F1,a,50,62\n")));
        QVERIFY2(faultOf("P1,F1,a,5,620\n").contains("column Q3: the rating 620 is outside the scale; expected 0 to 100"),
                 qPrintable(faultOf("P1,F1,a,5,620\n")));
    }

    /// Where the protocol describes all ratings, it would decide in silence.
    void aProtocolWithAnotherScaleIsRefused()
    {
        QTemporaryDir folder;
        const auto file = written(folder, "participant,fabric,condition,Q2\nP1,F1,a,5\nP1,F1,b,6\n");
        reports::AnswersCsvOptions options;
        options.protocol = protocolAsking("Q2", protocols::Rating{});
        options.scale.emplace();
        QCOMPARE(reports::readAnswersCsv(file, options).equivalenceBounds, std::pair(-0.5, 0.5));
        options.scale->max = protocols::Tenths{1000};
        const QString fault = errorOf([&] { reports::readAnswersCsv(file, options); });
        QVERIFY2(fault.contains("--scale names 0 to 100, but by the protocol Q2 is rated from 0 to 10") &&
                     fault.contains("leave --scale out"),
                 qPrintable(fault));
        // A protocol that does not describe the ratings of the file leaves their scale, and its bounds, to the caller.
        options.protocol = protocolAsking("Q3", protocols::Rating{});
        options.protocol->hasUsualBounds = true;
        const auto other = reports::readAnswersCsv(file, options);
        QCOMPARE(other.equivalenceBounds, std::pair(-5.0, 5.0));
        QVERIFY(other.questions[0].kind == protocols::AnswerKind(protocols::Rating{*options.scale}));
    }

    /// A shell splits at &, so both spellings name one condition, in the file and in the call.
    void plannedContrastsHaveEitherSpelling()
    {
        QTemporaryDir folder;
        const auto file =
            written(folder, "participant,fabric,condition,Q2\nP1,F1,h_g+f_g,5\nP1,F1,h_g&f_g@fast,6\nP1,F1,x+y,4\n");
        reports::AnswersCsvOptions options;
        options.planned = {{"h_g+f_g", "h_g+f_g@fast"}, {"x+y", "h_g&f_g"}};
        const auto data = reports::readAnswersCsv(file, options);
        QVERIFY(data.planned[0] == std::pair(std::string("h_g&f_g"), std::string("h_g&f_g@fast")));
        QVERIFY(data.planned[1] == std::pair(std::string("x+y"), std::string("h_g&f_g")));
        options.planned = {{"h_g+f_g", "x+y"}, {"x+y", "h_g&f_g"}};
        QVERIFY(errorOf([&] { reports::readAnswersCsv(file, options); }).contains("repeats an earlier one"));
    }

    /// The counts would follow the score, and the table of the fabrics chosen the answer. The lists of pieces in an export make
    /// it certain that the answers are fabrics; elsewhere, that every score contradicts.
    void aScoreThatTheAnswerContradictsIsRefused_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("fault");
        const QString own = "participant,question,fabric,condition,alternatives,answer,correct,anchor,state\n";
        const auto ownRow = [](const std::string& fabric, const std::string& condition, const std::string& answer,
                               const std::string& scoreAndAnchor) {
            return QString::fromStdString("P1,Q1," + fabric + "," + condition + R"(,"[""F1"",""F2""]",)" + answer + "," +
                                          scoreAndAnchor + ",finished\n");
        };
        const QString right = ownRow("F1", "f", "F1", "1,");
        QTest::newRow("right, but wrong in an export")
            << own + right + ownRow("F2", "f", "F2", "0,")
            << "line 3), column correct of Q1: the answer F2 is the fabric of the row, but it counts as wrong";
        QTest::newRow("wrong, but right in an export")
            << own + right + ownRow("F2", "f", "F1", "1,")
            << "line 3), column correct of Q1: the answer F1 is not the fabric of the row, F2, but it counts as right";
        QTest::newRow("blank glass") << own + right + ownRow("F2", "catch", "F1", "1,") << "";
        QTest::newRow("a mismatch") << own + right + ownRow("F2", "f", "F1", "1,mismatched") << "";

        const QString wide = "participant,fabric,condition,Q1_answer,Q1_correct\n",
                      rows = "participant,fabric,condition,answer,correct\n",
                      four = "P1,F1,a,F1,0\nP1,F2,a,F2,0\nP1,F1,b,F2,1\nP1,F2,b,F1,1\n", five = four + "P2,F1,a,F1,0\n";
        QTest::newRow("1 for wrong")
            << wide + five
            << "line 2), column Q1_correct: all 5 scores of Q1 contradict their answers: the answer F1 is "
               "the fabric of the row, but it counts as wrong; expected 1 where the answer is the fabric "
               "of the row, else 0; exchange 0 and 1; or, where the answers name no fabrics, call their "
               "column otherwise, such as slot";
        QTest::newRow("1 for wrong in one row an answer")
            << rows + five << "line 2), column correct of Q1: all 5 scores of Q1 contradict";
        QTest::newRow("few rows") << wide + four << "";
        QTest::newRow("one row agrees") << wide + five + "P2,F2,a,F2,1\n"
                                        << "";
        QTest::newRow("the column slot") << QString(wide).replace("Q1_answer", "slot") + five << "";
        QTest::newRow("the column slot in one row an answer") << QString(rows).replace("answer", "slot") + five << "";
        QTest::newRow("other names") << wide + "P1,F1,a,F1,1\nP1,F2,a,A,0\nP1,F2,b,B,1\nP1,F2,c,,1\n"
                                     << "";
    }
    void aScoreThatTheAnswerContradictsIsRefused()
    {
        QFETCH(QString, text);
        QFETCH(QString, fault);
        QTemporaryDir folder;
        const QString found = errorOf([&] { reports::readAnswersCsv(written(folder, text.toStdString())); });
        QVERIFY2(fault.isEmpty() ? found.isEmpty() : found.contains(fault), qPrintable(found));
    }

    /// Fabrics A to D, and answers that are the places A to C on the tray: some agree with the score by chance, others do not.
    void placesCalledLikeFabricsAreRead()
    {
        QTemporaryDir folder;
        const std::string places =
            "P1,A,a,1,A\nP1,B,a,0,B\nP1,C,a,1,A\nP1,D,a,1,C\nP1,A,b,0,B\nP1,B,b,1,C\nP1,C,b,1,B\nP1,D,b,0,A\n";
        const auto file = written(folder, "participant,fabric,condition,Q1_correct,Q1_answer\n" + places);
        QCOMPARE(reports::readAnswersCsv(file).responses.size(), std::size_t{8});
        QVERIFY2(notesOn(file).endsWith("answers.csv: in 1 of 8 rows the answer to Q1 names the fabric of the row, but the score "
                                        "says wrong; in 4 of 8 rows the answer to Q1 names another fabric, but the score says "
                                        "right; correct these rows, or, where the answers name no fabrics, call their column "
                                        "otherwise, such as slot\n"),
                 qPrintable(notesOn(file)));
        const auto named = written(folder, "participant,fabric,condition,Q1_correct,slot\n" + places);
        QVERIFY2(!notesOn(named).contains("the score says") && notesOn(named).contains("not analysed: slot"),
                 qPrintable(notesOn(named)));
    }

    /// A fabric may be called as the answer to a pair.
    void wordsOfPairsAreNoFabrics()
    {
        QTemporaryDir folder;
        const auto data = reports::readAnswersCsv(
            written(folder, "participant,fabric,condition,Q1_correct,Q1_answer\nP1,same,a,1,different\nP1,different,a,1,same\n"),
            {protocolAsking("Q1", protocols::SameDifferent{}), "ab"});
        QCOMPARE(data.responses.size(), std::size_t{2});
    }

    /// As in a protocol, each pair of conditions comes once. Twice it would count twice in Holm's correction.
    void plannedContrastsAreDifferentPairs_data()
    {
        QTest::addColumn<QString>("first");
        QTest::addColumn<QString>("second");
        QTest::addColumn<QString>("fault");
        QTest::newRow("two pairs") << "a,b"
                                   << "a,c"
                                   << "";
        QTest::newRow("twice") << "a,b"
                               << "a,b"
                               << "the planned contrast \"a,b\" repeats an earlier one";
        QTest::newRow("turned") << "a,b"
                                << "b,a"
                                << "the planned contrast \"b,a\" repeats an earlier one";
        QTest::newRow("with itself") << "a,b"
                                     << "c,c"
                                     << "the planned contrast \"c,c\" compares a condition with itself";
    }
    void plannedContrastsAreDifferentPairs()
    {
        QFETCH(QString, first);
        QFETCH(QString, second);
        QFETCH(QString, fault);
        QTemporaryDir folder;
        reports::AnswersCsvOptions options;
        for (const QString& pair : {first, second})
            options.planned.emplace_back(pair.section(',', 0, 0).toStdString(), pair.section(',', 1, 1).toStdString());
        const auto file = written(folder, "participant,fabric,condition,Q2\nP1,F1,a,5\nP1,F1,b,6\nP1,F1,c,4\n");
        try {
            QCOMPARE(reports::readAnswersCsv(file, options).planned.size(), std::size_t(2));
            QVERIFY2(fault.isEmpty(), "the contrasts were accepted");
        } catch (const protocols::Error& error) {
            QVERIFY2(!fault.isEmpty() && QString(error.what()).contains(fault), error.what());
            QVERIFY(error.exitCode() == protocols::ExitCode::BadInput);
        }
    }

    /// A wrong --map makes a question of every row. The wide table would then have the square of the rows as cells.
    /// Its wide table would have no column at all.
    void aHeaderOfQuestionsAloneIsNoTableOfAnswers()
    {
        QTemporaryDir folder;
        for (const char* header : {"question,rating\n", "question\n", "question,answer,seconds\n"})
            QVERIFY_THROWS_EXCEPTION(protocols::Error, reports::readAnswersCsv(written(folder, header)));
    }

    void aColumnOfOtherValuesIsNoQuestion()
    {
        const auto rowsOf = [](int questions) {
            std::string text = "participant,fabric,condition,question,rating\n";
            for (int i = 0; i < questions; ++i) text += "P" + std::to_string(i) + ",F1,a,R" + std::to_string(i) + ",3\n";
            return text;
        };
        QTemporaryDir folder;
        QCOMPARE(reports::readAnswersCsv(written(folder, rowsOf(200))).questions.size(), std::size_t{200});
        try {
            reports::readAnswersCsv(written(folder, rowsOf(201)));
            QFAIL("201 questions were read");
        } catch (const protocols::Error& error) {
            for (const char* part : {"more than 200 different values", "line 202", "--map question=COLUMN"})
                QVERIFY2(QString(error.what()).contains(part), error.what());
        }
    }

    void theWideTableHasALimit()
    {
        std::string text = "participant,fabric,condition,question,rating\n";
        for (int i = 0; i < 20'000; ++i) text += "P" + std::to_string(i) + ",F1,a,R" + std::to_string(i % 200) + ",3\n";
        QTemporaryDir folder;
        try {
            reports::readAnswersCsv(written(folder, text));
            QFAIL("a table of 20 million cells was made");
        } catch (const protocols::Error& error) {
            for (const char* part : {"20000 rows and 1003 columns", "questions: 200", "at most 20000000 cells"})
                QVERIFY2(QString(error.what()).contains(part), error.what());
        }
    }

    /// Names are looked up, not searched: the time grows with the rows, not with their square.
    void manyNamesAreReadQuickly()
    {
        std::string text = "participant,fabric,condition,session,instruction,Q2\n", other = text;
        for (int i = 0; i < 40'000; ++i) {
            const std::string number = std::to_string(i);
            text += "participant " + number + ",fabric " + number + ",condition " + number + ",1,one,5\n";
            other += "P1,F1,a," + number + ",instruction " + number + ",5\n";
        }
        QTemporaryDir folder;
        QElapsedTimer timer;
        timer.start();
        const auto data = reports::readAnswersCsv(written(folder, text));
        QCOMPARE(data.participants.size(), std::size_t{40'000});
        QCOMPARE(data.participants.back(), std::string("participant 39999"));
        const auto sessions = reports::readAnswersCsv(written(folder, other));
        QVERIFY(sessions.responses.back().sitting == 40'000);
        QCOMPARE(sessions.questions[0].instructions.size(), std::size_t{40'000});
        QVERIFY2(timer.elapsed() < 8000, qPrintable(QString::number(timer.elapsed())));
    }

    void missingFileIsBadInput() { QVERIFY_EXCEPTION_THROWN(reports::readAnswersCsv("/nowhere/answers.csv"), protocols::Error); }
};

QTEST_GUILESS_MAIN(AnswersCsvTest)
#include "answers_csv_test.moc"
