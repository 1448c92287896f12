#include "reports/documents/report_pdf.h"

#include <QAbstractTextDocumentLayout>
#include <QBuffer>
#include <QFontDatabase>
#include <QPainter>
#include <QPdfWriter>
#include <QRegularExpression>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QTextDocumentFragment>
#include <QTextTable>
#include <algorithm>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "reports/documents/figure_object.h"
#include "reports/documents/html_entities.h"
#include "reports/formats/table_parts.h"

namespace reports {
namespace {

constexpr int dotsPerInch = 600;
constexpr double marginMm = 17, footerMm = 9;
constexpr double bodyPt = 9.5, smallPt = 8, tablePt = 9;  ///< tablePt: type of a table whose scale is 1
/// Liberation Sans and DejaVu Sans are wider than Computer Modern, in whose widths table_parts.h counts.
constexpr double sansOverComputerModern = 1.18;
constexpr double besideCellPt = 6.5;  ///< padding on both sides of a cell, and what rounding takes
constexpr int staysWithNext = QTextFormat::UserProperty + 2;

const QColor ink("#22303a"), soft("#5b6770"), accent("#1d4e63"), warning("#8a3b00"), rule("#9aa5ad");

QTextCharFormat type(double points, const QColor& colour = ink, bool isBold = false)
{
    QTextCharFormat format;
    format.setFontPointSize(points);
    format.setForeground(colour);
    format.setFontWeight(isBold ? QFont::DemiBold : QFont::Normal);
    return format;
}

QTextBlockFormat block(double above, double below, bool keepsWithNext = false)
{
    QTextBlockFormat format;
    format.setTopMargin(above);
    format.setBottomMargin(below);
    if (keepsWithNext) format.setProperty(staysWithNext, true);
    return format;
}

/// Tiles stand in one line, and what is folded on the page is open.
QString asLines(const std::string& html)
{
    QString text = QString::fromUtf8(asXml(html));
    text.remove("<text>").remove("</text>");
    static const QRegularExpression folded("<summary>(.*?)</summary>"), tileEnd("</div><div class=\"tile\">");
    text.replace(tileEnd, "&nbsp;&nbsp;\u00B7&nbsp;&nbsp;").replace("<div class=\"tiles\"><div class=\"tile\">", "<p>");
    text.replace("</div></div>", "</p>").replace("</b><span>", "</b>&nbsp;<span>");
    text.replace(folded, "<p><b>\\1</b></p>").remove("<details>").remove("</details>");
    return text;
}

/// The text of a cell without the tags of the page; its minus signs and spaces are those of the page.
QString plainOf(QString text)
{
    static const QRegularExpression tag("<[^>]*>");
    text.remove(tag);
    return text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&#39;", "'").replace("&amp;", "&");
}

class PdfReport {
public:
    explicit PdfReport(const ReportDocument& document)
        : m_document(document), m_writer(&m_buffer), m_figures(prepared().width(), 0.62 * bodyHeight()), m_cursor(&m_text)
    {
        m_text.documentLayout()->setPaintDevice(&m_writer);
        m_text.documentLayout()->registerHandler(FigureObject::format, &m_figures);
        m_text.setDocumentMargin(0);
        QFont font("Liberation Sans");
        font.setPointSizeF(bodyPt);
        m_text.setDefaultFont(font);
        m_text.setPageSize(QSizeF(m_writer.width(), bodyHeight()));
        m_text.setDefaultStyleSheet(
            "p { margin-top: 3px; margin-bottom: 5px; } li { margin-bottom: 3px; } code { font-size: 8pt; }");
    }

    std::string written()
    {
        m_cursor.beginEditBlock();
        addHead();
        for (const DocumentSection& section : m_document.sections) addSection(section);
        addHtml(m_document.footerHtml, smallPt, soft);
        m_cursor.endEditBlock();
        moveLonelyHeads();
        paint();
        return m_bytes.toStdString();
    }

private:
    /// Sets up the writer before anything asks for its size.
    QPdfWriter& prepared()
    {
        m_buffer.open(QIODevice::WriteOnly);
        m_writer.setResolution(dotsPerInch);
        m_writer.setPageLayout({QPageSize(QPageSize::A4), QPageLayout::Portrait,
                                QMarginsF(marginMm, marginMm, marginMm, marginMm - footerMm), QPageLayout::Millimeter});
        m_writer.setTitle(QString::fromStdString(m_document.title));
        return m_writer;
    }

