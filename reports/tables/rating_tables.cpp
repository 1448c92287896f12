#include "reports/tables/rating_tables.h"

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using RatingQuestion = AnalysedQuestion<RatingAnalysis>;

/// The lowest and the highest mean that answers to the question can have.
void addAnchorRows(Table& table, const QuestionAnchors& anchors)
{
    if (anchors.floor) {
        const AnchorFloor& floor = *anchors.floor;
        table.rows.push_back({textCell("floor: another fabric"), countCell(floor.ratings), meanSdCell(floor.mean, floor.sd, 2),
                              numberCell(floor.sd, 2), countCell(floor.participants), numberCell(floor.meanOfParticipants, 2),
                              numberCell(floor.ci95.low, 2), numberCell(floor.ci95.high, 2), intervalCell(floor.ci95, 2),
                              blankCell()});
    }
    if (anchors.ratings) {
        const stats::Estimate& ceiling = anchors.ratings->meanCeiling;
        table.rows.push_back({textCell("ceiling: noise of the answers"), blankCell(), numberCell(ceiling.value, 2), blankCell(),
                              countCell(anchors.ratings->participants), blankCell(), numberCell(ceiling.ci95.low, 2),
                              numberCell(ceiling.ci95.high, 2), intervalCell(ceiling.ci95, 2), blankCell()});
    }
}

Table ratingsTable(const StudyAnalysis& analysis, const RatingQuestion& question)
{
    const bool isUnequal = haveUnequalCounts(question.findings);
    Table table{lowerCase(question.id()) + "_ratings",
                question.id() + ": ratings, with the 95 % interval of the participants' means",
                {"condition",
                 "ratings",
                 "mean \u00B1 SD",
                 {"sd", ColumnUse::InCsv},
                 "participants",
                 {"mean of participants", isUnequal ? ColumnUse::Everywhere : ColumnUse::InCsv},
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "within-subject half-width"},
                {}};
    for (std::size_t i = 0; i < analysis.data.conditions.size(); ++i) {
        const ConditionRatings& ratings = question.findings.conditions[i];
        table.rows.push_back({conditionCell(analysis.data.conditions[i]), countCell(ratings.ratings),
                              meanSdCell(ratings.mean, ratings.sd, 2), numberCell(ratings.sd, 2), countCell(ratings.participants),
                              numberCell(ratings.meanOfParticipants, 2), numberCell(ratings.ci95.low, 2),
                              numberCell(ratings.ci95.high, 2), intervalCell(ratings.ci95, 2),
                              numberCell(ratings.withinHalfWidth, 2)});
    }
    if (const QuestionAnchors* anchors = anchorsOf(analysis.anchors, question.id())) addAnchorRows(table, *anchors);
    return table;
}

