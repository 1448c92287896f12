#include "database/event_chain.h"

#include <QSqlRecord>
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "protocols/files/canonical_bytes.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/secrets/secret_key.h"

namespace database {

namespace {

// Columns by name, so that a column of a later schema does not change the hash of an older study.
constexpr const char* fixedRows[] = {
    "SELECT name, protocol_json, protocol_sha256, design_seed, key_sha256, station_key_sha256, has_passphrase, dataset_path, "
    "dataset_sha256, dataset_procedural, model_sha256, stamps, signals_json, planned_balance, created_at, program_version, "
    "made_with FROM study",
    "SELECT position, id, name FROM fabrics ORDER BY position",
    "SELECT file_code, sha256 FROM stimuli ORDER BY file_code",
    "SELECT number FROM slots ORDER BY number",
    "SELECT slot, number, phase, presentation_code, alternatives, sealed_code, instruction, aim, deadline_ms FROM "
    "trials ORDER BY slot, number",
    "SELECT slot, fabric, code FROM swatches ORDER BY slot, fabric",
    "SELECT position, name, sealed_code FROM familiarisation ORDER BY position",
};

constexpr std::size_t saltBytes = 32;

void addRows(protocols::CanonicalBytes& bytes, const SqliteConnection& connection, const char* rows)
{
    bytes << std::string(rows);
    QSqlQuery query = connection.run(QString::fromLatin1(rows));
    const int columns = query.record().count();
    while (query.next())
        for (int column = 0; column < columns; ++column) bytes << fromQt(query.value(column));
}

void insertResponse(const SqliteConnection& connection, std::int64_t event, const ResponseRow& row)
{
    static const QString insertion =
        QStringLiteral("INSERT INTO responses(event, %1) VALUES (?, %2)").arg(namesOf(ResponseColumns::OfTable), placeholders());
    connection.runKept(insertion, QVariantList{qlonglong(event)} + valuesOf(row));
}

struct Links {
    std::string places, salt, commitment, previous, hash;
};

void insertEvent(const SqliteConnection& connection, const EventRecord& event, const Links& links)
{
    connection.runKept(
        QStringLiteral("INSERT INTO events(sequence, participant, sitting, kind, places, payload, at_ns, wall_time, "
                       "salt, commitment, previous_hash, hash) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
        {qlonglong(event.sequence), toQt(event.participant.value), event.sitting, toQt(event.kind), toQt(links.places),
         toQt(event.payloadJson), qlonglong(event.atNs), toQt(event.wallTime), toQt(links.salt), toQt(links.commitment),
         toQt(links.previous), toQt(links.hash)});
}

/// The chain of acts has no lock and no head of its own that is given out at sittings. So the log commits to it.
void nameLastAct(const SqliteConnection& connection, EventRecord& event)
{
    auto last = connection.runKept(QStringLiteral("SELECT number, hash FROM acts ORDER BY number DESC LIMIT 1"));
    if (!last.next()) return;
    auto payload = protocols::storedOrderedJson(event.payloadJson);
    if (!payload.is_object()) return;
    payload["acts"] = {{"number", last.value(0).toLongLong()}, {"sha256", fromQt(last.value(1))}};
    event.payloadJson = payload.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void insertRows(const SqliteConnection& connection, const LogEntry& entry)
{
    const qlonglong event = entry.event.sequence;
    for (const ResponseRow& row : entry.responses) insertResponse(connection, event, row);
    for (const VoidRow& row : entry.voids)
        connection.run(QStringLiteral("INSERT INTO voids(event, participant, trial, attempt) VALUES (?, ?, ?, ?)"),
                       {event, toQt(row.participant), row.trial, row.attempt});
    for (const NoteRow& row : entry.notes)
        connection.run(
            QStringLiteral(
                "INSERT INTO notes(event, participant, trial, attempt, question, text, is_flag) VALUES (?, ?, ?, ?, ?, ?, ?)"),
            {event, toQt(row.participant), row.trial, row.attempt, row.question ? QVariant(toQt(*row.question)) : QVariant(),
             toQt(row.text), int(row.isFlag)});
    for (const FingerRow& row : entry.finger)
        connection.runKept(
            QStringLiteral("INSERT INTO finger_samples(event, participant, trial, attempt, began_at, count, left_out, "
                           "samples) VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
            {event, toQt(row.participant), row.trial, row.attempt, qlonglong(row.beganAt), row.count, row.leftOut,
             toQt(row.samples)});
    if (entry.unblinding)
        connection.run(QStringLiteral("INSERT INTO unblindings(event, who, why, wall_time) VALUES (?, ?, ?, ?)"),
                       {event, toQt(entry.unblinding->who), toQt(entry.unblinding->why), toQt(entry.unblinding->wallTime)});
}

}  // namespace

bool isOfTrial(const EventRecord& event)
{
    return !event.participant.empty() && (event.kind == "answered" || event.kind == "touched" || event.kind == "tray_ready");
}

std::string placesOf(const LogEntry& entry)
{
    protocols::CanonicalBytes bytes;
    for (const ResponseRow& row : entry.responses) addPlaceTo(bytes, row);
    for (const VoidRow& row : entry.voids) bytes << std::string("void") << row.participant << row.trial << row.attempt;
    for (const NoteRow& row : entry.notes)
        bytes << std::string("note") << row.participant << row.trial << row.attempt << row.question << row.isFlag;
    for (const FingerRow& row : entry.finger) bytes << std::string("finger") << row.participant << row.trial << row.attempt;
    return bytes.text();
}

std::string commitmentOf(const LogEntry& entry, const std::string& salt)
{
    protocols::CanonicalBytes bytes;
    bytes << salt << entry.event.payloadJson << entry.event.atNs << entry.event.wallTime;
    for (const ResponseRow& row : entry.responses) addContentTo(bytes, row);
    for (const NoteRow& row : entry.notes) bytes << std::string("note") << row.text;
    for (const FingerRow& row : entry.finger)
        bytes << std::string("finger") << row.beganAt << row.count << row.leftOut << row.samplesSha256;
    if (entry.unblinding)
        bytes << std::string("unblinding") << entry.unblinding->who << entry.unblinding->why << entry.unblinding->wallTime;
    return bytes.hash();
}

std::string chainHash(const std::string& previous, const EventRecord& event, const std::string& places,
                      const std::string& commitment)
{
    protocols::CanonicalBytes bytes;
    bytes << previous << event.sequence << event.participant.value << event.sitting << event.kind << places << commitment;
    return bytes.hash();
}

std::string commitmentOfFact(const std::string& salt, const std::string& fact, const std::string& value)
{
    protocols::CanonicalBytes bytes;
    bytes << salt << fact << value;
    return bytes.hash();
}

LogEntry actOnStudy(const std::string& kind, const nlohmann::ordered_json& payload, const std::string& wallTime)
{
    LogEntry entry;
    entry.event.kind = kind;
    entry.event.payloadJson = payload.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    entry.event.wallTime = wallTime;
    return entry;
}

std::int64_t store(const SqliteConnection& connection, LogEntry entry)
{
    std::string previous;
    entry.event.sequence = 1;
    if (auto last = connection.runKept(QStringLiteral("SELECT sequence, hash FROM events ORDER BY sequence DESC LIMIT 1"));
        last.next()) {
        const std::int64_t before = last.value(0).toLongLong();
        if (before == std::numeric_limits<std::int64_t>::max())
            throw protocols::workFailed({"the last entry of the log has the largest number that there is",
                                         connection.file().string(), "entries that are numbered from 1",
                                         "see `vis2hap verify`; restore the study from a backup"});
        entry.event.sequence = before + 1;
        previous = fromQt(last.value(1));
    }
    if (!isOfTrial(entry.event)) nameLastAct(connection, entry.event);
    storeUnderItsNumber(connection, entry, previous, drawnSalt());
    insertRows(connection, entry);
    return entry.event.sequence;
}

std::string storeUnderItsNumber(const SqliteConnection& connection, const LogEntry& entry, const std::string& previous,
                                const std::string& salt)
{
    Links links{placesOf(entry), salt, commitmentOf(entry, salt), previous, {}};
    links.hash = chainHash(previous, entry.event, links.places, links.commitment);
    insertEvent(connection, entry.event, links);
    return links.hash;
}

std::string chainHash(const ChainedAct& act)
{
    protocols::CanonicalBytes bytes;
    bytes << std::string("act") << act.previous << act.number << act.kind << act.details << act.wallTime;
    return bytes.hash();
}

std::vector<ChainedAct> chainedActsIn(const SqliteConnection& connection)
{
    std::vector<ChainedAct> acts;
    QSqlQuery row =
        connection.run(QStringLiteral("SELECT number, kind, wall_time, details, previous_hash, hash FROM acts ORDER BY number"));
    while (row.next())
        acts.push_back({row.value(0).toLongLong(), fromQt(row.value(1)), fromQt(row.value(2)), fromQt(row.value(3)),
                        fromQt(row.value(4)), fromQt(row.value(5))});
    return acts;
}

void appendAct(const SqliteConnection& connection, ChainedAct act)
{
    QSqlQuery last = connection.run(QStringLiteral("SELECT number, hash FROM acts ORDER BY number DESC LIMIT 1"));
    const bool isFirst = !last.next();
    act.number = isFirst ? 1 : last.value(0).toLongLong() + 1;
    act.previous = isFirst ? std::string() : fromQt(last.value(1));
    act.hash = chainHash(act);
    connection.run(
        QStringLiteral("INSERT INTO acts(number, kind, details, wall_time, previous_hash, hash) VALUES (?, ?, ?, ?, ?, ?)"),
        {qlonglong(act.number), toQt(act.kind), toQt(act.details), toQt(act.wallTime), toQt(act.previous), toQt(act.hash)});
}

KeptActs keepActsOf(const SqliteConnection& earlier, const SqliteConnection& into)
{
    const std::vector<ChainedAct> present = chainedActsIn(earlier), kept = chainedActsIn(into);
    const auto differing = std::ranges::mismatch(present, kept, {}, &ChainedAct::hash, &ChainedAct::hash).in1;
    KeptActs acts;
    Transaction transaction(into);
    for (auto act = differing; act != present.end(); ++act) {
        const bool isAltered = chainHash(*act) != act->hash;
        ++(isAltered ? acts.altered : acts.added);
        if (!isAltered) appendAct(into, *act);
    }
    transaction.commit();
    return acts;
}

std::string drawnSalt() { return protocols::drawHex(saltBytes); }

std::string hashOfRows(const SqliteConnection& connection, std::span<const char* const> queries)
{
    protocols::CanonicalBytes bytes;
    for (const char* query : queries) addRows(bytes, connection, query);
    return bytes.hash();
}

std::string hashOfFixedTables(const SqliteConnection& connection) { return hashOfRows(connection, fixedRows); }

}  // namespace database