    static double units(double mm) { return mm / 25.4 * dotsPerInch; }
    double bodyHeight() const { return m_writer.height() - units(footerMm); }
    double bodyWidthPt() const { return 72.0 * m_writer.width() / dotsPerInch; }

    void addText(const QString& text, const QTextBlockFormat& place, const QTextCharFormat& look)
    {
        if (m_text.isEmpty()) {
            m_cursor.setBlockFormat(place);
            m_cursor.setBlockCharFormat(look);
        } else {
            m_cursor.insertBlock(place, look);
        }
        m_cursor.insertText(text, look);
    }

    void addHtml(const std::string& html, double points = bodyPt, const QColor& colour = ink)
    {
        if (html.empty()) return;
        m_cursor.insertBlock(block(3, 4), type(points, colour));
        const int begin = m_cursor.position();
        m_cursor.insertHtml(asLines(html));
        if (points == bodyPt && colour == ink) return;
        QTextCursor all(&m_text);
        all.setPosition(begin);
        all.setPosition(m_cursor.position(), QTextCursor::KeepAnchor);
        QTextCharFormat look;
        look.setFontPointSize(points);
        look.setForeground(colour);
        all.mergeCharFormat(look);
    }

    void addHead()
    {
        addText(QString::fromStdString(m_document.title), block(0, 2, true), type(20, ink, true));
        addText(QString::fromStdString(m_document.lede), block(0, 8), type(11, soft));
        for (const DocumentNotice& notice : m_document.notices) addHtml(notice.html, bodyPt, notice.isWarning ? warning : soft);
    }

    QString tags() const
    {
        QString text;
        for (const DocumentTag& tag : m_document.tags) text += "   " + QString::fromStdString(tag.text);
        return text;
    }

    void addSection(const DocumentSection& section)
    {
        addText(QString::fromStdString(section.heading.title), block(20, 5, true), type(14, accent, true));
        m_cursor.insertText(tags(), type(smallPt, warning, true));
        addHtml(section.leadHtml);
        for (const DocumentItem& item : section.items) std::visit([this](const auto* one) { add(*one); }, item);
        addHtml(section.endHtml, smallPt);
    }

    void add(const Figure& figure)
    {
        m_cursor.insertBlock(block(8, 2, true), type(bodyPt));
        QTextCharFormat object;
        object.setObjectType(FigureObject::format);
        object.setProperty(FigureObject::numberProperty, m_figures.add(figure));
        m_cursor.insertText(QString(QChar::ObjectReplacementCharacter), object);
        addText(QString::fromStdString(figure.caption), block(2, 8), type(smallPt, soft));
    }

    void add(const ReportTable& one)
    {
        const std::vector<TablePart> parts =
            tableParts(one.table, {.widthPt = bodyWidthPt() / sansOverComputerModern * 10 / tablePt});
        for (std::size_t i = 0; i < parts.size(); ++i) {
            addText(QString::fromStdString(one.table.caption + partWords(i + 1, parts.size())), block(9, 3, true),
                    type(smallPt, soft));
            addTable(one.table, parts[i]);
        }
    }

    /// What the text takes in the font of this computer, which may be wider than Liberation Sans; in points.
    double advancePt(const QString& text, double points, QFont::Weight weight = QFont::Normal)
    {
        QFont font = m_text.defaultFont();
        font.setPointSizeF(points);
        font.setWeight(weight);
        return 72.0 * QFontMetricsF(font, &m_writer).horizontalAdvance(text) / dotsPerInch;
    }

