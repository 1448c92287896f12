// A SQLite VFS over the default one that counts what reaches the write-ahead log, and can let the disk
// fail. While one exists, every database opened in this process goes through it.
#pragma once

#include <sqlite3.h>

namespace tests::support {

struct LogTraffic {
    int writes = 0;          ///< to a -wal file
    int completedSyncs = 0;  ///< of a -wal file
    int writesSinceSync = 0;
};

class CountingVfs {
public:
    CountingVfs();
    ~CountingVfs();
    CountingVfs(const CountingVfs&) = delete;
    CountingVfs& operator=(const CountingVfs&) = delete;

    LogTraffic traffic() const;
    /// SQLITE_FULL, SQLITE_IOERR_WRITE ...; SQLITE_OK heals the disk.
    void letWritesFailWith(int code);
    void letSyncsFailWith(int code);

private:
    sqlite3_vfs m_vfs;
};

}  // namespace tests::support
