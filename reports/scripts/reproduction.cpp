#include "reports/scripts/reproduction.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "protocols/files/csv_table.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "reports/cells/response_time.h"
#include "reports/scripts/anchor_numbers.h"
#include "reports/scripts/script_texts.h"

namespace reports {
namespace {

using protocols::safeCell;

/// Rows of one group of numbers: a condition, or a pair of conditions.
class NumberRows {
public:
    NumberRows(std::string& text, const std::string& section, const std::string& question, const std::string& a,
               const std::string& b)
        : m_text(text), m_begin{section, safeCell(question), safeCell(a), safeCell(b), "", ""}
    {
    }
    NumberRows& within(double low, const std::string& high)
    {
        m_begin[4] = protocols::shortest(low);
        m_begin[5] = high;
        return *this;
    }
    NumberRows& put(const std::string& quantity, const stats::Value& value)
    {
        auto cells = m_begin;
        cells.insert(cells.end(), {quantity, value.exists() ? protocols::shortest(*value) : ""});
        m_text += protocols::csvRow(cells);
        return *this;
    }
    NumberRows& count(const char* quantity, std::size_t number) { return put(quantity, static_cast<double>(number)); }
    NumberRows& ends(const std::string& name, const stats::Interval& interval)
    {
        return put(name + "_low", interval.low).put(name + "_high", interval.high);
    }
    /// Standard deviation of a group of random effects: "sd_participant_condition".
    NumberRows& sd(std::string group, const stats::Value& value)
    {
        std::replace(group.begin(), group.end(), ':', '_');
        return put("sd_" + group, value);
    }

private:
    std::string& m_text;
    std::vector<std::string> m_begin;
};

void addComparisonNumbers(std::string& text, const std::string& question, const PairComparison& one)
{
    const stats::TTest& test = one.test;
    NumberRows(text, "comparison", question, one.pair.a, one.pair.b)
        .count("n", test.n)
        .put("mean_difference", test.estimate)
        .put("statistic", test.t)
        .put("df", test.df)
        .put("p", test.p)
        .put("p_holm", one.pHolm)
        .ends("ci95", test.ci)
        .put("d_z", test.dZ);
}

void addEquivalenceNumbers(std::string& text, const std::string& question, const PairEquivalence& one)
{
    const stats::EquivalenceTest& test = one.test;
    NumberRows(text, "equivalence", question, one.pair.a, one.pair.b)
        .within(one.low, protocols::shortest(one.high))
        .count("n", test.n)
        .put("mean_difference", test.estimate)
        .put("p_lower", test.pLower)
        .put("p_upper", test.pUpper)
        .ends("ci90", test.ci);
}

void addClaimNumbers(std::string& text, const std::string& question, const QuestionClaims& claims)
{
    for (const ContrastFinding& finding : claims.contrasts) {
        const stats::ContrastClaim& claim = finding.claim;
        NumberRows rows(text, "claims_" + nameOf(finding.generalisation), question, finding.a, finding.b);
        if (claims.bounds) rows.within(claims.bounds->first, protocols::shortest(claims.bounds->second));
        rows.put("estimate", claim.mean.estimate)
            .put("se", claim.mean.se)
            .put("df", claim.mean.df)
            .put("p", claim.difference.p)
            .put("p_holm", claim.pAdjusted)
            .put("p_equivalence", claim.equivalence.p)
            .put("p_equivalence_holm", claim.pEquivalenceAdjusted)
            .ends("ci95", claim.mean.ci95)
            .ends("ci90", claim.mean.ci90);
    }
}

void addChanceNumbers(std::string& text, const std::string& question, const ChoiceAnalysis& choices)
{
    for (std::size_t i = 0; i < choices.claims.aboveChance.size(); ++i) {
        const ChanceFinding& finding = choices.claims.aboveChance[i];
        NumberRows rows(text, "above_chance_" + nameOf(finding.generalisation), question, finding.condition, "");
        if (choices.conditions[i / 2].noChance.empty()) rows.within(1.0 / choices.alternatives, "");  // each stands there twice
        rows.put("estimate", finding.claim.mean.estimate)
            .put("se", finding.claim.mean.se)
            .put("df", finding.claim.mean.df)
            .put("p", finding.claim.above.p)
            .put("p_holm", finding.claim.pAdjusted)
            .ends("ci95", finding.claim.mean.ci95);
    }
}

void addLinearModelNumbers(std::string& text, const std::string& question, const stats::RatingModel& fitted)
{
    NumberRows rows(text, "linear_model", question, "", "");
    rows.count("n", fitted.model.rows)
        .put("f", fitted.condition.f)
        .put("df1", fitted.condition.df1)
        .put("df2", fitted.condition.df2)
        .put("p", fitted.condition.p);
    for (const stats::RandomEffect& effect : fitted.model.random) rows.sd(effect.name, effect.sd);
    rows.sd("residual", fitted.model.residualSd);
}

void addModelContrastNumbers(std::string& text, const std::string& question, const std::vector<ModelContrast>& contrasts)
{
    for (const ModelContrast& contrast : contrasts) {
        const stats::MeanTest test = stats::testOfMean(contrast.mean, 0, stats::Tail::TwoSided);
        NumberRows(text, "model_contrast", question, contrast.a, contrast.b)
            .put("estimate", contrast.mean.estimate)
            .put("se", contrast.mean.se)
            .put("df", contrast.mean.df)
            .put("t", test.t)
            .put("p", test.p)
            .ends("ci95", contrast.mean.ci95);
    }
}

/// The first effect is that of the reference, which stands in column a alone. Without interactions, standard errors are those of
/// lme4, which depend on the steps of its inner search: no other fit can compare them.
void addLogisticNumbers(std::string& text, const char* section, const std::string& question, const stats::ChoiceModel& fitted,
                        bool hasStandardErrors)
{
    const stats::LogisticMixedModel& model = fitted.model;
    NumberRows rows(text, section, question, "", "");
    rows.count("n", model.rows)
        .put("log_likelihood", model.logLikelihood)
        .put("chi2", model.chiSquared)
        .put("df", model.df)
        .put("p", model.p);
    for (const stats::RandomIntercept& effect : model.random) rows.sd(effect.name, effect.sd);
    for (std::size_t i = 0; i < model.fixed.size(); ++i) {
        NumberRows effect(text, section, question, fitted.conditions[i], i == 0 ? "" : fitted.conditions.front());
        effect.put("estimate", model.fixed[i].estimate);
        if (hasStandardErrors) effect.put("se", model.fixed[i].se);
    }
}

stats::Value oddsOf(const stats::Value& logOdds) { return logOdds.exists() ? stats::Value(std::exp(*logOdds)) : logOdds; }

void addOrdinalNumbers(std::string& text, const std::string& question, const OrdinalRatings& ratings)
{
    const stats::OrdinalMixedModel& model = ratings.fitted.model;
    const std::vector<std::string>& conditions = ratings.fitted.conditions;
    NumberRows rows(text, "ordinal_model", question, "", "");
    rows.within(ratings.unit, "").count("n", model.rows).put("log_likelihood", model.logLikelihood);
    for (const stats::RandomIntercept& effect : model.random) rows.sd(effect.name, effect.sd);
    for (std::size_t i = 0; i < model.fixed.size(); ++i)
        NumberRows(text, "ordinal_model", question, conditions[i + 1], conditions.front())
            .within(ratings.unit, "")
            .put("estimate", model.fixed[i].estimate)
            .put("se", model.fixed[i].se)
            .put("p", model.fixed[i].p)
            .put("odds_ratio", oddsOf(model.fixed[i].estimate))
            .ends("ci95", {oddsOf(model.fixed[i].ci.low), oddsOf(model.fixed[i].ci.high)});
}

void addNumbers(std::string& text, const StudyAnalysis& analysis, const std::string& question, const ChoiceAnalysis& choices)
{
    for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c) {
        const ConditionChoices& one = choices.conditions[c];
        NumberRows rows(text, "matches", question, analysis.data.conditions[c], "");
        if (one.noChance.empty()) rows.within(1.0 / choices.alternatives, "");
        rows.count("correct", one.count.correct)
            .count("trials", one.count.trials)
            .put("proportion", one.againstChance.estimate)
            .put("p_chance", one.againstChance.pGreater)
            .put("p_chance_participants", one.participantsAgainstChance.p);
    }
    for (const PairComparison& one : choices.comparisons) addComparisonNumbers(text, question, one);
    addChanceNumbers(text, question, choices);
    addClaimNumbers(text, question, choices.claims);
    addLinearModelNumbers(text, question, choices.linearModel);
    addLogisticNumbers(text, "logistic_model", question, choices.model, false);
    addLogisticNumbers(text, "logistic_model_crossed", question, choices.crossedModel, true);
}

void addNumbers(std::string& text, const StudyAnalysis& analysis, const std::string& question, const RatingAnalysis& ratings)
{
    for (std::size_t c = 0; c < analysis.data.conditions.size(); ++c) {
        const ConditionRatings& one = ratings.conditions[c];
        NumberRows(text, "ratings", question, analysis.data.conditions[c], "")
            .count("n", one.ratings)
            .put("mean", one.mean)
            .put("sd", one.sd)
            .ends("ci95", one.ci95);
    }
    for (const PairComparison& one : ratings.comparisons) addComparisonNumbers(text, question, one);
    for (const PairEquivalence& one : ratings.equivalences) addEquivalenceNumbers(text, question, one);
    addClaimNumbers(text, question, ratings.claims);
    addLinearModelNumbers(text, question, ratings.model);
    addModelContrastNumbers(text, question, ratings.modelContrasts);
    if (analysis.depth == Depth::Whole) addOrdinalNumbers(text, question, ratings.ordinal);
}

void addNumbers(std::string&, const StudyAnalysis&, const std::string&, const WordedAnalysis&) {}

void addAnchorNumbers(std::string& text, const StudyAnalysis& analysis, const QuestionAnchors& anchors)
{
    if (anchors.floor)
        NumberRows(text, "anchor_floor", anchors.question, "", "")
            .count("n", anchors.floor->ratings)
            .put("mean", anchors.floor->mean)
            .put("sd", anchors.floor->sd)
            .ends("ci95", anchors.floor->ci95);
    if (anchors.choices)
        NumberRows(text, anchors.compared == stats::ChoicesCompared::Words ? "anchor_words" : "anchor_choices", anchors.question,
                   "", "")
            .within(anchors.alternatives,
                    std::to_string(anchors.compared == stats::ChoicesCompared::Outcomes ? 2 : anchors.alternatives))
            .count("pairs", anchors.choices->pairs)
            .put("agreement", anchors.choices->agreement.value)
            .ends("agreement_ci95", anchors.choices->agreement.ci95)
            .put("kappa", anchors.choices->kappa.value)
            .ends("kappa_ci95", anchors.choices->kappa.ci95)
            .put("ceiling_of_proportion", anchors.choices->shareCeiling.value);
    if (!anchors.ratings) return;
    for (const QuestionInfo& question : analysis.data.questions)
        if (const auto scoring = scoringOf(question.kind); question.id == anchors.question) {
            NumberRows rows(text, "anchor_ratings", anchors.question, "", "");
            rows.within(std::get<NumberOnScale>(scoring).min, protocols::shortest(std::get<NumberOnScale>(scoring).max))
                .count("pairs", anchors.ratings->pairs)
                .put("icc", anchors.ratings->icc.value)
                .ends("icc_ci95", anchors.ratings->icc.ci95)
                .put("within_sd", anchors.ratings->withinSd.value)
                .ends("within_sd_ci95", anchors.ratings->withinSd.ci95)
                .put("mean_difference", anchors.ratings->bias.estimate)
                .ends("ci95", anchors.ratings->bias.ci)
                .put("ceiling_of_correlation", anchors.ratings->correlationCeiling.value);
            // Without a scale there is none; the scripts would take the assumed end.
            if (anchors.ratings->meanCeiling.value.exists()) rows.put("ceiling_of_mean", anchors.ratings->meanCeiling.value);
        }
}

std::string scaleOf(const StudyData& data)
{
    std::string text;
    for (const QuestionInfo& question : data.questions)
        if (const auto scoring = scoringOf(question.kind); const auto* scale = std::get_if<NumberOnScale>(&scoring))
            text += (text.empty() ? "" : "; ") + question.id + ": " + protocols::shortest(scale->min) + " to " +
                    protocols::shortest(scale->max);
    return text;
}

std::string namesOf(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : "; ") + name;
    return text;
}

