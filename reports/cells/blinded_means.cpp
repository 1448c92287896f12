#include "reports/cells/blinded_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// See meansStep(): bits of one number, and the share of what is unknown.
constexpr double mostBits = 0.5, shareTold = 0.05;
constexpr const char* sealed = "sealed";

std::array<std::vector<StudyResponse>*, 4> allResponsesOf(StudyData& data)
{
    return {&data.responses, &data.catchResponses, &data.mismatchedResponses, &data.repeatedResponses};
}

/// 0.1 on scales up to 10 units long, 1 on those up to 100. Ratings are tenths, so no scale has a finer unit.
double unitOn(const NumberOnScale& scale)
{
    double unit = 0.1;
    while (scale.max - scale.min > 100 * unit * (1 + 1e-9)) unit *= 10;
    return unit < 1 ? 0.1 : std::round(unit);
}

/// The multiple of the unit in its shortest digits: 0.3, not 0.30000000000000004.
double roundedTo(double unit, double value)
{
    return unit < 1 ? std::round(value * std::round(1 / unit)) / std::round(1 / unit) : std::round(value / unit) * unit;
}

std::optional<double> publishedNumber(const AnswerContent& content)
{
    using Number = std::optional<double>;
    return std::visit(protocols::Overloaded{
                          [](const ChosenAnswer& choice) { return Number(choice.correct ? 1.0 : 0.0); },
                          [](const RatedAnswer& rated) { return Number(rated.rating); },
                          [](const WordedAnswer&) { return Number(); },
                      },
                      content);
}

struct Sum {
    std::size_t n = 0;      ///< numbers
    std::size_t words = 0;  ///< answers that are none
    double sum = 0;
    double mean() const { return sum / static_cast<double>(n); }
};

/// Adds the answers to the question: those that are numbers to n and sum.
void addAnswers(const std::vector<StudyResponse>& responses, const std::string& question, std::map<std::string, Sum>& sums,
                const std::string* label)
{
    for (const StudyResponse& response : responses)
        if (response.question == question) {
            const auto number = publishedNumber(response.content);
            Sum& sum = sums[label != nullptr ? *label : response.condition];
            ++(number ? sum.n : sum.words);
            sum.sum += number.value_or(0);
        }
}

/// Mean of all ratings, also of catch trials and anchors: study.db shows it to everybody.
double meanOfAll(StudyData& data, const std::string& question, double unit)
{
    const std::string all = sealed;
    std::map<std::string, Sum> sums;
    for (const auto* responses : allResponsesOf(data)) addAnswers(*responses, question, sums, &all);
    return sums[all].n == 0 ? 0 : roundedTo(unit, sums[all].mean());
}

double roundedShare(double share, double step) { return std::min(1.0, roundedTo(0.01, std::round(share / step) * step)); }

double roundedRating(double rating, double centre, double step, const NumberOnScale& scale)
{
    const double steps = std::round((rating - centre) / step);
    return std::clamp(roundedTo(unitOn(scale), centre + steps * step), scale.min, scale.max);
}

BlindedQuestion blindedQuestion(StudyData& data, const QuestionInfo& question, std::size_t questions)
{
    std::map<std::string, Sum> sums;
    addAnswers(data.responses, question.id, sums, nullptr);
    std::size_t fewest = data.responses.size();
    for (const std::string& condition : data.conditions) fewest = std::min(fewest, sums[condition].n);
    const MeansDesign design{fewest, data.conditions.size(), questions};
    const Scoring scoring = scoringOf(question.kind);
    const auto* scale = std::get_if<NumberOnScale>(&scoring);
    BlindedQuestion blinded{question, 0, {}};
    if (hasNumbers(question) && fewest > 0)
        blinded.step = scale != nullptr ? std::max(unitOn(*scale), meansStep(scale->max - scale->min, design))
                                        : std::max(0.05, meansStep(1, design));
    const double centre = scale != nullptr ? meanOfAll(data, question.id, unitOn(*scale)) : 0;
    for (const std::string& condition : data.conditions) {
        const Sum& sum = sums[condition];
        const auto rounded = [&] {
            return scale != nullptr ? roundedRating(sum.mean(), centre, blinded.step, *scale)
                                    : roundedShare(sum.mean(), blinded.step);
        };
        blinded.conditions.push_back({condition, hasNumbers(question) ? sum.n : sum.words,
                                      !hasNumbers(question)       ? stats::Value::undefined("words have no mean")
                                      : fewest < fewestUnderLabel ? stats::Value::undefined("fewer than 40 answers under a label")
                                                                  : stats::Value(rounded())});
    }
    return blinded;
}

