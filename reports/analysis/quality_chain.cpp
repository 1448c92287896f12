#include "reports/analysis/quality_chain.h"

#include <algorithm>

#include "protocols/condition.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

ChainAnswer answerTo(const QuestionAnalysis& question, std::size_t condition)
{
    if (const auto* choices = std::get_if<ChoiceAnalysis>(&question.findings)) {
        const auto& test = choices->conditions[condition].againstChance;
        return {test.estimate, test.wilson};
    }
    const auto& ratings = std::get<RatingAnalysis>(question.findings).conditions[condition];
    return {ratings.meanOfParticipants, ratings.ci95};
}

ChainQuestion chainQuestion(const StudyData& data, const QuestionAnalysis& question)
{
    if (const auto* choices = std::get_if<ChoiceAnalysis>(&question.findings))
        return {question.question.id,
                true,
                0,
                1,
                shownChance(*choices) > 0 ? std::optional(1.0 / choices->alternatives) : std::nullopt,
                untestedConditions(data, *choices)};
    const auto& scale = std::get<RatingAnalysis>(question.findings).scale;
    return {question.question.id, false, scale.min, scale.max, {}, {}};
}

bool inOrderOfPaper(const RenderingPrice& a, const RenderingPrice& b)
{
    return protocols::comesBefore(protocols::ConditionId(a.condition), protocols::ConditionId(b.condition));
}

}  // namespace

std::string answerIntervalsText(const QualityChain& chain)
{
    std::vector<std::string> overParticipants;
    if (std::ranges::any_of(chain.questions, [](const ChainQuestion& one) { return !one.isChoice; }))
        overParticipants.emplace_back("mean ratings");
    if (std::ranges::any_of(chain.rows, [](const ChainRow& one) { return one.bitsPerSecond.exists(); }))
        overParticipants.emplace_back("bits per second");
    std::string text;
    if (std::ranges::any_of(chain.questions, &ChainQuestion::isChoice))
        text = "Intervals of shares correct take the trials as independent (Wilson), which they are not";
    if (!overParticipants.empty())
        text += (text.empty() ? "" : ". ") + ("Intervals of " + listed(overParticipants)) +
                " are over participants, for these fabrics";
    return text;
}

QualityChain qualityChain(const StudyAnalysis& analysis)
{
    const StudyData& data = analysis.data;
    QualityChain chain;
    if (data.prices.empty()) return chain;
    std::vector<const QuestionAnalysis*> asked;
    for (const QuestionAnalysis& question : analysis.questions)
        if (hasNumbers(question.question)) {
            asked.push_back(&question);
            chain.questions.push_back(chainQuestion(data, question));
        }
    std::vector<RenderingPrice> prices;
    for (const RenderingPrice& price : data.prices)
        if (std::ranges::count(data.conditions, price.condition) > 0) prices.push_back(price);
    std::ranges::stable_sort(prices, inOrderOfPaper);
    const auto choices = questionsWith<ChoiceAnalysis>(analysis);
    for (const RenderingPrice& price : prices) {
        const auto place = std::ranges::find(data.conditions, price.condition);
        const auto condition = static_cast<std::size_t>(place - data.conditions.begin());
        ChainRow row{price, {}, {}, analysis.speed[condition].bitsPerSecond, analysis.speed[condition].bitsPerSecondCi95};
        for (const QuestionAnalysis* question : asked) row.answers.push_back(answerTo(*question, condition));
        if (!choices.empty()) row.matchesPerRendering = choices.front().findings.conditions[condition].matchesPerRendering;
        chain.rows.push_back(std::move(row));
    }
    return chain;
}

}  // namespace reports
