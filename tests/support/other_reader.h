// Another program that holds a state of a study.
#pragma once

#include <sqlite3.h>

#include <QtGlobal>
#include <filesystem>

namespace tests::support {

/// Another program that reads the database and keeps its state.
class Reader {
public:
    explicit Reader(const std::filesystem::path& file)
    {
        if (sqlite3_open(file.c_str(), &m_database) != SQLITE_OK) qFatal("cannot open");
        sqlite3_exec(m_database, "BEGIN; SELECT COUNT(*) FROM responses", nullptr, nullptr, nullptr);
    }
    ~Reader() { sqlite3_close(m_database); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

private:
    sqlite3* m_database = nullptr;
};

}  // namespace tests::support
