#include "database/study_store.h"

#include <cstdio>
#include <optional>
#include <set>
#include <system_error>
#include <type_traits>
#include <utility>

#include "database/audit.h"
#include "database/disk/open_files.h"
#include "database/disk/server_note.h"
#include "database/disk/study_upgrade.h"
#include "database/disk/write_lock.h"
#include "database/erasure.h"
#include "database/open_study.h"
#include "database/rescue.h"
#include "database/rescue_files.h"
#include "database/sqlite_connection.h"
#include "database/study_creation.h"
#include "database/study_rows.h"
#include "database/study_writing.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/utf8.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

/// Upgrades a study of an earlier version in its place for a writer, and a copy of it for a reader. Returns the copy.
std::unique_ptr<protocols::TemporaryFolder> upgraded(const StudyFolder& folder, StudyStore::Access access)
{
    if (access == StudyStore::Access::Write) {
        std::fprintf(stderr, "%s\n", upgrade(folder).c_str());
        return nullptr;
    }
    std::fprintf(stderr,
                 "%s: an earlier version of this program made this study. This command reads an upgraded copy. Open the study in "
                 "the app to upgrade it.\n",
                 protocols::printable(folder.folder.string()).c_str());
    return upgradedCopy(folder);
}

/// A rescue gives study.db another name before it puts the rescued one in its place.
bool hasInterruptedRescue(const StudyFolder& folder)
{
    std::error_code unknown;
    for (const auto& entry : std::filesystem::directory_iterator(folder.folder, unknown))
        if (entry.path().filename().string().starts_with("study-before-rescue-") &&
            std::filesystem::equivalent(entry.path(), folder.database(), unknown))
            return true;
    return false;
}

/// Through another name of the file another program could write, with a lock and a write-ahead log of its own.
void requireOwnFile(const StudyFolder& folder, StudyStore::Access access)
{
    std::error_code unknown;
    const std::string file = folder.database().string(), word = protocols::shellWord(file);
    if (std::filesystem::is_symlink(folder.database(), unknown))
        throw protocols::badInput({"study.db is a link to another file", file, "the database itself",
                                   "open the folder of that file, or copy the study with vis2hap backup"});
    const bool isWritten = access == StudyStore::Access::Write;
    if (isWritten && hasInterruptedRescue(folder))
        throw protocols::badInput({"a rescue was interrupted, and its answers are in a rescue file yet", folder.folder.string(),
                                   "", "run vis2hap rescue " + protocols::shellWord(folder.folder.string()) + " again"});
    if (isWritten && std::filesystem::hard_link_count(folder.database(), unknown) > 1 && !unknown)
        throw protocols::badInput(
            {"study.db is the same file as another one (hard link)", file, "a file of its own",
             "close every program of the study, then: cp -p " + word + " " + word + ".new && mv " + word + ".new " + word});
}

/// Runs a write with the open files in place before it and after it, so that an acknowledged answer is in the folder.
template <class Connection, class Write>
auto written(Connection& connection, const Write& write)
{
    if (connection.batch) return write();  // the batch looks at the files when it begins and when it is committed
    connection.requireFilesInPlace();
    if constexpr (std::is_void_v<decltype(write())>) {
        write();
        connection.requireFilesInPlace(Connection::Moment::AfterStep);
    } else {
        auto result = write();
        connection.requireFilesInPlace(Connection::Moment::AfterStep);
        return result;
    }
}

}  // namespace

std::string nameOf(ParticipantKind kind)
{
    switch (kind) {
        case ParticipantKind::Human:
            return "human";
        case ParticipantKind::Scripted:
            return "scripted";
        case ParticipantKind::Simulated:
            return "simulated";
    }
    return {};
}

std::string nameOf(SlotState state)
{
    switch (state) {
        case SlotState::Free:
            return "free";
        case SlotState::Started:
            return "started";
        case SlotState::Finished:
            return "finished";
        case SlotState::Withdrawn:
            return "withdrawn";
    }
    return {};
}

void StudyStore::create(const StudyFolder& folder, const StudyFacts& facts,
                        const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                        const std::map<protocols::FileCode, std::string>& stimulusHashes)
{
    if (std::filesystem::exists(folder.database()))
        throw protocols::badInput(
            {"the folder holds a study already", folder.folder.string(), "a new folder", "choose another name"});
    const WriteLock lock(folder);
    createDatabase(folder, facts, slots, stimulusHashes);
}

