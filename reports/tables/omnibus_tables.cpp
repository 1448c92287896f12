#include "reports/tables/omnibus_tables.h"

#include "reports/tables/table_cells.h"
#include "reports/text/number_text.h"

namespace reports {
namespace {

/// "8, 72".
TableCell dfCell(const stats::Value& first, const stats::Value& second)
{
    return numericTextCell(first.exists() && second.exists() ? fixed(*first, 0) + ", " + fixed(*second, 0) : "-");
}

/// "partial eta squared 0.12", or the reason why there is none.
TableCell effectCell(const std::string& name, const stats::Value& value)
{
    return textCell(value.exists() ? name + " " + fixed(*value, 2) : value.why());
}

/// Remark on a mixed model: a singular fit, or random effects that were left out.
std::string noteOn(bool isSingular, const std::vector<stats::LeftOut>& leftOut)
{
    if (isSingular) return "singular: a random effect was estimated as zero";
    return leftOut.empty() ? "new participants and fabrics" : "without random effects that cannot be estimated";
}

std::string noteOn(const stats::ChoiceModel& fitted)
{
    const stats::LogisticMixedModel& model = fitted.model;
    if (model.why.empty() && model.separation != stats::Separation::None) return "separation: " + model.separationWhy;
    return noteOn(model.why.empty() && model.singular, fitted.leftOut);
}

std::string noteOn(const stats::RatingModel& fitted)
{
    return noteOn(fitted.model.why.empty() && fitted.model.singular, fitted.leftOut);
}

/// A model that was not fitted has no test, but a reason.
stats::Value fittedOr(const std::string& why, const stats::Value& value)
{
    return why.empty() ? value : stats::Value::undefined(why);
}

void addLinearModelRow(Table& table, const std::string& id, const std::string& name, const stats::RatingModel& fitted)
{
    const stats::MixedModel& model = fitted.model;
    const stats::FTest& test = fitted.condition;
    table.rows.push_back({textCell(id), textCell(name), countCell(model.why.empty() ? model.rows : 0),
                          numberCell(fittedOr(model.why, test.f), 2),
                          dfCell(fittedOr(model.why, test.df1), fittedOr(model.why, test.df2)),
                          pCell(fittedOr(model.why, test.p), test.logP), blankCell(), textCell(noteOn(fitted))});
}

void addLogisticRow(Table& table, const std::string& id, const std::string& name, const stats::ChoiceModel& fitted)
{
    const stats::LogisticMixedModel& model = fitted.model;
    table.rows.push_back({textCell(id), textCell(name), countCell(model.why.empty() ? model.rows : 0),
                          numberCell(fittedOr(model.why, model.chiSquared), 2), numberCell(fittedOr(model.why, model.df), 0),
                          pCell(fittedOr(model.why, model.p), model.logP), blankCell(), textCell(noteOn(fitted))});
}

void addChoiceRows(Table& table, const std::string& id, const ChoiceAnalysis& choices)
{
    const stats::CochranTest& cochran = choices.cochran;
    table.rows.push_back({textCell(id), textCell("Cochran's\u00A0Q"), countCell(cochran.blocks), numberCell(cochran.q, 2),
                          numberCell(cochran.df, 0), pCell(cochran.p, cochran.logP), blankCell(),
                          textCell("descriptive: ignores clustering")});
    addLinearModelRow(table, id, "mixed model of 0 and 1,\u00A0F", choices.linearModel);
    addLogisticRow(table, id, "logistic mixed model \u03c7\u00b2", choices.model);
    addLogisticRow(table, id, "the same with interactions \u03c7\u00b2", choices.crossedModel);
}

void addRatingRows(Table& table, const std::string& id, const RatingAnalysis& ratings)
{
    const stats::RepeatedMeasuresAnova& anova = ratings.anova;
    table.rows.push_back({textCell(id), textCell("RM-ANOVA\u00A0F"), countCell(anova.blocks), numberCell(anova.f, 2),
                          dfCell(anova.df1, anova.df2), pCell(anova.p, anova.logP), pCell(anova.pGg, anova.logPGg),
                          effectCell("partial eta squared", anova.partialEtaSquared)});
    const stats::FriedmanTest& friedman = ratings.friedman;
    table.rows.push_back({textCell(id), textCell("Friedman\u00A0Q"), countCell(friedman.blocks), numberCell(friedman.q, 2),
                          numberCell(friedman.df, 0), pCell(friedman.p, friedman.logP), blankCell(),
                          effectCell("Kendall's W", friedman.kendallW)});
    addLinearModelRow(table, id, "mixed model\u00A0F", ratings.model);
}

Table omnibusTable(const StudyAnalysis& analysis)
{
    Table table{"all_conditions",
                "All conditions at once: on the participants' means (complete blocks), and by mixed models of every answer",
                {"question", "test", "n", "statistic", "df", "p", "p (Greenhouse-Geisser)", "effect"},
                {}};
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) addChoiceRows(table, question.id(), question.findings);
    for (const auto& question : questionsWith<RatingAnalysis>(analysis)) addRatingRows(table, question.id(), question.findings);
    return table;
}

}  // namespace

std::vector<ReportTable> omnibusTables(const StudyAnalysis& analysis)
{
    Table table = omnibusTable(analysis);
    if (table.rows.empty()) return {};
    return {{.table = std::move(table), .section = PageSection::Comparisons}};
}

}  // namespace reports
