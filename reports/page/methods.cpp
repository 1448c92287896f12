#include "reports/page/methods.h"

#include <algorithm>
#include <optional>
#include <set>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
#include "reports/cells/finger_motion.h"
#include "reports/cells/response_time.h"
#include "reports/data/design_limits.h"
#include "reports/page/anchor_text.h"
#include "reports/page/plan_section.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using ChoiceQuestions = std::vector<AnalysedQuestion<ChoiceAnalysis>>;

bool haveOneChance(const ChoiceQuestions& questions)
{
    std::set<int> alternatives;
    for (const auto& question : questions) alternatives.insert(question.findings.alternatives);
    return alternatives.size() == 1;
}

/// "1/3", or "1/m" where the questions differ.
std::string chanceText(const ChoiceQuestions& questions)
{
    return haveOneChance(questions) ? "1/" + std::to_string(questions.front().findings.alternatives) : "1/m";
}

/// "3 for Q1 and 2 for Q5"
std::string alternativesOfEach(const ChoiceQuestions& questions)
{
    std::vector<std::string> each;
    for (const auto& question : questions)
        each.push_back(std::to_string(question.findings.alternatives) + " for " + protocols::escapedMarkup(question.id()));
    return listed(each);
}

/// "Chance is 1/3", or the value of m for each question.
std::string chanceSentence(const ChoiceQuestions& questions)
{
    std::string text = "Chance is " + chanceText(questions);
    std::vector<std::string> assumed;
    for (const auto& question : questions)
        if (question.analysis.question.alternativesAssumed) assumed.push_back(protocols::escapedMarkup(question.id()));
    const std::string origin = assumed.empty()
                                   ? std::string()
                                   : " For " + listed(assumed) + " this is the default of this program: no protocol " +
                                         "and no option stated the number of alternatives.";
    if (haveOneChance(questions)) return text + "." + origin;
    return text + ", where m is the number of answers to choose from: " + alternativesOfEach(questions) + "." + origin;
}

bool anyPlanned(const StudyAnalysis& analysis)
{
    return std::ranges::any_of(analysis.questions, [](const QuestionAnalysis& question) {
        const QuestionClaims* claims = claimsOf(question);
        return claims != nullptr && arePlanned(*claims);
    });
}

/// What was left out in turn. A quick report says elsewhere that it leaves out nothing.
std::string leftOutSentence(const StudyAnalysis& analysis)
{
    bool withoutFabrics = false, withoutParticipants = false;
    std::size_t largestFamily = 0;
    for (const QuestionAnalysis& question : analysis.questions)
        if (const QuestionClaims* claims = claimsOf(question)) {
            largestFamily = std::max(largestFamily, claims->contrasts.size() / 2);  // each stands there twice
            for (const ContrastFinding& finding : claims->contrasts) {
                withoutFabrics = withoutFabrics || !finding.withoutFabric.empty();
                withoutParticipants = withoutParticipants || !finding.withoutParticipant.empty();
            }
        }
    if (withoutFabrics && withoutParticipants)
        return " Each family is analysed again without each fabric and without each participant.";
    std::string text;
    if (withoutFabrics) text += " Each family is analysed again without each fabric.";
    if (withoutParticipants) text += " Each family is analysed again without each participant.";
    if (analysis.depth == Depth::Quick) return text;
    if (largestFamily > mostContrastsLeftOut)
        return " A family of more than " + std::to_string(mostContrastsLeftOut) +
               " contrasts is not analysed again without single fabrics or participants.";
    if (withoutFabrics && analysis.data.participants.size() > mostLeftOut)
        text += " With more than " + std::to_string(mostLeftOut) + " participants, none of them is left out in turn.";
    return text;
}

std::string testedFamilySentence(const StudyAnalysis& analysis)
{
    if (anyPlanned(analysis))
        return " The planned contrasts of a question are one family, in the order and with the sign of " +
               contrastsSource(analysis.data) + ", the primary one first.";
    const std::string none = " No planned contrast applies to these answers: ";
    return none + (comparesAllPairs(analysis.data) ? "all pairs of a question are one family."
                                                   : "no difference is tested, because all pairs are too many.");
}

