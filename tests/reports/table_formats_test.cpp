// One table in its four formats, and the cells of each kind.
#include "reports/formats/table_formats.h"

#include <QtTest>

#include "reports/formats/table_cells.h"

using namespace reports;

namespace {

/// The column sd is in the CSV only, the column 95 % CI in documents only.
Table example()
{
    return {"example",
            "Means & more",
            {"condition", "mean \u00B1 SD", {"sd", ColumnUse::InCsv}, {"95 % CI", ColumnUse::InDocuments}, "p", "n"},
            {{conditionCell("h_g&f_g"), meanSdCell(-1.25, 0.5, 1), numberCell(0.5, 1), intervalCell({-1.75, 0.0625}, 2),
              pCell(0.0004), countCell(7)},
             {conditionCell("f"), meanSdCell(stats::Value::undefined("no ratings"), 0.5, 1),
              numberCell(stats::Value::undefined("no ratings"), 1), intervalCell({stats::Value::undefined("one value"), 1.0}, 2),
              pCell(stats::Value::undefined("no variation")), countCell(0)}}};
}

}  // namespace

class TableFormatsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void csvHasFullDigitsAndItsOwnColumns()
    {
        QCOMPARE(toCsv(example()), std::string("condition,mean \u00B1 SD,sd,p,n\r\n"
                                               "h_g&f_g,-1.25,0.5,4e-04,7\r\n"
                                               "f,,,,0\r\n"));
        const Table words{"w", "", {"words"}, {{textCell("soft, \"warm\"\nwool")}}};
        QCOMPARE(toCsv(words), std::string("words\r\n\"soft, \"\"warm\"\"\nwool\"\r\n"));
    }

    void terminalTextIsAligned()
    {
        QCOMPARE(toText(example()), std::string("condition   mean \u00B1 SD        95 % CI       p  n\n"
                                                "-----------------------------------------------\n"
                                                "h_g&f_g    -1.2 \u00B1 0.5  [-1.75, 0.06]  < .001  7\n"
                                                "f                   -              -       -  0\n"));
    }

    void latexIsABooktabsTable()
    {
        QCOMPARE(
            toTex(example()),
            std::string("% needs \\usepackage{booktabs}\n\\begin{table}\n\\centering\n\\caption{Means \\& more}\n"
                        "\\begin{tabular}{lrrrr}\n\\toprule\ncondition & mean \u00B1 SD & 95 \\% CI & p & n \\\\\n\\midrule\n"
                        "$h_{\\mathrm{g}}$\\,\\&\\,$f_{\\mathrm{g}}$ & $-1.2$ $\\pm$ 0.5 & $[-1.75, 0.06]$ & $<$ .001 & 7 \\\\\n"
                        "$f$ & -- & -- & -- & 0 \\\\\n\\bottomrule\n\\end{tabular}\n\\end{table}\n"));
        const Table blank{"b", "", {"a", "b"}, {{textCell(""), textCell("x")}}};
        QVERIFY(toTex(blank).find("\n & x \\\\\n") != std::string::npos);
    }

    void htmlShowsReasonsAsTooltips()
    {
        const std::string html = toHtml(example());
        QVERIFY(html.find("<caption>Means &amp; more</caption>") != std::string::npos);
        QVERIFY(html.find("<th scope=\"col\" class=\"n\">95 % CI</th>") != std::string::npos);
        QVERIFY(html.find("<td class=\"n\">\u22121.2 <span class=\"sd\">\u00B1 0.5</span></td>") != std::string::npos);
        QVERIFY(html.find("<td class=\"n\">[\u22121.75, 0.06]</td><td class=\"n\">&lt; .001</td>") != std::string::npos);
        QVERIFY(html.find("<td class=\"n\" title=\"no variation\">\u2013</td>") != std::string::npos);
        QVERIFY(html.find(">sd<") == std::string::npos);
    }

    void numbersThatAreNotFiniteAreNotPrinted()
    {
        QCOMPARE(numberCell(std::numeric_limits<double>::infinity(), 2).why, std::string("unbounded"));
        QCOMPARE(pCell(0.0, -1000.0).csv, std::string());
        QCOMPARE(pCell(0.25, -1.4).csv, std::string("0.25"));
        QCOMPARE(meanSdCell(4.0, stats::Value::undefined("one rating"), 1).text, std::string("4.0 \u00B1 -"));
    }

    void aQuestionMayBeCalledCondition()
    {
        QCOMPARE(questionColumn("Q2"), std::string("Q2"));
        QCOMPARE(questionColumn("Condition"), std::string("question Condition"));
    }
};

QTEST_GUILESS_MAIN(TableFormatsTest)
#include "table_formats_test.moc"
