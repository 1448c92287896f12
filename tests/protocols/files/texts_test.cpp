// Numbers and markup as text.
#include <QTest>
#include <array>
#include <clocale>
#include <cmath>
#include <limits>
#include <vector>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "protocols/files/svg_drawing.h"
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

    void nobodyReadsHundredsOfDigits()
    {
        QCOMPARE(fixed(-0.004, 2), std::string("0.00"));
        QCOMPARE(fixed(123456789.125, 2), std::string("123456789.12"));
        QCOMPARE(fixed(-1.3243e276, 2), std::string("-1.32e+276"));
        QCOMPARE(fixed(1e12, 0), std::string("1.00e+12"));
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

    /// Every drawing takes its ticks from here, so a step that rounding swallows must end the list, not repeat it for ever.
    void ticksOfAnyAxisEnd()
    {
        QCOMPARE(multiplesBetween(-0.25, 1, 0.25), (std::vector<double>{-0.25, 0, 0.25, 0.5, 0.75, 1}));
        QCOMPARE(multiplesBetween(0.1, 0.3, 0.1).size(), std::size_t(3));  // 3 · 0.1 is above 0.3 by rounding
        QVERIFY(!std::signbit(multiplesBetween(-0.5, 0.5, 1).front()));
        constexpr double infinite = std::numeric_limits<double>::infinity(), tiny = std::numeric_limits<double>::denorm_min();
        QVERIFY(multiplesBetween(1, 1e6, 1e-3).size() == std::size_t(mostTicks));
        const std::vector<std::array<double, 3>> without{{0.3, std::nextafter(0.3, 1), 1e-17},
                                                         {1e17, 1e17 + 16, 2},
                                                         {0, 1, 0},
                                                         {0, 1, -1},
                                                         {0, infinite, 1},
                                                         {-infinite, infinite, infinite},
                                                         {0, 1, std::nan("")},
                                                         {std::nan(""), 1, 1},
                                                         {0, 1, tiny},
                                                         {2, 1, 0.1}};
        for (const auto& [low, high, step] : without) QVERIFY(multiplesBetween(low, high, step).empty());
    }

    void markupIsEscaped()
    {
        QCOMPARE(escapedMarkup("a <b> & \"c\" 'd'"), std::string("a &lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;"));
        QCOMPARE(escapedMarkup("Größe\n\t"), std::string("Größe\n\t"));
        QCOMPARE(escapedMarkup(std::string_view("a\0b\x1b", 4)), std::string("ab"));
        // What XML does not have, and what turns the numbers behind it around.
        QCOMPARE(escapedMarkup("a\uFFFE\u202Eb\uFFFF\u2067c\u2069 \u2013 \uFF21"), std::string("abc \u2013 \uFF21"));
        // Bytes that are no character, among them a mark of direction that would come together without its control character.
        QCOMPARE(escapedMarkup("a\xC3(\xE2\x80\x01\xAE"), std::string("a\uFFFD(\uFFFD\uFFFD\uFFFD"));
    }
};

QTEST_GUILESS_MAIN(TextsTest)
#include "texts_test.moc"
