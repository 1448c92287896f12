#include "reports/page/findings.h"

#include <algorithm>
#include <map>

#include "protocols/files/markup_text.h"
#include "reports/analysis/claim_words.h"
#include "reports/data/design_limits.h"
#include "reports/page/plan_section.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using stats::Generalisation;

/// "< .001" or "= .032".
std::string pSentence(const stats::Value& p)
{
    if (!p.exists()) return "undefined";
    return *p < 0.001 ? "&lt; .001" : "= " + pText(*p);
}

/// Conditions above chance, for one generalisation.
std::vector<std::string> aboveChance(const ChoiceAnalysis& choices, Generalisation generalisation)
{
    std::vector<std::string> labels;
    for (const ChanceFinding& finding : choices.claims.aboveChance)
        if (finding.generalisation == generalisation && finding.claim.isAbove) labels.push_back(htmlLabel(finding.condition));
    return labels;
}

/// The conditions that are not tested, because guessing is not right in 1/m of the answers.
std::vector<std::string> withoutChance(const StudyAnalysis& analysis, const ChoiceAnalysis& choices)
{
    std::vector<std::string> labels;
    for (const std::string& condition : untestedConditions(analysis.data, choices)) labels.push_back(htmlLabel(condition));
    return labels;
}

/// Names the conditions without any variation, for which no test exists.
std::string withoutVariation(const ChoiceAnalysis& choices, double share, const std::string& answers)
{
    std::vector<std::string> labels;
    for (std::size_t i = 0; i < choices.claims.aboveChance.size(); ++i) {
        if (!choices.conditions[i / 2].noChance.empty()) continue;  // each condition stands there twice
        const ChanceFinding& finding = choices.claims.aboveChance[i];
        const stats::CrossedMean& mean = finding.claim.mean;
        const bool isConstant = !mean.why.empty() && mean.values > 1 && mean.estimate.exists() && *mean.estimate == share;
        if (finding.generalisation == Generalisation::FabricsLikeThese && isConstant)
            labels.push_back(htmlLabel(finding.condition));
    }
    if (labels.empty()) return {};
    return " All answers were " + answers + " under " + listed(labels) +
           ": how much others vary is unknown, so there is no such test (see the exact test of the trials in the table).";
}

std::string chanceSentence(const StudyAnalysis& analysis, const std::string& id, const ChoiceAnalysis& choices)
{
    const std::vector<std::string> untested = withoutChance(analysis, choices);
    const std::size_t tested = analysis.data.conditions.size() - untested.size();
    const std::string m = std::to_string(choices.alternatives);
    const std::string reason = untested.empty() ? ""
                                                : " There is no test against chance (1/" + m + ") under " + listed(untested) +
                                                      ": the pairs were not half the same, so guessing is not right in half of "
                                                      "them. Read d\u2032 and its interval.";
    if (tested == 0 && !untested.empty()) return id + ":" + reason;
    const std::vector<std::string> alike = aboveChance(choices, Generalisation::FabricsLikeThese),
                                   these = aboveChance(choices, Generalisation::TheseFabrics);
    std::string text = id + ": matching is shown to be above chance (1/" + m + ") in " + std::to_string(alike.size()) + " of " +
                       counted(tested, untested.empty() ? "condition" : "tested condition") + " for fabrics like these";
    text += alike.empty() ? "." : ": " + listed(alike) + ".";
    if (these == alike)
        text += " For these fabrics only the result is the same.";
    else
        text += " For these fabrics only it is in " + std::to_string(these.size()) +
                (these.empty() ? "." : ": " + listed(these) + ".");
    return text + withoutVariation(choices, 1, "right") + withoutVariation(choices, 0, "wrong") + reason;
}

/// The smallest and the largest of the conditions' values; empty for fewer than two.
template <class Conditions, class ValueOf>
std::string rangeSentence(const StudyAnalysis& analysis, const Conditions& conditions, const std::string& what,
                          const ValueOf& valueOf)
{
    std::vector<std::pair<double, std::string>> values;
    for (std::size_t i = 0; i < conditions.size(); ++i)
        if (const stats::Value& value = valueOf(conditions[i]); value.exists())
            values.emplace_back(*value, analysis.data.conditions[i]);
    if (values.size() < 2) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (low->first == high->first) return what + " are " + fixed(low->first, 1) + " in all conditions.";
    return what + " range from " + fixed(low->first, 1) + " (" + htmlLabel(low->second) + ") to " + fixed(high->first, 1) + " (" +
           htmlLabel(high->second) + ").";
}

/// The primary contrast, or the only one; null where there is neither.
const ContrastFinding* primaryOf(const QuestionClaims& claims, Generalisation generalisation)
{
    for (const ContrastFinding& finding : claims.contrasts)
        if ((finding.primary || claims.contrasts.size() == 2) && finding.generalisation == generalisation) return &finding;
    return nullptr;
}

std::string verdictText(const ContrastFinding& finding)
{
    if (!finding.claim.mean.why.empty()) return "there is no test (" + protocols::escapedMarkup(finding.claim.mean.why) + ")";
    const stats::ContrastClaim& claim = finding.claim;
    std::string text = "<b>" + wordsOf(claim.verdict) + "</b> (";
    text += "p of the difference " + pSentence(claim.pAdjusted);
    if (claim.pEquivalenceAdjusted.exists()) text += ", of equivalence " + pSentence(claim.pEquivalenceAdjusted);
    return text + ")";
}

std::string byFabricSentence(const ContrastFinding& finding)
{
    std::vector<double> values;
    for (const stats::Value& value : finding.byFabric)
        if (value.exists()) values.push_back(*value);
    if (values.size() < 2) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return " On single fabrics the difference runs from " + typeset(fixed(*low, 2)) + " to " + typeset(fixed(*high, 2)) + ".";
}

