#include "tests/promises/crash_states.h"

#include <algorithm>
#include <map>
#include <optional>

#include "protocols/files/whole_file.h"
#include "protocols/random.h"
#include "tests/promises/kept_answers.h"
#include "tests/support/counting_vfs.h"
#include "tests/support/played_session.h"

namespace tests::promises {

namespace {

namespace fs = std::filesystem;
using support::DiskOperation;
using Kind = DiskOperation::Kind;

/// What a disk holds of one file: what is certain, and the operations since its last sync.
class FileOnDisk {
public:
    FileOnDisk() = default;
    explicit FileOnDisk(std::string bytes) : m_certain(std::move(bytes)) {}

    void take(const DiskOperation& operation)
    {
        m_pending.push_back(operation);
        if (operation.kind != Kind::Sync) return;
        for (const DiskOperation& one : m_pending) apply(one, m_certain);
        m_pending.clear();
    }

    std::size_t pending() const { return m_pending.size(); }

    /// One of the states after a power cut; empty: there is no such file.
    std::optional<std::string> afterCut(protocols::Random& random) const
    {
        std::optional<std::string> bytes = m_certain;
        std::vector<DiskOperation> survivors;
        const double share = 0.25 * static_cast<double>(random.below(5));
        const bool tears = random.below(2) == 0;
        for (const DiskOperation& operation : m_pending) {
            if (operation.kind == Kind::Remove) {
                // A name that is still there leads to the old file; nothing written later is found under it.
                land(survivors, random, bytes);
                if (random.below(2) == 0) return bytes;
                bytes.reset();
            } else if (random.uniform() < share) {
                addPieces(operation, tears, random, survivors);
            }
        }
        land(survivors, random, bytes);
        return bytes;
    }

private:
    static constexpr std::size_t sectorBytes = 512;

    static void apply(const DiskOperation& operation, std::optional<std::string>& bytes)
    {
        const auto offset = static_cast<std::size_t>(operation.offset);
        if (operation.kind == Kind::Remove) bytes.reset();
        if (operation.kind == Kind::Truncate && bytes) bytes->resize(offset);
        if (operation.kind != Kind::Write) return;
        if (!bytes) bytes.emplace();
        if (bytes->size() < offset + operation.bytes.size()) bytes->resize(offset + operation.bytes.size());
        bytes->replace(offset, operation.bytes.size(), operation.bytes);
    }

    /// The whole write, or some of the sectors that it touches.
    static void addPieces(const DiskOperation& write, bool tears, protocols::Random& random, std::vector<DiskOperation>& pieces)
    {
        if (write.kind != Kind::Write || !tears) {
            pieces.push_back(write);
            return;
        }
        const auto offset = static_cast<std::size_t>(write.offset);
        for (std::size_t from = 0; from < write.bytes.size();) {
            const std::size_t to = std::min(write.bytes.size(), ((offset + from) / sectorBytes + 1) * sectorBytes - offset);
            if (random.below(2) == 0)
                pieces.push_back(
                    {Kind::Write, write.file, static_cast<std::int64_t>(offset + from), write.bytes.substr(from, to - from)});
            from = to;
        }
    }

    /// Lets the survivors reach the disk in any order.
    static void land(std::vector<DiskOperation>& survivors, protocols::Random& random, std::optional<std::string>& bytes)
    {
        const bool isOrdered = std::ranges::any_of(survivors, [](const auto& one) { return one.kind == Kind::Truncate; });
        if (!isOrdered) random.shuffle(survivors);
        for (const DiskOperation& one : survivors) apply(one, bytes);
        survivors.clear();
    }

    std::optional<std::string> m_certain;
    std::vector<DiskOperation> m_pending;
};

/// All operations of a session, and how many answers were acknowledged before each.
struct Recording {
    std::vector<DiskOperation> operations;
    std::vector<int> acknowledged;  ///< one more than operations: the last is that of the end
    std::string database;           ///< its bytes before the session
};

/// The session in two sittings, so that the database is also closed and opened.
Recording recordSession(const database::StudyFolder& folder, int answers)
{
    Recording recording;
    recording.database = protocols::readWholeFile(folder.database());
    int acknowledged = 0;
    support::CountingVfs disk;
    disk.showOperations([&](DiskOperation operation) {
        recording.acknowledged.push_back(acknowledged);
        recording.operations.push_back(std::move(operation));
    });
    for (const int until : {answers / 2, answers}) {
        support::OpenSession session(folder, "S01");
        while (session.driver->state().answersStored < until && session.step())
            acknowledged = session.driver->state().answersStored;
        if (until == answers) session.playToEnd();
    }
    recording.acknowledged.push_back(acknowledged);
    return recording;
}

void put(const std::optional<std::string>& bytes, const fs::path& file)
{
    fs::remove(file);
    if (bytes) protocols::writeWholeFile(file, *bytes, protocols::Sync::Later);
}

}  // namespace

Promise afterPowerCuts(const Effort& effort)
{
    SessionStudy study(paperStudy());
    const int answers = static_cast<int>(study.expected().size());
    const database::StudyFolder played = study.copy(), rebuilt = study.copy();
    const Recording recording = recordSession(played, answers);
    protocols::Random random(20260102);
    std::vector<std::size_t> cuts;
    for (int state = 0; state < effort.crashStates; ++state) cuts.push_back(random.below(recording.operations.size() + 1));
    std::ranges::sort(cuts);

    const std::string log = played.database().string() + "-wal";
    std::map<std::string, FileOnDisk> disk;
    disk[played.database().string()] = FileOnDisk(recording.database);
    Losses losses;
    std::size_t next = 0;
    int withPending = 0;
    for (const std::size_t cut : cuts) {
        for (; next < cut; ++next) disk[recording.operations[next].file].take(recording.operations[next]);
        withPending += disk[played.database().string()].pending() + disk[log].pending() > 0;
        put(disk[played.database().string()].afterCut(random), rebuilt.database());
        put(disk[log].afterCut(random), rebuilt.database().string() + "-wal");
        fs::remove(rebuilt.database().string() + "-shm");
        support::OpenSession session(rebuilt, "S01");
        const int acknowledged = recording.acknowledged[cut];
        losses += study.lossesIn(session.store, acknowledged);
        const int stored = session.driver->state().answersStored;
        session.playUntilAnswers(stored + 1);
        losses += study.lossesIn(session.store, stored + (stored < answers));
    }
    return {"power cut, unsynced writes dropped, torn and reordered",
            withCommas(effort.crashStates) + " states of the disk in one session of 252 answers (" +
                withCommas(static_cast<long>(recording.operations.size())) + " operations), " + withCommas(withPending) +
                " with unsynced writes",
            "0 lost, 0 doubled", textOf(losses), losses == Losses{}};
}

}  // namespace tests::promises
