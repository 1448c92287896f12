#include "reports/page/anchor_text.h"

#include <algorithm>

#include "protocols/files/markup_text.h"
#include "reports/page/html_parts.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// "3.1 (95 % interval 2.4 to 3.8)"
std::string valueWithInterval(const stats::Value& value, const stats::Interval& ci, int decimals)
{
    std::string text = typeset(fixed(*value, decimals));
    if (ci.low.exists() && ci.high.exists())
        text += " (95 % interval " + typeset(fixed(*ci.low, decimals)) + " to " + typeset(fixed(*ci.high, decimals)) + ")";
    return text;
}

std::string anchorLabels(const std::vector<std::string>& conditions)
{
    std::vector<std::string> labels;
    for (const std::string& condition : conditions) labels.push_back(htmlLabel(condition));
    return listed(labels);
}

std::string floorSentences(const std::string& question, const AnchorFloor& floor)
{
    const bool isNamed = std::ranges::none_of(floor.conditions, [](const std::string& one) { return one.empty(); });
    const std::string images = isNamed ? anchorLabels(floor.conditions) + " images" : "images";
    std::string text = question + " floor: with another fabric on the tray, " + images + " were rated " +
                       valueWithInterval(floor.meanOfParticipants, floor.ci95, 1) + " on average (" +
                       counted(floor.ratings, "rating") + ").";
    if (floor.shareAbove.exists())
        text += " " + percentText(*floor.shareAbove, 1) + " of these ratings lie above the mean of " + htmlLabel(floor.lowest) +
                ", the lowest condition.";
    if (!floor.notAbove.empty())
        text += " Not above the floor: " + anchorLabels(floor.notAbove) +
                ". Such ratings do not show that the rendering conveys the fabric.";
    return text;
}

std::string reliabilitySentences(const std::string& question, const stats::RatingReliability& found)
{
    std::string text = question + " test&ndash;retest: " + counted(found.pairs, "presentation") + " came twice.";
    if (found.icc.value.exists())
        text += " ICC(2,1) is " + valueWithInterval(found.icc.value, found.icc.ci95, 2) +
                ". No prediction of single ratings can correlate with them by more than " +
                typeset(fixed(*found.correlationCeiling.value, 2)) + ".";
    else
        text += " There is no ICC: " + protocols::escapedMarkup(found.icc.value.why()) + ".";
    if (found.withinSd.value.exists())
        text +=
            " A rating varies around the participant&rsquo;s own mean with an SD of " +
            valueWithInterval(found.withinSd.value, found.withinSd.ci95, 2) + " points." +
            (found.meanCeiling.value.exists()
                 ? " So the mean rating of a rendering can reach at most " +
                       valueWithInterval(found.meanCeiling.value, found.meanCeiling.ci95, 1) + "."
                 : " How high a mean rating can be is unknown: " + protocols::escapedMarkup(found.meanCeiling.value.why()) + ".");
    if (found.bias.estimate.exists()) {
        text +=
            " Second ratings differ from first ones by " + valueWithInterval(found.bias.estimate, found.bias.ci, 2) + " points";
        const stats::EquivalenceTest& test = found.biasEquivalence;
        text += !test.why.empty() ? "."
                : test.equivalent ? "; the shift lies within the bounds of equivalence."
                                  : "; it is not shown that the shift lies within the bounds of equivalence.";
    }
    return text;
}

std::string choiceSentences(const std::string& question, const QuestionAnchors& anchors)
{
    std::string text = question + " test&ndash;retest: ";
    if (!anchors.choices) return text + protocols::escapedMarkup(anchors.noPairs) + ".";
    const stats::ChoiceReliability& found = *anchors.choices;
    if (anchors.compared == stats::ChoicesCompared::Outcomes)
        text += counted(found.pairs, "choice") + " came twice, the second time beside other foils; " +
                std::to_string(found.agreeing - found.bothWrong) + " were right both times and " +
                std::to_string(found.bothWrong) + " wrong both times";
    else
        text += std::to_string(found.agreeing) + " of " + counted(found.pairs, "choice") + " that came twice were the same";
    const bool areWords = anchors.compared == stats::ChoicesCompared::Words;
    if (!found.kappa.value.exists())
        return text + (areWords ? ". There is no kappa: " + protocols::escapedMarkup(found.kappa.value.why()) + "." : ".");
    const std::string guessing =
        areWords ? "each participant&rsquo;s habit for one word" : "guessing (1/" + std::to_string(anchors.alternatives) + ")";
    return text + "; corrected for " + guessing + ", kappa is " + valueWithInterval(found.kappa.value, found.kappa.ci95, 2) +
           ". With this noise the share of right answers, over all conditions together, can reach at most " +
           valueWithInterval(found.shareCeiling.value, found.shareCeiling.ci95, 2) + ".";
}

