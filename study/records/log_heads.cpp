#include "study/records/log_heads.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "database/evidence/acts.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace study::records {

namespace {

using database::LogHead;

constexpr std::size_t hashLength = 64;  // SHA-256 in hexadecimal

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool isWordPart(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool isHashDigit(char c) { return isDigit(c) || (c >= 'a' && c <= 'f'); }

/// The hash, or its first 16 digits and more, at the beginning of the text; empty where there is none.
std::string_view hashAt(std::string_view text)
{
    const auto digits = static_cast<std::size_t>(std::ranges::find_if_not(text, isHashDigit) - text.begin());
    const bool isHash = digits >= database::shortHeadLength && digits <= hashLength;
    const bool ends = isHash && (digits == text.size() || !isWordPart(text[digits]));
    return ends ? text.substr(0, digits) : std::string_view();
}

/// The head around the colon at `colon`.
std::optional<LogHead> headAround(std::string_view text, std::size_t colon)
{
    const std::string_view hash = hashAt(text.substr(colon + 1));
    std::size_t begin = colon;
    while (begin > 0 && isDigit(text[begin - 1])) --begin;
    if (hash.empty() || begin == colon || (begin > 0 && isWordPart(text[begin - 1]))) return std::nullopt;
    LogHead head{0, std::string(hash)};
    const auto [end, fault] = std::from_chars(text.data() + begin, text.data() + colon, head.sequence);
    return fault == std::errc() ? std::optional(head) : std::nullopt;
}

std::vector<LogHead> headsInText(std::string_view text)
{
    std::vector<LogHead> heads;
    for (std::size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':', colon + 1))
        if (auto head = headAround(text, colon); head && std::ranges::find(heads, *head) == heads.end())
            heads.push_back(std::move(*head));
    return heads;
}

/// Heads of the acts are given out beside those of the log, and no hash can be that of both.
bool isAmongActs(const database::StudyStore& store, const LogHead& head)
{
    return std::ranges::any_of(chainedActsOf(store), [&](const database::ChainedAct& act) {
        return head.sequence == 0 ? act.hash == head.hash : act.number == head.sequence && act.hash.starts_with(head.hash);
    });
}

}  // namespace

std::vector<LogHead> headsIn(const std::string& headOrFile)
{
    if (headOrFile.size() == hashLength && hashAt(headOrFile) == headOrFile) return {{0, headOrFile}};
    const std::size_t colon = headOrFile.find(':');
    if (colon != std::string::npos)
        if (auto head = headAround(headOrFile, colon); head && textOf(*head) == headOrFile) return {*head};
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(headOrFile, unknown))
        throw protocols::badInput({"this is neither a head of a log nor a file", headOrFile,
                                   "SEQUENCE:HASH as a session, report, export or backup gives it, or a file that contains one",
                                   "check the text"});
    auto heads = headsInText(protocols::readWholeFile(headOrFile));
    if (heads.empty())
        throw protocols::badInput({"the file contains no head of a log", headOrFile, "SEQUENCE:HASH, for example in results.json",
                                   "name a report's results.json, an export.json or a certificate"});
    return heads;
}

std::string headTextOf(const database::StudyStore& store)
{
    return store.hasLastingHead() ? textOf(store.head()) : std::string("none before the upgrade of the study");
}

void requireLastingHead(const database::StudyStore& store)
{
    if (!store.hasLastingHead())
        throw protocols::badInput({"an earlier version made this study, and its log has no head that lasts",
                                   store.namedFolder().string(), "an upgraded study",
                                   "open the study in the app or with replay, which upgrades it, and do it again"});
}

std::string faultAgainst(const database::StudyStore& store, const LogHead& head)
{
    const auto last = store.head();
    if (head.sequence == 0 ? store.entryWithHash(head.hash).has_value() : store.hashOfEntry(head.sequence).starts_with(head.hash))
        return {};
    if (isAmongActs(store, head)) return {};
    if (head.sequence > last.sequence)
        return "the log ends at entry " + std::to_string(last.sequence) + ", and the head is entry " +
               std::to_string(head.sequence) + ": entries were cut off, or an earlier database was put back";
    return "no entry of the log and no act has this hash in this place: they were cut off or written anew, or the head is that "
           "of "
           "another study";
}

}  // namespace study::records
