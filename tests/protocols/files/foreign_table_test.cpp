// Tables as spreadsheets of Germany, France, old Macs and a Chinese Windows write them.
#include "protocols/files/foreign/foreign_table.h"

#include <QTest>

#include "protocols/files/errors.h"
#include "tests/support/error_text.h"

using namespace protocols;
using tests::support::errorOf;

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Each character as two bytes of UTF-16, little endian, with a byte order mark.
std::string asUtf16(const std::u16string& text)
{
    std::string bytes = "\xFF\xFE";
    for (const char16_t c : text) {
        bytes += char(c & 0xFF);
        bytes += char(c >> 8);
    }
    return bytes;
}

}  // namespace

class ForeignTableTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theSameTableIsReadFromEverySpreadsheet_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("taken");
        QTest::newRow("usual") << QByteArray("fabric,Q2\nM\xC3\xBCll,5.5\nb,10\n") << "commas, decimal points, UTF-8";
        QTest::newRow("German Excel") << QByteArray("fabric;Q2\r\nM\xFCll;5,5\r\nb;10\r\n")
                                      << "semicolons, decimal commas, Windows-1252";
        QTest::newRow("French, UTF-8 with mark, stated separator")
            << QByteArray("\xEF\xBB\xBFsep=;\r\nfabric;Q2\r\nM\xC3\xBCll;5,5\r\nb;10\r\n") << "semicolons, decimal commas, UTF-8";
        QTest::newRow("old Mac") << QByteArray("fabric\tQ2\rM\x9Fll\t5,5\rb\t10\r") << "tabs, decimal commas, Mac OS Roman";
        QTest::newRow("Unicode text of Excel")
            << QByteArray::fromStdString(asUtf16(u"fabric\tQ2\r\nM\u00FCll\t5.5\r\nb\t10\r\n")) << "tabs, decimal points, UTF-16";
        QTest::newRow("bars") << QByteArray("fabric|Q2\nM\xC3\xBCll|5,5\nb|10\n") << "bars, decimal commas, UTF-8";
    }
    void theSameTableIsReadFromEverySpreadsheet()
    {
        QFETCH(const QByteArray, bytes);
        QFETCH(const QString, taken);
        const ForeignTable foreign = foreignTableFrom(bytes.toStdString(), "t.csv");
        QCOMPARE(QString::fromStdString(foreign.taken), taken);
        QCOMPARE(foreign.table.columns, (std::vector<std::string>{"fabric", "Q2"}));
        QCOMPARE(foreign.table.rows, (Rows{{"M\xC3\xBCll", "5.5"}, {"b", "10"}}));
        QCOMPARE(foreign.isUsual, taken == "commas, decimal points, UTF-8");
    }

    void chineseNamesOfAChineseWindowsAreRead()
    {
        // "织物" (cloth) in GB 2312.
        const ForeignTable foreign = foreignTableFrom("fabric,Q2\n\xD6\xAF\xCE\xEF,5.5\n", "t.csv");
        QCOMPARE(foreign.table.rows[0][0], std::string("\u7EC7\u7269"));
        QCOMPARE(foreign.taken, std::string("commas, decimal points, GB18030"));
    }

    /// Two accented letters in a row are one rare character of GB 2312.
    void germanWordsAreNotTakenForChinese()
    {
        const ForeignTable foreign = foreignTableFrom(
            "Gr\xF6\xDF"
            "e;S\xFC\xDF"
            "er\n3,5;2\n",
            "t.csv");
        QCOMPARE(foreign.table.columns, (std::vector<std::string>{"Gr\u00F6\u00DFe", "S\u00FC\u00DFer"}));
    }

    void pointsThatMayBeThousandsAreRefused_data()
    {
        QTest::addColumn<QByteArray>("cells");
        QTest::addColumn<bool>("isRefused");
        QTest::newRow("thousands or thousandths") << QByteArray("1.988 987 2.104") << true;
        QTest::newRow("with signs") << QByteArray("-1.988 +2.104 NA") << true;
        QTest::newRow("another number of decimals") << QByteArray("1.988 2.5 3") << false;
        QTest::newRow("below one") << QByteArray("1.988 0.104 3") << false;
        QTest::newRow("whole numbers") << QByteArray("1988 987 2104") << false;
        QTest::newRow("dates") << QByteArray("27.11.2026 1.988 2.104") << false;
    }
    void pointsThatMayBeThousandsAreRefused()
    {
        QFETCH(const QByteArray, cells);
        QFETCH(const bool, isRefused);
        std::string text = "force;ms\n";
        for (const auto& cell : cells.split(' ')) text += "0,5;" + cell.toStdString() + "\n";
        const QString error = errorOf([&] { foreignTableFrom(text, "t.csv"); });
        QCOMPARE(error.contains("may be thousands"), isRefused);
        QVERIFY(isRefused || error.isEmpty());
        // Without decimal commas nothing is in doubt.
        QVERIFY(errorOf([&] { foreignTableFrom("force;ms\n0.5;1.988\n", "t.csv"); }).isEmpty());
    }

    void commasThatMayBeThousandsAreRefused_data()
    {
        QTest::addColumn<QByteArray>("cells");
        QTest::addColumn<bool>("isRefused");
        QTest::newRow("thousands or thousandths") << QByteArray("1,203 999 2,500") << true;
        QTest::newRow("with signs") << QByteArray("-1,203 +2,104 NA") << true;
        QTest::newRow("another number of decimals") << QByteArray("1,203 2,5 3") << false;
        QTest::newRow("below one") << QByteArray("1,203 0,104 3") << false;
        QTest::newRow("four digits before") << QByteArray("1203,500 999") << false;
    }
    void commasThatMayBeThousandsAreRefused()
    {
        QFETCH(const QByteArray, cells);
        QFETCH(const bool, isRefused);
        std::string text = "t_s\ttaxels\n";
        for (const auto& cell : cells.split(' ')) text += "0.01\t" + cell.toStdString() + "\n";
        const QString error = errorOf([&] { foreignTableFrom(text, "t.tsv"); });
        QCOMPARE(error.contains("may be thousands, because other columns have decimal points"), isRefused);
        QVERIFY2(isRefused || error.isEmpty(), qPrintable(error));
        // Without decimal points nothing is in doubt.
        QCOMPARE(foreignTableFrom("t_s\ttaxels\n1\t1,203\n", "t.tsv").table.rows[0][1], std::string("1.203"));
    }

    /// A name may look like a number with a comma; a column of names is not changed.
    void onlyColumnsOfNumbersLoseTheirCommas()
    {
        const ForeignTable foreign = foreignTableFrom("name;x;y\n1,5;1,5;1.5\nwool;2,25;2,5\n", "t.csv");
        QCOMPARE(foreign.table.rows, (Rows{{"1,5", "1.5", "1.5"}, {"wool", "2.25", "2,5"}}));
    }

    /// In a file separated by commas, "1,500" may be a thousand and a half, or one and a half: nobody can tell.
    void quotedCommasAreLeftAlone()
    {
        QCOMPARE(foreignTableFrom("x,y\n\"1,500\",2\n", "t.csv").table.rows, (Rows{{"1,500", "2"}}));
    }

    void aNamedEncodingWins()
    {
        QCOMPARE(foreignTableFrom("x\n\xE4\xE5\n", "t.csv", "ISO-8859-1").table.rows[0][0], std::string("\u00E4\u00E5"));
    }

    /// These encodings hold a letter back until the next one. Before, the last letter of a file without a last line end was lost.
    void theLastLetterIsKeptWithoutALineEnd()
    {
        for (const char* encoding : {"CP1258", "TCVN"})
            QCOMPARE(foreignTableFrom("x\nwa", "t.csv", encoding).table.rows, (Rows{{"wa"}}));
        QCOMPARE(foreignTableFrom("x\n\xF9", "t.csv", "CP1255").table.rows, (Rows{{"\u05E9"}}));
    }

    void faultsSayWhatToDo_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("encoding");
        QTest::addColumn<QString>("said");
        QTest::newRow("zero byte") << QByteArray("x\n1\n\0 2\n", 8) << ""
                                   << "2: t.csv, line 3: the text holds a zero byte; expected text without zero bytes";
        QTest::newRow("undefined byte") << QByteArray("x\n\x81 \n") << ""
                                        << "byte 3 has no meaning in Windows-1252";
        QTest::newRow("unknown encoding") << QByteArray("x\n") << "klingon"
                                          << "the encoding \"klingon\" is unknown here";
        QTest::newRow("half a character of UTF-16") << QByteArray("\xFF\xFEx", 3) << ""
                                                    << "has no meaning in UTF-16";
    }
    void faultsSayWhatToDo()
    {
        QFETCH(const QByteArray, bytes);
        QFETCH(const QString, encoding);
        QFETCH(const QString, said);
        const QString error = errorOf([&] { foreignTableFrom(bytes.toStdString(), "t.csv", encoding.toStdString()); });
        QVERIFY2(error.contains(said), qPrintable(error));
    }

    /// What a spreadsheet would run as a formula is written with an apostrophe, which the reader takes off again.
    void formulasBecomeTextAndComeBack_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("cell");
        QTest::newRow("formula") << "=cmd|' /C calc'!A0"
                                 << "'=cmd|' /C calc'!A0";
        QTest::newRow("function") << "@SUM(1)"
                                  << "'@SUM(1)";
        QTest::newRow("plus") << "+x"
                              << "'+x";
        QTest::newRow("an apostrophe of the text's own") << "'tis"
                                                         << "''tis";
        QTest::newRow("negative number") << "-5.5"
                                         << "-5.5";
        QTest::newRow("signed number") << "+5"
                                       << "+5";
        QTest::newRow("the mark of no value") << "-"
                                              << "-";
        QTest::newRow("words") << "soft - warm"
                               << "soft - warm";
    }
    void formulasBecomeTextAndComeBack()
    {
        QFETCH(const QString, text);
        QFETCH(const QString, cell);
        QCOMPARE(QString::fromStdString(safeCell(text.toStdString())), cell);
        const ForeignTable foreign = foreignTableFrom("x\n" + csvCell(cell.toStdString()) + "\n", "t.csv");
        QCOMPARE(QString::fromStdString(foreign.table.rows[0][0]), text);
    }
};

QTEST_GUILESS_MAIN(ForeignTableTest)
#include "foreign_table_test.moc"
