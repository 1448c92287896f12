#include "reports/page/sentences.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "reports/analysis/claim_words.h"
#include "reports/page/html_parts.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using stats::Generalisation;

constexpr std::size_t mostUnfolded = 12;  ///< sentences of a list; longer lists open on request

std::string equation(const std::string& symbol, const std::string& number) { return symbol + "\u00A0= " + typeset(number); }

/// A number that cannot exceed 1 has no zero before its point.
std::string withoutZero(double value)
{
    const std::string text = fixed(value, 2);
    if (text.starts_with("0.")) return text.substr(1);
    return text.starts_with("-0.") ? "\u2212" + text.substr(2) : typeset(text);
}

std::string pEquation(const stats::Value& p)
{
    if (!p.exists()) return "<i>p</i> undefined";
    return *p < 0.001 ? "<i>p</i>\u00A0&lt; .001" : equation("<i>p</i>", pText(*p));
}

std::string degrees(const stats::Value& df)
{
    if (!df.exists()) return "?";
    return fixed(*df, *df == std::floor(*df) ? 0 : 1);
}

std::string tEquation(const stats::Value& df, const stats::Value& t)
{
    return t.exists() ? equation("<i>t</i>(" + degrees(df) + ")", fixed(*t, 2)) : "<i>t</i> undefined";
}

std::string intervalPart(const char* level, const stats::Interval& interval, bool isShare)
{
    if (!interval.low.exists() || !interval.high.exists()) return {};
    const auto number = [&](double value) { return isShare ? withoutZero(value) : typeset(fixed(value, 2)); };
    return std::string(", ") + level + "% CI [" + number(*interval.low) + ", " + number(*interval.high) + "]";
}

std::string whyNot(const std::string& why) { return "there is no test (" + protocols::escapedMarkup(why) + ")"; }

/// "F(8, 62.1) = 5.20, p < .001".
std::string fEquation(const stats::FTest& test)
{
    if (!test.why.empty()) return whyNot(test.why);
    return equation("<i>F</i>(" + degrees(test.df1) + ", " + degrees(test.df2) + ")", fixed(*test.f, 2)) + ", " +
           pEquation(test.p);
}

std::string effectSizes(const QuestionEffects& effects)
{
    std::string text;
    if (effects.partialEtaSquared.exists())
        text += ", " + equation("\u03B7<sub>p</sub>\u00B2", withoutZero(*effects.partialEtaSquared));
    if (effects.generalizedEtaSquared.exists())
        text += ", " + equation("\u03B7<sub>G</sub>\u00B2", withoutZero(*effects.generalizedEtaSquared));
    return text;
}

std::string overallSentence(const QuestionAnalysis& question, const QuestionClaims& claims)
{
    std::string text;
    for (const OmnibusFinding& finding : claims.omnibus) {
        const bool isThese = finding.generalisation == Generalisation::TheseFabrics;
        text += std::string(text.empty() ? "Test of all conditions at once: for " : "; for ") + wordsOf(finding.generalisation) +
                ", " + fEquation(finding.test);
        if (const QuestionEffects* effects = effectsOf(question); isThese && effects && finding.test.why.empty())
            text += effectSizes(*effects);
    }
    return text.empty() ? text : text + ".";
}

/// What stands in place of a test against chance.
std::string dPrimePart(const ChoiceAnalysis& choices, const ChanceFinding& finding)
{
    for (const ClusteredSensitivity& one : choices.sensitivities)
        if (one.condition == finding.condition && one.generalisation == finding.generalisation && one.dPrime.exists())
            return "; " + equation("<i>d</i>\u2032", fixed(*one.dPrime, 2)) + intervalPart("95", one.ci95, false);
    return {};
}

