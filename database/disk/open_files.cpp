#include "database/disk/open_files.h"

#include <sys/stat.h>

namespace database {

OpenFiles::OpenFiles(std::filesystem::path database)
    : m_database(std::move(database)),
      m_log(m_database.string() + "-wal"),
      m_databaseIdentity(identityOf(m_database)),
      m_logIdentity(identityOf(m_log))
{
}

std::optional<OpenFiles::Identity> OpenFiles::identityOf(const std::filesystem::path& file)
{
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return Identity{status.st_dev, status.st_ino};
}

bool OpenFiles::areInPlace() const
{
    return m_databaseIdentity && m_logIdentity && identityOf(m_database) == m_databaseIdentity &&
           identityOf(m_log) == m_logIdentity;
}

}  // namespace database
