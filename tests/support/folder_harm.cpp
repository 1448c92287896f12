#include "tests/support/folder_harm.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>

#include "protocols/files/whole_file.h"

namespace tests::support {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t pageBytes = 4096;  // of SQLite

constexpr NamedHarm harms[] = {{FolderHarm::DatabaseDeleted, "deleted"},
                               {FolderHarm::DatabaseReplaced, "replaced"},
                               {FolderHarm::DatabaseRenamed, "renamed"},
                               {FolderHarm::LogDeleted, "log deleted"},
                               {FolderHarm::FolderMoved, "folder moved"},
                               {FolderHarm::DatabaseEmptied, "emptied in place"},
                               {FolderHarm::DatabaseOverwritten, "overwritten in place"},
                               {FolderHarm::LogEmptied, "log emptied in place"},
                               {FolderHarm::LogOverwritten, "log overwritten in place"},
                               {FolderHarm::BothEmptied, "database and log emptied in place"}};

fs::path asideOf(const database::StudyFolder& folder) { return folder.folder.string() + "-aside"; }
fs::path logOf(const database::StudyFolder& folder) { return folder.database().string() + "-wal"; }

/// Keeps the file and replaces its bytes behind the first `kept`, as `cat other > file` does.
void overwriteInPlace(const fs::path& file, std::size_t kept)
{
    std::string bytes = protocols::readWholeFile(file);
    if (bytes.size() > kept)
        std::rotate(bytes.begin() + static_cast<long>(kept), bytes.begin() + static_cast<long>(kept + (bytes.size() - kept) / 2),
                    bytes.end());
    std::ofstream(file, std::ios::binary | std::ios::in | std::ios::out) << bytes;
}

void emptyInPlace(const fs::path& file) { std::ofstream(file, std::ios::binary | std::ios::trunc); }

}  // namespace

std::span<const NamedHarm> folderHarms() { return harms; }

void doHarm(FolderHarm harm, const database::StudyFolder& folder)
{
    switch (harm) {
        case FolderHarm::DatabaseDeleted:
            fs::remove(folder.database());
            return;
        case FolderHarm::DatabaseReplaced:
            fs::remove(folder.database());
            protocols::writeWholeFile(folder.database(), "something else");
            return;
        case FolderHarm::DatabaseRenamed:
            fs::rename(folder.database(), asideOf(folder));
            return;
        case FolderHarm::LogDeleted:
            fs::remove(logOf(folder));
            return;
        case FolderHarm::FolderMoved:
            fs::rename(folder.folder, asideOf(folder));
            return;
        case FolderHarm::DatabaseEmptied:
            emptyInPlace(folder.database());
            return;
        case FolderHarm::DatabaseOverwritten:
            overwriteInPlace(folder.database(), pageBytes);
            return;
        case FolderHarm::LogEmptied:
            emptyInPlace(logOf(folder));
            return;
        case FolderHarm::LogOverwritten:
            overwriteInPlace(logOf(folder), 0);
            return;
        case FolderHarm::BothEmptied:
            emptyInPlace(folder.database());
            emptyInPlace(logOf(folder));
            return;
    }
}

void putRight(FolderHarm harm, const database::StudyFolder& folder)
{
    if (harm == FolderHarm::FolderMoved) {
        fs::rename(asideOf(folder), folder.folder);
        return;
    }
    if (harm >= FolderHarm::DatabaseEmptied) return;
    std::error_code none;
    fs::remove(folder.database(), none);
}

}  // namespace tests::support
