#include "study/records/folder_audit.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "database/erasure.h"
#include "database/event_chain.h"
#include "database/preregistrations.h"
#include "database/rescue_files.h"
#include "database/schema.h"
#include "database/sqlite_connection.h"
#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"

namespace study::records {

namespace {

namespace fs = std::filesystem;

constexpr const char* knownFiles[] = {"study.db",      "study.db-wal",        "study.db-shm",    ".lock",
                                      "protocol.json", "allocation-key.json", "station-key.json"};
constexpr const char* knownFolders[] = {"stimuli", "erasures", "prompts"};
/// Of the owner's folder while the study lies on a server; sessions on this computer leave the queue there.
constexpr const char* filesOnServer[] = {"server.json", "queue.db", "queue.db-wal", "queue.db-shm"};

/// True for "before-upgrade", "before-upgrade-2" and so on.
bool isCopyBeforeUpgrade(const std::string& name, const database::StudyFolder& folder)
{
    const std::string first = folder.beforeUpgrade().filename().string();
    return name == first || database::isNumbered(name, first + "-", "");
}

/// True for what a session leaves that cannot go on with its server.
bool isOfServerSession(const std::string& name)
{
    return name.ends_with(".json") && (name.starts_with("held-") || name.starts_with("not-sent-"));
}

std::set<std::string> registeredFiles(const database::StudyStore& store)
{
    std::set<std::string> names;
    try {
        for (const auto& record : preregistrationsOf(store))
            for (const char* kind : {"txt", "json"})
                names.insert(preregistrationFile(store.folder(), record.number, kind).filename().string());
    } catch (const protocols::Error&) {
        // The audit of the log reports a payload that cannot be read.
    }
    return names;
}

/// What a rescue put aside, which may be a damaged study.
bool isBeforeRescue(const std::string& name) { return database::isNumbered(name, "study-before-rescue-", ".db"); }

/// A database that a rescue put aside, or that waits for one.
bool isKeptDatabase(const std::string& name) { return database::isNumbered(name, "rescue-", ".db") || isBeforeRescue(name); }

/// The same with the files that SQLite keeps beside it.
bool belongsToKeptDatabase(const std::string& name, const fs::path& folder)
{
    if (isKeptDatabase(name)) return true;
    std::error_code unknown;
    for (const std::string_view ending : {"-wal", "-shm"}) {
        if (!name.ends_with(ending)) continue;
        const std::string database = name.substr(0, name.size() - ending.size());
        if (isKeptDatabase(database) && fs::exists(folder / database, unknown)) return true;
    }
    return false;
}

/// NAME of ".NAME.unfinished-COMPUTER-PID", which a program leaves that is killed while it writes; empty for another name.
std::string unfinishedNameIn(const std::string& name)
{
    const std::size_t mark = name.find(".unfinished-"), number = name.rfind('-');
    const bool ends = number != std::string::npos && number + 1 < name.size() &&
                      std::all_of(name.begin() + static_cast<std::ptrdiff_t>(number) + 1, name.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
    return name.starts_with('.') && mark != std::string::npos && mark > 1 && ends ? name.substr(1, mark - 1) : std::string();
}

class Search {
public:
    Search(const fs::path& study, FolderFindings& findings) : m_study(study), m_findings(findings) {}

    using IsKnown = std::function<bool(const std::string& name)>;

    static bool none(const std::string&) { return false; }

    /// Looks at each entry of a folder: `file` says whether a file of this name belongs there, `folder` the same of a folder.
    void look(const fs::path& where, const IsKnown& file, const IsKnown& folder)
    {
        std::error_code unreadable;
        std::vector<fs::path> entries;
        for (const auto& entry : fs::directory_iterator(where, unreadable)) entries.push_back(entry.path());
        if (unreadable) addFault(where, "the folder cannot be read");
        std::ranges::sort(entries);
        std::size_t openToOthers = 0;
        for (const fs::path& entry : entries) openToOthers += lookAt(entry, file, folder);
        if (openToOthers > 0)
            m_findings.notes.push_back(nameOf(where) + ": other users may read or change " + std::to_string(openToOthers) +
                                       " of its files (expected modes 0600 and 0700): " +
                                       (protocols::keepsAccessRights(where)
                                            ? "run chmod -R go-rwx on the study"
                                            : "this file system keeps no access rights; move the study to a disk that does"));
    }

private:
    /// "stimuli/x.sealed"; "the study folder" for the study itself.
    std::string nameOf(const fs::path& path) const
    {
        return path == m_study ? "the study folder" : path.lexically_relative(m_study).string();
    }
    void addFault(const fs::path& path, const std::string& what) { m_findings.faults.push_back(nameOf(path) + ": " + what); }

    /// Returns whether other users may read it.
    bool lookAt(const fs::path& entry, const IsKnown& file, const IsKnown& folder)
    {
        const std::string name = entry.filename().string();
        struct stat status {};
        if (::lstat(entry.c_str(), &status) != 0) return false;  // gone since, as the files of SQLite may be
        const bool isFile = file(name), isFolder = folder(name);
        const std::string unfinished = unfinishedNameIn(name);
        if (!unfinished.empty() && file(unfinished) && S_ISREG(status.st_mode)) {
            m_findings.unknownFiles.push_back(entry.lexically_relative(m_study));
            m_findings.notes.push_back(nameOf(entry) + ": left by a program that was killed while it wrote: delete it");
            return (status.st_mode & 0077) != 0;
        }
        if (!isFile && !isFolder) {
            m_findings.unknownFiles.push_back(entry.lexically_relative(m_study));
            addFault(entry, "does not belong to the study: move it out of the folder");
            return false;
        }
        if (name == "study.db" && S_ISREG(status.st_mode) && status.st_nlink > 1)
            addFault(entry, "is the same file as another one (hard link), so that a second program could write to it");
        if (S_ISLNK(status.st_mode)) {
            addFault(entry, std::string("a link stands in the place of ") + (isFile ? "the file" : "the folder"));
            return false;
        }
        if (isFile ? !S_ISREG(status.st_mode) : !S_ISDIR(status.st_mode)) {
            addFault(entry, isFile ? "is no file" : "is no folder");
            m_findings.isReadable = false;
            return false;
        }
        return (status.st_mode & 0077) != 0;
    }

    const fs::path& m_study;
    FolderFindings& m_findings;
};

template <std::size_t count>
bool isOneOf(const char* const (&names)[count], const std::string& name)
{
    return std::ranges::find(names, name) != std::end(names);
}

/// The hashes of the recordings by key, as the making of the study kept them.
std::map<std::string, std::string> promptHashes(const database::StudyStore& store)
{
    const auto made = protocols::storedJson(store.facts().madeWith);
    std::map<std::string, std::string> hashes;
    if (!made.is_object() || !made.contains("prompts_sha256") || !made.at("prompts_sha256").is_object()) return hashes;
    for (const auto& [key, hash] : made.at("prompts_sha256").items())
        if (hash.is_string()) hashes[key] = hash.get<std::string>();
    return hashes;
}

/// A session plays these files, so that an altered one would reach the participant.
void checkPrompts(const database::StudyStore& store, const std::map<std::string, std::string>& hashes, FolderFindings& findings)
{
    for (const auto& [key, hash] : hashes) {
        const auto bytes = protocols::readIfPossible(store.folder().prompt(key));
        if (!bytes || protocols::sha256(*bytes) != hash)
            findings.faults.push_back("prompts/" + key + ".wav: " + (bytes ? "was altered" : "is missing") +
                                      ": put the recording of the first protocol back");
    }
}

struct Certificate {
    std::int64_t erasure = 0;  ///< entry of the log
    std::string sha256;        ///< empty where the log has none
};

bool isCertificate(const std::string& name) { return name.starts_with("erasure-") && name.ends_with(".txt"); }

/// By file name: the certificate of every erasure in the log.
std::map<std::string, Certificate> certificatesIn(const database::StudyStore& store)
{
    std::map<std::string, Certificate> found;
    if (store.erasures().empty()) return found;  // a search of the whole log takes long
    const auto hashes = certificatesOf(store);
    for (const auto& event : store.eventsOfKind("erased")) {
        if (!event.participant.empty()) continue;
        const auto hash = hashes.find(event.sequence);
        found[certificateFile(store.folder(), event.sequence).filename().string()] = {
            event.sequence, hash == hashes.end() ? std::string() : hash->second};
    }
    return found;
}

void checkCertificate(const database::StudyStore& store, const Certificate& certificate, FolderFindings& findings)
{
    const fs::path file = certificateFile(store.folder(), certificate.erasure);
    const std::string name = "erasures/" + file.filename().string();
    const auto text = protocols::readIfPossible(file);
    if (certificate.sha256.empty())
        findings.notes.push_back(name + (text ? ": its hash is not recorded, so it cannot be checked"
                                              : ": is missing, and its hash is not recorded: the erasure was interrupted, or "
                                                "somebody removed the certificate"));
    else if (!text || protocols::sha256(*text) != certificate.sha256)
        findings.faults.push_back(name + (text ? ": was altered" : ": is missing") +
                                  ": put the certificate back, as the erasure wrote it");
}

std::string hashOfEntryIn(const database::SqliteConnection& sqlite, std::int64_t sequence)
{
    return database::fromQt(sqlite.value(QStringLiteral("SELECT hash FROM events WHERE sequence = ?"), {qlonglong(sequence)}));
}

/// A certificate stands there for an erasure that the log does not have: an older database was put back.
bool lacksErasures(const database::StudyStore& store)
{
    const auto known = certificatesIn(store);
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(certificatesFolder(store.folder()), none)) {
        const std::string name = entry.path().filename().string();
        if (isCertificate(name) && !known.contains(name)) return true;
    }
    return false;
}

/// How the log of a kept database lies to that of the study. Throws Error where it is no database of this study.
std::string relationOf(const database::StudyStore& store, const fs::path& file)
{
    const database::SqliteConnection kept(file, database::SqliteConnection::Mode::Kept);
    if (database::checkedVersion(kept) < database::schemaVersion) return "it is from before the upgrade of the study";
    if (hashOfEntryIn(kept, 1) != store.hashOfEntry(1))
        throw protocols::workFailed({"this is a database of another study", file.string(), "", ""});
    const database::LogHead own = store.head(), other = database::headIn(kept);
    if (own == other) return "its log is that of the study";
    const std::string entries = std::to_string(other.sequence);
    if (other.sequence < own.sequence && store.hashOfEntry(other.sequence) == other.hash)
        return "its log is the beginning of the study's (" + entries + " of " + std::to_string(own.sequence) + " entries)";
    if (other.sequence > own.sequence && hashOfEntryIn(kept, own.sequence) == own.hash)
        return "its log has " + entries + " entries and goes on where that of the study ends" +
               (lacksErasures(store) ? "; an erasure came after it" : ": run vis2hap rescue");
    return "its log (" + entries + " entries) is apart from the study's: it holds other answers";
}

/// Nothing else reads these files before a rescue does, which checks them as a whole.
void checkKeptDatabases(const database::StudyStore& store, FolderFindings& findings)
{
    std::error_code unreadable;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(store.folder().folder, unreadable))
        if (isKeptDatabase(entry.path().filename().string()) && entry.is_regular_file(unreadable)) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        try {
            findings.notes.push_back(name + ": kept aside for a rescue or by one; " + relationOf(store, file));
        } catch (const protocols::Error& fault) {
            findings.unknownFiles.emplace_back(name);
            auto& lines = isBeforeRescue(name) ? findings.notes : findings.faults;
            lines.push_back(name +
                            ": is no database of this study that can be read, so move it out of the folder: " + fault.what());
        }
    }
}

