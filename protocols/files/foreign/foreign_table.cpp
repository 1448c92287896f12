#include "protocols/files/foreign/foreign_table.h"

#include <algorithm>
#include <array>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/text_encoding.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"

namespace protocols {

namespace {

struct Separator {
    char sign;
    const char* name;
};
constexpr std::array<Separator, 4> separators{{{',', "commas"}, {';', "semicolons"}, {'\t', "tabs"}, {'|', "bars"}}};

constexpr char guard = '\'';

/// How often each separator stands outside quotes in the first line that is not empty.
std::array<std::size_t, separators.size()> countsInHeader(std::string_view text)
{
    std::array<std::size_t, separators.size()> counts{};
    bool inQuotes = false, isEmpty = true;
    for (const char c : text) {
        if (c == '"') inQuotes = !inQuotes;
        if (inQuotes) continue;
        if (c == '\n' || c == '\r') {
            if (!isEmpty) break;
            continue;
        }
        isEmpty = isEmpty && (c == ' ' || c == '\t');
        for (std::size_t i = 0; i < separators.size(); ++i) counts[i] += separators[i].sign == c ? 1 : 0;
    }
    return counts;
}

const Separator& separatorOf(std::string_view text)
{
    const auto counts = countsInHeader(text);
    return separators[std::size_t(std::max_element(counts.begin(), counts.end()) - counts.begin())];
}

/// Excel states the separator in a first line "sep=;". Takes the line off.
const Separator* statedSeparator(std::string_view& text)
{
    constexpr std::string_view mark = "sep=";
    if (!text.starts_with(mark) || text.size() <= mark.size()) return nullptr;
    const auto* found =
        std::find_if(separators.begin(), separators.end(), [&](const Separator& one) { return one.sign == text[mark.size()]; });
    const std::size_t end = text.find_first_of("\r\n");
    if (found == separators.end() || end != mark.size() + 1) return nullptr;
    text.remove_prefix(end);
    return found;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// "-12,5" as "-12.5"; empty where the cell is not digits, one comma, digits.
std::string withPoint(std::string_view cell)
{
    cell = withoutBlanks(cell);
    const std::size_t comma = cell.find(',');
    if (comma == std::string_view::npos || comma + 1 == cell.size() || !isDigit(cell[comma + 1])) return {};
    std::string number(cell);
    number[comma] = '.';
    return numberIn(number) ? number : std::string();
}

/// Whether all numbers of a column are written with a comma or are whole, and at least one has a comma.
bool hasDecimalCommas(const CsvTable& table, std::size_t column)
{
    bool hasComma = false;
    for (const auto& row : table.rows) {
        const std::string& cell = row[column];
        if (isMissing(cell)) continue;
        const bool isWhole = cell.find('.') == std::string::npos && numberIn(cell).has_value();
        if (!isWhole && withPoint(cell).empty()) return false;
        hasComma = hasComma || !isWhole;
    }
    return hasComma;
}

/// Whether a cell may be thousands, "-1.988" where the mark is a point.
bool isGrouped(std::string_view cell, char mark)
{
    if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
    const std::size_t place = cell.find(mark);
    if (place < 1 || place > 3 || cell.front() == '0' || cell.size() != place + 4) return false;
    for (std::size_t i = 0; i < cell.size(); ++i)
        if (i != place && !isDigit(cell[i])) return false;
    return true;
}

/// How the cells of a column are marked, of which every one is a number with the mark or a whole number.
enum class Marked { Nowhere, AsGroups, AsDecimals };

/// Numbers of groups of three may be thousands; one of another form shows that the mark stands before decimals.
Marked markingOf(const CsvTable& table, std::size_t column, char mark)
{
    bool hasMarks = false, hasDecimals = false;
    for (const auto& row : table.rows) {
        const std::string_view cell = withoutBlanks(row[column]);
        if (isMissing(cell)) continue;
        const bool isMarked = cell.find(mark) != std::string_view::npos;
        if (mark == ',' && isMarked ? withPoint(cell).empty() : !numberIn(cell)) return Marked::Nowhere;
        hasMarks = hasMarks || isMarked;
        hasDecimals = hasDecimals || (isMarked && !isGrouped(cell, mark));
    }
    return hasDecimals ? Marked::AsDecimals : hasMarks ? Marked::AsGroups : Marked::Nowhere;
}

/// The first cell of a column with the mark.
std::string firstGroup(const CsvTable& table, std::size_t column, char mark)
{
    for (const auto& row : table.rows)
        if (row[column].find(mark) != std::string::npos) return row[column];
    return {};
}

/// Refuses a column whose marks may stand between thousands, because other columns have the other mark before decimals.
void requireNoThousands(const CsvTable& table, std::size_t column, char mark)
{
    if (markingOf(table, column, mark) != Marked::AsGroups) return;
    const std::string marks = mark == ',' ? "commas" : "points", others = mark == ',' ? "points" : "commas";
    throw badInput({"numbers such as " + firstGroup(table, column, mark) + " in the column \"" + table.columns[column] +
                        "\" may be thousands, because other columns have decimal " + others,
                    table.where, "numbers without " + marks + " between thousands",
                    "save the table with one sign for decimals, and none between thousands"});
}

/// Whether a number of another column has decimals after a point: its points are not all between groups of three.
bool hasDecimalPoints(const CsvTable& table)
{
    for (std::size_t column = 0; column < table.columns.size(); ++column)
        if (markingOf(table, column, '.') == Marked::AsDecimals) return true;
    return false;
}

/// Whether each column has decimal commas. Throws badInput where the points or commas of a column may be between thousands.
std::vector<bool> columnsWithCommas(const CsvTable& table)
{
    std::vector<bool> hasCommas(table.columns.size());
    for (std::size_t column = 0; column < hasCommas.size(); ++column) hasCommas[column] = hasDecimalCommas(table, column);
    if (std::ranges::find(hasCommas, true) == hasCommas.end()) return hasCommas;
    const bool hasPoints = hasDecimalPoints(table);
    for (std::size_t column = 0; column < hasCommas.size(); ++column)
        if (!hasCommas[column] || hasPoints) requireNoThousands(table, column, hasCommas[column] ? ',' : '.');
    return hasCommas;
}

void writePoints(CsvTable& table, const std::vector<bool>& hasCommas)
{
    for (std::size_t column = 0; column < hasCommas.size(); ++column) {
        if (!hasCommas[column]) continue;
        for (auto& row : table.rows)
            if (std::string number = withPoint(row[column]); !number.empty()) row[column] = std::move(number);
    }
}

void requireNoZeroByte(std::string_view text, const std::string& where)
{
    const std::size_t at = text.find('\0');
    if (at == std::string_view::npos) return;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw badInput({"the text holds a zero byte", where + ", line " + std::to_string(line), "text without zero bytes",
                    "save the table again as CSV in UTF-8"});
}

bool isFormulaSign(char c) { return c == '=' || c == '+' || c == '-' || c == '@' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

ForeignTable foreignTableFrom(std::string_view bytes, const std::string& where, const std::string& encoding)
{
    const DecodedText decoded = encoding.empty() ? decodedText(bytes, where) : decodedText(bytes, where, encoding);
    requireNoZeroByte(decoded.text, where);
    std::string_view text = decoded.text;
    const Separator* stated = statedSeparator(text);
    const Separator& separator = stated != nullptr ? *stated : separatorOf(text);
    ForeignTable foreign{csvTableFrom(text, where, separator.sign), {}, true};
    for (auto& row : foreign.table.rows)
        for (std::string& cell : row)
            if (const auto plain = cellWithoutGuard(cell); plain.size() != cell.size()) cell = std::string(plain);
    std::vector<bool> hasCommas;
    if (separator.sign != ',') hasCommas = columnsWithCommas(foreign.table);
    writePoints(foreign.table, hasCommas);
    const bool commas = std::ranges::find(hasCommas, true) != hasCommas.end();
    foreign.taken = std::string(separator.name) + (commas ? ", decimal commas, " : ", decimal points, ") + decoded.encoding;
    foreign.isUsual = separator.sign == ',' && !commas && decoded.encoding == "UTF-8";
    return foreign;
}

ForeignTable readForeignTable(const std::filesystem::path& file, const std::string& encoding)
{
    return foreignTableFrom(readWholeFile(file, largestTable), file.string(), encoding);
}

std::string safeCell(std::string_view text)
{
    const bool isSafe = text.empty() || text == "-" || numberIn(text) || (!isFormulaSign(text.front()) && text.front() != guard);
    return isSafe ? std::string(text) : guard + std::string(text);
}

std::string_view cellWithoutGuard(std::string_view cell)
{
    const bool isGuarded =
        cell.size() > 1 && cell[0] == guard && (isFormulaSign(cell[1]) || cell[1] == guard) && !numberIn(cell.substr(1));
    return isGuarded ? cell.substr(1) : cell;
}

}  // namespace protocols
