#include "study/records/evidence/exported_log.h"

#include "database/evidence/acts.h"
#include "database/evidence/clear_log.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"

namespace study::records {

namespace {

/// Python 3 without any package. The test runs it on the exported file.
constexpr const char* recipe = R"(import csv, hashlib, json, sys

def field(text):
    data = text.encode("utf-8")
    return str(len(data)).encode() + b":" + data + b","

def rows(file):
    return list(csv.DictReader(open(file, newline="", encoding="utf-8")))

def chain(what, rows, first, columns):
    hashes = []
    for row in rows:
        previous = hashes[-1] if hashes else ""
        parts = first + [previous] + [row[column] for column in columns]
        own = hashlib.sha256(b"".join(field(part) for part in parts)).hexdigest()
        if row[columns[0]] != str(len(hashes) + 1) or row["previous_hash"] != previous or row["hash"] != own:
            sys.exit(what + " " + row[columns[0]] + " was altered, or one before it is missing")
        hashes.append(own)
    return hashes

log = chain("entry", rows(sys.argv[1]), [], ["sequence", "participant", "sitting", "kind", "places", "commitment"])
acts = chain("act", rows(sys.argv[2]), ["act"], ["number", "kind", "details", "time"])
for row in rows(sys.argv[2]):
    head = json.loads(row["details"])
    if log[head["entry"] - 1:head["entry"]] != [head["hash"]]:
        sys.exit("act " + row["number"] + " names a head that the log does not have")
print("log " + str(len(log)) + ":" + "".join(log[-1:]))
print("acts " + str(len(acts)) + ":" + "".join(acts[-1:]))
)";

std::string rowOf(const database::ClearEntry& entry)
{
    return protocols::csvRow({std::to_string(entry.sequence), entry.participant, std::to_string(entry.sitting), entry.kind,
                              entry.wallTime, entry.places, entry.commitment, entry.previous, entry.hash});
}

std::string textOf(const std::vector<database::ChainedAct>& acts)
{
    return std::to_string(acts.size()) + ":" + (acts.empty() ? "" : acts.back().hash);
}

std::string explanation(const std::string& study, const database::LogHead& head, const std::vector<database::ChainedAct>& acts)
{
    return "The log of the study " + protocols::printable(study) + "\n\nHead: " + protocols::printable(textOf(head)) +
           "\nActs: " + protocols::printable(textOf(acts)) +
           "\n\n"
           "log.csv has one row for each entry of the log, from the first on.\n\n"
           "sequence       number of the entry, from 1 without gaps\n"
           "participant    whom the entry concerns; empty for an act on the study itself\n"
           "sitting        number of the sitting of this participant\n"
           "kind           what happened: answered, corrected, voided, paused, ...\n"
           "time           wall clock; empty where the entry was erased\n"
           "places         which rows the entry stored (trial, attempt, question), but not what they say\n"
           "commitment     SHA-256 of a secret salt and the content: payload, times, answers and notes\n"
           "previous_hash  hash of the entry before; empty in the first\n"
           "hash           SHA-256 of previous_hash, sequence, participant, sitting, kind, places and commitment\n\n"
           "acts.csv has one row for each recorded act outside the sessions: exports, backups, reports and others. The acts "
           "have\n"
           "a chain of hashes of their own. This export is recorded after it is written, so it is not among them.\n\n"
           "number         number of the act, from 1 without gaps\n"
           "kind           what was done: export, backup, report, unblind, leak-check, sign, ...\n"
           "time           wall clock\n"
           "details        JSON: who, program, host, path, the head of the log at that time (entry, hash), and perhaps a note\n"
           "previous_hash  hash of the act before; empty in the first\n"
           "hash           SHA-256 of the word act, previous_hash, number, kind, details and time\n\n"
           "Each of these fields enters the hash as UTF-8: its length in bytes, a colon, its bytes, a comma. The last hash of\n"
           "log.csv is the head, which commits to every entry. Times of entries are covered by the commitment only. Content and\n"
           "salts are not exported: `vis2hap verify` compares them with the commitments in the study itself. Cells of both "
           "files\n"
           "are quoted as in RFC 4180.\n\n"
           "This program computes both last hashes again (python3 check.py log.csv acts.csv). Compare its output with a head "
           "that\n"
           "somebody kept elsewhere, such as in the laboratory book: the files alone cannot show that they are the true ones. "
           "An\n"
           "act whose head is in the log shows that this part of the log existed at the time of the act.\n\n" +
           recipe;
}

void writeActs(const std::vector<database::ChainedAct>& acts, const std::filesystem::path& file)
{
    std::string rows = protocols::csvRow({"number", "kind", "time", "details", "previous_hash", "hash"});
    for (const database::ChainedAct& act : acts)
        rows += protocols::csvRow({std::to_string(act.number), act.kind, act.wallTime, act.details, act.previous, act.hash});
    protocols::writeWholeFile(file, rows, protocols::Sync::Later);
}

}  // namespace

database::LogHead writeExportedLog(const database::StudyStore& store, const std::filesystem::path& folder)
{
    // Before the log, so that it has the head that each act names, also during a session.
    const std::vector<database::ChainedAct> acts = chainedActsOf(store);
    writeActs(acts, folder / "acts.csv");
    database::LogHead head;
    protocols::writeInPieces(
        folder / "log.csv",
        [&](const protocols::TakeBytes& take) {
            take(protocols::csvRow(
                {"sequence", "participant", "sitting", "kind", "time", "places", "commitment", "previous_hash", "hash"}));
            std::string rows;
            head = eachClearEntry(store, [&](const database::ClearEntry& entry) {
                rows += rowOf(entry);
                if (rows.size() < (std::size_t{1} << 20)) return;
                take(rows);
                rows.clear();
            });
            take(rows);
        },
        protocols::Sync::Later);
    protocols::writeWholeFile(folder / "log.txt", explanation(store.facts().name, head, acts), protocols::Sync::Later);
    return head;
}

}  // namespace study::records
