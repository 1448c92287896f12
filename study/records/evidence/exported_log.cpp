#include "study/records/evidence/exported_log.h"

#include "database/evidence/clear_log.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"

namespace study::records {

namespace {

/// Python 3 without any package. The test runs it on the exported file.
constexpr const char* recipe = R"(import csv, hashlib, sys

def field(text):
    data = text.encode("utf-8")
    return str(len(data)).encode() + b":" + data + b","

previous, count = "", 0
for row in csv.DictReader(open(sys.argv[1], newline="", encoding="utf-8")):
    parts = [previous, row["sequence"], row["participant"], row["sitting"], row["kind"], row["places"], row["commitment"]]
    own = hashlib.sha256(b"".join(field(part) for part in parts)).hexdigest()
    count += 1
    if row["sequence"] != str(count) or row["previous_hash"] != previous or row["hash"] != own:
        sys.exit("entry " + row["sequence"] + " was altered, or one before it is missing")
    previous = own
print(str(count) + ":" + previous)
)";

std::string rowOf(const database::ClearEntry& entry)
{
    return protocols::csvRow({std::to_string(entry.sequence), entry.participant, std::to_string(entry.sitting), entry.kind,
                              entry.wallTime, entry.places, entry.commitment, entry.previous, entry.hash});
}

std::string explanation(const std::string& study, const database::LogHead& head)
{
    return "The log of the study " + protocols::printable(study) + "\n\nHead: " + textOf(head) +
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
           "Each of these fields enters the hash as UTF-8: its length in bytes, a colon, its bytes, a comma. The last hash is "
           "the\n"
           "head, which commits to every entry. The time is covered by the commitment only. Content and salts are not exported:\n"
           "`vis2hap verify` compares them with the commitments in the study itself. Cells of log.csv are quoted as in RFC "
           "4180.\n\n"
           "This program computes the head again (python3 check.py log.csv). Compare its output with a head that somebody kept\n"
           "elsewhere, such as in the laboratory book: the file alone cannot show that it is the true log.\n\n" +
           recipe;
}

}  // namespace

database::LogHead writeExportedLog(const database::StudyStore& store, const std::filesystem::path& folder)
{
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
    protocols::writeWholeFile(folder / "log.txt", explanation(store.facts().name, head), protocols::Sync::Later);
    return head;
}

}  // namespace study::records
