// Long tables of answers, one row an answer, as wide ones.
#pragma once

#include <array>
#include <string_view>

#include "protocols/files/csv_table.h"
#include "reports/data/answer_rows.h"

namespace reports {

/// Columns of a long table that belong to the whole row of the wide one.
inline constexpr std::array<std::string_view, 7> keyColumns{"participant", "fabric",     "condition",  "group",
                                                            "session",     "repetition", "instruction"};

/// Writes the wide table and what was found in the long one, which has a column `question`. `rows` knows already whether the
/// table is an export of this program, and whether it has states. `alternatives`: of choices whose number the table does not
/// tell.
void writeWideTable(const protocols::CsvTable& table, int alternatives, AnswerRows& rows);

}  // namespace reports
