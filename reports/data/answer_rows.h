// The rows of another lab's answers, in the form that answers_csv reads: one row a participant x fabric x condition.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "protocols/answer_kind.h"
#include "protocols/files/csv_table.h"

namespace reports {

struct AnswerRowsOptions {
    std::string encoding;                                    ///< empty: found in the file
    std::vector<std::pair<std::string, std::string>> names;  ///< meaning of a column, and its name in the file
};

struct AnswerRows {
    protocols::CsvTable table;                           ///< wide
    std::map<std::string, protocols::AnswerKind> kinds;  ///< of questions that a long table holds
    std::vector<std::string> unused;                     ///< columns of a long table that are not analysed
    std::size_t voided = 0;                              ///< rows of a long table that are marked as void
    std::string taken;                                   ///< what the file was taken for; empty for a usual one
    bool isOwnExport = false;                            ///< answers.csv of this program, a public one, too
    bool hasAnchors = false;                             ///< the column "anchor" names anchors, and nothing else
    std::set<std::string> choicesRepeatedAnew;           ///< questions whose choices came again beside other foils
};

/// Reads a wide or a long table. A long one has a column `question` and one row an answer, with `correct` (right or wrong),
/// `rating` or `answer` (words), and any of `seconds`, `repetition`, `session`, `group`, `trial`, `sitting`, `voided`. The
/// answers.csv of this program is long. Its `response_seconds`, where every answer has them, are the seconds, and `place` is the
/// trial. A column `anchor` whose values are mismatched, repeated or missing marks answers to anchors; in a long table their
/// trial stands behind the word, so that two mismatches with one image stay two. A table of one question needs no column
/// `question`: it is called Q1. TRUE and FALSE, also in German and French, are read as 1 and 0 in columns of right and wrong
/// answers. Throws badInput as readForeignTable() does, for an unknown column of `names`, and for a doubled answer.
AnswerRows readAnswerRows(const std::filesystem::path& file, const AnswerRowsOptions& options, int alternatives);

/// The words that columns of right and wrong answers may hold instead of 1 and 0: "true/false, wahr/falsch, ...".
std::string wordsForScores();

}  // namespace reports
