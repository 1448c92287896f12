#include "reports/formats/table_parts.h"

#include <algorithm>
#include <numeric>
#include <sstream>

#include "reports/text/tex_text.h"

namespace reports {
namespace {

constexpr double leastWrappedPt = 46;  ///< narrowest column in which words are wrapped
constexpr double spare = 0.97;         ///< share of the text width that is used: widths are estimates

std::vector<std::string> blankedWords(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

double longestWord(const std::string& text)
{
    double longest = 0;
    for (const std::string& word : blankedWords(text)) longest = std::max(longest, texWidth(word));
    return longest;
}

std::vector<PartColumn> columnsOf(const Table& table)
{
    std::vector<PartColumn> columns;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (!table.isInDocuments(i)) continue;
        PartColumn column{i, longestWord(table.columns[i].name), !table.rows.empty(), 0};
        for (const auto& row : table.rows) {
            column.width = std::max(column.width, texWidth(row[i].text));
            column.isNumber = column.isNumber && row[i].isNumber;
        }
        columns.push_back(column);
    }
    return columns;
}

/// Fits the columns into the text by wrapping those of words; returns false where that is not enough.
bool wrap(TablePart& part, const TableRoom& room, double leastPt)
{
    double fixed = room.gapPt * double(part.columns.size() - 1), wanted = 0;
    const auto isWrappable = [&](const PartColumn& column) {
        return (!column.isNumber || column.width > 130) && column.width * part.scale > leastPt;
    };
    for (PartColumn& column : part.columns) {
        column.wrappedPt = 0;
        (isWrappable(column) ? wanted : fixed) += column.width * part.scale;
    }
    const double left = spare * room.widthPt - fixed;
    if (wanted <= left) return true;
    // Every wrapped column gets the least width, and a share of the rest by what it wants.
    const auto wrapped = double(std::ranges::count_if(part.columns, isWrappable));
    if (wrapped * leastPt > left || wrapped == 0) return false;
    for (PartColumn& column : part.columns)
        if (isWrappable(column)) column.wrappedPt = leastPt + (left - wrapped * leastPt) * column.width * part.scale / wanted;
    return true;
}

/// The columns in the largest type that needs no wrapping, else in the largest in which wrapping helps.
bool fit(TablePart& part, const TableRoom& room)
{
    for (const double scale : room.scales) {
        part.scale = scale;
        const double width =
            std::accumulate(part.columns.begin(), part.columns.end(), room.gapPt * double(part.columns.size() - 1),
                            [&](double sum, const PartColumn& one) { return sum + one.width * scale; });
        for (PartColumn& column : part.columns) column.wrappedPt = 0;
        if (width <= spare * room.widthPt) return true;
    }
    for (const double scale : room.scales) {
        part.scale = scale;
        if (wrap(part, room, leastWrappedPt + 20 * scale)) return true;
    }
    return wrap(part, room, leastWrappedPt);
}

/// Columns of names before the first number; at most three, and at least one.
std::size_t namesIn(const std::vector<PartColumn>& columns)
{
    std::size_t names = 0;
    while (names < columns.size() && names < 3 && !columns[names].isNumber) ++names;
    return std::min(columns.size(), std::max<std::size_t>(1, names));
}

/// The columns in parts of at most `most`, each filled before the next begins.
std::vector<TablePart> filledParts(const std::vector<PartColumn>& columns, const TableRoom& room, std::size_t most)
{
    const auto firstValue = columns.begin() + static_cast<std::ptrdiff_t>(std::min(namesIn(columns), columns.size() - 1));
    std::vector<TablePart> parts;
    TablePart part{{columns.begin(), firstValue}, 1};
    for (auto column = firstValue; column != columns.end(); ++column) {
        TablePart longer = part;
        longer.columns.push_back(*column);
        const bool isFirst = part.columns.size() == std::size_t(firstValue - columns.begin());
        if ((longer.columns.size() <= most && fit(longer, room)) || isFirst) {
            if (isFirst) fit(longer, room);
            part = longer;
            continue;
        }
        parts.push_back(part);
        part = TablePart{{columns.begin(), firstValue}, 1};
        part.columns.push_back(*column);
        fit(part, room);
    }
    parts.push_back(part);
    return parts;
}

}  // namespace

std::vector<TablePart> tableParts(const Table& table, const TableRoom& room)
{
    const std::vector<PartColumn> columns = columnsOf(table);
    TablePart whole{columns, 1};
    if (columns.size() <= mostPartColumns && fit(whole, room)) return {whole};
    const std::vector<TablePart> filled = filledParts(columns, room, mostPartColumns);
    // Parts of about equal size read better than a full one with a rest.
    for (std::size_t most = 2; most < mostPartColumns; ++most)
        if (std::vector<TablePart> even = filledParts(columns, room, most); even.size() == filled.size()) return even;
    return filled;
}

std::string partWords(std::size_t number, std::size_t parts)
{
    return parts < 2 ? "" : " (part " + std::to_string(number) + " of " + std::to_string(parts) + ")";
}

std::vector<std::string> headLines(const std::string& name, double width)
{
    std::vector<std::string> lines;
    std::string line;
    for (const std::string& word : blankedWords(name)) {
        const std::string longer = line.empty() ? word : line + " " + word;
        if (!line.empty() && texWidth(longer) > width + 0.1) {
            lines.push_back(line);
            line = word;
        } else {
            line = longer;
        }
    }
    lines.push_back(line);
    return lines;
}

}  // namespace reports
