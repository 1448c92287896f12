#include "database/schema.h"

#include <QStringList>
#include <map>
#include <string>

#include "database/response_columns.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

// Fixed and logged tables refuse UPDATE and DELETE by trigger (appendOnlyTables). Of the others, participants changes with its
// states, which the log records, and participant_facts holds what can be erased.
constexpr const char* tables[] = {
    // The facts that never change: one row. design_seed is text because SQLite has no unsigned 64-bit integers.
    R"(CREATE TABLE study(
        id INTEGER PRIMARY KEY CHECK (id = 1), name TEXT NOT NULL,
        protocol_json TEXT NOT NULL, protocol_sha256 TEXT NOT NULL, design_seed TEXT NOT NULL,
        key_sha256 TEXT NOT NULL, station_key_sha256 TEXT NOT NULL, has_passphrase INTEGER NOT NULL,
        dataset_path TEXT NOT NULL, dataset_sha256 TEXT NOT NULL, dataset_procedural INTEGER NOT NULL,
        model_sha256 TEXT NOT NULL, stamps TEXT NOT NULL, signals_json TEXT NOT NULL, planned_balance TEXT NOT NULL,
        created_at TEXT NOT NULL, program_version TEXT NOT NULL, made_with TEXT NOT NULL) STRICT)",
    "CREATE TABLE fabrics(position INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, name TEXT NOT NULL) STRICT",
    "CREATE TABLE stimuli(file_code TEXT PRIMARY KEY, sha256 TEXT NOT NULL) STRICT",
    // A slot is one running order of the design. It becomes free when its participant withdraws.
    "CREATE TABLE slots(number INTEGER PRIMARY KEY CHECK (number >= 1)) STRICT",
    // sealed_code holds the file code of the image, encrypted with the station key: no two rows have an equal one. instruction is
    // an id of the phase, or empty; aim is speed, accuracy or empty; deadline_ms is the time that is left for an answer.
    R"(CREATE TABLE trials(
        slot INTEGER NOT NULL REFERENCES slots(number), number INTEGER NOT NULL CHECK (number >= 1),
        phase INTEGER NOT NULL, presentation_code TEXT NOT NULL, alternatives TEXT NOT NULL, sealed_code TEXT NOT NULL UNIQUE,
        instruction TEXT NOT NULL DEFAULT '', aim TEXT NOT NULL DEFAULT '', deadline_ms INTEGER,
        PRIMARY KEY (slot, number)) STRICT, WITHOUT ROWID)",
    R"(CREATE TABLE participants(
        id TEXT PRIMARY KEY, slot INTEGER NOT NULL REFERENCES slots(number),
        kind TEXT NOT NULL CHECK (kind IN ('human', 'scripted', 'simulated')),
        state TEXT NOT NULL CHECK (state IN ('started', 'finished', 'withdrawn')),
        protocol_version INTEGER NOT NULL DEFAULT 1) STRICT)",
    "CREATE UNIQUE INDEX one_in_a_slot ON participants(slot) WHERE state <> 'withdrawn'",
    // The log. participant is empty for acts on the study itself (created, enrolled, unblinded). payload, at_ns and wall_time are
    // content: an erasure empties them and the salt. places and commitment stay (event_chain.h).
    R"(CREATE TABLE events(
        sequence INTEGER PRIMARY KEY AUTOINCREMENT, participant TEXT NOT NULL, sitting INTEGER NOT NULL,
        kind TEXT NOT NULL, places TEXT NOT NULL, payload TEXT NOT NULL, at_ns INTEGER NOT NULL, wall_time TEXT NOT NULL,
        salt TEXT NOT NULL, commitment TEXT NOT NULL, previous_hash TEXT NOT NULL, hash TEXT NOT NULL UNIQUE) STRICT)",
    "CREATE INDEX events_of_participant ON events(participant, sequence)",
    // Every answer ever given. attempt counts the presentations of a trial from 1; a void starts the next one. The columns stand
    // in response_columns.cpp.
    R"(CREATE TABLE responses(
        id INTEGER PRIMARY KEY, event INTEGER NOT NULL REFERENCES events(sequence), %1,
        CHECK ((choice IS NULL) <> (rating_tenths IS NULL))) STRICT)",
    "CREATE INDEX responses_of_question ON responses(participant, trial, attempt, question, id)",
    // Guarantees that an answer is stored once: one first answer to a question in one attempt.
    "CREATE UNIQUE INDEX one_first_answer ON responses(participant, trial, attempt, question) WHERE is_correction = 0",
    R"(CREATE TABLE voids(
        event INTEGER NOT NULL REFERENCES events(sequence), participant TEXT NOT NULL REFERENCES participants(id),
        trial INTEGER NOT NULL, attempt INTEGER NOT NULL, PRIMARY KEY (participant, trial, attempt)) STRICT)",
    // question is null if the note concerns the whole presentation.
    R"(CREATE TABLE notes(
        id INTEGER PRIMARY KEY, event INTEGER NOT NULL REFERENCES events(sequence),
        participant TEXT NOT NULL REFERENCES participants(id), trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
        question TEXT, text TEXT NOT NULL, is_flag INTEGER NOT NULL DEFAULT 0) STRICT)",
    "CREATE INDEX notes_of_trial ON notes(participant, trial, attempt)",
    // What a sensor of the display measured of the finger, up to an answer of the presentation. samples: finger_text.h.
    R"(CREATE TABLE finger_samples(
        id INTEGER PRIMARY KEY, event INTEGER NOT NULL REFERENCES events(sequence),
        participant TEXT NOT NULL REFERENCES participants(id), trial INTEGER NOT NULL, attempt INTEGER NOT NULL,
        began_at INTEGER NOT NULL, count INTEGER NOT NULL, left_out INTEGER NOT NULL, samples TEXT NOT NULL) STRICT)",
    "CREATE INDEX finger_samples_of_trial ON finger_samples(participant, trial, attempt)",
    R"(CREATE TABLE unblindings(
        event INTEGER PRIMARY KEY REFERENCES events(sequence), who TEXT NOT NULL, why TEXT NOT NULL,
        wall_time TEXT NOT NULL) STRICT)",
    // Facts about people stand outside the log, so that they can be erased. The log holds the hash of salt and value.
    R"(CREATE TABLE participant_facts(
        participant TEXT NOT NULL REFERENCES participants(id), fact TEXT NOT NULL, value TEXT NOT NULL,
        salt TEXT NOT NULL DEFAULT '', PRIMARY KEY (participant, fact)) STRICT, WITHOUT ROWID)",
    R"(CREATE TABLE swatches(
        slot INTEGER NOT NULL REFERENCES slots(number), fabric TEXT NOT NULL REFERENCES fabrics(id), code TEXT NOT NULL,
        PRIMARY KEY (slot, fabric)) STRICT, WITHOUT ROWID)",
    "CREATE TABLE familiarisation(position INTEGER PRIMARY KEY, name TEXT NOT NULL, sealed_code TEXT NOT NULL) STRICT",
    // Later versions of the protocol; version 1 is in the table study.
    R"(CREATE TABLE protocol_versions(
        version INTEGER PRIMARY KEY CHECK (version >= 2), event INTEGER NOT NULL REFERENCES events(sequence),
        json TEXT NOT NULL, sha256 TEXT NOT NULL, who TEXT NOT NULL, why TEXT NOT NULL, wall_time TEXT NOT NULL) STRICT)",
    R"(CREATE TABLE erasures(
        event INTEGER PRIMARY KEY REFERENCES events(sequence), participant TEXT NOT NULL, answers_too INTEGER NOT NULL,
        who TEXT NOT NULL, why TEXT NOT NULL, wall_time TEXT NOT NULL) STRICT)",
    // Exports, backups and reports: a chain of its own, written without the lock of the sessions. details is JSON.
    R"(CREATE TABLE acts(
        number INTEGER PRIMARY KEY AUTOINCREMENT, kind TEXT NOT NULL, details TEXT NOT NULL, wall_time TEXT NOT NULL,
        previous_hash TEXT NOT NULL, hash TEXT NOT NULL UNIQUE) STRICT)",
};

