#include "database/upgrade/older_study.h"

#include <QSqlRecord>
#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "database/disk/payload_fields.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "database/study_rows.h"
#include "protocols/files/canonical_bytes.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

constexpr const char* olderResponses =
    "SELECT id, event, participant, trial, attempt, question, file_code, alternatives, choice, rating_tenths, ready_at, "
    "touched_at, answered_at, stored_at, is_correction, %1 FROM responses ORDER BY id";

StudyFacts olderFactsIn(const SqliteConnection& sqlite, std::string& maskedKeySha256)
{
    QSqlQuery row = sqlite.run(QStringLiteral(
        "SELECT name, protocol_json, protocol_sha256, key_sha256, dataset_path, dataset_sha256, model_sha256, signals_json, "
        "created_at, program_version, masked_key_sha256, dataset_procedural, stamps, design_seed FROM study"));
    if (!row.next())
        throw protocols::workFailed(
            {"the study's facts are missing", sqlite.file().string(), "one row in the table study", "restore it from a backup"});
    StudyFacts facts;
    int column = 0;
    for (std::string* text :
         {&facts.name, &facts.protocolJson, &facts.protocolSha256, &facts.keySha256, &facts.datasetPath, &facts.datasetSha256,
          &facts.modelSha256, &facts.signalsJson, &facts.createdAt, &facts.programVersion, &maskedKeySha256})
        *text = fromQt(row.value(column++));
    facts.datasetProcedural = row.value(column++).toInt() != 0;
    facts.stamps = textsOf(fromQt(row.value(column++)));
    const std::string seed = fromQt(row.value(column));
    std::from_chars(seed.data(), seed.data() + seed.size(), facts.designSeed);
    QSqlQuery fabric = sqlite.run(QStringLiteral("SELECT id, name FROM fabrics ORDER BY position"));
    while (fabric.next()) {
        facts.fabrics.emplace_back(fromQt(fabric.value(0)));
        facts.fabricNames[facts.fabrics.back()] = fromQt(fabric.value(1));
    }
    return facts;
}

void readOlderPieces(const SqliteConnection& sqlite, OlderStudy& study)
{
    study.facts.swatches = swatchesIn(sqlite, study.facts.fabrics);
    QSqlQuery item = sqlite.run(QStringLiteral("SELECT name, file_code FROM familiarisation ORDER BY position"));
    while (item.next()) study.familiarisation.emplace_back(fromQt(item.value(0)), protocols::FileCode(fromQt(item.value(1))));
}

protocols::Error damaged(const SqliteConnection& sqlite, const std::string& what, const std::string& expected)
{
    return protocols::workFailed(
        {what, sqlite.file().string(), expected, "restore the study from a backup; it cannot be upgraded like this"});
}

void readOlderLists(const SqliteConnection& sqlite, OlderStudy& study)
{
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT file_code, sha256 FROM stimuli"));
    while (row.next()) study.stimuli[protocols::FileCode(fromQt(row.value(0)))] = fromQt(row.value(1));
    row = sqlite.run(QStringLiteral("SELECT number FROM slots ORDER BY number"));
    for (; row.next(); study.slots.emplace_back())
        if (row.value(0).toULongLong() != study.slots.size() + 1)
            throw damaged(sqlite, "a slot has the number " + fromQt(row.value(0)), "slots that are numbered from 1");
    row = sqlite.run(QStringLiteral(
        "SELECT slot, number, phase, presentation_code, alternatives, file_code FROM trials ORDER BY slot, number"));
    while (row.next()) {
        const qulonglong slot = row.value(0).toULongLong();
        if (slot < 1 || slot > study.slots.size())
            throw damaged(sqlite, "a trial belongs to slot " + fromQt(row.value(0)),
                          "a slot from 1 to " + std::to_string(study.slots.size()));
        study.slots[slot - 1].push_back({{protocols::TrialNumber{row.value(1).toInt()},
                                          row.value(2).toInt(),
                                          {},
                                          protocols::PresentationCode(fromQt(row.value(3))),
                                          fabricsOf(fromQt(row.value(4)))},
                                         protocols::FileCode(fromQt(row.value(5)))});
    }
}

void readOlderEvents(const SqliteConnection& sqlite, OlderStudy& study)
{
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT sequence, participant, sitting, kind, payload, at_ns, wall_time, "
                                  "previous_hash, hash FROM events ORDER BY sequence"));
    while (row.next()) {
        const qlonglong sequence = row.value(0).toLongLong();
        study.events[sequence] = {sequence,
                                  protocols::ParticipantId(fromQt(row.value(1))),
                                  row.value(2).toInt(),
                                  fromQt(row.value(3)),
                                  fromQt(row.value(4)),
                                  row.value(5).toLongLong(),
                                  fromQt(row.value(6))};
        study.links[sequence] = {fromQt(row.value(7)), fromQt(row.value(8))};
    }
}

