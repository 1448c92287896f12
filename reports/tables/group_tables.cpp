#include "reports/tables/group_tables.h"

#include <algorithm>

#include "reports/formats/table_cells.h"
#include "reports/text/condition_label.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

constexpr const char* leftOutColumn = "fabrics left out";

TableCell leftOutCell(const std::vector<std::string>& fabrics)
{
    return fabrics.empty() ? blankCell() : textCell(listed(fabrics));
}

/// Takes the column of fabrics out where every group answered every fabric.
void dropLeftOutColumn(Table& table, const StudyAnalysis& analysis)
{
    if (!fabricsNotInEveryGroup(analysis.data, analysis.groups).empty()) {
        table.caption += ". A fabric that some group did not answer is left out";
        return;
    }
    const auto column = std::ranges::find(table.columns, leftOutColumn, &TableColumn::name) - table.columns.begin();
    table.columns.erase(table.columns.begin() + column);
    for (auto& row : table.rows) row.erase(row.begin() + column);
}

Table groupMeansTable(const StudyAnalysis& analysis)
{
    const GroupAnalysis& groups = analysis.groups;
    Table table{"group_means", "Groups of participants: means of the participants' means", {"question", "condition"}, {}};
    for (std::size_t g = 0; g < groups.groups.size(); ++g)
        table.columns.emplace_back("group " + groups.groups[g] + " (" + counted(groups.participants[g], "participant") + ")");
    table.columns.emplace_back(leftOutColumn);
    for (const GroupedQuestion& question : groups.questions)
        for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c) {
            table.rows.push_back({textCell(question.question), conditionCell(analysis.data.conditions[c])});
            for (std::size_t g = 0; g < groups.groups.size(); ++g)
                table.rows.back().push_back(numberCell(question.means[g][c], 2));
            table.rows.back().push_back(leftOutCell(question.fabricsLeftOut[c]));
        }
    dropLeftOutColumn(table, analysis);
    return table;
}

void addGroupRow(Table& table, const std::string& question, TableCell a, TableCell b, const GroupTest& test)
{
    table.rows.push_back({textCell(question), std::move(a), std::move(b), numberCell(test.difference, 2),
                          numberCell(test.ci95.low, 2), numberCell(test.ci95.high, 2), intervalCell(test.ci95, 2),
                          numberCell(test.f, 2), numberCell(test.df1, 0), numberCell(test.df2, 1), pCell(test.p),
                          pCell(test.pHolm), leftOutCell(test.fabricsLeftOut)});
}

Table groupTestsTable(const StudyAnalysis& analysis)
{
    const GroupAnalysis& groups = analysis.groups;
    const std::string first =
        groups.groups.size() == 2 ? "difference " + groups.groups[0] + " \u2212 " + groups.groups[1] : "difference";
    Table table{"group_tests",
                "Do the groups differ, for these fabrics? First row of a question: the mean over all conditions. Other rows: the "
                "difference of conditions a \u2212 b (group \u00D7 condition), with Holm's correction over these rows",
                {"question",
                 "a",
                 "b",
                 first,
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "F",
                 "df1",
                 "df2",
                 {"p", ColumnUse::InCsv},
                 "p corrected",
                 leftOutColumn},
                {}};
    for (const GroupedQuestion& question : groups.questions) {
        addGroupRow(table, question.question, textCell("all conditions"), textCell(""), question.overall);
        for (const GroupContrast& contrast : question.contrasts)
            addGroupRow(table, question.question, conditionCell(contrast.a), conditionCell(contrast.b), contrast.test);
    }
    dropLeftOutColumn(table, analysis);
    return table;
}

}  // namespace

std::vector<ReportTable> groupTables(const StudyAnalysis& analysis)
{
    if (analysis.groups.questions.empty()) return {};
    return {{.table = groupMeansTable(analysis), .section = PageSection::Groups},
            {.table = groupTestsTable(analysis), .section = PageSection::Groups}};
}

}  // namespace reports