    /// The widths of the columns at this size of the type, in points. Columns that are not wrapped keep every line whole.
    std::vector<double> widthsOf(const Table& table, const TablePart& part, double points)
    {
        std::vector<double> widths;
        for (const PartColumn& column : part.columns) {
            if (column.wrappedPt > 0) {
                widths.push_back(column.wrappedPt * sansOverComputerModern * points / (10 * part.scale));
                continue;
            }
            double widest = 0;
            for (const std::string& line : headLines(table.columns[column.index].name, column.width))
                widest = std::max(widest, advancePt(QString::fromStdString(line), points, QFont::DemiBold));
            for (const auto& row : table.rows)
                widest = std::max(widest, advancePt(plainOf(QString::fromStdString(row[column.index].html)), points));
            widths.push_back(widest + besideCellPt);
        }
        return widths;
    }

    /// Qt finds the widths itself, but takes a head in lines for one long line, and shrinks columns beside wrapped ones.
    static bool needsWidths(const Table& table, const TablePart& part)
    {
        return !std::ranges::all_of(part.columns, [&](const PartColumn& column) {
            return column.wrappedPt == 0 && headLines(table.columns[column.index].name, column.width).size() == 1;
        });
    }

    void addTable(const Table& table, const TablePart& part)
    {
        QTextTableFormat format;
        format.setHeaderRowCount(1);
        format.setBorder(0);
        format.setCellSpacing(0);
        format.setCellPadding(1.5);
        double points = tablePt * part.scale;
        if (needsWidths(table, part)) {
            const auto sum = [](const std::vector<double>& widths) { return std::accumulate(widths.begin(), widths.end(), 0.0); };
            const double whole = sum(widthsOf(table, part, points));
            points *= std::min(1.0, bodyWidthPt() / whole);
            const auto widths = widthsOf(table, part, points);
            QList<QTextLength> lengths;
            for (const double width : widths)
                lengths.emplace_back(QTextLength::PercentageLength, 100 * width / std::max(bodyWidthPt(), sum(widths)));
            format.setColumnWidthConstraints(lengths);
        }
        QTextTable* grid = m_cursor.insertTable(int(table.rows.size()) + 1, int(part.columns.size()), format);
        for (std::size_t column = 0; column < part.columns.size(); ++column)
            addHeadCell(grid, table, part.columns[column], int(column), points);
        for (std::size_t row = 0; row < table.rows.size(); ++row)
            for (std::size_t column = 0; column < part.columns.size(); ++column)
                addCell(grid->cellAt(int(row) + 1, int(column)), table.rows[row][part.columns[column].index],
                        part.columns[column], points, row + 1 == table.rows.size());
        m_cursor.movePosition(QTextCursor::End);
    }

    static void align(QTextCursor& cursor, bool isNumber)
    {
        QTextBlockFormat place;
        place.setAlignment(isNumber ? Qt::AlignRight : Qt::AlignLeft);
        cursor.setBlockFormat(place);
    }

    void addHeadCell(QTextTable* grid, const Table& table, const PartColumn& column, int at, double points)
    {
        QTextTableCell cell = grid->cellAt(0, at);
        setRules(cell, 1.2, 0.7);
        QTextCursor cursor = cell.firstCursorPosition();
        align(cursor, column.isNumber);
        QString name;
        const std::string& text = table.columns[column.index].name;
        for (const std::string& line : headLines(text, column.wrappedPt > 0 ? 1e9 : column.width))
            name += (name.isEmpty() ? "" : "\n") + QString::fromStdString(line);
        cursor.insertText(name.replace('\n', QChar::LineSeparator), type(points, ink, true));
    }

    void addCell(QTextTableCell cell, const TableCell& content, const PartColumn& column, double points, bool isLast)
    {
        setRules(cell, 0, isLast ? 1.2 : 0);
        QTextCursor cursor = cell.firstCursorPosition();
        align(cursor, column.isNumber);
        if (content.html.find("<i>") == std::string::npos && content.html.find("<sub>") == std::string::npos) {
            cursor.insertText(plainOf(QString::fromStdString(content.html)), type(points));
            return;
        }
        // Conditions: italic letters with subscripts, and the text around them.
        QTextCharFormat italic = type(points), lowered = type(points);
        italic.setFontItalic(true);
        lowered.setVerticalAlignment(QTextCharFormat::AlignSubScript);
        static const QRegularExpression piece("<i>([^<]*)</i>|<sub>([^<]*)</sub>|<[^>]*>|([^<]+)");
        for (auto found = piece.globalMatch(QString::fromStdString(content.html)); found.hasNext();) {
            const auto one = found.next();
            if (one.hasCaptured(1)) cursor.insertText(plainOf(one.captured(1)), italic);
            if (one.hasCaptured(2)) cursor.insertText(plainOf(one.captured(2)), lowered);
            if (one.hasCaptured(3)) cursor.insertText(plainOf(one.captured(3)), type(points));
        }
    }

