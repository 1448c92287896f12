// A table in LaTeX that fits the text of an article: booktabs rules, a label, and notes below it.
#pragma once

#include <string>

#include "reports/formats/table.h"

namespace reports {

/// Most rows of a `table*`, which cannot continue on the next page.
inline constexpr std::size_t mostTexRows = 30;

/// Width that a table keeps to, points: the text of the class article at 10 pt.
inline constexpr double texTextWidth = 345;

/// A `table*`. It is a `longtable` where it has many rows, or needs parts (table_parts.h) because it is too wide. Needs the
/// packages array, booktabs and longtable, and fontenc T1. The size of the type and line breaks in columns of words are chosen so
/// that no line is too wide. Reasons of values that do not exist stand in a note.
std::string toTex(const Table& table);

}  // namespace reports
