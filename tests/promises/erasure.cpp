#include "tests/promises/erasure.h"

#include <sqlite3.h>

#include <filesystem>
#include <optional>
#include <set>

#include "database/event_chain.h"
#include "database/response_columns.h"
#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "tests/promises/kept_answers.h"
#include "tests/promises/traces.h"
#include "tests/support/played_session.h"
#include "tests/support/program.h"
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

/// The content of a row of finger_samples, as the commitment covers it.
database::FingerRow fingerFrom(const QSqlQuery& row, int first)
{
    database::FingerRow finger;
    finger.beganAt = row.value(first).toLongLong();
    finger.count = row.value(first + 1).toInt();
    finger.leftOut = row.value(first + 2).toInt();
    finger.samplesSha256 = protocols::sha256(database::fromQt(row.value(first + 3)));
    return finger;
}

std::vector<KnownEntry> answersInLog(const database::StudyFolder& folder)
{
    const database::SqliteConnection sqlite(folder.database(), database::SqliteConnection::Mode::Read);
    std::vector<KnownEntry> entries;
    QSqlQuery row =
        sqlite.run(QStringLiteral("SELECT e.payload, e.at_ns, e.wall_time, e.salt, e.commitment, f.began_at, f.count, "
                                  "f.left_out, f.samples, %1 FROM events e JOIN responses r ON r.event = e.sequence "
                                  "LEFT JOIN finger_samples f ON f.event = e.sequence ORDER BY e.sequence")
                       .arg(QLatin1String("r.") + namesOf(database::ResponseColumns::OfTable).replace(", ", ", r.")));
    while (row.next()) {
        KnownEntry known;
        known.entry.event.payloadJson = database::fromQt(row.value(0));
        known.entry.event.atNs = row.value(1).toLongLong();
        known.entry.event.wallTime = database::fromQt(row.value(2));
        known.salt = database::fromQt(row.value(3));
        known.commitment = database::fromQt(row.value(4));
        if (!row.value(5).isNull()) known.entry.finger.push_back(fingerFrom(row, 5));
        known.entry.responses.push_back(rowFrom(row, database::ResponseColumns::OfTable, 9));
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

/// Facts and remarks that nobody else gives: the search ignores what two participants share.
study::session::EventBody madeOwn(study::session::EventBody event, int step)
{
    if (auto* facts = std::get_if<study::session::FactsGiven>(&event))
        for (auto& [name, value] : facts->facts) value += " and more about S01";
    if (auto* debriefed = std::get_if<study::session::Debriefed>(&event)) debriefed->text = "S01 has a friend who sews";
    if (auto* noted = std::get_if<study::session::Noted>(&event)) noted->text = "S01 sneezed at step " + std::to_string(step);
    return event;
}

/// A whole session with facts, notes, and a finger in every presentation. Its times are those of nobody else.
void playWithTraces(const database::StudyFolder& folder)
{
    OpenSession session(folder, "S01");
    session.clock.advanceSeconds(1234567.891);
    for (int step = 1;; ++step) {
        session.clock.advanceSeconds(1.25);  // longer than the dead time after a step
        const auto* presenting = std::get_if<study::session::Presenting>(&session.driver->state().stage);
        if (presenting && !session.driver->state().paused) {
            if (presenting->question == 0) session.send(study::session::Touched{});
            for (int sample = 0; sample < 20; ++sample) {
                session.clock.advanceSeconds(0.01);
                session.driver->addFinger({{}, 4000.01 + step + 0.07 * sample, 20.05, 0.432});
            }
            if (step % 10 == 0) session.send(madeOwn(study::session::Noted{{}, false}, step));
        }
        const auto event = support::nextEvent(session.driver->view(), session.driver->plan());
        if (!event) return;
        session.send(madeOwn(*event, step));
    }
}

/// Whether an erasure is refused, and nothing is erased, while another program reads the study. `logIsEmpty`: that program
/// began after the write-ahead log was emptied, so that it reads study.db alone.
bool isRefusedBesideReader(database::StudyStore& store, const database::Erasure& erasure, bool logIsEmpty)
{
    const std::size_t before = store.answers().size();
    support::RawSqlite reader(store.folder().database());
    if (logIsEmpty) reader.rows("PRAGMA wal_checkpoint(TRUNCATE)");
    reader.run("BEGIN");
    reader.rows("SELECT COUNT(*) FROM responses");
    try {
        store.erase(erasure);
    } catch (const protocols::Error&) {
        return store.answers().size() == before;
    }
    return false;
}

/// Everything that the program writes about a study: backups, exports in every form, reports; first blinded, then unblinded.
fs::path everyCopyOf(const fs::path& study)
{
    const QString folder = QString::fromStdString(study.string()), out = folder + "-copies/";
    fs::create_directory(out.toStdString());
    const auto run = [](const QStringList& words) { ::support::mustRun(words); };
    run({"backup", folder, "--out", out + "backup.tar"});
    for (const bool isBlinded : {true, false}) {
        const QString at = out + (isBlinded ? "blinded-" : "open-");
        if (!isBlinded) run({"unblind", folder, "--who", "promises", "--why", "measures the erasure"});
        for (const char* format : {"csv", "json", "script", "psych-ds"})
            run(QStringList{"export", folder, "--out", at + format, "--format", format, "--with-log"} +
                (isBlinded ? QStringList() : QStringList{"--with-samples"}));
        run({"export", folder, "--out", at + "person", "--participant", "S01"});
        run({"report", folder, "--out", at + "report", "--quick"});
        run({"study", "data-sheet", folder, "--out", at + "sheet.txt"});
    }
    return out.toStdString();
}

}  // namespace

Promise afterErasure(const Effort&)
{
    SessionStudy study(paperStudy());
    const database::StudyFolder folder = study.copy();
    const database::Erasure erasure{protocols::ParticipantId("S01"), true, "promises", "measures the erasure", {}};
    playWithTraces(folder);
    std::optional<OpenSession> other(std::in_place, folder, "S02");
    other->playUntilAnswers(20);
    const std::vector<KnownEntry> before = answersInLog(folder);
    const Traces traces = tracesOf("S01", folder);

    const fs::path earlier = folder.folder.string() + "-earlier";
    fs::create_directory(earlier);
    other->store.copyTo(earlier / "study.db");
    for (const char* part : {"protocol.json", "stimuli", "allocation-key.json", "station-key.json"})
        fs::copy(folder.folder / part, earlier / part, fs::copy_options::recursive);
    const bool isSearched = kindsFoundIn({earlier}, traces).size() == traces.size() &&
                            kindsFoundIn({everyCopyOf(earlier)}, traces).size() == traces.size();

    const bool isRefused =
        isRefusedBesideReader(other->store, erasure, false) && isRefusedBesideReader(other->store, erasure, true);
    const auto record = other->store.erase(erasure);
    int found = filesWith(traces, {folder.folder}) + static_cast<int>(record.found.size());  // also the write-ahead log
    other.reset();
    const fs::path copies = everyCopyOf(folder.folder);
    found += filesWith(traces, {folder.folder, copies});

    std::set<std::string> salts = saltsLeft(folder);
    salts.merge(possibleSaltsIn(copies));
    int erased = 0, recovered = 0, openedBefore = 0;
    for (const KnownEntry& known : before) {
        if (known.entry.responses.front().participant != "S01") continue;
        ++erased;
        openedBefore += isOpened(known, {known.salt});
        recovered += isOpened(known, salts);
    }
    return {"erased answers, guessed from database and write-ahead log, and from backups, exports and reports made after",
            withCommas(erased) + " answers with facts, notes and samples of the finger, each against " +
                withCommas(static_cast<long>(salts.size())) + " texts, with its times and its content known",
            "0 recovered; 0 found by a byte search; refused while a reader holds a snapshot",
            std::to_string(recovered) + " recovered, found in " + std::to_string(found) + " files" +
                (isSearched ? "" : ", but the search does NOT find what an earlier copy holds") +
                "; with a reader: " + (isRefused ? "refused, nothing erased" : "NOT refused"),
            recovered == 0 && found == 0 && isSearched && isRefused && openedBefore == erased && record.answers == erased};
}

}  // namespace tests::promises
