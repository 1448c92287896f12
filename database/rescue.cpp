#include "database/rescue.h"

#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "database/audit.h"
#include "database/disk/payload_fields.h"
#include "database/disk/server_note.h"
#include "database/erasure.h"
#include "database/event_chain.h"
#include "database/rescue_files.h"
#include "database/schema.h"
#include "database/study_rows.h"
#include "protocols/files/disk_sync.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

namespace fs = std::filesystem;

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

void requireSound(const SqliteConnection& rescued)
{
    checkedVersion(rescued);
    const auto faults = faultsOfCopy(rescued);
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

std::string hashOfEntry(const SqliteConnection& sqlite, std::int64_t sequence)
{
    return fromQt(sqlite.value(QStringLiteral("SELECT hash FROM events WHERE sequence = ?"), {qlonglong(sequence)}));
}

protocols::Error refused(const std::string& what, const fs::path& rescue, const std::string& expected, const std::string& next)
{
    return protocols::badInput({what, rescue.string(), expected, next + "; nothing was changed"});
}

/// The log of the present study.db must be the beginning of the rescued one.
void requireBeginning(const StudyFolder& folder, const LogHead& present, const SqliteConnection& rescued)
{
    // An entry that is missing has no hash, and so is the same as an altered one without.
    if (!present.hash.empty() && hashOfEntry(rescued, present.sequence) == present.hash) return;
    const SqliteConnection study(folder.database(), SqliteConnection::Mode::Read);
    const std::string continues = "a rescue file that continues " + folder.database().string();
    if (hashOfEntry(rescued, 1) != hashOfEntry(study, 1))
        throw refused("study.db and the rescue file are of two studies", rescued.file(), continues,
                      "move the one that does not belong to this folder aside");
    const LogHead other = headIn(rescued);
    if (other.sequence <= present.sequence && hashOfEntry(study, other.sequence) == other.hash)
        throw refused("the study has every entry of the rescue file already", rescued.file(), continues,
                      "delete the rescue file, which may hold answers that were erased since");
    throw refused("the study has answers that the rescue file lacks, and the rescue file others that the study lacks",
                  rescued.file(), continues,
                  "keep both; to look into the rescue file, copy the folder, move study.db out of the copy, and run this there");
}

/// Without a study.db that can be read, the keys say whose folder it is.
void requireOwnKeys(const StudyFolder& folder, const SqliteConnection& rescued)
{
    const std::string expected = "a rescue file of the study in " + folder.folder.string();
    switch (originOf(rescued, folder)) {
        case Origin::ThisStudy:
            return;
        case Origin::AnotherStudy:
            throw refused("the rescue file is of another study", rescued.file(), expected, "choose another rescue file");
        case Origin::Unknown:
            throw refused("the folder has no station key, so that nothing says to which study it belongs", rescued.file(),
                          expected, "restore the folder from its newest backup and do it again");
    }
}

/// Whether the log has the erasure of this certificate, at its entry and of its participant. `entry`: 0 for any.
bool hasErasure(const SqliteConnection& sqlite, std::int64_t entry, const fs::path& certificate)
{
    const auto text = protocols::readIfPossible(certificate);
    QSqlQuery row = sqlite.run(
        QStringLiteral("SELECT payload FROM events WHERE kind = 'erased' AND participant = '' AND (sequence = ? OR ? = 0)"),
        {qlonglong(entry), qlonglong(entry)});
    while (row.next()) {
        const std::string line = "\nParticipant: " + textIn(payloadIn(fromQt(row.value(0))), "participant") + "\n";
        if (!text || text->find(line) != std::string::npos) return true;
    }
    return false;
}

/// A database from before an erasure would bring the erased data back.
void requireErasuresOf(const StudyFolder& folder, const SqliteConnection& rescued)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(certificatesFolder(folder), none)) {
        const std::string name = entry.path().filename().string();
        std::int64_t erasure = 0;
        if (std::sscanf(name.c_str(), "erasure-%" SCNd64, &erasure) != 1) continue;
        // One that a later erasure put aside is of another log.
        const bool isOfThisLog = name == "erasure-" + std::to_string(erasure) + ".txt";
        if (!hasErasure(rescued, isOfThisLog ? erasure : 0, entry.path()))
            throw refused(
                "the rescue file is from before the erasure of " + name + " and would bring the erased data back", rescued.file(),
                "a rescue file or a backup from after it",
                "where this file is the only one left: move the certificate aside, do it again, and then erase at once");
    }
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

