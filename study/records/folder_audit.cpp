#include "study/records/folder_audit.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "database/preregistrations.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"

namespace study::records {

namespace {

namespace fs = std::filesystem;

constexpr const char* knownFiles[] = {"study.db",      "study.db-wal",        "study.db-shm",          ".lock",
                                      "protocol.json", "allocation-key.json", "allocation-key.sealed", "station-key.json"};
constexpr const char* knownFolders[] = {"stimuli", "erasures", "prompts"};

/// True for PREFIX, a number and ENDING.
bool isNumbered(std::string_view name, std::string_view prefix, std::string_view ending)
{
    if (!name.starts_with(prefix) || !name.ends_with(ending) || name.size() <= prefix.size() + ending.size()) return false;
    const auto number = name.substr(prefix.size(), name.size() - prefix.size() - ending.size());
    return std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
}

/// True for "before-upgrade", "before-upgrade-2" and so on.
bool isCopyBeforeUpgrade(const std::string& name, const database::StudyFolder& folder)
{
    const std::string first = folder.beforeUpgrade().filename().string();
    return name == first || isNumbered(name, first + "-", "");
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

class Search {
public:
    Search(const fs::path& study, FolderFindings& findings) : m_study(study), m_findings(findings) {}

    using IsKnown = std::function<bool(const std::string& name)>;

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
                                       " of its files (expected modes 0600 and 0700): run chmod -R go-rwx on the study");
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
        if (!isFile && !isFolder) {
            addFault(entry, "does not belong to the study: move it out of the folder");
            return false;
        }
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
    const auto made = nlohmann::json::parse(store.facts().madeWith, nullptr, false);
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

}  // namespace

FolderFindings findingsInFolder(const database::StudyStore& store)
{
    FolderFindings findings;
    const database::StudyFolder& folder = store.folder();
    const auto none = [](const std::string&) { return false; };
    const auto registered = registeredFiles(store);
    std::set<std::string> stimuli;
    for (const auto& [code, hash] : store.stimulusHashes()) stimuli.insert(code.value + ".sealed");

    Search search(folder.folder, findings);
    search.look(
        folder.folder,
        [&](const std::string& name) {
            return isOneOf(knownFiles, name) || registered.contains(name) || isNumbered(name, "rescue-", ".db") ||
                   isNumbered(name, "study-before-rescue-", ".db");
        },
        [&](const std::string& name) {
            if (!isCopyBeforeUpgrade(name, folder)) return isOneOf(knownFolders, name);
            findings.notes.push_back(name +
                                     ": the study before its upgrade, not sealed: delete it when the upgraded study works");
            return true;
        });
    if (fs::is_directory(folder.stimuli()))
        search.look(
            folder.stimuli(), [&](const std::string& name) { return stimuli.contains(name); }, none);
    const auto prompts = promptHashes(store);
    if (fs::is_directory(folder.prompts()))
        search.look(
            folder.prompts(),
            [&](const std::string& name) { return name.ends_with(".wav") && prompts.contains(name.substr(0, name.size() - 4)); },
            none);
    if (findings.isReadable) checkPrompts(store, prompts, findings);
    if (const fs::path erasures = folder.folder / "erasures"; fs::is_directory(erasures))
        search.look(
            erasures, [](const std::string& name) { return isNumbered(name, "erasure-", ".txt"); }, none);
    return findings;
}

}  // namespace study::records
