// A table written in three ways: CSV with full digits, HTML with rounded ones, text for a terminal. tex_table.h writes LaTeX.
#pragma once

#include <string>

#include "reports/formats/table.h"

namespace reports {

/// Text that a spreadsheet would take for a formula has an apostrophe in front (foreign_table.h).
std::string toCsv(const Table& table);
std::string toHtml(const Table& table);
std::string toText(const Table& table);

}  // namespace reports
