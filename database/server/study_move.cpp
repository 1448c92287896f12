#include "database/server/study_move.h"

#include <functional>
#include <nlohmann/json.hpp>
#include <system_error>

#include "database/audit.h"
#include "database/disk/server_note.h"
#include "database/disk/station_key.h"
#include "database/disk/write_lock.h"
#include "database/server/held_log.h"
#include "database/server/server_connection.h"
#include "database/server/server_scripts.h"
#include "database/server/table_rows.h"
#include "database/stored_texts.h"
#include "database/study_creation.h"
#include "database/study_rows.h"
#include "protocols/files/errors.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/temporary_folder.h"
#include "protocols/files/whole_file.h"
#include "protocols/protocol_json.h"
#include "protocols/records/sealed_stimulus.h"
#include "protocols/secrets/sealing.h"

namespace database {

namespace {

namespace fs = std::filesystem;

constexpr int serverFormat = 1;

bool hasStudy(const ServerConnection& server)
{
    return server
               .value(QStringLiteral("SELECT COUNT(*) FROM pg_namespace WHERE nspname = ?"),
                      {QStringLiteral("vis2hap_%1").arg(toQt(server.address().study))})
               .toInt() > 0;
}

std::string stateOf(const ServerConnection& server)
{
    return fromQt(server.value(QStringLiteral("SELECT state FROM @schema@.server_study")));
}

/// Logins that hold locks on the study's tables, with the number of the process and the name of the program.
std::string loginsAtWork(const ServerConnection& server)
{
    return fromQt(server.value(
        QStringLiteral("SELECT string_agg(DISTINCT concat(coalesce(a.usename, 'a login that is not shown'), ' (process ', l.pid, "
                       "nullif(', ' || a.application_name, ', '), ')'), ', ') "
                       "FROM pg_locks l LEFT JOIN pg_stat_activity a ON a.pid = l.pid "
                       "WHERE l.granted AND l.pid <> pg_backend_pid() AND l.relation IN (SELECT c.oid FROM pg_class c JOIN "
                       "pg_namespace n ON n.oid = c.relnamespace WHERE n.nspname = ?) AND l.database = "
                       "(SELECT d.oid FROM pg_database d WHERE d.datname = current_database())"),
        {QStringLiteral("vis2hap_%1").arg(toQt(server.address().study))}));
}

protocols::Error studyIsInUse(const ServerConnection& server)
{
    const std::string logins = loginsAtWork(server);
    return protocols::environmentFault(
        {"the copy of the study on the server cannot be removed, because others read its tables: " +
             (logins.empty() ? "logins that are not shown" : logins),
         server.address().text, "no open transaction on the study within 10 seconds",
         "close these, then run the same command again"});
}

void dropStudy(const ServerConnection& server)
{
    server.run(QStringLiteral("SET lock_timeout = '10s'"));
    try {
        server.run(QStringLiteral("DROP SCHEMA @schema@ CASCADE"));
    } catch (const ServerLocked&) {
        throw studyIsInUse(server);
    }
    try {
        server.run(QStringLiteral(
            "DROP ROLE IF EXISTS \"@prefix@_experimenter\", \"@prefix@_monitor\", \"@prefix@_analyst\", \"@prefix@_display\""));
    } catch (const protocols::Error&) {
        // An owner without the right to make roles leaves them to the administrator; they have no rights any more.
    }
    server.run(QStringLiteral("RESET lock_timeout"));
}

LogHead headOf(const ServerConnection& server)
{
    QSqlQuery row = server.run(QStringLiteral("SELECT sequence, hash FROM @schema@.events ORDER BY sequence DESC LIMIT 1"));
    return row.next() ? LogHead{row.value(0).toLongLong(), fromQt(row.value(1))} : LogHead{};
}

protocols::Error nameIsTaken(const ServerConnection& server)
{
    return protocols::badInput(
        {"the server has a study of this name already", server.address().text, "a new name", "choose another study=NAME"});
}

/// The groups of a study belong to the whole server (roles.sql): members of those of another study could enter this one.
void requireOwnGroups(const ServerConnection& server)
{
    const auto others = server.value(
        QStringLiteral("SELECT count(*) FROM pg_shdepend d JOIN pg_roles r ON r.oid = d.refobjid "
                       "WHERE d.refclassid = CAST('pg_authid' AS regclass) AND r.rolname = ANY(ARRAY['@prefix@_experimenter', "
                       "'@prefix@_monitor', '@prefix@_analyst', '@prefix@_display']) "
                       "AND d.dbid NOT IN (0, (SELECT oid FROM pg_database WHERE datname = current_database()))"));
    if (others.toInt() == 0) return;
    throw protocols::badInput({"another database of this server has a study of this name, and its logins could enter this one",
                               server.address().text, "a name of its own for each study of a server",
                               "choose another study=NAME"});
}

/// What an interrupted move of the same study left is removed; any other study of this name is refused.
void requireRoom(const ServerConnection& server, const StudyFacts& facts)
{
    requireOwnGroups(server);
    if (!hasStudy(server)) return;
    const bool isSame = fromQt(server.value(QStringLiteral("SELECT key_sha256 FROM @schema@.study"))) == facts.keySha256;
    if (!isSame || stateOf(server) != "arriving") throw nameIsTaken(server);
    dropStudy(server);
}

/// The questions of every phase by version of the protocol: what the server needs to know when a presentation is complete.
std::string phaseQuestions(const StudyStore& store)
{
    nlohmann::ordered_json versions;
    for (const ProtocolVersion& version : store.protocolVersions()) {
        const auto protocol =
            protocols::keptProtocolFromJson(version.json, store.folder().protocol().string(), store.facts().programVersion);
        auto phases = nlohmann::ordered_json::array();
        for (const protocols::Phase& phase : protocol.phases) {
            auto& questions = phases.emplace_back(nlohmann::ordered_json::array());
            for (const protocols::Question& question : phase.questions) questions.push_back(question.id.value);
        }
        versions[std::to_string(version.version)] = phases;
    }
    return versions.dump();
}

void sendImages(const StudyStore& store, const ServerConnection& server, const protocols::SecretKey& stationKey)
{
    for (const auto& [code, hash] : store.stimulusHashes()) {
        const fs::path file = protocols::stimulusFile(store.folder().stimuli(), code);
        const auto sealed = protocols::readIfPossible(file);
        const auto image = sealed ? protocols::open(stationKey, *sealed, code.value) : std::nullopt;
        if (!image)
            throw protocols::workFailed({"the stimulus is missing or was altered", file.string(),
                                         "the file from the making of the study", "restore it from a backup"});
        const auto key = protocols::SecretKey::drawn();
        server.run(
            QStringLiteral("INSERT INTO @schema@.server_images(file_code, sealed, key) VALUES (?, ?, ?)"),
            {toQt(code.value), QByteArray::fromStdString(protocols::seal(key, *image, releasedImageBound)), toQt(key.hex())});
    }
}

/// Which image each presentation shows. In the file this is sealed with the station key, which never reaches the server.
void sendOrder(const StudyStore& store, const ServerConnection& server, const protocols::SecretKey& stationKey)
{
    const auto send = [&](const char* table, const char* columns, const nlohmann::json& rows) {
        server.run(QStringLiteral("INSERT INTO @schema@.%1(%2) SELECT %2 FROM json_populate_recordset(CAST(NULL AS "
                                  "@schema@.%1), CAST(? AS json))")
                       .arg(QLatin1String(table), QLatin1String(columns)),
                   {toQt(rows.dump())});
    };
    for (const Slot& slot : store.slots()) {
        auto rows = nlohmann::json::array();
        for (const protocols::BlindedTrial& trial : store.trials(slot.number))
            rows.push_back({{"slot", slot.number},
                            {"number", trial.number.value},
                            {"file_code", protocols::opened(trial.sealedCode, stationKey).value}});
        send("server_trials", "slot, number, file_code", rows);
    }
    auto items = nlohmann::json::array();
    for (const FamiliarisationItem& item : store.facts().familiarisation)
        items.push_back({{"position", items.size() + 1}, {"file_code", protocols::opened(item.sealedCode, stationKey).value}});
    send("server_familiarisation", "position, file_code", items);
}

void sendWhole(const StudyStore& store, const ServerConnection& server)
{
    const auto stationKey = readStationKey(store.folder(), store.facts().stationKeySha256);
    ServerTransaction transaction(server);
    for (const char* script : {"tables", "functions"}) server.runScript(serverScript(script));
    sendRows(SqliteConnection(store.folder().database(), SqliteConnection::Mode::Read), server);
    server.run(QStringLiteral("SELECT @schema@.begin_arrival(?, ?, CAST(? AS jsonb))"),
               {toQt(store.facts().programVersion), serverFormat, toQt(phaseQuestions(store))});
    sendImages(store, server, stationKey);
    sendOrder(store, server, stationKey);
    transaction.commit();
}

void fetchInto(const ServerConnection& server, const StudyFolder& folder)
{
    makeDatabase(folder, [&](const SqliteConnection& file) {
        ServerTransaction state(server, ServerTransaction::Kind::ReadOneState);
        fetchRows(server, file);
        state.commit();
    });
}

void requireSame(const ServerConnection& server, const StudyFolder& folder)
{
    const protocols::TemporaryFolder again;
    const StudyFolder copy{again.path()};
    fetchInto(server, copy);
    const SqliteConnection sent(folder.database(), SqliteConnection::Mode::Read);
    const SqliteConnection arrived(copy.database(), SqliteConnection::Mode::Read);
    if (hashOfAllRows(sent) != hashOfAllRows(arrived))
        throw protocols::workFailed({"the server holds other rows than it was sent", server.address().text, "",
                                     "the folder is unchanged; check the server's encoding (UTF8)"});
}

void removeDatabase(const StudyFolder& folder)
{
    for (const char* ending : {"", "-wal", "-shm"}) fs::remove(folder.database().string() + ending);
}

/// The last steps of a move to the server, which an interruption may have left undone. The file goes last: as long as the study
/// has not arrived, it can come back. A study on its way back stays on it.
LogHead openOnServer(const StudyFolder& folder, const ServerConnection& server)
{
    const WriteLock lock(folder);  // against a move the other way at the same time
    const std::string state = stateOf(server);
    if (state == "leaving")
        throw protocols::workFailed({"the study is on its way back to its folder", folder.folder.string(), "",
                                     "complete that first: vis2hap study move " + protocols::shellWord(server.address().text) +
                                         " " + protocols::shellWord(folder.folder.string())});
    if (state == "arriving") server.run(QStringLiteral("SELECT @schema@.finish_arrival()"));
    removeDatabase(folder);
    return headOf(server);
}

ServerNote ownersNote(const StudyFolder& folder)
{
    auto note = readServerNote(folder.folder);
    if (!note)
        throw protocols::badInput(
            {"this study lies on no server", folder.folder.string(), "a folder with server.json", "check the path"});
    if (!note->isOwner)
        throw protocols::badInput({"this is the folder of a station, which holds neither keys nor answers",
                                   folder.folder.string(), "the folder of the study's owner", "run the command there"});
    return *note;
}

/// Fetches the study and checks it; the folder then has a sound study.db, or none.
void bringBack(const ServerConnection& server, const StudyFolder& folder, const std::vector<std::string>& givenUp)
{
    if (stateOf(server) == "leaving") server.run(QStringLiteral("SELECT @schema@.cancel_leaving()"));  // a move was interrupted
    server.run(QStringLiteral("SELECT @schema@.begin_leaving(CAST(? AS jsonb))"), {toQt(nlohmann::json(givenUp).dump())});
    try {
        fetchInto(server, folder);
        const SqliteConnection file(folder.database(), SqliteConnection::Mode::Read);
        const auto faults = faultsOfCopy(file);
        if (!faults.empty() || headIn(file) != headOf(server))
            throw protocols::workFailed({"the study did not arrive whole: " + (faults.empty() ? "another head" : faults.front()),
                                         folder.folder.string(), "", "the study is still on the server; see vis2hap verify"});
    } catch (...) {
        removeDatabase(folder);
        server.run(QStringLiteral("SELECT @schema@.cancel_leaving()"));
        throw;
    }
}

/// After a move that was interrupted: on the way back between the arrival of the file and the end of the server's copy, or on the
/// way to the server before the study opened there.
void requireArrived(const ServerConnection& server, const StudyFolder& folder)
{
    const std::string state = stateOf(server);
    if (state == "arriving") return requireSame(server, folder);
    const SqliteConnection file(folder.database(), SqliteConnection::Mode::Read);
    if (state != "leaving" || headIn(file) != headOf(server))
        throw protocols::workFailed({"a study.db stands in the folder, and the study is on the server", folder.folder.string(),
                                     "a folder without study.db", "move that file elsewhere"});
}

/// Before the note of the server is removed, so that an interrupted move records it later.
void recordStay(const StudyFolder& folder, Act act, const std::string& address, const LogHead& head)
{
    act.kind = serverAct;
    act.path = address;
    act.head = head;
    if (const auto refused = recordAct(folder, act))
        throw protocols::workFailed({"the study is back, but its time on the server could not be recorded: " + *refused,
                                     folder.folder.string(), "", "run the same command again"});
}

/// The queue of sessions in this folder. What its owner gave up stays as a file, like at every station.
void clearQueue(const StudyFolder& folder)
{
    std::error_code ignored;
    if (!fs::is_regular_file(fs::symlink_status(folder.queue(), ignored))) return;
    try {
        AnswerQueue queue(folder);
        while (const auto first = queue.first()) keepNotSent(folder, queue, *first);
    } catch (const protocols::Error& fault) {
        if (fault.exitCode() == protocols::ExitCode::Environment) throw;
        return;  // a damaged queue stays, and verify names it
    }
    for (const char* ending : {"", "-wal", "-shm"}) fs::remove(folder.queue().string() + ending, ignored);
}

/// A link stays a link. Pipes, sockets and devices stay behind: `verify` looks at the folder itself.
void copyWhatCanBeRead(const fs::directory_entry& entry, const fs::path& to)
{
    switch (entry.symlink_status().type()) {
        case fs::file_type::regular:
            fs::copy_file(entry.path(), to);
            break;
        case fs::file_type::symlink:
            fs::copy_symlink(entry.path(), to);
            break;
        case fs::file_type::directory:
            fs::create_directory(to, entry.path());
            for (const auto& inner : fs::directory_iterator(entry.path())) copyWhatCanBeRead(inner, to / inner.path().filename());
            break;
        default:
            break;
    }
}

void copyFilesBeside(const StudyFolder& folder, const StudyFolder& copy)
{
    for (const auto& entry : fs::directory_iterator(folder.folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("study.db") || name == ".lock" || name.starts_with("queue.db") ||
            entry.path() == serverNoteOf(folder.folder))
            continue;
        copyWhatCanBeRead(entry, copy.folder / name);
        const fs::file_type type = entry.symlink_status().type();
        if (type == fs::file_type::directory) fs::permissions(copy.folder / name, fs::perms::owner_all);
        if (type == fs::file_type::regular) fs::permissions(copy.folder / name, fs::perms::owner_read | fs::perms::owner_write);
    }
}

}  // namespace

// A recycled segment of the write-ahead log keeps its old content, so the segments are removed for once. Every switch fills one.
const char* const removalFromServer =
    "  sudo -u postgres psql -c \"ALTER SYSTEM SET wal_recycle = off\" -c \"SELECT pg_reload_conf()\" \\\n"
    "    -c \"SELECT pg_logical_emit_message(false, '', ''), pg_switch_wal() FROM pg_ls_waldir()\" -c \"CHECKPOINT\" \\\n"
    "    -c \"ALTER SYSTEM RESET wal_recycle\" -c \"SELECT pg_reload_conf()\"\n"
    "  sudo sh -c 'rm -f /var/log/postgresql/*.log.*; truncate -s 0 /var/log/postgresql/*.log'\n"
    "  Then delete the server's backups and its archive of the write-ahead log, where it has them.\n";

void requireFreeName(const ServerAddress& address)
{
    const ServerConnection server(address);
    if (hasStudy(server)) throw nameIsTaken(server);
    requireOwnGroups(server);
}

LogHead moveToServer(const StudyFolder& folder, const ServerAddress& address, const std::string& station)
{
    if (const auto note = readServerNote(folder.folder)) {
        if (note->address != address.text)
            throw protocols::badInput({"this study lies on a server already", note->address, "",
                                       "bring it back first: vis2hap study move " + protocols::shellWord(note->address) + " " +
                                           protocols::shellWord(folder.folder.string())});
        return openOnServer(folder, ServerConnection(address));
    }
    const ServerConnection server(address);
    {
        const StudyStore store(folder, StudyStore::Access::Write);
        requireRoom(server, store.facts());
        sendWhole(store, server);
        requireSame(server, folder);
        writeServerNote(folder.folder, {address.text, station, protocols::drawHex(32), true});
    }
    return openOnServer(folder, server);
}

LogHead moveToFolder(const ServerAddress& address, const StudyFolder& folder, const Act& by,
                     const std::vector<std::string>& givenUp)
{
    const ServerNote note = ownersNote(folder);
    const WriteLock lock(folder);
    const ServerConnection server(serverAddressFrom(note.address));
    if (address.study != server.address().study || address.database != server.address().database)
        throw protocols::badInput(
            {"this folder belongs to another study", folder.folder.string(), note.address, "name the study's own folder"});
    std::error_code ignored;
    const bool hasArrived = fs::exists(folder.database(), ignored);
    if (!hasArrived)
        bringBack(server, folder, givenUp);
    else if (hasStudy(server))
        requireArrived(server, folder);
    if (hasStudy(server)) dropStudy(server);
    const LogHead head = headIn(SqliteConnection(folder.database(), SqliteConnection::Mode::Read));
    if (!by.program.empty()) recordStay(folder, by, note.address, head);
    clearQueue(folder);
    fs::remove(serverNoteOf(folder.folder));
    return head;
}

StudyStore readStudy(const StudyFolder& folder)
{
    if (isServerAddress(folder.folder.string()))
        throw protocols::badInput({"this command needs a folder, not an address", withoutPassword(folder.folder.string()),
                                   "the folder of the study's owner", "run it there; the folder leads to the server"});
    if (!readServerNote(folder.folder)) return {folder, StudyStore::Access::Read};
    const ServerNote note = ownersNote(folder);
    auto copy = std::make_unique<protocols::TemporaryFolder>();
    const StudyFolder copied{copy->path()};
    copyFilesBeside(folder, copied);
    fetchInto(ServerConnection(serverAddressFrom(note.address)), copied);
    return StudyStore::ofCopy(std::move(copy), folder.folder);
}

std::unique_ptr<protocols::TemporaryFolder> fetchedRows(const StudyFolder& folder)
{
    const ServerConnection server(serverAddressFrom(ownersNote(folder).address));
    auto copy = std::make_unique<protocols::TemporaryFolder>();
    fetchInto(server, {copy->path()});
    return copy;
}

std::optional<std::string> recordActOnServer(const StudyFolder& folder, Act act)
{
    if (act.wallTime.empty()) act.wallTime = wallTimeNow();
    try {
        const ServerConnection server(serverAddressFrom(ownersNote(folder).address));
        (void)server.call("record_act", {toQt(act.kind), toQt(detailsOf(act)), toQt(act.wallTime)});
        return std::nullopt;
    } catch (const protocols::Error& fault) {
        return fault.what();
    }
}

}  // namespace database