void readOlderRows(const SqliteConnection& sqlite, OlderStudy& study)
{
    const bool first = study.version < 2;
    QSqlQuery row = sqlite.run(QString::fromLatin1(olderResponses).arg(QLatin1String(first ? "NULL" : "touched_by")));
    while (row.next())
        study.responses.push_back(
            {row.value(0).toLongLong(), row.value(1).toLongLong(), rowFrom(row, ResponseColumns::OfTable, 2)});
    row = sqlite.run(QStringLiteral("SELECT event, participant, trial, attempt FROM voids ORDER BY rowid"));
    while (row.next())
        study.voids.push_back({0, row.value(0).toLongLong(), {fromQt(row.value(1)), row.value(2).toInt(), row.value(3).toInt()}});
    row = sqlite.run(QStringLiteral("SELECT id, event, participant, trial, attempt, question, text, %1 FROM notes ORDER BY id")
                         .arg(QLatin1String(first ? "0" : "is_flag")));
    while (row.next()) {
        NoteRow note{fromQt(row.value(2)), row.value(3).toInt(), row.value(4).toInt(),
                     std::nullopt,         fromQt(row.value(6)), row.value(7).toInt() != 0};
        if (!row.value(5).isNull()) note.question = fromQt(row.value(5));
        study.notes.push_back({row.value(0).toLongLong(), row.value(1).toLongLong(), note});
    }
    row = sqlite.run(QStringLiteral("SELECT event, who, why, wall_time FROM unblindings"));
    while (row.next())
        study.unblindings[row.value(0).toLongLong()] = {fromQt(row.value(1)), fromQt(row.value(2)), fromQt(row.value(3))};
}

// The hash covers the text of each query, too, so that the texts must stay as they are.
constexpr const char* olderFixedRows[] = {
    "SELECT name, protocol_json, protocol_sha256, design_seed, key_sha256, masked_key_sha256, dataset_path, dataset_sha256, "
    "dataset_procedural, model_sha256, stamps, signals_json, created_at, program_version FROM study",
    "SELECT position, id, name FROM fabrics ORDER BY position",
    "SELECT file_code, sha256 FROM stimuli ORDER BY file_code",
    "SELECT number FROM slots ORDER BY number",
    "SELECT slot, number, phase, file_code, presentation_code, alternatives FROM trials ORDER BY slot, number",
    // Since schema 2.
    "SELECT slot, fabric, code FROM swatches ORDER BY slot, fabric",
    "SELECT position, name, file_code FROM familiarisation ORDER BY position",
};
constexpr std::size_t fixedRowsOfFirstSchema = 5;

void addOlderResponse(protocols::CanonicalBytes& bytes, const ResponseRow& row)
{
    bytes << std::string("response") << row.participant << row.trial << row.attempt << row.question << row.presentationCode
          << row.alternatives << row.choice << row.ratingTenths << row.readyAt << row.touchedAt << row.answeredAt << row.storedAt
          << row.isCorrection;
    if (row.touchedBy) bytes << std::string("touched by") << *row.touchedBy;
}

std::string olderChainHash(const std::string& previous, const LogEntry& entry)
{
    protocols::CanonicalBytes bytes;
    const EventRecord& event = entry.event;
    bytes << previous << event.sequence << event.participant.value << event.sitting << event.kind << event.payloadJson
          << event.atNs << event.wallTime;
    for (const ResponseRow& row : entry.responses) addOlderResponse(bytes, row);
    for (const VoidRow& row : entry.voids) bytes << std::string("void") << row.participant << row.trial << row.attempt;
    for (const NoteRow& row : entry.notes) {
        bytes << std::string("note") << row.participant << row.trial << row.attempt << row.question << row.text;
        if (row.isFlag) bytes << std::string("flag");
    }
    if (entry.unblinding)
        bytes << std::string("unblinding") << entry.unblinding->who << entry.unblinding->why << entry.unblinding->wallTime;
    return bytes.hash();
}

std::vector<std::string> faultsOfOlderChain(const OlderStudy& study)
{
    std::vector<std::string> faults;
    const auto erasedBefore = erasuresInOlderLog(study);
    std::string previous;
    for (const auto& [sequence, entry] : entriesOf(study)) {
        const auto links = study.links.find(sequence);
        if (links == study.links.end()) continue;  // the audit of the new database finds rows without an entry
        const std::string name = "log entry " + std::to_string(sequence) + " (" + entry.event.kind + ")";
        if (links->second.previous != previous) faults.push_back(name + ": does not follow the entry before it");
        if (!isErasedInOlderLog(entry, erasedBefore) && olderChainHash(links->second.previous, entry) != links->second.own)
            faults.push_back(name + ": the entry or its rows were altered");
        previous = links->second.own;
    }
    return faults;
}

void checkOlderEnd(const SqliteConnection& sqlite, const OlderStudy& study, std::vector<std::string>& faults)
{
    const qlonglong written = sqlite.value(QStringLiteral("SELECT seq FROM sqlite_sequence WHERE name = 'events'")).toLongLong();
    const qlonglong last = study.events.empty() ? 0 : study.events.rbegin()->first;
    if (written != last)
        faults.push_back("the log ended at entry " + std::to_string(last) + ", " + std::to_string(written) + " were written");
}

