#include "study/records/evidence/data_words.h"

#include <algorithm>
#include <array>

namespace study::records {

namespace {

constexpr AtErasure no = AtErasure::NotPersonal, stays = AtErasure::Stays, facts = AtErasure::WithFacts,
                    answers = AtErasure::WithAnswers;

constexpr ColumnWords columns[] = {
    {"study", "id", "always 1", no},
    {"study", "name", "name of the study", no},
    {"study", "protocol_json", "the protocol", no},
    {"study", "protocol_sha256", "hash of the protocol", no},
    {"study", "design_seed", "seed that drew fabrics and samples", no},
    {"study", "key_sha256", "hash of the allocation key", no},
    {"study", "station_key_sha256", "hash of the station key", no},
    {"study", "has_passphrase", "whether a passphrase seals the allocation key", no},
    {"study", "dataset_path", "folder of the data set of fabrics", no},
    {"study", "dataset_sha256", "hash of the data set", no},
    {"study", "dataset_procedural", "whether the fabrics were computed", no},
    {"study", "model_sha256", "hash of the weights that generated signals", no},
    {"study", "stamps", "sentences that every report must show", no},
    {"study", "signals_json", "generated signals compared with measured ones", no},
    {"study", "planned_balance", "balance of the running orders", no},
    {"study", "created_at", "time of making", no},
    {"study", "program_version", "version of the program", no},
    {"study", "made_with", "program, compiler, libraries and settings", no},
    {"fabrics", "position", "place in the list", no},
    {"fabrics", "id", "id of the fabric", no},
    {"fabrics", "name", "name of the fabric", no},
    {"stimuli", "file_code", "opaque name of an encrypted friction image", no},
    {"stimuli", "sha256", "hash of that file", no},
    {"slots", "number", "number of a running order", no},
    {"trials", "slot", "running order", no},
    {"trials", "number", "number of the presentation in it", no},
    {"trials", "phase", "part of the session", no},
    {"trials", "presentation_code", "code that the operator sees", no},
    {"trials", "alternatives", "fabrics on the tray", no},
    {"trials", "sealed_code", "encrypted name of the image", no},
    {"participants", "id", "code of the participant", stays},
    {"participants", "slot", "running order of the participant", stays},
    {"participants", "kind", "human, scripted or simulated", stays},
    {"participants", "state", "started, finished or withdrawn", stays},
    {"participants", "protocol_version", "version of the protocol that the session follows", stays},
    {"events", "sequence", "number of the entry in the log", stays},
    {"events", "participant", "code of the participant; empty for acts on the study", stays},
    {"events", "sitting", "number of the sitting", stays},
    {"events", "kind", "what happened, such as answered or paused", stays},
    {"events", "places", "trial, attempt and question of the stored rows", stays},
    {"events", "payload", "content, such as an answer, a reason, and the operator's name", answers},
    {"events", "at_ns", "time on the clock of the session", answers},
    {"events", "wall_time", "date and time", answers},
    {"events", "salt", "random number that keeps the commitment from being guessed", answers},
    {"events", "commitment", "hash of salt and content", stays},
    {"events", "previous_hash", "hash of the entry before", stays},
    {"events", "hash", "hash of this entry", stays},
    {"responses", "id", "number of the row", answers},
    {"responses", "event", "entry of the log", answers},
    {"responses", "participant", "code of the participant", answers},
    {"responses", "trial", "number of the presentation", answers},
    {"responses", "attempt", "which presentation of this trial", answers},
    {"responses", "question", "id of the question", answers},
    {"responses", "presentation_code", "code that the operator saw", answers},
    {"responses", "alternatives", "fabrics on the tray", answers},
    {"responses", "choice", "answer: chosen piece, same or different, or words", answers},
    {"responses", "rating_tenths", "answer: a number on the scale, in tenths", answers},
    {"responses", "ready_at", "when the presentation was ready", answers},
    {"responses", "touched_at", "when the participant touched the glass", answers},
    {"responses", "answered_at", "when the participant answered", answers},
    {"responses", "stored_at", "when the answer was stored", answers},
    {"responses", "is_correction", "whether the answer corrects an earlier one", answers},
    {"responses", "touched_by", "whether display or operator stamped the touch", answers},
    {"voids", "event", "entry of the log", answers},
    {"voids", "participant", "code of the participant", answers},
    {"voids", "trial", "number of the invalid presentation", answers},
    {"voids", "attempt", "which presentation of this trial", answers},
    {"notes", "id", "number of the row", answers},
    {"notes", "event", "entry of the log", answers},
    {"notes", "participant", "code of the participant", answers},
    {"notes", "trial", "number of the presentation", answers},
    {"notes", "attempt", "which presentation of this trial", answers},
    {"notes", "question", "question that the note concerns", answers},
    {"notes", "text", "what the operator wrote", answers},
    {"notes", "is_flag", "whether the presentation needs a check", answers},
    {"unblindings", "event", "entry of the log", no},
    {"unblindings", "who", "name of the person who unblinded the study", no},
    {"unblindings", "why", "the reason", no},
    {"unblindings", "wall_time", "date and time", no},
    {"participant_facts", "participant", "code of the participant", facts},
    {"participant_facts", "fact", "which fact, such as age, or the debriefing", facts},
    {"participant_facts", "value", "what the participant said", facts},
    {"participant_facts", "salt", "random number for the hash in the log", facts},
    {"swatches", "slot", "running order", no},
    {"swatches", "fabric", "id of the fabric", no},
    {"swatches", "code", "code on the piece of fabric", no},
    {"familiarisation", "position", "place in the list", no},
    {"familiarisation", "name", "name of a fabric for practice", no},
    {"familiarisation", "sealed_code", "encrypted name of its image", no},
    {"protocol_versions", "version", "number of a later version of the protocol", no},
    {"protocol_versions", "event", "entry of the log", no},
    {"protocol_versions", "json", "that protocol", no},
    {"protocol_versions", "sha256", "its hash", no},
    {"protocol_versions", "who", "name of the person who changed it", no},
    {"protocol_versions", "why", "the reason", no},
    {"protocol_versions", "wall_time", "date and time", no},
    {"erasures", "event", "entry of the log", no},
    {"erasures", "participant", "code of the participant", stays},
    {"erasures", "answers_too", "whether answers were erased, too", stays},
    {"erasures", "who", "name of the person who erased", stays},
    {"erasures", "why", "the reason", stays},
    {"erasures", "wall_time", "date and time", stays},
    {"acts", "number", "number of an export, backup, report or unblinding", no},
    {"acts", "kind", "which of them", no},
    {"acts", "details", "name of the person, program, computer, path, head of the log", no},
    {"acts", "wall_time", "date and time", no},
    {"acts", "previous_hash", "hash of the act before", no},
    {"acts", "hash", "hash of this act", no},
};

constexpr TableWords tables[] = {
    {"study", "facts of the study that never change"},
    {"fabrics", "fabrics of the study"},
    {"stimuli", "encrypted friction images"},
    {"slots", "running orders"},
    {"trials", "presentations of each running order"},
    {"participants", "people, under codes"},
    {"events", "the log: everything that happened, in a chain of hashes"},
    {"responses", "answers, corrections included"},
    {"voids", "invalid presentations"},
    {"notes", "notes of the operator"},
    {"unblindings", "who opened the key"},
    {"participant_facts", "facts about people, and what they said after the session"},
    {"swatches", "codes on the pieces of fabric"},
    {"familiarisation", "fabrics for practice"},
    {"protocol_versions", "changes of the protocol"},
    {"erasures", "erasures of data about people"},
    {"acts", "exports, backups, reports and unblindings, in a chain of hashes"},
};

constexpr const char* asDatabase = "not encrypted; the mode keeps other accounts out";

struct NamedFile {
    const char* begin;
    const char* end;
    const char* words;
    const char* protection;
};

/// The first line that fits counts.
constexpr NamedFile files[] = {
    {"study.db", "", "the database: everything in the tables of this sheet", asDatabase},
    {"study.db-wal", "", "write-ahead log of the database: its latest changes", asDatabase},
    {"study.db-shm", "", "index of the write-ahead log; no data", "not encrypted"},
    {".lock", "", "lock of the program that writes; no data", "not encrypted"},
    {"protocol.json", "", "the protocol; nothing about people", "not encrypted"},
    {"station-key.json", "", "the station key, which opens one image at a time; nothing about people", "not encrypted"},
    {"allocation-key.sealed", "", "who is shown which fabric and condition",
     "encrypted with the owner's passphrase (Argon2id, XChaCha20-Poly1305)"},
    {"allocation-key.json", "", "who is shown which fabric and condition", "open: not encrypted"},
    {"stimuli", "", "friction images; nothing about people", "encrypted with the station key (XChaCha20-Poly1305)"},
    {"erasures", "", "certificates of erasure, with the codes of the participants", "not encrypted"},
    {"preregistration", "", "the registered plan; nothing about people", "not encrypted"},
    {"rescue-", ".db", "rescued answers: a copy of the database", asDatabase},
    {"study-before-rescue-", ".db", "the database before a rescue: a copy with data about people", asDatabase},
    {"before-upgrade", "", "the study of an earlier version: a copy with data about people, whose files name every condition",
     "not encrypted"},
};

bool fits(const std::string& name, const NamedFile& file)
{
    const std::string begin = file.begin, end = file.end;
    const bool isPrefix = !end.empty() || begin == "preregistration" || begin == "before-upgrade";
    return isPrefix ? name.starts_with(begin) && name.ends_with(end) : name == begin;
}

}  // namespace

std::span<const ColumnWords> columnWords() { return columns; }

const ColumnWords* wordsOf(const std::string& table, const std::string& column)
{
    const auto* found =
        std::ranges::find_if(columns, [&](const ColumnWords& one) { return table == one.table && column == one.column; });
    return found == std::end(columns) ? nullptr : found;
}

std::string nameOf(AtErasure atErasure)
{
    switch (atErasure) {
        case AtErasure::NotPersonal:
            return "";
        case AtErasure::Stays:
            return "stays";
        case AtErasure::WithFacts:
            return "removed by every erasure";
        case AtErasure::WithAnswers:
            return "removed with --answers";
    }
    return {};
}

std::span<const TableWords> tableWords() { return tables; }

std::optional<FileWords> fileWords(const std::string& name)
{
    for (const NamedFile& file : files)
        if (fits(name, file)) return FileWords{file.words, file.protection};
    return std::nullopt;
}

}  // namespace study::records
