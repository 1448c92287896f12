#include "tests/support/counting_vfs.h"

#include <cstring>
#include <new>
#include <thread>

namespace tests::support {

namespace {

// SQLite's callbacks cannot carry an object of ours, so the state is global to the process.
struct SharedState {
    sqlite3_vfs* real = nullptr;
    LogTraffic traffic;
    int writeFault = SQLITE_OK;
    int syncFault = SQLITE_OK;
    bool hasSharedMemory = true;
    bool readsFail = false, readsFailAfterSync = false;
    DiskFault fault;
    std::int64_t operations = 0;
    std::chrono::milliseconds delay{0};
    std::function<void(DiskOperation)> show;
} shared;

/// Our part of an open file. The real file follows it in the memory that SQLite allocates.
struct File {
    sqlite3_file base;
    bool isLog;
    const char* name;  ///< SQLite keeps it until the file is closed; null for temporary files
};

sqlite3_file* realOf(sqlite3_file* file) { return reinterpret_cast<sqlite3_file*>(reinterpret_cast<File*>(file) + 1); }
const char* nameOf(sqlite3_file* file) { return reinterpret_cast<File*>(file)->name; }
bool isLog(sqlite3_file* file) { return reinterpret_cast<File*>(file)->isLog; }
const sqlite3_io_methods& methodsOf(sqlite3_file* file) { return *realOf(file)->pMethods; }

/// Counts an operation. True if it must fail.
bool failsNow()
{
    const std::int64_t number = shared.operations++;
    return shared.fault.first >= 0 && (shared.fault.lasts ? number >= shared.fault.first : number == shared.fault.first);
}

/// Shows an operation of a named file, if it succeeded.
int shown(int result, const char* name, DiskOperation::Kind kind, std::int64_t offset = 0, std::string bytes = {})
{
    if (result == SQLITE_OK && shared.show && name) shared.show({kind, name, offset, std::move(bytes)});
    return result;
}

int writeFile(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset)
{
    if (shared.writeFault != SQLITE_OK) return shared.writeFault;
    if (failsNow()) return shared.fault.ofWrites;
    if (isLog(file)) {
        ++shared.traffic.writes;
        ++shared.traffic.writesSinceSync;
    }
    const int result = methodsOf(file).xWrite(realOf(file), bytes, count, offset);
    if (!shared.show) return result;
    return shown(result, nameOf(file), DiskOperation::Kind::Write, offset,
                 std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(count)));
}

int syncFile(sqlite3_file* file, int flags)
{
    if (shared.syncFault != SQLITE_OK) return shared.syncFault;
    if (failsNow()) return shared.fault.ofSyncs;
    std::this_thread::sleep_for(shared.delay);
    const int result = methodsOf(file).xSync(realOf(file), flags);
    if (result == SQLITE_OK && isLog(file)) {
        ++shared.traffic.completedSyncs;
        shared.traffic.writesSinceSync = 0;
        shared.readsFail = shared.readsFail || shared.readsFailAfterSync;
    }
    return shown(result, nameOf(file), DiskOperation::Kind::Sync);
}

int truncateFile(sqlite3_file* file, sqlite3_int64 size)
{
    return shown(methodsOf(file).xTruncate(realOf(file), size), nameOf(file), DiskOperation::Kind::Truncate, size);
}

int removeFile(sqlite3_vfs*, const char* name, int syncsFolder)
{
    return shown(shared.real->xDelete(shared.real, name, syncsFolder), name, DiskOperation::Kind::Remove);
}

const sqlite3_io_methods countingMethods = {
    2,
    [](sqlite3_file* f) { return methodsOf(f).xClose(realOf(f)); },
    [](sqlite3_file* f, void* bytes, int count, sqlite3_int64 offset) {
        return methodsOf(f).xRead(realOf(f), bytes, count, offset);
    },
    writeFile,
    truncateFile,
    syncFile,
    [](sqlite3_file* f, sqlite3_int64* size) { return methodsOf(f).xFileSize(realOf(f), size); },
    [](sqlite3_file* f, int level) { return methodsOf(f).xLock(realOf(f), level); },
    [](sqlite3_file* f, int level) { return methodsOf(f).xUnlock(realOf(f), level); },
    [](sqlite3_file* f, int* held) { return methodsOf(f).xCheckReservedLock(realOf(f), held); },
    [](sqlite3_file* f, int operation, void* argument) { return methodsOf(f).xFileControl(realOf(f), operation, argument); },
    [](sqlite3_file* f) { return methodsOf(f).xSectorSize(realOf(f)); },
    [](sqlite3_file* f) { return methodsOf(f).xDeviceCharacteristics(realOf(f)); },
    [](sqlite3_file* f, int page, int size, int extend, void volatile** memory) {
        return shared.hasSharedMemory ? methodsOf(f).xShmMap(realOf(f), page, size, extend, memory) : SQLITE_IOERR_SHMMAP;
    },
    [](sqlite3_file* f, int offset, int count, int flags) {
        constexpr int asReader = SQLITE_SHM_LOCK | SQLITE_SHM_SHARED;
        return shared.readsFail && flags == asReader ? SQLITE_IOERR_READ : methodsOf(f).xShmLock(realOf(f), offset, count, flags);
    },
    [](sqlite3_file* f) { methodsOf(f).xShmBarrier(realOf(f)); },
    [](sqlite3_file* f, int deleteFlag) { return methodsOf(f).xShmUnmap(realOf(f), deleteFlag); },
    nullptr,
    nullptr,
};

int openFile(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* outFlags)
{
    auto* counting = new (file) File{{nullptr}, (flags & SQLITE_OPEN_WAL) != 0, name};
    const int result = shared.real->xOpen(shared.real, name, realOf(file), flags, outFlags);
    if (realOf(file)->pMethods) counting->base.pMethods = &countingMethods;
    return result;
}

}  // namespace

CountingVfs::CountingVfs()
{
    shared = {};
    shared.real = sqlite3_vfs_find(nullptr);
    m_vfs = *shared.real;
    m_vfs.pNext = nullptr;
    m_vfs.zName = "counting";
    m_vfs.szOsFile = static_cast<int>(sizeof(File)) + shared.real->szOsFile;
    m_vfs.xOpen = openFile;
    m_vfs.xDelete = removeFile;
    sqlite3_vfs_register(&m_vfs, 1);
}

CountingVfs::~CountingVfs()
{
    sqlite3_vfs_unregister(&m_vfs);
    sqlite3_vfs_register(shared.real, 1);
}

LogTraffic CountingVfs::traffic() const { return shared.traffic; }
void CountingVfs::letReadsFailAfterNextSync() { shared.readsFailAfterSync = true; }

void CountingVfs::letReadsWork() { shared.readsFail = shared.readsFailAfterSync = false; }

void CountingVfs::letWritesFailWith(int code) { shared.writeFault = code; }
void CountingVfs::letSyncsFailWith(int code) { shared.syncFault = code; }
void CountingVfs::letSharedMemoryFail() { shared.hasSharedMemory = false; }

void CountingVfs::setFault(const DiskFault& fault)
{
    shared.fault = fault;
    shared.operations = 0;
}

std::int64_t CountingVfs::operations() const { return shared.operations; }
void CountingVfs::slowDown(std::chrono::milliseconds sync) { shared.delay = sync; }
void CountingVfs::showOperations(std::function<void(DiskOperation)> show) { shared.show = std::move(show); }

}  // namespace tests::support
