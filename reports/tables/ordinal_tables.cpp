#include "reports/tables/ordinal_tables.h"

#include <cmath>

#include "reports/formats/table_cells.h"

namespace reports {
namespace {

stats::Value oddsRatio(const stats::Value& logOdds) { return logOdds.exists() ? stats::Value(std::exp(*logOdds)) : logOdds; }

stats::Interval oddsRatio(const stats::Interval& logOdds) { return {oddsRatio(logOdds.low), oddsRatio(logOdds.high)}; }

/// The SDs of the random intercepts stand in the same column as the odds ratios.
void addOrdinalRows(Table& table, const std::string& id, const stats::OrdinalRatingModel& fitted)
{
    const stats::OrdinalMixedModel& model = fitted.model;
    for (std::size_t i = 0; i < model.fixed.size(); ++i) {
        const stats::LogOdds& effect = model.fixed[i];
        const stats::Interval ci = oddsRatio(effect.ci);
        table.rows.push_back({textCell(id), conditionCell(fitted.conditions[i + 1]), conditionCell(fitted.conditions.front()),
                              textCell("odds ratio"), numberCell(oddsRatio(effect.estimate), 2), numberCell(ci.low, 2),
                              numberCell(ci.high, 2), intervalCell(ci, 2), pCell(effect.p, effect.logP)});
    }
    for (const stats::RandomIntercept& effect : model.random)
        table.rows.push_back({textCell(id), textCell(effect.name), textCell("-"),
                              textCell(effect.zero ? "SD, log odds (singular)" : "SD, log odds"), numberCell(effect.sd, 2),
                              blankCell(), blankCell(), blankCell(), blankCell()});
}

void addOrdinalReason(Table& table, const std::string& id, const std::string& why)
{
    const stats::Value none = stats::Value::undefined(why);
    table.rows.push_back({textCell(id), textCell("-"), textCell("-"), textCell(why), numberCell(none, 2), numberCell(none, 2),
                          numberCell(none, 2), intervalCell({none, none}, 2), pCell(none)});
}

std::string ordinalCaption(const StudyAnalysis& analysis)
{
    std::string rounding;
    for (const auto& question : questionsWith<RatingAnalysis>(analysis))
        rounding += (rounding.empty() ? "" : "; ") + question.id() + " rounded " + roundingWords(question.findings.ordinal.unit);
    return "Odds of a higher rating by a cumulative logit mixed model (" + rounding +
           "). They hold for new participants and fabrics that vary alike under all conditions. No claim rests on them";
}

}  // namespace

std::vector<ReportTable> ordinalTables(const StudyAnalysis& analysis)
{
    if (analysis.depth == Depth::Quick) return {};
    Table table{"ordinal_models",
                ordinalCaption(analysis),
                {"question",
                 "condition or group",
                 "against",
                 "quantity",
                 "estimate",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "p"},
                {}};
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) {
        const OrdinalRatings& ordinal = question.findings.ordinal;
        if (ordinal.why.empty())
            addOrdinalRows(table, question.id(), ordinal.fitted);
        else
            addOrdinalReason(table, question.id(), ordinal.why);
    }
    if (table.rows.empty()) return {};
    return {{.table = std::move(table), .section = PageSection::Ratings, .foldedUnder = "Ratings as ordered categories"}};
}

}  // namespace reports
