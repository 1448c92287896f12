#include "reports/tables/effect_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "protocols/files/number_text.h"
#include "reports/formats/table_cells.h"
#include "reports/text/number_text.h"

namespace reports {
namespace {

/// "0.42 [0.20, 0.71]".
TableCell withInterval(const stats::Value& value, const stats::Interval& interval)
{
    const TableCell number = numberCell(value, 2), ends = intervalCell(interval, 2);
    if (!value.exists() || !interval.low.exists() || !interval.high.exists()) return number;
    return {number.text + " " + ends.text, number.csv, number.html + " " + ends.html, number.tex + " " + ends.tex, "", true};
}

/// Choices have no raters of stimuli.
RaterAgreement agreementOrReason(const QuestionEffects& effects)
{
    if (effects.agreement) return *effects.agreement;
    const stats::Value none = stats::Value::undefined("right and wrong answers are no ratings of the stimuli");
    const stats::Interval noInterval{none, none};
    return {
        0, 0, {}, {none.why(), none, none, none, none, none, none}, {none.why(), noInterval, noInterval, noInterval, noInterval}};
}

Table effectSizesTable(const StudyAnalysis& analysis)
{
    Table table{"effect_sizes",
                "Effect of condition (\u03b7\u00b2 on the participants' means, R\u00b2 of the mixed model), and agreement of the "
                "participants as raters of the stimuli with its 95 % interval",
                {"question",
                 "partial \u03b7\u00b2",
                 "\u03b7\u00b2G",
                 "R\u00b2 marginal",
                 "R\u00b2 conditional",
                 {"stimuli", ColumnUse::InCsv},
                 {"raters", ColumnUse::InCsv},
                 {"stimuli \u00D7 raters", ColumnUse::InDocuments},
                 "ICC(2,1)",
                 {"ICC(2,1) low", ColumnUse::InCsv},
                 {"ICC(2,1) high", ColumnUse::InCsv},
                 "ICC(2,k)",
                 {"ICC(2,k) low", ColumnUse::InCsv},
                 {"ICC(2,k) high", ColumnUse::InCsv},
                 {"ICC(3,1)", ColumnUse::InCsv},
                 {"ICC(3,1) low", ColumnUse::InCsv},
                 {"ICC(3,1) high", ColumnUse::InCsv},
                 {"ICC(3,k)", ColumnUse::InCsv},
                 {"ICC(3,k) low", ColumnUse::InCsv},
                 {"ICC(3,k) high", ColumnUse::InCsv}},
                {}};
    for (const QuestionAnalysis& question : analysis.questions) {
        const QuestionEffects* effects = effectsOf(question);
        if (effects == nullptr) continue;
        const RaterAgreement agreement = agreementOrReason(*effects);
        const stats::IntraclassCorrelations& icc = agreement.icc;
        const stats::IntraclassIntervals& ci = agreement.ci95;
        const bool isRated = effects->agreement.has_value();
        table.rows.push_back(
            {textCell(question.question.id),
             numberCell(effects->partialEtaSquared, 2),
             numberCell(effects->generalizedEtaSquared, 2),
             numberCell(effects->variance.marginal, 2),
             numberCell(effects->variance.conditional, 2),
             isRated ? countCell(agreement.stimuli) : blankCell(),
             isRated ? countCell(agreement.raters) : blankCell(),
             isRated ? numericTextCell(std::to_string(agreement.stimuli) + " \u00D7 " + std::to_string(agreement.raters))
                     : blankCell(),
             withInterval(icc.icc2, ci.icc2),
             numberCell(ci.icc2.low, 2),
             numberCell(ci.icc2.high, 2),
             withInterval(icc.icc2k, ci.icc2k),
             numberCell(ci.icc2k.low, 2),
             numberCell(ci.icc2k.high, 2),
             numberCell(icc.icc3, 2),
             numberCell(ci.icc3.low, 2),
             numberCell(ci.icc3.high, 2),
             numberCell(icc.icc3k, 2),
             numberCell(ci.icc3k.low, 2),
             numberCell(ci.icc3k.high, 2)});
    }
    return table;
}

std::string remarkOn(const stats::VarianceComponent& component, bool isChoice)
{
    if (component.isZero) return "estimated as zero";
    return isChoice && component.name == "Residual" ? "\u03c0\u00b2/3, fixed by the logistic model" : "";
}

Table componentsTable(const StudyAnalysis& analysis)
{
    Table table{"variance_components",
                "Variance components of the mixed models with all interactions: ratings in scale points, choices in log odds",
                {"question", "component", "SD", {"variance", ColumnUse::InCsv}, "share %", "remark"},
                {}};
    for (const QuestionAnalysis& question : analysis.questions) {
        const QuestionEffects* effects = effectsOf(question);
        if (effects == nullptr) continue;
        const TableCell id = textCell(question.question.id);
        const bool isChoice = std::holds_alternative<ChoiceAnalysis>(question.findings);
        for (const stats::VarianceComponent& component : effects->variance.components)
            table.rows.push_back(
                {id, textCell(component.name), numberCell(component.sd, 2), numberCell(component.variance, 3),
                 numberCell(component.share.exists() ? stats::Value(100 * *component.share) : component.share, 1),
                 textCell(remarkOn(component, isChoice))});
        if (!effects->variance.why.empty())
            table.rows.push_back(
                {id, textCell("the model"), blankCell(), blankCell(), blankCell(), textCell(effects->variance.why)});
        for (const stats::LeftOut& effect : effects->leftOut)
            table.rows.push_back(
                {id, textCell(effect.name), blankCell(), blankCell(), blankCell(), textCell("left out: " + effect.why)});
    }
    return table;
}

/// Three digits; "> 10000" and "< 0.001" beyond, because the logarithm stands beside it.
TableCell factorCell(const stats::Value& factor)
{
    if (!factor.exists() || !std::isfinite(*factor)) return numberCell(factor, 2);
    if (*factor >= 0.001 && *factor <= 10000)
        return numberCell(factor, *factor >= 100 ? 0 : *factor >= 10 ? 1 : *factor >= 0.1 ? 2 : 3);
    TableCell cell = numericTextCell(*factor < 1 ? "< 0.001" : "> 10000");
    cell.csv = protocols::shortest(*factor);
    return cell;
}

Table evidenceTable(const StudyAnalysis& analysis)
{
    Table table{
        "bayes_factors",
        "Bayes factors of the contrasts on the participants' means, for these fabrics (JZS, Cauchy prior of scale 0.707): "
        "how many times more probable the data are with a difference than without",
        {"question", "a", "b", "n", "t", "BF10", "log10 BF10"},
        {}};
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionEffects* effects = effectsOf(question))
            for (const ContrastEvidence& one : effects->evidence) {
                const stats::Value& log = one.factor.logBf10;
                table.rows.push_back({textCell(question.question.id), conditionCell(one.a), conditionCell(one.b),
                                      countCell(one.participants), numberCell(one.t, 2), factorCell(one.factor.bf10),
                                      numberCell(log.exists() ? stats::Value(*log / std::numbers::ln10) : log, 2)});
            }
    return table;
}

}  // namespace

std::vector<ReportTable> effectTables(const StudyAnalysis& analysis)
{
    std::vector<ReportTable> tables;
    if (Table sizes = effectSizesTable(analysis); !sizes.rows.empty())
        tables.push_back({.table = std::move(sizes), .section = PageSection::Effects});
    if (Table components = componentsTable(analysis); !components.rows.empty())
        tables.push_back({.table = std::move(components), .section = PageSection::Effects});
    if (Table evidence = evidenceTable(analysis); !evidence.rows.empty())
        tables.push_back(
            {.table = std::move(evidence), .section = PageSection::Effects, .foldedUnder = "Bayes factors of the contrasts"});
    return tables;
}

}  // namespace reports
