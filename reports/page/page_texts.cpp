// The sentences of the page: what came out, and how it was computed.
#include <algorithm>

#include "reports/page/page.h"
#include "reports/tables/table.h"
#include "reports/text/condition_label.h"

namespace reports {
namespace {

std::string pSentence(double p) { return p < 0.001 ? "p &lt; .001" : "p = " + pText(p); }

std::string listed(const std::vector<std::string>& items)
{
    std::string text;
    for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
    return text;
}

std::string chanceSentence(const Analysis& analysis, const std::string& question)
{
    std::vector<std::string> above;
    std::size_t tested = 0;
    for (const Json& row : analysis.statistics[lowerCase(question) + "_per_condition"]) {
        const stats::Value p = valueOf(row, "p_holm");
        tested += p.exists() ? 1 : 0;
        if (p.exists() && *p < 0.05) above.push_back(htmlLabel(row["condition"]));
    }
    const std::string rule = " (exact binomial tests against 1/" + std::to_string(analysis.data.alternativesOf(question)) +
                             " over trials, Holm-corrected, 5 % level)";
    if (tested == 0) return question + ": there are no trials to test against chance.";
    if (above.empty())
        return question + ": in none of " + std::to_string(tested) + " conditions is matching shown to be above chance" + rule +
               ".";
    return question + ": matching is above chance in " + std::to_string(above.size()) + " of " + std::to_string(tested) +
           " conditions" + rule + ": " + listed(above) + ".";
}

std::string bestSentence(const Analysis& analysis, const std::string& question, const std::string& field, const std::string& what,
                         int decimals)
{
    std::vector<std::pair<double, std::string>> values;
    for (const std::string& condition : conditionsOf(analysis.results))
        if (const stats::Value value = valueOf(analysis.results[question][condition], field); value.exists())
            values.emplace_back(*value, condition);
    if (values.size() < 2) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return question + ": " + what + " from " + fixed(low->first, decimals) + " (" + htmlLabel(low->second) + ") to " +
           fixed(high->first, decimals) + " (" + htmlLabel(high->second) + ").";
}

std::string contrastSentence(const Json& comparison, const Json& equivalence)
{
    const stats::Value p = valueOf(comparison, "p_holm");
    const stats::Value difference = valueOf(equivalence, "mean_difference");
    const std::string pair = equivalence["question"].get<std::string>() + ", " + htmlLabel(equivalence["a"]) + " \u2212 " +
                             htmlLabel(equivalence["b"]) + ": ";
    if (!p.exists() || !difference.exists())
        return pair + "undefined (" + escapedHtml(p.exists() ? difference.why() : p.why()) + ").";
    const stats::Interval ci = intervalOf(equivalence, "ci90");
    return pair + "difference " + typeset(fixed(*difference, 2)) + ", 90 % interval [" + typeset(fixed(*ci.low, 2)) + ", " +
           typeset(fixed(*ci.high, 2)) + "]; t test " + pSentence(valueOf(comparison, "p").orElse(0)) + " (after Holm " +
           pSentence(*p) + "), equivalence test " + pSentence(*valueOf(equivalence, "p")) + ": <b>" +
           escapedHtml(equivalence["verdict"]) + "</b>.";
}

std::string boundsText(const Analysis& analysis)
{
    const auto [low, high] = analysis.data.equivalenceBounds;
    return (low < 0 ? "\u2212" + shortest(-low) : shortest(low)) + " and " + shortest(high);
}

bool isMainContrast(const StudyData& data, const Json& pair)
{
    if (data.planned.empty()) return false;
    const auto& [a, b] = data.planned.front();
    return (pair["a"] == a && pair["b"] == b) || (pair["a"] == b && pair["b"] == a);
}

/// Who they were, who withdrew, and what is not analysed.
std::string whoTookPart(const StudyData& data)
{
    std::string text = "<b>Participants.</b> ";
    text += data.participantsSentence.empty() ? counted(data.participants.size(), "participant") + "."
                                              : escapedHtml(data.participantsSentence);
    if (!data.withdrawn.empty())
        text += " Besides, " + counted(data.withdrawn.size(), "participant") +
                " withdrew; their answers are kept and not analysed, and their places were free again.";
    if (!data.catchResponses.empty())
        text += " " + counted(data.catchResponses.size(), "answer") + " to catch trials with blank glass are in no analysis.";
    return text;
}

}  // namespace

std::vector<std::string> findings(const Analysis& analysis)
{
    const Json& results = analysis.results;
    std::vector<std::string> sentences;
    for (const std::string& question : choiceQuestions(results)) {
        sentences.push_back(bestSentence(analysis, question, "matches_per_rendering", "mean matches per rendering", 1));
        sentences.push_back(chanceSentence(analysis, question));
    }
    for (const std::string& question : ratingQuestions(results))
        sentences.push_back(bestSentence(analysis, question, "mean", "mean ratings", 1));
    // The first contrast of the protocol is the study's main question; the others have their tables below.
    for (const Json& equivalence : results["equivalence"]) {
        if (!isMainContrast(analysis.data, equivalence)) continue;
        for (const Json& comparison : results["comparisons"])
            if (comparison["question"] == equivalence["question"] && comparison["a"] == equivalence["a"] &&
                comparison["b"] == equivalence["b"])
                sentences.push_back(contrastSentence(comparison, equivalence));
    }
    std::erase(sentences, std::string());
    return sentences;
}

std::vector<std::string> methodParagraphs(const Analysis& analysis)
{
    const std::string m = std::to_string(analysis.data.alternatives);
    const std::string n = std::to_string(analysis.data.participants.size());
    return {
        "<b>Unit of analysis.</b> Every test between conditions uses one number a participant and condition: the mean over "
        "fabrics (for choices, the share correct). The single answers are not independent and are never counted as if they were. "
        "Means and SDs of ratings describe the ratings; their 95 % intervals (Student's t) are those of the participants' means.",
        "<b>Matches.</b> &ldquo;Matches per rendering&rdquo; is the share correct times the number of participants (" + n +
            "). Intervals are Wilson's. Chance is 1/" + m +
            ": the exact binomial test over trials is one-sided (better than chance) and ignores that a participant's trials "
            "belong together; beside it stands the two-sided t test of the participants' shares against 1/" +
            m + ". Choices have no equivalence test: the protocol states no bounds for them.",
        "<b>Pairs.</b> Two-sided paired t tests of all pairs, on the participants who answered under both conditions; Holm's "
        "correction over all pairs of a question, planned contrasts included. d<sub>z</sub> is the mean difference divided by "
        "the SD of the differences.",
        "<b>Different, and equivalent, are two questions.</b> A t test asks whether two means differ. A small p says that they "
        "do; a large p says only that no difference was shown, which with few participants is easily had. Neither shows that two "
        "renderings, or generated and measured signals, are alike. (Published work has read p &lt; 0.05 of a t test as "
        "&ldquo;the averages are close&rdquo;: that reads the test backwards.) Likeness is tested here by two one-sided tests "
        "against bounds stated beforehand, " +
            boundsText(analysis) +
            " scale points: both must reject at 5 %, which happens exactly when the 90 % interval lies inside the bounds. The "
            "verdict has four cells: different (the corrected t test rejects) or not different, and equivalent or not shown "
            "equivalent. A difference can be real and too small to matter; and &ldquo;not different / not shown "
            "equivalent&rdquo; means that these data cannot tell. Equivalence p values are not corrected for the number of "
            "pairs.",
        "<b>All conditions.</b> Repeated-measures analysis of variance on complete participants, always with the "
        "Greenhouse&ndash;Geisser correction beside it; Friedman's test, corrected for ties; Cochran's Q for choices, over "
        "participant &times; fabric blocks, which is descriptive only. These speak of new participants touching these fabrics. "
        "The "
        "mixed models speak of new participants and new fabrics: ratings with random intercepts of participant, fabric and their "
        "interactions with condition (REML, Satterthwaite's degrees of freedom), choices with random intercepts of participant "
        "and fabric (Laplace, likelihood-ratio test). A random effect that is estimated as zero (singular fit) and a condition "
        "that was always or never right (separation) are said where they occur.",
        "<b>What the tests promise, measured.</b> The last table tells how often each test rejects when there is nothing to "
        "find; "
        "above 6 % it is marked as anti-conservative. Tests that take the fabrics as they are reject too often when fabrics "
        "differ in how conditions suit them: then the mixed model is the one to read.",
        "<b>Speed and accuracy.</b> Response time runs from the first touch to the spoken answer of the matching task. Bits per "
        "second: information of one choice among " +
            m +
            " (log<sub>2</sub> m + p log<sub>2</sub> p + (1 &minus; p) log<sub>2</sub>((1 &minus; p)/(m &minus; 1)), 0 at or "
            "below chance) over the mean time. Balanced integration score: z of the share correct minus z of the mean time over "
            "all participant &times; condition cells (SD of the population), averaged by condition; higher is better, and 0 is "
            "the average.",
        whoTookPart(analysis.data),
        "<b>Missing answers</b> are counted and left out; each test uses the participants who have what it needs, and its n is "
        "given. A value that does not exist (no variation, too few participants) is shown as &ndash; with its reason, never as p "
        "= 0 or 1.",
    };
}

}  // namespace reports
