#include "database/rescue_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <system_error>

#include "database/schema.h"
#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

namespace fs = std::filesystem;

constexpr int mostFiles = 1000;
constexpr const char* rescueWord = "rescue-";

fs::path withoutSlash(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

/// The study folder by its own name and by the name that was given, which may be a link. The own one stands first.
std::vector<fs::path> namesOf(const StudyFolder& folder)
{
    std::error_code unknown;
    const fs::path given = withoutSlash(fs::absolute(folder.folder).lexically_normal());
    const fs::path own = withoutSlash(fs::weakly_canonical(given, unknown));
    if (unknown || own == given) return {given};
    return {own, given};
}

std::string prefixBeside(const fs::path& study) { return study.filename().string() + "-" + rescueWord; }

bool isRegular(const fs::path& file)
{
    std::error_code unknown;
    return fs::symlink_status(file, unknown).type() == fs::file_type::regular;
}

enum class Owner {
    This,     ///< this account
    Another,  ///< another account
    None,     ///< it is no regular file
};

bool hidesTables(const SqliteConnection& sqlite)
{
    try {
        requireTables(sqlite);
        return false;
    } catch (const protocols::Error&) {
        return true;
    }
}

Owner ownerOf(const fs::path& file)
{
    struct stat status {};
    if (::lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return Owner::None;
    return status.st_uid == ::geteuid() ? Owner::This : Owner::Another;
}

/// Empty where the file cannot be read as the database of a study.
std::optional<Origin> originOf(const fs::path& file, const StudyFolder& folder)
{
    try {
        const SqliteConnection kept(file, SqliteConnection::Mode::Kept);
        checkedVersion(kept);
        return originOf(kept, folder);
    } catch (const protocols::Error&) {
        return std::nullopt;
    }
}

void addInside(const StudyFolder& folder, std::vector<fs::path>& files)
{
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(folder.folder, unreadable)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(rescueWord) && name.ends_with(".db")) files.push_back(entry.path());
    }
}

/// Files with the prefix, and those that another name of the folder left. Others may put what they like into such a folder, so
/// that only own files are opened.
void addFrom(const fs::path& where, const std::string& prefix, const StudyFolder& folder, std::vector<fs::path>& files)
{
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(where, unreadable)) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".db") || std::ranges::find(files, entry.path()) != files.end()) continue;
        const bool isNamed = name.starts_with(prefix);
        const bool isLike = name.find(std::string("-") + rescueWord) != std::string::npos;
        if ((!isNamed && !isLike) || ownerOf(entry.path()) != Owner::This) continue;
        if (isNamed || originOf(entry.path(), folder) == Origin::ThisStudy) files.push_back(entry.path());
    }
}

/// Files with the prefix that another account owns.
void addOfOthers(const fs::path& where, const std::string& prefix, std::vector<fs::path>& files)
{
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(where, unreadable)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(prefix) && name.ends_with(".db") && ownerOf(entry.path()) == Owner::Another &&
            std::ranges::find(files, entry.path()) == files.end())
            files.push_back(entry.path());
    }
}

bool isForeign(const fs::path& file, const StudyFolder& folder)
{
    return isRegular(file) && originOf(file, folder) == Origin::AnotherStudy;
}

/// Copies of studies that killed programs of this account left in the folders for temporary files.
std::vector<fs::path> copiesOfKilledPrograms()
{
    constexpr std::string_view prefix = "vis2hap-";
    constexpr std::size_t letters = 6;  // as TemporaryFolder names them
    std::vector<fs::path> copies;
    for (const fs::path& place : protocols::temporaryPlaces()) {
        std::error_code unreadable;
        for (const auto& entry : fs::directory_iterator(place, unreadable)) {
            const std::string name = entry.path().filename().string();
            if (!name.starts_with(prefix) || name.size() != prefix.size() + letters) continue;
            const fs::path copy = entry.path() / "study.db";
            struct stat made {};
            const bool isFolder = ::lstat(entry.path().c_str(), &made) == 0 && S_ISDIR(made.st_mode);
            if (isFolder && made.st_uid == ::geteuid() && isRegular(copy)) copies.push_back(copy);
        }
    }
    std::ranges::sort(copies);
    return copies;
}

bool hasRowsAbout(const SqliteConnection& kept, const std::string& participant, bool answersToo)
{
    const auto has = [&](const char* rows) {
        return kept.value(QStringLiteral("SELECT EXISTS(SELECT 1 FROM %1)").arg(QLatin1String(rows)), {toQt(participant)})
                   .toInt() != 0;
    };
    if (checkedVersion(kept) < schemaVersion) return has("participants WHERE id = ?");
    return has("participant_facts WHERE participant = ?") ||
           (answersToo && (has("responses WHERE participant = ?") || has("notes WHERE participant = ?") ||
                           has("events WHERE participant = ? AND salt <> ''")));
}

}  // namespace

