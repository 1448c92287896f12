#include "database/erasure.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/payload_fields.h"
#include "database/event_chain.h"
#include "database/rescue.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "database/study_rows.h"
#include "database/study_upgrade.h"
#include "protocols/files/byte_search.h"
#include "protocols/files/errors.h"

namespace database {

namespace {

constexpr const char* emptiedTables[] = {"responses", "voids", "notes", "finger_samples", "events"};
constexpr const char* certifiedKind = "certified";
constexpr std::size_t shortestText = 8;  // a shorter one may stand in a file by chance

std::vector<std::string> textsFrom(const SqliteConnection& sqlite, const char* select, const std::string& participant)
{
    std::vector<std::string> texts;
    QSqlQuery row = sqlite.run(QString::fromLatin1(select), {toQt(participant)});
    while (row.next()) texts.push_back(fromQt(row.value(0)));
    return texts;
}

/// Texts that only this participant's data hold: their facts, and with the answers also notes, words and salts.
std::set<std::string> textsOnlyOf(const SqliteConnection& sqlite, const Erasure& erasure)
{
    struct Source {
        const char* own;
        const char* others;
        bool isAnswer;
    };
    constexpr Source sources[] = {
        {"SELECT value FROM participant_facts WHERE participant = ?",
         "SELECT value FROM participant_facts WHERE participant <> ?", false},
        {"SELECT salt FROM participant_facts WHERE participant = ?", "SELECT salt FROM participant_facts WHERE participant <> ?",
         false},
        {"SELECT text FROM notes WHERE participant = ?", "SELECT text FROM notes WHERE participant <> ?", true},
        {"SELECT choice FROM responses WHERE participant = ? AND choice IS NOT NULL",
         "SELECT choice FROM responses WHERE participant <> ? AND choice IS NOT NULL", true},
        // A long text lies in several pages of the file, and its beginning in one.
        {"SELECT substr(samples, 1, 64) FROM finger_samples WHERE participant = ?",
         "SELECT substr(samples, 1, 64) FROM finger_samples WHERE participant <> ?", true},
        {"SELECT salt FROM events WHERE participant = ?", "SELECT salt FROM events WHERE participant <> ?", true},
    };
    std::set<std::string> only;
    for (const Source& source : sources) {
        if (source.isAnswer && !erasure.answersToo) continue;
        for (std::string& text : textsFrom(sqlite, source.own, erasure.participant.value))
            if (text.size() >= shortestText) only.insert(std::move(text));
    }
    for (const Source& source : sources)
        for (const std::string& text : textsFrom(sqlite, source.others, erasure.participant.value)) only.erase(text);
    for (const protocols::FabricId& fabric : factsIn(sqlite).fabrics) only.erase(fabric.value);
    only.erase("different");  // an answer that every protocol with such a question names, too
    return only;
}

int removed(const SqliteConnection& sqlite, const char* table, const std::string& participant)
{
    return sqlite.run(QStringLiteral("DELETE FROM %1 WHERE participant = ?").arg(QLatin1String(table)), {toQt(participant)})
        .numRowsAffected();
}

void removeAnswers(const SqliteConnection& sqlite, const std::string& participant, ErasureRecord& record)
{
    for (const char* table : emptiedTables) unguard(sqlite, table);
    record.answers = removed(sqlite, "responses", participant);
    record.notes = removed(sqlite, "notes", participant);
    record.fingerSamples =
        sqlite.value(QStringLiteral("SELECT TOTAL(count) FROM finger_samples WHERE participant = ?"), {toQt(participant)})
            .toLongLong();
    removed(sqlite, "finger_samples", participant);
    removed(sqlite, "voids", participant);
    sqlite.run(QStringLiteral("UPDATE events SET payload = '{}', at_ns = 0, wall_time = '', salt = '' WHERE participant = ?"),
               {toQt(participant)});
    for (const char* table : emptiedTables) guardAgainstChanges(sqlite, table);
    sqlite.run(QStringLiteral("UPDATE participants SET state = 'withdrawn' WHERE id = ?"), {toQt(participant)});
}

/// Writes one page as it is. A reader who began with an empty log reads the database file itself, which hinders emptying the log
/// only where the log holds something.
void touchLog(const SqliteConnection& sqlite)
{
    const int version = sqlite.value(QStringLiteral("PRAGMA user_version")).toInt();
    sqlite.run(QStringLiteral("PRAGMA user_version = %1").arg(version));
}

/// Copies the write-ahead log into the database and empties it; false while another connection reads an older state.
bool logIsEmptied(const SqliteConnection& sqlite)
{
    QSqlQuery row = sqlite.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
    return row.next() && row.value(0).toInt() == 0;
}

void removeFromTables(const SqliteConnection& sqlite, const Erasure& erasure, ErasureRecord& record)
{
    const std::string& id = erasure.participant.value;
    Transaction transaction(sqlite);
    record.facts = removed(sqlite, "participant_facts", id);
    if (erasure.answersToo) removeAnswers(sqlite, id, record);
    record.wallTime = wallTimeNow();
    record.event = store(
        sqlite, actOnStudy("erased",
                           {{"participant", id}, {"answers_too", erasure.answersToo}, {"who", erasure.who}, {"why", erasure.why}},
                           record.wallTime));
    sqlite.run(
        QStringLiteral("INSERT INTO erasures(event, participant, answers_too, who, why, wall_time) VALUES (?, ?, ?, ?, ?, ?)"),
        {qlonglong(record.event), toQt(id), int(erasure.answersToo), toQt(erasure.who), toQt(erasure.why),
         toQt(record.wallTime)});
    transaction.commit();
}

}  // namespace

ErasureRecord eraseFrom(const SqliteConnection& sqlite, const Erasure& erasure)
{
    const std::string folder = sqlite.folder();
    if (erasure.who.empty() || erasure.why.empty())
        throw protocols::badInput({"an erasure needs a name and a reason", folder, "--who NAME --why TEXT", "add both"});
    if (sqlite.value(QStringLiteral("SELECT COUNT(*) FROM participants WHERE id = ?"), {toQt(erasure.participant.value)})
            .toInt() == 0)
        throw protocols::badInput(
            {"unknown participant " + erasure.participant.value, folder, "an enrolled participant", "see vis2hap study status"});
    touchLog(sqlite);
    if (!logIsEmptied(sqlite))
        throw protocols::environmentFault({"another program reads the study, so the data would stay in its files", folder,
                                           "no open monitor, report or database browser",
                                           "close it and run the command again; nothing was erased"});
    ErasureRecord record;
    const std::set<std::string> texts = textsOnlyOf(sqlite, erasure);
    // SQLite overwrites what it frees; VACUUM then writes every page anew.
    sqlite.run(QStringLiteral("PRAGMA secure_delete = ON"));
    removeFromTables(sqlite, erasure, record);
    sqlite.run(QStringLiteral("VACUUM"));
    if (!logIsEmptied(sqlite))
        throw protocols::environmentFault({"the data are removed, but another program keeps an older state of the study", folder,
                                           "no open monitor, report or database browser",
                                           "close it and run the command again, which completes the erasure"});
    const protocols::ByteSearch search = protocols::searchFiles(sqlite.file().parent_path(), {texts.begin(), texts.end()},
                                                                rescueFilesOutside({sqlite.file().parent_path()}));
    record.searchedFiles = search.files;
    record.searchedTexts = texts.size();
    record.found = search.found;
    // Numbers and times are too short for the search, so that a copy of the older study counts as found.
    for (const std::string& copy : copiesBeforeUpgradeOf(erasure.participant.value, {sqlite.file().parent_path()}))
        if (std::ranges::find(record.found, copy) == record.found.end()) record.found.push_back(copy);
    return record;
}

void recordCertificate(const StudyStore& store, std::int64_t erasure, const std::string& sha256)
{
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Write);
    Transaction transaction(sqlite);
    database::store(sqlite, actOnStudy(certifiedKind, {{"erasure", erasure}, {"sha256", sha256}}, wallTimeNow()));
    transaction.commit();
}

std::map<std::int64_t, std::string> certificatesOf(const StudyStore& store)
{
    std::map<std::int64_t, std::string> hashes;
    for (const EventRecord& event : store.eventsOfKind(certifiedKind)) {
        const nlohmann::json payload = payloadIn(event.payloadJson);
        // A later entry must not replace the hash: whoever can write the file could add one.
        if (event.participant.empty()) hashes.emplace(numberIn(payload, "erasure", 0), textIn(payload, "sha256"));
    }
    return hashes;
}

std::filesystem::path certificatesFolder(const StudyFolder& folder) { return folder.folder / "erasures"; }

std::filesystem::path certificateFile(const StudyFolder& folder, std::int64_t erasure)
{
    return certificatesFolder(folder) / ("erasure-" + std::to_string(erasure) + ".txt");
}

}  // namespace database
