// Other programs compute the main tables again: of a complete study, of one with missing answers, and of one whose answers are so
// equal that tests do not exist, of one with answers to anchors, and of repetitions of which some are missing. A wrong number is
// found.
#include "reports/scripts/reproduction.h"

#include <QProcess>
#include <QProcessEnvironment>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <map>

#include "protocols/files/csv_table.h"
#include "protocols/files/whole_file.h"
#include "reports/data/answers_csv.h"

namespace fs = std::filesystem;

namespace {

fs::path smallStudy() { return fs::path(VIS2HAP_SOURCE_DIR) / "tests/reports/small_study/answers.csv"; }

/// Ten participants, three fabrics, three conditions. "degenerate": one condition is always right, two have equal ratings.
std::string studyCsv(bool isDegenerate)
{
    std::string csv = "participant,fabric,condition,Q1_correct,Q2\n";
    const char* conditions[] = {"f", "h", "h&f"};
    for (int p = 0; p < 10; ++p)
        for (int f = 0; f < 3; ++f)
            for (int c = 0; c < 3; ++c) {
                const int mixed = (7 * p + 5 * f + 3 * c * c + p * f) % 11;
                const int correct = isDegenerate && c == 2 ? 1 : mixed > 5 - c ? 1 : 0;
                const double rating = isDegenerate && c > 0 ? 5 : (mixed * 7 + 11 * c) % 100 / 10.0;
                csv += (p < 9 ? "=P0" : "=P") + std::to_string(p + 1) + ",F" + std::to_string(f + 1) + "," + conditions[c] + "," +
                       std::to_string(correct) + "," + std::to_string(rating) + "\n";
            }
    return csv;
}

/// Eight participants, three fabrics and three conditions under two instructions; "sessions": in sessions of one condition each.
/// A seventh of the answers is missing.
std::string repeatedCsv(bool hasSessions)
{
    std::string csv = "participant,fabric,condition,session,instruction,Q1_correct,Q2\n";
    const char* conditions[] = {"f", "h", "h&f"};
    int place = 0;
    for (int p = 0; p < 8; ++p)
        for (int f = 0; f < 3; ++f)
            for (int c = 0; c < 3; ++c)
                for (int repetition = 0; repetition < 4; ++repetition) {
                    if (++place * 37 % 101 % 7 == 0) continue;
                    const bool isFast = repetition % 2 == 0;
                    const int mixed = (7 * p + 5 * f + 3 * c * c + p * f + 4 * repetition) % 11;
                    const int session = repetition / 2 + (hasSessions ? 2 * ((p + c) % 3) : 0);
                    csv += "P" + std::to_string(p) + ",F" + std::to_string(f) + "," + conditions[c] + "," +
                           std::to_string(session + 1) + (isFast ? ",speed," : ",accuracy,") +
                           (mixed > (isFast ? 7 : 3) - c ? "1," : "0,") +
                           std::to_string((isFast ? 2 : 5) + (mixed * 7 + 11 * c) % 40 / 10.0) + "\n";
                }
    return csv;
}

/// Six participants whose choices and ratings partly came again: Q1 beside other foils, Five among the same five fabrics.
std::string anchoredCsv()
{
    std::string csv = "participant,question,fabric,condition,alternatives,answer,correct,rating,anchor\n";
    const auto add = [&](const std::string& before, const char* tray, int answer, const char* anchor) {
        const std::string chosen = "F" + std::to_string(answer + 1);
        csv += before + "," + tray + "," + chosen + "," + (before.find("," + chosen + ",") != std::string::npos ? "1" : "0") +
               ",," + anchor + "\n";
    };
    const char* conditions[] = {"f", "h", "h&f"};
    for (int p = 0; p < 6; ++p)
        for (int f = 0; f < 2; ++f)
            for (int c = 0; c < 3; ++c) {
                const auto row = [&](const char* question) {
                    return "P" + std::to_string(p + 1) + "," + question + ",F" + std::to_string(f + 1) + "," + conditions[c];
                };
                const int mixed = (7 * p + 5 * f + 3 * c * c + p * f) % 11;
                for (const bool again : {false, true}) {
                    if (again && c == f) continue;
                    const char* anchor = again ? "repeated" : "";
                    const int answer = again && mixed % 3 == 0 ? 2 : mixed % 4 == 0 ? 3 : (f + mixed / 8) % 3;
                    add(row("Q1"), again ? R"("[""F1"",""F2"",""F5""]")" : R"("[""F1"",""F2"",""F3""]")", answer, anchor);
                    add(row("Five"), R"("[""F1"",""F2"",""F3"",""F4"",""F5""]")", answer, anchor);
                    // One piece, the true one or the other, which stays on the tray.
                    const bool isOwn = (p + c) % 2 == 0, isSame = (mixed + (again ? 5 : 0)) % 4 != 0;
                    csv += row("Same") + R"(,"[""F)" + std::to_string(isOwn ? f + 1 : 2 - f) + R"(""]",)" +
                           (isSame ? "same," : "different,") + (isOwn == isSame ? "1,," : "0,,") + anchor + "\n";
                    const int shift = again ? 5 + (p * p + 3 * c) % 7 : 0;  // differences that are all equal have no test in R
                    const int tenths = (mixed * 7 + 11 * c * (p + 2) + shift) % 100;
                    csv += row("Q2") + ",[],,," + std::to_string(tenths / 10.0) + "," + anchor + "\n";
                }
            }
    return csv;
}

/// Answers of anchoredCsv(), where a table of others does not tell that two words are the answers.
reports::StudyData readAnchored(const fs::path& answers)
{
    reports::StudyData data = reports::readAnswersCsv(answers);
    for (reports::QuestionInfo& question : data.questions)
        if (question.id == "Same") question.kind = protocols::SameDifferent{};
    return data;
}

/// Ten participants as in studyCsv(). One presentation came twice, and its answers cannot be compared: choices of which only
/// right and wrong are known, ratings that are all equal, or one rating alone.
std::string uncomparableCsv(const QString& what)
{
    std::string csv = "participant,fabric,condition,Q1_correct,Q2,anchor\n";
    const char* conditions[] = {"f", "h", "h&f"};
    for (int p = 0; p < 10; ++p)
        for (int f = 0; f < 3; ++f)
            for (int c = 0; c < 3; ++c) {
                const int mixed = (7 * p + 5 * f + 3 * c * c + p * f) % 11;
                const bool isRepeated = f == 0 && c == 0;
                const std::string cell =
                    "P" + std::to_string(p) + ",F" + std::to_string(f) + "," + conditions[c] + (mixed > 5 - c ? ",1," : ",0,");
                const std::string rating =
                    isRepeated && what == "equal ratings" ? "5.1" : std::to_string((mixed * 7 + 11 * c) % 100 / 10.0);
                csv += cell + rating + ",\n";
                if (isRepeated && (what != "one rating" || p == 0))
                    csv += cell + (what == "choices" ? "" : rating) + ",repeated\n";
            }
    return csv;
}

bool has(const QString& program)
{
    if (QStandardPaths::findExecutable(program).isEmpty()) return false;
    return program != "python3" || QProcess::execute("python3", {"-c", "import scipy"}) == 0;
}

/// Exit code and output of a script in its folder.
std::pair<int, QString> ran(const QString& program, const QString& script, const fs::path& folder,
                            const QProcessEnvironment& environment = QProcessEnvironment::systemEnvironment())
{
    QProcess process;
    process.setProcessEnvironment(environment);
    process.setWorkingDirectory(QString::fromStdString(folder.string()));
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(program, {script});
    if (!process.waitForFinished(280'000)) return {-1, "did not end"};
    return {process.exitCode(), QString::fromUtf8(process.readAll())};
}

/// Replaces the value in the first row that begins with `start`; false where no row does.
bool setNumber(const fs::path& folder, const QString& start, const QString& value)
{
    auto rows = QString::fromStdString(protocols::readWholeFile(folder / "expected.csv")).split('\n');
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const QString& one) { return one.startsWith(start); });
    if (row == rows.end()) return false;
    *row = row->section(',', 0, -2) + "," + value;
    protocols::writeWholeFile(folder / "expected.csv", rows.join('\n').toStdString());
    return true;
}

/// Whether every number that the script compared agrees.
bool isReproduced(const QString& said)
{
    const auto counts = QRegularExpression("reproduced: (\\d+) of (\\d+)\n").match(said);
    return counts.hasMatch() && counts.captured(1) == counts.captured(2) && counts.captured(2).toInt() > 50;
}

bool hasPackageOfR(const QString& package)
{
    return has("Rscript") &&
           QProcess::execute("Rscript", {"-e", "quit(status = !requireNamespace('" + package + "', quietly = TRUE))"}) == 0;
}

}  // namespace

class ReproductionTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyNumberHasItsRow()
    {
        const auto analysis = reports::analyse(reports::readAnswersCsv(smallStudy()), {.depth = reports::Depth::Quick});
        const auto table = protocols::csvTableFrom(reports::expectedNumbersCsv(analysis), "expected.csv");
        std::map<std::string, int> rows;
        for (const auto& row : table.rows) ++rows[row[0]];
        // Q1 is a choice, Q2 and Q3 are ratings; three conditions make three pairs.
        const std::map<std::string, int> wanted{{"matches", 3 * 5},
                                                {"ratings", 2 * 3 * 5},
                                                {"comparison", 3 * 3 * 9},
                                                {"equivalence", 2 * 3 * 6},
                                                {"above_chance_these_fabrics", 3 * 7},
                                                {"above_chance_fabrics_like_these", 3 * 7},
                                                {"claims_these_fabrics", 3 * 3 * 11},
                                                {"claims_fabrics_like_these", 3 * 3 * 11},
                                                {"linear_model", 3 * 10},
                                                {"model_contrast", 2 * 3 * 7},
                                                {"logistic_model", 10},
                                                {"logistic_model_crossed", 15}};
        QVERIFY(rows == wanted);
        const auto answers = protocols::csvTableFrom(reports::analysedAnswersCsv(analysis.data), "answers.csv");
        QCOMPARE(answers.rows.size(), analysis.data.responses.size());
    }

    /// The scripts get the alternatives and the number of answers that are compared.
    void choicesThatCameTwiceHaveTheirRows()
    {
        QTemporaryDir place;
        const fs::path answers = fs::path(place.path().toStdString()) / "study.csv";
        protocols::writeWholeFile(answers, anchoredCsv());
        const auto analysis = reports::analyse(readAnchored(answers), {.depth = reports::Depth::Quick});
        const QString numbers = QString::fromStdString(reports::expectedNumbersCsv(analysis));
        QCOMPARE(numbers.count("anchor_choices,Q1,,,3,2,"), 8);
        QCOMPARE(numbers.count("anchor_choices,Five,,,3,3,"), 8);
        QCOMPARE(numbers.count("anchor_words,Same,,,2,2,"), 8);
        QCOMPARE(numbers.count("anchor_choices,"), 16);
    }

    /// Right and wrong alone do not say whether two wrong choices are the same: there is no number to compute.
    void choicesWithoutTheirFabricHaveNoRows()
    {
        QTemporaryDir place;
        const fs::path answers = fs::path(place.path().toStdString()) / "study.csv";
        protocols::writeWholeFile(answers, uncomparableCsv("choices"));
        const auto analysis = reports::analyse(reports::readAnswersCsv(answers), {.depth = reports::Depth::Quick});
        QVERIFY(!analysis.data.repeatedResponses.empty());
        QCOMPARE(QString::fromStdString(reports::expectedNumbersCsv(analysis)).count("anchor_choices"), 0);
    }

    /// A script that stops computes none of the other numbers, either.
    void anchorsThatCannotBeComparedStopNoScript_data()
    {
        QTest::addColumn<QString>("program");
        QTest::addColumn<QString>("script");
        QTest::addColumn<QString>("what");
        for (const char* what : {"choices", "equal ratings", "one rating"}) {
            QTest::addRow("R, %s", what) << "Rscript"
                                         << "analysis.R" << what;
            QTest::addRow("Python, %s", what) << "python3"
                                              << "analysis.py" << what;
        }
    }
    void anchorsThatCannotBeComparedStopNoScript()
    {
        QFETCH(const QString, program);
        QFETCH(const QString, script);
        QFETCH(const QString, what);
        if (!has(program)) QSKIP(qPrintable(program + " (or scipy) is not installed, so its script is not run"));
        QTemporaryDir place;
        const fs::path folder(place.path().toStdString());
        protocols::writeWholeFile(folder / "study.csv", uncomparableCsv(what));
        reports::writeReproduction(
            reports::analyse(reports::readAnswersCsv(folder / "study.csv"), {.depth = reports::Depth::Quick}), folder);
        const auto [code, said] = ran(program, script, folder);
        QVERIFY2(code == 0 && isReproduced(said), qPrintable(said));
        QCOMPARE(said.contains("anchor_ratings: "), what != "choices");
    }

    void modelsOfEqualRatingsHaveTheirRows()
    {
        QTemporaryDir place;
        const fs::path answers = fs::path(place.path().toStdString()) / "study.csv";
        protocols::writeWholeFile(answers, studyCsv(true));
        const auto analysis = reports::analyse(reports::readAnswersCsv(answers), {.depth = reports::Depth::Quick});
        const auto table = protocols::csvTableFrom(reports::expectedNumbersCsv(analysis), "expected.csv");
        std::map<std::string, int> rows;
        for (const auto& row : table.rows)
            if (row[1] == "Q2") ++rows[row[0]];
        QCOMPARE(rows["linear_model"], 10);
        QCOMPARE(rows["model_contrast"], 3 * 7);
        QCOMPARE(rows["claims_fabrics_like_these"], 3 * 11);
    }

    void otherProgramsComputeTheSame_data()
    {
        QTest::addColumn<QString>("program");
        QTest::addColumn<QString>("script");
        QTest::addColumn<QString>("study");
        for (const char* study : {"clean", "missing", "degenerate", "anchors", "repetitions", "sessions"}) {
            QTest::addRow("R, %s", study) << "Rscript"
                                          << "analysis.R" << study;
            QTest::addRow("Python, %s", study) << "python3"
                                               << "analysis.py" << study;
        }
    }
    void otherProgramsComputeTheSame()
    {
        QFETCH(const QString, program);
        QFETCH(const QString, script);
        QFETCH(const QString, study);
        if (!has(program)) QSKIP(qPrintable(program + " (or scipy) is not installed, so its script is not run"));
        QTemporaryDir place;
        const fs::path folder(place.path().toStdString());
        fs::path answers = smallStudy();
        if (study != "missing") {
            answers = folder / "study.csv";
            const bool isRepeated = study == "repetitions" || study == "sessions";
            protocols::writeWholeFile(answers, study == "anchors" ? anchoredCsv()
                                               : isRepeated       ? repeatedCsv(study == "sessions")
                                                                  : studyCsv(study == "degenerate"));
        }
        const reports::StudyData data = study == "anchors" ? readAnchored(answers) : reports::readAnswersCsv(answers);
        reports::writeReproduction(reports::analyse(data, {.depth = reports::Depth::Quick}), folder);
        const auto [code, said] = ran(program, script, folder);
        QVERIFY2(code == 0, qPrintable(said));
        QVERIFY2(isReproduced(said), qPrintable(said));
        QCOMPARE(said.contains("anchor_choices: 16 of 16"), study == "anchors");
        QCOMPARE(said.contains("anchor_words: 8 of 8"), study == "anchors");
        // One number of the report is made wrong.
        QVERIFY(setNumber(folder, "ratings,Q2,f,,,,mean,", "99") || setNumber(folder, "ratings,Q2,v_grey,,,,mean,", "99"));
        const auto [wrong, words] = ran(program, script, folder);
        QCOMPARE(wrong, 1);
        QVERIFY2(words.contains("differs: ratings Q2"), qPrintable(words));
    }

    void modelsAreComputedInR()
    {
        for (const char* package : {"lme4", "lmerTest", "ordinal"})
            if (!hasPackageOfR(package))
                QSKIP(qPrintable(QString("R or its package %1 is not installed, so no mixed model was compared").arg(package)));
        QTemporaryDir place;
        const fs::path folder(place.path().toStdString());
        reports::writeReproduction(reports::analyse(reports::readAnswersCsv(smallStudy())), folder);
        const auto [code, said] = ran("Rscript", "analysis.R", folder);
        QVERIFY2(code == 0 && isReproduced(said), qPrintable(said));
        for (const char* line : {"claims_fabrics_like_these: 99 of 99", "above_chance_fabrics_like_these: 21 of 21",
                                 "linear_model: 30 of 30", "model_contrast: 42 of 42", "logistic_model: 10 of 10",
                                 "logistic_model_crossed: 15 of 15", "ordinal_model: 32 of 32"})
            QVERIFY2(said.contains(line), qPrintable(said));
        // One number of each model is made wrong by 1 % or more.
        const std::map<QString, QString> wrongNumbers{{"claims_fabrics_like_these,Q2,v_grey,h&f,-0.5,0.5,df,", "1"},
                                                      {"linear_model,Q2,,,,,f,", "9"},
                                                      {"model_contrast,Q3,v_grey,h&f,,,se,", "1"},
                                                      {"logistic_model,Q1,,,,,chi2,", "9"},
                                                      {"logistic_model_crossed,Q1,,,,,log_likelihood,", "-50"},
                                                      {"ordinal_model,Q2,h&f,v_grey,1,,p,", "0.5"}};
        for (const auto& [start, value] : wrongNumbers) QVERIFY2(setNumber(folder, start, value), qPrintable(start));
        const auto [wrong, words] = ran("Rscript", "analysis.R", folder);
        QCOMPARE(wrong, 1);
        for (const auto& [start, value] : wrongNumbers)
            QVERIFY2(words.contains("differs: " + start.section(',', 0, 1).replace(',', ' ')), qPrintable(words));
    }

    // Repetitions of which some are missing. And where optimisers stop at different places: ratings that are all equal, and so
    // few answers that variances tie with zero, that groups reproduce every number, or that a separated condition leaves one
    // condition.
    void modelsOfExtremeStudiesAreComputedInR_data()
    {
        QTest::addColumn<QByteArray>("csv");
        const auto few = [](const QList<int>& answers, int participants, int fabrics, int conditions) {
            QByteArray csv = "participant,fabric,condition,Q1_correct,Q2\n";
            for (qsizetype i = 0; i < answers.size(); ++i) {
                const int c = int(i) % conditions, f = int(i) / conditions % fabrics, p = int(i) / conditions / fabrics;
                if (answers[i] < 0 || p >= participants) continue;
                csv += QString("P%1,F%2,c%3,%4,%5\n")
                           .arg(p)
                           .arg(f)
                           .arg(c)
                           .arg(answers[i] / 100)
                           .arg(answers[i] % 100 / 10.0)
                           .toUtf8();
            }
            return csv;
        };
        QTest::newRow("equal ratings") << QByteArray::fromStdString(studyCsv(true));
        QTest::newRow("repetitions with gaps") << QByteArray::fromStdString(repeatedCsv(false));
        QTest::newRow("sessions of one condition with gaps") << QByteArray::fromStdString(repeatedCsv(true));
        // 100 and more: right; the rest is ten times the rating. -1: no answer.
        QTest::newRow("2 x 2 x 2, one condition always right") << few({172, 67, 150, 53, 136, 153, 154, 164}, 2, 2, 2);
        QTest::newRow("2 x 2 x 2, ties") << few({160, 50, 60, 150, 70, 150, 140, 60}, 2, 2, 2);
        QTest::newRow("2 x 2 x 2, half of them right") << few({140, 50, 60, 160, 150, 70, 150, 40}, 2, 2, 2);
        QTest::newRow("3 x 3 x 3 with gaps") << few(
            {55, 65, 57, 160, 58, 159, -1, 43, 169, 43, 158, 163, -1, 147, 39, 18, 42, -1, -1, -1, 44, 49, 135, 43, 60, 47, 46},
            3, 3, 3);
    }

    void modelsOfExtremeStudiesAreComputedInR()
    {
        QFETCH(const QByteArray, csv);
        for (const char* package : {"lme4", "lmerTest", "ordinal"})
            if (!hasPackageOfR(package))
                QSKIP(qPrintable(QString("R or its package %1 is not installed, so no mixed model was compared").arg(package)));
        QTemporaryDir place;
        const fs::path folder(place.path().toStdString());
        protocols::writeWholeFile(folder / "study.csv", csv.toStdString());
        reports::writeReproduction(reports::analyse(reports::readAnswersCsv(folder / "study.csv")), folder);
        const auto [code, said] = ran("Rscript", "analysis.R", folder);
        QVERIFY2(code == 0 && isReproduced(said), qPrintable(said));
    }

    /// Sum contrasts are common in psychology; the script weights coefficients of treatment contrasts.
    void theUsersOwnOptionsChangeNoNumber()
    {
        if (!has("Rscript")) QSKIP("R is not installed, so its script is not run");
        QTemporaryDir place;
        const fs::path folder(place.path().toStdString());
        reports::writeReproduction(reports::analyse(reports::readAnswersCsv(smallStudy()), {.depth = reports::Depth::Quick}),
                                   folder);
        protocols::writeWholeFile(folder / "profile.R",
                                  "options(contrasts = c('contr.sum', 'contr.poly'), scipen = -5, OutDec = ',')\n");
        auto environment = QProcessEnvironment::systemEnvironment();
        environment.insert("R_PROFILE_USER", place.filePath("profile.R"));
        const auto [code, said] = ran("Rscript", "analysis.R", folder, environment);
        QVERIFY2(code == 0 && isReproduced(said), qPrintable(said));
    }

    void modelsAreLeftOutWithoutTheirPackages()
    {
        if (!has("Rscript")) QSKIP("R is not installed, so its script is not run");
        QTemporaryDir place;
        const fs::path folder(place.path().toStdString());
        reports::writeReproduction(reports::analyse(reports::readAnswersCsv(smallStudy()), {.depth = reports::Depth::Quick}),
                                   folder);
        auto environment = QProcessEnvironment::systemEnvironment();
        for (const char* libraries : {"R_LIBS", "R_LIBS_SITE", "R_LIBS_USER"}) environment.insert(libraries, place.path());
        const auto [code, said] = ran("Rscript", "analysis.R", folder, environment);
        if (!said.contains("needs lme4")) QSKIP("lme4 lies among the packages of R itself, so it cannot be hidden");
        QVERIFY2(code == 0 && isReproduced(said), qPrintable(said));
        QVERIFY2(said.contains("needs lme4 and lmerTest (apt-get install r-cran-lme4 r-cran-lmertest)"), qPrintable(said));
        QVERIFY2(said.contains("claims_these_fabrics: 99 of 99") && !said.contains("linear_model: "), qPrintable(said));
    }
};

QTEST_GUILESS_MAIN(ReproductionTest)
#include "reproduction_test.moc"
