// The rows of another lab's answers, in the form that answers_csv reads: one row a participant x fabric x condition.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocols/answer_kind.h"
#include "protocols/files/csv_table.h"
#include "reports/data/study_data.h"

namespace reports {

struct AnswerRowsOptions {
    std::string encoding;                                    ///< empty: found in the file
    std::vector<std::pair<std::string, std::string>> names;  ///< meaning of a column, and its name in the file
};

/// What a column of the wide table holds that was made from a long one.
struct MadeColumn {
    enum class Part { Value, Seconds, Answer, Trial, Sitting, Slot, TouchedBy, Entries, Late };  ///< the last four: own exports
    std::string question;
    Part part = Part::Value;
};

struct AnswerRows {
    protocols::CsvTable table;                           ///< wide
    std::map<std::size_t, MadeColumn> made;              ///< columns of a long table's questions
    std::map<std::string, protocols::AnswerKind> kinds;  ///< of questions that a long table holds
    std::set<std::string> assumedChoices;                ///< questions of a long table that does not tell their alternatives
    /// Of the choices of an own export: the pieces on their trays (0: unknown), and the first row with each number. Trays of
    /// catch trials and anchors do not count.
    std::map<std::string, std::map<int, std::string>> trays;
    std::map<std::string, std::vector<bool>> given;  ///< questions in words of an own export: rows that are answers
    std::vector<std::string> unused;                 ///< columns of a long table that are not analysed
    std::size_t voided = 0;                          ///< rows marked as void, or their presentations
    bool namesPresentations = false;                 ///< an own export with the columns `trial` and `attempt`
    std::size_t ofWithdrawn = 0;                     ///< rows by participants who withdrew
    std::size_t wordsAlone = 0;                      ///< rows with words, of questions with choices or ratings
    bool hasStates = false;                          ///< the column "state" tells who withdrew
    std::set<std::string> answeredBy;                ///< "human", "scripted", "simulated"; empty where no column tells
    TimesTaken times = TimesTaken::AsRecorded;       ///< what the seconds are
    std::string taken;                               ///< what the file was taken for; empty for a usual one
    bool isOwnExport = false;                        ///< answers.csv of this program, a public one, too
    bool hasAnchors = false;                         ///< the column "anchor" names anchors, and nothing else
    std::set<std::string> choicesRepeatedAnew;       ///< questions whose choices came again beside other foils
};

/// Reads a wide or a long table. A long one has a column `question` and one row an answer, with `correct` (right or wrong),
/// `rating` or `answer` (words), and any of `seconds`, `repetition`, `session`, `group`, `trial`, `sitting`, `voided`. The
/// answers.csv of this program is long. `place` is its trial, `alternatives` tells how many answers a choice had, and every row
/// of a question in words is an answer, also an empty one. Its seconds are `response_seconds`, unless whole sittings have no
/// stamps of the beginning of answers (SittingStamps). The same holds for such a column of another long table. Rows whose `state`
/// is withdrawn are left out, where the column has only the words of an export; `kind` tells who answered. A column `anchor`
/// whose values are mismatched, repeated or missing marks answers to anchors; in a long table their trial stands behind the word,
/// so that two mismatches with one image stay two. A table of one question needs no column `question`: it is called Q1. TRUE and
/// FALSE, also in German and French, are read as 1 and 0 in columns of right and wrong answers, and in `voided` and `late`. Names
/// of participants, fabrics, conditions and the like lose the blanks at their ends. Throws badInput as readForeignTable() does,
/// for an unknown column of `names`, for a doubled answer, for a question with both choices and ratings, for more than 200
/// questions (10,000 in an own export), and where the wide table would have more than 20 million cells.
AnswerRows readAnswerRows(const std::filesystem::path& file, const AnswerRowsOptions& options, int alternatives);

/// A name without the blanks, tabs and no-break spaces that a spreadsheet leaves at its ends.
std::string_view nameWithoutBlanks(std::string_view cell);

/// The words that such columns may hold instead of 1 and 0: "true/false, wahr/falsch, ...".
std::string wordsForScores();

}  // namespace reports
