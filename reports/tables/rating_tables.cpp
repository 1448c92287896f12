#include "reports/tables/rating_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using RatingQuestion = AnalysedQuestion<RatingAnalysis>;

Table ratingsTable(const StudyAnalysis& analysis, const RatingQuestion& question)
{
    Table table{lowerCase(question.id()) + "_ratings",
                question.id() + ": ratings, with the 95 % interval of the participants' means",
                {"condition",
                 "ratings",
                 "mean \u00B1 SD",
                 {"sd", ColumnUse::InCsv},
                 "participants",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "within-subject half-width"},
                {}};
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        const ConditionRatings& ratings = question.findings.conditions[i];
        table.rows.push_back({conditionCell(analysis.data.conditions[i]), countCell(ratings.ratings),
                              meanSdCell(ratings.mean, ratings.sd, 2), numberCell(ratings.sd, 2), countCell(ratings.participants),
                              numberCell(ratings.ci95.low, 2), numberCell(ratings.ci95.high, 2), intervalCell(ratings.ci95, 2),
                              numberCell(ratings.withinHalfWidth, 2)});
    }
    return table;
}

}  // namespace

std::vector<ReportTable> ratingTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    for (const RatingQuestion& question : questionsWith<RatingAnalysis>(analysis))
        tables.push_back({.table = ratingsTable(analysis, question), .section = PageSection::Ratings, .question = question.id()});
    return tables;
}

}  // namespace reports
