// Other programs compute the main tables again: of a complete study, of one with missing answers, and of one whose answers are so
// equal that tests do not exist. A wrong number is found.
#include "reports/scripts/reproduction.h"

#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QtTest>
#include <fstream>

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

/// Exit code and output of a script in its folder.
std::pair<int, QString> ran(const QString& program, const QString& script, const fs::path& folder)
{
    QProcess process;
    process.setWorkingDirectory(QString::fromStdString(folder.string()));
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(program, {script});
    if (!process.waitForFinished(120'000)) return {-1, "did not end"};
    return {process.exitCode(), QString::fromUtf8(process.readAll())};
}

bool has(const QString& program)
{
    if (QStandardPaths::findExecutable(program).isEmpty()) return false;
    return program != "python3" || QProcess::execute("python3", {"-c", "import scipy"}) == 0;
}

}  // namespace

class ReproductionTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyNumberHasItsRow()
    {
        const auto analysis = reports::analyse(reports::readAnswersCsv(smallStudy()), {.depth = reports::Depth::Quick});
        const auto table = protocols::csvTableFrom(reports::expectedNumbersCsv(analysis), "expected.csv");
        // 3 conditions of 5 numbers for each of Q1, Q2 and Q3; 3 pairs of 9 numbers each; 3 pairs of 6 numbers for Q2 and Q3.
        QCOMPARE(table.rows.size(), std::size_t(3 * 3 * 5 + 3 * 3 * 9 + 2 * 3 * 6));
        const auto answers = protocols::csvTableFrom(reports::analysedAnswersCsv(analysis.data), "answers.csv");
        QCOMPARE(answers.rows.size(), analysis.data.responses.size());
    }

    void otherProgramsComputeTheSame_data()
    {
        QTest::addColumn<QString>("program");
        QTest::addColumn<QString>("script");
        QTest::addColumn<QString>("study");
        for (const char* study : {"clean", "missing", "degenerate"}) {
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
            protocols::writeWholeFile(answers, studyCsv(study == "degenerate"));
        }
        reports::writeReproduction(reports::analyse(reports::readAnswersCsv(answers), {.depth = reports::Depth::Quick}), folder);
        const auto [code, said] = ran(program, script, folder);
        QVERIFY2(code == 0, qPrintable(said));
        const auto counts = QRegularExpression("reproduced: (\\d+) of (\\d+)\n").match(said);
        QVERIFY2(counts.hasMatch() && counts.captured(1) == counts.captured(2) && counts.captured(2).toInt() > 50,
                 qPrintable(said));
        // One number of the report is made wrong.
        auto rows = QString::fromStdString(protocols::readWholeFile(folder / "expected.csv")).split('\n');
        const auto mean = std::find_if(rows.begin(), rows.end(), [](const QString& row) { return row.contains(",mean,"); });
        QVERIFY(mean != rows.end());
        *mean = mean->section(',', 0, -2) + ",99";
        protocols::writeWholeFile(folder / "expected.csv", rows.join('\n').toStdString());
        const auto [wrong, words] = ran(program, script, folder);
        QCOMPARE(wrong, 1);
        QVERIFY2(words.contains("differs: ratings Q2"), qPrintable(words));
    }
};

QTEST_GUILESS_MAIN(ReproductionTest)
#include "reproduction_test.moc"