/// The folders of studies from before an upgrade, which hold the files of the study of that time.
void lookBeforeUpgrades(const database::StudyStore& store, const fs::path& top, Search& search)
{
    std::error_code unreadable;
    std::vector<fs::path> copies;
    for (const auto& entry : fs::directory_iterator(top, unreadable))
        if (isCopyBeforeUpgrade(entry.path().filename().string(), store.folder()) && !entry.is_symlink(unreadable) &&
            entry.is_directory(unreadable))
            copies.push_back(entry.path());
    if (copies.empty() || store.eventsOfKind(database::upgradedKind).empty()) return;
    std::ranges::sort(copies);
    const auto registered = registeredFiles(store);
    for (const fs::path& copy : copies)
        search.look(
            copy,
            [&](const std::string& name) {
                return name == "masked-key.json" || name == "allocation-key.sealed" || isOneOf(knownFiles, name) ||
                       registered.contains(name) || belongsToKeptDatabase(name, copy);
            },
            [](const std::string& name) { return name == "stimuli"; });
}

/// Looks at the folder that was opened: of a study that needs an upgrade or lies on a server, the store reads a copy, which lacks
/// links and folders, and whose modes are those of a copy.
void lookAtTop(const database::StudyStore& store, const fs::path& top, Search& search, FolderFindings& findings)
{
    const auto registered = registeredFiles(store);
    const bool hasPassphrase = store.facts().hasPassphrase;
    search.look(
        top,
        [&](const std::string& name) {
            if (name == "allocation-key.sealed") return hasPassphrase;
            if (name == "masked-key.json") return store.isUpgradedCopy();
            if (isOfServerSession(name)) {
                findings.notes.push_back(name + ": a session with a server left it; read it and delete it");
                return true;
            }
            if (isOneOf(filesOnServer, name)) return !store.serverFolder().empty();
            return isOneOf(knownFiles, name) || registered.contains(name) || belongsToKeptDatabase(name, top);
        },
        [&](const std::string& name) {
            if (name == ".upgrade" && store.isUpgradedCopy()) return true;
            if (!isCopyBeforeUpgrade(name, store.folder())) return isOneOf(knownFolders, name);
            if (store.eventsOfKind(database::upgradedKind).empty()) return false;
            findings.notes.push_back(name +
                                     ": the study before its upgrade, not sealed: delete it when the upgraded study works");
            return true;
        });
    if (store.isUpgradedCopy() && store.hasLastingHead())
        findings.faults.emplace_back(
            ".upgrade: an upgrade was interrupted, or somebody made this folder: open the study in the app or with replay, which "
            "finishes the upgrade, and verify it again");
}

}  // namespace