std::string chanceSentence(const ChoiceAnalysis& choices, const ConditionChoices& counts, const ChanceFinding& finding)
{
    const stats::ChanceClaim& claim = finding.claim;
    const double chance = 1.0 / choices.alternatives;
    std::string text = "Under " + htmlLabel(finding.condition) + ", " + std::to_string(counts.count.correct) + " of " +
                       counted(counts.count.trials, "answer") + (counts.count.correct == 1 ? " was right" : " were right");
    if (counts.count.trials > 0)
        text += " (" + fixed(100.0 * double(counts.count.correct) / double(counts.count.trials), 1) + "%)";
    text += "; for " + wordsOf(finding.generalisation) + ", ";
    if (!claim.mean.why.empty()) return text + whyNot(claim.mean.why) + ".";
    if (!claim.above.p.exists()) return text + whyNot(claim.above.p.why()) + dPrimePart(choices, finding) + ".";
    return text + "the share was " + (claim.isAbove ? "" : "not shown to be ") + "above chance (" + withoutZero(chance) + "), " +
           equation("<i>M</i>", withoutZero(*claim.mean.estimate)) + intervalPart("95", claim.mean.ci95, true) + ", " +
           tEquation(claim.mean.df, claim.above.t) + ", " + pEquation(claim.pAdjusted) + ".";
}

/// The test for fabrics like these, or for these fabrics where there is no other.
const ChanceFinding* testableOf(const QuestionClaims& claims, const std::string& condition)
{
    const ChanceFinding* best = nullptr;
    for (const ChanceFinding& finding : claims.aboveChance) {
        if (finding.condition != condition) continue;
        const bool isAlike = finding.generalisation == Generalisation::FabricsLikeThese;
        if (best == nullptr || (isAlike && (finding.claim.mean.why.empty() || !best->claim.mean.why.empty()))) best = &finding;
    }
    return best;
}

std::size_t positionOf(const StudyData& data, const std::string& condition)
{
    return static_cast<std::size_t>(std::find(data.conditions.begin(), data.conditions.end(), condition) -
                                    data.conditions.begin());
}

/// "h&f (M = 6.10, SD = 1.95)"; the label alone for choices.
std::string described(const StudyAnalysis& analysis, const QuestionAnalysis& question, const std::string& condition)
{
    const auto* ratings = std::get_if<RatingAnalysis>(&question.findings);
    const std::size_t at = positionOf(analysis.data, condition);
    if (ratings == nullptr || at >= ratings->conditions.size() || !ratings->conditions[at].mean.exists())
        return htmlLabel(condition);
    const ConditionRatings& one = ratings->conditions[at];
    const std::string sd = one.sd.exists() ? ", " + equation("<i>SD</i>", fixed(*one.sd, 2)) : "";
    return htmlLabel(condition) + " (" + equation("<i>M</i>", fixed(*one.mean, 2)) + sd + ")";
}

/// d_z of the participants' mean differences, with the sign of a - b; empty where it does not exist.
std::string dzPart(const QuestionAnalysis& question, const ContrastFinding& finding)
{
    for (const PairComparison& comparison : comparisonsOf(question)) {
        const bool isTurned = comparison.pair.a == finding.b && comparison.pair.b == finding.a;
        if (!isTurned && (comparison.pair.a != finding.a || comparison.pair.b != finding.b)) continue;
        const stats::Value& dz = comparison.test.dZ;
        return dz.exists() ? ", " + equation("<i>d<sub>z</sub></i>", fixed(isTurned ? -*dz : *dz, 2)) : std::string();
    }
    return {};
}

std::string differencePart(const ContrastFinding& finding)
{
    const stats::CrossedMean& mean = finding.claim.mean;
    if (!mean.why.empty()) return whyNot(mean.why);
    return equation("<i>M</i><sub>diff</sub>", fixed(*mean.estimate, 2)) + intervalPart("95", mean.ci95, false) + ", " +
           tEquation(mean.df, finding.claim.difference.t) + ", " + pEquation(finding.claim.pAdjusted);
}

std::string equivalencePart(const QuestionClaims& claims, const ContrastFinding& finding)
{
    const stats::CrossedMean& mean = finding.claim.mean;
    if (!claims.bounds || !mean.why.empty()) return {};
    return " Two one-sided tests against " + typeset(protocols::shortest(claims.bounds->first)) + " and " +
           typeset(protocols::shortest(claims.bounds->second)) + intervalPart("90", mean.ci90, false) + ", " +
           tEquation(mean.df, finding.claim.equivalence.t) + ", " + pEquation(finding.claim.pEquivalenceAdjusted) + ".";
}

