#include "reports/page/methods.h"

#include <set>

#include "protocols/files/markup_text.h"
#include "protocols/files/number_text.h"
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

/// "Chance is 1/3", or the value of m for each question.
std::string chanceSentence(const ChoiceQuestions& questions)
{
    std::string text = "Chance is " + chanceText(questions);
    if (haveOneChance(questions)) return text + ".";
    std::vector<std::string> each;
    for (const auto& question : questions)
        each.push_back(std::to_string(question.findings.alternatives) + " for " + protocols::escapedMarkup(question.id()));
    return text + ", where m is the number of answers to choose from: " + listed(each) + ".";
}

std::string boundsText(const StudyData& data)
{
    return typeset(protocols::shortest(data.equivalenceBounds.first)) + " and " +
           typeset(protocols::shortest(data.equivalenceBounds.second));
}

std::string unitParagraph()
{
    return "<b>Unit of analysis.</b> Every test between conditions uses one number for each participant and condition: the mean "
           "over fabrics, or the share correct for choices. The single answers of a participant are not independent, so no such "
           "test counts them one by one. Means and SDs of ratings describe the ratings. Their 95 % intervals (Student's t) are "
           "those of the participants' means.";
}

std::string matchesParagraph(const StudyData& data, const ChoiceQuestions& questions)
{
    return "<b>Matches.</b> &ldquo;Matches per rendering&rdquo; is the share correct times the number of participants (" +
           std::to_string(data.participants.size()) + "). Intervals are Wilson's. " + chanceSentence(questions) +
           " The exact binomial test over trials is one-sided (better than chance). It ignores that the trials of one "
           "participant belong together. The table also gives the two-sided t test of the participants' shares against " +
           chanceText(questions) + ". Choices have no equivalence test, because the protocol states no bounds for them.";
}

std::string pairsParagraph()
{
    return "<b>Pairs.</b> All pairs of conditions are compared by two-sided paired t tests, on the participants who answered "
           "under both conditions. Holm's correction covers all pairs of a question, planned contrasts included. d<sub>z</sub> "
           "is the mean difference divided by the SD of the differences.";
}

std::string equivalenceParagraph(const StudyData& data)
{
    return "<b>Different and equivalent are two questions.</b> A t test asks whether two means differ. A small p shows that they "
           "do. A large p shows only that no difference was found, which is common with few participants. Neither shows that two "
           "renderings, or generated and measured signals, are alike. Published work has read p &lt; 0.05 of a t test as "
           "&ldquo;the averages are close&rdquo;, which reverses the meaning of the test. Likeness is tested here by two "
           "one-sided tests against bounds that were stated beforehand: " +
           boundsText(data) +
           " scale points. Both tests must reject at 5 %. They do so exactly when the 90 % interval lies inside the bounds. The "
           "verdict has two parts. The first is &ldquo;different&rdquo; (the corrected t test rejects) or &ldquo;not "
           "different&rdquo;. The second is &ldquo;equivalent&rdquo; or &ldquo;not shown equivalent&rdquo;. A difference can be "
           "real and too small to matter. &ldquo;Not different / not shown equivalent&rdquo; means that these data cannot "
           "decide. The p values of equivalence tests are not corrected for the number of pairs.";
}

std::string omnibusParagraph(bool hasChoices, bool hasRatings)
{
    std::string text = "<b>All conditions.</b>";
    if (hasRatings)
        text +=
            " Ratings: repeated-measures analysis of variance on complete participants, always with the Greenhouse&ndash;Geisser "
            "correction beside it, and Friedman's test, corrected for ties.";
    if (hasChoices) text += " Choices: Cochran's Q over blocks of participant &times; fabric, which is descriptive only.";
    text +=
        " These results hold for new participants who touch these fabrics. Those of the mixed models hold for new "
        "participants and new fabrics.";
    if (hasRatings)
        text +=
            " The model of ratings has random intercepts of participant, fabric and their interactions with condition (REML, "
            "Satterthwaite's degrees of freedom).";
    if (hasChoices)
        text +=
            " The model of choices has random intercepts of participant and fabric (Laplace approximation, likelihood-ratio "
            "test).";
    return text +
           " The table notes where a random effect was estimated as zero (singular fit), and where a condition was always or "
           "never right (separation).";
}

std::string measuredSizesParagraph()
{
    return "<b>Measured error rates.</b> The last table shows how often each test rejects when there is no true effect. A test "
           "above 6 % is marked as anti-conservative. Tests that treat the fabrics as fixed reject too often when fabrics differ "
           "in how conditions suit them. Use the mixed model in this case.";
}

std::string speedParagraph(const ChoiceQuestions& questions)
{
    return "<b>Speed and accuracy</b> are those of " + protocols::escapedMarkup(questions.front().id()) +
           ". Response time runs from the first touch to the spoken answer. Bits per second are the information of one choice "
           "among m = " +
           std::to_string(questions.front().findings.alternatives) +
           " divided by the mean time. That information is log<sub>2</sub> m + p log<sub>2</sub> p + (1 &minus; p) "
           "log<sub>2</sub>((1 &minus; p)/(m &minus; 1)) for a share correct p, and 0 at or below chance. The balanced "
           "integration score is the z score of the share correct minus the z score of the mean time. Both are taken over all "
           "participant &times; condition cells (population SD) and averaged by condition. Higher is better, and 0 is the "
           "average.";
}

std::string participantsParagraph(const StudyData& data)
{
    std::string text = "<b>Participants.</b> ";
    text += data.participantsSentence.empty() ? counted(data.participants.size(), "participant") + "."
                                              : protocols::escapedMarkup(data.participantsSentence);
    if (!data.withdrawn.empty())
        text += " In addition, " + counted(data.withdrawn.size(), "participant") +
                " withdrew. Answers given before are kept and not analysed, and the " + pluralOf(data.withdrawn.size(), "place") +
                " became free again.";
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
    if (hasChoices) paragraphs.push_back(matchesParagraph(analysis.data, choices));
    if (hasChoices || hasRatings) paragraphs.push_back(pairsParagraph());
    if (hasRatings) paragraphs.push_back(equivalenceParagraph(analysis.data));
    if (hasChoices || hasRatings) paragraphs.push_back(omnibusParagraph(hasChoices, hasRatings));
    if (hasChoices || hasRatings) paragraphs.push_back(measuredSizesParagraph());
    if (hasChoices) paragraphs.push_back(speedParagraph(choices));
    if (hasWords) paragraphs.push_back(wordsParagraph());
    paragraphs.push_back(participantsParagraph(analysis.data));
    paragraphs.push_back(missingParagraph());
    return paragraphs;
}

}  // namespace reports
