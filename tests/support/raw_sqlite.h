// SQL on a database file without the program's own code, as an intruder or a script of a laboratory would use it.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace tests::support {

class RawSqlite {
public:
    explicit RawSqlite(const std::filesystem::path& file)
    {
        if (sqlite3_open_v2(file.c_str(), &m_connection, SQLITE_OPEN_READWRITE, nullptr) != SQLITE_OK)
            throw std::runtime_error("cannot open " + file.string());
    }
    ~RawSqlite() { sqlite3_close(m_connection); }
    RawSqlite(const RawSqlite&) = delete;
    RawSqlite& operator=(const RawSqlite&) = delete;

    /// Runs a statement and returns the error message; empty if there is no error.
    std::string run(const std::string& sql)
    {
        return sqlite3_exec(m_connection, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK ? ""
                                                                                               : sqlite3_errmsg(m_connection);
    }

    /// Rows of the result, with cells joined by "|". A NULL cell is empty.
    std::vector<std::string> rows(const std::string& sql)
    {
        std::vector<std::string> lines;
        const auto collect = [](void* out, int columns, char** cells, char**) {
            std::string line;
            for (int i = 0; i < columns; ++i) line += (i ? "|" : "") + std::string(cells[i] ? cells[i] : "");
            static_cast<std::vector<std::string>*>(out)->push_back(line);
            return 0;
        };
        if (sqlite3_exec(m_connection, sql.c_str(), collect, &lines, nullptr) != SQLITE_OK)
            throw std::runtime_error(sqlite3_errmsg(m_connection));
        return lines;
    }

    void dropTriggers()
    {
        for (const std::string& name : rows("SELECT name FROM sqlite_master WHERE type = 'trigger'"))
            run("DROP TRIGGER \"" + name + "\"");
    }

private:
    sqlite3* m_connection = nullptr;
};

/// Gives a study a name that earlier versions took, for instance of two lines.
inline void renameAsBefore(const std::filesystem::path& database, const std::string& name)
{
    std::string quoted;
    for (const char c : name) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    RawSqlite sqlite(database);
    sqlite.dropTriggers();
    const std::string fault = sqlite.run("UPDATE study SET name = '" + quoted +
                                         "', protocol_json = json_set(protocol_json, '$.name', '" + quoted + "')");
    if (!fault.empty()) throw std::runtime_error(fault);
}

}  // namespace tests::support
