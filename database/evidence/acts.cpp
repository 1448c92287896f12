#include "database/evidence/acts.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "database/disk/write_lock.h"
#include "database/event_chain.h"
#include "database/sqlite_connection.h"
#include "database/stored_texts.h"
#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/utf8.h"
#include "protocols/json_count.h"

namespace database {

namespace {

/// Bytes. A server takes 10,000; a folder with hundreds of faults has more.
constexpr std::size_t longestNote = 4000;

/// Empty where the details cannot be read.
std::optional<Act> actOf(const ChainedAct& row)
{
    try {
        const auto details = protocols::storedJson(row.details);
        return Act{row.kind,
                   details.at("who").get<std::string>(),
                   details.at("program").get<std::string>(),
                   details.at("host").get<std::string>(),
                   details.at("path").get<std::string>(),
                   {protocols::wholeOf<std::int64_t>(details.at("entry")), details.at("hash").get<std::string>()},
                   row.wallTime,
                   details.value("note", "")};
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

/// `verify` names it as a fault. Until somebody looks, it may be any copy of the whole log.
Act unreadable(const ChainedAct& row)
{
    const std::string what = "act " + std::to_string(row.number) + ", which cannot be read";
    return {row.kind, "", "", "", what, {std::numeric_limits<std::int64_t>::max(), ""}, row.wallTime, what};
}

void insert(const SqliteConnection& sqlite, const Act& act)
{
    Transaction transaction(sqlite);
    appendAct(sqlite, {0, act.kind, act.wallTime, detailsOf(act), {}, {}});
    transaction.commit();
    // A reader closes the database last and cannot empty the write-ahead log. Do not make a session wait for it.
    sqlite.run(QStringLiteral("PRAGMA busy_timeout = 100"));
    sqlite.run(QStringLiteral("PRAGMA wal_checkpoint(TRUNCATE)"));
}

}  // namespace

std::string detailsOf(const Act& act)
{
    nlohmann::ordered_json details{{"who", act.who},   {"program", act.program},     {"host", act.host},
                                   {"path", act.path}, {"entry", act.head.sequence}, {"hash", act.head.hash}};
    if (!act.note.empty()) details["note"] = protocols::inShort(act.note, longestNote);
    return details.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::optional<std::string> recordAct(const StudyFolder& folder, Act act)
{
    if (act.wallTime.empty()) act.wallTime = wallTimeNow();
    try {
        requireNoOtherComputer(folder);
        insert(SqliteConnection(folder.database(), SqliteConnection::Mode::Write), act);
        return std::nullopt;
    } catch (const protocols::Error& fault) {
        return fault.what();
    }
}

std::vector<Act> actsOf(const StudyStore& store)
{
    const SqliteConnection& sqlite = store.connection();
    std::vector<Act> acts;
    for (const ChainedAct& row : chainedActsIn(sqlite)) {
        acts.push_back(actOf(row).value_or(unreadable(row)));
    }
    return acts;
}

std::vector<ChainedAct> chainedActsOf(const StudyStore& store) { return chainedActsIn(store.connection()); }

LogHead headOfActs(const StudyStore& store)
{
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Read);
    QSqlQuery last = sqlite.run(QStringLiteral("SELECT number, hash FROM acts ORDER BY number DESC LIMIT 1"));
    return last.next() ? LogHead{last.value(0).toLongLong(), fromQt(last.value(1))} : LogHead{};
}

std::vector<Act> copiesSince(const StudyStore& store, std::int64_t sequence, const protocols::ParticipantId& about)
{
    std::vector<Act> copies;
    for (Act& act : actsOf(store)) {
        const bool isReadable = !act.head.hash.empty();
        const bool isAboutThem = act.kind == personExport && (about.value.empty() || act.note == about.value);
        const bool leavesCopy = !isReadable || act.kind == "export" || act.kind == "backup" || act.kind == "report" ||
                                act.kind == serverAct || isAboutThem;
        if (leavesCopy && !act.path.empty() && act.head.sequence >= sequence) copies.push_back(std::move(act));
    }
    return copies;
}

std::vector<std::string> faultsOfActs(const StudyStore& store)
{
    const SqliteConnection sqlite(store.folder().database(), SqliteConnection::Mode::Read);
    const ReadSnapshot snapshot(sqlite);
    std::vector<std::string> faults;
    std::string previous;
    std::int64_t last = 0;
    for (const ChainedAct& row : chainedActsIn(sqlite)) {
        const std::string name = "act " + std::to_string(row.number) + " (" + row.kind + ")";
        const auto act = actOf(row);
        if (row.number != last + 1 || row.previous != previous) faults.push_back(name + ": does not follow the act before it");
        if (!act || chainHash(row) != row.hash)
            faults.push_back(name + ": was altered");
        else if (fromQt(sqlite.value(QStringLiteral("SELECT hash FROM events WHERE sequence = ?"),
                                     {qlonglong(act->head.sequence)})) != act->head.hash)
            faults.push_back(name + ": the log no longer has the head of that time, " + textOf(act->head));
        previous = row.hash;
        last = row.number;
    }
    const std::int64_t written = sqlite.value(QStringLiteral("SELECT seq FROM sqlite_sequence WHERE name = 'acts'")).toLongLong();
    if (written != last)
        faults.push_back("the acts end at number " + std::to_string(last) + ", " + std::to_string(written) + " were written");
    return faults;
}

}  // namespace database
