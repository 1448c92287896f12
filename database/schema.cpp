#include "database/schema.h"

#include <span>
#include <string>

#include "database/response_columns.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

// Version 1. Fixed and logged tables refuse UPDATE and DELETE by trigger (see appendOnlyTables). Only participants.state changes,
// and the log records every change.
constexpr const char* firstTables[] = {
    // The facts that never change: one row. design_seed is text because SQLite has no unsigned 64-bit integers.
    R"(CREATE TABLE study(
        id INTEGER PRIMARY KEY CHECK (id = 1), name TEXT NOT NULL,
        protocol_json TEXT NOT NULL, protocol_sha256 TEXT NOT NULL, design_seed TEXT NOT NULL,
        key_sha256 TEXT NOT NULL, masked_key_sha256 TEXT NOT NULL,
        dataset_path TEXT NOT NULL, dataset_sha256 TEXT NOT NULL, dataset_procedural INTEGER NOT NULL,
        model_sha256 TEXT NOT NULL, stamps TEXT NOT NULL, signals_json TEXT NOT NULL,
        created_at TEXT NOT NULL, program_version TEXT NOT NULL) STRICT)",
    "CREATE TABLE fabrics(position INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, name TEXT NOT NULL) STRICT",
    "CREATE TABLE stimuli(file_code TEXT PRIMARY KEY, sha256 TEXT NOT NULL) STRICT",
    // A slot is one running order of the design; a participant takes one slot.
    "CREATE TABLE slots(number INTEGER PRIMARY KEY CHECK (number >= 1)) STRICT",
    R"(CREATE TABLE trials(
        slot INTEGER NOT NULL REFERENCES slots(number), number INTEGER NOT NULL CHECK (number >= 1),
        phase INTEGER NOT NULL, file_code TEXT NOT NULL REFERENCES stimuli(file_code),
        presentation_code TEXT NOT NULL, alternatives TEXT NOT NULL,
        PRIMARY KEY (slot, number)) STRICT, WITHOUT ROWID)",
    R"(CREATE TABLE participants(
        id TEXT PRIMARY KEY, slot INTEGER NOT NULL UNIQUE REFERENCES slots(number),
        kind TEXT NOT NULL CHECK (kind IN ('human', 'scripted', 'simulated')),
        state TEXT NOT NULL CHECK (state IN ('started', 'finished', 'withdrawn'))) STRICT)",
    // The log. participant is empty for acts on the study itself (created, enrolled, unblinded).
    R"(CREATE TABLE events(
        sequence INTEGER PRIMARY KEY AUTOINCREMENT, participant TEXT NOT NULL, sitting INTEGER NOT NULL,
        kind TEXT NOT NULL, payload TEXT NOT NULL, at_ns INTEGER NOT NULL, wall_time TEXT NOT NULL,
        previous_hash TEXT NOT NULL, hash TEXT NOT NULL UNIQUE) STRICT)",
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
        question TEXT, text TEXT NOT NULL) STRICT)",
    "CREATE INDEX notes_of_trial ON notes(participant, trial, attempt)",
    R"(CREATE TABLE unblindings(
        event INTEGER PRIMARY KEY REFERENCES events(sequence), who TEXT NOT NULL, why TEXT NOT NULL,
        wall_time TEXT NOT NULL) STRICT)",
};

constexpr const char* views[] = {
    // The latest answer to each question of each attempt, with the time stamps of the first: a correction changes the answer, not
    // its time.
    R"(CREATE VIEW current_responses AS SELECT
        p.slot AS slot, first.id AS first_id, first.event AS event, %1,
        (SELECT COUNT(*) FROM responses r WHERE r.participant = first.participant AND r.trial = first.trial
            AND r.attempt = first.attempt AND r.question = first.question) - 1 AS corrections,
        EXISTS (SELECT 1 FROM voids v WHERE v.participant = first.participant AND v.trial = first.trial
            AND v.attempt = first.attempt) AS voided,
        e.wall_time AS wall_time,
        COALESCE((SELECT group_concat(text, '; ') FROM (SELECT n.text AS text FROM notes n
            WHERE n.participant = first.participant AND n.trial = first.trial AND n.attempt = first.attempt
            AND (n.question IS NULL OR n.question = first.question) ORDER BY n.id)), '') AS note
      FROM responses first
      JOIN participants p ON p.id = first.participant
      JOIN responses latest ON latest.id = (SELECT MAX(r.id) FROM responses r WHERE r.participant = first.participant
            AND r.trial = first.trial AND r.attempt = first.attempt AND r.question = first.question)
      JOIN events e ON e.sequence = latest.event
      WHERE first.is_correction = 0)",
    // The documented view for the SQL of users; its columns must not change.
    R"(CREATE VIEW answers AS SELECT participant, trial, question, file_code, alternatives, choice AS answer,
        rating_tenths / 10.0 AS rating, ready_at, touched_at, answered_at, stored_at,
        (answered_at - COALESCE(touched_at, ready_at)) / 1e9 AS seconds, corrections, voided, wall_time, note
      FROM current_responses ORDER BY slot, trial, first_id)",
};