/// Why the participants of the study allow no means; empty where they do.
std::string whyNoMeansOf(const StudyData& data, std::size_t finished)
{
    const std::string none =
        data.openPlaces > 0 ? "There are no means under K-labels yet: " : "There are no means under K-labels: ";
    if (finished < fewestFinished)
        return none + counted(finished, "participant") + (finished == 1 ? " has" : " have") + " finished, and at least " +
               std::to_string(fewestFinished) + " are needed.";
    if (data.openPlaces > 0)
        return none + counted(data.openPlaces, "place") + " of the study " + (data.openPlaces == 1 ? "is" : "are") +
               " not finished. Means before and after one participant would name the labels of that participant. Who withdraws "
               "after the end leaves "
               "a place open.";
    return {};
}

bool hasMeans(const BlindedQuestion& question)
{
    return std::ranges::any_of(question.conditions, [](const BlindedMean& one) { return one.mean.exists(); });
}

}  // namespace

double meansStep(double width, const MeansDesign& design)
{
    const auto answers = static_cast<double>(design.answers), labels = static_cast<double>(design.labels);
    const double published = (labels - 1) * static_cast<double>(design.questions);
    const double unknown = answers * std::lgamma(labels + 1) / std::log(2.0);
    const double bits = published > 0 ? std::min(mostBits, shareTold * unknown / published) : mostBits;
    const double least = width / std::sqrt(answers) / std::exp2(bits);
    double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (digit * power >= least * (1 - 1e-9)) return roundedTo(power, digit * power);
    return roundedTo(10 * power, 10 * power);
}

int BlindedQuestion::decimals() const
{
    const Scoring scoring = scoringOf(question.kind);
    const auto* scale = std::get_if<NumberOnScale>(&scoring);
    return scale == nullptr ? 2 : unitOn(*scale) < 1 ? 1 : 0;
}

StudyData finishedPart(StudyData data)
{
    std::set<std::string> answering;  // erased answers count for nobody
    for (const StudyResponse& response : data.responses) answering.insert(response.participant);
    std::erase_if(data.participants,
                  [&](const std::string& one) { return !data.finished.contains(one) || !answering.contains(one); });
    const std::set<std::string> kept(data.participants.begin(), data.participants.end());
    const auto isLeftOut = [&](const auto& of) { return !kept.contains(of.participant); };
    for (auto* responses : allResponsesOf(data)) std::erase_if(*responses, isLeftOut);
    std::erase_if(data.touches, isLeftOut);
    return data;
}

StudyData withoutKey(StudyData data)
{
    std::size_t expected = 0;
    for (QuestionInfo& question : data.questions) {
        question.answersPerCell = question.presentations != 0
                                      ? question.presentations
                                      : answersPerCellOf(data, question) * data.conditions.size() * data.fabrics.size();
        expected += question.answersPerCell * data.participants.size();
    }
    if (data.expectedResponses == 0) data.expectedResponses = expected;
    std::vector<StudyResponse> all;
    for (auto* responses : allResponsesOf(data)) {
        const std::string kind = std::to_string(all.size());
        for (StudyResponse& response : *responses) {
            // Every presentation is a repetition of its own in the one cell.
            response.repetition = response.trial
                                      ? std::to_string(*response.trial)
                                      : kind + "/" + response.fabric + "/" + response.condition + "/" + response.repetition;
            response.fabric = response.condition = sealed;
            if (auto* choice = std::get_if<ChosenAnswer>(&response.content)) choice->correct = false;
            all.push_back(std::move(response));
        }
        responses->clear();
    }
    data.responses = std::move(all);
    data.fabrics = data.conditions = {sealed};
    data.choicesRepeatedAnew.clear();  // the trays of one cell differ anyway
    data.touches.clear();
    return data;
}

BlindedMeans blindedMeans(const StudyData& data)
{
    StudyData part = finishedPart(data);
    BlindedMeans means;
    means.participants = part.participants.size();
    means.why = whyNoMeansOf(data, means.participants);
    if (!means.why.empty()) return means;
    const auto numbers = static_cast<std::size_t>(std::ranges::count_if(part.questions, hasNumbers));
    for (const QuestionInfo& question : part.questions) means.questions.push_back(blindedQuestion(part, question, numbers));
    if (numbers == 0 || std::ranges::any_of(means.questions, hasMeans)) return means;
    means.questions.clear();
    means.why = "There are no means under K-labels: a label has fewer than " + std::to_string(fewestUnderLabel) +
                " answers to each question.";
    return means;
}

void forgetAnswers(StudyData& data)
{
    for (auto* responses : allResponsesOf(data)) responses->clear();
    data.touches.clear();
    data.choicesRepeatedAnew.clear();
}

}  // namespace reports