constexpr const char* appendOnlyTables[] = {
    "study",    "fabrics", "stimuli",        "slots",       "trials",   "events",          "responses",
    "voids",    "notes",   "finger_samples", "unblindings", "swatches", "familiarisation", "protocol_versions",
    "erasures", "acts"};

// The documented view for the SQL of users; its columns must not change. The program itself never reads it. A piece is the code
// on a piece of fabric, or the fabric's id where the pieces have no codes.
constexpr const char* answersView =
    R"(CREATE VIEW answers AS SELECT
        first.participant AS participant, first.trial AS trial, first.question AS question,
        first.presentation_code AS presentation_code,
        COALESCE((SELECT json_group_array(piece) FROM (SELECT COALESCE(s.code, fabric.value) AS piece
            FROM json_each(first.alternatives) fabric
            LEFT JOIN swatches s ON s.slot = p.slot AND s.fabric = fabric.value ORDER BY fabric.key)), '[]') AS alternatives,
        COALESCE((SELECT s.code FROM swatches s WHERE s.slot = p.slot AND s.fabric = latest.choice), latest.choice) AS answer,
        latest.rating_tenths / 10.0 AS rating, first.ready_at AS ready_at, first.touched_at AS touched_at,
        first.answered_at AS answered_at, latest.stored_at AS stored_at,
        (first.answered_at - COALESCE(first.touched_at, first.ready_at)) / 1e9 AS seconds, %1,
        e.wall_time AS wall_time, %2, first.touch_ended_at AS touch_ended_at, first.answer_begun_at AS answer_begun_at,
        first.answer_begun_by AS answer_begun_by, first.entries AS entries,
        %4 / 1e9 AS response_seconds,
        (SELECT NULLIF(t.instruction, '') FROM trials t WHERE t.slot = p.slot AND t.number = first.trial) AS instruction,
        (SELECT t.deadline_ms / 1000.0 FROM trials t WHERE t.slot = p.slot AND t.number = first.trial) AS deadline_seconds,
        %4 > (SELECT t.deadline_ms * 1000000 FROM trials t WHERE t.slot = p.slot AND t.number = first.trial) AS late
      FROM %3
      ORDER BY p.slot, first.trial, first.id)";

