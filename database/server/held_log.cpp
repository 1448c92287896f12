#include "database/server/held_log.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

constexpr auto longerThanABounce = std::chrono::seconds(1);  ///< of a key: an operator who agrees has read the question
constexpr auto longestThought = std::chrono::minutes(10);    ///< after it the question comes again

bool isConfirmed(const EventRecord& entry) { return entry.sequence != 0; }

bool isSameEntry(const EventRecord& held, const EventRecord& onServer)
{
    return (!isConfirmed(held) || held.sequence == onServer.sequence) && held.sitting == onServer.sitting &&
           held.kind == onServer.kind && held.payloadJson == onServer.payloadJson && held.atNs == onServer.atNs;
}

}  // namespace

std::optional<std::string> differenceOf(const std::string& participant, const std::vector<EventRecord>& held,
                                        const std::vector<EventRecord>& onServer)
{
    const auto confirmed = static_cast<std::size_t>(std::ranges::count_if(held, isConfirmed));
    const std::size_t found = onServer.size();
    if (found < confirmed) return "lost entries of " + participant + " (" + std::to_string(confirmed - found) + ")";
    const auto [one, other] = std::ranges::mismatch(held, onServer, isSameEntry);
    if (other == onServer.end()) return std::nullopt;
    if (one != held.end() && isConfirmed(*one)) return "has other entries of " + participant;
    return "gained entries of " + participant + " (" + std::to_string(found - confirmed) + ")";
}

void confirmFirst(std::vector<EventRecord>& held, std::int64_t sequence)
{
    if (std::ranges::find(held, sequence, &EventRecord::sequence) != held.end()) return;
    const auto first = std::ranges::find_if_not(held, isConfirmed);
    if (first != held.end()) first->sequence = sequence;
}

std::filesystem::path keepHeldLog(const StudyFolder& folder, const std::string& participant, const std::vector<EventRecord>& held)
{
    std::string lines;
    for (const EventRecord& entry : held)
        lines += nlohmann::ordered_json{{"sequence", entry.sequence},   {"sitting", entry.sitting}, {"kind", entry.kind},
                                        {"payload", entry.payloadJson}, {"at_ns", entry.atNs},      {"wall_time", entry.wallTime}}
                     .dump() +
                 "\n";
    std::filesystem::path file;
    for (int number = 1; file.empty() || std::filesystem::exists(file); ++number)
        file = folder.folder / ("held-" + participant + "-" + std::to_string(number) + ".json");
    protocols::writeWholeFile(file, lines, protocols::Sync::Now, protocols::Readers::OwnerOnly);
    return file;
}

std::filesystem::path keepNotSent(const StudyFolder& folder, AnswerQueue& queue, const AnswerQueue::Entry& first)
{
    std::filesystem::path file;
    for (auto number = first.number; file.empty() || std::filesystem::exists(file); ++number)
        file = folder.folder / ("not-sent-" + first.participant + "-" + std::to_string(number) + ".json");
    std::string lines;
    for (auto entry = std::optional(first); entry && entry->participant == first.participant; entry = queue.first()) {
        lines += entry->json + "\n";
        protocols::writeWholeFile(file, lines, protocols::Sync::Now, protocols::Readers::OwnerOnly);
        queue.remove(entry->number);
    }
    return file;
}

SeenLog afterHead(const SeenLog& seen, const LogHead& onServer)
{
    if (onServer == seen.head) return {seen.study, seen.head, {}};
    if (seen.lostAfter) return seen;
    if (onServer.sequence > seen.head.sequence) return {seen.study, onServer, {}};
    const auto known = std::max<std::int64_t>(0, std::min(onServer.sequence, seen.head.sequence - 1));
    return {seen.study, seen.head, known};
}

void LogWatch::see(const LogHead& onServer)
{
    m_head = onServer;
    const SeenLog now = afterHead(m_seen, onServer);
    if (now == m_seen) return;
    m_seen = now;
    m_queue.keepSeen(now);
}

void LogWatch::requireAgreement(const protocols::ParticipantId& participant, const std::string& where)
{
    if (!m_seen.lostAfter) return;
    const auto now = std::chrono::steady_clock::now();
    const auto waited = now - m_askedAt;
    if (m_asked != participant.value || waited < longerThanABounce || waited > longestThought) {
        m_asked = participant.value;
        m_askedAt = now;
        throw protocols::badInput({"the server lost entries after entry " + std::to_string(*m_seen.lostAfter) +
                                       ", so codes of participants may be lost, too",
                                   where, "",
                                   "ask the study's owner; if the owner agrees, enrol " + participant.value + " once more"});
    }
    m_asked.clear();
    m_seen = {m_seen.study, m_head, {}};
    m_queue.keepSeen(m_seen);
}

}  // namespace database
