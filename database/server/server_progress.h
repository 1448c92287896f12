// Progress of a study on a server and its stations, for monitors, analysts and the owner: states and counts, no answers.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "database/server/server_link.h"
#include "database/session_store.h"

namespace database {

/// Seconds without a sign of life after which a station counts as lost. The server ends a silent connection after the same time
/// (join_study in functions.sql).
constexpr int lostAfterSeconds = 20;

/// One station of a study as monitors see it.
struct StationSeen {
    std::string station, login, participant;  ///< participant: empty without a session
    bool isLive = false;                      ///< its connection holds
    int waiting = 0;                          ///< entries in its queue, as it reported last
    int lastSeenSeconds = 0;
    std::string program = {};  ///< name and version; empty where the server does not give them
    bool isLost() const { return !isLive || lastSeenSeconds > lostAfterSeconds; }
};

/// Answers that may still wait at a station, though its row is that of a later connection, or gone.
struct OwedSeen {
    std::string station, participant;  ///< participant: empty where it is not known
    int waiting = 0;                   ///< entries in its queue, as it reported last
};

/// One place of the study. A participant who withdrew keeps an entry of their own before the next one of the place.
struct PlaceSeen {
    int slot = 0;
    SlotState state = SlotState::Free;
    std::string participant;  ///< empty if the place is free
    ParticipantKind kind = ParticipantKind::Human;
    int answers = 0;
};

struct ServerProgress {
    std::vector<StationSeen> stations;  ///< by name
    std::vector<OwedSeen> owed;         ///< by station
    std::vector<PlaceSeen> places;      ///< by slot
    int free = 0, started = 0, finished = 0, withdrawn = 0, answers = 0;
    std::string head;
};

/// Places that the server gives to nobody before the study's owner releases them: who had them last withdrew, and none is free.
std::set<int> heldPlaces(const ServerProgress& progress);

/// Waits for the server. Throws the errors of ServerConnection.
ServerProgress progressOf(const ServerAddress& address);

/// Asks a server for the progress again and again, and waits for nothing.
class ProgressWatch {
public:
    explicit ProgressWatch(ServerAddress address) : m_address(std::move(address)) {}

    /// Asks, unless the last question still waits for its reply. Where no thread can begin, take() has the fault.
    void ask();
    /// Takes a reply or a fault that has arrived. Returns whether there was one.
    bool take();

    /// The last reply; none before the first.
    const std::optional<ServerProgress>& seen() const { return m_seen; }
    /// Time since the last reply.
    std::chrono::seconds age() const;
    /// Why the last question has no reply; empty where it has one.
    const std::string& fault() const { return m_fault; }
    /// Whether the fault is that nobody answers. Otherwise the server refused the question.
    bool isAway() const { return m_isAway; }

private:
    void lose(const std::string& why, bool isAway);

    ServerAddress m_address;
    std::unique_ptr<ServerLink> m_link;
    std::future<ServerReply> m_reply;
    std::chrono::steady_clock::time_point m_askedAt = {}, m_seenAt = {};
    std::optional<ServerProgress> m_seen;
    std::string m_fault;
    bool m_isAway = false;
    bool m_isUntold = false;  ///< a question that could not be asked
};

}  // namespace database
