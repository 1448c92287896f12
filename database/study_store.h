// study.db: the fixed facts of a study, the slots of its participants, their blinded trial lists, and an append-only,
// hash-chained log of all events. SQLite in WAL mode with synchronous FULL: when append() returns, the event and its answers are
// on the disk. A QCoreApplication must exist first, because Qt loads its SQLite driver as a plug-in. One writer at a time, by a
// lock on the folder that ends with its process; any number of readers.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database/study_folder.h"
#include "protocols/allocation.h"
#include "protocols/finger_sample.h"
#include "protocols/ids.h"
#include "protocols/protocol.h"

namespace database {

/// A fabric outside the study with one friction image, which lets the participant get to know the display.
struct FamiliarisationItem {
    std::string name;
    protocols::SealedCode sealedCode;
    bool operator==(const FamiliarisationItem&) const = default;
};

/// The sentence that the report of a study without a passphrase must show.
inline constexpr const char* noPassphraseStamp =
    "The allocation key of this study has no passphrase: whoever could read its folder could name every condition.";

/// The facts that never change after a study is made.
struct StudyFacts {
    std::string name;
    std::string protocolJson;  ///< byte for byte as in protocol.json
    std::string protocolSha256;
    std::uint64_t designSeed = 0;
    std::string keySha256;         ///< commitment to the text of the allocation key
    std::string stationKeySha256;  ///< commitment to station-key.json
    bool hasPassphrase = false;    ///< false: the allocation key lies open in the folder
    std::string datasetPath;
    std::string datasetSha256;
    bool datasetProcedural = false;
    std::string modelSha256;          ///< empty if no condition is generated
    std::vector<std::string> stamps;  ///< sentences that the report must show
    std::vector<protocols::FabricId> fabrics;
    std::map<protocols::FabricId, std::string> fabricNames;
    std::vector<protocols::SwatchLabels> swatches;  ///< [slot]; empty: fabric pieces have no codes
    std::vector<FamiliarisationItem> familiarisation;
    std::string signalsJson;     ///< generated against measured signals; "{}" if none
    std::string plannedBalance;  ///< of the running orders, as JSON: the design cannot be drawn again without the secret
    std::string madeWith;        ///< program, compiler, libraries and settings that made the study, as JSON
    std::string createdAt;       ///< wall clock, ISO 8601 with zone
    std::string programVersion;
};

enum class ParticipantKind { Human, Scripted, Simulated };
std::string nameOf(ParticipantKind kind);  ///< "human", "scripted", "simulated"

enum class SlotState { Free, Started, Finished, Withdrawn };
std::string nameOf(SlotState state);

/// A running order of the study and the participant who takes it. A participant who withdraws frees the slot.
struct Slot {
    int number = 0;                        ///< from 1
    SlotState state = SlotState::Free;     ///< never Withdrawn
    protocols::ParticipantId participant;  ///< empty while free
    ParticipantKind kind = ParticipantKind::Human;
};

/// A participant, also one who withdrew.
struct Enrolment {
    protocols::ParticipantId participant;
    int slot = 0;
    ParticipantKind kind = ParticipantKind::Human;
    SlotState state = SlotState::Started;  ///< never Free
    int protocolVersion = 1;               ///< the version that the session follows
};

/// A version of the study's protocol: the first, or one that was taken over later.
struct ProtocolVersion {
    int version = 1;
    std::string json, sha256;
    std::string who, why, wallTime;  ///< empty for the first
};

/// An event of a session as it is stored.
struct EventRecord {
    std::int64_t sequence = 0;  ///< set by append
    protocols::ParticipantId participant;
    int sitting = 0;   ///< number of times that the session was opened, from 1
    std::string kind;  ///< "answered", "corrected", "paused", ...
    std::string payloadJson;
    std::int64_t atNs = 0;  ///< the session's monotonic clock
    std::string wallTime;   ///< ISO 8601
};

/// The answer to one question, or a correction of it. The corrected answer stays in the table. A correction has the time stamps
/// of the first answer, because it changes the answer, not its time.
struct AnswerRecord {
    protocols::TrialNumber trial;
    protocols::QuestionId question;
    protocols::PresentationCode presentationCode;  ///< of this attempt at the trial
    std::vector<protocols::FabricId> alternatives;
    std::optional<std::string> answer;        ///< a fabric id, "same", "different", or words
    std::optional<protocols::Tenths> rating;  ///< rating questions only
    std::int64_t readyAtNs = 0;
    std::optional<std::int64_t> touchedAtNs;
    std::string touchedBy;                        ///< "display" or "operator"; empty without a touch
    std::optional<std::int64_t> touchEndedAtNs;   ///< last time before the answer that the finger left the display
    std::optional<std::int64_t> answerBegunAtNs;  ///< none: from a version that did not stamp it
    std::string answerBegunBy;                    ///< "entry", "spoken" or "script"; empty without the stamp
    std::int64_t answeredAtNs = 0;                ///< the answer was entered
    std::optional<int> entries;                   ///< entries until two agreed; none where one is enough
    std::string note;
    bool isCorrection = false;
};

/// The current answer to one question of one trial: a row of the view `answers`.
struct CurrentAnswer {
    protocols::ParticipantId participant;
    AnswerRecord record;
    std::int64_t event = 0;  ///< entry of the log with the first answer
    int sitting = 0;         ///< of the first answer: number of times that the session was opened, from 1
    int attempt = 1;         ///< number of this presentation of the trial, from 1; a void starts the next
    std::int64_t storedAtNs = 0;
    double seconds = 0;                     ///< answered - touched; answered - ready if there was no touch
    std::optional<double> responseSeconds;  ///< answer begun - touched; none where a stamp is missing
    int corrections = 0;
    bool voided = false;
    std::string wallTime;
};

/// A recorded unblinding.
struct UnblindingRecord {
    std::string who, why, wallTime;
};

/// A recorded removal of data about a participant.
struct Erasure {
    protocols::ParticipantId participant;
    bool answersToo = false;  ///< false: facts and debriefing only
    std::string who, why, wallTime;
};

/// What an erasure did.
struct ErasureRecord {
    std::int64_t event = 0;  ///< entry of the log
    int answers = 0, notes = 0, facts = 0;
    std::int64_t fingerSamples = 0;
    std::string wallTime;
    std::size_t searchedFiles = 0;   ///< files of the study in which the removed texts were looked for
    std::size_t searchedTexts = 0;   ///< salts, facts, notes and words that no other participant has
    std::vector<std::string> found;  ///< files that still hold one of them, relative to the study
};

/// The last entry of the log. Its hash commits to every entry before it.
struct LogHead {
    std::int64_t sequence = 0;
    std::string hash;
    bool operator==(const LogHead&) const = default;
};
std::string textOf(const LogHead& head);  ///< "128:5c0f…", as `verify --against` takes it

/// "128:5c0fa1b2c3d4e5f6": the number and the first 16 digits, short enough to be written down by hand.
std::string shortTextOf(const LogHead& head);
inline constexpr std::size_t shortHeadLength = 16;

class StudyStore {
public:
    /// Makes study.db in an existing folder, in one transaction, with the blinded lists of all slots and the hash of every
    /// stimulus. Throws badInput if it exists, environmentFault on disk faults.
    static void create(const StudyFolder& folder, const StudyFacts& facts,
                       const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                       const std::map<protocols::FileCode, std::string>& stimulusHashes);

