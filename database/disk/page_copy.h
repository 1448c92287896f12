// The database of an open study once more, in memory: read when the study is opened, and from then on kept up to date with the
// frames that each commit leaves in the write-ahead log. It tells whether the files still hold what was committed, and outlives
// them. It grants no secrecy that the process itself does not have, and ends with it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "database/disk/raw_database.h"
#include "protocols/files/whole_file.h"

namespace database {

/// Databases up to this size are kept in memory, bytes.
inline constexpr std::int64_t largestCopy = std::int64_t{1} << 30;

class PageCopy {
public:
    /// Reads the whole database. `raw` must live longer.
    explicit PageCopy(const RawDatabase& raw);

    /// False for a database that is too large, or once letGo() was called: only its log is compared then.
    bool isWhole() const { return m_isWhole; }
    void letGo();

    /// Which files have another size or time than at the last call, so that all of their bytes are compared.
    struct Touched {
        bool database = false, log = false;
    };

    /// Takes over what was committed since the last call. False where the files do not hold it, or do not hold any more what they
    /// held then. Without `touched`, a few of the bytes are compared.
    bool follow(const Touched& touched);

    /// The bytes of the whole database, complete without a write-ahead log, page by page.
    void give(const protocols::TakeBytes& take) const;
    std::int64_t bytes() const { return static_cast<std::int64_t>(m_pages.size()) * m_pageBytes; }

    /// Writes the database into one new file, readable by its owner only. Throws environmentFault.
    void writeTo(const std::filesystem::path& file) const;

private:
    using Page = std::unique_ptr<char[]>;
    using Frames = std::vector<std::pair<std::size_t, Page>>;  ///< each with the place of its page
    using Moved = std::map<std::size_t, const char*>;          ///< pages of a new commit that the database holds already
    using Checksum = std::array<std::uint32_t, 2>;

    void readAll();
    bool readPages();
    bool agreesWith(const LogState& now, const Touched& touched);
    bool lightlyAgreesWith(const LogState& now);
    bool beginsAsIn(const LogState& now);
    bool endsAsIn(const LogState& state) const;
    bool readFrames(const LogState& now, std::uint32_t known, Frames& fresh);
    void take(Frames fresh, std::size_t pages);
    template <class Take>
    bool eachFrame(const LogState& now, std::uint32_t known, const Take& take) const;
    Moved movedOf(const Frames& fresh, std::uint32_t known) const;
    bool isThere(std::size_t page, const char* found, const Moved& moved) const;
    bool pagesAreThere(std::size_t first, std::size_t count, const Moved& moved) const;
    bool allAreThere(std::size_t pages, const Moved& moved) const;
    bool someAreThere(std::size_t pages, const Moved& moved);
    /// So that the database file may hold an older page.
    bool isInLogOnly(std::size_t page) const { return page < m_lastFrame.size() && m_lastFrame[page] > m_backfilled; }
    std::int64_t placeOfFrame(std::uint32_t frame) const;

    const RawDatabase& m_raw;
    bool m_isWhole = false;
    std::uint32_t m_pageBytes = 0;
    std::vector<Page> m_pages;               ///< in their order; null: zeros
    std::vector<std::uint32_t> m_lastFrame;  ///< the last one of each page in the log, from 1; 0: none
    std::uint32_t m_backfilled = 0;          ///< as in LogState
    LogState m_log;                          ///< at the last follow()
    Checksum m_headChecksum = {};            ///< of the header of the log
    std::size_t m_sample = 0;                ///< the page that is compared next where nothing was touched
};

}  // namespace database
