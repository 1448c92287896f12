#include "database/evidence/clear_log.h"

#include "database/response_columns.h"
#include "database/sqlite_connection.h"
#include "database/stored_texts.h"
#include "database/study_rows.h"

namespace database {

LogHead eachClearEntry(const StudyStore& store, const std::function<void(const ClearEntry&)>& take)
{
    const SqliteConnection& sqlite = store.connection();
    const ReadSnapshot snapshot(sqlite);
    LogHead head;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT sequence, participant, sitting, kind, wall_time, places, commitment, "
                                  "previous_hash, hash FROM events ORDER BY sequence"));
    while (row.next()) {
        const ClearEntry entry{row.value(0).toLongLong(), fromQt(row.value(1)), row.value(2).toInt(),
                               fromQt(row.value(3)),      fromQt(row.value(4)), fromQt(row.value(5)),
                               fromQt(row.value(6)),      fromQt(row.value(7)), fromQt(row.value(8))};
        take(entry);
        head = {entry.sequence, entry.hash};
    }
    return head;
}

std::vector<LoggedAnswer> answersGivenBy(const StudyStore& store, const protocols::ParticipantId& participant)
{
    const SqliteConnection& sqlite = store.connection();
    std::vector<LoggedAnswer> answers;
    QSqlQuery row = sqlite.run(
        QStringLiteral("SELECT event, (SELECT e.sitting FROM events e WHERE e.sequence = event), "
                       "(SELECT e.wall_time FROM events e WHERE e.sequence = event), "
                       "EXISTS (SELECT 1 FROM voids v WHERE v.participant = responses.participant AND v.trial = responses.trial "
                       "AND v.attempt = responses.attempt), %1 FROM responses WHERE participant = ? ORDER BY id")
            .arg(namesOf(ResponseColumns::OfTable)),
        {toQt(participant.value)});
    while (row.next()) {
        const ResponseRow stored = rowFrom(row, ResponseColumns::OfTable, 4);
        answers.push_back({row.value(0).toLongLong(), row.value(1).toInt(), stored.attempt, row.value(3).toInt() != 0,
                           fromQt(row.value(2)), responseSecondsOf(stored),
                           answerRecordOf(stored, fabricsOf(stored.alternatives))});
    }
    return answers;
}

std::vector<LoggedNote> notesAbout(const StudyStore& store, const protocols::ParticipantId& participant)
{
    const SqliteConnection& sqlite = store.connection();
    std::vector<LoggedNote> notes;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT event, trial, attempt, question, text, is_flag, (SELECT e.wall_time FROM "
                                              "events e WHERE e.sequence = event) FROM notes WHERE participant = ? ORDER BY id"),
                               {toQt(participant.value)});
    while (row.next())
        notes.push_back({row.value(0).toLongLong(), row.value(1).toInt(), row.value(2).toInt(), fromQt(row.value(3)),
                         fromQt(row.value(4)), row.value(5).toInt() != 0, fromQt(row.value(6))});
    return notes;
}

}  // namespace database