std::string claimsParagraph(const StudyAnalysis& analysis, bool hasChoices)
{
    std::string text =
        "<b>Two generalisations.</b> Each claim is made twice. &ldquo;For these fabrics&rdquo;: participants are a sample, the "
        "fabrics are all there are. The test is Student's t on the participants' means over fabrics. &ldquo;For fabrics like "
        "these&rdquo;: participants and fabrics are samples. A linear mixed model (REML) is fitted to the ratings under the two "
        "conditions alone. Its random intercepts are participant, fabric, participant &times; condition and fabric &times; "
        "condition, so each pair has variances of its own. If ratings are missing, the model is fitted to the differences of the "
        "two conditions, with crossed random intercepts of participant and fabric. The t test has Satterthwaite's degrees of "
        "freedom. They have a limit where the differences vary neither with participants nor with fabrics by these estimates. It "
        "applies if all conditions together show such an interaction (F tests, p &lt; .05), or if answers are missing. It is "
        "1.2 / (r<sub>p</sub><sup>6</sup> / (participants &minus; 1) + r<sub>f</sub><sup>6</sup> / (fabrics &minus; 1)). "
        "Here r is the mean square of the participants' or fabrics' differences over that of their residual. The verdict of the "
        "summary is the second.";
    if (hasChoices)
        text +=
            " Choices count as 0 and 1 in these tests, and the model is always that of the differences. Odds and effects come "
            "from the logistic mixed models, whose tests reject "
            "too often with few fabrics.";
    return text + testedFamilySentence(analysis) +
           " Holm's correction is taken within the family: once for the differences, once for the equivalences, separately for "
           "each generalisation. The verdict is &ldquo;different&rdquo; or &ldquo;equivalent&rdquo; if the corrected p is below "
           ".05. It is &ldquo;different, within the bounds&rdquo; if both are, and &ldquo;not decided&rdquo; if neither is." +
           leftOutSentence(analysis);
}

std::string unitParagraph()
{
    return "<b>Unit of analysis.</b> The answers of one participant are not independent, and neither are the answers to one "
           "fabric. No test between conditions counts them one by one. Means and SDs of ratings describe the ratings. "
           "95 % intervals (Student's t) are those of the participants' means. Where participants have unequal numbers of "
           "ratings, the mean of these means differs from that of all ratings. Figures show it with its interval, and tables "
           "have both.";
}

/// Shares of pairs that were the same, over the conditions.
struct SameShares {
    std::optional<double> least = {}, most = {};

    void add(double share)
    {
        least = std::min(least.value_or(1), share);
        most = std::max(most.value_or(0), share);
    }
    std::string text() const
    {
        const std::string low = percentText(*least, 1), high = percentText(*most, 1);
        return low == high ? low : low + " to " + high;
    }
};

/// What a share correct of 1/2 means, by the share of pairs that were the same under each condition.
std::string halfSentences(const AnalysedQuestion<ChoiceAnalysis>& question)
{
    SameShares tested, untested;
    for (const ConditionChoices& condition : question.findings.conditions) {
        if (!condition.matches) continue;
        const auto same = static_cast<double>(condition.matches->counts.same);
        const double pairs = same + static_cast<double>(condition.matches->counts.different);
        if (pairs > 0) (condition.noChance.empty() ? tested : untested).add(same / pairs);
    }
    const std::string share = " The share correct of " + protocols::escapedMarkup(question.id());
    const std::string isTested = share + " is tested against 1/2";
    if (!tested.least && !untested.least)
        return isTested +
               ". The answers do not show how many pairs were the same: guessing gives 1/2 only where half of them were.";
    const std::string measure = " Whoever guesses is then not right in half of them. d\u2032 is the measure to read.";
    if (!tested.least)
        return share + " is not tested against 1/2, because " + untested.text() + " of the pairs were the same." + measure;
    const bool isHalf = *tested.least == 0.5 && *tested.most == 0.5;
    const std::string because = isTested + ", because " + (isHalf ? "half" : "about half (" + tested.text() + ")") +
                                " of the pairs were the same. Whoever feels no difference gets half of them right on average.";
    if (!untested.least) return because;
    return because + " There is no test under conditions where " + untested.text() + " were the same." + measure;
}

