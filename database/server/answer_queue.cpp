#include "database/server/answer_queue.h"

#include <exception>
#include <filesystem>

namespace database {

namespace {

constexpr std::size_t digitsOfHash = 64;
constexpr std::size_t longestCode = 64;  ///< bytes of a participant's code

bool isSoundHash(const std::string& text)
{
    return text.size() == digitsOfHash && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool isSoundMemory(const SeenLog& seen)
{
    const auto& [sequence, hash] = seen.head;
    return sequence >= 0 && (sequence == 0 ? hash.empty() : isSoundHash(hash)) &&
           (!seen.lostAfter || (*seen.lostAfter >= 0 && *seen.lostAfter < sequence));
}

}  // namespace

AnswerQueue::AnswerQueue(const StudyFolder& folder)
    : m_file(folder.queue(),
             std::filesystem::exists(folder.queue()) ? SqliteConnection::Mode::Write : SqliteConnection::Mode::Create)
{
    m_file.run(
        QStringLiteral("CREATE TABLE IF NOT EXISTS entries(number INTEGER PRIMARY KEY AUTOINCREMENT, participant TEXT NOT NULL, "
                       "kind TEXT NOT NULL, json TEXT NOT NULL) STRICT"));
    m_file.run(
        QStringLiteral("CREATE TABLE IF NOT EXISTS seen(id INTEGER PRIMARY KEY CHECK (id = 1), study TEXT NOT NULL, "
                       "sequence INTEGER NOT NULL, hash TEXT NOT NULL, lost_after INTEGER) STRICT"));
    m_file.run(QStringLiteral("CREATE TABLE IF NOT EXISTS enrolled(participant TEXT PRIMARY KEY) STRICT"));
    m_file.run(QStringLiteral("PRAGMA secure_delete = ON"));  // an answer that was sent leaves no trace on the station
}

void AnswerQueue::put(const Entry& entry)
{
    waitForDisk();
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
    waitForDisk();
    {
        Transaction transaction(m_file);
        m_file.run(QStringLiteral("DELETE FROM entries WHERE number = ?"), {qlonglong(number)});
        transaction.commit();
    }
    if (size() == 0) m_file.value(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
}

std::size_t AnswerQueue::size() const { return m_file.value(QStringLiteral("SELECT COUNT(*) FROM entries")).toULongLong(); }

SeenLog AnswerQueue::seenOf(const std::string& study)
{
    {
        QSqlQuery row = m_file.run(QStringLiteral("SELECT study, sequence, hash, lost_after FROM seen WHERE id = 1"));
        if (row.next() && fromQt(row.value(0)) == study) {
            SeenLog seen{study, {row.value(1).toLongLong(), fromQt(row.value(2))}, {}};
            if (!row.value(3).isNull()) seen.lostAfter = row.value(3).toLongLong();
            return isSoundMemory(seen) ? seen : SeenLog{study, {}, {}};
        }
    }
    keep(QStringLiteral("DELETE FROM seen"), {});
    keep(QStringLiteral("DELETE FROM enrolled"), {});
    return {study, {}, {}};
}

std::set<std::string> AnswerQueue::enrolledHere() const
{
    std::set<std::string> codes;
    QSqlQuery row = m_file.run(QStringLiteral("SELECT participant FROM enrolled"));
    while (row.next())
        if (const std::string code = fromQt(row.value(0)); code.size() <= longestCode) codes.insert(code);
    return codes;
}

void AnswerQueue::keepSeen(const SeenLog& seen)
{
    if (!isSoundMemory(seen)) return;
    keep(QStringLiteral("INSERT OR REPLACE INTO seen(id, study, sequence, hash, lost_after) VALUES (1, ?, ?, ?, ?)"),
         {toQt(seen.study), qlonglong(seen.head.sequence), toQt(seen.head.hash),
          seen.lostAfter ? QVariant(qlonglong(*seen.lostAfter)) : QVariant()});
}

void AnswerQueue::keepEnrolled(const std::string& participant)
{
    keep(QStringLiteral("INSERT OR IGNORE INTO enrolled(participant) VALUES (?)"), {toQt(participant)});
}

/// A commit with synchronous NORMAL waits for no disk, so it costs an answer some microseconds. Entries keep FULL. The answer may
/// be on the server already, so nothing here may throw.
void AnswerQueue::keep(const QString& sql, const QVariantList& values)
{
    m_waitsForDisk = false;
    try {
        m_file.run(QStringLiteral("PRAGMA synchronous = NORMAL"));
        m_file.run(sql, values);
    } catch (const std::exception&) {
        // An older memory is better than an answer that fails.
    }
    try {
        waitForDisk();
    } catch (const std::exception&) {
        // The next entry asks for it again, and is refused where that fails.
    }
}

void AnswerQueue::waitForDisk()
{
    if (m_waitsForDisk) return;
    m_file.run(QStringLiteral("PRAGMA synchronous = FULL"));
    m_waitsForDisk = true;
}

}  // namespace database
