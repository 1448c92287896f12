#include "rendering/cache/result_cache.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <sstream>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"

namespace rendering::cache {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view headOfEntry = "vis2hap.cache/1 ";
constexpr std::size_t hexDigits = 64;
constexpr std::int64_t nanosecondsPerSecond = 1'000'000'000;
/// Coarsest time stamps of common file systems, in seconds.
constexpr std::int64_t coarseClockS = 2;
constexpr std::time_t abandonedAfterS = 3600;

bool isKey(std::string_view name)
{
    return name.size() == hexDigits && name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// The hash covers the key, so that an entry under another name is not believed.
std::string headFor(const std::string& key, std::string_view bytes)
{
    std::string text = key + "\n";
    text += bytes;
    return std::string(headOfEntry) + protocols::sha256(text) + "\n";
}

/// True for a folder of this user that nobody else can write to. Whoever can write entries could make false ones.
bool isOwnFolder(const fs::path& folder)
{
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) return false;
    if (status.st_uid != ::geteuid() || (status.st_mode & 022U) != 0) return false;
    return (status.st_mode & 077U) == 0 || ::chmod(folder.c_str(), 0700) == 0;
}

bool makeOwnFolder(const fs::path& folder)
{
    std::error_code problem;
    fs::create_directories(folder.parent_path(), problem);
    ::mkdir(folder.c_str(), 0700);
    return isOwnFolder(folder);
}

std::int64_t nanosecondsOf(const timespec& time) { return time.tv_sec * nanosecondsPerSecond + time.tv_nsec; }

/// Text that changes when the file is written or replaced. Nobody can set the time of the last change of the status back.
std::string identityOf(const struct stat& status)
{
    std::string text;
    for (const auto number :
         {static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino),
          static_cast<std::int64_t>(status.st_size), nanosecondsOf(status.st_mtim), nanosecondsOf(status.st_ctim)})
        text += (text.empty() ? "" : ":") + std::to_string(number);
    return text;
}

bool mayHaveChangedSince(const struct stat& status)
{
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    const std::int64_t changed = std::max(nanosecondsOf(status.st_mtim), nanosecondsOf(status.st_ctim));
    return changed > nanosecondsOf(now) - coarseClockS * nanosecondsPerSecond;
}

std::string keyOfKnownFiles(const fs::path& folder) { return protocols::sha256("hashes of the files in " + folder.string()); }

/// Folders as they were found, each as lines "identity sha256 name".
template <class Files>
std::string textOf(const Files& files)
{
    std::string text;
    for (const auto& [name, file] : files)
        if (name.find('\n') == std::string::npos) text += file.identity + " " + file.sha256 + " " + name + "\n";
    return text;
}

struct Entry {
    fs::path file;
    std::time_t used = 0;
    std::uint64_t bytes = 0;
};

/// Removes files that killed processes left unfinished on the way.
std::vector<Entry> entriesIn(const fs::path& folder)
{
    std::vector<Entry> entries;
    std::error_code problem;
    for (fs::directory_iterator at(folder, problem), end; !problem && at != end; at.increment(problem)) {
        struct stat status {};
        if (::lstat(at->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
        const std::string name = at->path().filename().string();
        if (isKey(name))
            entries.push_back({at->path(), status.st_mtim.tv_sec, static_cast<std::uint64_t>(status.st_size)});
        else if (name.starts_with(".") && name.find(".unfinished-") != std::string::npos &&
                 status.st_mtim.tv_sec + abandonedAfterS < std::time(nullptr))
            ::unlink(at->path().c_str());
    }
    return entries;
}

}  // namespace

ResultCache::ResultCache(fs::path folder, std::uint64_t mostBytes)
    : m_folder(std::move(folder)), m_mostBytes(mostBytes), m_isUsable(makeOwnFolder(m_folder))
{
}

ResultCache::~ResultCache()
{
    try {
        keepKnownFiles();
        if (m_use.kept > 0) removeOldest();
    } catch (const std::exception&) {
        // Only the reuse is lost.
    }
}

std::optional<std::string> ResultCache::find(const std::string& key)
{
    if (!m_isUsable) return std::nullopt;
    const fs::path file = m_folder / key;
    auto bytes = protocols::readIfPossible(file);
    const std::size_t head = headOfEntry.size() + hexDigits + 1;
    if (!bytes) {
        ++m_use.missing;
        return std::nullopt;
    }
    if (bytes->size() < head || std::string_view(*bytes).substr(0, head) != headFor(key, std::string_view(*bytes).substr(head))) {
        ++m_use.damaged;
        return std::nullopt;
    }
    ++m_use.found;
    ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0);  // the time of the last use, which decides what is removed first
    bytes->erase(0, head);
    return bytes;
}

