#include "reports/tables/table.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/csv_table.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"

namespace reports {
namespace {

const std::string minus = "\u2212";

TableCell noValue(const std::string& why) { return {"-", "", "\u2013", "--", why, true}; }

/// Characters on the screen: UTF-8 continuation bytes take no room.
std::size_t width(const std::string& text)
{
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string padded(const std::string& text, std::size_t to, bool right)
{
    const std::string space(to > width(text) ? to - width(text) : 0, ' ');
    return right ? space + text : text + space;
}

bool isNumeric(const Table& table, std::size_t column)
{
    return std::all_of(table.rows.begin(), table.rows.end(), [&](const auto& row) { return row[column].isNumber; });
}

}  // namespace

TableCell textCell(const std::string& text) { return {text, protocols::csvCell(text), escapedHtml(text), escapedTex(text), "", false}; }

TableCell blankCell() { return {"", "", "", "", "", true}; }

TableCell conditionCell(const std::string& condition)
{
    return {condition, protocols::csvCell(condition), htmlLabel(condition), texLabel(condition), "", false};
}

TableCell numberCell(const stats::Value& value, int decimals)
{
    if (!value.exists() || !std::isfinite(*value)) return noValue(value.exists() ? "unbounded" : value.why());
    const std::string text = fixed(*value, decimals);
    return {text, shortest(*value), typeset(text), "$" + text + "$", "", true};
}

TableCell countCell(std::size_t n)
{
    const std::string text = std::to_string(n);
    return {text, text, text, text, "", true};
}

TableCell pCell(const stats::Value& p)
{
    if (!p.exists()) return noValue(p.why());
    const std::string text = pText(*p);
    return {text, shortest(*p), escapedHtml(text), text.starts_with('<') ? "$<$ .001" : text, "", true};
}

TableCell intervalCell(const stats::Interval& interval, int decimals)
{
    if (!interval.low.exists() || !interval.high.exists())
        return noValue(interval.low.exists() ? interval.high.why() : interval.low.why());
    const std::string low = fixed(*interval.low, decimals);
    const std::string high = fixed(*interval.high, decimals);
    return {"[" + low + ", " + high + "]",
            protocols::csvCell("[" + shortest(*interval.low) + ", " + shortest(*interval.high) + "]"),
            "[" + typeset(low) + ", " + typeset(high) + "]",
            "$[" + low + ", " + high + "]$",
            "",
            true};
}

TableCell meanSdCell(const stats::Value& mean, const stats::Value& sd, int decimals)
{
    TableCell cell = numberCell(mean, decimals);
    if (!mean.exists()) return cell;
    const std::string spread = sd.exists() ? fixed(*sd, decimals) : "-";
    cell.text += " \u00B1 " + spread;
    cell.html += " <span class=\"sd\">\u00B1 " + spread + "</span>";
    cell.tex += " $\\pm$ " + spread;
    return cell;
}

std::string typeset(const std::string& number) { return number.starts_with('-') ? minus + number.substr(1) : number; }

std::string toCsv(const Table& table)
{
    const auto line = [&](const auto& textOf) {
        std::string result;
        bool isFirst = true;
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            if (!table.isInCsv(i)) continue;
            result += (isFirst ? "" : ",") + textOf(i);
            isFirst = false;
        }
        return result + "\r\n";
    };
    std::string csv = line([&](std::size_t i) { return protocols::csvCell(table.columns[i].name); });
    for (const auto& row : table.rows) csv += line([&](std::size_t i) { return row[i].csv; });
    return csv;
}

std::string toTex(const Table& table)
{
    std::string format;
    std::string head;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (!table.isInDocuments(i)) continue;
        format += isNumeric(table, i) ? 'r' : 'l';
        head += (head.empty() ? "" : " & ") + escapedTex(table.columns[i].name);
    }
    std::string tex = "% needs \\usepackage{booktabs}\n\\begin{table}\n\\centering\n\\caption{" + escapedTex(table.caption) +
                      "}\n\\begin{tabular}{" + format + "}\n\\toprule\n" + head + " \\\\\n\\midrule\n";
    for (const auto& row : table.rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            if (table.isInDocuments(i)) line += (line.empty() ? "" : " & ") + row[i].tex;
        tex += line + " \\\\\n";
    }
    return tex + "\\bottomrule\n\\end{tabular}\n\\end{table}\n";
}

std::string toHtml(const Table& table)
{
    std::string html = "<div class=\"scroll\"><table><caption>" + escapedHtml(table.caption) + "</caption><thead><tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (table.isInDocuments(i))
            html += std::string("<th scope=\"col\"") + (isNumeric(table, i) ? " class=\"n\"" : "") + ">" +
                    escapedHtml(table.columns[i].name) + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (!table.isInDocuments(i)) continue;
            const std::string tag = i == 0 ? "th" : "td";
            html += "<" + tag + (i == 0 ? " scope=\"row\"" : "") + (isNumeric(table, i) ? " class=\"n\"" : "") +
                    (row[i].why.empty() ? "" : " title=\"" + escapedHtml(row[i].why) + "\"") + ">" + row[i].html + "</" + tag +
                    ">";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string toText(const Table& table)
{
    std::vector<std::size_t> widths(table.columns.size());
    for (std::size_t i = 0; i < widths.size(); ++i) {
        widths[i] = width(table.columns[i].name);
        for (const auto& row : table.rows) widths[i] = std::max(widths[i], width(row[i].text));
    }
    const auto line = [&](const auto& textOf, bool isHead) {
        std::string result;
        for (std::size_t i = 0; i < widths.size(); ++i)
            if (table.isInDocuments(i))
                result += (result.empty() ? "" : "  ") + padded(textOf(i), widths[i], isNumeric(table, i) || (isHead && i > 0));
        while (result.ends_with(' ')) result.pop_back();
        return result + "\n";
    };
    std::string text = line([&](std::size_t i) { return table.columns[i].name; }, false);
    std::size_t across = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) across += !table.isInDocuments(i) ? 0 : widths[i] + (i > 0 ? 2 : 0);
    text += std::string(across, '-') + "\n";
    for (const auto& row : table.rows) text += line([&](std::size_t i) { return row[i].text; }, false);
    return text;
}

}  // namespace reports
