#include "reports/page/findings.h"

#include <algorithm>

#include "protocols/files/markup_text.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

std::string pSentence(double p) { return p < 0.001 ? "p &lt; .001" : "p = " + pText(p); }

std::string chanceSentence(const StudyAnalysis& analysis, const std::string& id, const ChoiceAnalysis& choices)
{
    std::vector<std::string> above;
    std::size_t tested = 0;
    for (std::size_t i = 0; i < choices.conditions.size(); ++i) {
        const stats::Value& p = choices.conditions[i].pHolm;
        tested += p.exists() ? 1 : 0;
        if (p.exists() && *p < 0.05) above.push_back(htmlLabel(analysis.data.conditions[i]));
    }
    const std::string rule =
        " (exact binomial tests against 1/" + std::to_string(choices.alternatives) + " over trials, Holm-corrected, 5 % level)";
    if (tested == 0) return id + ": there are no trials to test against chance.";
    if (above.empty())
        return id + ": matching is not shown to be above chance in any of " + counted(tested, "condition") + rule + ".";
    return id + ": matching is above chance in " + std::to_string(above.size()) + " of " + counted(tested, "condition") + rule +
           ": " + listed(above) + ".";
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
    return what + " range from " + fixed(low->first, 1) + " (" + htmlLabel(low->second) + ") to " + fixed(high->first, 1) + " (" +
           htmlLabel(high->second) + ").";
}

std::string contrastSentence(const std::string& id, const PairComparison& comparison, const PairEquivalence& equivalence)
{
    const stats::EquivalenceTest& test = equivalence.test;
    const std::string pair = id + ", " + htmlLabel(comparison.pair.a) + " \u2212 " + htmlLabel(comparison.pair.b) + ": ";
    const stats::Value& p = comparison.pHolm;
    if (!p.exists() || !test.estimate.exists())
        return pair + "there is no test (" + protocols::escapedMarkup(p.exists() ? test.estimate.why() : p.why()) + ").";
    return pair + "the difference is " + typeset(fixed(*test.estimate, 2)) + " scale points (90 % interval [" +
           typeset(fixed(*test.ci.low, 2)) + ", " + typeset(fixed(*test.ci.high, 2)) +
           "]). t test: " + pSentence(*comparison.test.p) + ", after Holm's correction " + pSentence(*p) +
           ". Equivalence test: " + pSentence(*test.p) + ". Verdict: <b>" + protocols::escapedMarkup(equivalence.verdict) +
           "</b>.";
}

/// The protocol's first planned contrast, the study's main question.
bool isMainContrast(const StudyData& data, const ConditionPair& pair)
{
    if (data.planned.empty()) return false;
    const auto& [a, b] = data.planned.front();
    return (pair.a == a && pair.b == b) || (pair.a == b && pair.b == a);
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
    for (const auto& question : questionsWith<RatingAnalysis>(analysis))
        for (std::size_t i = 0; i < question.findings.comparisons.size(); ++i)
            if (isMainContrast(analysis.data, question.findings.comparisons[i].pair))
                sentences.push_back(contrastSentence(protocols::escapedMarkup(question.id()), question.findings.comparisons[i],
                                                     question.findings.equivalences[i]));
    for (const auto& question : questionsWith<WordedAnalysis>(analysis))
        sentences.push_back(wordsSentence(protocols::escapedMarkup(question.id()), question.findings));
    std::erase(sentences, std::string());
    return sentences;
}

}  // namespace reports