// Version 2. A slot becomes free when its participant withdraws. Facts about people stand outside the log, so that they can be
// erased. Fabric pieces have codes. The texts of a protocol may change in mid-study.
constexpr const char* secondTables[] = {
    "DROP VIEW IF EXISTS answers",
    "DROP VIEW IF EXISTS current_responses",
    R"(CREATE TABLE participants_now(
        id TEXT PRIMARY KEY, slot INTEGER NOT NULL REFERENCES slots(number),
        kind TEXT NOT NULL CHECK (kind IN ('human', 'scripted', 'simulated')),
        state TEXT NOT NULL CHECK (state IN ('started', 'finished', 'withdrawn')),
        protocol_version INTEGER NOT NULL DEFAULT 1) STRICT)",
    "INSERT INTO participants_now(id, slot, kind, state) SELECT id, slot, kind, state FROM participants",
    "DROP TABLE participants",
    "ALTER TABLE participants_now RENAME TO participants",
    "CREATE UNIQUE INDEX one_in_a_slot ON participants(slot) WHERE state <> 'withdrawn'",
    "ALTER TABLE responses ADD COLUMN %1",
    "ALTER TABLE notes ADD COLUMN is_flag INTEGER NOT NULL DEFAULT 0",
    R"(CREATE TABLE participant_facts(
        participant TEXT NOT NULL REFERENCES participants(id), fact TEXT NOT NULL, value TEXT NOT NULL,
        PRIMARY KEY (participant, fact)) STRICT, WITHOUT ROWID)",
    R"(CREATE TABLE swatches(
        slot INTEGER NOT NULL REFERENCES slots(number), fabric TEXT NOT NULL REFERENCES fabrics(id), code TEXT NOT NULL,
        PRIMARY KEY (slot, fabric)) STRICT, WITHOUT ROWID)",
    R"(CREATE TABLE familiarisation(
        position INTEGER PRIMARY KEY, name TEXT NOT NULL, file_code TEXT NOT NULL REFERENCES stimuli(file_code)) STRICT)",
    // Later versions of the protocol; version 1 is in the table study.
    R"(CREATE TABLE protocol_versions(
        version INTEGER PRIMARY KEY CHECK (version >= 2), event INTEGER NOT NULL REFERENCES events(sequence),
        json TEXT NOT NULL, sha256 TEXT NOT NULL, who TEXT NOT NULL, why TEXT NOT NULL, wall_time TEXT NOT NULL) STRICT)",
    R"(CREATE TABLE erasures(
        event INTEGER PRIMARY KEY REFERENCES events(sequence), participant TEXT NOT NULL, answers_too INTEGER NOT NULL,
        who TEXT NOT NULL, why TEXT NOT NULL, wall_time TEXT NOT NULL) STRICT)",
};

constexpr const char* appendOnlyTables[] = {"study",  "fabrics",   "stimuli", "slots", "trials",
                                            "events", "responses", "voids",   "notes", "unblindings"};
constexpr const char* laterAppendOnlyTables[] = {"swatches", "familiarisation", "protocol_versions", "erasures"};

/// `columns` stands for %1 in the statements.
void run(const SqliteConnection& connection, std::span<const char* const> statements, const QString& columns)
{
    for (const char* statement : statements) connection.run(QString::fromUtf8(statement).replace(QStringLiteral("%1"), columns));
}

void makeFirstVersion(const SqliteConnection& connection)
{
    run(connection, firstTables, definitionsSince(1));
    for (const char* table : appendOnlyTables) guardAgainstChanges(connection, table);
    connection.run(QStringLiteral("PRAGMA application_id = %1").arg(applicationId));
}

void makeSecondVersion(const SqliteConnection& connection)
{
    run(connection, secondTables, definitionsSince(2));
    run(connection, views, currentAnswerColumns());
    for (const char* table : laterAppendOnlyTables) guardAgainstChanges(connection, table);
}

/// Step i migrates from version i to version i + 1.
using MigrationStep = void (*)(const SqliteConnection&);
constexpr MigrationStep steps[] = {makeFirstVersion, makeSecondVersion};
static_assert(std::size(steps) == schemaVersion);

int versionOf(const SqliteConnection& connection) { return connection.value(QStringLiteral("PRAGMA user_version")).toInt(); }

}  // namespace

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

void migrate(const SqliteConnection& connection)
{
    for (int version = versionOf(connection); version < schemaVersion; ++version) {
        steps[version](connection);
        connection.run(QStringLiteral("PRAGMA user_version = %1").arg(version + 1));
    }
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
    return version;
}

}  // namespace database