/// Empty where no question asks for same or different.
std::string hitsSentences(const ChoiceQuestions& questions)
{
    const bool isAsked = std::any_of(questions.begin(), questions.end(),
                                     [](const auto& question) { return ruleOfDPrime(question.findings) == DPrimeRule::OfHits; });
    if (!isAsked) return "";
    std::string halves;
    for (const auto& question : questions)
        if (ruleOfDPrime(question.findings) == DPrimeRule::OfHits) halves += halfSentences(question);
    return " In a question of same or different, d\u2032 is z(hit rate) \u2212 z(false-alarm rate). A hit is &ldquo;same&rdquo; "
           "said of a pair that was the same. d\u2032 does not depend on how readily a participant says &ldquo;same&rdquo;; the "
           "criterion c measures that. 1/2 is added to each count and 1 to each number of pairs (Hautus 1995). Intervals are by "
           "the jackknife: over participants, or over participants and fabrics. The answers of all participants are pooled. So "
           "d\u2032 comes out somewhat too small where their criteria differ." +
           halves;
}

/// What d' is where it follows from the share correct. Empty where every question asks for same or different.
std::string shareSentences(const ChoiceQuestions& questions)
{
    std::vector<std::string> ids;
    for (const auto& question : questions)
        if (ruleOfDPrime(question.findings) == DPrimeRule::OfShare) ids.push_back(protocols::escapedMarkup(question.id()));
    if (ids.empty()) return "";
    return std::string(" d\u2032") + (ids.size() == questions.size() ? "" : " of " + listed(ids)) +
           " belongs to the mean share. The ends of its interval are the d\u2032 of the ends of the interval of the share: 0 at "
           "or below chance, unbounded at 1.";
}

/// "10", or "Q1: 10 and Q5: 9" where not all participants answered every question.
std::string peopleText(const StudyData& data, const ChoiceQuestions& questions)
{
    std::set<std::size_t> counts;
    std::vector<std::string> named;
    for (const auto& question : questions) {
        const std::size_t people = answeringParticipants(data, question.findings);
        counts.insert(people);
        named.push_back(protocols::escapedMarkup(question.id()) + ": " + std::to_string(people));
    }
    return counts.size() == 1 ? std::to_string(*counts.begin()) : listed(named);
}

std::string matchesParagraph(const StudyData& data, const ChoiceQuestions& questions)
{
    return "<b>Matches.</b> &ldquo;Matches per rendering&rdquo; is the share correct times the number of participants (" +
           peopleText(data, questions) + "). " + chanceSentence(questions) +
           " &ldquo;Above chance&rdquo; is tested one-sided on the mean share, with participants and fabrics as samples, and "
           "corrected over the conditions. Its interval is drawn in the figure. The table of matches has it for both "
           "generalisations. The exact binomial test and Wilson's interval beside it count the trials as independent, which they "
           "are not; they describe." +
           shareSentences(questions) + " The CSV file also has the two-sided t test of the participants' shares against " +
           chanceText(questions) + ". Choices have no equivalence test, because the bounds are scale points." +
           hitsSentences(questions);
}

std::string pairsParagraph()
{
    return "<b>All pairs of participants' means.</b> All pairs of conditions are also compared by two-sided paired t tests, on "
           "the participants who answered under both conditions. A participant's means are those over the fabrics answered under "
           "both, with repetitions averaged first. Otherwise a missing answer would make a difference of fabrics look like one "
           "of conditions. Analyses of variance and rank tests take the fabrics answered under all conditions. "
           "Holm's correction covers all pairs of a question. These tests hold "
           "for these fabrics only. d<sub>z</sub> is the mean difference divided by the SD of the differences.";
}

