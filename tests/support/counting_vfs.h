// SQLite VFS that wraps the default one, counts writes and syncs of the write-ahead log, can show every operation to a test, and
// can simulate disk faults. While an object exists, every database that this process opens uses it.
#pragma once

#include <sqlite3.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace tests::support {

/// Number of operations on -wal files.
struct LogTraffic {
    int writes = 0;
    int completedSyncs = 0;
    int writesSinceSync = 0;
};

/// One operation that changes a file, in the words of SQLite.
struct DiskOperation {
    enum class Kind { Write, Sync, Truncate, Remove };
    Kind kind;
    std::string file;         ///< its whole path
    std::int64_t offset = 0;  ///< of a write; of a truncation the new size
    std::string bytes;        ///< of a write
};

/// Writes and syncs of all files fail from operation `first` on, counted from 0.
struct DiskFault {
    std::int64_t first = -1;            ///< -1: none fails
    bool lasts = false;                 ///< false: only this one fails
    int ofWrites = SQLITE_IOERR_WRITE;  ///< result code of SQLite
    int ofSyncs = SQLITE_IOERR_FSYNC;
};

class CountingVfs {
public:
    CountingVfs();
    ~CountingVfs();
    CountingVfs(const CountingVfs&) = delete;
    CountingVfs& operator=(const CountingVfs&) = delete;

    LogTraffic traffic() const;
    /// Sets the result of all following writes: SQLITE_FULL, SQLITE_IOERR_WRITE, …; SQLITE_OK lets them work again.
    void letWritesFailWith(int code);
    void letSyncsFailWith(int code);
    /// Statements that begin to read fail from the end of the next sync of a log on, until letReadsWork(): what that sync stored
    /// is stored.
    void letReadsFailAfterNextSync();
    void letReadsWork();
    /// As a file system that maps no memory for several processes.
    void letSharedMemoryFail();

    /// Sets the fault and counts the operations from 0 again.
    void setFault(const DiskFault& fault);
    /// Writes and syncs since the last setFault().
    std::int64_t operations() const;
    /// Lets every sync take this much longer.
    void slowDown(std::chrono::milliseconds sync);
    /// Shows every successful operation; an empty function ends that.
    void showOperations(std::function<void(DiskOperation)> show);

private:
    sqlite3_vfs m_vfs;
};

}  // namespace tests::support