StudyStore::StudyStore(const StudyFolder& folder, Access access)
{
    if (const auto note = readServerNote(folder.folder))
        throw protocols::workFailed({"this study lies on a server, where its stations write to it", folder.folder.string(),
                                     note->address,
                                     "run sessions in the app, or bring the study back first: vis2hap study move '" +
                                         note->address + "' " + folder.folder.string()});
    std::error_code unreadable;
    const bool isThere = std::filesystem::is_regular_file(folder.database(), unreadable);
    if (isThere) requireOwnFile(folder, access);
    if (unreadable == std::errc::permission_denied)
        throw protocols::badInput({"this account may not look into the folder", folder.folder.string(),
                                   "a folder of this account", "ask the account that made the study, or its owner"});
    if (!isThere)
        throw protocols::badInput(
            {"this is no study folder (it has no study.db)", folder.folder.string(), "a folder made by vis2hap study new",
             rescueFiles(folder).empty() ? "check the path"
                                         : "run vis2hap rescue " + protocols::shellWord(folder.folder.string()) +
                                               ", which brings back what a session kept aside"});
    const bool writes = access == Access::Write;
    auto lock = writes ? std::make_unique<WriteLock>(folder) : nullptr;
    const bool hasOlderLog = isOlder(folder);
    auto copy = hasOlderLog || hasUnfinishedUpgrade(folder) ? upgraded(folder, access) : nullptr;
    const auto mode = writes ? SqliteConnection::Mode::Write : SqliteConnection::Mode::Read;
    const StudyFolder opened = copy ? StudyFolder{copy->path()} : folder;
    const bool isCopy = copy != nullptr;
    m_connection.reset(new Connection{std::move(copy), opened, std::move(lock), {opened.database(), mode}});
    if (isCopy) m_connection->upgradedFrom = folder.folder;
    m_connection->isChainedAnew = isCopy && hasOlderLog;
    if (!writes) return;
    m_connection->sqlite.value(QStringLiteral("SELECT COUNT(*) FROM sqlite_master"));  // opens the write-ahead log
    m_connection->files.emplace(opened.database(), m_connection->sqlite.handle());
}

StudyStore::StudyStore(std::unique_ptr<Connection> connection) : m_connection(std::move(connection)) {}

StudyStore StudyStore::ofCopy(std::unique_ptr<protocols::TemporaryFolder> copy, const std::filesystem::path& original)
{
    const StudyFolder opened{copy->path()};
    std::unique_ptr<Connection> connection(
        new Connection{std::move(copy), opened, nullptr, {opened.database(), SqliteConnection::Mode::Read}});
    connection->serverFolder = original;
    return StudyStore(std::move(connection));
}

StudyStore::~StudyStore() = default;
StudyStore::StudyStore(StudyStore&&) noexcept = default;
StudyStore& StudyStore::operator=(StudyStore&&) noexcept = default;

const StudyFolder& StudyStore::folder() const { return m_connection->folder; }

std::unique_ptr<ReadSnapshot> StudyStore::readOneState() const
{
    auto state = std::make_unique<ReadSnapshot>(m_connection->sqlite);
    m_connection->sqlite.value(QStringLiteral("SELECT COUNT(*) FROM sqlite_master"));  // the state is that of the first reading
    return state;
}

const SqliteConnection& StudyStore::connection() const { return m_connection->sqlite; }

bool StudyStore::isUpgradedCopy() const { return !m_connection->upgradedFrom.empty(); }

std::filesystem::path StudyStore::namedFolder() const
{
    if (isUpgradedCopy()) return m_connection->upgradedFrom;
    return m_connection->serverFolder.empty() ? m_connection->folder.folder : m_connection->serverFolder;
}

bool StudyStore::hasLastingHead() const { return !m_connection->isChainedAnew; }

std::filesystem::path StudyStore::serverFolder() const { return m_connection->serverFolder; }

const StudyFacts& StudyStore::facts() const
{
    if (!m_connection->facts) m_connection->facts = factsIn(m_connection->sqlite);
    return *m_connection->facts;
}

std::map<protocols::FileCode, std::string> StudyStore::stimulusHashes() const { return stimulusHashesIn(m_connection->sqlite); }

std::vector<Slot> StudyStore::slots() const { return slotsIn(m_connection->sqlite); }