std::string leaveOneOutSentence(const ContrastFinding& finding)
{
    const std::vector<LeftOneOut>& list = finding.withoutFabric;
    const auto changed =
        std::count_if(list.begin(), list.end(), [&](const LeftOneOut& one) { return one.verdict != finding.claim.verdict; });
    if (changed == 0) return list.empty() ? "" : " The verdict stays the same without any single fabric.";
    return " Without one of the fabrics, the verdict is another in " + std::to_string(changed) + " of " +
           std::to_string(list.size()) + " cases.";
}

/// The primary contrast, or the only one, for both generalisations.
std::string primarySentence(const std::string& id, const QuestionClaims& claims)
{
    const ContrastFinding* alike = primaryOf(claims, Generalisation::FabricsLikeThese);
    const ContrastFinding* these = primaryOf(claims, Generalisation::TheseFabrics);
    if (alike == nullptr || these == nullptr) return {};
    const stats::CrossedMean& mean = alike->claim.mean.why.empty() ? alike->claim.mean : these->claim.mean;
    std::string text =
        id + (alike->primary ? ", primary contrast " : ", ") + htmlLabel(alike->a) + " \u2212 " + htmlLabel(alike->b) + ": ";
    if (mean.estimate.exists() && mean.ci90.low.exists())
        text += typeset(fixed(*mean.estimate, 2)) + ", 90 % interval [" + typeset(fixed(*mean.ci90.low, 2)) + ", " +
                typeset(fixed(*mean.ci90.high, 2)) + "]. ";
    text += "For fabrics like these: " + verdictText(*alike) + ". For these fabrics only: " + verdictText(*these) + ".";
    return text + byFabricSentence(*alike) + (alike->claim.mean.why.empty() ? leaveOneOutSentence(*alike) : "");
}

/// "Q2: of 12 planned contrasts, 2 are different and 10 not decided for fabrics like these."
std::string familySentence(const std::string& id, const QuestionClaims& claims)
{
    std::map<stats::Verdict, std::size_t> counts;
    std::size_t tested = 0;
    for (const ContrastFinding& finding : claims.contrasts) {
        if (finding.generalisation != Generalisation::FabricsLikeThese) continue;
        ++counts[finding.claim.verdict];
        ++tested;
    }
    if (tested < 2) return {};
    std::vector<std::string> parts;
    for (const auto& [verdict, count] : counts) parts.push_back(std::to_string(count) + " " + wordsOf(verdict));
    return id + ": of " + std::to_string(tested) + (arePlanned(claims) ? " planned contrasts" : " pairs") +
           ", for fabrics like these: " + listed(parts) + ".";
}

/// Says so where the numbers of participants and fabrics cannot carry a result for others.
std::string smallStudySentence(const StudyData& data)
{
    const std::size_t participants = answeringParticipants(data), fabrics = data.fabrics.size();
    if (participants == 1) return "With 1 participant this study cannot show what holds for others.";
    // One condition is compared with chance only.
    const bool hasClaims = data.conditions.size() > 1 || std::ranges::any_of(data.questions, [](const QuestionInfo& question) {
                               const Scoring scoring = scoringOf(question.kind);
                               return std::holds_alternative<RightOrWrong>(scoring);
                           });
    if (canSpeakForOtherFabrics(data) || !hasClaims) return {};
    if (fabrics >= fewestFabrics)
        return "With " + counted(participants, "participant") +
               " the claims for fabrics like these are not reliable: without any difference, such small studies claim one far "
               "too "
               "often. Read the claims for these fabrics, or measure the rate: --resimulate.";
    return "With " + counted(fabrics, "fabric") +
           " this study can hardly show what holds for fabrics like these: their variation is known from too few.";
}

std::string wordsSentence(const std::string& id, const WordedAnalysis& words)
{
    std::size_t speakers = 0;
    for (std::size_t i = 0; i < words.answers.size(); ++i)
        speakers += i == 0 || words.answers[i].participant != words.answers[i - 1].participant ? 1 : 0;
    return id + ": " + counted(speakers, "participant") + " gave " + counted(words.answers.size(), "answer") + " in words.";
}

}  // namespace

std::vector<std::string> findings(const StudyAnalysis& analysis)
{
    std::vector<std::string> sentences;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis)) {
        sentences.push_back(rangeSentence(analysis, question.findings.conditions,
                                          protocols::escapedMarkup(question.id()) + ": matches per rendering",
                                          [](const ConditionChoices& one) { return one.matchesPerRendering; }));
        sentences.push_back(chanceSentence(analysis, protocols::escapedMarkup(question.id()), question.findings));
    }
    for (const auto& question : questionsWith<RatingAnalysis>(analysis))
        sentences.push_back(rangeSentence(analysis, question.findings.conditions,
                                          protocols::escapedMarkup(question.id()) + ": mean ratings",
                                          [](const ConditionRatings& one) { return one.mean; }));
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionClaims* claims = claimsOf(question)) {
            const std::string id = protocols::escapedMarkup(question.question.id);
            sentences.push_back(primarySentence(id, *claims));
            sentences.push_back(familySentence(id, *claims));
        }
    sentences.push_back(smallStudySentence(analysis.data));
    for (const auto& question : questionsWith<WordedAnalysis>(analysis))
        sentences.push_back(wordsSentence(protocols::escapedMarkup(question.id()), question.findings));
    for (std::string& sentence : planFindings(analysis)) sentences.push_back(std::move(sentence));
    std::erase(sentences, std::string());
    return sentences;
}

}  // namespace reports
