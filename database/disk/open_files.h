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
#include "protocols/files/errors.h"

namespace database {

class OpenFiles {
public:
    /// Takes the identities of an open database and its write-ahead log, and a copy of what they hold (page_copy.h).
    /// `connection`: as RawDatabase takes it. Throws unseen().
    OpenFiles(std::filesystem::path database, sqlite3* connection);
    OpenFiles(const OpenFiles&) = delete;
    OpenFiles& operator=(const OpenFiles&) = delete;

    enum class State {
        InPlace,
        Gone,         ///< one of them is missing now, or is another file
        Overwritten,  ///< they are the same files, but hold other bytes than SQLite wrote
        Unseen,       ///< the file system reports an error; it may have lost its server for a moment
    };
    State state();
    /// Whether the file under the database's name is the open one, whatever became of its log.
    bool hasDatabaseInPlace();
    /// The environmentFault for State::Unseen.
    protocols::Error unseen() const;

    /// The whole database as of the last state(); null where it was not kept.
    const PageCopy* copy() const { return m_copy && m_copy->isWhole() ? &*m_copy : nullptr; }
    /// From now on only the end of the log is compared: for many commits of simulated participants.
    void letCopyGo();
    /// Takes the copy anew, after a change that rewrote the database.
    void takeCopy();

    /// Leaves the files as they are when the connection is closed. `isKept`: a rescue file holds what the log holds. A log that
    /// still stands in its place is then emptied: SQLite would add it to whatever database stands there.
    void giveUp(bool isKept);

private:
    using Status = std::optional<struct ::stat>;
    /// Empty where no such file is there. Sets m_reason where the file system does not say.
    Status statusOf(const std::filesystem::path& file);
    static bool isSameFile(const Status& one, const Status& other);
    static bool isUntouched(const Status& one, const Status& other);

    std::filesystem::path m_database, m_log;
    int m_reason = 0;                      ///< the errno of State::Unseen
    Status m_databaseStatus, m_logStatus;  ///< when they were last found in place
    RawDatabase m_raw;
    std::optional<PageCopy> m_copy;
};

}  // namespace database