// From the touch to the beginning of the answer, ns; null where a stamp is missing.
constexpr const char* responseNs =
    R"(CASE WHEN first.answer_begun_at >= CASE WHEN first.answer_begun_by = 'script'
                THEN COALESCE(first.touched_at, first.ready_at) ELSE first.touched_at END
            THEN (first.answer_begun_at - COALESCE(first.touched_at, first.ready_at)) END)";

constexpr const char* countsOfAnswer =
    R"((SELECT COUNT(*) FROM responses r WHERE r.participant = first.participant AND r.trial = first.trial
            AND r.attempt = first.attempt AND r.question = first.question) - 1 AS corrections,
        EXISTS (SELECT 1 FROM voids v WHERE v.participant = first.participant AND v.trial = first.trial
            AND v.attempt = first.attempt) AS voided)";

constexpr const char* noteOfAnswer =
    R"(COALESCE((SELECT group_concat(text, '; ') FROM (SELECT n.text AS text FROM notes n
            WHERE n.participant = first.participant AND n.trial = first.trial AND n.attempt = first.attempt
            AND (n.question IS NULL OR n.question = first.question) ORDER BY n.id)), '') AS note)";

constexpr const char* firstAndLatest =
    R"(responses first
      JOIN participants p ON p.id = first.participant
      JOIN responses latest ON latest.id = (SELECT MAX(r.id) FROM responses r WHERE r.participant = first.participant
            AND r.trial = first.trial AND r.attempt = first.attempt AND r.question = first.question)
      JOIN events e ON e.sequence = latest.event
      JOIN events begun ON begun.sequence = first.event
      WHERE first.is_correction = 0)";

