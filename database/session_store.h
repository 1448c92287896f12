// What a session and the app's start page need of a study: the records, and the store behind them. StudyStore keeps the study in
// a file of this disk, StationStore (server/station_store.h) on a server that many stations share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "database/disk/study_folder.h"
#include "protocols/finger_sample.h"
#include "protocols/ids.h"
#include "protocols/orders/allocation.h"
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
    std::int64_t event = 0;          ///< entry of the log that took it over; 0 for the first, and at a station
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
/// A file that still holds something after an erasure, as the log remembers it.
struct FoundFile {
    std::string name = {};  ///< printable; empty where the name itself holds a removed text
    std::int64_t bytes = 0;
    std::string sha256 = {};  ///< of the content; empty where it could not be read
};

struct ErasureRecord {
    std::int64_t event = 0;  ///< entry of the log
    int answers = 0, notes = 0, facts = 0;
    std::int64_t fingerSamples = 0;
    std::string wallTime;
    std::size_t searchedFiles = 0;  ///< files of the study in which the removed texts were looked for
    std::size_t searchedTexts = 0;  ///< salts, facts, notes and words that nothing else in the study holds
    std::size_t shortTexts = 0;     ///< others of less than 8 bytes, which stand in many files by chance
    std::size_t sharedTexts = 0;    ///< others, which the study still holds, so that no file can be searched for them
    /// Files that still hold one of them, relative to the study, also by earlier certificates. Where the name holds one, too, the
    /// hash of the content stands for it.
    std::vector<std::string> found;
    std::vector<FoundFile> foundFiles;  ///< the same files
    std::vector<std::string> unread;    ///< files and folders that could not be searched, by printable names
    /// Earlier erasures of this participant, by their entries, that ended before the search: their texts are no longer known.
    std::vector<std::int64_t> interrupted;
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

/// The image of one presentation as a server gives it out: sealed under a key of its own.
struct ReleasedImage {
    std::string sealed, key;  ///< key: 64 hexadecimal digits
};
/// What the seal of a released image is bound to.
inline constexpr const char* releasedImageBound = "vis2hap.image";

/// What a study on a server takes (server/sql/functions.sql); a session keeps it in folders, too.
inline constexpr std::size_t longestText = 100'000;       ///< bytes of words, a note, a reason or a fact
inline constexpr std::size_t longestPayload = 1'000'000;  ///< bytes of the JSON of an event

class SessionStore {
public:
    /// A remark on one presentation. The view `answers` shows it with each answer.
    struct Note {
        protocols::TrialNumber trial;
        std::string text;
        bool isFlag = false;              ///< marks the presentation for a later check
        std::optional<int> attempt = {};  ///< from 1, at most the present one; empty: the present one
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

    virtual ~SessionStore() = default;

    virtual const StudyFolder& folder() const = 0;
    /// Read once; valid as long as the store.
    virtual const StudyFacts& facts() const = 0;
    virtual std::vector<ProtocolVersion> protocolVersions() const = 0;
    virtual std::vector<Slot> slots() const = 0;
    virtual std::vector<Enrolment> enrolments() const = 0;  ///< by slot, in each by time
    /// The next unused one of "P01", "P02", ...
    virtual protocols::ParticipantId nextParticipantId() const = 0;
    /// Stored answers of each participant that are not voided.
    virtual std::map<protocols::ParticipantId, int> answerCounts() const = 0;

    /// The participant's slot, or the next free one. Throws workFailed if none is free, badInput if the id is empty, belongs to
    /// a participant of another kind, or was erased.
    virtual Slot enrol(const protocols::ParticipantId& participant, ParticipantKind kind) = 0;
    /// The list of a slot. On a server, a trial that is not due yet has neither alternatives nor a sealed code.
    virtual std::vector<protocols::BlindedTrial> trials(int slot) const = 0;
    /// The whole trial, once it is due: the one before it is answered or voided. Throws workFailed before.
    virtual protocols::BlindedTrial dueTrial(int slot, protocols::TrialNumber number) = 0;
    virtual std::vector<EventRecord> events(const protocols::ParticipantId& participant) const = 0;
    /// Returns once the entry is safe: synced on this disk, on the server or in the station's queue. Throws environmentFault
    /// (disk full, read-only) and then stores nothing; workFailed for an answer that is stored already, or a correction without
    /// an answer.
    virtual void append(const Append& entry) = 0;
    virtual LogHead head() const = 0;
};

}  // namespace database
