// The codebook of an export: what each column of its tables is, in which unit, and which values it can have. codebook.csv and the
// metadata of a data set (psych_ds.h) are made from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocols/protocol.h"

namespace study::exports {

/// The scale of one rating question.
struct RatedQuestion {
    protocols::QuestionId question;
    double least = 0, greatest = 0;
    std::string words = {};  ///< of a Likert scale, "1 = not at all, 2 = a little"; empty without
};

/// One column of an exported table.
struct CodebookColumn {
    std::string table;  ///< without its extension: "answers"
    std::string name, type;
    std::string unit = {};                    ///< empty where there is none
    std::vector<std::string> levels = {};     ///< all possible values; empty where they cannot be listed
    std::optional<double> least = {};         ///< no value lies below
    bool exceedsLeast = false;                ///< no value equals `least`
    std::vector<RatedQuestion> ratings = {};  ///< questions whose scales the values follow
    std::string meaning = {};
};

/// Columns that a public export leaves out: what names a day, and what people said in their own words.
bool isPrivateColumn(const std::string& column);

/// The columns of answers.csv and participants.csv. `answerColumns`: those of the export, in their order; each is known
/// (asserted).
std::vector<CodebookColumn> codebookOf(const protocols::Protocol& protocol, const std::vector<protocols::FabricId>& fabrics,
                                       const std::vector<std::string>& answerColumns);

/// The columns of progress.csv, balance.csv and flags.csv of a blinded study; with `hasMeans` also those of conditions.csv.
std::vector<CodebookColumn> blindedCodebookOf(const protocols::Protocol& protocol, bool hasMeans);

/// codebook.csv: file, column, type, unit, values, meaning.
std::string codebookCsv(const std::vector<CodebookColumn>& columns);

}  // namespace study::exports