constexpr const char* changingTables[] = {"participants", "participant_facts"};

/// "'study', 'fabrics', ...": the names of all tables, for a query.
QString quotedTableNames()
{
    QStringList names;
    for (const char* table : appendOnlyTables) names << QStringLiteral("'%1'").arg(QLatin1String(table));
    for (const char* table : changingTables) names << QStringLiteral("'%1'").arg(QLatin1String(table));
    return names.join(QStringLiteral(", "));
}

int versionOf(const SqliteConnection& connection) { return connection.value(QStringLiteral("PRAGMA user_version")).toInt(); }

}  // namespace

QString currentAnswersQuery()
{
    return QStringLiteral(
               "SELECT first.event AS event, %1, e.wall_time AS wall_time, %2, begun.sitting AS sitting, %3 FROM %4 "
               "ORDER BY p.slot, first.trial, first.id")
        .arg(QLatin1String(countsOfAnswer), QLatin1String(noteOfAnswer), currentAnswerColumns(), QLatin1String(firstAndLatest));
}

void guardAgainstChanges(const SqliteConnection& connection, const char* table)
{
    for (const char* change : {"UPDATE", "DELETE"})
        connection.run(QStringLiteral("CREATE TRIGGER %1_no_%2 BEFORE %2 ON %1 BEGIN "
                                      "SELECT RAISE(ABORT, '%1 is append-only'); END")
                           .arg(QLatin1String(table), QLatin1String(change)));
}

void unguard(const SqliteConnection& connection, const char* table)
{
    for (const char* change : {"UPDATE", "DELETE"})
        connection.run(QStringLiteral("DROP TRIGGER %1_no_%2").arg(QLatin1String(table), QLatin1String(change)));
}

void makeSchema(const SqliteConnection& connection)
{
    for (const char* table : tables) connection.run(QString::fromLatin1(table).replace(QStringLiteral("%1"), definitions()));
    connection.run(QString::fromLatin1(answersView)
                       .arg(QLatin1String(countsOfAnswer), QLatin1String(noteOfAnswer), QLatin1String(firstAndLatest),
                            QLatin1String(responseNs)));
    for (const char* table : appendOnlyTables) guardAgainstChanges(connection, table);
    connection.run(QStringLiteral("PRAGMA application_id = %1").arg(applicationId));
    connection.run(QStringLiteral("PRAGMA user_version = %1").arg(schemaVersion));
}

namespace {

/// "view answers" -> the table it belongs to and its text.
using Schema = std::map<std::string, std::string>;

Schema schemaOf(const SqliteConnection& sqlite)
{
    Schema schema;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT type, name, tbl_name, sql FROM sqlite_master"));
    while (row.next())
        schema[fromQt(row.value(0)) + " " + fromQt(row.value(1))] =
            fromQt(row.value(2)) + ": " + row.value(3).toString().simplified().toStdString();
    return schema;
}

/// "LEAST AND MOST" of a column of integers; empty for times, which have all 64 bits.
QString rangeOf(const QString& column)
{
    static const QStringList yesOrNo{QStringLiteral("is_correction"), QStringLiteral("is_flag"), QStringLiteral("answers_too"),
                                     QStringLiteral("has_passphrase"), QStringLiteral("dataset_procedural")};
    if (column.endsWith(QLatin1String("_at")) || column.endsWith(QLatin1String("_ns"))) return {};
    return yesOrNo.contains(column) ? QStringLiteral("0 AND 1") : QStringLiteral("-2147483648 AND 2147483647");
}

Schema schemaOfProgram()
{
    const SqliteConnection memory(":memory:", SqliteConnection::Mode::Memory);
    makeSchema(memory);
    return schemaOf(memory);
}

}  // namespace

