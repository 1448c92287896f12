// Taking out what is known about a participant, without breaking the log: an erased entry keeps its hash
// and its place in the chain, and the act says whose entries were emptied and up to which.
#include "database/event_chain.h"

#include <nlohmann/json.hpp>
#include "database/schema.h"
#include "database/store_connection.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

constexpr const char* emptiedTables[] = {"responses", "voids", "notes", "events"};

void removeAnswers(const SqliteConnection& sqlite, const std::string& participant)
{
    for (const char* table : emptiedTables) unguard(sqlite, table);
    for (const char* table : {"responses", "voids", "notes"})
        sqlite.run(QStringLiteral("DELETE FROM %1 WHERE participant = ?").arg(QLatin1String(table)), {toQt(participant)});
    sqlite.run(QStringLiteral("UPDATE events SET payload = '{}' WHERE participant = ?"), {toQt(participant)});
    for (const char* table : emptiedTables) guardAgainstChanges(sqlite, table);
    sqlite.run(QStringLiteral("UPDATE participants SET state = 'withdrawn' WHERE id = ?"), {toQt(participant)});
}

}  // namespace

void StudyStore::erase(const Erasure& erasure)
{
    if (erasure.who.empty() || erasure.why.empty())
        throw protocols::badInput(
            {"an erasure needs a name and a reason", folder().folder.string(), "--who NAME --why TEXT", ""});
    const SqliteConnection& sqlite = m_connection->sqlite;
    const std::string& id = erasure.participant.value;
    // Freed pages are overwritten, so that nothing of it stays in the file.
    sqlite.run(QStringLiteral("PRAGMA secure_delete = ON"));
    {
        Transaction transaction(sqlite);
        if (sqlite.value(QStringLiteral("SELECT COUNT(*) FROM participants WHERE id = ?"), {toQt(id)}).toInt() == 0)
            throw protocols::badInput(
                {"no participant " + id, folder().folder.string(), "one who is enrolled", "see vis2hap study status"});
        sqlite.run(QStringLiteral("DELETE FROM participant_facts WHERE participant = ?"), {toQt(id)});
        if (erasure.answersToo) removeAnswers(sqlite, id);
        const std::string wallTime = wallTimeNow();
        const std::int64_t event = store(
            sqlite,
            actOnStudy("erased",
                       {{"participant", id}, {"answers_too", erasure.answersToo}, {"who", erasure.who}, {"why", erasure.why}},
                       wallTime));
        sqlite.run(QStringLiteral(
                       "INSERT INTO erasures(event, participant, answers_too, who, why, wall_time) VALUES (?, ?, ?, ?, ?, ?)"),
                   {qlonglong(event), toQt(id), int(erasure.answersToo), toQt(erasure.who), toQt(erasure.why), toQt(wallTime)});
        transaction.commit();
    }
    sqlite.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
}

std::vector<Erasure> StudyStore::erasures() const
{
    std::vector<Erasure> erasures;
    QSqlQuery row = m_connection->sqlite.run(
        QStringLiteral("SELECT participant, answers_too, who, why, wall_time FROM erasures ORDER BY event"));
    while (row.next())
        erasures.push_back({protocols::ParticipantId(fromQt(row.value(0))), row.value(1).toInt() != 0, fromQt(row.value(2)),
                            fromQt(row.value(3)), fromQt(row.value(4))});
    return erasures;
}

std::map<protocols::ParticipantId, std::map<std::string, std::string>> StudyStore::personalFacts() const
{
    std::map<protocols::ParticipantId, std::map<std::string, std::string>> facts;
    QSqlQuery row = m_connection->sqlite.run(QStringLiteral("SELECT participant, fact, value FROM participant_facts"));
    while (row.next()) facts[protocols::ParticipantId(fromQt(row.value(0)))][fromQt(row.value(1))] = fromQt(row.value(2));
    return facts;
}

void StudyStore::copyTo(const std::filesystem::path& file) const
{
    if (std::filesystem::exists(file))
        throw protocols::badInput({"the file exists", file.string(), "a new file", "choose another name"});
    m_connection->sqlite.run(QStringLiteral("VACUUM INTO ?"), {toQt(file.string())});
}

}  // namespace database