/// Adds the acts of the present study.db that the new one lacks, and leaves the new one complete without its other files. Damage
/// to the acts does not keep the answers away.
void keepActs(const StudyFolder& folder, const fs::path& file, Rescue& result)
{
    const SqliteConnection made(file, SqliteConnection::Mode::Write);
    try {
        const KeptActs kept = keepActsOf(SqliteConnection(folder.database(), SqliteConnection::Mode::Read), made);
        result.acts = kept.added;
        result.lacksActs = kept.altered > 0;
    } catch (const protocols::Error&) {
        result.lacksActs = true;
    }
    made.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
}

/// Gives study.db another name, with its write-ahead log where that may hold something. It keeps its own name until the rescued
/// one replaces it, so that nothing is missing after an interruption, where the file system has links. Returns the new name.
fs::path movePresentAside(const StudyFolder& folder)
{
    fs::path earlier = freeName(folder.folder, "study-before-rescue-");
    std::error_code ignored;
    if (::link(folder.database().c_str(), earlier.c_str()) != 0) fs::rename(folder.database(), earlier);
    const fs::path log = folder.database().string() + "-wal";
    if (fs::exists(log, ignored) && fs::file_size(log, ignored) > 0) fs::rename(log, earlier.string() + "-wal");
    return earlier;
}

/// After a failure; movePresentAside() in the other direction.
void putPresentBack(const fs::path& earlier, const StudyFolder& folder)
{
    std::error_code ignored;
    if (fs::exists(folder.database(), ignored))
        fs::remove(earlier, ignored);
    else
        fs::rename(earlier, folder.database(), ignored);
    fs::rename(earlier.string() + "-wal", folder.database().string() + "-wal", ignored);
}

}  // namespace

std::filesystem::path keepAside(const SqliteConnection& sqlite, const PageCopy* copy, const StudyFolder& folder)
{
    for (const fs::path& file : placesForRescue(folder))
        if (wroteCopy(sqlite, copy, file)) return file;
    throw protocols::environmentFault({"the answers cannot be kept aside", folder.folder.string(), "room for a copy of study.db",
                                       "leave this window open and free space"});
}

bool holdsAllOf(const PageCopy& copy, const std::filesystem::path& database, Facts facts)
{
    try {
        const SqliteConnection present(database, SqliteConnection::Mode::Read);
        requireTables(present);
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

Rescue bringBack(const StudyFolder& folder, const std::filesystem::path& rescue)
{
    std::error_code ignored;
    if (const auto note = readServerNote(folder.folder))
        throw refused("the study lies on a server, and its answers are there", rescue, "a study in its folder",
                      "bring the study back with vis2hap study move " + protocols::shellWord(note->address) + " " +
                          protocols::shellWord(folder.folder.string()));
    if (::access(folder.folder.c_str(), W_OK) != 0)
        throw protocols::environmentFault({"the study folder cannot be written", folder.folder.string(),
                                           "a folder that this account may write",
                                           "check its permissions and its file system; nothing was changed"});
    const bool hasPresent = fs::exists(folder.database());
    requireRegular(rescue, "rescue-N.db, a file that the program kept aside");
    if (hasPresent) requireRegular(folder.database(), "the database of a study, or no file of this name");
    Rescue result;
    const NewDatabase made{freeName(folder.folder, ".rescued-")};
    bool continuesPresent = false;
    {
        const SqliteConnection rescued(rescue, SqliteConnection::Mode::Read);
        requireSound(rescued);
        result.events = static_cast<std::size_t>(headIn(rescued).sequence);
        if (const auto present = hasPresent ? headOfPresent(folder) : std::nullopt; present && present->sequence > 0) {
            continuesPresent = true;
            requireBeginning(folder, *present, rescued);
            requireErasuresOf(folder, rescued);
            result.events -= static_cast<std::size_t>(present->sequence);
            makeComplete(folder);
        } else {
            requireOwnKeys(folder, rescued);
            requireErasuresOf(folder, rescued);
        }
        writeWhole(rescued, made.file);
    }
    if (continuesPresent)
        keepActs(folder, made.file, result);
    else
        result.lacksActs = hasPresent;  // nobody can read which acts it had
    if (hasPresent) result.earlier = movePresentAside(folder);
    for (const char* ending : {"-wal", "-shm"}) fs::remove(folder.database().string() + ending, ignored);
    try {
        protocols::putFileInPlace(made.file, folder.database());
    } catch (...) {
        if (hasPresent) putPresentBack(result.earlier, folder);
        throw;
    }
    if (isLeftBy(rescue, folder))
        for (const char* ending : {"", "-wal", "-shm"}) fs::remove(rescue.string() + ending, ignored);
    return result;
}

}  // namespace database
