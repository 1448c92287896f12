// One report in all its forms, read back as a reader's programs read them: the page, CSV, LaTeX, JSON, and the text of the PDF
// and of the text document where this machine has the programs that extract it.
#include <QMap>
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>
#include <QTextFormat>
#include <QXmlStreamReader>
#include <nlohmann/json.hpp>
#include <set>

#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/svg_drawing.h"
#include "protocols/files/whole_file.h"
#include "reports/documents/drawing_painter.h"
#include "reports/documents/figure_files.h"
#include "reports/documents/figure_object.h"
#include "reports/documents/report_documents.h"
#include "reports/documents/report_docx.h"
#include "reports/documents/report_tex.h"
#include "reports/figures/report_figures.h"
#include "reports/page/html_parts.h"
#include "reports/page/sentences.h"
#include "reports/tables/report_tables.h"
#include "reports/write_report.h"
#include "tests/reports/study_builder.h"

namespace fs = std::filesystem;

namespace {

QString textOf(const fs::path& file) { return QString::fromStdString(protocols::readWholeFile(file)); }

/// Text without markup; a no-break space counts as a space.
QString plain(QString html)
{
    static const QRegularExpression tag("<[^>]*>");
    html.replace("<br>", " ").remove(tag);
    const std::pair<const char*, const char*> entities[] = {{"&lt;", "<"},         {"&gt;", ">"},          {"&minus;", "\u2212"},
                                                            {"&ndash;", "\u2013"}, {"&quot;", "\""},       {"&#39;", "'"},
                                                            {"&nbsp;", " "},       {"&plusmn;", "\u00B1"}, {"&amp;", "&"}};
    for (const auto& [entity, sign] : entities) html.replace(QString(entity), QString::fromUtf8(sign));
    return html.replace(QChar(0xA0), ' ').simplified();
}

/// Every number of a text in its order, as it is printed; a minus sign becomes a hyphen. Digits inside words are no numbers.
QStringList numbersIn(QString text)
{
    static const QRegularExpression number("(?<![\\w.])-?(?:[0-9]+(?:\\.[0-9]+)?|\\.[0-9]+)(?![\\w])");
    text.replace(QChar(0x2212), '-');
    QStringList numbers;
    for (auto it = number.globalMatch(text); it.hasNext();) numbers << it.next().captured();
    return numbers;
}

/// Cells of one table.
struct ReadTable {
    QStringList columns;
    QList<QStringList> rows;
};

/// The tables of the page by caption.
std::map<QString, ReadTable> tablesOfPage(const QString& page)
{
    static const QRegularExpression table("<table>(.*?)</table>", QRegularExpression::DotMatchesEverythingOption);
    static const QRegularExpression caption("<caption>(.*?)</caption>", QRegularExpression::DotMatchesEverythingOption);
    static const QRegularExpression row("<tr>(.*?)</tr>", QRegularExpression::DotMatchesEverythingOption);
    static const QRegularExpression cell("<t[hd][^>]*>(.*?)</t[hd]>", QRegularExpression::DotMatchesEverythingOption);
    std::map<QString, ReadTable> tables;
    for (auto it = table.globalMatch(page); it.hasNext();) {
        const QString inside = it.next().captured(1);
        ReadTable read;
        for (auto rows = row.globalMatch(inside); rows.hasNext();) {
            QStringList cells;
            for (auto found = cell.globalMatch(rows.next().captured(1)); found.hasNext();)
                cells << plain(found.next().captured(1));
            read.columns.isEmpty() ? read.columns = cells : (read.rows << cells, read.columns);
        }
        tables[plain(caption.match(inside).captured(1))] = read;
    }
    return tables;
}

/// The words and numbers of LaTeX as they are typeset.
QString typesetTex(QString tex)
{
    static const QRegularExpression comment("%[^\n]*(?<!\\\\)\n"), shortstack("\\\\shortstack\\[[lrc]\\]\\{([^}]*)\\}");
    tex.replace("\\%", QChar(0x1)).remove(comment).replace(QChar(0x1), '%');
    for (const char* sign : {"$", "\\,", "\\hspace{0pt}", "\\par"}) tex.remove(sign);
    tex.replace("\\pi^2", "\u03C0\u00B2").replace("\\pm", "\u00B1").replace("--", "\u2013");
    return tex;
}

std::set<double> numbersOf(const nlohmann::json& json)
{
    std::set<double> numbers;
    if (json.is_number()) numbers.insert(json.get<double>());
    if (json.is_structured())
        for (const auto& one : json) numbers.merge(numbersOf(one));
    return numbers;
}

/// Some participants and fabrics whose answers differ by condition, with gaps; names need quoting in every form.
reports::StudyData hostileStudy()
{
    reports::StudyData data = builders::paperSized();
    data.name = "\u05E9\u05DC\u05D5\u05DD \"quoted\" </script> \\input{x} =1+1 " + std::string(500, 'n');
    data.planned = {{"h_g&f_g", "h&f"}, {"h", "f"}};
    int i = 0;
    for (reports::StudyResponse& r : data.responses) r.seconds = 2 + (i++ % 9) * 0.7;
    std::erase_if(data.responses, [&](const reports::StudyResponse&) { return ++i % 41 == 0; });
    return data;
}

}  // namespace

class AllFormsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_data = hostileStudy();
        m_analysis = std::make_unique<reports::StudyAnalysis>(reports::analyse(m_data));
        reports::writeReport(*m_analysis, report(), {}, reports::allDocuments());
        m_page = textOf(report() / "index.html");
        m_tables = tablesOfPage(m_page);
        QVERIFY(m_tables.size() > 20);
    }

    /// The CSV has all digits of what the page rounds.
    void pageAndCsvAgree()
    {
        int compared = 0;
        for (const reports::ReportTable& one : shownTables()) {
            const ReadTable& shown = m_tables.at(plain(QString::fromStdString(one.table.caption).toHtmlEscaped()));
            const auto csv = protocols::readForeignTable(report() / "tables" / (one.table.name + ".csv")).table;
            QCOMPARE(std::size_t(shown.rows.size()), csv.rows.size());
            for (int i = 0; i < shown.rows.size(); ++i)
                for (int j = 0; j < shown.columns.size(); ++j) {
                    const auto column = csv.column(shown.columns[j].toStdString());
                    bool isShown = false, isFull = false;
                    QString text = shown.rows[i].value(j);
                    const double rounded = text.replace(QChar(0x2212), '-').toDouble(&isShown);
                    const double full = column ? QString::fromStdString(csv.rows[std::size_t(i)][*column]).toDouble(&isFull) : 0;
                    if (!isShown || !isFull) continue;
                    const int decimals = text.contains('.') ? int(text.size() - text.indexOf('.') - 1) : 0;
                    QVERIFY2(std::fabs(rounded - full) <= 0.5000001 * std::pow(10.0, -decimals),
                             qPrintable(shown.columns[j] + ": " + text));
                    ++compared;
                }
        }
        QVERIFY2(compared > 700, qPrintable(QString::number(compared)));
    }

    /// Row by row the same numbers in the same order.
    void pageAndLatexAgree()
    {
        int compared = 0;
        for (const reports::ReportTable& one : shownTables()) {
            const QString tex = typesetTex(textOf(report() / "tables" / (one.table.name + ".tex")));
            const ReadTable& shown = m_tables.at(plain(QString::fromStdString(one.table.caption).toHtmlEscaped()));
            if (tex.contains("(part 2 of")) continue;  // the next test reads the parts
            QList<QStringList> rows;
            for (const QString& line : tex.split('\n'))
                if (line.endsWith("\\\\") && line.contains(" & ")) rows << line.chopped(2).split(" & ");
            rows = rows.mid(rows.size() - shown.rows.size());
            QCOMPARE(rows.size(), shown.rows.size());
            for (int i = 0; i < rows.size(); ++i) {
                QCOMPARE(rows[i].size(), shown.rows[i].size());
                for (int j = 0; j < rows[i].size(); ++j) {
                    QVERIFY2(numbersIn(rows[i][j]) == numbersIn(shown.rows[i][j]),
                             qPrintable(QString::fromStdString(one.table.name) + ": " + rows[i][j] + " and " + shown.rows[i][j]));
                    ++compared;
                }
            }
        }
        QVERIFY2(compared > 500, qPrintable(QString::number(compared)));
    }

    void wideTablesKeepTheirNumbersInLatex()
    {
        int compared = 0;
        for (const reports::ReportTable& one : shownTables()) {
            const QString tex = typesetTex(textOf(report() / "tables" / (one.table.name + ".tex")));
            QStringList found = numbersIn(tex);
            for (const QStringList& row : m_tables.at(plain(QString::fromStdString(one.table.caption).toHtmlEscaped())).rows)
                for (const QString& cell : row)
                    for (const QString& number : numbersIn(cell)) {
                        QVERIFY2(found.removeOne(number), qPrintable(QString::fromStdString(one.table.name) + ": " + number));
                        ++compared;
                    }
        }
        QVERIFY(compared > 2000);
    }

    /// Numbers with more than four digits come from the analysis, and stand in one of the two JSON files with the same bits.
    void csvAndJsonAgree()
    {
        std::set<double> known = numbersOf(nlohmann::json::parse(protocols::readWholeFile(report() / "results.json")));
        known.merge(numbersOf(nlohmann::json::parse(protocols::readWholeFile(report() / "statistics.json"))));
        QStringList strange;
        int compared = 0;
        for (const char* name :
             {"q1_matches", "q2_ratings", "comparisons_q2", "claims_q1", "claims_q2", "claims_q3", "equivalence_q2"}) {
            const fs::path file = report() / "tables" / (std::string(name) + ".csv");
            QVERIFY2(fs::exists(file), name);
            const auto table = protocols::readForeignTable(file).table;
            for (const auto& row : table.rows)
                for (std::size_t j = 0; j < row.size(); ++j) {
                    bool isNumber = false;
                    const QString text = QString::fromStdString(row[j]);
                    const double value = text.toDouble(&isNumber);
                    if (!isNumber || text.size() < 8) continue;
                    ++compared;
                    if (!known.contains(value))
                        strange << QString(name) + " " + QString::fromStdString(table.columns[j]) + " " + text;
                }
        }
        QCOMPARE(strange, QStringList());
        QVERIFY2(compared > 400, qPrintable(QString::number(compared)));
    }

    void pdfHasTheNumbersOfThePage()
    {
        if (QStandardPaths::findExecutable("pdftotext").isEmpty()) QSKIP("pdftotext is not installed (package poppler-utils)");
        QProcess reader;
        reader.start("pdftotext", {"-layout", QString::fromStdString((report() / "report.pdf").string()), "-"});
        QVERIFY(reader.waitForFinished(60000));
        const QString text = QString::fromUtf8(reader.readAllStandardOutput());
        comparedWithPage(text);
        // A column that is narrower than its words breaks them: "conditio" and "n", "change" and "s".
        static const QRegularExpression broken("\\b(conditio|chanc|equivalen|independen|change(?=\\s*\\n\\s*s\\b))\\b");
        const auto found = broken.match(text);
        QVERIFY2(!found.hasMatch(), qPrintable(text.mid(found.capturedStart() - 200, 400)));
    }

    void textDocumentHasTheNumbersOfThePage()
    {
        if (!reports::hasPandoc()) QSKIP("pandoc is not installed");
        QProcess reader;
        reader.start("pandoc", {"--from=docx", "--to=plain", "--columns=1000",
                                QString::fromStdString((report() / "report.docx").string())});
        QVERIFY(reader.waitForFinished(60000));
        comparedWithPage(QString::fromUtf8(reader.readAllStandardOutput()));
    }

    /// t, df, p, effect and interval of each planned contrast are those of its table.
    void sentencesCarryTheNumbersOfTheTables()
    {
        const auto sentences = reports::paperSentences(*m_analysis);
        QCOMPARE(sentences.size(), std::size_t(4));
        int compared = 0;
        for (const reports::QuestionSentences& one : sentences) {
            const auto claims =
                protocols::readForeignTable(report() / "tables" /
                                            ("claims_" + QString::fromStdString(one.question).toLower().toStdString() + ".csv"))
                    .table;
            QCOMPARE(one.contrasts.size(), std::size_t(2));
            for (std::size_t i = 0; i < one.contrasts.size(); ++i) {
                const QString sentence = plain(QString::fromStdString(one.contrasts[i])).replace(QChar(0x2212), '-');
                for (const std::size_t row : {2 * i, 2 * i + 1}) {
                    const auto number = [&](const char* column) {
                        return protocols::numberAt(claims, row, *claims.column(column));
                    };
                    const QString interval =
                        QString("95% CI [%1, %2]").arg(number("95 % CI low"), 0, 'f', 2).arg(number("95 % CI high"), 0, 'f', 2);
                    QVERIFY2(sentence.contains(interval), qPrintable(interval + " in " + sentence));
                    QVERIFY(sentence.contains(QString("Mdiff = %1").arg(number("difference a\u2212b"), 0, 'f', 2)));
                    ++compared;
                }
                QVERIFY(sentence.contains("dz = ") && sentence.contains("t(") && sentence.contains("p"));
            }
        }
        QCOMPARE(compared, 16);
        QVERIFY(m_page.contains("Sentences for a paper"));
    }

    /// "10 participants; 63 renderings", as the other documents have it.
    void tilesStandInOneLineOfTheLatex()
    {
        const std::string tiles = reports::tiles({{"7", "participants"}, {"63", "renderings"}, {"5 %", "of the <mean>"}});
        QCOMPARE(QString::fromStdString(reports::texOfHtml("<p>before</p>" + tiles + "<p>behind</p>")).simplified(),
                 QString("before \\textbf{7} participants; \\textbf{63} renderings; \\textbf{5 \\%} of the $<$mean$>$ behind"));
        const std::string people = std::to_string(m_data.participants.size());
        QVERIFY(textOf(report() / "report.tex").contains(QString::fromStdString("\\textbf{" + people + "} participants; ")));
    }

    /// Letters of a narrow drawing are as large as those of a wide one.
    void narrowDrawingsDoNotFillTheText()
    {
        const auto drawing = [](double width) { return protocols::SvgDrawing(width, 300, "", "").finished(); };
        QCOMPARE(reports::shareOfTextWidth(drawing(450)), 0.5);
        QCOMPARE(reports::shareOfTextWidth(drawing(960)), 1.0);
        QCOMPARE(reports::shareOfTextWidth("no drawing"), 1.0);
        std::vector<reports::Figure> figures(1);
        figures[0] = {.name = "half", .caption = "Half", .svg = drawing(450), .section = reports::PageSection::Signals};
        const reports::ReportDocument document = reports::reportDocument(*m_analysis, {}, figures);
        QVERIFY(reports::plainHtml(document).find("width=\"80mm\"") != std::string::npos);
        QVERIFY(reports::reportTex(document).find("\\includegraphics[width=0.50\\textwidth]{figures/half.pdf}") !=
                std::string::npos);
        reports::FigureObject object(1800, 10000);
        QTextCharFormat format;
        format.setProperty(reports::FigureObject::numberProperty, object.add(figures[0]));
        QCOMPARE(object.intrinsicSize(nullptr, 0, format), QSizeF(900, 600));
    }

    /// Letters of 5 points or more in print, at both widths.
    void figuresCanBeReadAtBothWidths()
    {
        static const QRegularExpression size("font-size=\"([0-9.]+)\""), width("<svg[^>]* width=\"([0-9.]+)\"");
        const auto smallest = [&](const std::string& svg, double mm) {
            const QString text = QString::fromStdString(svg);
            const double px = width.match(text).captured(1).toDouble();
            double least = 1e9;
            for (auto it = size.globalMatch(text); it.hasNext();) least = std::min(least, it.next().captured(1).toDouble());
            return least * mm / px * 72 / 25.4;
        };
        const auto figures = reports::reportFigures(*m_analysis);
        QVERIFY(figures.size() > 12);
        for (const reports::Figure& figure : figures) {
            QVERIFY2(smallest(figure.svg, reports::twoColumnsMm) >= 5, figure.name.c_str());
            QVERIFY2(smallest(figure.narrowSvg, reports::oneColumnMm) >= 5,
                     qPrintable(QString::fromStdString(figure.name) +
                                QString::number(smallest(figure.narrowSvg, reports::oneColumnMm))));
            QXmlStreamReader xml(QString::fromStdString(figure.narrowSvg));
            while (!xml.atEnd()) xml.readNext();
            QVERIFY2(!xml.hasError(), figure.name.c_str());
            for (const fs::path& folder : {report() / "figures", report() / "figures" / reports::oneColumnFolder})
                for (const char* ending : {".svg", ".pdf"}) QVERIFY(fs::exists(folder / (figure.name + ending)));
        }
    }

