#include "database/server/answer_queue.h"

#include <filesystem>

namespace database {

AnswerQueue::AnswerQueue(const StudyFolder& folder)
    : m_file(folder.queue(),
             std::filesystem::exists(folder.queue()) ? SqliteConnection::Mode::Write : SqliteConnection::Mode::Create)
{
    m_file.run(
        QStringLiteral("CREATE TABLE IF NOT EXISTS entries(number INTEGER PRIMARY KEY AUTOINCREMENT, participant TEXT NOT NULL, "
                       "kind TEXT NOT NULL, json TEXT NOT NULL) STRICT"));
    m_file.run(QStringLiteral("PRAGMA secure_delete = ON"));  // an answer that was sent leaves no trace on the station
}

void AnswerQueue::put(const Entry& entry)
{
    Transaction transaction(m_file);
    m_file.run(QStringLiteral("INSERT INTO entries(participant, kind, json) VALUES (?, ?, ?)"),
               {toQt(entry.participant), toQt(entry.kind), toQt(entry.json)});
    transaction.commit();
}

std::optional<AnswerQueue::Entry> AnswerQueue::first() const
{
    QSqlQuery row = m_file.run(QStringLiteral("SELECT number, participant, kind, json FROM entries ORDER BY number LIMIT 1"));
    if (!row.next()) return std::nullopt;
    return Entry{row.value(0).toLongLong(), fromQt(row.value(1)), fromQt(row.value(2)), fromQt(row.value(3))};
}

void AnswerQueue::remove(std::int64_t number)
{
    {
        Transaction transaction(m_file);
        m_file.run(QStringLiteral("DELETE FROM entries WHERE number = ?"), {qlonglong(number)});
        transaction.commit();
    }
    if (size() == 0) m_file.value(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
}

std::size_t AnswerQueue::size() const { return m_file.value(QStringLiteral("SELECT COUNT(*) FROM entries")).toULongLong(); }

}  // namespace database
