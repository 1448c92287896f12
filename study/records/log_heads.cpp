#include "study/records/log_heads.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"

namespace study::records {

namespace {

using database::LogHead;

constexpr std::size_t hashLength = 64;  // SHA-256 in hexadecimal

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool isWordPart(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool isBlank(char c) { return c == ' ' || c == '\t'; }

constexpr std::size_t shortestCopy = 8;   // fewer digits after a colon are a time, or anything else
constexpr std::size_t shortestWord = 12;  // the same, where blanks or other letters stand there
bool isHashDigit(char c) { return isDigit(c) || (c >= 'a' && c <= 'f'); }

std::string inSmallLetters(std::string_view text)
{
    std::string small(text);
    std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
    return small;
}

/// What stands around a colon: a number, perhaps blanks, and a word in small letters.
struct Around {
    std::size_t begin = 0, end = 0;
    std::string_view number;
    bool hasBlanks = false;
    std::string word;

    std::size_t hashDigitsInWord() const { return static_cast<std::size_t>(std::ranges::count_if(word, isHashDigit)); }
    bool isHash() const { return !word.empty() && hashDigitsInWord() == word.size(); }
    bool isHead() const { return isHash() && word.size() >= database::shortHeadLength && word.size() <= hashLength; }
    /// Whoever copies a head by hand may leave out a digit, or take 0 for O.
    bool seemsHead() const
    {
        if (std::ranges::none_of(word, [](char c) { return c >= 'a' && c <= 'f'; })) return false;  // a date and a time
        if (isHash() && word.size() >= shortestCopy && !hasBlanks) return true;
        return word.size() >= shortestWord && std::ranges::any_of(word, isDigit) && 4 * hashDigitsInWord() >= 3 * word.size();
    }
};

std::optional<Around> around(std::string_view text, std::size_t colon)
{
    Around found{colon, colon + 1, {}, false, {}};
    while (found.begin > 0 && isDigit(text[found.begin - 1])) --found.begin;
    if (found.begin == colon) return std::nullopt;
    const char before = found.begin == 0 ? ' ' : text[found.begin - 1];
    const bool isJoined = (before == '-' || before == '.') && found.begin > 1 && isWordPart(text[found.begin - 2]);
    if (isWordPart(before) || isJoined) return std::nullopt;  // "SHA-256: …", or an address of a computer
    found.number = text.substr(found.begin, colon - found.begin);
    while (found.end < text.size() && isBlank(text[found.end])) ++found.end;
    const std::size_t word = found.end;
    found.hasBlanks = word > colon + 1;
    while (found.end < text.size() && isWordPart(text[found.end])) ++found.end;
    found.word = inSmallLetters(text.substr(word, found.end - word));
    if (before == ':' && !found.isHead()) return std::nullopt;  // a time, or an address
    return found;
}

std::optional<LogHead> headOf(const Around& found)
{
    LogHead head{0, found.word};
    const auto [end, fault] = std::from_chars(found.number.data(), found.number.data() + found.number.size(), head.sequence);
    return found.isHead() && fault == std::errc() ? std::optional(std::move(head)) : std::nullopt;
}

GivenHeads headsInText(std::string_view text)
{
    GivenHeads given;
    std::set<std::pair<std::int64_t, std::string>> heads;
    std::set<std::string> unread;
    for (std::size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
        const auto found = around(text, colon);
        if (!found) continue;
        if (auto head = headOf(*found)) {
            if (heads.emplace(head->sequence, head->hash).second) given.heads.push_back(std::move(*head));
        } else if (found->seemsHead()) {
            std::string seen(text.substr(found->begin, found->end - found->begin));
            if (unread.insert(seen).second) given.unread.push_back(std::move(seen));
        }
    }
    return given;
}

/// Heads of the acts are given out beside those of the log, and no hash can be that of both.
bool isAmong(const std::map<std::int64_t, std::string>& hashes, const LogHead& head)
{
    if (head.sequence == 0) return std::ranges::any_of(hashes, [&](const auto& act) { return act.second == head.hash; });
    const auto act = hashes.find(head.sequence);
    return act != hashes.end() && act->second.starts_with(head.hash);
}

}  // namespace

GivenHeads headsIn(const std::string& headOrFile)
{
    const std::string small = inSmallLetters(headOrFile);
    if (small.size() == hashLength && std::ranges::all_of(small, isHashDigit)) return {{{0, small}}, {}};
    if (const std::size_t colon = headOrFile.find(':'); colon != std::string::npos)
        if (const auto found = around(headOrFile, colon); found && found->begin == 0 && found->end == headOrFile.size())
            if (const auto head = headOf(*found)) return {{*head}, {}};
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(headOrFile, unknown))
        throw protocols::badInput({"this is neither a head of a log nor a file", headOrFile,
                                   "SEQUENCE:HASH as a session, report, export or backup gives it, or a file that contains one",
                                   "check the text"});
    auto given = headsInText(protocols::readWholeFile(headOrFile));
    if (given.heads.empty() && given.unread.empty())
        throw protocols::badInput({"the file contains no head of a log", headOrFile, "SEQUENCE:HASH, for example in results.json",
                                   "name a report's results.json, an export.json or a certificate"});
    return given;
}

std::string headTextOf(const database::StudyStore& store)
{
    if (!store.hasLastingHead()) return "none before the upgrade of the study";
    return protocols::printable(textOf(store.head()));
}

void requireLastingHead(const database::StudyStore& store)
{
    if (!store.hasLastingHead())
        throw protocols::badInput({"an earlier version made this study, and its log has no head that lasts",
                                   store.namedFolder().string(), "an upgraded study",
                                   "open the study in the app or with replay, which upgrades it, and do it again"});
}

HeadCheck::HeadCheck(const database::StudyStore& store) : m_store(store), m_last(store.head()) {}

std::string HeadCheck::faultOf(const LogHead& head)
{
    if (head.sequence == 0 ? m_store.entryWithHash(head.hash).has_value()
                           : m_store.hashOfEntry(head.sequence).starts_with(head.hash))
        return {};
    if (!m_hashesOfActs) {
        m_hashesOfActs.emplace();
        for (database::ChainedAct& act : chainedActsOf(m_store)) m_hashesOfActs->emplace(act.number, std::move(act.hash));
    }
    if (isAmong(*m_hashesOfActs, head)) return {};
    if (head.sequence > m_last.sequence)
        return "the log ends at entry " + std::to_string(m_last.sequence) + ", and the head is entry " +
               std::to_string(head.sequence) + ": entries were cut off, or an earlier database was put back";
    return "no entry of the log and no act has this hash in this place: they were cut off or written anew, or the head is that "
           "of another study";
}

std::string faultAgainst(const database::StudyStore& store, const LogHead& head) { return HeadCheck(store).faultOf(head); }

}  // namespace study::records
