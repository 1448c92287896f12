// study.db: the fixed facts of a study, the slots of its participants, their blinded trial lists, and an append-only,
// hash-chained log of all events. SQLite in WAL mode with synchronous FULL: when append() returns, the event and its answers are
// on the disk. A QCoreApplication must exist first, because Qt loads its SQLite driver as a plug-in. One writer at a time, by a
// lock on the folder that ends with its process; any number of readers.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "database/session_store.h"

namespace protocols {
class TemporaryFolder;
}

namespace database {

class ReadSnapshot;
class SqliteConnection;

class StudyStore final : public SessionStore {
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
        std::size_t acts = 0;           ///< exports and the like that only that database had: the study keeps them
        bool lacksActs = false;         ///< some of them are altered or cannot be read, and stay in that database
    };
    static Rescued rescue(const StudyFolder& folder, const std::filesystem::path& file);

    enum class Access { Read, Write };
    /// Throws badInput if the folder is no study, workFailed for a study on a server (server/study_move.h), environmentFault if
    /// another writer holds the lock (naming its process) or the folder cannot be written.
    StudyStore(const StudyFolder& folder, Access access);
    /// Reads a copy of a study on a server; the copy vanishes with the store. `original`: the folder of the study.
    static StudyStore ofCopy(std::unique_ptr<protocols::TemporaryFolder> copy, const std::filesystem::path& original);
    ~StudyStore() override;
    StudyStore(StudyStore&&) noexcept;
    StudyStore& operator=(StudyStore&&) noexcept;

    const StudyFolder& folder() const override;
    /// As long as the result lives, this store reads one state of the study, for files that must agree with each other, and an
    /// erasure is refused. Only for a store that was opened to read.
    std::unique_ptr<ReadSnapshot> readOneState() const;
    /// What the other parts of database/ read from.
    const SqliteConnection& connection() const;
    /// Whether the folder is an upgraded copy of a study of an earlier version, which vanishes with the store.
    bool isUpgradedCopy() const;
    /// The folder that was opened; for a copy, the one of its study.
    std::filesystem::path namedFolder() const;
    /// False for a copy of a study with an older log. The upgrade of each copy chains it anew, so that its head is worth nothing.
    bool hasLastingHead() const;
    /// The folder of a study on a server, of which this store reads a copy; empty for any other.
    std::filesystem::path serverFolder() const;
    const StudyFacts& facts() const override;
    std::map<protocols::FileCode, std::string> stimulusHashes() const;
    std::vector<Slot> slots() const override;
    std::vector<protocols::BlindedTrial> trials(int slot) const override;
    protocols::BlindedTrial dueTrial(int slot, protocols::TrialNumber number) override;
    std::vector<Enrolment> enrolments() const override;
    std::vector<ProtocolVersion> protocolVersions() const override;
    /// Participants who enrol later follow this version. Throws badInput if who or why is empty.
    void takeProtocol(const std::string& json, const std::string& who, const std::string& why);

    Slot enrol(const protocols::ParticipantId& participant, ParticipantKind kind) override;
    protocols::ParticipantId nextParticipantId() const override;
    std::map<protocols::ParticipantId, int> answerCounts() const override;
    /// The next `count` unused ids: the prefix with a number of at least two digits, "SIM01". The ids of withdrawn
    /// participants count as used.
    std::vector<protocols::ParticipantId> nextParticipantIds(const std::string& prefix, std::size_t count) const;

    /// Every writing call throws environmentFault where somebody deleted, replaced, overwrote or moved the open database; a
    /// rescue file then holds everything that was acknowledged. The destructor looks once more, and prints where that file lies.
    /// Where the file system does not say, the call throws environmentFault and can be made again.
    void append(const Append& entry) override;

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

    std::vector<EventRecord> events(const protocols::ParticipantId& participant) const override;
    /// Those of one kind, of every participant.
    std::vector<EventRecord> eventsOfKind(const std::string& kind) const;
    /// Entry of the log with the first of them, whatever was erased since; none where there is no such event.
    std::optional<std::int64_t> firstEventOfKind(const std::string& kind) const;
    /// Number of entries of this kind behind an entry.
    std::size_t eventsAfter(std::int64_t sequence, const std::string& kind) const;
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
    /// badInput for an unknown participant or an empty who or why, environmentFault while another program reads the study, or
    /// where room is missing: the same call later completes the erasure.
    ErasureRecord erase(const Erasure& erasure);
    std::vector<Erasure> erasures() const;

    /// Empty for a database without entries. Throws once as writing calls do, and then gives the end of the log in the rescue
    /// file.
    LogHead head() const override;
    /// The entry with this hash; empty where there is none.
    std::optional<std::int64_t> entryWithHash(const std::string& hash) const;
    /// Empty where there is no such entry.
    std::string hashOfEntry(std::int64_t sequence) const;

    /// Writes a consistent copy of study.db into one new file, also during a session. Throws badInput if the file exists.
    void copyTo(const std::filesystem::path& file) const;

    /// Records an unblinding; unblinding() returns the first. Throws badInput if who or why is empty.
    void recordUnblinding(const UnblindingRecord& record);
    std::optional<UnblindingRecord> unblinding() const;

    /// One line for each fault of the file, its foreign keys and the hash chain.
    std::vector<std::string> faults() const;

private:
    struct Connection;
    explicit StudyStore(std::unique_ptr<Connection> connection);
    std::unique_ptr<Connection> m_connection;
};

}  // namespace database