std::vector<protocols::BlindedTrial> StudyStore::trials(int slot) const { return trialsIn(m_connection->sqlite, slot); }

protocols::BlindedTrial StudyStore::dueTrial(int slot, protocols::TrialNumber number)
{
    return trials(slot).at(static_cast<std::size_t>(number.value) - 1);
}

std::vector<Enrolment> StudyStore::enrolments() const { return enrolmentsIn(m_connection->sqlite); }

std::vector<ProtocolVersion> StudyStore::protocolVersions() const { return protocolVersionsIn(m_connection->sqlite); }

StudyStore::Rescued StudyStore::rescue(const StudyFolder& folder, const std::filesystem::path& file)
{
    const WriteLock lock(folder);
    const Rescue done = bringBack(folder, file);
    return {done.events, done.earlier, done.acts, done.lacksActs};
}

void StudyStore::takeProtocol(const std::string& json, const std::string& who, const std::string& why)
{
    written(*m_connection, [&] { takeProtocolInto(m_connection->sqlite, json, who, why); });
}

Slot StudyStore::enrol(const protocols::ParticipantId& participant, ParticipantKind kind)
{
    const auto& batch = m_connection->batch;
    if (batch) m_connection->requireInBatch(kind == ParticipantKind::Simulated, participant);
    Slot slot = written(*m_connection, [&] { return enrolIn(m_connection->sqlite, participant, kind); });
    if (batch) m_connection->batch->insert(participant);
    return slot;
}

protocols::ParticipantId StudyStore::nextParticipantId() const { return nextParticipantIds("P", 1).front(); }

std::vector<protocols::ParticipantId> StudyStore::nextParticipantIds(const std::string& prefix, std::size_t count) const
{
    std::set<protocols::ParticipantId> taken;
    for (const Enrolment& known : enrolments()) taken.insert(known.participant);
    std::vector<protocols::ParticipantId> ids;
    for (int number = 1; ids.size() < count; ++number) {
        const protocols::ParticipantId id(prefix + (number < 10 ? "0" : "") + std::to_string(number));
        if (!taken.contains(id)) ids.push_back(id);
    }
    return ids;
}

void StudyStore::append(const Append& entry)
{
    const auto& batch = m_connection->batch;
    if (batch) m_connection->requireInBatch(batch->contains(entry.event.participant), entry.event.participant);
    written(*m_connection, [&] { appendTo(m_connection->sqlite, entry); });
}

struct StudyStore::Batch::Open {
    Connection& connection;
    Transaction transaction;

    explicit Open(Connection& of) : connection(of), transaction(of.sqlite)
    {
        // The hashes of a batch fall all over their index: with the usual 2 MB its pages would be read again and again.
        of.sqlite.run(QStringLiteral("PRAGMA cache_size = -65536"));
        of.sqlite.value(QStringLiteral("PRAGMA wal_autocheckpoint = 10000"));  // pages; for the same reason
        connection.batch.emplace();
    }
    ~Open() { connection.batch.reset(); }
    Open(const Open&) = delete;
    Open& operator=(const Open&) = delete;
};

StudyStore::Batch::Batch(StudyStore& store)
{
    store.m_connection->requireFilesInPlace();
    if (store.m_connection->files) store.m_connection->files->letCopyGo();  // simulated participants can be simulated again
    m_open = std::make_unique<Open>(*store.m_connection);
}

StudyStore::Batch::~Batch() = default;

void StudyStore::Batch::commit()
{
    m_open->transaction.commit();
    m_open->connection.requireFilesInPlace(Connection::Moment::AfterStep);
}

std::vector<StudyStore::Flag> StudyStore::flags() const { return flagsIn(m_connection->sqlite); }

std::vector<EventRecord> StudyStore::events(const protocols::ParticipantId& participant) const
{
    return eventsIn(m_connection->sqlite, participant);
}

std::vector<EventRecord> StudyStore::eventsOfKind(const std::string& kind) const
{
    return eventsOfKindIn(m_connection->sqlite, kind);
}

std::size_t StudyStore::eventsAfter(std::int64_t sequence, const std::string& kind) const
{
    return m_connection->sqlite
        .value(QStringLiteral("SELECT COUNT(*) FROM events WHERE sequence > ? AND kind = ?"), {qlonglong(sequence), toQt(kind)})
        .toULongLong();
}

