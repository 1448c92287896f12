// What each column of study.db and each file of a study folder holds, in words, and what an erasure does to it.
#pragma once

#include <optional>
#include <span>
#include <string>

namespace study::records {

/// What becomes of a value that concerns a participant.
enum class AtErasure {
    NotPersonal,  ///< concerns the study, or the people who run it
    Stays,        ///< needed to verify the rest: which entry it was, and that it was erased
    WithFacts,    ///< removed by every erasure
    WithAnswers,  ///< removed by an erasure with --answers
};

struct ColumnWords {
    const char* table;
    const char* column;
    const char* words;
    AtErasure atErasure;
};

/// All columns of the schema, in its order; a test compares them with the schema.
std::span<const ColumnWords> columnWords();
/// Null where the program does not know the column.
const ColumnWords* wordsOf(const std::string& table, const std::string& column);

/// "stays", "removed by every erasure" or "removed with --answers"; empty for what is not personal.
std::string nameOf(AtErasure atErasure);

struct TableWords {
    const char* table;
    const char* words;
};
std::span<const TableWords> tableWords();

struct FileWords {
    std::string words;
    std::string protection;  ///< "encrypted: ...", "not encrypted"
};
/// The file or folder of this name in a study folder; empty where it does not belong there.
std::optional<FileWords> fileWords(const std::string& name);

}  // namespace study::records
