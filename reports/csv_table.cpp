#include "reports/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "protocols/files/errors.h"

namespace reports {
namespace {

/// One pass over the text; a record ends at a line break outside quotes.
class Reader {
public:
    Reader(std::string_view text, const std::string& where) : m_text(text), m_where(where) {}

    bool next(CsvRow& row)
    {
        while (m_at < m_text.size() && atLineBreak()) skipLineBreak();
        if (m_at >= m_text.size()) return false;
        row = {m_line, {}};
        while (true) {
            row.cells.push_back(field());
            if (m_at < m_text.size() && m_text[m_at] == ',') {
                ++m_at;
                continue;
            }
            if (m_at < m_text.size()) skipLineBreak();
            return true;
        }
    }

private:
    bool atLineBreak() const { return m_text[m_at] == '\n' || m_text[m_at] == '\r'; }

    void skipLineBreak()
    {
        if (m_text[m_at] == '\r' && m_at + 1 < m_text.size() && m_text[m_at + 1] == '\n') ++m_at;
        ++m_at;
        ++m_line;
    }

    std::string field()
    {
        if (m_at < m_text.size() && m_text[m_at] == '"') return quotedField();
        std::string result;
        for (; m_at < m_text.size() && m_text[m_at] != ',' && !atLineBreak(); ++m_at) {
            if (m_text[m_at] == '"') fail("a quote stands inside a field", "the whole field in quotes, inner quotes doubled");
            result += m_text[m_at];
        }
        return result;
    }

    std::string quotedField()
    {
        const std::size_t opened = m_line;
        std::string result;
        for (++m_at; m_at < m_text.size(); ++m_at) {
            if (m_text[m_at] == '"') {
                if (m_at + 1 < m_text.size() && m_text[m_at + 1] == '"') {
                    ++m_at;
                } else {
                    ++m_at;
                    if (m_at < m_text.size() && m_text[m_at] != ',' && !atLineBreak())
                        fail("text follows a closing quote", "a comma or the end of the line");
                    return result;
                }
            } else if (m_text[m_at] == '\n') {
                ++m_line;
            }
            result += m_text[m_at];
        }
        m_line = opened;
        fail("a quote is not closed", "a closing quote");
        return result;
    }

    void fail(const std::string& what, const std::string& expected) const
    {
        throw protocols::badInput({what, m_where + ", row " + std::to_string(m_line), expected, ""});
    }

    std::string_view m_text;
    std::string m_where;
    std::size_t m_at = 0;
    std::size_t m_line = 1;
};

void requireDistinct(const std::vector<std::string>& header, const std::string& where)
{
    std::set<std::string> seen;
    for (const std::string& name : header)
        if (!seen.insert(name).second)
            throw protocols::badInput(
                {"the column \"" + name + "\" occurs twice", where + ", row 1", "distinct column names", ""});
}

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const
{
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) return std::nullopt;
    return static_cast<std::size_t>(found - header.begin());
}

CsvTable parseCsv(std::string_view text, const std::string& where)
{
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    Reader reader(text, where);
    CsvTable table;
    CsvRow row;
    if (!reader.next(row)) throw protocols::badInput({"the file is empty", where, "a header row and rows of values", ""});
    table.header = row.cells;
    requireDistinct(table.header, where);
    while (reader.next(row)) {
        if (row.cells.size() != table.header.size())
            throw protocols::badInput({"a row has " + std::to_string(row.cells.size()) + " fields",
                                       where + ", row " + std::to_string(row.line),
                                       std::to_string(table.header.size()) + " as in the header", ""});
        table.rows.push_back(row);
    }
    return table;
}

CsvTable readCsv(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    if (!stream || !std::filesystem::is_regular_file(file) || (stream.peek() != EOF && !(text << stream.rdbuf())))
        throw protocols::badInput({"the file cannot be read", file.string(), "a CSV file with a header row", "check the path"});
    return parseCsv(text.str(), file.string());
}

bool isMissing(std::string_view cell) { return cell.empty() || cell == "NA" || cell == "NaN" || cell == "nan"; }

std::optional<double> numberOf(const CsvTable& table, const CsvRow& row, std::size_t column, const std::string& where)
{
    const std::string& cell = row.cells[column];
    if (isMissing(cell)) return std::nullopt;
    const char* begin = cell.data() + (cell.starts_with('+') ? 1 : 0);
    const char* end = cell.data() + cell.size();
    double number = 0;
    const auto parsed = std::from_chars(begin, end, number);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(number))
        throw protocols::badInput({"\"" + cell + "\" is not a number",
                                   where + ", row " + std::to_string(row.line) + ", column " + table.header[column],
                                   "a number, or nothing, NA or NaN for a missing one", ""});
    return number;
}

std::string csvField(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

}  // namespace reports