    /// Brings back a rescue file (rescue.h) in the place of study.db. `file`: one of rescueFiles().
    struct Rescued {
        std::size_t events = 0;         ///< entries of the log that the study gained
        std::filesystem::path earlier;  ///< the database that stood there, kept under another name
    };
    static Rescued rescue(const StudyFolder& folder, const std::filesystem::path& file);

    enum class Access { Read, Write };
    /// Throws badInput if the folder is no study, environmentFault if another writer holds the lock (naming its process) or the
    /// folder cannot be written.
    StudyStore(const StudyFolder& folder, Access access);
    ~StudyStore();
    StudyStore(StudyStore&&) noexcept;

    const StudyFolder& folder() const;
    /// Whether the folder is an upgraded copy of a study of an earlier version, which vanishes with the store.
    bool isUpgradedCopy() const;
    /// Read once; valid as long as the store.
    const StudyFacts& facts() const;
    std::map<protocols::FileCode, std::string> stimulusHashes() const;
    std::vector<Slot> slots() const;
    std::vector<protocols::BlindedTrial> trials(int slot) const;

    std::vector<Enrolment> enrolments() const;  ///< by slot, in each by time

    std::vector<ProtocolVersion> protocolVersions() const;
    /// Participants who enrol later follow this version. Throws badInput if who or why is empty.
    void takeProtocol(const std::string& json, const std::string& who, const std::string& why);

    /// The participant's slot, or the next free one. Throws workFailed if none is free, badInput if the id is empty, belongs to
    /// a participant of another kind, or was erased.
    Slot enrol(const protocols::ParticipantId& participant, ParticipantKind kind);
    /// The next unused one of "P01", "P02", ...
    protocols::ParticipantId nextParticipantId() const;
    /// The next `count` unused ids: the prefix with a number of at least two digits, "SIM01". The ids of withdrawn
    /// participants count as used.
    std::vector<protocols::ParticipantId> nextParticipantIds(const std::string& prefix, std::size_t count) const;
    void setSlotState(const protocols::ParticipantId& participant, SlotState state);

