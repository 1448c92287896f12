// study.db: the study's fixed facts, the slots of its participants, their blinded trial lists, and an
// append-only, hash-chained log of everything that happened. SQLite in WAL mode with synchronous FULL:
// when append() returns, the event and its answers are on the disk. (Qt loads its SQLite driver as a
// plug-in: a QCoreApplication must exist before a store is made or opened.)
// One writer at a time, by a lock on the folder that dies with its process; any number of readers.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database/study_folder.h"
#include "protocols/allocation.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace database {

/// A fabric outside the study's own with one friction image, for getting to know the display.
struct FamiliarisationItem {
    std::string name;
    protocols::FileCode fileCode;
    bool operator==(const FamiliarisationItem&) const = default;
};

/// Everything fixed when a study is made.
struct StudyFacts {
    std::string name;
    std::string protocolJson;  ///< the text, byte for byte, as in protocol.json
    std::string protocolSha256;
    std::uint64_t designSeed = 0;
    std::string keySha256;  ///< commitment to allocation-key.json
    std::string maskedKeySha256;
    std::string datasetPath;
    std::string datasetSha256;
    bool datasetProcedural = false;
    std::string modelSha256;          ///< empty where no condition is generated
    std::vector<std::string> stamps;  ///< sentences the report must carry, e.g. training samples allowed
    std::vector<protocols::FabricId> fabrics;
    std::map<protocols::FabricId, std::string> fabricNames;
    std::vector<protocols::SwatchLabels> swatches;  ///< [slot]; empty: fabric pieces go by their names
    std::vector<FamiliarisationItem> familiarisation;
    std::string signalsJson;  ///< generated against measured signals; "{}" where there is none
    std::string createdAt;    ///< wall clock, ISO 8601 with zone
    std::string programVersion;
};

enum class ParticipantKind { Human, Scripted, Simulated };
std::string nameOf(ParticipantKind kind);  ///< "human", "scripted", "simulated"

enum class SlotState { Free, Started, Finished, Withdrawn };
std::string nameOf(SlotState state);

/// One of the study's participant places with its fixed running order. A participant who withdraws frees it.
struct Slot {
    int number = 0;                        ///< from 1
    SlotState state = SlotState::Free;     ///< never Withdrawn
    protocols::ParticipantId participant;  ///< empty while free
    ParticipantKind kind = ParticipantKind::Human;
};

/// Somebody who took part, those who withdrew among them.
struct Enrolment {
    protocols::ParticipantId participant;
    int slot = 0;
    ParticipantKind kind = ParticipantKind::Human;
    SlotState state = SlotState::Started;  ///< never Free
    int protocolVersion = 1;               ///< the one their session follows
};

/// The study's protocol, and each later text of it that was taken over.
struct ProtocolVersion {
    int version = 1;
    std::string json, sha256;
    std::string who, why, wallTime;  ///< empty for the first
};

/// What happened, as the session engine stores it.
struct EventRecord {
    std::int64_t sequence = 0;  ///< set by append
    protocols::ParticipantId participant;
    int sitting = 0;   ///< counts the starts of the engine for this participant, from 1
    std::string kind;  ///< "answered", "corrected", "paused", ...
    std::string payloadJson;
    std::int64_t atNs = 0;  ///< the session's monotonic clock
    std::string wallTime;   ///< ISO 8601
};

/// One question's response, or a correction of an earlier one (which stays in the table; its stamps
/// stay the answer's, because a correction changes what was answered and not when).
struct AnswerRecord {
    protocols::TrialNumber trial;
    protocols::QuestionId question;
    protocols::FileCode fileCode;
    std::vector<protocols::FabricId> alternatives;
    std::optional<std::string> answer;        ///< a fabric id, "same" or "different", or words; by question
    std::optional<protocols::Tenths> rating;  ///< rating questions
    std::int64_t readyAtNs = 0;
    std::optional<std::int64_t> touchedAtNs;
    std::string touchedBy;  ///< "display" or "operator"; empty without a touch
    std::int64_t answeredAtNs = 0;
    std::string note;
    bool isCorrection = false;
};

/// A row of the view `answers`: the current answer to one question of one trial.
struct CurrentAnswer {
    protocols::ParticipantId participant;
    AnswerRecord record;
    std::int64_t event = 0;  ///< of the log: when it was first answered
    int attempt = 1;         ///< presentations of this trial to this participant; a void starts the next
    std::int64_t storedAtNs = 0;
    double seconds = 0;  ///< answered - touched, or - ready where no touch was stamped
    int corrections = 0;
    bool voided = false;
    std::string wallTime;
};

/// The recorded opening of the key.
struct UnblindingRecord {
    std::string who, why, wallTime;
};

/// The recorded removal of what is known about a participant.
struct Erasure {
    protocols::ParticipantId participant;
    bool answersToo = false;  ///< else facts and debriefing alone
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

    std::vector<Enrolment> enrolments() const;  ///< by slot, in each by time

    std::vector<ProtocolVersion> protocolVersions() const;
    /// Participants enrolled from now on follow it. Throws badInput where who or why is empty.
    void takeProtocol(const std::string& json, const std::string& who, const std::string& why);

    /// Takes the next free slot (or finds the participant's own). Throws workFailed when none is free,
    /// badInput where the id is empty, belongs to a participant of another kind, or was erased.
    Slot enrol(const protocols::ParticipantId& participant, ParticipantKind kind);
    /// "P01", "P02" ...: the next unused one.
    protocols::ParticipantId nextParticipantId() const;
    void setSlotState(const protocols::ParticipantId& participant, SlotState state);

    /// A remark on one presentation; the view shows it with each of its answers.
    struct Note {
        protocols::TrialNumber trial;
        std::string text;
        bool isFlag = false;  ///< marks the presentation for a look at it
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
        std::vector<std::pair<std::string, std::string>> facts;  ///< about the participant; kept outside the log
        std::int64_t storedAtNs = 0;                             ///< the session's clock just before the transaction
    };
    void append(const Append& entry);

    /// Presentations that the operator marked for a look at them.
    struct Flag {
        protocols::ParticipantId participant;
        protocols::TrialNumber trial;
        std::string text;
    };
    std::vector<Flag> flags() const;

    std::vector<EventRecord> events(const protocols::ParticipantId& participant) const;
    std::vector<CurrentAnswer> answers() const;  ///< of all participants, by slot, trial and question

    /// Facts about participants, as they were given and not erased.
    std::map<protocols::ParticipantId, std::map<std::string, std::string>> personalFacts() const;

    /// Removes facts and, where asked for, every answer and note, whose participant then counts as withdrawn;
    /// the act is recorded, and the log stays checkable. Throws badInput for an unknown participant or an
    /// empty who or why.
    void erase(const Erasure& erasure);
    std::vector<Erasure> erasures() const;

    /// A whole and consistent copy of study.db as one file that must not exist, also while a session runs.
    void copyTo(const std::filesystem::path& file) const;

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
