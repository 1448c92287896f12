// Numbers, words, escapes, labels and file names in the form of the report.
#include <QTest>
#include <limits>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "reports/text/condition_label.h"
#include "reports/text/file_names.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"
#include "reports/text/tex_text.h"

using namespace reports;

class ReportTextTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void numbersHaveTheDigitsAskedFor()
    {
        QCOMPARE(fixed(3.857142857142857, 1), std::string("3.9"));
        QCOMPARE(fixed(0.125, 2), std::string("0.12"));  // ties go to the even digit, as printf rounds
        QCOMPARE(fixed(-0.004, 2), std::string("0.00"));
        QCOMPARE(fixed(-0.006, 2), std::string("-0.01"));
        QCOMPARE(fixed(7, 0), std::string("7"));
        QCOMPARE(protocols::shortest(0.1), std::string("0.1"));
        QCOMPARE(protocols::shortest(3.857142857142857), std::string("3.857142857142857"));
        QCOMPARE(protocols::shortest(5), std::string("5"));
        QCOMPARE(typeset("-0.25"), std::string("\u22120.25"));
        QCOMPARE(typeset("0.25"), std::string("0.25"));
        QCOMPARE(percentText(1, 12), std::string("8 %"));
        QCOMPARE(percentText(2, 3), std::string("67 %"));
    }

    void probabilitiesAreWrittenAsInPapers_data()
    {
        QTest::addColumn<double>("p");
        QTest::addColumn<QString>("text");
        QTest::newRow("far below") << 1e-12 << "< .001";
        QTest::newRow("just below") << 0.00099999 << "< .001";
        QTest::newRow("limit") << 0.001 << ".001";
        QTest::newRow("rounded") << 0.04951 << ".050";
        QTest::newRow("ordinary") << 0.0324 << ".032";
        QTest::newRow("large") << 0.9994 << ".999";
        QTest::newRow("nearly one") << 0.9996 << "1.00";
        QTest::newRow("one") << 1.0 << "1.00";
    }
    void probabilitiesAreWrittenAsInPapers()
    {
        QFETCH(double, p);
        QFETCH(QString, text);
        QCOMPARE(QString::fromStdString(pText(p)), text);
    }

    void aPTooSmallForADoubleHasItsPowerOfTen()
    {
        // exp(-1000) = 10^-434.29
        const stats::Value p = writableP(0.0, -1000.0);
        QVERIFY(!p.exists());
        QCOMPARE(p.why(), std::string("below the smallest double; log10 p = -434.29"));
        QCOMPARE(*writableP(1e-300, -690.0), 1e-300);
        QCOMPARE(*writableP(0.0, stats::Value::undefined("no logarithm")), 0.0);
        QCOMPARE(writableP(0.0).why(), std::string("below the smallest double"));
        QCOMPARE(*writableP(1e-300), 1e-300);
        QCOMPARE(writableP(stats::Value::undefined("no test")).why(), std::string("no test"));
    }

    void wordsAgreeWithTheirNumber()
    {
        QCOMPARE(counted(0, "participant"), std::string("0 participants"));
        QCOMPARE(counted(1, "participant"), std::string("1 participant"));
        QCOMPARE(counted(2, "participant"), std::string("2 participants"));
        QCOMPARE(listed({}), std::string());
        QCOMPARE(listed({"a"}), std::string("a"));
        QCOMPARE(listed({"a", "b"}), std::string("a and b"));
        QCOMPARE(listed({"a", "b", "c"}), std::string("a, b and c"));
        QCOMPARE(lowerCase("Q1_Real"), std::string("q1_real"));
    }

    void textOfAnyOriginIsSafe()
    {
        QCOMPARE(protocols::escapedMarkup("<b a=\"x\" c='y'> & </b>"),
                 std::string("&lt;b a=&quot;x&quot; c=&#39;y&#39;&gt; &amp; &lt;/b&gt;"));
        QCOMPARE(
            escapedTex("50 % of $x_1$ & #2 {a} ~ ^ \\ < > [b]*\nc"),
            std::string("50 \\% of \\$x\\_1\\$ \\& \\#2 \\{a\\} \\textasciitilde{} \\textasciicircum{} \\textbackslash{} $<$ $>$ "
                        "{[}b]{*} c"));
    }

    void filesOfOneFolderHaveDifferentNames()
    {
        FileNames names;
        QCOMPARE(names.unique("comparisons_planned"), std::string("comparisons_planned"));
        QCOMPARE(names.unique("Comparisons_Planned"), std::string("Comparisons_Planned-2"));
        QCOMPARE(names.unique("comparisons_planned"), std::string("comparisons_planned-3"));
        QCOMPARE(names.unique("soft/hard .. \u00e9"), std::string("soft_hard______"));
    }

    void conditionsAreSetAsInThePaper()
    {
        QCOMPARE(texLabel("h_g&f_g"), std::string("$h_{\\mathrm{g}}$\\,\\&\\,$f_{\\mathrm{g}}$"));
        QCOMPARE(htmlLabel("v_grey"), std::string("<span class=\"cond\"><i>v</i><sub>grey</sub></span>"));
        QCOMPARE(htmlLabel("<K1>"), std::string("&lt;K1&gt;"));
        QCOMPARE(svgLabel("f"), std::string("<tspan font-style=\"italic\">f</tspan>"));
        QCOMPARE(svgLabel("a very long name of a condition"), std::string("a very long name of a c\u2026"));
        QCOMPARE(svgTextAfter("h_g", " x"), std::string("<tspan dy=\"-4\"> x</tspan>"));
        QCOMPARE(svgTextAfter("h", " x"), std::string("<tspan> x</tspan>"));
        QCOMPARE(labelLength("h&f"), 3.8);
        QVERIFY(groupOf("h_g") == protocols::ConditionGroup::Generated);
        QVERIFY(!groupOf("K1"));
    }
};

QTEST_GUILESS_MAIN(ReportTextTest)
#include "report_text_test.moc"
