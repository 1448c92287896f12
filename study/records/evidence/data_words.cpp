#include "study/records/evidence/data_words.h"

#include <algorithm>
#include <array>

namespace study::records {

namespace {

using enum AtErasure;

constexpr ColumnWords allColumnWords[] = {
    {"study", "id", "always 1", NotPersonal},
    {"study", "name", "name of the study", NotPersonal},
    {"study", "protocol_json", "the protocol", NotPersonal},
    {"study", "protocol_sha256", "hash of the protocol", NotPersonal},
    {"study", "design_seed", "seed that drew fabrics and samples", NotPersonal},
    {"study", "key_sha256", "hash of the allocation key", NotPersonal},
    {"study", "station_key_sha256", "hash of the station key", NotPersonal},
    {"study", "has_passphrase", "whether a passphrase seals the allocation key", NotPersonal},
    {"study", "dataset_path", "folder of the data set of fabrics", NotPersonal},
    {"study", "dataset_sha256", "hash of the data set", NotPersonal},
    {"study", "dataset_procedural", "whether the fabrics were computed", NotPersonal},
    {"study", "model_sha256", "hash of the weights that generated signals", NotPersonal},
    {"study", "stamps", "sentences that every report must show", NotPersonal},
    {"study", "signals_json", "generated signals compared with measured ones", NotPersonal},
    {"study", "planned_balance", "balance of other running orders by the same rules", NotPersonal},
    {"study", "created_at", "time of making", NotPersonal},
    {"study", "program_version", "version of the program", NotPersonal},
    {"study", "made_with", "program, compiler, libraries and settings", NotPersonal},
    {"fabrics", "position", "place in the list", NotPersonal},
    {"fabrics", "id", "id of the fabric", NotPersonal},
    {"fabrics", "name", "name of the fabric", NotPersonal},
    {"stimuli", "file_code", "opaque name of an encrypted friction image", NotPersonal},
    {"stimuli", "sha256", "hash of that file", NotPersonal},
    {"slots", "number", "number of a running order", NotPersonal},
    {"trials", "slot", "running order", NotPersonal},
    {"trials", "number", "number of the presentation in it", NotPersonal},
    {"trials", "phase", "part of the session", NotPersonal},
    {"trials", "presentation_code", "code that the operator sees", NotPersonal},
    {"trials", "alternatives", "fabrics on the tray", NotPersonal},
    {"trials", "sealed_code", "encrypted name of the image", NotPersonal},
    {"trials", "instruction", "instruction of the block, such as to be fast", NotPersonal},
    {"trials", "aim", "whether it asks for speed or accuracy", NotPersonal},
    {"trials", "deadline_ms", "time that the instruction leaves for an answer", NotPersonal},
    {"participants", "id", "code of the participant", Stays},
    {"participants", "slot", "running order of the participant", Stays},
    {"participants", "kind", "human, scripted or simulated", Stays},
    {"participants", "state", "started, finished or withdrawn", Stays},
    {"participants", "protocol_version", "version of the protocol that the session follows", Stays},
    {"events", "sequence", "number of the entry in the log", Stays},
    {"events", "participant", "code of the participant; empty for acts on the study", Stays},
    {"events", "sitting", "number of the sitting", Stays},
    {"events", "kind", "what happened, such as answered or paused", Stays},
    {"events", "places", "trial, attempt and question of the stored rows", Stays},
    {"events", "payload", "content, such as an answer, a reason, and the operator's name; that of the enrolment stays",
     WithAnswers},
    {"events", "at_ns", "time on the clock of the session", WithAnswers},
    {"events", "wall_time", "date and time; that of the enrolment stays", WithAnswers},
    {"events", "salt", "random number that keeps the commitment from being guessed", WithAnswers},
    {"events", "commitment", "hash of salt and content", Stays},
    {"events", "previous_hash", "hash of the entry before", Stays},
    {"events", "hash", "hash of this entry", Stays},
    {"responses", "id", "number of the row", WithAnswers},
    {"responses", "event", "entry of the log", WithAnswers},
    {"responses", "participant", "code of the participant", WithAnswers},
    {"responses", "trial", "number of the presentation", WithAnswers},
    {"responses", "attempt", "which presentation of this trial", WithAnswers},
    {"responses", "question", "id of the question", WithAnswers},
    {"responses", "presentation_code", "code that the operator saw", WithAnswers},
    {"responses", "alternatives", "fabrics on the tray", WithAnswers},
    {"responses", "choice", "answer: chosen piece, same or different, or words", WithAnswers},
    {"responses", "rating_tenths", "answer: a number on the scale, in tenths", WithAnswers},
    {"responses", "ready_at", "when the question was ready", WithAnswers},
    {"responses", "touched_at", "when the participant touched the glass", WithAnswers},
    {"responses", "answered_at", "when the participant answered", WithAnswers},
    {"responses", "stored_at", "when the answer was stored", WithAnswers},
    {"responses", "is_correction", "whether the answer corrects an earlier one", WithAnswers},
    {"responses", "touched_by", "whether display or operator stamped the touch", WithAnswers},
    {"responses", "touch_ended_at", "when the finger left the display", WithAnswers},
    {"responses", "answer_begun_at", "when the answer began", WithAnswers},
    {"responses", "answer_begun_by", "what marked the beginning of the answer", WithAnswers},
    {"responses", "entries", "how often the answer was entered until two entries agreed", WithAnswers},
    {"voids", "event", "entry of the log", WithAnswers},
    {"voids", "participant", "code of the participant", WithAnswers},
    {"voids", "trial", "number of the invalid presentation", WithAnswers},
    {"voids", "attempt", "which presentation of this trial", WithAnswers},
    {"notes", "id", "number of the row", WithAnswers},
    {"notes", "event", "entry of the log", WithAnswers},
    {"notes", "participant", "code of the participant", WithAnswers},
    {"notes", "trial", "number of the presentation", WithAnswers},
    {"notes", "attempt", "which presentation of this trial", WithAnswers},
    {"notes", "question", "question that the note concerns", WithAnswers},
    {"notes", "text", "what the operator wrote", WithAnswers},
    {"notes", "is_flag", "whether the presentation needs a check", WithAnswers},
    {"finger_samples", "id", "number of the row", WithAnswers},
    {"finger_samples", "event", "entry of the log", WithAnswers},
    {"finger_samples", "participant", "code of the participant", WithAnswers},
    {"finger_samples", "trial", "number of the presentation", WithAnswers},
    {"finger_samples", "attempt", "which presentation of this trial", WithAnswers},
    {"finger_samples", "began_at", "when the first sample was taken", WithAnswers},
    {"finger_samples", "count", "number of samples", WithAnswers},
    {"finger_samples", "left_out", "samples that were too many or too close to each other", WithAnswers},
    {"finger_samples", "samples", "where the finger was on the display, and its force, over time", WithAnswers},
    {"unblindings", "event", "entry of the log", NotPersonal},
    {"unblindings", "who", "name of the person who unblinded the study", NotPersonal},
    {"unblindings", "why", "the reason", NotPersonal},
    {"unblindings", "wall_time", "date and time", NotPersonal},
    {"participant_facts", "participant", "code of the participant", WithFacts},
    {"participant_facts", "fact", "which fact, such as age, or the debriefing", WithFacts},
    {"participant_facts", "value", "what the participant said", WithFacts},
    {"participant_facts", "salt", "random number for the hash in the log", WithFacts},
    {"swatches", "slot", "running order", NotPersonal},
    {"swatches", "fabric", "id of the fabric", NotPersonal},
    {"swatches", "code", "code on the piece of fabric", NotPersonal},
    {"familiarisation", "position", "place in the list", NotPersonal},
    {"familiarisation", "name", "name of a fabric for practice", NotPersonal},
    {"familiarisation", "sealed_code", "encrypted name of its image", NotPersonal},
    {"protocol_versions", "version", "number of a later version of the protocol", NotPersonal},
    {"protocol_versions", "event", "entry of the log", NotPersonal},
    {"protocol_versions", "json", "that protocol", NotPersonal},
    {"protocol_versions", "sha256", "its hash", NotPersonal},
    {"protocol_versions", "who", "name of the person who changed it", NotPersonal},
    {"protocol_versions", "why", "the reason", NotPersonal},
    {"protocol_versions", "wall_time", "date and time", NotPersonal},
    {"erasures", "event", "entry of the log", NotPersonal},
    {"erasures", "participant", "code of the participant", Stays},
    {"erasures", "answers_too", "whether answers were erased, too", Stays},
    {"erasures", "who", "name of the person who erased", Stays},
    {"erasures", "why", "the reason", Stays},
    {"erasures", "wall_time", "date and time", Stays},
    {"acts", "number", "number of an export, backup, report or unblinding", NotPersonal},
    {"acts", "kind", "which of them", NotPersonal},
    {"acts", "details",
     "name of the person, program, computer, path, head of the log; of a hand-over the code of the participant", Stays},
    {"acts", "wall_time", "date and time", NotPersonal},
    {"acts", "previous_hash", "hash of the act before", NotPersonal},
    {"acts", "hash", "hash of this act", NotPersonal},
};

constexpr TableWords allTableWords[] = {
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
    {"finger_samples", "what the display measured of the finger, up to each answer"},
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
constexpr NamedFile allFileWords[] = {
    {"study.db", "", "the database: everything in the tables of this sheet", asDatabase},
    {"study.db-wal", "", "write-ahead log of the database: its latest changes", asDatabase},
    {"study.db-shm", "", "index of the write-ahead log; no data", "not encrypted"},
    {".lock", "", "lock of the program that writes: its process and computer; nothing about people", "not encrypted"},
    {"queue.db", "", "answers of this computer that wait for the server", asDatabase},
    {"queue.db-wal", "", "write-ahead log of the queue: its latest changes", asDatabase},
    {"queue.db-shm", "", "index of the queue's log; no data", "not encrypted"},
    {"not-sent-", ".json", "answers that the server did not take, or that were given up at a move: read them, then delete them",
     "not encrypted"},
    {"held-", ".json", "entries of a session that could not go on with the server: read them, then delete them", "not encrypted"},
    {"server.json", "", "address of the server and the token of this folder; nothing about people", "not encrypted"},
    {"protocol.json", "", "the protocol; nothing about people", "not encrypted"},
    {"station-key.json", "", "the station key, which opens one image at a time; nothing about people", "not encrypted"},
    {"allocation-key.sealed", "", "who is shown which fabric and condition",
     "encrypted with the owner's passphrase (Argon2id, XChaCha20-Poly1305)"},
    {"masked-key.json", "", "the masked label of each image of an earlier version; nothing about people", "open: not encrypted"},
    {"allocation-key.json", "", "who is shown which fabric and condition", "open: not encrypted"},
    {"stimuli", "", "friction images; nothing about people", "encrypted with the station key (XChaCha20-Poly1305)"},
    {"prompts", "", "recordings for the headphones; nothing about the participants", "not encrypted"},
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

std::span<const ColumnWords> columnWords() { return allColumnWords; }

const ColumnWords* wordsOf(const std::string& table, const std::string& column)
{
    const auto* found =
        std::ranges::find_if(allColumnWords, [&](const ColumnWords& one) { return table == one.table && column == one.column; });
    return found == std::end(allColumnWords) ? nullptr : found;
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

std::span<const TableWords> tableWords() { return allTableWords; }

std::optional<FileWords> fileWords(const std::string& name)
{
    for (const NamedFile& file : allFileWords)
        if (fits(name, file)) return FileWords{file.words, file.protection};
    return std::nullopt;
}

}  // namespace study::records
