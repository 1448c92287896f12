#include "tests/fuzz/damaged_rows.h"

#include <sqlite3.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace fuzz {

namespace {

constexpr char separator = '\x1f';
constexpr const char* wholeColumn = "*";  ///< in the place of a row
constexpr const char* lostRow = "-";      ///< in the place of a column
constexpr const char* copiedRow = "+";
constexpr int mostRows = 40;
constexpr std::size_t mostDeepRows = 3;
constexpr std::size_t deepLevels = 40'000;  ///< more than recursive functions survive in a program with sanitizers

using Database = std::unique_ptr<sqlite3, decltype(&sqlite3_close)>;
using Statement = std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)>;

Database opened(const std::filesystem::path& file)
{
    sqlite3* database = nullptr;
    if (sqlite3_open(file.c_str(), &database) != SQLITE_OK) throw std::runtime_error("the sound database cannot be opened");
    return {database, sqlite3_close};
}

Statement prepared(const Database& database, const std::string& sql)
{
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database.get(), sql.c_str(), static_cast<int>(sql.size()), &statement, nullptr);
    return {statement, sqlite3_finalize};
}

std::string textAt(const Statement& row, int column)
{
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row.get(), column));
    return text == nullptr ? std::string() : std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(row.get(), column)));
}

/// The first column of the rows.
std::vector<std::string> textsIn(const Database& database, const std::string& sql)
{
    std::vector<std::string> texts;
    const Statement row = prepared(database, sql);
    while (row && sqlite3_step(row.get()) == SQLITE_ROW) texts.push_back(textAt(row, 0));
    return texts;
}

std::string quoted(const std::string& name)
{
    const std::unique_ptr<char, decltype(&sqlite3_free)> text(sqlite3_mprintf("\"%w\"", name.c_str()), sqlite3_free);
    return text.get();
}

constexpr const char* tableNames = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name";

std::string columnNames(const std::string& table) { return "SELECT name FROM pragma_table_info(" + quoted(table) + ")"; }

std::string inputOf(const std::string& table, const std::string& column, const std::string& row, const std::string& value)
{
    return table + separator + column + separator + row + separator + value + separator;
}

/// Two cells at once: the one in the middle of the column and the last one, which is often of a session that goes on.
std::string laterCellsOf(const Database& database, const std::string& table, const std::string& column)
{
    std::string input;
    const auto counts = textsIn(database, "SELECT COUNT(*) FROM " + quoted(table));
    const long long rows = counts.empty() ? 0 : std::atoll(counts.front().c_str());
    for (const long long row : {rows / 2, rows - 1}) {
        if (row < 1) continue;
        const std::string place = std::to_string(row);
        const std::string cell = "SELECT " + quoted(column) + " FROM " + quoted(table) + " LIMIT 1 OFFSET " + place;
        for (const auto& value : textsIn(database, cell)) input += inputOf(table, column, place, value);
    }
    return input;
}

std::vector<std::string> keyColumns(const Database& database, const std::string& table)
{
    return textsIn(database, "SELECT name FROM pragma_table_info(" + quoted(table) + ") WHERE pk > 0 ORDER BY pk");
}

/// "slot, number": what names a row. A table without a primary key has row numbers.
std::string keyOf(const Database& database, const std::string& table)
{
    std::string key;
    for (const auto& column : keyColumns(database, table)) key += (key.empty() ? "" : ", ") + quoted(column);
    return key.empty() ? "rowid" : key;
}

/// Rows that are lost, and rows that come twice, the copy with another last part of its key.
std::vector<std::string> lostAndCopiedOf(const Database& database, const std::string& table)
{
    const auto counts = textsIn(database, "SELECT COUNT(*) FROM " + quoted(table));
    const long long rows = counts.empty() ? 0 : std::atoll(counts.front().c_str());
    std::vector<std::string> inputs;
    long long before = -1;
    for (const long long row : {0LL, rows / 2, rows - 1}) {
        if (row <= before || row >= rows) continue;
        before = row;
        inputs.push_back(inputOf(table, lostRow, std::to_string(row), ""));
        inputs.push_back(inputOf(table, copiedRow, std::to_string(row), std::to_string(rows + 1)));
    }
    if (rows > 1) inputs.push_back(inputOf(table, lostRow, wholeColumn, ""));
    return inputs;
}

/// False for names that a mutation made, and for views.
bool isColumnOfTable(const Database& database, const std::string& table, const std::string& column)
{
    const auto tables = textsIn(database, tableNames), columns = textsIn(database, columnNames(table));
    return std::ranges::find(tables, table) != tables.end() && std::ranges::find(columns, column) != columns.end();
}

void removeRow(const Database& database, const std::string& table, const std::string& row)
{
    const std::string key = keyOf(database, table);
    const std::string one = " WHERE (" + key + ") = (SELECT " + key + " FROM " + quoted(table) + " LIMIT 1 OFFSET ?)";
    const Statement removal = prepared(database, "DELETE FROM " + quoted(table) + (row == wholeColumn ? "" : one));
    if (!removal) return;
    sqlite3_bind_int64(removal.get(), 1, std::atoll(row.c_str()));
    sqlite3_step(removal.get());
}