std::string equivalenceParagraph(const StudyData& data)
{
    const std::string text =
        "<b>Different and equivalent are two questions.</b> A t test asks whether two means differ. A small p shows that they "
        "do. A large p shows only that no difference was found, which is common with few participants. Neither shows that two "
        "renderings, or generated and measured signals, are alike. Published work has read p &lt; 0.05 of a t test as "
        "&ldquo;the averages are close&rdquo;, which reverses the meaning of the test. Likeness is tested here by two "
        "one-sided tests. " +
        boundsSentence(data) +
        " Both tests must reject at 5 %. Without a correction they do so exactly when the 90 % interval lies inside the "
        "bounds. A difference can be real and too small to matter.";
    if (!comparesAllPairs(data)) return text;
    return text +
           " The tables of all pairs carry verdicts of an older form: the first part is the corrected t test, the second the "
           "equivalence test without a correction.";
}

std::string omnibusParagraph(bool hasChoices, bool hasRatings)
{
    std::string text = "<b>All conditions.</b>";
    if (hasRatings)
        text +=
            " Ratings: repeated-measures analysis of variance with the Greenhouse&ndash;Geisser correction beside it, and "
            "Friedman's test, corrected for ties. Both take participants with a fabric that they rated under all conditions.";
    if (hasChoices)
        text +=
            " Choices: Cochran's Q over blocks of participant &times; fabric. It takes all answers as independent and only "
            "describes.";
    text +=
        " These results hold for new participants who touch these fabrics. Those of the mixed models hold for new "
        "participants and new fabrics.";
    if (hasRatings)
        text +=
            " The model of ratings has random intercepts of participant, fabric and their interactions with condition (REML, "
            "Satterthwaite's degrees of freedom). The cumulative logit model takes ratings as ordered categories. It has random "
            "intercepts of participant and fabric (Laplace approximation), and no claim rests on it.";
    if (hasChoices)
        text +=
            " The logistic models of choices have random intercepts of participant and fabric, and in the second their "
            "interactions with condition (Laplace approximation, likelihood-ratio test). The linear mixed model of the choices "
            "as 0 and 1 decides, because its test keeps its level.";
    return text +
           " The table notes where a random effect was estimated as zero (singular fit), and where a condition was always or "
           "never right (separation).";
}

std::string measuredSizesParagraph()
{
    return "<b>Measured error rates.</b> The tables below show how often claims and tests reject when there is no true effect. "
           "The nulls have interactions of participants and fabrics with condition, because these make tests reject too often. "
           "The rates were measured for the paper's design (10 participants, 7 fabrics, 9 conditions). A test above 6 % is "
           "marked as "
           "anti-conservative. Tests that treat the fabrics as fixed say nothing about other fabrics.";
}

std::string speedParagraph(const ChoiceQuestions& questions, const StudyData& data)
{
    std::vector<std::string> ids;
    for (const auto& question : questions) ids.push_back(protocols::escapedMarkup(question.id()));
    const bool hasInstructions = std::ranges::any_of(questions, [&](const auto& one) { return isInstructed(data, one.id()); });
    return "<b>Speed and accuracy</b> are those of " + listed(ids) +
           (ids.size() > 1 ? ". The table by condition is about " + ids.front() + ". " : ". ") +
           responseTimeSentence(data.times) + " Bits per second are the information of one choice among m" +
           (haveOneChance(questions) ? " = " + std::to_string(questions.front().findings.alternatives)
                                     : " answers (" + alternativesOfEach(questions) + ")") +
           " divided by the mean time. That information is log<sub>2</sub> m + p log<sub>2</sub> p + (1 &minus; p) "
           "log<sub>2</sub>((1 &minus; p)/(m &minus; 1)) for a share correct p, and 0 at or below chance. The balanced "
           "integration score is the z score of the share correct minus the z score of the mean time. Both are taken over all "
           "participant &times; condition cells (population SD) and averaged by condition. Higher is better, and 0 is the "
           "average. The interval of the median time is Student's t over the participants' log medians. The interval of bits per "
           "second is that of a ratio (MOVER): the limits of the share correct and of the mean "
           "time are Student's t over participants. The interval of the score is Student's t over the participants' scores. "
           "Conditions are compared by paired t tests over participants: of jackknife pseudo-values of bits per second, of the "
           "scores, and of the mean logarithms of the time. They take the choices with a time about fabrics that the participant "
           "timed under both. Holm's correction covers the contrasts of a measure. These results "
           "hold for new participants and these fabrics. The share correct by response time uses quarters of each participant's "
           "own times. Slow conditions may also be hard ones, so its trend is that at equal " +
           heldEqual(hasInstructions) + ".";
}