/// Sections of expected.csv.
const std::vector<std::string> sections{"matches",
                                        "ratings",
                                        "comparison",
                                        "equivalence",
                                        "above_chance_these_fabrics",
                                        "above_chance_fabrics_like_these",
                                        "claims_these_fabrics",
                                        "claims_fabrics_like_these",
                                        "linear_model",
                                        "model_contrast",
                                        "logistic_model",
                                        "logistic_model_crossed",
                                        "ordinal_model",
                                        "anchor_floor",
                                        "anchor_ratings",
                                        "anchor_choices",
                                        "anchor_words"};

std::string codebookCsv(const StudyData& data)
{
    std::vector<std::string> questions;
    for (const QuestionInfo& question : data.questions) questions.push_back(question.id);
    const std::vector<std::vector<std::string>> rows{
        {"file", "column", "type", "unit", "values", "meaning"},
        {"answers.csv", "participant", "text", "", "", "who answered"},
        {"answers.csv", "question", "text", "", safeCell(namesOf(questions)), "id of the question"},
        {"answers.csv", "fabric", "text", "", safeCell(namesOf(data.fabrics)), "the true fabric"},
        {"answers.csv", "condition", "text", "", safeCell(namesOf(data.conditions)), "input condition of the rendering"},
        {"answers.csv", "instruction", "text", "", "", "what the block asked of the speed; empty where it asked nothing"},
        {"answers.csv", "repetition", "text", "", "", "of a cell that is asked more than once"},
        {"answers.csv", "trial", "whole number", "", "from 1",
         "place in time among the presentations (place in answers.csv of an export); empty where unknown"},
        {"answers.csv", "correct", "whole number", "", "0; 1", "of a choice: 1 is right"},
        {"answers.csv", "rating", "number", "points of the scale", safeCell(scaleOf(data)), "of a rating"},
        {"answers.csv", "seconds", "number", "s", "", "time that the report uses; empty where there is none"},
        {"expected.csv", "section", "text", "", safeCell(namesOf(sections)), "kind of test or model"},
        {"expected.csv", "question", "text", "", "", "id of the question"},
        {"expected.csv", "a", "text", "", "", "condition, or the first of a pair; empty for a whole model"},
        {"expected.csv", "b", "text", "", "", "second condition of a pair; differences are a - b"},
        {"expected.csv", "low", "number", "", "",
         "chance of a match (empty where it is not tested), the lower bound of equivalence, the lowest rating, the number of "
         "alternatives, or the unit to which an ordinal model rounds ratings"},
        {"expected.csv", "high", "number", "", "",
         "upper bound of equivalence, the highest rating, or the number of answers that are compared: 2 for right and wrong"},
        {"expected.csv", "quantity", "text", "", "",
         "name as in results.json and statistics.json; ci95_low and ci95_high are the ends of ci95"},
        {"expected.csv", "value", "number", "", "", "as the report has it; empty where it does not exist"}};
    std::string text;
    for (const auto& row : rows) text += protocols::csvRow(row);
    return text;
}

