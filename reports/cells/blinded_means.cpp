#include "reports/cells/blinded_means.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// 0.1 on scales up to 10 units long, 1 on those up to 100. Ratings are tenths, so no scale has a finer step.
double stepOn(const NumberOnScale& scale)
{
    double step = 0.1;
    while (scale.max - scale.min > 100 * step * (1 + 1e-9)) step *= 10;
    return step < 1 ? 0.1 : std::round(step);
}

/// The multiple of the step in its shortest digits: 0.3, not 0.30000000000000004.
double roundedTo(double step, double value)
{
    return step < 1 ? std::round(value * std::round(1 / step)) / std::round(1 / step) : std::round(value / step) * step;
}

double stepOf(const QuestionInfo& question, std::size_t fewestAnswers)
{
    return std::visit(protocols::Overloaded{
                          [&](const RightOrWrong&) { return shareStep(fewestAnswers); },
                          [](const NumberOnScale& scale) { return stepOn(scale); },
                          [](const OpenWords&) { return 0.0; },
                      },
                      scoringOf(question.kind));
}

double worthOf(const AnswerContent& content)
{
    return std::visit(protocols::Overloaded{
                          [](const ChosenAnswer& choice) { return choice.correct ? 1.0 : 0.0; },
                          [](const RatedAnswer& rated) { return rated.rating; },
                          [](const WordedAnswer&) { return 0.0; },
                      },
                      content);
}

BlindedQuestion blindedQuestion(const StudyData& data, const QuestionInfo& question)
{
    std::map<std::string, std::pair<std::size_t, double>> sums;
    for (const StudyResponse& response : data.responses)
        if (response.question == question.id) {
            auto& [n, sum] = sums[response.condition];
            ++n;
            sum += worthOf(response.content);
        }
    std::size_t fewest = data.responses.size();
    for (const std::string& condition : data.conditions) fewest = std::min(fewest, sums[condition].first);
    BlindedQuestion blinded{question, stepOf(question, fewest), {}};
    for (const std::string& condition : data.conditions) {
        const auto [n, sum] = sums[condition];
        const bool isTooFew = blinded.isChosen() && n < fewestChoices;
        const char* const why = !hasNumbers(question) ? "words have no mean"
                                : n == 0              ? "nobody answered"
                                                      : "fewer than 12 answers";
        blinded.conditions.push_back({condition, n,
                                      n == 0 || isTooFew || blinded.step == 0
                                          ? stats::Value::undefined(why)
                                          : stats::Value(roundedTo(blinded.step, sum / static_cast<double>(n)))});
    }
    return blinded;
}

}  // namespace

double shareStep(std::size_t answers) { return answers >= 60 ? 0.05 : 0.25; }

int BlindedQuestion::decimals() const { return isChosen() ? 2 : step < 1 ? 1 : 0; }

StudyData finishedPart(StudyData data)
{
    std::set<std::string> answering;  // erased answers count for nobody
    for (const StudyResponse& response : data.responses) answering.insert(response.participant);
    std::erase_if(data.participants,
                  [&](const std::string& one) { return !data.finished.contains(one) || !answering.contains(one); });
    const std::set<std::string> kept(data.participants.begin(), data.participants.end());
    const auto isLeftOut = [&](const auto& of) { return !kept.contains(of.participant); };
    for (auto* responses : {&data.responses, &data.catchResponses, &data.mismatchedResponses, &data.repeatedResponses})
        std::erase_if(*responses, isLeftOut);
    std::erase_if(data.touches, isLeftOut);
    return data;
}

BlindedMeans blindedMeans(const StudyData& data)
{
    const StudyData part = finishedPart(data);
    BlindedMeans means;
    means.participants = part.participants.size();
    if (means.participants < fewestFinished) {
        means.why = "There are no means under K-labels yet: " + counted(means.participants, "participant") +
                    (means.participants == 1 ? " has" : " have") + " finished, and at least " + std::to_string(fewestFinished) +
                    " are needed.";
        return means;
    }
    for (const QuestionInfo& question : part.questions) means.questions.push_back(blindedQuestion(part, question));
    return means;
}

void forgetAnswers(StudyData& data)
{
    for (auto* responses : {&data.responses, &data.catchResponses, &data.mismatchedResponses, &data.repeatedResponses})
        responses->clear();
    data.touches.clear();
    data.choicesRepeatedAnew.clear();
}

}  // namespace reports