/// Empty where no answers are words.
std::string wordsMethod(const StudyAnalysis& analysis)
{
    const auto areWords = [](const QuestionAnchors& anchors) { return anchors.compared == stats::ChoicesCompared::Words; };
    if (std::ranges::none_of(analysis.anchors, areWords)) return {};
    return " Where the answers are the words same and different, chance comes from each participant&rsquo;s own words (Cohen "
           "1960). It is how often the first answer to one presentation is the second answer to another. So a habit for one word "
           "has a kappa of 0, too, and a kappa of few pairs can lie below &minus;1. The ceiling is then (1 + &radic;kappa)/2, if "
           "each word is right equally often; both intervals come from the jackknife over participants.";
}

std::string listedAnchors(const std::vector<std::string>& items) { return items.empty() ? std::string() : bulletList(items); }

}  // namespace

std::string ratingAnchorsText(const StudyAnalysis& analysis)
{
    std::vector<std::string> items;
    for (const QuestionAnchors& anchors : analysis.anchors) {
        const std::string question = "<b>" + protocols::escapedMarkup(anchors.question) + "</b>";
        if (anchors.floor) items.push_back(floorSentences(question, *anchors.floor));
        if (anchors.ratings) items.push_back(reliabilitySentences(question, *anchors.ratings));
        const bool isRating = anchors.alternatives == 0;
        if (isRating && !anchors.noPairs.empty())
            items.push_back(question + " test&ndash;retest: " + protocols::escapedMarkup(anchors.noPairs) + ".");
    }
    return listedAnchors(items);
}

std::string choiceAnchorsText(const StudyAnalysis& analysis)
{
    std::vector<std::string> items;
    for (const auto& question : questionsWith<ChoiceAnalysis>(analysis))
        if (const QuestionAnchors* anchors = anchorsOf(analysis.anchors, question.id());
            anchors != nullptr && (anchors->choices || !anchors->noPairs.empty()))
            items.push_back(choiceSentences("<b>" + protocols::escapedMarkup(question.id()) + "</b>", *anchors));
    return listedAnchors(items);
}

std::string anchorsMethod(const StudyAnalysis& analysis)
{
    if (analysis.anchors.empty()) return {};
    return "<b>Anchors.</b> Some presentations belong to no condition, and no analysis of conditions uses their answers. "
           "Mismatched "
           "ones show the image of one fabric while another lies on the tray; their mean rating is the floor. Repeated ones come "
           "a "
           "second time. For ratings, ICC(2,1) is the absolute agreement of first and second answers (Shrout and Fleiss 1979). "
           "Its "
           "interval and that of the within-participant SD (Bland and Altman 1996) come from the jackknife over participants, on "
           "the scales of Fisher&rsquo;s z and of the logarithm. Nothing correlates with single ratings by more than the root of "
           "the "
           "ICC (Spearman 1904). The highest mean rating is the end of the scale minus SD/&radic;(2&pi;): noise around the end "
           "can "
           "only lower a rating. For choices, kappa is the agreement corrected for guessing among m alternatives (Brennan and "
           "Prediger 1981). Where the foils were others the second time, right and wrong are compared, and two wrong answers "
           "agree "
           "by 1/(m &minus; 1) only: guessers have a kappa of 0. Its interval is Wilson&rsquo;s, with a design effect where "
           "participants differ. The highest share of right answers is (1 + &radic;((k &minus; 1)(kA &minus; 1)))/k for an "
           "agreement of A: among all probabilities of k answers that give this agreement, it is the largest that one answer can "
           "have. k is m, or 2 where right and wrong are compared; then all wrong answers count as one, and the ceiling is high "
           "where many are wrong. These ceilings suppose the noise of the repeated presentations." +
           wordsMethod(analysis);
}

}  // namespace reports