bool isNumbered(std::string_view name, std::string_view prefix, std::string_view ending)
{
    if (!name.starts_with(prefix) || !name.ends_with(ending) || name.size() <= prefix.size() + ending.size()) return false;
    return std::ranges::all_of(name.substr(prefix.size(), name.size() - prefix.size() - ending.size()),
                               [](char c) { return c >= '0' && c <= '9'; });
}

fs::path freeName(const fs::path& where, const std::string& prefix)
{
    std::error_code unknown;
    int number = 1;
    while (number < mostFiles && fs::exists(where / (prefix + std::to_string(number) + ".db"), unknown)) ++number;
    return where / (prefix + std::to_string(number) + ".db");
}

std::vector<fs::path> placesForRescue(const StudyFolder& folder)
{
    const fs::path study = namesOf(folder).front();
    return {freeName(folder.folder, rescueWord), freeName(study.parent_path(), prefixBeside(study)),
            freeName(protocols::temporaryPlaces().front(), prefixBeside(study))};
}

std::vector<fs::path> rescueFiles(const StudyFolder& folder)
{
    std::vector<fs::path> files;
    addInside(folder, files);
    for (const fs::path& study : namesOf(folder)) addFrom(study.parent_path(), prefixBeside(study), folder, files);
    std::erase_if(files, [&](const fs::path& file) { return isForeign(file, folder); });
    std::ranges::sort(files, {}, [](const fs::path& file) {
        std::error_code unknown;
        return fs::last_write_time(file, unknown);
    });
    return files;
}

std::vector<fs::path> rescueFilesOutside(const StudyFolder& folder)
{
    std::vector<fs::path> files;
    for (const fs::path& study : namesOf(folder)) {
        addFrom(study.parent_path(), prefixBeside(study), folder, files);
        for (const fs::path& place : protocols::temporaryPlaces()) addFrom(place, prefixBeside(study), folder, files);
    }
    std::erase_if(files, [](const fs::path& file) { return !isRegular(file) || ::access(file.c_str(), R_OK) != 0; });
    return files;
}

std::vector<fs::path> rescueFilesOfOthers(const StudyFolder& folder)
{
    std::vector<fs::path> files;
    for (const fs::path& study : namesOf(folder)) {
        addOfOthers(study.parent_path(), prefixBeside(study), files);
        for (const fs::path& place : protocols::temporaryPlaces()) addOfOthers(place, prefixBeside(study), files);
    }
    std::ranges::sort(files);
    return files;
}

bool isLeftBy(const fs::path& rescue, const StudyFolder& folder)
{
    std::vector<fs::path> files;
    addInside(folder, files);
    std::error_code missing;
    if (std::ranges::any_of(files, [&](const fs::path& file) { return fs::equivalent(file, rescue, missing); })) return true;
    const auto isBeside = [&](const fs::path& study) {
        return rescue.filename().string().starts_with(prefixBeside(study)) &&
               fs::equivalent(fs::absolute(rescue).parent_path(), study.parent_path(), missing);
    };
    return std::ranges::any_of(namesOf(folder), isBeside);
}

Origin originOf(const SqliteConnection& database, const StudyFolder& folder)
{
    const auto key = protocols::readIfPossible(folder.stationKey());
    const std::string committed = key ? factsIn(database).stationKeySha256 : std::string();
    if (committed.empty()) return Origin::Unknown;
    return protocols::sha256(*key) == committed ? Origin::ThisStudy : Origin::AnotherStudy;
}

std::optional<bool> rowsAbout(const fs::path& file, const std::string& participant, bool answersToo, const StudyFolder& folder)
{
    try {
        const SqliteConnection kept(file, SqliteConnection::Mode::Kept);
        if (hidesTables(kept)) return true;  // Its other tables may hold what was erased, and are not read.
        checkedVersion(kept);
        return originOf(kept, folder) != Origin::AnotherStudy && hasRowsAbout(kept, participant, answersToo);
    } catch (const protocols::Error&) {
        return std::nullopt;
    }
}

std::vector<std::string> databasesAbout(const std::string& participant, bool answersToo, const StudyFolder& folder)
{
    std::vector<std::string> found;
    std::error_code unreadable;
    const auto isAbout = [&](const fs::path& file) { return rowsAbout(file, participant, answersToo, folder).value_or(false); };
    for (const auto& entry : fs::directory_iterator(folder.folder, unreadable)) {
        const fs::path& file = entry.path();
        const std::string name = file.filename().string();
        const bool isOther = file.extension() == ".db" && file.filename() != folder.database().filename();
        // P1 and P1-2 may be two participants.
        const bool isOfSession =
            isNumbered(name, "held-" + participant + "-", ".json") || isNumbered(name, "not-sent-" + participant + "-", ".json");
        if (isRegular(file) && ((isOther && isAbout(file)) || (answersToo && isOfSession))) found.push_back(name);
    }
    std::vector<fs::path> outside = rescueFilesOutside(folder);
    std::ranges::copy(copiesOfKilledPrograms(), std::back_inserter(outside));
    for (const fs::path& file : outside)
        if (isAbout(file)) found.push_back(file.string());
    return found;
}

}  // namespace database
