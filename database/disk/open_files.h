// The database files that a store holds open, compared with those that stand in the folder under their names. SQLite would go on
// writing into a file that somebody deleted, replaced or overwrote, and everything written would be lost with the process.
#pragma once

#include <sys/stat.h>
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <utility>

#include "database/disk/page_copy.h"
#include "database/disk/raw_database.h"

namespace database {

class OpenFiles {
public:
    /// Takes the identities of an open database and its write-ahead log, and a copy of what they hold (page_copy.h).
    /// `connection`: as RawDatabase takes it.
    OpenFiles(std::filesystem::path database, sqlite3* connection);
    OpenFiles(const OpenFiles&) = delete;
    OpenFiles& operator=(const OpenFiles&) = delete;

    enum class State {
        InPlace,
        Gone,         ///< one of them is missing now, or is another file
        Overwritten,  ///< they are the same files, but hold other bytes than SQLite wrote
    };
    State state();

    /// The whole database as of the last state(); null where it was not kept.
    const PageCopy* copy() const { return m_copy && m_copy->isWhole() ? &*m_copy : nullptr; }
    /// From now on only the end of the log is compared: for many commits of simulated participants.
    void letCopyGo();
    /// Takes the copy anew, after a change that rewrote the database.
    void takeCopy();

    /// Leaves overwritten files as they are when the connection is closed. `isKept`: a rescue file holds what the log holds, so
    /// that the log can be emptied.
    void giveUp(bool isKept) const;

private:
    using Status = std::optional<struct ::stat>;
    static Status statusOf(const std::filesystem::path& file);
    static bool isSameFile(const Status& one, const Status& other);
    static bool isUntouched(const Status& one, const Status& other);

    std::filesystem::path m_database, m_log;
    Status m_databaseStatus, m_logStatus;  ///< when they were last found in place
    RawDatabase m_raw;
    std::optional<PageCopy> m_copy;
};

}  // namespace database
