// The bytes of an open SQLite database as they stand on the disk, read through SQLite's own open files: a second descriptor of
// the database would drop SQLite's locks when it is closed. The state of the write-ahead log comes from its index in shared
// memory, so it is what SQLite committed, whatever became of the file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

struct sqlite3;
struct sqlite3_file;

namespace database {

/// What SQLite holds of the write-ahead log (https://www.sqlite.org/walformat.html).
struct LogState {
    std::uint32_t frames = 0;                    ///< committed ones
    std::uint32_t backfilled = 0;                ///< frames that the database file holds already
    std::uint32_t pages = 0;                     ///< of the database after the last commit
    std::uint32_t pageBytes = 0;                 ///< 0 before the first commit
    bool isBigEndian = false;                    ///< the words that checksums add
    std::array<std::uint32_t, 2> checksum = {};  ///< of everything up to the last frame
    std::array<char, 8> salt = {};               ///< drawn anew each time the log begins again
    bool operator==(const LogState&) const = default;
};

class RawDatabase {
public:
    /// `connection`: has read from the database, which has a write-ahead log; null where there is no way to its files.
    explicit RawDatabase(sqlite3* connection);

    /// False where SQLite shows no files; the other functions must not be called then.
    bool isThere() const { return m_database && m_log; }

    /// Empty while another process writes it.
    std::optional<LogState> logState() const;

    std::int64_t databaseBytes() const;

    /// False where the disk reports an error. Bytes behind the end of the file are zero, as SQLite takes them.
    bool readDatabase(std::int64_t offset, std::span<char> bytes) const;
    /// False also where the file ends before.
    bool readLog(std::int64_t offset, std::span<char> bytes) const;

    /// Lets SQLite end without copying the log into the database: both hold bytes of different origin.
    void leaveLogAlone() const;
    void emptyLog() const;

private:
    sqlite3* m_connection;
    sqlite3_file* m_database = nullptr;
    sqlite3_file* m_log = nullptr;
};

}  // namespace database