/// `value`: of the last column of the key.
void copyRow(const Database& database, const std::string& table, const std::string& row, const std::string& value)
{
    const auto keys = keyColumns(database, table);
    std::string columns, values;
    for (const auto& column : textsIn(database, columnNames(table))) {
        columns += (columns.empty() ? "" : ", ") + quoted(column);
        values += (values.empty() ? "" : ", ") + (!keys.empty() && column == keys.back() ? "?2" : quoted(column));
    }
    const Statement copy = prepared(database, "INSERT INTO " + quoted(table) + " (" + columns + ") SELECT " + values + " FROM " +
                                                  quoted(table) + " LIMIT 1 OFFSET ?1");
    if (!copy) return;
    sqlite3_bind_int64(copy.get(), 1, std::atoll(row.c_str()));
    sqlite3_bind_text(copy.get(), 2, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    sqlite3_step(copy.get());
}

void change(const Database& database, const std::string& table, const std::string& column, const std::string& row,
            const std::string& value)
{
    if (column == lostRow) return removeRow(database, table, row);
    if (column == copiedRow) return copyRow(database, table, row, value);
    const std::string key = keyOf(database, table);
    const std::string one = " WHERE (" + key + ") = (SELECT " + key + " FROM " + quoted(table) + " LIMIT 1 OFFSET ?)";
    const Statement update =
        prepared(database, "UPDATE " + quoted(table) + " SET " + quoted(column) + " = ?" + (row == wholeColumn ? "" : one));
    if (!update && isColumnOfTable(database, table, column))
        throw std::runtime_error("column " + column + " of table " + table +
                                 " cannot be changed: " + sqlite3_errmsg(database.get()));
    if (!update) return;
    sqlite3_bind_text(update.get(), 1, value.data(), static_cast<int>(value.size()), SQLITE_TRANSIENT);
    sqlite3_bind_int64(update.get(), 2, std::atoll(row.c_str()));
    sqlite3_step(update.get());
}

}  // namespace

std::string deepJson() { return std::string(deepLevels, '[') + std::string(deepLevels, ']'); }

std::vector<std::string> rowsOf(const std::filesystem::path& file)
{
    const Database database = opened(file);
    std::vector<std::string> inputs, deep;
    for (const auto& table : textsIn(database, tableNames))
        for (const auto& column : textsIn(database, columnNames(table))) {
            const auto values = textsIn(database, "SELECT " + quoted(column) + " FROM " + quoted(table) + " LIMIT " +
                                                      std::to_string(column == "payload" ? mostRows : 1));
            for (std::size_t row = 0; row < values.size(); ++row) {
                inputs.push_back(inputOf(table, column, std::to_string(row), values[row]));
                if (row < mostDeepRows && (values[row].starts_with('{') || values[row].starts_with('[')))
                    deep.push_back(inputOf(table, column, std::to_string(row), deepJson()));
            }
            if (std::string later = laterCellsOf(database, table, column); !later.empty()) inputs.push_back(std::move(later));
        }
    inputs.insert(inputs.begin() + 1, deep.begin(), deep.end());
    for (const auto& table : textsIn(database, tableNames))
        for (auto& input : lostAndCopiedOf(database, table)) inputs.push_back(std::move(input));
    return inputs;
}

std::vector<std::string> knownDamages()
{
    const std::string last = "9223372036854775807", first = "-9223372036854775808";
    return {inputOf("trials", "phase", "11", "2"),
            inputOf("trials", "phase", wholeColumn, "99"),
            inputOf("trials", "number", "5", "99"),
            inputOf("trials", "alternatives", wholeColumn, "[]"),
            inputOf("trials", "alternatives", "0", R"(["ZZ"])"),
            inputOf("trials", "presentation_code", wholeColumn, ""),
            inputOf("responses", "trial", "0", "999"),
            inputOf("responses", "ready_at", wholeColumn, first) + inputOf("responses", "answered_at", wholeColumn, last),
            inputOf("finger_samples", "left_out", wholeColumn, "2147483647"),
            inputOf("participants", "slot", "0", "2147483648"),
            inputOf("study", "planned_balance", "0", R"({"of":5})"),
            inputOf("events", "at_ns", wholeColumn, last),
            inputOf("events", "at_ns", "20", last) + inputOf("events", "at_ns", "21", first),
            inputOf("events", "sequence", "4", last),
            inputOf("events", "sequence", "4", first)};
}

void makeDatabase(const std::filesystem::path& file, const std::string& sql)
{
    const Database database = opened(file);
    if (sqlite3_exec(database.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        throw std::runtime_error(std::string("the sound database cannot be made: ") + sqlite3_errmsg(database.get()));
}

void changeRows(const std::filesystem::path& file, const std::string& input)
{
    const Database database = opened(file);
    for (const char* pragma :
         {"PRAGMA ignore_check_constraints = ON", "PRAGMA foreign_keys = OFF", "PRAGMA synchronous = OFF", "BEGIN"})
        sqlite3_exec(database.get(), pragma, nullptr, nullptr, nullptr);
    for (const auto& trigger : textsIn(database, "SELECT name FROM sqlite_master WHERE type = 'trigger'"))
        sqlite3_exec(database.get(), ("DROP TRIGGER " + quoted(trigger)).c_str(), nullptr, nullptr, nullptr);
    std::vector<std::string> texts;
    for (std::size_t begin = 0, end = input.find(separator); end != std::string::npos; end = input.find(separator, begin)) {
        texts.push_back(input.substr(begin, end - begin));
        begin = end + 1;
    }
    for (std::size_t i = 0; i + 3 < texts.size(); i += 4) change(database, texts[i], texts[i + 1], texts[i + 2], texts[i + 3]);
    sqlite3_exec(database.get(), "COMMIT", nullptr, nullptr, nullptr);
}

}  // namespace fuzz