FolderFindings findingsInFolder(const database::StudyStore& store)
{
    FolderFindings findings;
    const database::StudyFolder& folder = store.folder();
    std::set<std::string> stimuli;
    for (const auto& [code, hash] : store.stimulusHashes()) stimuli.insert(code.value + ".sealed");

    const fs::path top = store.namedFolder();
    Search ofTop(top, findings);
    lookAtTop(store, top, ofTop, findings);
    lookBeforeUpgrades(store, top, ofTop);
    Search search(folder.folder, findings);
    if (fs::is_directory(folder.stimuli()))
        search.look(
            folder.stimuli(), [&](const std::string& name) { return stimuli.contains(name); }, Search::none);
    const auto prompts = promptHashes(store);
    if (fs::is_directory(folder.prompts()))
        search.look(
            folder.prompts(),
            [&](const std::string& name) { return name.ends_with(".wav") && prompts.contains(name.substr(0, name.size() - 4)); },
            Search::none);
    if (findings.isReadable) checkPrompts(store, prompts, findings);
    const auto certificates = certificatesIn(store);
    if (const fs::path erasures = certificatesFolder(folder); fs::is_directory(erasures))
        search.look(
            erasures,
            [&](const std::string& name) {
                if (certificates.contains(name) || !isCertificate(name)) return certificates.contains(name);
                findings.unknownFiles.emplace_back("erasures/" + name);
                findings.faults.push_back("erasures/" + name +
                                          ": is of an erasure that the log does not have: an earlier database was put back, or "
                                          "somebody made this file. Erase that participant again, then move the file away");
                return true;
            },
            Search::none);
    if (!findings.isReadable) return findings;
    if (store.hasLastingHead())  // erasures of older versions have no certificates
        for (const auto& [name, certificate] : certificates) checkCertificate(store, certificate, findings);
    checkKeptDatabases(store, findings);
    return findings;
}

}  // namespace study::records
