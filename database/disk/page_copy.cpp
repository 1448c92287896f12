#include "database/disk/page_copy.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "protocols/files/whole_file.h"

namespace database {

namespace {

constexpr std::size_t logHeadBytes = 32, frameHeadBytes = 24, fileHeadBytes = 100, blockPages = 64;
constexpr std::uint32_t smallestPage = 512, largestPage = 65536;
constexpr std::string_view beginningOfFile("SQLite format 3\0", 16);
constexpr int mostFollowings = 3;

std::uint32_t bigWordAt(const char* bytes)
{
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return std::endian::native == std::endian::big ? word : __builtin_bswap32(word);
}

using LogChecksum = std::array<std::uint32_t, 2>;

void addTo(LogChecksum& sum, std::span<const char> bytes, bool isBigEndian)
{
    const bool isSwapped = isBigEndian != (std::endian::native == std::endian::big);
    auto [first, second] = sum;
    std::array<std::uint32_t, 2> words{};
    for (std::size_t at = 0; at + sizeof words <= bytes.size(); at += sizeof words) {
        std::memcpy(words.data(), bytes.data() + at, sizeof words);  // a call for each word would take longer than the rest
        if (isSwapped) words = {__builtin_bswap32(words[0]), __builtin_bswap32(words[1])};
        first += words[0] + second;
        second += words[1] + first;
    }
    sum = {first, second};
}

LogChecksum checksumAt(const char* bytes) { return {bigWordAt(bytes), bigWordAt(bytes + 4)}; }

bool hasSalt(const char* bytes, const LogState& state) { return std::memcmp(bytes, state.salt.data(), state.salt.size()) == 0; }

}  // namespace

PageCopy::PageCopy(const RawDatabase& raw) : m_raw(raw)
{
    try {
        readAll();
    } catch (const std::bad_alloc&) {
        letGo();
    }
}

void PageCopy::letGo()
{
    m_isWhole = false;
    m_pages = std::vector<Page>();
    m_lastFrame = std::vector<std::uint32_t>();
}

void PageCopy::readAll()
{
    for (int attempt = 0; attempt < mostFollowings; ++attempt) {
        const auto before = m_raw.logState();
        if (!before || !readPages()) break;
        if (m_raw.logState() != before) continue;  // another process moved the log into the database meanwhile
        m_isWhole = true;
        m_log = {};
        m_log.salt = before->salt;
        if (follow({})) return;
    }
    letGo();
}

/// Those of the database file, without the log.
bool PageCopy::readPages()
{
    std::array<char, fileHeadBytes> head{};
    const std::int64_t bytes = m_raw.databaseBytes();
    if (bytes > largestCopy || !m_raw.readDatabase(0, head) ||
        !std::string_view(head.data(), head.size()).starts_with(beginningOfFile))
        return false;
    const std::uint32_t shortSize = bigWordAt(head.data() + 16) >> 16;
    m_pageBytes = shortSize == 1 ? largestPage : shortSize;
    if (m_pageBytes < smallestPage || m_pageBytes > largestPage) return false;
    m_pages.clear();
    m_pages.resize(static_cast<std::size_t>(bytes / m_pageBytes));
    m_lastFrame.assign(m_pages.size(), 0);
    for (std::size_t page = 0; page < m_pages.size(); ++page) {
        m_pages[page] = std::make_unique_for_overwrite<char[]>(m_pageBytes);
        if (!m_raw.readDatabase(static_cast<std::int64_t>(page) * m_pageBytes, {m_pages[page].get(), m_pageBytes})) return false;
    }
    return true;
}

bool PageCopy::follow(const Touched& touched)
{
    for (int attempt = 0; attempt < mostFollowings; ++attempt) {
        const auto now = m_raw.logState();
        try {
            if (!now || agreesWith(*now, touched)) return true;
        } catch (const std::bad_alloc&) {
            letGo();
            continue;
        }
        if (m_raw.logState() == now) return false;  // else another process emptied the log meanwhile
    }
    return false;
}

bool PageCopy::agreesWith(const LogState& now, const Touched& touched)
{
    if (m_isWhole && now.frames > 0 && std::int64_t{now.pages} * now.pageBytes > largestCopy) letGo();
    if (!m_isWhole) return lightlyAgreesWith(now);
    const bool beganAgain = now.salt != m_log.salt || now.frames < m_log.frames;
    const std::uint32_t known = beganAgain ? 0 : m_log.frames;
    if (beganAgain) std::ranges::fill(m_lastFrame, 0);
    m_backfilled = now.frames > 0 ? now.backfilled : 0;
    Frames fresh;
    if (now.frames > 0) {
        if (now.pageBytes != m_pageBytes || !beginsAsIn(now) || (known > 0 && !endsAsIn(m_log))) return false;
        if (now.frames > known && !readFrames(now, known, fresh)) return false;
        if (now.frames == known && touched.log && !eachFrame(now, 0, [](std::uint32_t, const char*) {})) return false;
    }
    // The copy takes a commit only where the database under it was the right one: SQLite may have read other bytes.
    const Moved moved = movedOf(fresh, known);
    const std::size_t lasting = now.frames > 0 ? std::min<std::size_t>(m_pages.size(), now.pages) : m_pages.size();
    if (!(beganAgain || touched.database ? allAreThere(lasting, moved) : someAreThere(lasting, moved))) return false;
    if (now.frames > known) take(std::move(fresh), now.pages);
    m_log = now;
    return true;
}

/// Without a copy: whether the last commit lies in the log, and the database is one.
bool PageCopy::lightlyAgreesWith(const LogState& now)
{
    std::array<char, beginningOfFile.size()> head{};
    if (!m_raw.readDatabase(0, head) || std::string_view(head.data(), head.size()) != beginningOfFile) return false;
    if (now.pageBytes > 0) m_pageBytes = now.pageBytes;
    return now.frames == 0 || (beginsAsIn(now) && endsAsIn(now));
}

std::int64_t PageCopy::placeOfFrame(std::uint32_t frame) const
{
    return std::int64_t{logHeadBytes} + std::int64_t{frame} * std::int64_t(frameHeadBytes + m_pageBytes);
}

bool PageCopy::beginsAsIn(const LogState& now)
{
    std::array<char, logHeadBytes> head{};
    if (!m_raw.readLog(0, head) || !hasSalt(head.data() + 16, now)) return false;
    LogChecksum sum{};
    addTo(sum, std::span(head).first(24), now.isBigEndian);
    m_headChecksum = sum;
    return sum == checksumAt(head.data() + 24);
}

bool PageCopy::endsAsIn(const LogState& state) const
{
    std::array<char, frameHeadBytes> head{};
    return m_raw.readLog(placeOfFrame(state.frames - 1), head) && bigWordAt(head.data() + 4) == state.pages &&
           hasSalt(head.data() + 8, state) && checksumAt(head.data() + 16) == state.checksum;
}

/// Gives the number and the bytes of each page behind the first `known` frames. False where a byte is another than SQLite wrote.
template <class Take>
bool PageCopy::eachFrame(const LogState& now, std::uint32_t known, const Take& take) const
{
    const std::size_t frameBytes = frameHeadBytes + m_pageBytes;
    LogChecksum sum = known == 0 ? m_headChecksum : m_log.checksum;
    std::vector<char> block;
    for (std::uint32_t frame = known; frame < now.frames;) {
        const std::size_t count = std::min<std::size_t>(blockPages, now.frames - frame);
        block.resize(count * frameBytes);
        if (!m_raw.readLog(placeOfFrame(frame), block)) return false;
        for (std::size_t i = 0; i < count; ++i, ++frame) {
            const char* head = block.data() + i * frameBytes;
            addTo(sum, {head, 8}, now.isBigEndian);
            addTo(sum, {head + frameHeadBytes, m_pageBytes}, now.isBigEndian);
            if (bigWordAt(head) == 0 || !hasSalt(head + 8, now) || sum != checksumAt(head + 16)) return false;
            take(bigWordAt(head), head + frameHeadBytes);
        }
    }
    return sum == now.checksum;
}

bool PageCopy::readFrames(const LogState& now, std::uint32_t known, Frames& fresh)
{
    const auto keep = [&](std::uint32_t number, const char* bytes) {
        fresh.emplace_back(number - 1, std::make_unique_for_overwrite<char[]>(m_pageBytes));
        std::memcpy(fresh.back().second.get(), bytes, m_pageBytes);
    };
    if (!eachFrame(now, known, keep)) return false;
    m_lastFrame.resize(std::max<std::size_t>(m_pages.size(), now.pages), 0);
    std::uint32_t frame = known;
    for (const auto& [page, bytes] : fresh) {
        ++frame;
        if (page < m_lastFrame.size()) m_lastFrame[page] = frame;
    }
    return true;
}

void PageCopy::take(Frames fresh, std::size_t pages)
{
    m_pages.resize(pages);
    m_lastFrame.resize(pages, 0);
    for (auto& [page, bytes] : fresh)
        if (page < pages) m_pages[page] = std::move(bytes);  // a later commit may have made the database smaller
}

/// SQLite begins a checkpoint at the end of the commit that makes the log long, so that the database may hold this commit, too.
PageCopy::Moved PageCopy::movedOf(const Frames& fresh, std::uint32_t known) const
{
    Moved moved;
    const std::size_t count = m_backfilled > known ? std::min<std::size_t>(fresh.size(), m_backfilled - known) : 0;
    for (const auto& [page, bytes] : std::span(fresh).first(count)) moved[page] = bytes.get();
    return moved;
}

bool PageCopy::isThere(std::size_t page, const char* found, const Moved& moved) const
{
    const auto place = moved.find(page);
    if (const char* known = place != moved.end() ? place->second : m_pages[page].get())
        return std::memcmp(found, known, m_pageBytes) == 0;
    return std::all_of(found, found + m_pageBytes, [](char byte) { return byte == 0; });
}

bool PageCopy::pagesAreThere(std::size_t first, std::size_t count, const Moved& moved) const
{
    std::vector<char> block(count * m_pageBytes);
    if (!m_raw.readDatabase(static_cast<std::int64_t>(first) * m_pageBytes, block)) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (!isThere(first + i, block.data() + i * m_pageBytes, moved) && !isInLogOnly(first + i)) return false;
    return true;
}

bool PageCopy::allAreThere(std::size_t pages, const Moved& moved) const
{
    for (std::size_t page = 0; page < pages; page += blockPages)
        if (!pagesAreThere(page, std::min(blockPages, pages - page), moved)) return false;
    return true;
}

/// The first page, which names the tables, and another one each time.
bool PageCopy::someAreThere(std::size_t pages, const Moved& moved)
{
    if (pages == 0) return true;
    m_sample = (m_sample + 1) % pages;
    return pagesAreThere(0, 1, moved) && pagesAreThere(m_sample, 1, moved);
}

void PageCopy::give(const protocols::TakeBytes& take) const
{
    const std::string zeros(m_pageBytes, '\0');
    for (std::size_t page = 0; page < m_pages.size(); ++page) {
        std::string bytes = m_pages[page] ? std::string(m_pages[page].get(), m_pageBytes) : zeros;
        if (page == 0) bytes[18] = bytes[19] = 1;  // without a write-ahead log
        take(bytes);
    }
}

void PageCopy::writeTo(const std::filesystem::path& file) const
{
    protocols::writeInPieces(
        file, [this](const protocols::TakeBytes& take) { give(take); }, protocols::Sync::Now, protocols::Readers::OwnerOnly);
}

}  // namespace database
