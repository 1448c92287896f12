#include "database/rescue.h"

#include <sys/stat.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "database/audit.h"
#include "database/schema.h"
#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

namespace fs = std::filesystem;

constexpr int mostFiles = 1000;

std::string nameOf(const StudyFolder& folder)
{
    const fs::path whole = fs::absolute(folder.folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

fs::path besideOf(const StudyFolder& folder)
{
    const fs::path whole = fs::absolute(folder.folder).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).parent_path();
}

std::string prefixBeside(const StudyFolder& folder) { return nameOf(folder) + "-rescue-"; }

/// A file name that is free: PREFIX1.db, PREFIX2.db ...
fs::path freeName(const fs::path& where, const std::string& prefix)
{
    std::error_code unknown;
    int number = 1;
    while (number < mostFiles && fs::exists(where / (prefix + std::to_string(number) + ".db"), unknown)) ++number;
    return where / (prefix + std::to_string(number) + ".db");
}

bool wroteCopy(const SqliteConnection& sqlite, const fs::path& file)
{
    try {
        sqlite.run(QStringLiteral("VACUUM INTO ?"), {toQt(file.string())});
        ::chmod(file.c_str(), 0600);
        return true;
    } catch (const protocols::Error&) {
        return false;  // the next place may take it
    }
}

void addRescues(const fs::path& where, const std::string& prefix, std::vector<fs::path>& files)
{
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(where, unreadable)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(prefix) && name.ends_with(".db")) files.push_back(entry.path());
    }
}

void requireSound(const SqliteConnection& rescued)
{
    checkedVersion(rescued);
    const auto faults = faultsOfDatabase(rescued);
    if (!faults.empty())
        throw protocols::badInput({"the rescue file has a fault: " + faults.front(), rescued.file().string(),
                                   "a file that the program kept aside", "choose another rescue file; nothing was changed"});
}

void requireBeginning(const StudyFolder& folder, const SqliteConnection& rescued)
{
    const SqliteConnection present(folder.database(), SqliteConnection::Mode::Read);
    checkedVersion(present);
    const LogHead head = headIn(present);
    if (fromQt(rescued.value(QStringLiteral("SELECT hash FROM events WHERE sequence = ?"), {qlonglong(head.sequence)})) !=
        head.hash)
        throw protocols::badInput({"the study has answers that the rescue file lacks", rescued.file().string(),
                                   "a rescue file that continues " + folder.database().string(),
                                   "keep both; move study.db aside to use the rescue file"});
}

}  // namespace

std::filesystem::path keepAside(const SqliteConnection& sqlite, const StudyFolder& folder)
{
    std::error_code none;
    const fs::path inside = freeName(folder.folder, "rescue-");
    const fs::path beside = freeName(besideOf(folder), prefixBeside(folder));
    const fs::path temporary = freeName(fs::temp_directory_path(none), prefixBeside(folder));
    for (const fs::path& file : {inside, beside, temporary})
        if (wroteCopy(sqlite, file)) return file;
    throw protocols::environmentFault({"the answers cannot be kept aside", folder.folder.string(), "room for a copy of study.db",
                                       "leave this window open and free space"});
}

std::vector<std::filesystem::path> rescueFiles(const StudyFolder& folder)
{
    std::vector<fs::path> files;
    addRescues(folder.folder, "rescue-", files);
    addRescues(besideOf(folder), prefixBeside(folder), files);
    std::ranges::sort(files, {}, [](const fs::path& file) {
        std::error_code unknown;
        return fs::last_write_time(file, unknown);
    });
    return files;
}

Rescue bringBack(const StudyFolder& folder, const std::filesystem::path& rescue)
{
    Rescue result;
    const bool hasPresent = fs::exists(folder.database());
    {
        const SqliteConnection rescued(rescue, SqliteConnection::Mode::Read);
        requireSound(rescued);
        if (hasPresent) requireBeginning(folder, rescued);
        result.events = static_cast<std::size_t>(headIn(rescued).sequence);
    }
    if (hasPresent) {
        {
            const SqliteConnection present(folder.database(), SqliteConnection::Mode::Write);
            result.events -= static_cast<std::size_t>(headIn(present).sequence);
            present.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
        }
        result.earlier = freeName(folder.folder, "study-before-rescue-");
        fs::rename(folder.database(), result.earlier);
    }
    std::error_code ignored;
    for (const char* ending : {"-wal", "-shm"}) fs::remove(folder.database().string() + ending, ignored);
    protocols::putFileInPlace(rescue, folder.database());
    return result;
}

}  // namespace database