template <class T, class ToText>
std::string textIfThere(const std::optional<T>& value, ToText toText)
{
    return value ? toText(*value) : std::string();
}

}  // namespace

std::string expectedNumbersCsv(const StudyAnalysis& analysis)
{
    std::string text = protocols::csvRow({"section", "question", "a", "b", "low", "high", "quantity", "value"});
    for (const QuestionAnalysis& question : analysis.questions)
        std::visit([&](const auto& findings) { addNumbers(text, analysis, question.question.id, findings); }, question.findings);
    for (const QuestionAnchors& anchors : analysis.anchors) addAnchorNumbers(text, analysis, anchors);
    return text;
}

std::string analysedAnswersCsv(const StudyData& data)
{
    std::string text = protocols::csvRow(
        {"participant", "question", "fabric", "condition", "instruction", "repetition", "trial", "correct", "rating", "seconds"});
    const auto number = [](double value) { return protocols::shortest(value); };
    for (const StudyResponse& response : data.responses) {
        const auto* chosen = std::get_if<ChosenAnswer>(&response.content);
        const auto* rated = std::get_if<RatedAnswer>(&response.content);
        if (chosen == nullptr && rated == nullptr) continue;
        text += protocols::csvRow({safeCell(response.participant), safeCell(response.question), safeCell(response.fabric),
                                   safeCell(response.condition), safeCell(response.instruction), safeCell(response.repetition),
                                   textIfThere(response.trial, [](int trial) { return std::to_string(trial); }),
                                   chosen ? std::string(chosen->correct ? "1" : "0") : "", rated ? number(rated->rating) : "",
                                   textIfThere(responseTimeOf(response), number)});
    }
    return text;
}

void writeReproduction(const StudyAnalysis& analysis, const std::filesystem::path& folder)
{
    const auto write = [&](const char* name, std::string_view text) {
        protocols::writeWholeFile(folder / name, text, protocols::Sync::Later);
    };
    write("answers.csv", analysedAnswersCsv(analysis.data));
    write("expected.csv", expectedNumbersCsv(analysis));
    const std::string anchors = anchorAnswersCsv(analysis.data);
    if (!anchors.empty()) write("anchors.csv", anchors);
    write("codebook.csv", codebookCsv(analysis.data) + (anchors.empty() ? "" : anchorCodebookRows()));
    write("analysis.R", scripts::inR());
    write("analysis.py", scripts::inPython());
}

}  // namespace reports
