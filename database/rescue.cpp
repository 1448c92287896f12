#include "database/rescue.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "database/audit.h"
#include "database/schema.h"
#include "database/study_rows.h"
#include "protocols/files/disk_sync.h"
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

/// False where the connection cannot be read, or the file lacks a row of the copy.
bool wroteWhatIsRead(const SqliteConnection& sqlite, const PageCopy& copy, const fs::path& file)
{
    try {
        sqlite.run(QStringLiteral("VACUUM INTO ?"), {toQt(file.string())});
        if (holdsAllOf(copy, file, Facts::MustAgree)) return true;
    } catch (const protocols::Error&) {
        // The copy is written in its place.
    }
    std::error_code ignored;
    for (const char* ending : {"", "-wal", "-shm"}) fs::remove(file.string() + ending, ignored);
    return false;
}

bool wroteCopy(const SqliteConnection& sqlite, const PageCopy* copy, const fs::path& file)
{
    try {
        if (!copy)
            sqlite.run(QStringLiteral("VACUUM INTO ?"), {toQt(file.string())});
        else if (!wroteWhatIsRead(sqlite, *copy, file))
            copy->writeTo(file);
        ::chmod(file.c_str(), 0600);
        headIn(SqliteConnection(file, SqliteConnection::Mode::Read));
        protocols::syncFile(file);  // VACUUM INTO does not
        protocols::syncFolder(file.parent_path());
        return true;
    } catch (const protocols::Error&) {
        std::error_code ignored;
        fs::remove(file, ignored);
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

/// Opening a pipe would wait for ever.
void requireRegular(const fs::path& file, const std::string& expected)
{
    std::error_code none;
    if (!fs::is_regular_file(file, none))
        throw protocols::badInput({fs::exists(file, none) ? "is no regular file" : "there is no such file", file.string(),
                                   expected, "check the path; nothing was changed"});
}

/// The end of the log in study.db; empty where that cannot be read as a study.
std::optional<LogHead> headOfPresent(const StudyFolder& folder)
{
    try {
        const SqliteConnection present(folder.database(), SqliteConnection::Mode::Read);
        checkedVersion(present);
        return headIn(present);
    } catch (const protocols::Error& fault) {
        if (fault.exitCode() == protocols::ExitCode::Environment) throw;
        return std::nullopt;
    }
}

void requireBeginning(const StudyFolder& folder, const LogHead& present, const SqliteConnection& rescued)
{
    if (fromQt(rescued.value(QStringLiteral("SELECT hash FROM events WHERE sequence = ?"), {qlonglong(present.sequence)})) !=
        present.hash)
        throw protocols::badInput({"the study has answers that the rescue file lacks", rescued.file().string(),
                                   "a rescue file that continues " + folder.database().string(),
                                   "keep both; move study.db aside to use the rescue file"});
}

/// Moves the whole log of the present study.db into it, so that it is complete without its other files.
void makeComplete(const StudyFolder& folder)
{
    const SqliteConnection present(folder.database(), SqliteConnection::Mode::Write);
    QSqlQuery row = present.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
    if (!row.next() || row.value(0).toInt() != 0)
        throw protocols::environmentFault({"another program reads the study", folder.database().string(), "no open reader",
                                           "close it and do it again; nothing was changed"});
}

/// What is compared of the rows of a table: a session may change the rest.
std::string lastingColumnsOf(const std::string& table, Facts facts)
{
    if (facts == Facts::MustAgree) return "*";
    if (table == "participants") return "id";
    if (table == "participant_facts") return "participant, fact";
    return "*";
}

std::vector<std::string> tablesOf(const SqliteConnection& sqlite, const char* schema)
{
    std::vector<std::string> names;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT name FROM %1.sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite~_%' "
                                  "ESCAPE '~'")
                       .arg(QLatin1String(schema)));
    while (row.next()) names.push_back(fromQt(row.value(0)));
    return names;
}

/// The copy as a database of the connection that stays in memory, so that no file holds it.
bool attached(const SqliteConnection& sqlite, const PageCopy& copy, const char* schema)
{
    sqlite.run(QStringLiteral("ATTACH ':memory:' AS %1").arg(QLatin1String(schema)));
    sqlite3* handle = sqlite.handle();
    auto* bytes = handle ? static_cast<unsigned char*>(sqlite3_malloc64(static_cast<sqlite3_uint64>(copy.bytes()))) : nullptr;
    if (!bytes) return false;
    unsigned char* end = bytes;
    copy.give([&](std::string_view page) { end = std::copy(page.begin(), page.end(), end); });
    return sqlite3_deserialize(handle, schema, bytes, copy.bytes(), copy.bytes(),
                               SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_READONLY) == SQLITE_OK;
}

/// A file beside study.db that vanishes unless it was put in place.
struct NewDatabase {
    fs::path file;
    ~NewDatabase()
    {
        std::error_code ignored;
        for (const char* ending : {"", "-wal", "-shm"}) fs::remove(file.string() + ending, ignored);
    }
};