/// One row a question: how low and how high its answers can lie, and how well they agree with themselves.
Table anchorsTable(const StudyAnalysis& analysis)
{
    Table table{"anchors",
                "Anchors: floor of the ratings (mismatched presentations), test\u2013retest reliability (ICC(2,1) of ratings, "
                "kappa of choices), and ceiling of the mean rating or of the share correct. 95 % intervals",
                {"question",
                 "mismatched",
                 "floor",
                 {"floor low", ColumnUse::InCsv},
                 {"floor high", ColumnUse::InCsv},
                 {"95 % CI, floor", ColumnUse::InDocuments},
                 "above lowest condition",
                 "pairs",
                 "reliability",
                 {"reliability low", ColumnUse::InCsv},
                 {"reliability high", ColumnUse::InCsv},
                 {"95 % CI, reliability", ColumnUse::InDocuments},
                 "ceiling",
                 {"ceiling low", ColumnUse::InCsv},
                 {"ceiling high", ColumnUse::InCsv},
                 {"95 % CI, ceiling", ColumnUse::InDocuments}},
                {}};
    const auto addEstimate = [](std::vector<TableCell>& row, const stats::Value& value, const stats::Interval& ci) {
        for (TableCell cell : {numberCell(value, 2), numberCell(ci.low, 2), numberCell(ci.high, 2), intervalCell(ci, 2)})
            row.push_back(std::move(cell));
    };
    for (const QuestionAnchors& anchors : analysis.anchors) {
        std::vector<TableCell> row{textCell(anchors.question)};
        row.push_back(anchors.floor ? countCell(anchors.floor->ratings) : blankCell());
        if (anchors.floor)
            addEstimate(row, anchors.floor->meanOfParticipants, anchors.floor->ci95);
        else
            row.resize(row.size() + 4, blankCell());
        row.push_back(anchors.floor ? numberCell(anchors.floor->shareAbove, 2) : blankCell());
        const stats::Value none = stats::Value::undefined(anchors.noPairs);
        const stats::Estimate noEstimate{none, {none, none}};
        const bool isWithout = !anchors.noPairs.empty();  // choices came twice, and nothing of them can be compared
        const stats::Estimate* ceiling = isWithout ? &noEstimate : ceilingOf(anchors);
        row.push_back(isWithout            ? countCell(0)
                      : ceiling == nullptr ? blankCell()
                                           : countCell(anchors.ratings ? anchors.ratings->pairs : anchors.choices->pairs));
        for (const stats::Estimate* estimate : {isWithout ? &noEstimate : reliabilityOf(anchors), ceiling})
            if (estimate != nullptr)
                addEstimate(row, estimate->value, estimate->ci95);
            else
                row.resize(row.size() + 4, blankCell());
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// What the first and the second ratings of the same presentations differ by.
Table retestTable(const StudyAnalysis& analysis)
{
    Table table{
        "anchors_retest",
        "Ratings of presentations that came twice. Shift: second minus first, mean of the participants' means. The limits "
        "hold 95 % of the differences of single ratings",
        {"question",
         "pairs",
         "within-participant SD",
         {"SD low", ColumnUse::InCsv},
         {"SD high", ColumnUse::InCsv},
         {"95 % CI, SD", ColumnUse::InDocuments},
         "shift",
         {"shift low", ColumnUse::InCsv},
         {"shift high", ColumnUse::InCsv},
         {"95 % CI, shift", ColumnUse::InDocuments},
         "p shift",
         "p no shift (TOST)",
         {"limit low", ColumnUse::InCsv},
         {"limit high", ColumnUse::InCsv},
         {"limits of agreement", ColumnUse::InDocuments},
         "ceiling of correlation"},
        {}};
    for (const QuestionAnchors& anchors : analysis.anchors) {
        if (!anchors.ratings) continue;
        const stats::RatingReliability& found = *anchors.ratings;
        table.rows.push_back({textCell(anchors.question), countCell(found.pairs), numberCell(found.withinSd.value, 2),
                              numberCell(found.withinSd.ci95.low, 2), numberCell(found.withinSd.ci95.high, 2),
                              intervalCell(found.withinSd.ci95, 2), numberCell(found.bias.estimate, 2),
                              numberCell(found.bias.ci.low, 2), numberCell(found.bias.ci.high, 2), intervalCell(found.bias.ci, 2),
                              pCell(found.bias.p, found.bias.logP), pCell(found.biasEquivalence.p, found.biasEquivalence.logP),
                              numberCell(found.limitsOfAgreement.low, 2), numberCell(found.limitsOfAgreement.high, 2),
                              intervalCell(found.limitsOfAgreement, 2), numberCell(found.correlationCeiling.value, 2)});
    }
    return table;
}

}  // namespace

std::vector<ReportTable> ratingTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    const auto questions = questionsWith<RatingAnalysis>(analysis);
    for (const RatingQuestion& question : questions)
        tables.push_back({.table = ratingsTable(analysis, question), .section = PageSection::Ratings, .question = question.id()});
    if (analysis.anchors.empty()) return tables;
    tables.push_back(
        {.table = anchorsTable(analysis), .section = questions.empty() ? PageSection::Matches : PageSection::Ratings});
    if (Table retest = retestTable(analysis); !retest.rows.empty())
        tables.push_back(
            {.table = std::move(retest), .section = PageSection::Ratings, .foldedUnder = "Presentations that came twice"});
    return tables;
}

}  // namespace reports
