// One table in its four formats, and the cells of each kind.
#include "reports/formats/table_formats.h"

#include <QTest>

#include "reports/formats/table_cells.h"
#include "reports/formats/table_parts.h"
#include "reports/formats/tex_table.h"
#include "reports/text/tex_text.h"

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

/// One condition with this number of values of four or five characters.
Table tableOfNumbers(int columns)
{
    Table wide{"wide", "Wide", {"condition"}, {{conditionCell("f")}}};
    for (int i = 0; i < columns; ++i) {
        wide.columns.emplace_back("m" + std::to_string(i));
        wide.rows[0].push_back(numberCell(1.5 * i, 2));
    }
    return wide;
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
        QCOMPARE(toTex(example()),
                 std::string(
                     "% needs \\usepackage[T1]{fontenc} and \\usepackage{array,booktabs}\n\\begin{table*}\n\\centering\n\\small\n"
                     "\\setlength{\\tabcolsep}{3pt}\n\\caption{Means \\& more}\n\\label{tab:example}\n"
                     "\\begin{tabular}{@{}lrrrr@{}}\n\\toprule\ncondition & \\shortstack[r]{mean $\\pm$\\\\SD} & 95 \\% CI & p & "
                     "n \\\\\n\\midrule\n"
                     "$h_{\\mathrm{g}}$\\,\\&\\,$f_{\\mathrm{g}}$ & $-1.2$ $\\pm$ 0.5 & $[-1.75, 0.06]$ & $<$ .001 & 7 \\\\\n"
                     "$f$ & -- & -- & -- & 0 \\\\\n\\bottomrule\n\\end{tabular}\n\\par\\smallskip\\parbox{0.96\\textwidth}"
                     "{\\raggedright \\emph{Note.} --: no value (no ratings; no variatio\\hspace{0pt}n; one value).}\n"
                     "\\end{table*}\n"));
        const Table blank{"b", "", {"a", "b"}, {{textCell(""), textCell("x")}}};
        QVERIFY(toTex(blank).find("\n & x \\\\\n") != std::string::npos);
    }

    /// Too many columns come in parts, each with the names; many rows go on over pages.
    void wideAndLongTablesAreLongTables()
    {
        const QString tex = QString::fromStdString(toTex(tableOfNumbers(20)));
        QCOMPARE(tex.count("\\begin{longtable}"), 2);
        QCOMPARE(tex.count("\\label{tab:wide}"), 1);
        QCOMPARE(tex.count("\n$f$ & "), 2);
        QVERIFY(tex.contains("\\caption{Wide (part 1 of 2)}") && tex.contains("\\caption{Wide (part 2 of 2)}"));
        QVERIFY(tex.contains("$28.50$"));
        Table tall{"tall", "", {"n"}, std::vector(31, std::vector{countCell(1)})};
        QVERIFY(toTex(tall).find("\\begin{longtable}") != std::string::npos);
    }

    /// Narrow columns stay beside each other as long as they fit: only more than 14 of them, or wide ones, are cut.
    void tablesThatFitAreNotCut()
    {
        QCOMPARE(tableParts(tableOfNumbers(10), {.widthPt = texTextWidth}).size(), std::size_t(1));
        QCOMPARE(tableParts(tableOfNumbers(13), {.widthPt = 470}).size(), std::size_t(1));
        QCOMPARE(tableParts(tableOfNumbers(14), {.widthPt = 2000}).size(), std::size_t(2));
        const auto cut = tableParts(tableOfNumbers(10), {.widthPt = 170});
        QCOMPARE(cut.size(), std::size_t(2));
        QCOMPARE(cut[1].columns[0].index, std::size_t(0));
        // Type of one size only, as in a text document.
        const auto large = tableParts(tableOfNumbers(10), {.widthPt = texTextWidth, .scales = {1.2}});
        QCOMPARE(large.size(), std::size_t(2));
        QCOMPARE(large[0].scale, 1.2);
        QCOMPARE(partWords(1, 1), std::string());
        QCOMPARE(partWords(2, 3), std::string(" (part 2 of 3)"));
    }

    /// pdfLaTeX stops at characters that it does not know, and at commands in names.
    void everyTextIsSafeInLatex()
    {
        QCOMPARE(escapedTex("\u03C7\u00B2 \u2212 \u00D7 \u2013 \u00E9"), std::string("$\\chi$$^2$ $-$ $\\times$ -- \u00E9"));
        QCOMPARE(escapedTex("\\input{x} \u7EC7"), std::string("\\textbackslash{}input\\{x\\} U+7EC7"));
        QCOMPARE(breakableTex("abcdefghij"), std::string("abcdefgh\\hspace{0pt}ij"));
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
