#include "database/row_audit.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "database/disk/finger_text.h"
#include "database/disk/payload_fields.h"
#include "protocols/files/id_rule.h"

namespace database {

namespace {

using nlohmann::json;

constexpr std::int64_t farthestStampNs = std::int64_t{1} << 61;  ///< 73 years; a session refuses the same (session_moves.cpp)
constexpr std::size_t longestWallTime = 64;

bool isStamp(std::int64_t ns) { return ns > -farthestStampNs && ns < farthestStampNs; }

bool isWithin(const std::optional<std::int64_t>& stamp, std::int64_t from, std::int64_t to)
{
    return !stamp || (*stamp >= from && *stamp <= to);
}

/// One clock stamps a presentation: a session that was interrupted presents the trial again. A correction has the stamps of the
/// first answer, and may be stored after the clock began anew.
bool areStampsInOrder(const ResponseRow& row)
{
    return isStamp(row.readyAt) && isStamp(row.answeredAt) && isStamp(row.storedAt) && row.readyAt <= row.answeredAt &&
           isWithin(row.touchedAt, row.readyAt, row.answeredAt) &&
           isWithin(row.touchEndedAt, row.touchedAt.value_or(row.readyAt), row.answeredAt) &&
           isWithin(row.answerBegunAt, row.readyAt, row.answeredAt);
}

bool isOneOf(const std::optional<std::string>& name, std::initializer_list<std::string_view> known)
{
    return !name || name->empty() || std::ranges::find(known, *name) != known.end();
}

/// What programs write is plain letters, so that the rule for all scripts is seldom asked.
bool isWallTime(const std::string& text)
{
    const bool isVisible =
        text.size() <= longestWallTime && std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
    return isVisible || protocols::faultOfLine(text, longestWallTime).empty();
}

/// Whether JSON writes the character as it is.
bool isPlain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; }

/// Takes a plain word in quotes off the front: printable ASCII without a backslash.
bool takeWord(std::string_view& text)
{
    if (!text.starts_with('"')) return false;
    std::size_t end = 1;
    while (end < text.size() && isPlain(text[end])) ++end;
    if (end >= text.size() || text[end] != '"') return false;
    text.remove_prefix(end + 1);
    return true;
}

/// Takes a whole number without leading zeros off the front.
bool takeNumber(std::string_view& text)
{
    const std::size_t first = text.starts_with('-') ? 1 : 0;
    std::size_t end = first;
    while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
    if (end == first || end > first + 18 || (text[first] == '0' && end > first + 1)) return false;
    text.remove_prefix(end);
    return true;
}

/// The end of an object that holds plain words and whole numbers: ,"entries":1,"by":"entry"}
bool areFurtherFields(std::string_view text)
{
    while (text.starts_with(',')) {
        text.remove_prefix(1);
        if (!takeWord(text) || !text.starts_with(':')) return false;
        text.remove_prefix(1);
        if (!(text.starts_with('"') ? takeWord(text) : takeNumber(text))) return false;
    }
    return text == "}";
}

/// Whether the payload is the usual text of this answer, which need not be parsed: {"tenths":54,…} or {"fabric":"F01",…}.
bool isPlainly(const std::string& payload, const ResponseRow& row)
{
    std::string usual;
    if (row.ratingTenths)
        usual = "{\"tenths\":" + std::to_string(*row.ratingTenths);
    else if (row.choice && std::ranges::all_of(*row.choice, isPlain))
        usual = "{\"fabric\":\"" + *row.choice + '"';
    if (usual.empty() || !payload.starts_with(usual)) return false;
    const std::string_view rest = std::string_view(payload).substr(usual.size());
    // Of a key that occurs twice the last value counts, and a backslash may hide a key.
    return areFurtherFields(rest) &&
           std::ranges::none_of(std::initializer_list<std::string_view>{"fabric", "same", "words", "tenths"},
                                [&](std::string_view other) { return rest.find(other) != std::string_view::npos; });
}

/// Whether the payload tells this answer, as a session that goes on reads it (study/session).
bool isToldBy(const json& payload, const ResponseRow& row, const std::string& field)
{
    if (!payload.contains(field)) return false;
    if (field == "same") return payload[field].is_boolean() && row.choice == (yesIn(payload, "same") ? "same" : "different");
    if (field != "tenths") return payload[field].is_string() && row.choice == textIn(payload, field.c_str());
    return payload[field].is_number_integer() && row.ratingTenths && payload[field].dump() == std::to_string(*row.ratingTenths);
}

/// The field of the payload that a session would read for this question; empty where there is none.
std::string fieldOf(const json& payload, const std::string& question, const TellingFields& fields)
{
    if (const auto known = fields.find(question); known != fields.end()) return known->second;
    for (const char* field : {"fabric", "same", "words", "tenths"})
        if (payload.contains(field)) return field;
    return "";
}

/// Whether the answers of the entry are those that its kind and its payload tell.
bool areAnswersTold(const LogEntry& entry, const TellingFields& fields)
{
    const bool isCorrection = entry.event.kind == "corrected";
    if (!isCorrection && entry.event.kind != "answered") return entry.responses.empty();
    if (entry.responses.size() != 1 || entry.responses.front().isCorrection != isCorrection) return false;
    const ResponseRow& row = entry.responses.front();
    const auto known = fields.find(row.question);
    const bool isUsual = known == fields.end() || known->second == (row.ratingTenths ? "tenths" : "fabric");
    if (!isCorrection && isUsual && isPlainly(entry.event.payloadJson, row)) return true;
    const json payload = payloadIn(entry.event.payloadJson);
    return isToldBy(payload, row, fieldOf(payload, row.question, fields)) &&
           (!isCorrection || row.question == textIn(payload, "question"));
}

void checkRow(const ResponseRow& row, std::vector<std::string>& faults)
{
    const std::string place = "trial " + std::to_string(row.trial) + ", " + row.question + ": ";
    if (!areStampsInOrder(row))
        faults.push_back(place + "the stamps are not those of one clock (expected ready, touched, answer begun, answered)");
    if (!isOneOf(row.touchedBy, {"display", "operator"})) faults.push_back(place + "touched_by is neither display nor operator");
    if (!isOneOf(row.answerBegunBy, {"entry", "spoken", "script"}))
        faults.push_back(place + "answer_begun_by is none of entry, spoken and script");
    if (row.entries.value_or(0) < 0) faults.push_back(place + "the number of entries is below 0");
}

}  // namespace

std::vector<std::string> faultsOfEntry(const LogEntry& entry, const TellingFields& fields)
{
    std::vector<std::string> faults;
    if (!isWallTime(entry.event.wallTime)) faults.emplace_back("wall_time is no line of at most 64 visible characters");
    if (!isStamp(entry.event.atNs)) faults.emplace_back("at_ns is no time of a clock");
    if (entry.event.sitting < 0) faults.emplace_back("the number of the sitting is below 0");
    if (!areAnswersTold(entry, fields)) faults.emplace_back("the answer in the table is not the one that the entry tells");
    for (const ResponseRow& row : entry.responses) checkRow(row, faults);
    return faults;
}

std::string faultOfFinger(const FingerRow& row, const std::string& samples)
{
    const auto read = fingerSamplesFrom(samples, row.beganAt);
    if (!read) return "the samples cannot be read";
    if (row.count < 1 || read->size() != static_cast<std::size_t>(row.count))
        return "count is " + std::to_string(row.count) + ", and there are " + std::to_string(read->size()) + " samples";
    return row.leftOut < 0 ? "left_out is below 0" : "";
}

}  // namespace database
