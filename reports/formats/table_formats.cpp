#include "reports/formats/table_formats.h"

#include <algorithm>
#include <vector>

#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/markup_text.h"

namespace reports {
namespace {

/// Characters on the screen: continuation bytes of UTF-8 take no room.
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

/// By column: whether every cell is a number.
std::vector<bool> numericColumns(const Table& table)
{
    std::vector<bool> numeric;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        numeric.push_back(std::ranges::all_of(table.rows, [&](const auto& row) { return row[i].isNumber; }));
    return numeric;
}

}  // namespace

std::string toCsv(const Table& table)
{
    const auto line = [&](const auto& textOf) {
        std::string result;
        bool isFirst = true;
        for (std::size_t i = 0; i < table.columns.size(); ++i) {
            if (!table.isInCsv(i)) continue;
            result += (isFirst ? "" : ",") + protocols::csvCell(textOf(i));
            isFirst = false;
        }
        return result + "\r\n";
    };
    std::string csv = line([&](std::size_t i) { return table.columns[i].name; });
    for (const auto& row : table.rows)
        csv += line([&](std::size_t i) { return row[i].isNumber ? row[i].csv : protocols::safeCell(row[i].csv); });
    return csv;
}

std::string toHtml(const Table& table)
{
    const std::vector<bool> numeric = numericColumns(table);
    // The keyboard scrolls what it can reach: a table may be wider than its screen.
    const std::string caption = protocols::escapedMarkup(table.caption);
    std::string html = "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"" + caption + "\"><table><caption>" +
                       caption + "</caption><thead><tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (table.isInDocuments(i))
            html += std::string("<th scope=\"col\"") + (numeric[i] ? " class=\"n\"" : "") + ">" +
                    protocols::escapedMarkup(table.columns[i].name) + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (std::size_t i = 0; i < row.size(); ++i) {
            if (!table.isInDocuments(i)) continue;
            const std::string tag = i == 0 ? "th" : "td";
            html += "<" + tag + (i == 0 ? " scope=\"row\"" : "") + (numeric[i] ? " class=\"n\"" : "") +
                    (row[i].why.empty() ? "" : " title=\"" + protocols::escapedMarkup(row[i].why) + "\"") + ">" + row[i].html +
                    "</" + tag + ">";
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string toText(const Table& table)
{
    const std::vector<bool> numeric = numericColumns(table);
    std::vector<std::size_t> widths(table.columns.size());
    for (std::size_t i = 0; i < widths.size(); ++i) {
        widths[i] = width(table.columns[i].name);
        for (const auto& row : table.rows) widths[i] = std::max(widths[i], width(row[i].text));
    }
    const auto line = [&](const auto& textOf) {
        std::string result;
        for (std::size_t i = 0; i < widths.size(); ++i)
            if (table.isInDocuments(i)) result += (result.empty() ? "" : "  ") + padded(textOf(i), widths[i], numeric[i]);
        while (result.ends_with(' ')) result.pop_back();
        return result + "\n";
    };
    std::string text = line([&](std::size_t i) { return table.columns[i].name; });
    std::size_t across = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) across += !table.isInDocuments(i) ? 0 : widths[i] + (i > 0 ? 2 : 0);
    text += std::string(across, '-') + "\n";
    for (const auto& row : table.rows) text += line([&](std::size_t i) { return row[i].text; });
    return text;
}

}  // namespace reports
