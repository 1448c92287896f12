#include "database/erasure.h"

#include <nlohmann/json.hpp>

#include "database/event_chain.h"
#include "database/schema.h"
#include "database/stored_texts.h"
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

void eraseFrom(const SqliteConnection& sqlite, const Erasure& erasure)
{
    const std::string folder = sqlite.file().parent_path().string();
    if (erasure.who.empty() || erasure.why.empty())
        throw protocols::badInput({"an erasure needs a name and a reason", folder, "--who NAME --why TEXT", "add both"});
    const std::string& id = erasure.participant.value;
    // SQLite overwrites freed pages then, so that the file keeps none of the data.
    sqlite.run(QStringLiteral("PRAGMA secure_delete = ON"));
    {
        Transaction transaction(sqlite);
        if (sqlite.value(QStringLiteral("SELECT COUNT(*) FROM participants WHERE id = ?"), {toQt(id)}).toInt() == 0)
            throw protocols::badInput(
                {"unknown participant " + id, folder, "an enrolled participant", "see vis2hap study status"});
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

}  // namespace database
