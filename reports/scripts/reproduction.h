// The main tables of a report for readers who trust other programs: the analysed answers, the numbers of the report, what their
// columns mean, and scripts for R and Python that compute the numbers again and compare them.
#pragma once

#include <filesystem>
#include <string>

#include "reports/analysis/study_analysis.h"

namespace reports {

inline constexpr const char* reproductionFolder = "reproduce";

/// A row a number of the main tables: matches against chance, means of ratings, paired comparisons, equivalence, claims, and the
/// linear, logistic and ordinal mixed models. Columns section, question, a, b, low, high, quantity, value; `low` and `high` are
/// chance, the bounds of equivalence, or the unit of rounding (low). A number that does not exist is empty. Depth::Quick has no
/// ordinal models. A question whose ratings are all equal under a condition has no rows of mixed models.
std::string expectedNumbersCsv(const StudyAnalysis& analysis);

/// A row an analysed answer that is right, wrong or a number.
std::string analysedAnswersCsv(const StudyData& data);

/// Writes answers.csv, expected.csv, codebook.csv, analysis.R and analysis.py into an existing folder. Throws environmentFault.
void writeReproduction(const StudyAnalysis& analysis, const std::filesystem::path& folder);

}  // namespace reports
