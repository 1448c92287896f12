// Results that later runs use again: signals and ranges, never finished images. Each entry is a file under the SHA-256 of all
// that its result was computed from. A damaged entry counts as missing. The folder is for its owner alone.
//
// Blinding. An entry is keyed by recordings, settings and programs, and holds one signal or the range of one map. None of these
// depends on a study's secret. File codes, labels and running orders are unknown here, and finished images exist sealed only. The
// times of the entries may show which samples a study drew and when. The fabrics, the seed and the data set of a study are
// public, so everybody can draw these samples again. A study of a condition reads the same entries whichever code or label it
// has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace rendering::cache {

inline constexpr std::uint64_t usualMostBytes = std::uint64_t{2} << 30;

/// Use of a cache by one process.
struct CacheUse {
    int found = 0, missing = 0, damaged = 0, kept = 0;
};

/// For one thread. Several processes may share a folder. Nothing here throws for a fault of the disk: it costs only the reuse.
class ResultCache {
public:
    /// Makes the folder with mode 0700. A folder of another user, or one that others may write to, is not used.
    explicit ResultCache(std::filesystem::path folder, std::uint64_t mostBytes = usualMostBytes);
    /// Keeps the hashes of files, and removes the entries that were not used for longest where they exceed `mostBytes`.
    ~ResultCache();
    ResultCache(const ResultCache&) = delete;
    ResultCache& operator=(const ResultCache&) = delete;

    /// The bytes that were kept under `key`, 64 hexadecimal digits. nullopt where there are none, or where they are damaged.
    std::optional<std::string> find(const std::string& key);
    void keep(const std::string& key, std::string_view bytes);

    /// SHA-256 of a file. It is not read again while its place, size and times are those of an earlier reading. A file that
    /// changed within two seconds before a reading is read each time, because its times could not show a later change. Throws
    /// badInput.
    std::string hashOfFile(const std::filesystem::path& file);
    /// SHA-256 of the running program.
    const std::string& hashOfProgram();

    const std::filesystem::path& folder() const { return m_folder; }
    const CacheUse& use() const { return m_use; }
    bool isUsable() const { return m_isUsable; }

private:
    struct KnownFile {
        std::string identity;  ///< device, inode, size and times
        std::string sha256;
        bool operator==(const KnownFile&) const = default;
    };
    using KnownFolder = std::map<std::string, KnownFile>;  ///< by name

    KnownFolder& knownIn(const std::filesystem::path& folder);
    void keepKnownFiles();
    void removeOldest() const;

    std::filesystem::path m_folder;
    std::uint64_t m_mostBytes;
    bool m_isUsable = false;
    CacheUse m_use;
    std::string m_program;
    std::map<std::filesystem::path, KnownFolder> m_known, m_knownBefore;
};

/// $XDG_CACHE_HOME/vis2hap, else ~/.cache/vis2hap. nullopt where neither variable names an absolute folder.
std::optional<std::filesystem::path> usualFolder();

/// The cache in usualFolder(), of at most VIS2HAP_CACHE_MB megabytes (2048). Null where there is no folder, or for 0 megabytes.
/// Throws badInput where VIS2HAP_CACHE_MB is no whole number.
std::shared_ptr<ResultCache> usualCache();

}  // namespace rendering::cache
