// The database files that a store holds open, compared with those that stand in the folder under their names. SQLite would go on
// writing into a file that somebody deleted or replaced, and everything written would be lost with the process.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <utility>

namespace database {

class OpenFiles {
public:
    /// Takes the identities of an open database and its write-ahead log.
    explicit OpenFiles(std::filesystem::path database);

    /// False where one of them is missing now, or is another file.
    bool areInPlace() const;

private:
    using Identity = std::pair<dev_t, ino_t>;
    static std::optional<Identity> identityOf(const std::filesystem::path& file);

    std::filesystem::path m_database, m_log;
    std::optional<Identity> m_databaseIdentity, m_logIdentity;
};

}  // namespace database
