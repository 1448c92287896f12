// The report of a blinded study whose key nobody opened: progress, balance and flags, and nothing of any condition or fabric.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/formats/table.h"

namespace reports {

struct ProgressReport {
    std::string study;
    std::vector<std::string> sentences;  ///< above the tables
    std::vector<Table> tables;
    std::string results;  ///< the text of results.json
};

/// Writes index.html (self-contained), results.json and tables/*.csv into `folder`, under the rules of writeReport().
void writeProgressReport(const ProgressReport& report, const std::filesystem::path& folder);

}  // namespace reports
