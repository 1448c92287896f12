#include "reports/tables/order_tables.h"

#include <algorithm>

#include "reports/formats/table_cells.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

const std::string foldHeading = "Order, learning and fatigue";

std::string effectText(const QuestionAnalysis& question, OrderEffectKind kind)
{
    const bool isChoice = std::holds_alternative<ChoiceAnalysis>(question.findings);
    switch (kind) {
        case OrderEffectKind::Trend:
            return isChoice ? "share correct, over 10 trials" : "rating, over 10 trials";
        case OrderEffectKind::TimeTrend:
            return "response time, over 10 trials (logarithm)";
        case OrderEffectKind::LaterSittings:
            break;
    }
    return isChoice ? "share correct, later sittings \u2212 first" : "rating, later sittings \u2212 first";
}

const QuestionAnalysis& questionOf(const StudyAnalysis& analysis, const std::string& id)
{
    return *std::ranges::find_if(analysis.questions, [&](const QuestionAnalysis& one) { return one.question.id == id; });
}

Table effectsTable(const StudyAnalysis& analysis)
{
    Table table{"order_effects",
                "Changes over trials and sittings within participants, at equal " + heldEqual(isInstructed(analysis.data)) +
                    "; for these fabrics. p corrected: Holm over all rows",
                {"question",
                 "change",
                 "participants",
                 "mean",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "df",
                 "p",
                 "p corrected"},
                {}};
    for (const QuestionOrder& order : analysis.order.questions)
        for (const OrderEffect& effect : order.effects) {
            const stats::TTest& test = effect.trend.test;
            table.rows.push_back(
                {textCell(order.question), textCell(effectText(questionOf(analysis, order.question), effect.kind)),
                 countCell(test.n), numberCell(test.estimate, 3), numberCell(test.ci.low, 3), numberCell(test.ci.high, 3),
                 intervalCell(test.ci, 3), numberCell(test.df, 0), pCell(test.p, test.logP), pCell(effect.pHolm)});
        }
    return table;
}

/// Empty where every contrast is a primary one.
std::string pickedText(const OrderEffects& effects)
{
    std::vector<std::string> picked;
    for (const QuestionOrder& order : effects.questions)
        if (order.contrast.why.empty() && order.contrast.pickedFrom > 1)
            picked.push_back(std::to_string(order.contrast.pickedFrom) + " for " + order.question);
    return picked.empty() ? std::string()
                          : ". p and intervals of the largest have Bonferroni's correction for the contrasts that it was picked "
                            "from: " +
                                listed(picked);
}

Table contrastsTable(const StudyAnalysis& analysis)
{
    Table table{"order_contrasts",
                "A contrast of each question as it is, and without each participant's own trend over the trials: the primary "
                "contrast, or the largest without a primary one. Paired t tests over participants, for these fabrics" +
                    pickedText(analysis.order),
                {"question",
                 "a",
                 "b",
                 "trend",
                 "participants",
                 "difference a\u2212b",
                 {"95 % CI low", ColumnUse::InCsv},
                 {"95 % CI high", ColumnUse::InCsv},
                 {"95 % CI", ColumnUse::InDocuments},
                 "df",
                 "p"},
                {}};
    for (const QuestionOrder& order : analysis.order.questions) {
        const ContrastWithoutTrend& contrast = order.contrast;
        if (!contrast.why.empty()) continue;
        const auto add = [&](const std::string& trend, const stats::TTest& test) {
            table.rows.push_back({textCell(order.question), conditionCell(contrast.a), conditionCell(contrast.b), textCell(trend),
                                  countCell(test.n), numberCell(test.estimate, 3), numberCell(test.ci.low, 3),
                                  numberCell(test.ci.high, 3), intervalCell(test.ci, 3), numberCell(test.df, 0),
                                  pCell(test.p, test.logP)});
        };
        add("kept", contrast.plain);
        add("removed", contrast.adjusted);
    }
    return table;
}

}  // namespace

std::vector<ReportTable> orderTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    if (analysis.order.questions.empty()) return tables;
    tables.push_back({.table = effectsTable(analysis), .section = PageSection::Quality, .foldedUnder = foldHeading});
    if (Table table = contrastsTable(analysis); !table.rows.empty())
        tables.push_back({.table = std::move(table),
                          .section = PageSection::Quality,
                          .foldedUnder = "A contrast with and without the trend over trials"});
    return tables;
}

}  // namespace reports
