// A table written in four ways: CSV with full digits, LaTeX (booktabs) and HTML with rounded ones, text for a terminal.
#pragma once

#include <string>

#include "reports/formats/table.h"

namespace reports {

std::string toCsv(const Table& table);
std::string toTex(const Table& table);
std::string toHtml(const Table& table);
std::string toText(const Table& table);

}  // namespace reports
