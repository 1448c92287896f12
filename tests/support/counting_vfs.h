// SQLite VFS that wraps the default one, counts writes and syncs of the write-ahead log, and can simulate disk faults.
// While an object exists, every database that this process opens uses it.
#pragma once

#include <sqlite3.h>

namespace tests::support {

/// Number of operations on -wal files.
struct LogTraffic {
    int writes = 0;
    int completedSyncs = 0;
    int writesSinceSync = 0;
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

private:
    sqlite3_vfs m_vfs;
};

}  // namespace tests::support