std::string contrastSentence(const StudyAnalysis& analysis, const QuestionAnalysis& question, const QuestionClaims& claims,
                             const ContrastFinding& these, const ContrastFinding& alike)
{
    return described(analysis, question, alike.a) + " and " + described(analysis, question, alike.b) +
           ": for fabrics like these, " + differencePart(alike) + "; for these fabrics, " + differencePart(these) +
           (these.claim.mean.why.empty() ? dzPart(question, these) : "") + "." + equivalencePart(claims, alike) +
           " Verdict for fabrics like these: " + wordsOf(alike.claim.verdict) + ".";
}

QuestionSentences sentencesOf(const StudyAnalysis& analysis, const QuestionAnalysis& question, const QuestionClaims& claims)
{
    QuestionSentences all{question.question.id, {}, {}, {}};
    if (std::string text = overallSentence(question, claims); !text.empty()) all.overall.push_back(text);
    if (const auto* choices = std::get_if<ChoiceAnalysis>(&question.findings))
        for (std::size_t i = 0; i < choices->conditions.size(); ++i)
            if (const ChanceFinding* finding = testableOf(claims, analysis.data.conditions[i]))
                all.chance.push_back(chanceSentence(*choices, choices->conditions[i], *finding));
    for (std::size_t i = 0; i + 1 < claims.contrasts.size(); i += 2)
        all.contrasts.push_back(contrastSentence(analysis, question, claims, claims.contrasts[i], claims.contrasts[i + 1]));
    return all;
}

/// Whether a test of all conditions for these fabrics is printed. Its degrees of freedom are corrected ones.
bool hasCorrectedF(const StudyAnalysis& analysis)
{
    return std::ranges::any_of(analysis.questions, [](const QuestionAnalysis& question) {
        const QuestionClaims* claims = claimsOf(question);
        return claims != nullptr && std::ranges::any_of(claims->omnibus, [](const OmnibusFinding& finding) {
                   return finding.generalisation == Generalisation::TheseFabrics && finding.test.why.empty();
               });
    });
}

std::string degreesSentences(const StudyAnalysis& analysis)
{
    const std::string satterthwaite = "Degrees of freedom with a decimal are Satterthwaite\u2019s";
    if (!hasCorrectedF(analysis)) return satterthwaite + ".";
    return satterthwaite +
           " in <i>t</i> tests, and in <i>F</i> tests for fabrics like these. <i>F</i> tests for these fabrics have degrees of "
           "freedom after Greenhouse and Geisser\u2019s correction.";
}

std::string listOf(const std::string& heading, const std::vector<std::string>& sentences)
{
    if (sentences.empty()) return {};
    if (sentences.size() > mostUnfolded)
        return folded(heading + ": " + counted(sentences.size(), "sentence"), bulletList(sentences));
    return paragraph("<b>" + protocols::escapedMarkup(heading) + "</b>") + bulletList(sentences);
}

}  // namespace

std::vector<QuestionSentences> paperSentences(const StudyAnalysis& analysis)
{
    std::vector<QuestionSentences> all;
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionClaims* claims = claimsOf(question)) all.push_back(sentencesOf(analysis, question, *claims));
    std::erase_if(
        all, [](const QuestionSentences& one) { return one.overall.empty() && one.chance.empty() && one.contrasts.empty(); });
    return all;
}

std::string sentencesLead(const StudyAnalysis& analysis)
{
    std::string html;
    for (const QuestionSentences& one : paperSentences(analysis))
        html += listOf(one.question + ", all conditions", one.overall) + listOf(one.question + ", against chance", one.chance) +
                listOf(one.question + ", contrasts", one.contrasts);
    if (html.empty()) return html;
    return paragraph(
               "Sentences to paste, in APA form. p values of conditions and contrasts carry Holm\u2019s correction within their "
               "family; tests against chance are one-sided; intervals are not corrected. <i>d<sub>z</sub></i> is the mean "
               "difference of the participants in standard deviations of these differences. " +
               degreesSentences(analysis)) +
           html;
}

}  // namespace reports
