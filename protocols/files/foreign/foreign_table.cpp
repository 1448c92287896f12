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

/// Whether "1.988" and the like, and whole numbers, are all that a column holds. Beside decimal commas they may be thousands.
bool mayHaveThousandsPoints(const CsvTable& table, std::size_t column)
{
    const auto isGrouped = [](std::string_view cell) {
        if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
        const std::size_t point = cell.find('.');
        return point >= 1 && point <= 3 && cell.front() != '0' && cell.size() == point + 4;
    };
    bool hasGroups = false;
    for (const auto& row : table.rows) {
        const std::string_view cell = withoutBlanks(row[column]);
        if (isMissing(cell)) continue;
        const bool isWhole = cell.find('.') == std::string::npos;
        if (!numberIn(std::string(cell)) || (!isWhole && !isGrouped(cell))) return false;
        hasGroups = hasGroups || !isWhole;
    }
    return hasGroups;
}

/// The first cell of a column with a point.
std::string firstGroup(const CsvTable& table, std::size_t column)
{
    for (const auto& row : table.rows)
        if (row[column].find('.') != std::string::npos) return row[column];
    return {};
}

/// `hadCommas`: of each column.
void requireNoThousandsPoints(const CsvTable& table, const std::vector<bool>& hadCommas)
{
    for (std::size_t column = 0; column < table.columns.size(); ++column)
        if (!hadCommas[column] && mayHaveThousandsPoints(table, column))
            throw badInput({"numbers such as " + firstGroup(table, column) + " in the column \"" + table.columns[column] +
                                "\" may be thousands, because other columns have decimal commas",
                            table.where, "numbers without points between thousands",
                            "save the table with one sign for decimals, and none between thousands"});
}

/// Returns for each column whether it had decimal commas.
std::vector<bool> writePoints(CsvTable& table)
{
    std::vector<bool> hadCommas(table.columns.size());
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        hadCommas[column] = hasDecimalCommas(table, column);
        if (!hadCommas[column]) continue;
        for (auto& row : table.rows)
            if (std::string number = withPoint(row[column]); !number.empty()) row[column] = std::move(number);
    }
    return hadCommas;
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
    std::vector<bool> hadCommas;
    if (separator.sign != ',') hadCommas = writePoints(foreign.table);
    const bool commas = std::ranges::find(hadCommas, true) != hadCommas.end();
    if (commas) requireNoThousandsPoints(foreign.table, hadCommas);
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
