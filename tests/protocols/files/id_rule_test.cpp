// One rule decides which ids may come in from outside.
#include "protocols/files/id_rule.h"

#include <QTest>

#include "protocols/files/errors.h"

using namespace protocols;

class IdRuleTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void idsOfLabsAreGood_data()
    {
        QTest::addColumn<QByteArray>("id");
        for (const char* id : {"P01",
                               "P 01",
                               "p-01",
                               "S_1.a",
                               "quality",
                               "all",
                               "7",
                               "\u53C2\u52A0\u8005 1",
                               "Bj\u00F6rn",
                               "\u0645\u06CC\u200C\u062E",
                               "\u0915\u094D\u200D\u0937",
                               "O'Brien",
                               "50 %",
                               "=1+1",
                               "a:b",
                               "\"x\"",
                               "<b>",
                               "\U0001F600",
                               "\u2764\uFE0F",
                               "\u845B\U000E0100"})
            QTest::newRow(id) << QByteArray(id);
        QTest::newRow("64 bytes") << QByteArray(64, 'x');
    }
    void idsOfLabsAreGood()
    {
        QFETCH(const QByteArray, id);
        QCOMPARE(QString::fromStdString(faultOfId(id.toStdString())), QString());
        requireGoodId(id.toStdString(), "a participant", "here");
    }

    void linesOfWords_data()
    {
        QTest::addColumn<QByteArray>("line");
        QTest::addColumn<QString>("fault");
        QTest::newRow("name") << QByteArray("Dr. Ada M\u00FCller, Ph.D. / lab 3") << "";
        QTest::newRow("Persian") << QByteArray("\u0645\u06CC\u200C\u062E") << "";
        QTest::newRow("keycap and joiner") << QByteArray("1\uFE0F\u20E3 Auf\u200Clage") << "";
        QTest::newRow("200 bytes") << QByteArray(200, 'x') << "";
        QTest::newRow("201 bytes") << QByteArray(201, 'x') << "has 201 bytes";
        QTest::newRow("nothing") << QByteArray() << "is empty";
        QTest::newRow("blanks") << QByteArray(" \u3000 ") << "is empty";
        QTest::newRow("line end") << QByteArray("a\nb") << "holds a control character";
        QTest::newRow("escape") << QByteArray("a\x1b[2J") << "holds a control character";
        QTest::newRow("right to left") << QByteArray("a\u202Eb") << "holds an invisible character";
        QTest::newRow("Latin-1") << QByteArray("Bj\xF6rn") << "is not UTF-8";
    }
    void linesOfWords()
    {
        QFETCH(const QByteArray, line);
        QFETCH(const QString, fault);
        QCOMPARE(QString::fromStdString(faultOfLine(line.toStdString(), longestName)), fault);
    }

    void badIdsAreRefusedWithTheReason_data()
    {
        QTest::addColumn<QByteArray>("id");
        QTest::addColumn<QString>("reason");
        QTest::newRow("nothing") << QByteArray() << "is empty";
        QTest::newRow("65 bytes") << QByteArray(65, 'x') << "has 65 bytes";
        QTest::newRow("22 Japanese letters") << QByteArray("\u53C2").repeated(22) << "has 66 bytes";
        QTest::newRow("Latin-1") << QByteArray("Bj\xF6rn") << "is not UTF-8";
        QTest::newRow("overlong slash") << QByteArray("a\xC0\xAF") << "is not UTF-8";
        QTest::newRow("surrogate") << QByteArray("a\xED\xA0\x80") << "is not UTF-8";
        QTest::newRow("parent") << QByteArray("../victim") << "begins with a dot";
        QTest::newRow("hidden") << QByteArray(".x") << "begins with a dot";
        QTest::newRow("option") << QByteArray("--json") << "begins with a dash";
        QTest::newRow("path") << QByteArray("/etc/passwd") << "holds a slash or backslash";
        QTest::newRow("path of Windows") << QByteArray("a\\b") << "holds a slash or backslash";
        QTest::newRow("list") << QByteArray("a,b") << "holds a comma";
        QTest::newRow("zero byte") << QByteArray("a\0b", 3) << "holds a control character";
        QTest::newRow("line end") << QByteArray("a\nb") << "holds a control character";
        QTest::newRow("escape") << QByteArray("a\x1b[31m") << "holds a control character";
        QTest::newRow("delete") << QByteArray("a\x7f") << "holds a control character";
        QTest::newRow("C1") << QByteArray("a\u009B") << "holds a control character";
        QTest::newRow("right to left") << QByteArray("a\u202Eb") << "holds an invisible character";
        QTest::newRow("isolate") << QByteArray("a\u2067b") << "holds an invisible character";
        QTest::newRow("mark") << QByteArray("a\u200Eb") << "holds an invisible character";
        QTest::newRow("zero width") << QByteArray("P\u200B01") << "holds an invisible character";
        QTest::newRow("byte order mark") << QByteArray("\uFEFFP01") << "holds an invisible character";
        QTest::newRow("tag") << QByteArray("P01\U000E0041") << "holds an invisible character";
        QTest::newRow("filler of Hangul") << QByteArray("P01\u3164") << "holds an invisible character";
        QTest::newRow("joiner of letters that do not join") << QByteArray("P\u200D01") << "holds an invisible character";
        QTest::newRow("form of a digit") << QByteArray("P01\uFE0F") << "holds an invisible character";
        QTest::newRow("blank before") << QByteArray(" P01") << "begins with a blank";
        QTest::newRow("blank behind") << QByteArray("P01 ") << "ends with a blank";
        QTest::newRow("wide blank behind") << QByteArray("P01\u3000") << "ends with a blank";
        QTest::newRow("blank only") << QByteArray(" ") << "begins with a blank";
    }
    void badIdsAreRefusedWithTheReason()
    {
        QFETCH(const QByteArray, id);
        QFETCH(const QString, reason);
        QCOMPARE(QString::fromStdString(faultOfId(id.toStdString())), reason);
        try {
            requireGoodId(id.toStdString(), "a participant", "s.json, line 3");
            QFAIL("a bad id was accepted");
        } catch (const Error& error) {
            const QString said(error.what());
            QCOMPARE(error.exitCode(), ExitCode::BadInput);
            QVERIFY2(said.startsWith("s.json, line 3: "), error.what());
            QVERIFY2(said.contains(" cannot name a participant: it " + reason + "; expected 1 to 64 bytes"), error.what());
            QVERIFY2(said.endsWith("choose another id"), error.what());
        }
    }

    /// R and pandas read these words as missing values. Ids of earlier versions may be such a word.
    void wordsForMissingValuesAreNoNewIds()
    {
        for (const std::string id : {"NA", "na", "NaN", "nan", "null", "NULL", "None", "none", "nONE"}) {
            QCOMPARE(QString::fromStdString(faultOfId(id)), QString());
            QCOMPARE(QString::fromStdString(faultOfNewId(id)), QString("stands for a missing value in tables"));
            try {
                requireGoodNewId(id, "a participant", "study");
                QFAIL(id.c_str());
            } catch (const Error& error) {
                const QString what(error.what());
                QVERIFY2(what.startsWith("study: \"" + QString::fromStdString(id) +
                                         "\" cannot name a participant: it stands for "
                                         "a missing value in tables; expected another id than NA"),
                         error.what());
            }
        }
        for (const std::string id : {"NA1", "N", "nullo", "Nina", "\u0274a"})
            QCOMPARE(QString::fromStdString(faultOfNewId(id)), QString());
        QCOMPARE(QString::fromStdString(faultOfNewId("../NA")), QString("begins with a dot"));
        requireGoodNewId("P01", "a participant", "study");
    }
};

QTEST_GUILESS_MAIN(IdRuleTest)
#include "id_rule_test.moc"
