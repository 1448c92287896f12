#include "reports/page/order_text.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/markup_text.h"
#include "reports/text/condition_label.h"
#include "reports/text/number_text.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

bool isChoiceQuestion(const StudyAnalysis& analysis, const std::string& id)
{
    return std::ranges::any_of(questionsWith<ChoiceAnalysis>(analysis), [&](const auto& one) { return one.id() == id; });
}

std::string limitsText(double low, double high, int decimals)
{
    return " (95 % interval [" + typeset(fixed(low, decimals)) + ", " + typeset(fixed(high, decimals)) + "])";
}

std::string changeSentence(const StudyAnalysis& analysis, const std::string& id, const OrderEffect& effect)
{
    const stats::TTest& test = effect.trend.test;
    const std::string what = isChoiceQuestion(analysis, id) ? "the share correct" : "ratings";
    const std::string change = " by " + typeset(fixed(*test.estimate, 3)) + limitsText(*test.ci.low, *test.ci.high, 3);
    const auto percent = [](double logarithm) { return std::expm1(logarithm) * 100; };
    const std::string start = protocols::escapedMarkup(id) + ": ";
    switch (effect.kind) {
        case OrderEffectKind::Trend:
            return start + what + (isChoiceQuestion(analysis, id) ? " changes" : " change") + change + " over 10 trials.";
        case OrderEffectKind::TimeTrend:
            return start + "response times change by " + typeset(fixed(percent(*test.estimate), 1)) + " %" +
                   limitsText(percent(*test.ci.low), percent(*test.ci.high), 1) + " over 10 trials.";
        case OrderEffectKind::LaterSittings:
            break;
    }
    return start + what + (isChoiceQuestion(analysis, id) ? " differs" : " differ") + change +
           " between later sittings and the first.";
}

/// Whether the contrast of a question with a trend is decided otherwise without it.
std::string contrastSentence(const ContrastWithoutTrend& contrast)
{
    const stats::TTest &plain = contrast.plain, &adjusted = contrast.adjusted;
    if (!contrast.why.empty() || !plain.why.empty() || !adjusted.why.empty()) return {};
    const bool isSame = excludesZero(plain) == excludesZero(adjusted);
    return " Without each participant's trend, " + htmlLabel(contrast.a) + " \u2212 " + htmlLabel(contrast.b) + " is " +
           typeset(fixed(*adjusted.estimate, 2)) + " instead of " + typeset(fixed(*plain.estimate, 2)) +
           (isSame ? "." : ", and its interval " + std::string(excludesZero(adjusted) ? "then excludes 0." : "then includes 0."));
}

}  // namespace

std::vector<std::string> orderSentences(const StudyAnalysis& analysis)
{
    std::vector<std::string> sentences;
    for (const QuestionOrder& question : analysis.order.questions)
        for (const OrderEffect& effect : question.effects)
            if (excludesZero(effect.trend.test))
                sentences.push_back(changeSentence(analysis, question.question, effect) +
                                    (effect.kind == OrderEffectKind::Trend ? contrastSentence(question.contrast) : ""));
    const OrderEffectCount count = countOf(analysis.order);
    if (sentences.empty()) return sentences;
    sentences.push_back("These are " + std::to_string(count.shown) + " of " + counted(count.tested, "change") +
                        " over trials and sittings that were tested, for these fabrics. Each interval excludes 0 by chance in 1 "
                        "of 20 studies; the table has corrected p values.");
    return sentences;
}

}  // namespace reports
