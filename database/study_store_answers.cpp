// Reading back what a session stored.
#include "database/store_connection.h"
#include "database/study_store.h"

namespace database {

namespace {

CurrentAnswer answerOf(const QSqlQuery& row)
{
    CurrentAnswer answer;
    AnswerRecord& record = answer.record;
    answer.participant = protocols::ParticipantId(fromQt(row.value(0)));
    record.trial = {row.value(1).toInt()};
    answer.attempt = row.value(2).toInt();
    record.question = protocols::QuestionId(fromQt(row.value(3)));
    record.fileCode = protocols::FileCode(fromQt(row.value(4)));
    record.alternatives = fabricsOf(fromQt(row.value(5)));
    if (!row.value(6).isNull()) record.answer = fromQt(row.value(6));
    if (!row.value(7).isNull()) record.rating = protocols::Tenths{row.value(7).toInt()};
    record.readyAtNs = row.value(8).toLongLong();
    if (!row.value(9).isNull()) record.touchedAtNs = row.value(9).toLongLong();
    record.answeredAtNs = row.value(10).toLongLong();
    answer.storedAtNs = row.value(11).toLongLong();
    answer.corrections = row.value(12).toInt();
    record.isCorrection = answer.corrections > 0;
    answer.voided = row.value(13).toInt() != 0;
    answer.wallTime = fromQt(row.value(14));
    record.note = fromQt(row.value(15));
    record.touchedBy = fromQt(row.value(16));
    answer.event = row.value(17).toLongLong();
    answer.seconds = static_cast<double>(record.answeredAtNs - record.touchedAtNs.value_or(record.readyAtNs)) / 1e9;
    return answer;
}

}  // namespace

std::vector<EventRecord> StudyStore::events(const protocols::ParticipantId& participant) const
{
    std::vector<EventRecord> events;
    QSqlQuery row = m_connection->sqlite.run(
        QStringLiteral(
            "SELECT sequence, sitting, kind, payload, at_ns, wall_time FROM events WHERE participant = ? ORDER BY sequence"),
        {toQt(participant.value)});
    while (row.next())
        events.push_back({row.value(0).toLongLong(), participant, row.value(1).toInt(), fromQt(row.value(2)),
                          fromQt(row.value(3)), row.value(4).toLongLong(), fromQt(row.value(5))});
    return events;
}

std::vector<CurrentAnswer> StudyStore::answers() const
{
    std::vector<CurrentAnswer> answers;
    QSqlQuery row = m_connection->sqlite.run(QStringLiteral(
        "SELECT participant, trial, attempt, question, file_code, alternatives, choice, rating_tenths, ready_at, touched_at, "
        "answered_at, stored_at, corrections, voided, wall_time, note, touched_by, event FROM current_responses ORDER BY slot, "
        "trial, first_id"));
    while (row.next()) answers.push_back(answerOf(row));
    return answers;
}

std::vector<StudyStore::Flag> StudyStore::flags() const
{
    std::vector<Flag> flags;
    QSqlQuery row =
        m_connection->sqlite.run(QStringLiteral("SELECT participant, trial, text FROM notes WHERE is_flag = 1 ORDER BY id"));
    while (row.next())
        flags.push_back({protocols::ParticipantId(fromQt(row.value(0))), {row.value(1).toInt()}, fromQt(row.value(2))});
    return flags;
}

int StudyStore::synchronousMode() const { return m_connection->sqlite.value(QStringLiteral("PRAGMA synchronous")).toInt(); }

}  // namespace database
