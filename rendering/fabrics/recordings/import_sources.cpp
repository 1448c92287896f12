#include "rendering/fabrics/recordings/import_sources.h"

#include <algorithm>
#include <array>
#include <set>
#include <system_error>
#include <tuple>

#include "protocols/files/errors.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;

namespace {

std::string nameUpToLastUnderscore(const std::string& stem)
{
    const auto at = stem.rfind('_');
    return at == std::string::npos || at == 0 ? stem : stem.substr(0, at);
}

std::string nameBeforeForce(const std::string& stem)
{
    for (auto at = stem.find("_F"); at != std::string::npos && at + 2 < stem.size(); at = stem.find("_F", at + 1))
        if (at > 0 && stem[at + 2] >= '0' && stem[at + 2] <= '9') return stem.substr(0, at);
    return nameUpToLastUnderscore(stem);
}

bool hasEnding(const fs::path& file, std::span<const std::string_view> endings)
{
    const std::string ending = lowerCase(file.extension().string());
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

std::string listed(std::span<const std::string_view> endings)
{
    std::string list;
    for (const std::string_view ending : endings) list += (list.empty() ? "" : ", ") + std::string(ending);
    return list;
}

using EachFile = fs::recursive_directory_iterator;

/// Skips hidden folders with all that lies in them. True for a hidden file or folder.
bool isSkipped(EachFile& entry)
{
    if (!isHidden(entry->path())) return false;
    entry.disable_recursion_pending();
    return true;
}

void takeFolder(const fs::path& folder, std::span<const std::string_view> endings, FabricNaming naming,
                std::vector<SourceFile>& taken)
{
    const std::size_t before = taken.size();
    for (EachFile entry(folder, fs::directory_options::skip_permission_denied); entry != EachFile(); ++entry) {
        const fs::path& file = entry->path();
        if (isSkipped(entry) || !entry->is_regular_file() || !hasEnding(file, endings)) continue;
        const fs::path inside = file.lexically_relative(folder);
        const std::string stem = file.stem().string();
        std::string name = nameUpToLastUnderscore(stem);
        if (naming == FabricNaming::BeforeForce)
            name = nameBeforeForce(stem);
        else if (inside.has_parent_path())
            name = inside.begin()->string();
        taken.push_back({file, name});
    }
    if (taken.size() == before)
        throw protocols::badInput({"holds no file to import", folder.string(), "files ending in " + listed(endings),
                                   "choose the folder with the recordings"});
}

}  // namespace

bool isHidden(const fs::path& entry)
{
    const std::string name = entry.filename().string();
    constexpr std::array<std::string_view, 4> ofShares{"@eaDir", "#recycle", "@Recycle", "$RECYCLE.BIN"};
    return name.starts_with('.') || std::ranges::find(ofShares, name) != ofShares.end();
}

std::string lowerCase(std::string text)
{
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c + 32);
    return text;
}

std::string picturesLeftOut(std::span<const fs::path> from, std::span<const std::string_view> endings)
{
    constexpr std::string_view otherPictures[] = {".arw",  ".avif", ".cr2", ".cr3", ".dng", ".gif", ".heic",
                                                  ".heif", ".jp2",  ".nef", ".orf", ".raf", ".webp"};
    std::set<std::string> kinds;
    std::size_t count = 0;
    for (const fs::path& source : from) {
        std::error_code problem;
        for (EachFile entry(source, fs::directory_options::skip_permission_denied, problem); entry != EachFile(); ++entry) {
            const fs::path& file = entry->path();
            if (isSkipped(entry) || hasEnding(file, endings) || !hasEnding(file, otherPictures)) continue;
            kinds.insert(lowerCase(file.extension().string()));
            ++count;
        }
    }
    if (count == 0) return {};
    const std::vector<std::string> names(kinds.begin(), kinds.end());
    return std::to_string(count) + (count == 1 ? " picture was" : " pictures were") + " left out (" +
           listed(std::vector<std::string_view>(names.begin(), names.end())) + "); convert to PNG what belongs to the data set";
}

std::vector<SourceFile> sourceFiles(std::span<const fs::path> from, std::span<const std::string_view> endings,
                                    FabricNaming naming)
{
    if (from.empty()) throw protocols::badInput({"no source was named", "FROM", "files or folders", "name the recordings"});
    std::vector<SourceFile> taken;
    for (const fs::path& source : from) {
        std::error_code problem;
        if (fs::is_directory(source, problem)) {
            try {
                takeFolder(source, endings, naming, taken);
            } catch (const fs::filesystem_error& error) {
                throw protocols::badInput({"cannot be read (" + error.code().message() + ")", source.string(),
                                           "a readable folder", "check its permissions"});
            }
        } else if (!fs::is_regular_file(source, problem)) {
            throw protocols::badInput({"does not exist", source.string(), "a file or folder to import", "check the path"});
        } else if (!hasEnding(source, endings)) {
            throw protocols::badInput({"has a file ending that this import does not read", source.string(), listed(endings),
                                       "convert the file or choose another kind of import"});
        } else {
            const std::string stem = source.stem().string();
            taken.push_back({source, naming == FabricNaming::BeforeForce ? nameBeforeForce(stem) : nameUpToLastUnderscore(stem)});
        }
    }
    std::sort(taken.begin(), taken.end(), [](const SourceFile& a, const SourceFile& b) {
        return std::tie(a.fabricName, a.file) < std::tie(b.fabricName, b.file);
    });
    return taken;
}

}  // namespace rendering::fabrics
