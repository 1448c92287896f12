#include "tests/promises/erasure.h"

#include <sqlite3.h>

#include <filesystem>
#include <set>

#include "database/event_chain.h"
#include "database/response_columns.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "tests/promises/kept_answers.h"
#include "tests/support/played_session.h"
#include "tests/support/raw_sqlite.h"

namespace tests::promises {

namespace {

namespace fs = std::filesystem;
using database::LogEntry;
using support::OpenSession;

/// An entry of the log as an attacker knows it who kept everything but the answer: times, places, the commitment.
struct KnownEntry {
    LogEntry entry;
    std::string salt, commitment;
};

std::vector<KnownEntry> answersInLog(const database::StudyFolder& folder)
{
    const database::SqliteConnection sqlite(folder.database(), database::SqliteConnection::Mode::Read);
    std::vector<KnownEntry> entries;
    QSqlQuery row = sqlite.run(QStringLiteral("SELECT e.payload, e.at_ns, e.wall_time, e.salt, e.commitment, %1 FROM events e "
                                              "JOIN responses r ON r.event = e.sequence ORDER BY e.sequence")
                                   .arg(QLatin1String("r.") + namesOf(database::ResponseColumns::OfTable).replace(", ", ", r.")));
    while (row.next()) {
        KnownEntry known;
        known.entry.event.payloadJson = database::fromQt(row.value(0));
        known.entry.event.atNs = row.value(1).toLongLong();
        known.entry.event.wallTime = database::fromQt(row.value(2));
        known.salt = database::fromQt(row.value(3));
        known.commitment = database::fromQt(row.value(4));
        known.entry.responses.push_back(rowFrom(row, database::ResponseColumns::OfTable, 5));
        entries.push_back(known);
    }
    return entries;
}

/// Every text that the log still holds and that could be a salt; the empty one first.
std::set<std::string> saltsLeft(const database::StudyFolder& folder)
{
    support::RawSqlite sqlite(folder.database());
    std::set<std::string> texts{""};
    for (const char* column : {"salt", "commitment", "hash", "previous_hash"})
        for (const std::string& text : sqlite.rows(std::string("SELECT ") + column + " FROM events")) texts.insert(text);
    return texts;
}

/// Whether one of the salts opens the commitment. The attacker is given the true answer, so that no guess can be missed.
bool isOpened(const KnownEntry& known, const std::set<std::string>& salts)
{
    for (const std::string& salt : salts)
        if (commitmentOf(known.entry, salt) == known.commitment) return true;
    return false;
}

/// Number of texts found in any file of the folders.
int foundIn(const fs::path& folder, const std::set<std::string>& texts)
{
    int found = 0;
    for (const auto& file : fs::recursive_directory_iterator(folder)) {
        if (!file.is_regular_file()) continue;
        const std::string bytes = protocols::readWholeFile(file.path());
        for (const std::string& text : texts) found += bytes.find(text) != std::string::npos;
    }
    return found;
}

}  // namespace

Promise afterErasure(const Effort&)
{
    SessionStudy study(paperStudy());
    const database::StudyFolder folder = study.copy();
    const database::Erasure erasure{protocols::ParticipantId("S01"), true, "promises", "measures the erasure", {}};
    OpenSession(folder, "S01").playToEnd();
    OpenSession other(folder, "S02");
    other.playUntilAnswers(20);
    database::StudyStore& store = other.store;
    const std::vector<KnownEntry> before = answersInLog(folder);

    bool isRefused = false;
    {
        support::RawSqlite reader(folder.database());
        reader.run("BEGIN");
        reader.rows("SELECT COUNT(*) FROM responses");
        try {
            store.erase(erasure);
        } catch (const protocols::Error&) {
            isRefused = store.answers().size() == before.size();
        }
    }
    const auto record = store.erase(erasure);
    const fs::path backup = folder.folder.string() + "-backup";
    fs::create_directory(backup);
    store.copyTo(backup / "study.db");

    const std::set<std::string> salts = saltsLeft(folder);
    std::set<std::string> erasedSalts;
    int erased = 0, recovered = 0, openedBefore = 0;
    for (const KnownEntry& known : before) {
        if (known.entry.responses.front().participant != "S01") continue;
        ++erased;
        erasedSalts.insert(known.salt);
        openedBefore += isOpened(known, {known.salt});
        recovered += isOpened(known, salts);
    }
    const int found = foundIn(folder.folder, erasedSalts) + foundIn(backup, erasedSalts) + static_cast<int>(record.found.size());
    return {"erased answers, guessed from database, write-ahead log and a later backup",
            withCommas(erased) + " answers, each against " + withCommas(static_cast<long>(salts.size())) +
                " texts of the log, with its times and its content known",
            "0 recovered; 0 found by a byte search; refused while a reader holds a snapshot",
            std::to_string(recovered) + " recovered, " + std::to_string(found) +
                " found; with a reader: " + (isRefused ? "refused, nothing erased" : "NOT refused"),
            recovered == 0 && found == 0 && isRefused && openedBefore == erased && record.answers == erased};
}

}  // namespace tests::promises