std::vector<std::string> faultsOfSchema(const SqliteConnection& sqlite)
{
    std::vector<std::string> faults;
    const Schema expected = schemaOfProgram(), found = schemaOf(sqlite);
    for (const auto& [name, text] : expected)
        if (const auto same = found.find(name); same == found.end())
            faults.push_back("study.db: the " + name + " is missing");
        else if (same->second != text)
            faults.push_back("study.db: the " + name + " is not the one that this program makes");
    for (const auto& [name, text] : found)
        if (!expected.contains(name)) faults.push_back("study.db: the " + name + " is unknown to this program");
    return faults;
}

std::vector<std::string> faultsOfIntegers(const SqliteConnection& sqlite)
{
    std::vector<std::string> faults;
    const SqliteConnection memory(":memory:", SqliteConnection::Mode::Memory);
    makeSchema(memory);  // names of other tables are faults of the schema
    QSqlQuery table = memory.run(QStringLiteral("SELECT name FROM sqlite_master WHERE type = 'table' AND sql LIKE '%STRICT%'"));
    while (table.next()) {
        const QString name = table.value(0).toString();
        QStringList columns, counts;
        QSqlQuery column = memory.run(QStringLiteral("SELECT name FROM pragma_table_info(?) WHERE type = 'INTEGER'"), {name});
        while (column.next()) {
            const QString of = column.value(0).toString(), range = rangeOf(of);
            if (range.isEmpty()) continue;
            columns << of;
            counts << QStringLiteral("TOTAL(%1 NOT BETWEEN %2)").arg(of, range);
        }
        if (columns.isEmpty()) continue;
        QSqlQuery row = sqlite.run(QStringLiteral("SELECT %1 FROM %2").arg(counts.join(QStringLiteral(", ")), name));
        if (!row.next()) continue;
        for (int i = 0; i < columns.size(); ++i)
            if (const double rows = row.value(i).toDouble(); rows > 0)
                faults.push_back("study.db: " + std::to_string(static_cast<long>(rows)) + " rows of the table " +
                                 name.toStdString() + " hold numbers in " + columns[i].toStdString() +
                                 " that this program does not write");
    }
    return faults;
}

void requireTables(const SqliteConnection& connection)
{
    // SQLite compares names without their case. A virtual table has no page of its own.
    const auto others = QStringLiteral(
        "SELECT name FROM sqlite_master WHERE (type = 'view' OR (type = 'table' AND rootpage = 0)) AND lower(name) IN (%1)");
    QSqlQuery row = connection.run(others.arg(quotedTableNames()));
    if (row.next())
        throw protocols::workFailed({"a view or a virtual table stands in the place of the table " + fromQt(row.value(0)),
                                     connection.file().string(), "the tables that this program makes",
                                     "somebody altered the file; restore it from a backup"});
}

int checkedVersion(const SqliteConnection& connection)
{
    const int version = versionOf(connection);
    if (connection.value(QStringLiteral("PRAGMA application_id")).toInt() != applicationId || version < 1)
        throw protocols::badInput({"this database belongs to another program", connection.file().string(),
                                   "the study.db of a study folder", "check the path"});
    if (version > schemaVersion)
        throw protocols::badInput({"a newer version of this program made the study (schema " + std::to_string(version) + ")",
                                   connection.file().string(), "schema " + std::to_string(schemaVersion) + " or older",
                                   "update this program"});
    requireTables(connection);
    const auto newest = QStringLiteral(
        "SELECT (SELECT COUNT(*) FROM pragma_table_info('responses') WHERE name = 'answer_begun_at') + "
        "(SELECT COUNT(*) FROM pragma_table_info('trials') WHERE name = 'deadline_ms') + "
        "(SELECT COUNT(*) FROM sqlite_master WHERE type = 'table' AND name = 'finger_samples')");
    if (version == schemaVersion && connection.value(newest).toInt() < 3)
        throw protocols::badInput({"a development version of this program made the study, and tables or columns are missing",
                                   connection.file().string(), "a study of 0.5.0 or of this version",
                                   "finish and export it with the program that made it"});
    return version;
}

}  // namespace database