/// Writes everything that the connection sees, its write-ahead log included, into one file, and compares the end of the log.
void writeWhole(const SqliteConnection& rescued, const fs::path& file)
{
    rescued.run(QStringLiteral("VACUUM INTO ?"), {toQt(file.string())});
    ::chmod(file.c_str(), 0600);
    const LogHead expected = headIn(rescued);
    const LogHead found = headIn(SqliteConnection(file, SqliteConnection::Mode::Read));
    if (found.sequence != expected.sequence || found.hash != expected.hash)
        throw protocols::workFailed({"the new study.db lacks entries of the rescue file", rescued.file().string(),
                                     "entry " + std::to_string(expected.sequence), "do it again; nothing was changed"});
}

/// Renames study.db, with its write-ahead log where that may hold something. Returns its new name.
fs::path movePresentAside(const StudyFolder& folder)
{
    fs::path earlier = freeName(folder.folder, "study-before-rescue-");
    fs::rename(folder.database(), earlier);
    std::error_code ignored;
    const fs::path log = folder.database().string() + "-wal";
    if (fs::exists(log, ignored) && fs::file_size(log, ignored) > 0) fs::rename(log, earlier.string() + "-wal");
    return earlier;
}

}  // namespace

std::filesystem::path keepAside(const SqliteConnection& sqlite, const PageCopy* copy, const StudyFolder& folder)
{
    std::error_code none;
    const fs::path inside = freeName(folder.folder, "rescue-");
    const fs::path beside = freeName(besideOf(folder), prefixBeside(folder));
    const fs::path temporary = freeName(fs::temp_directory_path(none), prefixBeside(folder));
    for (const fs::path& file : {inside, beside, temporary})
        if (wroteCopy(sqlite, copy, file)) return file;
    throw protocols::environmentFault({"the answers cannot be kept aside", folder.folder.string(), "room for a copy of study.db",
                                       "leave this window open and free space"});
}

bool holdsAllOf(const PageCopy& copy, const std::filesystem::path& database, Facts facts)
{
    try {
        const SqliteConnection present(database, SqliteConnection::Mode::Read);
        if (!attached(present, copy, "kept")) return false;
        const ReadSnapshot snapshot(present);
        if (fromQt(present.value(QStringLiteral("PRAGMA main.quick_check(1)"))) != "ok") return false;
        for (const std::string& table : tablesOf(present, "kept")) {
            const std::string columns = lastingColumnsOf(table, facts), rows = "SELECT " + columns + " FROM ",
                              of = ".\"" + table + "\"";
            if (present.value(toQt("SELECT EXISTS(" + rows + "kept" + of + " EXCEPT " + rows + "main" + of + ")")).toInt() != 0)
                return false;
        }
        return true;
    } catch (const protocols::Error&) {
        return false;  // what stands there is no study, or cannot be compared
    }
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

std::vector<std::filesystem::path> rescueFilesOutside(const StudyFolder& folder)
{
    std::vector<fs::path> files;
    std::error_code none;
    addRescues(besideOf(folder), prefixBeside(folder), files);
    const fs::path temporary = fs::temp_directory_path(none);
    if (!none && !fs::equivalent(temporary, besideOf(folder), none)) addRescues(temporary, prefixBeside(folder), files);
    // In these folders others may put what they like under such a name.
    std::erase_if(files, [](const fs::path& file) {
        std::error_code unknown;
        return fs::symlink_status(file, unknown).type() != fs::file_type::regular || ::access(file.c_str(), R_OK) != 0;
    });
    return files;
}

Rescue bringBack(const StudyFolder& folder, const std::filesystem::path& rescue)
{
    std::error_code ignored;
    const bool hasPresent = fs::exists(folder.database());
    requireRegular(rescue, "rescue-N.db, a file that the program kept aside");
    if (hasPresent) requireRegular(folder.database(), "the database of a study, or no file of this name");
    Rescue result;
    const NewDatabase made{freeName(folder.folder, ".rescued-")};
    {
        const SqliteConnection rescued(rescue, SqliteConnection::Mode::Read);
        requireSound(rescued);
        result.events = static_cast<std::size_t>(headIn(rescued).sequence);
        if (const auto present = hasPresent ? headOfPresent(folder) : std::nullopt) {
            requireBeginning(folder, *present, rescued);
            result.events -= static_cast<std::size_t>(present->sequence);
            makeComplete(folder);
        }
        writeWhole(rescued, made.file);
    }
    const auto kept = rescueFiles(folder);
    if (hasPresent) result.earlier = movePresentAside(folder);
    for (const char* ending : {"-wal", "-shm"}) fs::remove(folder.database().string() + ending, ignored);
    protocols::putFileInPlace(made.file, folder.database());
    if (std::ranges::any_of(kept, [&](const fs::path& file) { return fs::equivalent(file, rescue, ignored); }))
        for (const char* ending : {"", "-wal", "-shm"}) fs::remove(rescue.string() + ending, ignored);
    return result;
}

}  // namespace database
