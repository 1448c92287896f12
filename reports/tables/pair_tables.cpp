// The tables of pairs of conditions: differences and equivalence.
#include <algorithm>

#include "reports/tables/report_tables.h"

namespace reports {
namespace {

using Keep = bool (*)(const Json& row);
bool isPlanned(const Json& row) { return row.value("planned", false); }

Table comparisons(const Json& results, const std::string& question, const std::string& name, const std::string& caption)
{
    Table table{name,
                caption,
                {{"question", question.empty() ? Shown::Everywhere : Shown::InCsv},
                 "a",
                 "b",
                 "n",
                 "difference a\u2212b",
                 {"95 % CI low", Shown::InCsv},
                 {"95 % CI high", Shown::InCsv},
                 {"95 % CI", Shown::InDocuments},
                 "t",
                 "df",
                 "p",
                 "p (Holm)",
                 "d_z"},
                {}};
    for (const Json& row : results["comparisons"]) {
        if (question.empty() ? !isPlanned(row) : row["question"] != question) continue;
        const stats::Interval ci = intervalOf(row, "ci95");
        table.rows.push_back({textCell(row["question"]), conditionCell(row["a"]), conditionCell(row["b"]),
                              countCell(countOf(row, "n")), numberCell(valueOf(row, "mean_difference"), 2), numberCell(ci.low, 2),
                              numberCell(ci.high, 2), intervalCell(ci, 2), numberCell(valueOf(row, "statistic"), 2),
                              numberCell(valueOf(row, "df"), 0), pCell(valueOf(row, "p")), pCell(valueOf(row, "p_holm")),
                              numberCell(valueOf(row, "d_z"), 2)});
    }
    return table;
}

Table equivalences(const Json& results, const std::string& question, const std::string& name, const std::string& caption)
{
    Table table{name,
                caption,
                {{"question", question.empty() ? Shown::Everywhere : Shown::InCsv},
                 "a",
                 "b",
                 "n",
                 "difference a\u2212b",
                 {"90 % CI low", Shown::InCsv},
                 {"90 % CI high", Shown::InCsv},
                 {"90 % CI", Shown::InDocuments},
                 "p above low bound",
                 "p below high bound",
                 "p (TOST)",
                 "verdict"},
                {}};
    for (const Json& row : results["equivalence"]) {
        if (question.empty() ? !isPlanned(row) : row["question"] != question) continue;
        const stats::Interval ci = intervalOf(row, "ci90");
        table.rows.push_back({textCell(row["question"]), conditionCell(row["a"]), conditionCell(row["b"]),
                              countCell(countOf(row, "n")), numberCell(valueOf(row, "mean_difference"), 2), numberCell(ci.low, 2),
                              numberCell(ci.high, 2), intervalCell(ci, 2), pCell(valueOf(row, "p_lower")),
                              pCell(valueOf(row, "p_upper")), pCell(valueOf(row, "p")), textCell(row["verdict"])});
    }
    return table;
}

std::string boundsText(const Json& results)
{
    for (const Json& row : results["equivalence"])
        return shortest(row["bounds"][0].get<double>()) + " and " + shortest(row["bounds"][1].get<double>());
    return "the stated bounds";
}

}  // namespace

bool hasPlanned(const Json& results)
{
    return std::any_of(results["comparisons"].begin(), results["comparisons"].end(), isPlanned);
}

Table comparisonsTable(const Json& results, const std::string& question)
{
    return comparisons(results, question, "comparisons_" + lowerCase(question),
                       question + ": all pairs, paired t tests of the participants' means, Holm's correction over all pairs");
}

Table plannedComparisonsTable(const Json& results)
{
    return comparisons(results, "", "comparisons_planned", "Planned contrasts: paired t tests of the participants' means");
}

Table equivalenceTable(const Json& results, const std::string& question)
{
    return equivalences(results, question, "equivalence_" + lowerCase(question),
                        question + ": all pairs, two one-sided tests against " + boundsText(results) + " scale points");
}

Table plannedEquivalenceTable(const Json& results)
{
    return equivalences(results, "", "equivalence_planned",
                        "Planned contrasts: two one-sided tests against " + boundsText(results) + " scale points");
}

}  // namespace reports
