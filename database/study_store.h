// study.db: the study's fixed facts, the slots of its participants, their blinded trial lists, and an
// append-only, hash-chained log of everything that happened. SQLite in WAL mode with synchronous FULL:
// when append() returns, the event and its answers are on the disk. (Qt loads its SQLite driver as a
// plug-in: a QCoreApplication must exist before a store is made or opened.)
// One writer at a time, by a lock on the folder that dies with its process; any number of readers.
#pragma once

#include "database/study_folder.h"
#include "protocols/allocation.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace database {

/// Everything fixed when a study is made.
struct StudyFacts {
    std::string name;
    std::string protocolJson;          ///< the text, byte for byte, as in protocol.json
    std::string protocolSha256;
    std::uint64_t designSeed = 0;
    std::string keySha256;             ///< commitment to allocation-key.json
    std::string maskedKeySha256;
    std::string datasetPath;
    std::string datasetSha256;
    bool datasetProcedural = false;
    std::string modelSha256;           ///< empty where no condition is generated
    std::vector<std::string> stamps;   ///< sentences the report must carry, e.g. training samples allowed
    std::vector<protocols::FabricId> fabrics;
    std::map<protocols::FabricId, std::string> fabricNames;
    std::string signalsJson;           ///< generated against measured signals; "{}" where there is none
    std::string createdAt;             ///< wall clock, ISO 8601 with zone
    std::string programVersion;
};

enum class ParticipantKind { Human, Scripted, Simulated };
std::string nameOf(ParticipantKind kind);  ///< "human", "scripted", "simulated"

enum class SlotState { Free, Started, Finished, Withdrawn };
std::string nameOf(SlotState state);

/// One of the study's participant places with its fixed running order.
struct Slot {
    int number = 0;  ///< from 1
    SlotState state = SlotState::Free;
    protocols::ParticipantId participant;  ///< empty while free
    ParticipantKind kind = ParticipantKind::Human;
};

/// What happened, as the session engine stores it.
struct EventRecord {
    std::int64_t sequence = 0;    ///< set by append
    protocols::ParticipantId participant;
    int sitting = 0;              ///< counts the starts of the engine for this participant, from 1
    std::string kind;             ///< "answered", "corrected", "paused", ...
    std::string payloadJson;
    std::int64_t atNs = 0;        ///< the session's monotonic clock
    std::string wallTime;         ///< ISO 8601
};

/// One question's response, or a correction of an earlier one (which stays in the table; its stamps
/// stay the answer's, because a correction changes what was answered and not when).
struct AnswerRecord {
    protocols::TrialNumber trial;
    protocols::QuestionId question;
    protocols::FileCode fileCode;
    std::vector<protocols::FabricId> alternatives;
    std::optional<protocols::FabricId> answer;   ///< choice questions
    std::optional<protocols::Tenths> rating;     ///< rating questions
    std::int64_t readyAtNs = 0;
    std::optional<std::int64_t> touchedAtNs;
    std::int64_t answeredAtNs = 0;
    std::string note;
    bool isCorrection = false;
};

/// A row of the view `answers`: the current answer to one question of one trial.
struct CurrentAnswer {
    protocols::ParticipantId participant;
    AnswerRecord record;
    int attempt = 1;            ///< presentations of this trial to this participant; a void starts the next
    std::int64_t storedAtNs = 0;
    double seconds = 0;         ///< answered - touched, or - ready where no touch was stamped
    int corrections = 0;
    bool voided = false;
    std::string wallTime;
};

/// The recorded opening of the key.
struct UnblindingRecord {
    std::string who, why, wallTime;
};

class StudyStore {
public:
    /// Makes study.db in an existing folder, in one transaction, with the blinded lists of all slots
    /// and the hash of every stimulus. Throws badInput where it exists, environmentFault on disk faults.
    static void create(const StudyFolder& folder, const StudyFacts& facts,
                       const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                       const std::map<protocols::FileCode, std::string>& stimulusHashes);

    enum class Access { Read, Write };
    /// Throws badInput for no study, environmentFault where the lock is held by another writer (naming
    /// its process) or the folder cannot be written.
    StudyStore(const StudyFolder& folder, Access access);
    ~StudyStore();
    StudyStore(StudyStore&&) noexcept;

    const StudyFolder& folder() const;
    StudyFacts facts() const;
    std::map<protocols::FileCode, std::string> stimulusHashes() const;
    std::vector<Slot> slots() const;
    std::vector<protocols::BlindedTrial> trials(int slot) const;

    /// Takes the next free slot (or finds the participant's own). Throws workFailed when none is free,
    /// badInput where the id is empty or belongs to a participant of another kind.
    Slot enrol(const protocols::ParticipantId& participant, ParticipantKind kind);
    /// "P01", "P02" ...: the next unused one.
    protocols::ParticipantId nextParticipantId() const;
    void setSlotState(const protocols::ParticipantId& participant, SlotState state);

    /// A remark on one presentation; the view shows it with each of its answers.
    struct Note {
        protocols::TrialNumber trial;
        std::string text;
    };
    /// One transaction: the event, its answers, the trial it voids, a note and, where given, the slot's
    /// new state. Returns when it is synced. Throws environmentFault (disk full, read-only) and stores
    /// nothing then; workFailed for an answer stored before, or a correction of none.
    struct Append {
        EventRecord event;
        std::vector<AnswerRecord> answers;
        std::optional<protocols::TrialNumber> voids;
        std::optional<Note> note;
        std::optional<SlotState> slotState;
        std::int64_t storedAtNs = 0;  ///< the session's clock just before the transaction
    };
    void append(const Append& entry);

    std::vector<EventRecord> events(const protocols::ParticipantId& participant) const;
    std::vector<CurrentAnswer> answers() const;  ///< of all participants, by slot, trial and question

    /// Every act is recorded; `unblinding` is the first. Throws badInput where who or why is empty.
    void recordUnblinding(const UnblindingRecord& record);
    std::optional<UnblindingRecord> unblinding() const;

    /// PRAGMA synchronous of this connection: 2.
    int synchronousMode() const;
    /// integrity_check, foreign keys and the hash chain: a line for each fault.
    std::vector<std::string> faults() const;

private:
    struct Connection;
    std::unique_ptr<Connection> m_connection;
};

}  // namespace database