    static void setRules(QTextTableCell& cell, double above, double below)
    {
        QTextTableCellFormat format = cell.format().toTableCellFormat();
        format.setBorderBrush(rule);
        format.setTopBorder(above);
        format.setBottomBorder(below);
        format.setTopBorderStyle(above > 0 ? QTextFrameFormat::BorderStyle_Solid : QTextFrameFormat::BorderStyle_None);
        format.setBottomBorderStyle(below > 0 ? QTextFrameFormat::BorderStyle_Solid : QTextFrameFormat::BorderStyle_None);
        format.setLeftPadding(3);
        format.setRightPadding(3);
        cell.setFormat(format);
    }

    int pageOf(double y) const { return int(y / m_text.pageSize().height()); }

    /// Begins a new page before every heading, caption or figure whose next block stands on another page.
    void moveLonelyHeads()
    {
        const auto* layout = m_text.documentLayout();
        QTextBlock chain;  // The first of consecutive blocks that stay together.
        for (QTextBlock one = m_text.begin(); one.isValid(); one = one.next()) {
            if (!one.blockFormat().boolProperty(staysWithNext)) {
                chain = {};
                continue;
            }
            if (!chain.isValid()) chain = one;
            const QTextBlock next = one.next();
            if (!next.isValid()) break;
            const double top = layout->blockBoundingRect(chain).top(), below = layout->blockBoundingRect(next).top();
            if (pageOf(top) == pageOf(below + 1)) continue;
            QTextCursor cursor(chain);
            QTextBlockFormat moved = chain.blockFormat();
            if (moved.pageBreakPolicy() != QTextFormat::PageBreak_Auto) continue;
            moved.setPageBreakPolicy(QTextFormat::PageBreak_AlwaysBefore);
            cursor.setBlockFormat(moved);
        }
    }

    void paint()
    {
        QPainter painter(&m_writer);
        const int pages = m_text.pageCount();
        QFont font("Liberation Sans");
        font.setPointSizeF(smallPt);
        for (int page = 0; page < pages; ++page) {
            if (page > 0) m_writer.newPage();
            painter.save();
            painter.translate(0, -page * m_text.pageSize().height());
            const QRectF shown(0, page * m_text.pageSize().height(), m_writer.width(), m_text.pageSize().height());
            painter.setClipRect(shown);
            QAbstractTextDocumentLayout::PaintContext context;
            context.clip = shown;
            context.palette.setColor(QPalette::Text, ink);
            m_text.documentLayout()->draw(&painter, context);
            painter.restore();
            painter.setFont(font);
            painter.setPen(soft);
            const QRectF foot(0, m_text.pageSize().height(), m_writer.width(), units(footerMm));
            const QString number = QString("%1 / %2").arg(page + 1).arg(pages);
            painter.drawText(foot, Qt::AlignRight | Qt::AlignBottom, number);
            const QString name = QString::fromStdString(m_document.title) + tags();
            painter.drawText(foot, Qt::AlignLeft | Qt::AlignBottom,
                             QFontMetricsF(font, &m_writer).elidedText(name, Qt::ElideRight, 0.85 * foot.width()));
        }
    }

    const ReportDocument& m_document;
    QByteArray m_bytes;
    QBuffer m_buffer{&m_bytes};
    QPdfWriter m_writer;
    FigureObject m_figures;
    QTextDocument m_text;
    QTextCursor m_cursor;
};

}  // namespace

void writeReportPdf(const ReportDocument& document, const std::filesystem::path& file)
{
    if (QFontDatabase::families().isEmpty())
        throw protocols::environmentFault(
            {"no font is installed", file.string(), "a font for the PDF", "apt-get install fonts-dejavu-core"});
    protocols::writeWholeFile(file, PdfReport(document).written(), protocols::Sync::Later);
}

}  // namespace reports