void ResultCache::keep(const std::string& key, std::string_view bytes)
{
    if (!m_isUsable || bytes.size() > m_mostBytes / 4) return;
    try {
        std::string entry = headFor(key, bytes);
        entry += bytes;
        protocols::writeWholeFile(m_folder / key, entry, protocols::Sync::Later, protocols::Readers::OwnerOnly);
        ++m_use.kept;
    } catch (const protocols::Error&) {
        m_isUsable = false;  // a full or read-only disk; asking again would cost time only
    }
}

ResultCache::KnownFolder& ResultCache::knownIn(const fs::path& folder)
{
    const auto [place, isNew] = m_known.try_emplace(folder);
    if (!isNew) return place->second;
    const CacheUse before = m_use;  // hashes of files are no results
    std::istringstream lines(find(keyOfKnownFiles(folder)).value_or(""));
    m_use = before;
    for (std::string line; std::getline(lines, line);) {
        const auto first = line.find(' ');
        if (first == std::string::npos || line.size() < first + hexDigits + 3) continue;
        place->second[line.substr(first + hexDigits + 2)] = {line.substr(0, first), line.substr(first + 1, hexDigits)};
    }
    m_knownBefore[folder] = place->second;
    return place->second;
}

std::string ResultCache::hashOfFile(const fs::path& file)
{
    struct stat status {};
    if (!m_isUsable || ::stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return protocols::sha256OfFile(file);
    const fs::path whole = fs::absolute(file).lexically_normal();
    KnownFolder& known = knownIn(whole.parent_path());
    const std::string name = whole.filename().string(), identity = identityOf(status);
    if (const auto found = known.find(name); found != known.end() && found->second.identity == identity)
        return found->second.sha256;
    std::string hash = protocols::sha256OfFile(file);
    struct stat after {};
    if (::stat(file.c_str(), &after) == 0 && identityOf(after) == identity && !mayHaveChangedSince(status))
        known[name] = {identity, hash};
    else
        known.erase(name);
    return hash;
}

const std::string& ResultCache::hashOfProgram()
{
    std::error_code none;
    if (m_program.empty())
        if (const fs::path self = fs::read_symlink("/proc/self/exe", none); !none) m_program = hashOfFile(self);
    return m_program;
}

void ResultCache::keepKnownFiles()
{
    const CacheUse before = m_use;
    for (const auto& [folder, files] : m_known)
        if (files != m_knownBefore[folder]) keep(keyOfKnownFiles(folder), textOf(files));
    m_use = before;
}

void ResultCache::removeOldest() const
{
    auto entries = entriesIn(m_folder);
    std::uint64_t bytes = 0;
    for (const Entry& entry : entries) bytes += entry.bytes;
    if (bytes <= m_mostBytes) return;
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
    for (const Entry& entry : entries) {
        if (bytes <= m_mostBytes / 10 * 9) return;
        ::unlink(entry.file.c_str());
        bytes -= entry.bytes;
    }
}

std::optional<fs::path> usualFolder()
{
    const auto absoluteFrom = [](const char* variable) -> std::optional<fs::path> {
        const char* value = std::getenv(variable);
        return value != nullptr && fs::path(value).is_absolute() ? std::optional(fs::path(value)) : std::nullopt;
    };
    if (const auto folder = absoluteFrom("XDG_CACHE_HOME")) return *folder / "vis2hap";
    if (const auto home = absoluteFrom("HOME")) return *home / ".cache" / "vis2hap";
    return std::nullopt;
}

std::shared_ptr<ResultCache> usualCache()
{
    std::uint64_t megabytes = usualMostBytes >> 20U;
    if (const char* text = std::getenv("VIS2HAP_CACHE_MB"); text != nullptr && *text != '\0') {
        const char* end = text + std::string_view(text).size();
        const auto [rest, problem] = std::from_chars(text, end, megabytes);
        if (problem != std::errc{} || rest != end || megabytes > (std::uint64_t{1} << 40U))
            throw protocols::badInput({"is \"" + std::string(text) + "\"", "VIS2HAP_CACHE_MB", "a whole number of megabytes",
                                       "correct the variable, or use --no-cache"});
    }
    const auto folder = usualFolder();
    return folder && megabytes > 0 ? std::make_shared<ResultCache>(*folder, megabytes << 20U) : nullptr;
}

}  // namespace rendering::cache