    /// A remark on one presentation. The view `answers` shows it with each answer.
    struct Note {
        protocols::TrialNumber trial;
        std::string text;
        bool isFlag = false;  ///< marks the presentation for a later check
    };
    /// What the display measured of the finger during one presentation, since the answer before.
    struct FingerStretch {
        protocols::TrialNumber trial;
        std::vector<protocols::FingerSample> samples;  ///< in the order of time; not empty
        int leftOut = 0;                               ///< samples that were too many or too close to each other
    };
    /// What one transaction stores: the event, its answers, the finger before them, the trial that it voids, a note, the slot's
    /// new state.
    struct Append {
        EventRecord event;
        std::vector<AnswerRecord> answers;
        std::optional<FingerStretch> finger;
        std::optional<protocols::TrialNumber> voids;
        std::optional<Note> note;
        std::optional<SlotState> slotState;
        std::vector<std::pair<std::string, std::string>> facts;  ///< about the participant; outside the log
        std::int64_t storedAtNs = 0;                             ///< the session's clock just before the transaction
    };
    /// Returns after the sync. Throws environmentFault (disk full, read-only) and then stores nothing; workFailed for an answer
    /// that is stored already, or a correction without an answer. Every writing call throws environmentFault where somebody
    /// deleted, replaced or moved the open database; a rescue file then holds everything that was acknowledged.
    void append(const Append& entry);

    /// Stores many events of simulated participants in one transaction, by the rules and with the rows of append(). They are in
    /// the study after commit(), which returns after the sync; a batch that ends without it leaves nothing. While a batch is
    /// open, enrol() and append() throw workFailed for any other participant: every answer of a person has its own transaction.
    class Batch {
    public:
        explicit Batch(StudyStore& store);
        ~Batch();
        Batch(const Batch&) = delete;
        Batch& operator=(const Batch&) = delete;
        void commit();

    private:
        struct Open;
        std::unique_ptr<Open> m_open;
    };

    /// A presentation that the operator marked for a later check.
    struct Flag {
        protocols::ParticipantId participant;
        protocols::TrialNumber trial;
        std::string text;
    };
    std::vector<Flag> flags() const;

    std::vector<EventRecord> events(const protocols::ParticipantId& participant) const;
    /// Those of one kind, of every participant.
    std::vector<EventRecord> eventsOfKind(const std::string& kind) const;
    /// Number of current answers, without reading them.
    std::size_t answerCount() const;
    std::vector<CurrentAnswer> answers() const;  ///< answers of all participants, by slot, trial and question
    /// The same one by one, so that a large study need not be held as a whole.
    void eachAnswer(const std::function<void(CurrentAnswer)>& take) const;

    /// Presentations that were voided, answered or not, by participant.
    std::map<protocols::ParticipantId, int> voidedPresentations() const;

    /// Facts about participants that were given and not erased.
    std::map<protocols::ParticipantId, std::map<std::string, std::string>> personalFacts() const;

    /// Removes facts and, if `answersToo`, every answer and note; the participant then counts as withdrawn. The erasure is
    /// recorded, and the log can still be verified. Afterwards every file of the study is searched for what was removed. Throws
    /// badInput for an unknown participant or an empty who or why, environmentFault while another program reads the study: the
    /// same call later completes the erasure.
    ErasureRecord erase(const Erasure& erasure);
    std::vector<Erasure> erasures() const;

    /// Empty for a database without entries.
    LogHead head() const;
    /// The entry with this hash; empty where there is none.
    std::optional<std::int64_t> entryWithHash(const std::string& hash) const;
    /// Empty where there is no such entry.
    std::string hashOfEntry(std::int64_t sequence) const;

    /// Writes a consistent copy of study.db into one new file, also during a session. Throws badInput if the file exists.
    void copyTo(const std::filesystem::path& file) const;

    /// Records an unblinding; unblinding() returns the first. Throws badInput if who or why is empty.
    void recordUnblinding(const UnblindingRecord& record);
    std::optional<UnblindingRecord> unblinding() const;

    /// PRAGMA synchronous of this connection: 2.
    int synchronousMode() const;
    /// One line for each fault of the file, its foreign keys and the hash chain.
    std::vector<std::string> faults() const;

private:
    struct Connection;
    std::unique_ptr<Connection> m_connection;
};

}  // namespace database
