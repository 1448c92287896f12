#include "database/audit.h"

#include <cstdint>
#include <future>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/payload_fields.h"
#include "database/event_chain.h"
#include "database/preregistrations.h"
#include "database/response_columns.h"
#include "database/row_audit.h"
#include "database/schema.h"
#include "database/state_audit.h"
#include "protocols/files/sha256.h"

namespace database {

namespace {

/// What is wrong with the study as a whole, and what no session writes: answers, facts, and names of acts that there are not.
struct Faults {
    std::vector<std::string> ofCopy, ofAnswers;
};

void append(std::vector<std::string>& faults, std::vector<std::string> others)
{
    faults.insert(faults.end(), std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
}

/// What an entry stores of the chain.
struct StoredLinks {
    std::string places, salt, commitment, previous, own;
};

/// The bytes of a column that the query casts to BLOB: Qt would convert a text to UTF-16, and this program back.
std::string bytesOf(const QVariant& value) { return value.toByteArray().toStdString(); }

std::optional<std::string> bytesOrNone(const QVariant& value)
{
    return value.isNull() ? std::nullopt : std::optional(bytesOf(value));
}

/// The latest row of a question counts, so rows that follow each other differently from their entries would change answers.
class OrderCheck {
public:
    OrderCheck(const char* table, std::vector<std::string>& faults) : m_table(table), m_faults(faults) {}

    /// Takes the entries of the rows as they lie in the table.
    std::int64_t next(std::int64_t entry)
    {
        if (entry < m_before)
            m_faults.push_back("study.db: the row of entry " + std::to_string(entry) + " in the table " + m_table +
                               " does not follow the order of the log");
        m_before = entry;
        return entry;
    }

private:
    const char* m_table;
    std::vector<std::string>& m_faults;
    std::int64_t m_before = 0;
};

void readResponses(const SqliteConnection& sqlite, Log& log, std::vector<std::string>& faults)
{
    OrderCheck order("responses", faults);
    QSqlQuery query = sqlite.run(QStringLiteral("SELECT event, %1 FROM responses ORDER BY id").arg(bytesOfTable()));
    while (query.next())
        log[order.next(query.value(0).toLongLong())].responses.push_back(rowFrom(query, ResponseColumns::OfTable, 1));
}

void readRest(const SqliteConnection& sqlite, Log& log, Faults& faults)
{
    OrderCheck order("notes", faults.ofCopy);
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT event, CAST(participant AS BLOB), trial, attempt FROM voids ORDER BY rowid"));
    while (row.next())
        log[row.value(0).toLongLong()].voids.push_back({bytesOf(row.value(1)), row.value(2).toInt(), row.value(3).toInt()});
    row =
        sqlite.run(QStringLiteral("SELECT event, CAST(participant AS BLOB), trial, attempt, CAST(question AS BLOB), CAST(text AS "
                                  "BLOB), is_flag FROM notes ORDER BY id"));
    while (row.next())
        log[order.next(row.value(0).toLongLong())].notes.push_back({bytesOf(row.value(1)), row.value(2).toInt(),
                                                                    row.value(3).toInt(), bytesOrNone(row.value(4)),
                                                                    bytesOf(row.value(5)), row.value(6).toInt() != 0});
    OrderCheck orderOfFingers("finger_samples", faults.ofCopy);
    row = sqlite.run(QStringLiteral(
        "SELECT event, CAST(participant AS BLOB), trial, attempt, began_at, count, left_out, CAST(samples AS BLOB) "
        "FROM finger_samples ORDER BY id"));
    while (row.next()) {
        const std::string samples = bytesOf(row.value(7));
        FingerRow finger{bytesOf(row.value(1)),
                         row.value(2).toInt(),
                         row.value(3).toInt(),
                         row.value(4).toLongLong(),
                         row.value(5).toInt(),
                         row.value(6).toInt(),
                         {},
                         protocols::sha256(samples)};
        if (const std::string fault = faultOfFinger(finger, samples); !fault.empty())
            faults.ofAnswers.push_back(finger.participant + ", trial " + std::to_string(finger.trial) +
                                       ", finger samples: " + fault);
        log[orderOfFingers.next(row.value(0).toLongLong())].finger.push_back(std::move(finger));
    }
    row = sqlite.run(
        QStringLiteral("SELECT event, CAST(who AS BLOB), CAST(why AS BLOB), CAST(wall_time AS BLOB) FROM unblindings"));
    while (row.next())
        log[row.value(0).toLongLong()].unblinding = {bytesOf(row.value(1)), bytesOf(row.value(2)), bytesOf(row.value(3))};
}

/// An entry of the log with its rows and its links, ready to be checked.
struct LinkedEntry {
    LogEntry entry;
    StoredLinks links;
};

constexpr std::size_t entriesOfBatch = 4096;

QSqlQuery queryOfEvents(const SqliteConnection& sqlite)
{
    return sqlite.run(QStringLiteral(
        "SELECT sequence, CAST(participant AS BLOB), sitting, CAST(kind AS BLOB), CAST(payload AS BLOB), at_ns, CAST(wall_time "
        "AS BLOB), "
        "CAST(places AS BLOB), CAST(salt AS BLOB), CAST(commitment AS BLOB), CAST(previous_hash AS BLOB), CAST(hash AS BLOB) "
        "FROM events ORDER BY sequence"));
}

/// Takes the next entries with their rows, which are in the log already. Those that later checks need stay in the log, without
/// answers and notes: all but those of trials. Empty at the end.
std::vector<LinkedEntry> nextEntries(QSqlQuery& row, Log& log)
{
    std::vector<LinkedEntry> batch;
    batch.reserve(entriesOfBatch);
    while (batch.size() < entriesOfBatch && row.next()) {
        const std::int64_t sequence = row.value(0).toLongLong();
        LinkedEntry& next = batch.emplace_back();
        if (auto rows = log.extract(sequence)) next.entry = std::move(rows.mapped());
        next.entry.event = {sequence,
                            protocols::ParticipantId(bytesOf(row.value(1))),
                            row.value(2).toInt(),
                            bytesOf(row.value(3)),
                            bytesOf(row.value(4)),
                            row.value(5).toLongLong(),
                            bytesOf(row.value(6))};
        next.links = {bytesOf(row.value(7)), bytesOf(row.value(8)), bytesOf(row.value(9)), bytesOf(row.value(10)),
                      bytesOf(row.value(11))};
        if (!isOfTrial(next.entry.event)) log[sequence] = {next.entry.event, {}, {}, {}, next.entry.unblinding};
    }
    return batch;
}

std::string nameOfEntry(const EventRecord& event)
{
    const std::string whose = event.participant.empty() ? std::string() : " of " + event.participant.value;
    return "log entry " + std::to_string(event.sequence) + " (" + event.kind + whose + ")";
}

nlohmann::json payloadOf(const LogEntry& entry) { return payloadIn(entry.event.payloadJson); }

/// Whether a recorded erasure concerns this entry: one of the participant's entries before it.
bool isErased(const LogEntry& entry, const std::map<std::string, std::int64_t>& erasedBefore)
{
    const auto act = erasedBefore.find(entry.event.participant.value);
    return act != erasedBefore.end() && entry.event.sequence < act->second;
}

bool isEmptied(const LogEntry& entry, const StoredLinks& links)
{
    return links.salt.empty() && entry.event.payloadJson == "{}" && entry.event.wallTime.empty() && entry.event.atNs == 0 &&
           entry.responses.empty() && entry.voids.empty() && entry.notes.empty() && entry.finger.empty();
}

/// Whether the rows, the content and the hash of an entry agree, and nothing is left where the entry was erased.
bool isWhole(const LogEntry& entry, const StoredLinks& links, bool erased)
{
    if (erased && !isEmptied(entry, links)) return false;
    if (!erased && (placesOf(entry) != links.places || commitmentOf(entry, links.salt) != links.commitment)) return false;
    return chainHash(links.previous, entry.event, links.places, links.commitment) == links.own;
}

std::map<std::string, std::int64_t> erasuresIn(const Log& log)
{
    std::map<std::string, std::int64_t> acts;
    for (const auto& [sequence, entry] : log) {
        if (entry.event.kind != "erased" || !entry.event.participant.empty()) continue;
        const nlohmann::json payload = payloadOf(entry);
        if (yesIn(payload, "answers_too")) acts[textIn(payload, "participant")] = sequence;
    }
    return acts;
}

/// The recorded erasures, before the log is read.
std::map<std::string, std::int64_t> recordedErasures(const SqliteConnection& sqlite)
{
    Log acts;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT sequence, payload FROM events WHERE kind = 'erased' AND participant = ''"));
    while (row.next()) {
        EventRecord& event = acts[row.value(0).toLongLong()].event;
        event.kind = "erased";
        event.payloadJson = fromQt(row.value(1));
    }
    return erasuresIn(acts);
}

/// Follows the chain from entry to entry.
class ChainCheck {
    using Sequences = std::numeric_limits<std::int64_t>;

public:
    ChainCheck(std::map<std::string, std::int64_t> erasedBefore, TellingFields fields)
        : m_erasedBefore(std::move(erasedBefore)), m_fields(std::move(fields))
    {
    }

    void check(const std::vector<LinkedEntry>& batch)
    {
        for (const auto& [entry, links] : batch) check(entry, links);
    }

    Faults& faults() { return m_faults; }

private:
    void check(const LogEntry& entry, const StoredLinks& links)
    {
        const std::int64_t sequence = entry.event.sequence;
        if (sequence != m_expected)
            m_faults.ofCopy.push_back("log entries from " + std::to_string(m_expected) + " to " +
                                      std::to_string(before(sequence)) + " are missing");
        if (links.previous != m_previous)
            m_faults.ofCopy.push_back(nameOfEntry(entry.event) + ": does not follow the entry before it");
        const bool erased = isErased(entry, m_erasedBefore);
        if (!isWhole(entry, links, erased))
            m_faults.ofCopy.push_back(nameOfEntry(entry.event) + ": the entry or its rows were altered");
        else if (!erased)
            for (const std::string& fault : faultsOfEntry(entry, m_fields))
                m_faults.ofAnswers.push_back(nameOfEntry(entry.event) + ": " + fault);
        m_previous = links.own;
        m_expected = after(sequence);
    }

    // An altered entry may have the smallest or the largest number that there is.
    static std::int64_t before(std::int64_t sequence) { return sequence - std::int64_t(sequence > Sequences::min()); }
    static std::int64_t after(std::int64_t sequence) { return sequence + std::int64_t(sequence < Sequences::max()); }

    std::map<std::string, std::int64_t> m_erasedBefore;
    TellingFields m_fields;
    std::string m_previous;
    std::int64_t m_expected = 1;
    Faults m_faults;
};

/// Reads the entries, checks the chain, and leaves in the log what later checks need, with the last entry. Another thread hashes
/// the entries while this one reads the next.
Faults faultsOfChain(const SqliteConnection& sqlite, Log& log)
{
    ChainCheck chain(recordedErasures(sqlite), fieldsOfAnswers(sqlite));
    QSqlQuery row = queryOfEvents(sqlite);
    std::future<void> hashed;
    EventRecord last;
    for (auto batch = nextEntries(row, log); !batch.empty(); batch = nextEntries(row, log)) {
        last = batch.back().entry.event;
        if (hashed.valid()) hashed.get();
        hashed = std::async(std::launch::async, [&chain, own = std::move(batch)] { chain.check(own); });
    }
    if (hashed.valid()) hashed.get();
    Faults faults = std::move(chain.faults());
    if (last.sequence > 0) log[last.sequence].event = last;
    for (const auto& [sequence, entry] : log)
        if (entry.event.sequence == 0)
            faults.ofCopy.push_back("log entry " + std::to_string(sequence) + " is missing, but its answers or notes are there");
    return faults;
}

void checkEnd(const SqliteConnection& sqlite, const Log& log, std::vector<std::string>& faults)
{
    const std::int64_t written =
        sqlite.value(QStringLiteral("SELECT seq FROM sqlite_sequence WHERE name = 'events'")).toLongLong();
    const std::int64_t last = log.empty() ? 0 : log.rbegin()->first;
    if (written != last)
        faults.push_back("the log ends at entry " + std::to_string(last) + ", " + std::to_string(written) + " were written");
    const auto strange =
        QStringLiteral("SELECT COUNT(*) - COUNT(DISTINCT name) + TOTAL(name NOT IN ('events', 'acts')) FROM sqlite_sequence");
    if (sqlite.value(strange).toInt() != 0) faults.emplace_back("study.db: the table sqlite_sequence has unknown rows");
}

/// The entry that an upgrade from an older schema left.
std::optional<LogEntry> upgradeIn(const Log& log)
{
    for (auto entry = log.rbegin(); entry != log.rend(); ++entry)
        if (entry->second.event.kind == upgradedKind && entry->second.event.participant.empty()) return entry->second;
    return std::nullopt;
}

/// An upgrade chains a log anew, and so it must not hide what was wrong before.
void checkUpgrade(const Log& log, std::vector<std::string>& faults)
{
    const auto upgrade = upgradeIn(log);
    if (!upgrade) return;
    const nlohmann::json before = payloadIn(upgrade->event.payloadJson);
    if (!before.is_object() || !before.contains("faults_before") || !before["faults_before"].is_array())
        faults.push_back(nameOfEntry(upgrade->event) + ": cannot be read");
    else
        for (const nlohmann::json& fault : before["faults_before"])
            faults.push_back("before the upgrade: " + (fault.is_string() ? fault.get<std::string>() : fault.dump()));
}

void checkFixedTables(const SqliteConnection& sqlite, const Log& log, std::vector<std::string>& faults)
{
    const auto first = log.find(1);
    if (first == log.end() || first->second.event.kind != "created") {
        faults.push_back("the log does not begin with the creation of the study");
        return;
    }
    const nlohmann::json payload = payloadOf(upgradeIn(log).value_or(first->second));
    if (textIn(payload, "fixed_sha256") != hashOfFixedTables(sqlite))
        faults.push_back(
            "study facts, fabrics, stimulus hashes, trial lists or swatch codes were altered after the study was made");
}

/// Compares "P01 in slot 1 (human)" of every participant in the log and in the table.
void checkPlaces(const SqliteConnection& sqlite, const Log& log, std::vector<std::string>& faults)
{
    std::set<std::string> logged, stored;
    const auto place = [](const std::string& id, int slot, const std::string& kind) {
        return id + " in slot " + std::to_string(slot) + " (" + kind + ")";
    };
    for (const auto& [sequence, entry] : log) {
        if (entry.event.kind != "enrolled") continue;
        const nlohmann::json payload = payloadOf(entry);
        logged.insert(place(textIn(payload, "participant"), numberIn(payload, "slot", 0), textIn(payload, "kind")));
    }
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT id, slot, kind FROM participants"));
    while (row.next()) stored.insert(place(fromQt(row.value(0)), row.value(1).toInt(), fromQt(row.value(2))));
    for (const std::string& one : stored)
        if (!logged.contains(one)) faults.push_back("participant " + one + " is not in the log");
    for (const std::string& one : logged)
        if (!stored.contains(one)) faults.push_back("participant " + one + " is in the log but not in the table");
}

/// The numbers run from 1, and the texts have the hashes that stand beside them.
void checkPreregistrations(const Log& log, std::vector<std::string>& faults)
{
    int expected = 1;
    for (const auto& [sequence, entry] : log) {
        if (entry.event.kind != "preregistered" || !entry.event.participant.empty()) continue;
        const std::string fault = faultOfPreregistration(payloadOf(entry), expected++);
        if (!fault.empty()) faults.push_back(nameOfEntry(entry.event) + ": " + fault);
    }
}

Faults faultsOfLog(const SqliteConnection& sqlite)
{
    Log log;
    Faults ofRows;
    readResponses(sqlite, log, ofRows.ofCopy);
    readRest(sqlite, log, ofRows);
    Faults faults = faultsOfChain(sqlite, log);
    append(faults.ofCopy, std::move(ofRows.ofCopy));
    append(faults.ofAnswers, std::move(ofRows.ofAnswers));
    checkEnd(sqlite, log, faults.ofCopy);
    checkUpgrade(log, faults.ofCopy);
    checkFixedTables(sqlite, log, faults.ofCopy);
    checkPlaces(sqlite, log, faults.ofCopy);
    StateFaults ofStates = faultsOfStates(sqlite, log);
    append(faults.ofCopy, std::move(ofStates.ofActs));
    append(faults.ofAnswers, std::move(ofStates.ofFacts));
    checkPreregistrations(log, faults.ofCopy);
    append(faults.ofAnswers, faultsOfNamedActs(sqlite, log));
    append(faults.ofAnswers, faultsOfAnswers(sqlite));
    return faults;
}

/// What SQLite finds in the file. It has a connection of its own, because this takes as long as the chain.
std::vector<std::string> faultsOfFile(const std::filesystem::path& file)
{
    const SqliteConnection sqlite(file, SqliteConnection::Mode::Read);
    // The index of the hashes is looked up in random order; 64 MB hold that of 500,000 entries.
    sqlite.run(QStringLiteral("PRAGMA cache_size = -65536"));
    std::vector<std::string> faults;
    QSqlQuery row = sqlite.run(QStringLiteral("PRAGMA integrity_check"));
    while (row.next())
        if (fromQt(row.value(0)) != "ok") faults.push_back("study.db: " + fromQt(row.value(0)));
    row = sqlite.run(QStringLiteral("PRAGMA foreign_key_check"));
    while (row.next())
        faults.push_back("study.db: table " + fromQt(row.value(0)) + ", row " + fromQt(row.value(1)) +
                         " refers to a missing row of " + fromQt(row.value(2)));
    for (std::string& fault : faultsOfIntegers(sqlite)) faults.push_back(std::move(fault));
    return faults;
}

Faults allFaults(const SqliteConnection& sqlite)
{
    requireTables(sqlite);
    auto ofFile = std::async(std::launch::async, faultsOfFile, sqlite.file());
    // One snapshot for the whole chain, because a writer may add entries meanwhile.
    const ReadSnapshot snapshot(sqlite);
    std::vector<std::string> ofSchema = faultsOfSchema(sqlite);
    Faults faults = faultsOfLog(sqlite);
    std::vector<std::string> first = ofFile.get();
    append(first, std::move(ofSchema));
    append(first, std::move(faults.ofCopy));
    faults.ofCopy = std::move(first);
    return faults;
}

}  // namespace

std::vector<std::string> faultsOfDatabase(const SqliteConnection& sqlite)
{
    Faults faults = allFaults(sqlite);
    append(faults.ofCopy, std::move(faults.ofAnswers));
    return std::move(faults.ofCopy);
}

std::vector<std::string> faultsOfCopy(const SqliteConnection& sqlite) { return allFaults(sqlite).ofCopy; }

}  // namespace database