bool haveInstructions(const ChoiceQuestions& questions)
{
    return std::ranges::any_of(questions,
                               [](const auto& question) { return !question.findings.instructions.instructions.empty(); });
}

/// Who answered what under each instruction.
std::string instructedAnswersSentence(const ChoiceQuestions& questions)
{
    const bool areComplete = std::ranges::all_of(questions, [](const auto& question) {
        return question.findings.instructions.instructions.empty() || question.findings.instructions.isComplete;
    });
    if (areComplete) return ": everybody answered every condition and fabric under each of them. ";
    return ". Not everybody answered every condition and fabric under each of them. Where a fabric was answered under several "
           "instructions, two conditions are compared under those that both have. Two instructions are compared on the "
           "conditions and fabrics answered under both, where there are any. ";
}

std::string instructionParagraph(const ChoiceQuestions& questions)
{
    return "<b>Instructions.</b> Blocks asked the participants to be fast or accurate, or to answer before a deadline. The "
           "instruction is a factor within participants" +
           instructedAnswersSentence(questions) +
           "Tests between conditions take the mean over the instructions. Measures by instruction take all conditions together. "
           "Their balanced integration scores are standardised over all participant &times; instruction cells; those by "
           "condition over all participant &times; condition &times; instruction cells. Instructions are compared by paired t "
           "tests over participants, with Holm's correction over the contrasts of a measure. Condition, instruction and their "
           "interaction are tested by an analysis of variance of the participants' means, with the Greenhouse&ndash;Geisser "
           "correction. An answer is late when its response time exceeds the deadline. Late answers are analysed like all "
           "others. These results hold for new participants and these fabrics.";
}

std::string touchParagraph()
{
    return "<b>The finger on the display</b> was measured by the display. Contact lasts while samples are at most " +
           fixed(longestGapSeconds, 1) +
           " s apart and their force is above 0. The speed of a presentation is the length of its " +
           "path through the time in contact. The path joins positions at least " + fixed(leastStepSeconds * 1000, 0) +
           " ms apart, because the noise of a sensor lengthens a path of shorter steps. The force is the mean over the time in "
           "contact. A presentation with less than " +
           fixed(leastContactSeconds, 1) +
           " s of contact has no speed and no force. The intervals are Student's t over the participants' means. They hold for "
           "new participants and these fabrics.";
}

std::string latencyParagraph()
{
    return "<b>Latencies of the operators</b> come from a task in which the operator presses a key at a signal. They show how "
           "late a time is that a key of the operator stamps. No time of this report was corrected by them.";
}

std::string orderParagraph(const StudyData& data)
{
    return "<b>Order, learning and fatigue.</b> For each participant, least squares give the change of the answers over the "
           "trials, with effects of " +
           std::string(isInstructed(data) ? "each condition under each instruction, and of fabric" : "condition and fabric") +
           ". The same is done for the logarithm of the response time, and for later "
           "sittings against the first. The mean of the participants' slopes is tested by Student's t, for these fabrics. "
           "Where the running orders balance the conditions over the trials, a change over trials adds noise and no bias. "
           "As a check, one contrast of each question is also shown without each participant's own trend: the primary one, or "
           "the largest. p and interval of the largest have Bonferroni's correction for the contrasts that it was picked from.";
}

