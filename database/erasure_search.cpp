#include "database/erasure_search.h"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "database/disk/payload_fields.h"
#include "database/disk/raw_database.h"
#include "database/rescue_files.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/sha256.h"

namespace database {

namespace {

/// Files outside of the study folder whose bytes may hold what was erased. Those of other accounts are searched up to a size,
/// because anybody may put a file there that has no end.
std::vector<std::filesystem::path> rescueFilesAround(const StudyFolder& study)
{
    constexpr std::uintmax_t largestOfOthers = 4ULL << 30;
    std::vector<std::filesystem::path> files = rescueFilesOutside(study);
    for (const auto& file : rescueFilesOfOthers(study)) {
        std::error_code unknown;
        const auto size = std::filesystem::file_size(file, unknown);
        if (!unknown && size <= largestOfOthers && ::access(file.c_str(), R_OK) == 0) files.push_back(file);
    }
    return files;
}

bool isOwnFile(const std::string& name) { return name == "study.db" || name == "study.db-wal" || name == "study.db-shm"; }

/// How a message and a certificate, which nobody can change later, name the file.
std::string shownName(const FoundFile& file)
{
    return file.name.empty() ? "a file whose name holds a removed text, with the SHA-256 " + file.sha256 : file.name;
}

std::string hashIfReadable(const std::filesystem::path& file)
{
    try {
        return protocols::sha256OfFile(file);
    } catch (const protocols::Error&) {
        return {};
    }
}

}  // namespace

FoundFile foundFile(const std::string& name, const std::set<std::string>& texts, const StudyFolder& study)
{
    const bool holdsText = std::ranges::any_of(texts, [&](const auto& text) { return name.find(text) != std::string::npos; });
    FoundFile file{holdsText ? "" : protocols::printable(name)};
    const std::filesystem::path path = study.folder / name;
    std::error_code unknown;
    if (const auto bytes = std::filesystem::file_size(path, unknown); !unknown) file.bytes = std::int64_t(bytes);
    if (!isOwnFile(name)) file.sha256 = hashIfReadable(path);  // else its name counts alone
    return file;
}

std::vector<FoundFile> filesInCertificates(const SqliteConnection& sqlite, const std::string& participant)
{
    std::set<std::int64_t> erasures;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT event FROM erasures WHERE participant = ?"), {toQt(participant)});
    while (row.next()) erasures.insert(row.value(0).toLongLong());
    std::vector<FoundFile> files;
    row = sqlite.run(QStringLiteral("SELECT payload FROM events WHERE kind = ? AND participant = ''"), {toQt(certifiedKind)});
    while (row.next()) {
        const nlohmann::json payload = payloadIn(fromQt(row.value(0)));
        const auto found = payload.find(foundField);
        if (found == payload.end() || !erasures.contains(numberIn(payload, "erasure", 0))) continue;
        for (const auto& file : *found) {
            if (!file.is_object()) continue;
            const auto bytes = file.find("bytes");
            const bool isSized = bytes != file.end() && bytes->is_number_integer();
            files.push_back({textIn(file, "name"), isSized ? bytes->get<std::int64_t>() : 0, textIn(file, "sha256")});
        }
    }
    return files;
}

std::vector<FoundFile> stillThere(const std::vector<FoundFile>& named, const Erasure& erasure, const StudyFolder& study)
{
    if (named.empty()) return {};
    std::map<std::string, std::filesystem::path> present;  // by printable name
    for (const auto& file : protocols::filesIn(study.folder))
        present.emplace(protocols::printable(file.lexically_relative(study.folder).string()), file);
    for (const auto& file : rescueFilesAround(study)) present.emplace(protocols::printable(file.string()), file);
    std::erase_if(present, [](const auto& file) { return isOwnFile(file.first); });
    std::vector<FoundFile> found;
    for (const auto& [name, path] : present) {
        std::error_code unknown;
        const auto bytes = std::int64_t(std::filesystem::file_size(path, unknown));
        const auto same = std::ranges::find_if(named, [&](const FoundFile& file) {
            return file.name == name || (!unknown && file.bytes == bytes && file.sha256 == hashIfReadable(path));
        });
        if (same == named.end() || !rowsAbout(path, erasure.participant.value, erasure.answersToo, study).value_or(true))
            continue;
        found.push_back({same->name.empty() ? "" : name, bytes, hashIfReadable(path)});
    }
    return found;
}

void addFound(const FoundFile& file, ErasureRecord& record)
{
    const std::string shown = shownName(file);
    if (std::ranges::find(record.found, shown) != record.found.end()) return;
    record.found.push_back(shown);
    record.foundFiles.push_back(file);
}

void requireSearchable(const std::filesystem::path& folder)
{
    const auto unreadable = protocols::unreadableIn(folder);
    if (unreadable.empty()) return;
    throw protocols::environmentFault(
        {"cannot be read (" + unreadable.front().reason + "), so that nobody could search it for what is erased",
         unreadable.front().path.string(), "a folder in which this account may read every file",
         "give this account the right to read it, or move it away, and run the command again; nothing was erased"});
}

protocols::ByteSearch searchFiles(const SqliteConnection& sqlite, const StudyFolder& study,
                                  const std::vector<std::string>& sequences)
{
    const RawDatabase raw(sqlite.handle());
    if (!raw.isThere()) return protocols::searchFiles(study.folder, sequences, rescueFilesAround(study));
    protocols::ByteSearch search = protocols::searchFiles(study.folder, sequences, rescueFilesAround(study), isOwnFile);
    const protocols::ByteSequences wanted(sequences);
    std::vector<char> block(std::size_t{1} << 20);
    std::string carried;  // the end of the block before
    ++search.files;
    for (std::int64_t at = 0, end = raw.databaseBytes(); at < end; at += std::int64_t(block.size())) {
        block.resize(std::size_t(std::min<std::int64_t>(end - at, std::int64_t(block.size()))));
        if (!raw.readDatabase(at, block))
            throw protocols::environmentFault({"the database cannot be read", sqlite.file().string(), "a disk without faults",
                                               "run the command again, which completes the erasure"});
        carried.append(block.data(), block.size());
        if (wanted.areIn(carried)) {
            search.found.emplace_back("study.db");
            break;
        }
        carried.erase(0, carried.size() - std::min(carried.size(), wanted.longest()));
    }
    return search;
}

}  // namespace database
