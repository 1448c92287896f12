// Numbers and markup as text.
#include <QTest>
#include <clocale>
#include <cmath>
#include <limits>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/typed_number.h"

using namespace protocols;

class TextsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void shortestTextReadsBackExactly()
    {
        QCOMPARE(shortest(5.4), std::string("5.4"));
        QCOMPARE(shortest(0.1 + 0.2), std::string("0.30000000000000004"));
        QCOMPARE(shortest(-2), std::string("-2"));
        for (const double value : {1.0 / 3, 1e300, std::numeric_limits<double>::denorm_min(), -0.0}) {
            QCOMPARE(*numberIn(shortest(value)), value);
            QCOMPARE(std::signbit(*numberIn(shortest(value))), std::signbit(value));
        }
    }

    void onlyWholeFiniteNumbersAreNumbers()
    {
        QCOMPARE(*numberIn("  +5.4\t"), 5.4);
        QCOMPARE(*numberIn("-1e3"), -1000.0);
        for (const char* text : {"", " ", "5,4", "5.4x", "x5", "nan", "inf", "1e999", "0x10", "++1", "1 2"})
            QVERIFY2(!numberIn(text), text);
    }

    void decimalCommaOfTheUserChangesNothing()
    {
        if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) QSKIP("the locale de_DE is not installed");
        QCOMPARE(*numberIn("5.4"), 5.4);
        QCOMPARE(shortest(5.4), std::string("5.4"));
        std::setlocale(LC_ALL, "C");
    }

    void typedNumbersHaveAPoint()
    {
        for (const char* typed : {"21.5", "21,5", " 21,5 ", "２１．５", "21，5", "２１。５"})
            QCOMPARE(typedNumber(typed), std::string("21.5"));
        QCOMPARE(typedNumber("−3,0"), std::string("-3.0"));
        QCOMPARE(typedNumber("１２"), std::string("12"));
        for (const char* text : {"", "1,2,3", "links, rechts", "5,", ",5", "21,5 °C", "1.000,5", "右手"})
            QCOMPARE(typedNumber(text), std::string(text));
        QCOMPARE(typedNumber("  links "), std::string("links"));
    }

    void markupIsEscaped()
    {
        QCOMPARE(escapedMarkup("a <b> & \"c\" 'd'"), std::string("a &lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;"));
        QCOMPARE(escapedMarkup("Größe\n\t"), std::string("Größe\n\t"));
        QCOMPARE(escapedMarkup(std::string_view("a\0b\x1b", 4)), std::string("ab"));
    }
};

QTEST_GUILESS_MAIN(TextsTest)
#include "texts_test.moc"