std::optional<std::int64_t> StudyStore::firstEventOfKind(const std::string& kind) const
{
    return firstEventOfKindIn(m_connection->sqlite, kind);
}

std::size_t StudyStore::answerCount() const
{
    return m_connection->sqlite.value(QStringLiteral("SELECT COUNT(*) FROM responses WHERE is_correction = 0")).toULongLong();
}

std::vector<CurrentAnswer> StudyStore::answers() const
{
    std::vector<CurrentAnswer> all;
    eachAnswer([&](CurrentAnswer answer) { all.push_back(std::move(answer)); });
    return all;
}

void StudyStore::eachAnswer(const std::function<void(CurrentAnswer)>& take) const { eachAnswerIn(m_connection->sqlite, take); }

std::map<protocols::ParticipantId, int> StudyStore::answerCounts() const
{
    std::map<protocols::ParticipantId, int> counts;
    eachAnswer([&](const CurrentAnswer& answer) { counts[answer.participant] += !answer.voided; });
    return counts;
}

std::map<protocols::ParticipantId, int> StudyStore::voidedPresentations() const
{
    return voidedPresentationsIn(m_connection->sqlite);
}

std::map<protocols::ParticipantId, std::map<std::string, std::string>> StudyStore::personalFacts() const
{
    return personalFactsIn(m_connection->sqlite);
}

ErasureRecord StudyStore::erase(const Erasure& erasure)
{
    const auto eraseAndForget = [&] {
        if (m_connection->files) m_connection->files->letCopyGo();  // it holds what is erased
        const auto takeAgain = [&] {
            if (m_connection->files) m_connection->files->takeCopy();
        };
        try {
            ErasureRecord record = eraseFrom(m_connection->sqlite, erasure);
            takeAgain();
            return record;
        } catch (...) {
            takeAgain();
            throw;
        }
    };
    return written(*m_connection, eraseAndForget);
}

std::vector<Erasure> StudyStore::erasures() const { return erasuresIn(m_connection->sqlite); }

LogHead StudyStore::head() const
{
    // The screen that reports a fault shows it, so a writer whose files were overwritten has one, too: that of the rescue file.
    Connection& open = *m_connection;
    try {
        if (open.hasFilesInPlace(Connection::Moment::AfterStep)) return headIn(open.sqlite);
        if (!open.isTold) throw open.displaced();
    } catch (const protocols::Error&) {
        const bool isDisplaced =
            open.isGivenUp || !open.keptAside.empty() || (open.files && open.files->state() == OpenFiles::State::Gone);
        if (!isDisplaced || !std::exchange(open.isTold, true)) throw;
    }
    return open.keptHead;
}

std::optional<std::int64_t> StudyStore::entryWithHash(const std::string& hash) const
{
    const QVariant sequence =
        m_connection->sqlite.value(QStringLiteral("SELECT sequence FROM events WHERE hash = ?"), {toQt(hash)});
    return sequence.isValid() ? std::optional<std::int64_t>(sequence.toLongLong()) : std::nullopt;
}

std::string StudyStore::hashOfEntry(std::int64_t sequence) const
{
    return fromQt(
        m_connection->sqlite.value(QStringLiteral("SELECT hash FROM events WHERE sequence = ?"), {qlonglong(sequence)}));
}

std::string shortTextOf(const LogHead& head)
{
    return std::to_string(head.sequence) + ":" + head.hash.substr(0, shortHeadLength);
}

std::string textOf(const LogHead& head) { return std::to_string(head.sequence) + ":" + head.hash; }

void StudyStore::copyTo(const std::filesystem::path& file) const
{
    protocols::requireNewFile(file);
    if (protocols::firstByteThatIsNotUtf8(file.string()))
        throw protocols::badInput({"the path is not UTF-8", file.string(), "a path in UTF-8", "choose another name"});
    m_connection->sqlite.run(QStringLiteral("VACUUM INTO ?"), {toQt(file.string())});
}

void StudyStore::recordUnblinding(const UnblindingRecord& record)
{
    written(*m_connection, [&] { recordUnblindingIn(m_connection->sqlite, record); });
}

std::optional<UnblindingRecord> StudyStore::unblinding() const { return unblindingIn(m_connection->sqlite); }

std::vector<std::string> StudyStore::faults() const { return faultsOfDatabase(m_connection->sqlite); }

}  // namespace database
