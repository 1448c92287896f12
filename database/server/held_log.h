// The log as a station holds it, compared with the server's: that of one participant at a new claim, and the newest entry of the
// whole study. Entries that the server has not confirmed have the sequence 0.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "database/server/answer_queue.h"
#include "database/session_store.h"

namespace database {

/// How the server's log differs, such as "lost entries of P01 (2)"; none where every confirmed entry stands at its place and only
/// held entries follow.
std::optional<std::string> differenceOf(const std::string& participant, const std::vector<EventRecord>& held,
                                        const std::vector<EventRecord>& onServer);

/// The first held entry without a number gets this one, unless an entry has it already.
void confirmFirst(std::vector<EventRecord>& held, std::int64_t sequence);

/// Writes the held entries into a new file of the folder, one a line, and returns the file.
std::filesystem::path keepHeldLog(const StudyFolder& folder, const std::string& participant,
                                  const std::vector<EventRecord>& held);

/// Moves the entries of this participant from the front of the queue into a file of the folder, and returns the file.
std::filesystem::path keepNotSent(const StudyFolder& folder, AnswerQueue& queue, const AnswerQueue::Entry& first);

/// What a station has seen once the server has named its newest entry. Every act makes the log longer. A log that ends before
/// the newest entry that was seen, or has another one in its place, has lost entries. They count as lost until the server has
/// exactly that entry again, as after a newer backup, or until somebody agrees to go on.
SeenLog afterHead(const SeenLog& seen, const LogHead& onServer);

/// The newest entry of the server's log, compared with the one that the station's folder remembers.
class LogWatch {
public:
    explicit LogWatch(AnswerQueue& queue) : m_queue(queue) {}

    /// Reads what the folder remembers of this study.
    void begin(const std::string& study) { m_seen = m_queue.seenOf(study); }
    void see(const LogHead& onServer);
    const LogHead& head() const { return m_head; }
    const std::optional<std::int64_t>& lostAfter() const { return m_seen.lostAfter; }
    /// Before a new participant: where the server lost entries, a code could be given to a second person. The first call throws
    /// badInput with the place `where`; a call for the same code 1 s to 10 minutes later agrees to go on.
    void requireAgreement(const protocols::ParticipantId& participant, const std::string& where);

private:
    AnswerQueue& m_queue;
    LogHead m_head;
    SeenLog m_seen;
    std::string m_asked;  ///< for this code
    std::chrono::steady_clock::time_point m_askedAt = {};
};

}  // namespace database
