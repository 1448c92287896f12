// Columns of another lab's table: the names that --map gives them, and the scale that nobody states.
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <map>

#include "reports/data/answers_csv.h"
#include "reports/page/plan_section.h"
#include "tests/support/error_text.h"

using reports::AnswersCsvOptions;
using tests::support::errorOf;

namespace {

using Names = std::vector<std::pair<std::string, std::string>>;

reports::StudyData dataOf(const std::string& text, AnswersCsvOptions options, QString* notes = nullptr)
{
    const QTemporaryDir folder;
    const auto file = std::filesystem::path(folder.path().toStdString()) / "answers.csv";
    std::ofstream(file, std::ios::binary) << text;
    if (notes != nullptr)
        options.note = [notes](const std::string& sentence) { *notes += QString::fromStdString(sentence) + "\n"; };
    return reports::readAnswersCsv(file, options);
}

/// The rating of each question in a table of one row.
std::map<std::string, double> ratingsWith(const Names& names, const std::string& header, const std::string& cells)
{
    AnswersCsvOptions options;
    options.rows.names = names;
    std::map<std::string, double> ratings;
    for (const auto& response :
         dataOf("participant,fabric,condition," + header + "\nP01,F01,h," + cells + "\n", options).responses)
        ratings[response.question] = std::get<reports::RatedAnswer>(response.content).rating;
    return ratings;
}

}  // namespace

class NamedColumnsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    /// The first option once renamed the column that the second one then found.
    void everyColumnIsNamedAsInTheFile_data()
    {
        QTest::addColumn<Names>("names");
        QTest::newRow("upwards") << Names{{"Q2", "Q1"}, {"Q3", "Q2"}, {"Q4", "Q3"}};
        QTest::newRow("downwards") << Names{{"Q4", "Q3"}, {"Q3", "Q2"}, {"Q2", "Q1"}};
    }
    void everyColumnIsNamedAsInTheFile()
    {
        QFETCH(const Names, names);
        QCOMPARE(ratingsWith(names, "Q1,Q2,Q3", "1,5,9"), (std::map<std::string, double>{{"Q2", 1}, {"Q3", 5}, {"Q4", 9}}));
    }

    void columnsCanBeSwapped()
    {
        QCOMPARE(ratingsWith({{"Q2", "Q3"}, {"Q3", "Q2"}}, "Q2,Q3", "2,8"),
                 (std::map<std::string, double>{{"Q2", 8}, {"Q3", 2}}));
    }

    void whatIsNamedTwiceIsRefused()
    {
        const auto refusal = [](const Names& names) { return errorOf([&] { ratingsWith(names, "a,b", "1,2"); }); };
        QVERIFY2(refusal({{"Q2", "a"}, {"Q3", "a"}}).contains("the column \"a\" is given two meanings"),
                 qPrintable(refusal({{"Q2", "a"}, {"Q3", "a"}})));
        QVERIFY2(refusal({{"Q2", "a"}, {"Q2", "b"}}).contains("two columns are given the meaning \"Q2\""),
                 qPrintable(refusal({{"Q2", "a"}, {"Q2", "b"}})));
    }

    /// Ratings of 1 to 5 lie within 0 to 10; their bounds of equivalence would be others.
    void aScaleThatNobodyStatesIsSaid()
    {
        const std::string table = "participant,fabric,condition,Q2\nP01,F01,a,1\nP01,F01,b,5\n";
        const QString assumed = "the ratings of Q2 are read on a scale of 0 to 10, the default of this program";
        QString notes, stated;
        const auto data = dataOf(table, {}, &notes);
        QVERIFY2(notes.contains(assumed), qPrintable(notes));
        QVERIFY(data.questions.front().scaleAssumed);
        QVERIFY(reports::boundsSentence(data).find("nor the scale: 0 to 10 is assumed") != std::string::npos);
        AnswersCsvOptions options;
        options.scale = protocols::RatingScale{};
        options.scale->min = protocols::Tenths{10};
        options.scale->max = protocols::Tenths{50};
        const auto known = dataOf(table, options, &stated);
        QVERIFY2(!stated.contains(assumed), qPrintable(stated));
        QVERIFY(!known.questions.front().scaleAssumed);
        QVERIFY(reports::boundsSentence(known).find("is assumed") == std::string::npos);
    }
};

QTEST_GUILESS_MAIN(NamedColumnsTest)
#include "named_columns_test.moc"
