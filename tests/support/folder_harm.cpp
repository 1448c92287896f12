#include "tests/support/folder_harm.h"

#include <system_error>

#include "protocols/files/whole_file.h"

namespace tests::support {

namespace {

namespace fs = std::filesystem;

constexpr NamedHarm harms[] = {{FolderHarm::DatabaseDeleted, "deleted"},
                               {FolderHarm::DatabaseReplaced, "replaced"},
                               {FolderHarm::DatabaseRenamed, "renamed"},
                               {FolderHarm::LogDeleted, "log deleted"},
                               {FolderHarm::FolderMoved, "folder moved"}};

fs::path asideOf(const database::StudyFolder& folder) { return folder.folder.string() + "-aside"; }

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
            fs::remove(folder.database().string() + "-wal");
            return;
        case FolderHarm::FolderMoved:
            fs::rename(folder.folder, asideOf(folder));
            return;
    }
}

void putRight(FolderHarm harm, const database::StudyFolder& folder)
{
    if (harm == FolderHarm::FolderMoved) {
        fs::rename(asideOf(folder), folder.folder);
        return;
    }
    std::error_code none;
    fs::remove(folder.database(), none);
}

}  // namespace tests::support
