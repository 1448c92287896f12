// Tables as in RFC 4180. The examples are those of its section 2, https://www.rfc-editor.org/rfc/rfc4180.
#include "protocols/files/csv_table.h"

#include <QTest>

#include "protocols/files/errors.h"
#include "tests/support/error_text.h"

using tests::support::errorOf;
using namespace protocols;

namespace {

using Rows = std::vector<std::vector<std::string>>;

}  // namespace

class CsvTableTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void examplesOfTheStandardAreRead_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::newRow("1: a line break after each row") << QByteArray("a,b,c\r\naaa,bbb,ccc\r\nzzz,yyy,xxx\r\n");
        QTest::newRow("2: none after the last") << QByteArray("a,b,c\r\naaa,bbb,ccc\r\nzzz,yyy,xxx");
        QTest::newRow("5: quotes") << QByteArray("a,b,c\r\n\"aaa\",\"bbb\",\"ccc\"\r\nzzz,yyy,xxx");
        QTest::newRow("of Unix") << QByteArray("a,b,c\naaa,bbb,ccc\nzzz,yyy,xxx\n");
        QTest::newRow("of old Macs") << QByteArray("a,b,c\raaa,bbb,ccc\rzzz,yyy,xxx\r");
        QTest::newRow("of Python on Windows") << QByteArray("a,b,c\r\r\naaa,\"bbb\",\"ccc\"\r\r\nzzz,yyy,xxx\r\r\n");
        QTest::newRow("byte order mark, empty lines, blanks")
            << QByteArray("\xEF\xBB\xBF\n a ,b,c\n\naaa,bbb,ccc\n  \nzzz,yyy,xxx\n\n");
    }
    void examplesOfTheStandardAreRead()
    {
        QFETCH(const QByteArray, text);
        const CsvTable table = csvTableFrom(text.toStdString(), "t.csv");
        QCOMPARE(table.columns, (std::vector<std::string>{"a", "b", "c"}));
        QCOMPARE(table.rows, (Rows{{"aaa", "bbb", "ccc"}, {"zzz", "yyy", "xxx"}}));
    }

    void quotesHoldBreaksSeparatorsAndQuotes()
    {
        const CsvTable table = csvTableFrom("a,b,c\n\"aaa\",\"b\r\nbb\",\"c,c\"\n\"aaa\",\"b\"\"bb\",\"\"\n", "t.csv");
        QCOMPARE(table.rows, (Rows{{"aaa", "b\r\nbb", "c,c"}, {"aaa", "b\"bb", ""}}));
        QCOMPARE(table.lines, (std::vector<std::size_t>{2, 4}));
    }

    /// Without this, the values after a missing one would move up.
    void anEmptyLineOfOneColumnIsAMissingValue()
    {
        const CsvTable table = csvTableFrom("\nx\r\n1\r\n\r\n  \r\n\"\"\r\n4\r\n\r\n \n", "t.csv");
        QCOMPARE(table.rows, (Rows{{"1"}, {""}, {"  "}, {""}, {"4"}}));
        QCOMPARE(table.lines, (std::vector<std::size_t>{3, 4, 5, 6, 7}));
        QCOMPARE(csvTableFrom("x\n1\n\"\"\n\n", "t.csv").rows, (Rows{{"1"}, {""}}));
        QVERIFY(csvTableFrom("x\n\n \n", "t.csv").rows.empty());
        QCOMPARE(csvTableFrom("x\n" + csvRow({"1"}) + csvRow({""}), "t.csv").rows, (Rows{{"1"}, {""}}));
        QVERIFY(errorOf([] { csvTableFrom("a,b\n1,2\n\"\"\n", "t.csv"); }).contains("line 3): the row has 1 cell"));
    }

    /// Python's csv on Windows ends a line so where the file was opened without newline="". No value is missing between them.
    void aDoubledCarriageReturnIsOneLineBreak()
    {
        const CsvTable table = csvTableFrom("x\r\r\n1\r\r\n\"2\"\r\r\n\r\r\n4\r\r\n", "t.csv");
        QCOMPARE(table.rows, (Rows{{"1"}, {"2"}, {""}, {"4"}}));
        QCOMPARE(table.lines, (std::vector<std::size_t>{2, 3, 4, 5}));
        QCOMPARE(csvTableFrom("x\r1\r\r4\r", "t.csv").rows, (Rows{{"1"}, {""}, {"4"}}));
    }

    void manyEmptyLinesAreReadQuickly()
    {
        const CsvTable table = csvTableFrom("x\n" + std::string(500'000, '\n') + "1\n" + std::string(500'000, '\n'), "t.csv");
        QCOMPARE(table.rows.size(), std::size_t{500'001});
    }

    void otherSeparatorsAreAnOption()
    {
        const CsvTable table = csvTableFrom("a;b\n1,5;2\n", "t.csv", ';');
        QCOMPARE(table.rows, (Rows{{"1,5", "2"}}));
        QCOMPARE(csvTableFrom("a\tb\n1\t2\n", "t.csv", '\t').columns.size(), std::size_t{2});
        QCOMPARE(csvRow({"1,5", "a;b"}, ';'), std::string("1,5;\"a;b\"\n"));
    }

    void faultsNameFileRowAndLine_data()
    {
        QTest::addColumn<QByteArray>("text");
        QTest::addColumn<QString>("said");
        QTest::newRow("nothing") << QByteArray() << "2: t.csv: the file is empty; expected a header row";
        QTest::newRow("only blanks") << QByteArray("  \n\n") << "2: t.csv: the file is empty; expected a header row";
        QTest::newRow("column twice") << QByteArray("\na,b,a\n")
                                      << "2: t.csv, line 2: the column \"a\" occurs twice; expected each column once";
        QTest::newRow("short row") << QByteArray("a,b\n1,2\n\n3\n")
                                   << "2: t.csv, row 2 (line 4): the row has 1 cell; expected 2, as the header has";
        QTest::newRow("long row") << QByteArray("a,b\n\"x\n\",2\n3,4,5\n")
                                  << "2: t.csv, row 2 (line 4): the row has 3 cells; expected 2, as the header has";
        QTest::newRow("open quote") << QByteArray("a,b\n1,2\n3,\"4\n")
                                    << "2: t.csv, line 3: a quote is never closed; expected a closing quote";
        QTest::newRow("quote inside")
            << QByteArray("a,b\n1,5\"\n")
            << "2: t.csv, line 2: a quote stands inside a cell; expected the whole cell in quotes, with "
               "inner quotes doubled";
        QTest::newRow("text after a quote")
            << QByteArray("a,b\n1,\"5\"x\n")
            << "2: t.csv, line 2: text follows a closing quote; expected a separator or the end of "
               "the line";
    }
    void faultsNameFileRowAndLine()
    {
        QFETCH(const QByteArray, text);
        QFETCH(const QString, said);
        QCOMPARE(errorOf([&] { csvTableFrom(text.toStdString(), "t.csv"); }), said);
    }

    void numbersAreReadOrNamed()
    {
        const CsvTable table = csvTableFrom("a,b\n +1.5e1,NA\n,five\n1e999,nan\n", "t.csv");
        QCOMPARE(numberAt(table, 0, 0), 15.0);
        QCOMPARE(errorOf([&] { numberAt(table, 1, 0); }),
                 QString("2: t.csv, row 2 (line 3), column a: the cell is empty; expected a finite number"));
        QVERIFY(errorOf([&] { numberAt(table, 2, 0); }).contains("\"1e999\" is not a number"));
        QVERIFY(!numberOrMissing(table, 0, 1));
        QVERIFY(!numberOrMissing(table, 1, 0));
        QVERIFY(!numberOrMissing(table, 2, 1));
        QCOMPARE(errorOf([&] { numberOrMissing(table, 1, 1); }),
                 QString("2: t.csv, row 2 (line 3), column b: \"five\" is not a number; expected a finite number; an empty cell, "
                         "NA or NaN for a missing value"));
    }

    void longRecordsAreReadRowByRow()
    {
        CsvReader reader("t_s,mu\n0,0.5\n1,soft\n", "t.csv");
        QCOMPARE(*reader.column("mu"), std::size_t{1});
        QVERIFY(!reader.column("force"));
        QVERIFY(reader.next());
        QCOMPARE(reader.number(1), 0.5);
        QVERIFY(reader.next());
        QCOMPARE(reader.rows(), std::size_t{2});
        QVERIFY(errorOf([&] { reader.number(1); }).contains("t.csv, row 2 (line 3), column mu: \"soft\""));
        QVERIFY(!reader.next());
    }

    /// Before, 8 MB of commas took 577 MB.
    void aFileOfCommasIsNoTable()
    {
        const std::string widest(mostColumns - 1, ',');
        QCOMPARE(csvTableFrom(widest + "\n" + widest + "\n", "t.csv").rows.front().size(), mostColumns);
        for (const std::string& text : {widest + ",\n", std::string(8'000'000, ',')})
            QCOMPARE(
                errorOf([&] { csvTableFrom(text, "t.csv"); }),
                QString("2: t.csv, line 1: the row has more than 16384 cells; expected at most 16384; check that the file is a "
                        "table, and its separator"));
        QVERIFY(errorOf([&] {
                    csvTableFrom("a,b\n1,2\n" + widest + ",\n", "t.csv");
                }).startsWith("2: t.csv, line 3: the row has more than 16384 cells"));
    }

    void aTableThatIsKeptHasALimitedNumberOfCells()
    {
        QVERIFY(mostCells > std::size_t{252'000} * 42);  // the answers of a large study
        QCOMPARE(csvTableFrom("a,b\n1,2\n3,4\n5,6\n", "t.csv", ',', 12).rows.size(), std::size_t{3});
        QCOMPARE(
            errorOf([&] { csvTableFrom("a,b\n1,2\n3,4\n5,6\n7,8\n", "t.csv", ',', 12); }),
            QString("2: t.csv: the table has more than 3 rows of 2 cells; expected at most 12 cells in all, where a row counts "
                    "as two more; leave out columns, or split the table"));
    }

    void cellsAreQuotedWhereTheyMustBe()
    {
        QCOMPARE(csvCell("a b"), std::string("a b"));
        QCOMPARE(csvCell("a \"b\",c"), std::string("\"a \"\"b\"\",c\""));
        QCOMPARE(csvCell("a\nb"), std::string("\"a\nb\""));
        QCOMPARE(csvRow({"a", "b,c", ""}), std::string("a,\"b,c\",\n"));
    }
};

QTEST_GUILESS_MAIN(CsvTableTest)
#include "csv_table_test.moc"
