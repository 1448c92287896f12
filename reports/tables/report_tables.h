// The tables of the report, made from the analysed study.
#pragma once

#include "reports/analysis/study_analysis.h"
#include "reports/tables/table.h"

namespace reports {

/// One row a condition: matches and mean ± SD of every rating question.
Table overviewTable(const Json& results);
/// Matches, share, interval and the tests against chance of a choice question.
Table matchesTable(const Analysis& analysis, const std::string& question);
/// Correct matches by condition and fabric.
Table matchesByFabricTable(const Analysis& analysis, const std::string& question);
/// Mean, SD, intervals of a rating question.
Table ratingsTable(const Analysis& analysis, const std::string& question);
/// Rank and variance tests over all conditions, one row a question.
Table omnibusTable(const Analysis& analysis);
/// Paired t tests; all pairs of a question, or the planned ones of all questions.
Table comparisonsTable(const Json& results, const std::string& question);
Table plannedComparisonsTable(const Json& results);
/// Equivalence tests with their four-cell verdict, likewise.
Table equivalenceTable(const Json& results, const std::string& question);
Table plannedEquivalenceTable(const Json& results);
Table speedTable(const Analysis& analysis);
Table signalsTable(const Json& signals);
Table qualityTable(const Json& results);
/// Means with and without flagged participants; no rows while nobody is flagged.
Table screeningTable(const Analysis& analysis);
/// How often the tests of this report reject when there is nothing to find, as measured by simulation.
Table measuredSizesTable();
/// Missing answers by question and condition.
Table missingTable(const Analysis& analysis);

bool hasPlanned(const Json& results);

/// Every table that the study has, in the order of the page.
std::vector<Table> allTables(const Analysis& analysis);

}  // namespace reports
