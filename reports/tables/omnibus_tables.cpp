#include "reports/tables/omnibus_tables.h"

#include <cmath>

#include "protocols/files/number_text.h"
#include "reports/analysis/claim_words.h"
#include "reports/formats/table_cells.h"
#include "reports/text/number_text.h"
#include "stats/power/measured_claims.h"

namespace reports {
namespace {

constexpr const char* theseTrials = "these trials";  // every answer counts as independent

/// Degrees of freedom: "8, 62.1" on the page, with all digits in files. Satterthwaite's are no whole numbers.
struct DegreesText {
    std::string shown = "-";
    std::string exact = "-";
};

DegreesText dfText(const stats::Value& df)
{
    if (!df.exists()) return {};
    return {fixed(*df, *df == std::floor(*df) ? 0 : 1), protocols::shortest(*df)};
}

DegreesText dfText(const stats::Value& first, const stats::Value& second)
{
    if (!first.exists() || !second.exists()) return {};
    const DegreesText one = dfText(first), two = dfText(second);
    return {one.shown + ", " + two.shown, one.exact + ", " + two.exact};
}

TableCell degreesCell(const DegreesText& df)
{
    TableCell cell = numericTextCell(df.shown);
    cell.csv = df.exact;
    return cell;
}

/// One row of the table.
struct OmnibusRow {
    std::string test;
    std::string holdsFor;
    std::size_t n = 0;
    stats::Value statistic;
    DegreesText df;
    stats::Value p;
    stats::Value logP;
    TableCell pGreenhouseGeisser = blankCell();
    std::string effect;
};

/// "14.10 (2, 10)".
TableCell statisticCell(const OmnibusRow& row)
{
    const TableCell number = numberCell(row.statistic, 2);
    if (!row.statistic.exists()) return number;
    const std::string df = " (" + row.df.shown + ")";
    return {number.text + df, number.csv, number.html + df, number.tex + df, "", true};
}

void addOmnibusRow(Table& table, const std::string& id, const OmnibusRow& row)
{
    table.rows.push_back({textCell(id), textCell(row.test), textCell(row.holdsFor), countCell(row.n),
                          numberCell(row.statistic, 2), degreesCell(row.df), statisticCell(row), pCell(row.p, row.logP),
                          row.pGreenhouseGeisser, textCell(row.effect)});
}

/// "partial eta squared 0.12", or the reason why there is none.
std::string effectText(const std::string& name, const stats::Value& value)
{
    return value.exists() ? name + " " + fixed(*value, 2) : value.why();
}

/// Remark on a mixed model: a singular fit, or random effects that were left out.
std::string noteOn(bool isSingular, const std::vector<stats::LeftOut>& leftOut)
{
    if (isSingular) return "singular: a random effect was estimated as zero";
    return leftOut.empty() ? "" : "without random effects that cannot be estimated";
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

OmnibusRow linearModelRow(const std::string& name, const stats::RatingModel& fitted)
{
    const std::string why = fitted.model.why.empty() ? stats::whyNotForOthers(fitted.leftOut) : fitted.model.why;
    const stats::FTest& test = fitted.condition;
    return {name,
            wordsOf(stats::Generalisation::FabricsLikeThese),
            why.empty() ? fitted.model.rows : 0,
            fittedOr(why, test.f),
            dfText(fittedOr(why, test.df1), fittedOr(why, test.df2)),
            fittedOr(why, test.p),
            test.logP,
            blankCell(),
            noteOn(fitted)};
}

OmnibusRow logisticRow(const std::string& name, const std::string& holdsFor, const stats::ChoiceModel& fitted)
{
    const stats::LogisticMixedModel& model = fitted.model;
    const bool isForOthers = holdsFor == wordsOf(stats::Generalisation::FabricsLikeThese);
    const std::string why = model.why.empty() && isForOthers ? stats::whyNotForOthers(fitted.leftOut) : model.why;
    return {name,
            holdsFor,
            why.empty() ? model.rows : 0,
            fittedOr(why, model.chiSquared),
            dfText(fittedOr(why, model.df)),
            fittedOr(why, model.p),
            model.logP,
            blankCell(),
            noteOn(fitted)};
}

void addChoiceRows(Table& table, const std::string& id, const ChoiceAnalysis& choices)
{
    const stats::CochranTest& cochran = choices.cochran;
    addOmnibusRow(table, id,
                  {"Cochran's\u00A0Q", theseTrials, cochran.blocks, cochran.q, dfText(cochran.df), cochran.p, cochran.logP,
                   blankCell(), "ignores clustering"});
    addOmnibusRow(table, id, linearModelRow("mixed model of 0 and 1,\u00A0F", choices.linearModel));
    addOmnibusRow(table, id, logisticRow("logistic mixed model \u03c7\u00b2", theseTrials, choices.model));
    addOmnibusRow(table, id,
                  logisticRow("the same with interactions \u03c7\u00b2", wordsOf(stats::Generalisation::FabricsLikeThese),
                              choices.crossedModel));
}

void addRatingRows(Table& table, const std::string& id, const RatingAnalysis& ratings)
{
    const stats::RepeatedMeasuresAnova& anova = ratings.anova;
    const std::string theseFabrics = wordsOf(stats::Generalisation::TheseFabrics);
    addOmnibusRow(table, id,
                  {"RM-ANOVA\u00A0F", theseFabrics, anova.blocks, anova.f, dfText(anova.df1, anova.df2), anova.p, anova.logP,
                   pCell(anova.pGg, anova.logPGg), effectText("partial eta squared", anova.partialEtaSquared)});
    const stats::FriedmanTest& friedman = ratings.friedman;
    addOmnibusRow(table, id,
                  {"Friedman\u00A0Q", theseFabrics, friedman.blocks, friedman.q, dfText(friedman.df), friedman.p, friedman.logP,
                   blankCell(), effectText("Kendall's W", friedman.kendallW)});
    addOmnibusRow(table, id, linearModelRow("mixed model\u00A0F", ratings.model));
}

/// How often Cochran's Q rejects where conditions differ from fabric to fabric, and from person to person besides.
std::string cochranWarning()
{
    const auto percent = [](double people, double fabrics) {
        return fixed(100 * stats::falseClaimRate(stats::cochranOfSampledFabrics, {true, people, fabrics, false}), 0);
    };
    return "\u201CThese trials\u201D: the test takes all answers as independent. Without any true difference, Cochran's Q "
           "rejects "
           "in " +
           percent(0, 0.5) + " % of studies where conditions differ by fabric (SD 0.5 log odds), in " + percent(0.5, 0.5) +
           " % where they differ by participant, too";
}

Table omnibusTable(const StudyAnalysis& analysis)
{
    const auto choices = questionsWith<ChoiceAnalysis>(analysis);
    Table table{"all_conditions",
                "All conditions at once: on the participants' means (complete blocks), and by mixed models of every answer" +
                    (choices.empty() ? "" : ". " + cochranWarning()),
                {"question",
                 "test",
                 "holds for",
                 "n",
                 {"statistic", ColumnUse::InCsv},
                 {"df", ColumnUse::InCsv},
                 {"statistic (df)", ColumnUse::InDocuments},
                 "p",
                 "p (Greenhouse-Geisser)",
                 "effect"},
                {}};
    for (const auto& question : choices) addChoiceRows(table, question.id(), question.findings);
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
