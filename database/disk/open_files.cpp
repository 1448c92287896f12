#include "database/disk/open_files.h"

#include <cerrno>
#include <cstring>
#include <string>

namespace database {

OpenFiles::OpenFiles(std::filesystem::path database, sqlite3* connection)
    : m_database(std::move(database)),
      m_log(m_database.string() + "-wal"),
      m_databaseStatus(statusOf(m_database)),
      m_logStatus(statusOf(m_log)),
      m_raw(connection)
{
    if (m_reason != 0) throw unseen();
    takeCopy();
}

OpenFiles::Status OpenFiles::statusOf(const std::filesystem::path& file)
{
    struct ::stat status {};
    if (::stat(file.c_str(), &status) == 0) return status;
    if (errno != ENOENT && errno != ENOTDIR) m_reason = errno;
    return std::nullopt;
}

bool OpenFiles::hasDatabaseInPlace() { return isSameFile(statusOf(m_database), m_databaseStatus); }

protocols::Error OpenFiles::unseen() const
{
    return protocols::environmentFault(
        {std::string("the file system does not say whether the database is in its place (") + std::strerror(m_reason) + ")",
         m_database.string(), "a disk or a network share that answers", "check it and do the step again"});
}

bool OpenFiles::isSameFile(const Status& one, const Status& other)
{
    return one && other && one->st_dev == other->st_dev && one->st_ino == other->st_ino;
}

bool OpenFiles::isUntouched(const Status& one, const Status& other)
{
    const auto isSameTime = [](const timespec& a, const timespec& b) { return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec; };
    return isSameFile(one, other) && one->st_size == other->st_size && isSameTime(one->st_mtim, other->st_mtim) &&
           isSameTime(one->st_ctim, other->st_ctim);
}

void OpenFiles::takeCopy()
{
    if (const Status now = statusOf(m_database); isSameFile(now, m_databaseStatus)) m_databaseStatus = now;
    if (const Status now = statusOf(m_log); isSameFile(now, m_logStatus)) m_logStatus = now;
    if (m_raw.isThere()) m_copy.emplace(m_raw);
}

void OpenFiles::letCopyGo()
{
    if (m_copy) m_copy->letGo();
}

void OpenFiles::giveUp(bool isKept)
{
    if (!m_raw.isThere()) return;
    m_raw.leaveLogAlone();
    if (isKept && isSameFile(statusOf(m_log), m_logStatus)) m_raw.emptyLog();
}

OpenFiles::State OpenFiles::state()
{
    // Times only say where to look: the bytes decide, because backups and other readers may change times.
    m_reason = 0;
    const Status database = statusOf(m_database), log = statusOf(m_log);
    const bool areSame = isSameFile(database, m_databaseStatus) && isSameFile(log, m_logStatus);
    const PageCopy::Touched touched{areSame && !isUntouched(database, m_databaseStatus),
                                    areSame && !isUntouched(log, m_logStatus)};
    const bool holdBytes = !m_copy || m_copy->follow(touched);
    if (m_reason != 0) return State::Unseen;
    if (!areSame) return State::Gone;
    if (!holdBytes) return State::Overwritten;
    m_databaseStatus = database;
    m_logStatus = log;
    return State::InPlace;
}

}  // namespace database
