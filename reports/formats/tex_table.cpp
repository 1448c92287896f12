#include "reports/formats/tex_table.h"

#include <cmath>
#include <set>

#include "reports/formats/table_parts.h"
#include "reports/text/tex_text.h"

namespace reports {
namespace {

constexpr std::size_t mostReasons = 8;

const char* commandFor(double scale) { return scale > 0.85 ? "\\small" : scale > 0.75 ? "\\footnotesize" : "\\scriptsize"; }

std::string points(double value) { return std::to_string(std::lround(std::floor(value))) + "pt"; }

std::string formatOf(const TablePart& part)
{
    std::string format = "@{}";
    for (const PartColumn& column : part.columns)
        format += column.wrappedPt > 0 ? ">{\\raggedright\\arraybackslash}p{" + points(column.wrappedPt) + "}"
                  : column.isNumber    ? "r"
                                       : "l";
    return format + "@{}";
}

/// The name of a column, in lines no wider than its cells or its longest word.
std::string headOf(const Table& table, const PartColumn& column)
{
    const std::string& name = table.columns[column.index].name;
    if (column.wrappedPt > 0) return breakableTex(name);
    const std::vector<std::string> lines = headLines(name, column.width);
    if (lines.size() == 1) return escapedTex(lines.front());
    std::string stack = std::string("\\shortstack[") + (column.isNumber ? "r" : "l") + "]{";
    for (const std::string& one : lines) stack += (&one == &lines.front() ? "" : "\\\\") + escapedTex(one);
    return stack + "}";
}

std::string cellOf(const TableCell& cell, const PartColumn& column, double scale)
{
    const bool fits = column.wrappedPt == 0 || texWidth(cell.text) * scale <= column.wrappedPt;
    return fits ? cell.tex : breakableTex(cell.text);
}

template <class TextOf>
std::string lineOf(const TablePart& part, const TextOf& textOf)
{
    std::string line;
    for (const PartColumn& column : part.columns) line += (&column == &part.columns.front() ? "" : " & ") + textOf(column);
    return line + " \\\\\n";
}

std::string headLine(const Table& table, const TablePart& part)
{
    return "\\toprule\n" + lineOf(part, [&](const PartColumn& column) { return headOf(table, column); }) + "\\midrule\n";
}

std::string rowsOf(const Table& table, const TablePart& part)
{
    std::string rows;
    for (const auto& row : table.rows)
        rows += lineOf(part, [&](const PartColumn& column) { return cellOf(row[column.index], column, part.scale); });
    return rows;
}

/// Why some cells hold a dash; empty where none does.
std::string noteOf(const Table& table)
{
    std::set<std::string> reasons;
    for (const auto& row : table.rows)
        for (const TableCell& cell : row)
            if (!cell.why.empty() && reasons.size() < mostReasons) reasons.insert(cell.why);
    std::string note;
    for (const std::string& reason : reasons) note += (note.empty() ? "" : "; ") + breakableTex(reason);
    return note.empty() ? "" : "\\emph{Note.} --: no value (" + note + ").";
}

std::string floatOf(const Table& table, const TablePart& part)
{
    const std::string note = noteOf(table);
    return "\\begin{table*}\n\\centering\n" + std::string(commandFor(part.scale)) +
           "\n\\setlength{\\tabcolsep}{3pt}\n\\caption{" + breakableTex(table.caption) + "}\n\\label{tab:" + table.name +
           "}\n\\begin{tabular}{" + formatOf(part) + "}\n" + headLine(table, part) + rowsOf(table, part) +
           "\\bottomrule\n\\end{tabular}\n" +
           (note.empty() ? "" : "\\par\\smallskip\\parbox{0.96\\textwidth}{\\raggedright " + note + "}\n") + "\\end{table*}\n";
}

std::string longTableOf(const Table& table, const TablePart& part, std::size_t number, std::size_t parts)
{
    const std::string label = number == 1 ? "\\label{tab:" + table.name + "}" : "";
    const std::string head = headLine(table, part), note = noteOf(table), columns = std::to_string(part.columns.size());
    return "{" + std::string(commandFor(part.scale)) + "\\setlength{\\tabcolsep}{3pt}\n\\begin{longtable}{" + formatOf(part) +
           "}\n\\caption{" + breakableTex(table.caption) + partWords(number, parts) + "}" + label + "\\\\\n" + head +
           "\\endfirsthead\n\\multicolumn{" + columns + "}{@{}l}{\\emph{continued}}\\\\\n" + head +
           "\\endhead\n\\bottomrule\n\\endfoot\n" + rowsOf(table, part) + "\\end{longtable}\n" +
           (note.empty() || number != parts ? "" : "\\noindent\\parbox{\\textwidth}{\\raggedright " + note + "}\n") + "}\n";
}

}  // namespace

std::string toTex(const Table& table)
{
    const std::vector<TablePart> parts = tableParts(table, {.widthPt = texTextWidth});
    if (parts.size() == 1 && table.rows.size() <= mostTexRows)
        return "% needs \\usepackage[T1]{fontenc} and \\usepackage{array,booktabs}\n" + floatOf(table, parts[0]);
    std::string tex =
        "% needs \\usepackage[T1]{fontenc} and \\usepackage{array,booktabs,longtable}; longtable needs text in one column\n";
    for (std::size_t i = 0; i < parts.size(); ++i) tex += longTableOf(table, parts[i], i + 1, parts.size());
    return tex;
}

}  // namespace reports
