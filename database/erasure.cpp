#include "database/erasure.h"

#include <QSqlRecord>
#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "database/disk/payload_fields.h"
#include "database/disk/room_to_write.h"
#include "database/disk/study_upgrade.h"
#include "database/erasure_search.h"
#include "database/event_chain.h"
#include "database/rescue_files.h"
#include "database/schema.h"
#include "database/stored_texts.h"
#include "database/study_rows.h"
#include "protocols/files/byte_search.h"
#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"

namespace database {

namespace {

constexpr const char* emptiedTables[] = {"responses", "voids", "notes", "finger_samples", "events"};
constexpr std::size_t shortestText = 8;  // a shorter one may stand in a file by chance

std::vector<std::string> textsFrom(const SqliteConnection& sqlite, const char* select, const std::string& participant)
{
    std::vector<std::string> texts;
    QSqlQuery row = sqlite.run(QString::fromLatin1(select), {toQt(participant)});
    while (row.next()) texts.push_back(fromQt(row.value(0)));
    return texts;
}

/// Notes, reasons and readings, of which a part stands in the log alone.
void addTextsOf(const std::string& payload, const std::function<void(std::string)>& add)
{
    const nlohmann::json fields = payloadIn(payload);
    for (const char* field : {"text", "why"}) add(textIn(fields, field));
    if (const auto readings = fields.find("readings"); readings != fields.end() && readings->is_object())
        for (const auto& reading : *readings)
            if (reading.is_string()) add(reading.get<std::string>());
}

/// What the erasure removes, as texts: facts, and with the answers also notes, words and salts. `shortOnes`: others that are too
/// short for a search.
std::set<std::string> textsToRemove(const SqliteConnection& sqlite, const Erasure& erasure, std::set<std::string>& shortOnes)
{
    struct Source {
        const char* select;
        bool isAnswer;
    };
    constexpr Source sources[] = {
        {"SELECT value FROM participant_facts WHERE participant = ?", false},
        {"SELECT salt FROM participant_facts WHERE participant = ?", false},
        {"SELECT text FROM notes WHERE participant = ?", true},
        {"SELECT choice FROM responses WHERE participant = ? AND choice IS NOT NULL", true},
        // A long text lies in several pages of the file, and its beginning in one.
        {"SELECT substr(samples, 1, 64) FROM finger_samples WHERE participant = ?", true},
        {"SELECT salt FROM events WHERE participant = ?", true},
    };
    std::set<std::string> texts;
    const auto add = [&](std::string text) { (text.size() < shortestText ? shortOnes : texts).insert(std::move(text)); };
    if (erasure.answersToo)
        for (const std::string& payload :
             textsFrom(sqlite, "SELECT payload FROM events WHERE participant = ?", erasure.participant.value))
            addTextsOf(payload, add);
    for (const Source& source : sources) {
        if (source.isAnswer && !erasure.answersToo) continue;
        for (std::string& text : textsFrom(sqlite, source.select, erasure.participant.value)) add(std::move(text));
    }
    shortOnes.erase("");
    return texts;
}

/// Calls `give` with each text that the study holds, but for rows of the participant that the erasure empties.
void giveTexts(const SqliteConnection& sqlite, const Erasure& erasure, const std::function<void(const std::string&)>& give)
{
    std::vector<QString> tables{QStringLiteral("sqlite_master")};
    QSqlQuery table = sqlite.run(QStringLiteral("SELECT name FROM sqlite_master WHERE type = 'table'"));
    while (table.next()) tables.push_back(table.value(0).toString());
    for (QString& name : tables) {
        const auto isName = [&](const char* one) { return name == QLatin1String(one); };
        const bool isEmptied = isName("participant_facts") || (erasure.answersToo && std::ranges::any_of(emptiedTables, isName));
        QSqlQuery row = sqlite.run(QStringLiteral("SELECT * FROM \"%1\"").arg(name.replace('"', QLatin1String("\"\""))));
        const int columns = row.record().count(), owner = row.record().indexOf(QStringLiteral("participant"));
        while (row.next()) {
            if (isEmptied && owner >= 0 && fromQt(row.value(owner)) == erasure.participant.value) continue;
            for (int column = 0; column < columns; ++column)
                if (const QVariant value = row.value(column); value.typeId() == QMetaType::QString) give(fromQt(value));
        }
    }
}

std::set<std::string> foundInStudy(const SqliteConnection& sqlite, const Erasure& erasure,
                                   const std::vector<std::string>& sequences)
{
    const protocols::ByteSequences wanted(sequences);
    std::set<std::string> found;
    giveTexts(sqlite, erasure, [&](const std::string& value) {
        wanted.findIn(value, [&](const std::string& sequence) {
            found.insert(sequence);
            return true;
        });
    });
    return found;
}

/// Parts of a text that the search compares, from its beginning to its end.
std::vector<std::string> partsOf(const std::string& text)
{
    constexpr std::size_t step = 8;
    if (text.size() <= protocols::comparedBytes) return {text};
    std::vector<std::string> parts;
    const std::size_t last = text.size() - protocols::comparedBytes;
    for (std::size_t from = 0; from < last; from += step) parts.push_back(text.substr(from, protocols::comparedBytes));
    parts.push_back(text.substr(last));
    return parts;
}

struct Traces {
    std::vector<std::string> sequences;  ///< what to search for: of each text a part that the study does not hold
    std::size_t shared = 0;              ///< texts without such a part
};

/// Other people may have given the same words, and the protocol or the reason of the erasure may hold them. A file with such
/// words proves nothing.
Traces tracesOf(const SqliteConnection& sqlite, const Erasure& erasure, const std::set<std::string>& texts)
{
    const std::set<std::string> begunAlike = foundInStudy(sqlite, erasure, {texts.begin(), texts.end()});
    std::vector<std::string> parts;
    for (const std::string& text : begunAlike) std::ranges::copy(partsOf(text), std::back_inserter(parts));
    const std::set<std::string> held = foundInStudy(sqlite, erasure, parts);
    Traces traces;
    for (const std::string& text : texts) {
        const auto own = begunAlike.contains(text) ? partsOf(text) : std::vector{text};
        const auto part = std::ranges::find_if(own, [&](const std::string& one) { return !held.contains(one); });
        const bool isInProtocols = text == "different";  // every protocol with such a question names it
        if (part == own.end() || isInProtocols)
            ++traces.shared;
        else
            traces.sequences.push_back(*part);
    }
    return traces;
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

/// Erasures of this participant that were recorded, and ended before they or a later one had a certificate. Those of versions
/// without certificates are not meant.
std::vector<std::int64_t> interruptedErasures(const SqliteConnection& sqlite, const std::string& participant)
{
    std::vector<std::int64_t> open;
    std::int64_t lastCertain =
        sqlite.value(QStringLiteral("SELECT MAX(sequence) FROM events WHERE kind = ?"), {toQt(upgradedKind)}).toLongLong();
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT event FROM erasures WHERE participant = ? ORDER BY event"), {toQt(participant)});
    while (row.next()) open.push_back(row.value(0).toLongLong());
    row = sqlite.run(QStringLiteral("SELECT payload FROM events WHERE kind = ? AND participant = ''"), {toQt(certifiedKind)});
    while (row.next()) {
        const std::int64_t certified = numberIn(payloadIn(fromQt(row.value(0))), "erasure", 0);
        if (std::ranges::find(open, certified) != open.end()) lastCertain = std::max(lastCertain, certified);
    }
    std::erase_if(open, [&](std::int64_t erasure) { return erasure <= lastCertain; });
    return open;
}

/// What the steps after the removal need. The removal cannot be taken back, and what was removed can no longer be searched for
/// later.
void requireRoom(const std::filesystem::path& database)
{
    protocols::makeFolders(certificatesFolder({database.parent_path()}));
    protocols::requireWritable(certificateFile({database.parent_path()}, 0));
    requireRoomToWriteAnew(database);
}

void writeAnew(const SqliteConnection& sqlite)
{
    try {
        sqlite.run(QStringLiteral("VACUUM"));
    } catch (const protocols::Error& fault) {
        throw protocols::environmentFault(
            {std::string("the data are removed, but the database could not be written anew: ") + fault.what(), sqlite.folder(),
             "room for another copy of the database", "make room and run the command again, which completes the erasure"});
    }
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
    requireRoom(sqlite.file());
    requireSearchable(sqlite.file().parent_path());
    ErasureRecord record;
    record.interrupted = interruptedErasures(sqlite, erasure.participant.value);
    std::set<std::string> shortOnes;
    const std::set<std::string> texts = textsToRemove(sqlite, erasure, shortOnes);
    record.shortTexts = shortOnes.size();
    // SQLite overwrites what it frees; VACUUM then writes every page anew.
    sqlite.run(QStringLiteral("PRAGMA secure_delete = ON"));
    removeFromTables(sqlite, erasure, record);
    writeAnew(sqlite);
    if (!logIsEmptied(sqlite))
        throw protocols::environmentFault({"the data are removed, but another program keeps an older state of the study", folder,
                                           "no open monitor, report or database browser",
                                           "close it and run the command again, which completes the erasure"});
    const Traces traces = tracesOf(sqlite, erasure, texts);
    record.sharedTexts = traces.shared;
    const StudyFolder study{sqlite.file().parent_path()};
    const protocols::ByteSearch search = searchFiles(sqlite, study, traces.sequences);
    record.searchedFiles = search.files;
    record.searchedTexts = traces.sequences.size();
    for (const std::string& name : search.unread) record.unread.push_back(protocols::printable(name));
    // Numbers and times are too short for the search, so that copies of the database count as found by their rows.
    std::vector<std::string> names = search.found;
    std::ranges::copy(copiesBeforeUpgradeOf(erasure.participant.value, study), std::back_inserter(names));
    const bool answersToo = erasure.answersToo || !record.interrupted.empty();
    std::ranges::copy(databasesAbout(erasure.participant.value, answersToo, study), std::back_inserter(names));
    for (const std::string& name : names) addFound(foundFile(name, texts, study), record);
    for (const FoundFile& file : stillThere(filesInCertificates(sqlite, erasure.participant.value), erasure, study))
        addFound(file, record);
    return record;
}

void recordCertificate(const StudyStore& store, const ErasureRecord& record, const std::string& sha256)
{
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Write);
    nlohmann::ordered_json payload{{"erasure", record.event}, {"sha256", sha256}};
    for (const FoundFile& file : record.foundFiles) {
        nlohmann::ordered_json entry{{"bytes", file.bytes}, {"sha256", file.sha256}};
        if (!file.name.empty()) entry["name"] = file.name;
        payload[foundField].push_back(entry);
    }
    Transaction transaction(sqlite);
    database::store(sqlite, actOnStudy(certifiedKind, payload, wallTimeNow()));
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
