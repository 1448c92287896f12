#include "database/disk/raw_database.h"

#include <sqlite3.h>

#include <cstring>

namespace database {

namespace {

constexpr int indexBytes = 32768;  // of the first part of the log's index in shared memory
constexpr std::size_t stateBytes = 48;
constexpr int mostStateReads = 100;

sqlite3_file* fileOf(sqlite3* connection, int which)
{
    sqlite3_file* file = nullptr;
    const bool isShown = sqlite3_file_control(connection, "main", which, &file) == SQLITE_OK;
    return isShown && file && file->pMethods ? file : nullptr;
}

template <class Value>
Value valueAt(const std::array<char, stateBytes>& bytes, std::size_t place)
{
    Value value{};
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
}

LogState stateFrom(const std::array<char, stateBytes>& bytes)
{
    LogState state;
    const auto shortSize = valueAt<std::uint16_t>(bytes, 14);
    state.isBigEndian = bytes[13] != 0;
    state.pageBytes = (shortSize & 0xfe00u) + ((shortSize & 1u) << 16);
    state.frames = valueAt<std::uint32_t>(bytes, 16);
    state.pages = valueAt<std::uint32_t>(bytes, 20);
    state.checksum = valueAt<std::array<std::uint32_t, 2>>(bytes, 24);
    state.salt = valueAt<std::array<char, 8>>(bytes, 32);
    return state;
}

}  // namespace

RawDatabase::RawDatabase(sqlite3* connection) : m_connection(connection)
{
    if (!connection) return;
    m_database = fileOf(connection, SQLITE_FCNTL_FILE_POINTER);
    m_log = fileOf(connection, SQLITE_FCNTL_JOURNAL_POINTER);
    if (m_database && (m_database->pMethods->iVersion < 2 || !m_database->pMethods->xShmMap)) m_database = nullptr;
}

std::optional<LogState> RawDatabase::logState() const
{
    void volatile* index = nullptr;
    if (m_database->pMethods->xShmMap(m_database, 0, indexBytes, 0, &index) != SQLITE_OK || !index) return std::nullopt;
    const auto* shared = static_cast<const volatile char*>(index);
    // SQLite writes two copies, one after the other. A reader takes them where they agree.
    for (int attempt = 0; attempt < mostStateReads; ++attempt) {
        std::array<char, stateBytes> first{}, second{};
        for (std::size_t i = 0; i < stateBytes; ++i) first[i] = shared[i];
        m_database->pMethods->xShmBarrier(m_database);
        for (std::size_t i = 0; i < stateBytes; ++i) second[i] = shared[stateBytes + i];
        if (first != second || first[12] == 0) continue;
        LogState state = stateFrom(first);
        std::array<char, sizeof state.backfilled> word{};
        for (std::size_t i = 0; i < word.size(); ++i) word[i] = shared[2 * stateBytes + i];
        std::memcpy(&state.backfilled, word.data(), word.size());
        return state;
    }
    return std::nullopt;
}

std::int64_t RawDatabase::databaseBytes() const
{
    sqlite3_int64 bytes = 0;
    return m_database->pMethods->xFileSize(m_database, &bytes) == SQLITE_OK ? bytes : 0;
}

bool RawDatabase::readDatabase(std::int64_t offset, std::span<char> bytes) const
{
    const int result = m_database->pMethods->xRead(m_database, bytes.data(), static_cast<int>(bytes.size()), offset);
    return result == SQLITE_OK || result == SQLITE_IOERR_SHORT_READ;
}

bool RawDatabase::readLog(std::int64_t offset, std::span<char> bytes) const
{
    return m_log->pMethods && m_log->pMethods->xRead(m_log, bytes.data(), static_cast<int>(bytes.size()), offset) == SQLITE_OK;
}

void RawDatabase::leaveLogAlone() const { sqlite3_db_config(m_connection, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr); }

void RawDatabase::emptyLog() const
{
    if (m_log->pMethods) m_log->pMethods->xTruncate(m_log, 0);
}

}  // namespace database
