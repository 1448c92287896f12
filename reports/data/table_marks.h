// Columns of a table of answers that are known by what they hold: their names alone could mean something else in another lab.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/files/csv_table.h"

namespace reports {

inline constexpr const char* anchorColumn = "anchor";
inline constexpr const char* stateColumn = "state";
inline constexpr const char* kindColumn = "kind";

/// Whether the table is `answers.csv` of this program, also a public one, which has no times of day. Either it has the columns
/// that only an export has together (those of versions before 0.7.0 had fewer), or, where somebody took some of them out, its
/// states and its trays are those of an export.
bool isExport(const protocols::CsvTable& table);

/// Whether `anchor` holds only kinds of anchors and missing values.
bool namesAnchors(const protocols::CsvTable& table);

/// Whether `state` holds only started, finished and withdrawn, as in an export.
bool namesStates(const protocols::CsvTable& table);

/// Whether `kind` holds only human, scripted and simulated, as in an export.
bool namesKinds(const protocols::CsvTable& table);

/// Whether a column is called "Q2" and the like, which needs no protocol to be known as a question.
bool isUsualQuestion(std::string_view name);

/// The pieces in a list as an export writes it: ["F02","F01"] has F02 and F01. Ids hold no commas. Empty for any other text.
std::vector<std::string> piecesIn(std::string_view list);

/// The questions of a long table whose `alternatives` (a list as JSON, as an export writes it) hold other pieces where a choice
/// comes a second time.
std::set<std::string> questionsRepeatedAnew(const protocols::CsvTable& table);

}  // namespace reports