private:
    fs::path report() const { return fs::path(m_folder.path().toStdString()) / "report"; }

    /// The tables of the page; their captions differ.
    std::vector<reports::ReportTable> shownTables() const
    {
        std::vector<reports::ReportTable> shown;
        for (reports::ReportTable& one : reports::reportTables(*m_analysis))
            if (one.onPage) shown.push_back(std::move(one));
        return shown;
    }

    /// Every number of every table stands in the text, as often as on the page.
    void comparedWithPage(const QString& text)
    {
        QMap<QString, int> found;
        for (const QString& number : numbersIn(text)) ++found[number];
        QStringList missing;
        int compared = 0;
        for (const auto& [caption, table] : m_tables)
            for (const QStringList& row : table.rows)
                for (const QString& cell : row)
                    for (const QString& number : numbersIn(cell)) {
                        ++compared;
                        if (--found[number] < 0) missing << caption + ": " + number;
                    }
        QVERIFY2(missing.isEmpty(), qPrintable(missing.mid(0, 10).join("; ") + QString::number(missing.size())));
        QVERIFY(compared > 2000);
    }

    QTemporaryDir m_folder;
    reports::StudyData m_data;
    std::unique_ptr<reports::StudyAnalysis> m_analysis;
    QString m_page;
    std::map<QString, ReadTable> m_tables;
};

QTEST_MAIN(AllFormsTest)
#include "all_forms_test.moc"
