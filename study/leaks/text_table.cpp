#include "study/leaks/text_table.h"

#include <QSqlRecord>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "database/schema.h"
#include "database/sqlite_connection.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"

namespace study::leaks {

namespace {

namespace fs = std::filesystem;
using database::SqliteConnection;
using nlohmann::json;

TextTable tableInDatabase(const SqliteConnection& sqlite, const QString& name, const QString& columns)
{
    QSqlQuery query = sqlite.run(QStringLiteral("SELECT %1 FROM \"%2\"").arg(columns, name));
    TextTable table{database::fromQt(name), {}, {}};
    const QSqlRecord record = query.record();
    for (int column = 0; column < record.count(); ++column) table.columns.push_back(record.fieldName(column).toStdString());
    while (query.next()) {
        auto& row = table.rows.emplace_back();
        for (int column = 0; column < record.count(); ++column) row.push_back(database::fromQt(query.value(column)));
    }
    return table;
}

bool isWithoutRowid(const QString& sql) { return sql.contains(QStringLiteral("WITHOUT ROWID")); }

std::string textOfCell(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// A file with more columns, or more cells in all, is no export: it is read as lines.
constexpr std::size_t mostColumns = 400;
constexpr std::size_t mostCells = 30'000'000;

/// Bytes kept of a line with a word.
constexpr std::size_t longestLine = 4096;

/// The plain fields of an object and of the objects around it.
using Fields = std::vector<std::pair<std::string, std::string>>;

/// One field too many says that there are more than `mostColumns`.
Fields fieldsOf(const json& object, Fields around)
{
    for (const auto& [name, value] : object.items())
        if (!value.is_object() && !(value.is_array() && !value.empty() && value.front().is_object())) {
            if (around.size() > mostColumns) break;
            std::erase_if(around, [&, &key = name](const auto& field) { return field.first == key; });
            around.emplace_back(name, textOfCell(value));
        }
    return around;
}

/// The arrays of objects of one JSON file as tables.
class TablesOfJson {
public:
    /// None where the file has too many columns or cells.
    static std::optional<std::vector<TextTable>> of(const json& content, const std::string& name)
    {
        TablesOfJson reader;
        if (!reader.collect(content, name, {})) return std::nullopt;
        return std::move(reader.m_tables);
    }

private:
    bool collect(const json& value, const std::string& name, const Fields& around)
    {
        if (value.is_object()) {
            const Fields fields = fieldsOf(value, around);
            if (fields.size() > mostColumns) return false;
            for (const auto& [key, inner] : value.items())
                if (inner.is_structured() && !collect(inner, name + "/" + key, fields)) return false;
            return true;
        }
        TextTable table{name, {}, {}};
        std::map<std::string, std::size_t> places;
        for (const auto& item : value) {
            if (!item.is_object()) continue;
            if (!addRow(table, places, fieldsOf(item, around)) || !collect(item, name, around)) return false;
        }
        for (auto& row : table.rows) row.resize(table.columns.size());
        m_cells += table.rows.size() * table.columns.size();
        if (!table.rows.empty()) m_tables.push_back(std::move(table));
        return true;
    }

    bool addRow(TextTable& table, std::map<std::string, std::size_t>& places, const Fields& fields)
    {
        std::vector<std::string> row(table.columns.size());
        for (const auto& [name, value] : fields) {
            const auto [place, isNew] = places.emplace(name, table.columns.size());
            if (isNew) {
                table.columns.push_back(name);
                row.emplace_back();
            }
            row.at(place->second) = value;
        }
        table.rows.push_back(std::move(row));
        return table.columns.size() <= mostColumns && m_cells + table.rows.size() * table.columns.size() <= mostCells;
    }

    std::vector<TextTable> m_tables;
    std::size_t m_cells = 0;  ///< of `m_tables`
};

/// One row for each word in each line.
TextTable linesWith(const std::set<std::string>& words, const std::string& text, const std::string& name)
{
    TextTable table{name, {"presentation_code", "line"}, {}};
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        for (std::size_t at = 0; at < line.size();) {
            const auto isLetter = [&](std::size_t i) { return std::isalnum(static_cast<unsigned char>(line[i])) != 0; };
            std::size_t end = at;
            while (end < line.size() && isLetter(end)) ++end;
            if (const auto word = line.substr(at, end - at); words.contains(word))
                table.rows.push_back({word, line.substr(0, longestLine)});
            at = end + 1;
        }
    return table;
}

std::vector<TextTable> tablesOfFile(const fs::path& file, const std::string& name, const std::set<std::string>& words)
{
    const std::string text = protocols::readIfPossible(file).value_or("");
    std::vector<TextTable> tables;
    if (file.extension() == ".csv") try {
            auto csv = protocols::csvTableFrom(text, name);
            return {{name, std::move(csv.columns), std::move(csv.rows)}};
        } catch (const protocols::Error&) {
            // Read as lines below.
        }
    if (const auto content = protocols::storedJson(text); content.is_structured())
        if (auto found = TablesOfJson::of(content, name)) return *std::move(found);
    if (auto lines = linesWith(words, text, name); !lines.rows.empty()) tables.push_back(std::move(lines));
    return tables;
}

}  // namespace

std::optional<std::size_t> TextTable::column(const std::string& wanted) const
{
    const auto found = std::ranges::find(columns, wanted);
    return found == columns.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - columns.begin()));
}

std::vector<TextTable> tablesOfDatabase(const fs::path& file)
{
    const SqliteConnection sqlite(file, SqliteConnection::Mode::Read);
    for (const auto& fault : database::faultsOfSchema(sqlite))
        if (fault.find(": the view ") != std::string::npos)
            throw protocols::workFailed({fault, file.string(), "the views that this program makes, because others may never end",
                                         "see `vis2hap verify`, and remove the view"});
    std::vector<TextTable> tables;
    QSqlQuery names = sqlite.run(QStringLiteral("SELECT name, type, sql FROM sqlite_master WHERE type IN ('table', 'view')"));
    while (names.next()) {
        const bool hasRowid = names.value(1).toString() == "table" && !isWithoutRowid(names.value(2).toString());
        tables.push_back(tableInDatabase(sqlite, names.value(0).toString(),
                                         hasRowid ? QStringLiteral("rowid AS rowid, *") : QStringLiteral("*")));
    }
    return tables;
}

std::vector<TextTable> tablesOfFolder(const fs::path& folder, const std::set<std::string>& words, const std::set<fs::path>& left)
{
    std::vector<TextTable> tables;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const fs::path name = entry.path().lexically_relative(folder);
        if (!entry.is_regular_file() || left.contains(name) || left.contains(*name.begin())) continue;
        for (auto& table : tablesOfFile(entry.path(), name.string(), words)) tables.push_back(std::move(table));
    }
    std::ranges::sort(tables, {}, &TextTable::name);
    return tables;
}

}  // namespace study::leaks