void checkOlderFixedRows(const SqliteConnection& sqlite, const OlderStudy& study, std::vector<std::string>& faults)
{
    const auto first = study.events.find(1);
    const nlohmann::json made = payloadIn(first == study.events.end() ? std::string() : first->second.payloadJson);
    const std::span<const char* const> all(olderFixedRows);
    const bool isOfFirstSchema = numberIn(made, "schema", 1) < 2 || study.version < 2;
    if (textIn(made, "fixed_sha256") != hashOfRows(sqlite, isOfFirstSchema ? all.first(fixedRowsOfFirstSchema) : all))
        faults.emplace_back(
            "study facts, fabrics, stimulus hashes, trial lists or swatch codes were altered after the study was made");
}

/// The columns of an older table, "1 AS protocol_version" for one that schema 1 lacks; empty for a table that it lacks.
QString olderColumnsOf(const QString& table, int version)
{
    if (table == QLatin1String("participants"))
        return QStringLiteral("id, slot, kind, state, ") +
               QLatin1String(version < 2 ? "1 AS protocol_version" : "protocol_version");
    if (version < 2) return {};
    if (table == QLatin1String("participant_facts")) return QStringLiteral("participant, fact, value");
    if (table == QLatin1String("protocol_versions")) return QStringLiteral("version, event, json, sha256, who, why, wall_time");
    return QStringLiteral("event, participant, answers_too, who, why, wall_time");
}

}  // namespace

OlderStudy readOlderStudy(const SqliteConnection& sqlite)
{
    OlderStudy study;
    study.version = checkedVersion(sqlite);
    study.facts = olderFactsIn(sqlite, study.maskedKeySha256);
    if (study.version >= 2) readOlderPieces(sqlite, study);
    readOlderLists(sqlite, study);
    readOlderEvents(sqlite, study);
    readOlderRows(sqlite, study);
    return study;
}

void copyOlderRows(const SqliteConnection& older, const SqliteConnection& made, const QString& table, int version)
{
    const QString columns = olderColumnsOf(table, version);
    if (columns.isEmpty()) return;
    const QString order = table == QLatin1String("participant_facts") ? "participant, fact" : "rowid";
    QSqlQuery row = older.run(QStringLiteral("SELECT %1 FROM %2 ORDER BY %3").arg(columns, table, order));
    const int count = row.record().count();
    const QString places = QStringList(count, QStringLiteral("?")).join(QStringLiteral(", "));
    while (row.next()) {
        QVariantList values;
        for (int column = 0; column < count; ++column) values << row.value(column);
        made.run(QStringLiteral("INSERT INTO %1(%2) VALUES (%3)").arg(table, olderColumnsOf(table, schemaVersion), places),
                 values);
    }
}

std::map<qlonglong, LogEntry> entriesOf(const OlderStudy& study)
{
    std::map<qlonglong, LogEntry> entries;
    for (const auto& [sequence, event] : study.events) entries[sequence].event = event;
    for (const auto& one : study.responses) entries[one.event].responses.push_back(one.row);
    for (const auto& one : study.voids) entries[one.event].voids.push_back(one.row);
    for (const auto& one : study.notes) entries[one.event].notes.push_back(one.row);
    for (const auto& [event, record] : study.unblindings) entries[event].unblinding = record;
    return entries;
}

std::vector<std::string> faultsOfOlderLog(const SqliteConnection& sqlite, const OlderStudy& study)
{
    std::vector<std::string> faults;
    QSqlQuery row = sqlite.run(QStringLiteral("PRAGMA integrity_check"));
    while (row.next())
        if (fromQt(row.value(0)) != "ok") faults.push_back("study.db: " + fromQt(row.value(0)));
    for (std::string& fault : faultsOfOlderChain(study)) faults.push_back(std::move(fault));
    checkOlderEnd(sqlite, study, faults);
    checkOlderFixedRows(sqlite, study, faults);
    return faults;
}

std::map<std::string, qlonglong> erasuresInOlderLog(const OlderStudy& study)
{
    std::map<std::string, qlonglong> acts;
    for (const auto& [sequence, event] : study.events) {
        if (event.kind != "erased" || !event.participant.empty()) continue;
        const nlohmann::json payload = payloadIn(event.payloadJson);
        if (yesIn(payload, "answers_too")) acts[textIn(payload, "participant")] = sequence;
    }
    return acts;
}

bool isErasedInOlderLog(const LogEntry& entry, const std::map<std::string, qlonglong>& erasedBefore)
{
    const auto act = erasedBefore.find(entry.event.participant.value);
    return act != erasedBefore.end() && entry.event.sequence < act->second && entry.event.payloadJson == "{}" &&
           entry.responses.empty() && entry.voids.empty() && entry.notes.empty();
}

}  // namespace database
