#include "database/disk/room_to_write.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "protocols/files/errors.h"
#include "protocols/files/temporary_folder.h"

namespace database {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t spareBytes = std::uintmax_t{1} << 20;

protocols::Error noRoom(const fs::path& place, std::uintmax_t bytes, int reason)
{
    return protocols::environmentFault(
        {std::string("there is no room to write the database anew") +
             (reason == EDQUOT ? ", because the quota of this account is used up" : ""),
         place.string(), std::to_string(bytes / spareBytes + 1) + " MB there and in the folder for temporary files",
         "make room and run the command again; nothing was erased"});
}

/// Where SQLite writes its temporary files, by its documentation.
fs::path temporaryFolderOfSqlite()
{
    const char* const places[] = {std::getenv("SQLITE_TMPDIR"), std::getenv("TMPDIR"), "/var/tmp", "/usr/tmp", "/tmp"};
    for (const char* place : places)
        if (std::error_code none; place && fs::is_directory(place, none) && ::access(place, W_OK | X_OK) == 0) return place;
    return ".";
}

dev_t deviceOf(const fs::path& folder)
{
    struct stat status {};
    return ::stat(folder.c_str(), &status) == 0 ? status.st_dev : dev_t{};
}

}  // namespace

void requireRoomToWriteAnew(const fs::path& database)
{
    const fs::path folder = database.parent_path(), temporary = temporaryFolderOfSqlite();
    std::error_code unknown;
    const std::uintmax_t once = fs::file_size(database, unknown) + spareBytes;
    const bool isOneDisk = deviceOf(folder) == deviceOf(temporary);
    for (const auto& place : {folder, temporary}) {
        const std::uintmax_t needed = isOneDisk ? 2 * once : once;
        const auto room = fs::space(place, unknown);
        // Only an attempt shows the quota of an account.
        const int reason = !unknown && room.available < needed ? ENOSPC : protocols::reasonAgainstRoom(place, needed);
        if (reason != 0) throw noRoom(place, needed, reason);
    }
}

}  // namespace database