std::string participantsParagraph(const StudyData& data)
{
    std::string text = "<b>Participants.</b> ";
    text += data.participantsSentence.empty() ? counted(data.participants.size(), "participant") + "."
                                              : protocols::escapedMarkup(data.participantsSentence);
    if (const std::size_t silent = data.participants.size() - answeringParticipants(data); silent > 0)
        text += " " + std::to_string(silent) + " of them gave no analysed answer and " + (silent == 1 ? "is" : "are") +
                " not counted as " + (silent == 1 ? "a participant." : "participants.");
    if (!data.withdrawn.empty())
        text += " In addition, " + counted(data.withdrawn.size(), "participant") +
                " withdrew. Answers given before are kept and not analysed, and the " + pluralOf(data.withdrawn.size(), "place") +
                " became free again.";
    if (!data.erased.empty())
        text += " The answers of " + counted(data.erased.size(), "participant") + " were erased, and the " +
                pluralOf(data.erased.size(), "place") + " became free again.";
    if (!data.catchResponses.empty())
        text += " No analysis uses the " + counted(data.catchResponses.size(), "answer") + " to catch trials with blank glass.";
    return text;
}

std::string missingParagraph()
{
    return "<b>Missing answers</b> are counted and left out. Each test uses the participants who have the answers that it needs, "
           "and reports its n. A value that does not exist (no variation, too few participants) is shown as &ndash; with its "
           "reason, never as p = 0 or 1.";
}

std::string wordsParagraph()
{
    return "<b>Answers in words</b> are listed as they were entered. Nothing is computed from them except their number.";
}

}  // namespace

std::vector<std::string> methodParagraphs(const StudyAnalysis& analysis)
{
    const ChoiceQuestions choices = questionsWith<ChoiceAnalysis>(analysis);
    const bool hasChoices = !choices.empty();
    const bool hasRatings = !questionsWith<RatingAnalysis>(analysis).empty();
    const bool hasWords = !questionsWith<WordedAnalysis>(analysis).empty();
    std::vector<std::string> paragraphs;
    if (hasChoices || hasRatings) paragraphs.push_back(unitParagraph());
    if (hasChoices || hasRatings) paragraphs.push_back(claimsParagraph(analysis, hasChoices));
    if (hasChoices) paragraphs.push_back(matchesParagraph(analysis.data, choices));
    if ((hasChoices || hasRatings) && comparesAllPairs(analysis.data)) paragraphs.push_back(pairsParagraph());
    if (hasRatings) paragraphs.push_back(equivalenceParagraph(analysis.data));
    if (hasChoices || hasRatings) paragraphs.push_back(omnibusParagraph(hasChoices, hasRatings));
    if (hasChoices || hasRatings) paragraphs.push_back(measuredSizesParagraph());
    if (hasChoices) paragraphs.push_back(speedParagraph(choices, analysis.data));
    if (haveInstructions(choices)) paragraphs.push_back(instructionParagraph(choices));
    if (!analysis.touch.empty()) paragraphs.push_back(touchParagraph());
    if (!analysis.data.operatorTaps.empty()) paragraphs.push_back(latencyParagraph());
    if (!analysis.order.questions.empty()) paragraphs.push_back(orderParagraph(analysis.data));
    if (std::string anchors = anchorsMethod(analysis); !anchors.empty()) paragraphs.push_back(std::move(anchors));
    if (hasWords) paragraphs.push_back(wordsParagraph());
    paragraphs.push_back(participantsParagraph(analysis.data));
    paragraphs.push_back(missingParagraph());
    for (const std::string& limit : analysis.designLimits)
        paragraphs.push_back("<b>Left out or taken for granted.</b> " + protocols::escapedMarkup(limit));
    return paragraphs;
}

}  // namespace reports
