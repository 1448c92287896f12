// A study on a server, as one of its stations sees it: the participants' progress, the list and the log of the one participant at
// work here, and no presentation before it is due. What the server cannot take at the moment waits in the station's queue.
#pragma once

#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <optional>

#include "database/disk/server_note.h"
#include "database/disk/write_lock.h"
#include "database/evidence/operator_latency.h"
#include "database/server/answer_queue.h"
#include "database/server/held_log.h"
#include "database/server/server_connection.h"
#include "database/server/server_link.h"
#include "database/session_store.h"

namespace database {

/// How long a step waits for a server before it counts as away.
struct ServerPatience {
    std::chrono::milliseconds presentation{4000};  ///< of an operator who waits for the next one
    std::chrono::milliseconds answer{1500};        ///< until it goes into the queue; also of signs of life and of leaving
};

class StationStore final : public SessionStore {
public:
    /// Joins the study of the folder's note and sends what waits there. Throws ServerAway, and badInput for a login without the
    /// right and for another study at the note's address.
    explicit StationStore(const StudyFolder& folder, ServerPatience patience = {});
    ~StationStore() override;
    StationStore(const StationStore&) = delete;
    StationStore& operator=(const StationStore&) = delete;

    const StudyFolder& folder() const override { return m_folder; }
    const StudyFacts& facts() const override { return m_facts; }
    std::vector<ProtocolVersion> protocolVersions() const override { return m_versions; }
    std::vector<Slot> slots() const override;
    std::vector<Enrolment> enrolments() const override;
    protocols::ParticipantId nextParticipantId() const override;
    std::map<protocols::ParticipantId, int> answerCounts() const override;
    Slot enrol(const protocols::ParticipantId& participant, ParticipantKind kind) override;
    std::vector<protocols::BlindedTrial> trials(int slot) const override;
    protocols::BlindedTrial dueTrial(int slot, protocols::TrialNumber number) override;
    std::vector<EventRecord> events(const protocols::ParticipantId& participant) const override;
    /// Throws workFailed, and stores nothing, once the server's log of the participant is another than the one held here.
    void append(const Append& entry) override;
    LogHead head() const override { return m_watch.head(); }

    /// Enrols a participant who must be new. Throws badInput where another station has enrolled this id in the meantime, or this
    /// participant has withdrawn. Where the server lost entries, a code could be given to a second person: the first call throws
    /// badInput, and a call for the same code after a second agrees to go on.
    void enrolNew(const protocols::ParticipantId& participant, ParticipantKind kind);
    /// Ends the work on the participant here, so that any station can go on. Never throws.
    void leaveParticipant();

    /// Adds a run of the latency task to the log. Throws badInput for an empty operator, ServerAway.
    void storeLatency(const OperatorLatency& run);

    /// The image of a presentation that was due, or of a fabric for familiarisation. Throws workFailed for any other code.
    ReleasedImage image(const protocols::SealedCode& code);
    /// Whether `sealed` of an image is a ticket, which the display's own login turns into the image.
    bool givesTickets() const { return m_givesTickets; }

    /// Whether answers reach the server now, and how many entries wait.
    struct Link {
        bool isUp = false;
        bool isRefused = false;  ///< the server answers, but takes nothing from this station now
        std::size_t waiting = 0;
        std::string station;
        std::string fault;     ///< why the link is down; empty where it is up
        std::string setAside;  ///< entries that the server refused, and their files, a line each; stays as long as the store
        std::string stale;     ///< why the session that is open here cannot go on; empty where it can
        std::optional<std::int64_t> lostAfter = {};  ///< entries that this station has seen are lost after this one; see SeenLog
        std::chrono::seconds clockAhead{0};  ///< clock of this computer minus that of the server, beyond the time of a call
        bool operator==(const Link&) const = default;
    };
    Link link() const;
    /// Tells the server that this station is alive, and sends what waits once the server can be reached again. Waits for nothing,
    /// but for the entries that it sends. A server that does not answer in time counts as away. Call it every few seconds.
    void refresh();

private:
    using Json = nlohmann::json;
    Json asked(const char* function, const QVariantList& arguments = {}) const;
    Json overview() const;
    QVariantList joining() const;
    void connectNow();
    void takeLink(std::unique_ptr<ServerLink> link, const Json& joined);
    void takeStudy(const Json& joined);
    void takeClaim(const Json& claimed);
    void claim(const std::string& participant, const std::string& kind);
    void requireLink();
    ServerAway away() const;
    void loseLink(const protocols::Error& why) const;
    /// Loses the link for a fault after which this connection is of no more use.
    void noteFault(const protocols::Error& fault) const;
    /// Returns the number of the entry in the log.
    std::int64_t send(const AnswerQueue::Entry& entry);
    void sendWaiting();
    void tellWaiting();
    void setAside(const AnswerQueue::Entry& first, const std::string& why);
    /// `how` the server's log of the participant differs. The session that is open here must be opened again.
    void endSession(const std::string& how);

    StudyFolder m_folder;
    ServerPatience m_patience;
    WriteLock m_lock;
    ServerNote m_note;
    AnswerQueue m_queue;
    LogWatch m_watch;
    mutable std::unique_ptr<ServerLink> m_link;  ///< null while the server cannot be reached
    mutable std::string m_fault;
    mutable bool m_isRefused = false;
    std::string m_setAside;
    mutable std::chrono::steady_clock::time_point m_lostAt = {};
    std::chrono::steady_clock::time_point m_signAt = {};  ///< when m_alive began
    std::chrono::system_clock::time_point m_signWallTime = {};
    std::chrono::seconds m_clockAhead{0};
    std::unique_ptr<ServerLink> m_attempt;  ///< to reach the server again
    std::future<ServerReply> m_joining, m_alive;
    StudyFacts m_facts;
    std::vector<ProtocolVersion> m_versions;
    mutable Json m_overview;
    std::string m_participant, m_kind;  ///< at work here; empty before
    bool m_givesTickets = false;
    bool m_isClaimed = false;  ///< in this connection
    bool m_isOpen = false;     ///< a session of the participant goes on here
    std::optional<protocols::Error> m_stale;
    int m_slot = 0;
    SlotState m_slotState = SlotState::Free;
    int m_protocolVersion = 1;
    std::vector<protocols::BlindedTrial> m_trials;
    std::vector<EventRecord> m_events;  ///< of the participant, with those that wait; these have the sequence 0
    std::map<protocols::SealedCode, ReleasedImage> m_images;
};

}  // namespace database
