#include "reports/cells/anchor_answers.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "reports/text/plain_words.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/equivalence.h"

namespace reports {
namespace {

auto presentationOf(const StudyResponse& response)
{
    return std::tie(response.participant, response.fabric, response.condition, response.repetition);
}

/// A retest may come in a session of its own, which `repetition` names.
auto inAnySession(const StudyResponse& response)
{
    return std::tie(response.participant, response.fabric, response.condition, response.instruction);
}

/// "36 repeated answers have no first answer to the same presentation"; empty where no answer came twice.
std::string withoutFirst(const StudyData& data, const std::string& question)
{
    const auto repeated = std::ranges::count(data.repeatedResponses, question, &StudyResponse::question);
    if (repeated == 0) return {};
    return counted(static_cast<std::size_t>(repeated), "repeated answer") + (repeated == 1 ? " has" : " have") +
           " no first answer to the same presentation";
}

std::optional<stats::RatingReliability> ratingsTwice(const StudyData& data, const QuestionInfo& info, const NumberOnScale& scale)
{
    std::vector<stats::RatingPairs> participants;
    for (const auto& [participant, pairs] : answersTwice(data, info.id)) {
        auto& own = participants.emplace_back();
        for (const auto& [first, second] : pairs) {
            const auto* before = std::get_if<RatedAnswer>(&first->content);
            const auto* after = std::get_if<RatedAnswer>(&second->content);
            if (before != nullptr && after != nullptr) own.emplace_back(before->rating, after->rating);
        }
    }
    if (participants.empty()) return std::nullopt;
    const auto [low, high] = data.equivalenceBounds;
    stats::RatingReliability found = stats::ratingReliability(participants, scale.max, {.low = low, .high = high});
    if (info.scaleAssumed) {
        const auto none = stats::Value::undefined("nobody stated the scale");
        found.meanCeiling = {none, {none, none}};
    }
    return found;
}

/// Choices that came twice can lack what is compared: right and wrong alone do not say whether two wrong choices are the same.
void compareChoices(const StudyData& data, const QuestionInfo& info, QuestionAnchors& anchors)
{
    const bool byOutcome = anchors.compared == stats::ChoicesCompared::Outcomes;
    std::optional<std::string> word;  // any of the two
    std::vector<stats::RepeatedChoices> participants;
    std::size_t twice = 0, compared = 0;
    for (const auto& [participant, pairs] : answersTwice(data, info.id)) {
        auto& own = participants.emplace_back();
        twice += pairs.size();
        for (const auto& [first, second] : pairs) {
            const auto* before = std::get_if<ChosenAnswer>(&first->content);
            const auto* after = std::get_if<ChosenAnswer>(&second->content);
            if (before == nullptr || after == nullptr || (!byOutcome && (!before->answer || !after->answer))) continue;
            ++own.pairs;
            own.agreeing += byOutcome ? before->correct == after->correct : *before->answer == *after->answer;
            own.bothWrong += byOutcome && !before->correct && !after->correct;
            if (anchors.compared != stats::ChoicesCompared::Words) continue;
            if (!word) word = before->answer;
            own.firstWord += before->answer == word;
            own.secondWord += after->answer == word;
        }
        compared += own.pairs;
    }
    if (compared > 0)
        anchors.choices = stats::choiceReliability(participants, anchors.alternatives, anchors.compared);
    else if (twice > 0)
        anchors.noPairs = counted(twice, "choice") +
                          " came twice, but of none both answers are known; right and wrong alone do not say whether two "
                          "wrong answers are the same";
    else
        anchors.noPairs = withoutFirst(data, info.id);
}

std::optional<AnchorFloor> floorOf(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    std::vector<double> ratings;
    std::map<std::string, std::vector<double>> byParticipant;
    AnchorFloor floor;
    for (const StudyResponse& response : data.mismatchedResponses) {
        const auto* rated = std::get_if<RatedAnswer>(&response.content);
        if (response.question != question || rated == nullptr) continue;
        if (std::ranges::find(floor.conditions, response.condition) == floor.conditions.end())
            floor.conditions.push_back(response.condition);
        ratings.push_back(rated->rating);
        byParticipant[response.participant].push_back(rated->rating);
    }
    if (ratings.empty()) return std::nullopt;
    std::ranges::sort(floor.conditions);
    std::vector<double> means;
    for (const auto& [participant, own] : byParticipant) means.push_back(*stats::meanOf(own));
    floor.ratings = ratings.size();
    floor.participants = means.size();
    floor.mean = stats::meanOf(ratings);
    floor.sd = stats::describe(ratings).sd;
    const auto isEqual = [&](const auto& one) { return one.second.size() == byParticipant.begin()->second.size(); };
    floor.meanOfParticipants = std::ranges::all_of(byParticipant, isEqual) ? floor.mean : stats::meanOf(means);
    floor.ci95 = stats::describe(means).ci95;
    if (means.size() < 2)
        floor.ci95.low = floor.ci95.high = stats::Value::undefined("needs the means of at least 2 participants");
    floor.lowestMean = floor.shareAbove = stats::Value::undefined("no condition has ratings");
    for (const std::string& condition : data.conditions) {
        const stats::Value mean = stats::meanOf(valuesOf(cells.of(question, condition)));
        if (!mean.exists()) continue;
        if (*mean <= *floor.mean) floor.notAbove.push_back(condition);
        if (floor.lowestMean.exists() && *floor.lowestMean <= *mean) continue;
        floor.lowest = condition;
        floor.lowestMean = mean;
    }
    if (floor.lowestMean.exists()) {
        const auto above = std::ranges::count_if(ratings, [&](double rating) { return rating > *floor.lowestMean; });
        floor.shareAbove = static_cast<double>(above) / static_cast<double>(ratings.size());
    }
    return floor;
}

}  // namespace

std::map<std::string, std::vector<AnswersTwice>> answersTwice(const StudyData& data, const std::string& question)
{
    std::map<std::tuple<std::string, std::string, std::string, std::string>, const StudyResponse*> repeated;
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<const StudyResponse*>> firsts, seconds;
    for (const StudyResponse& response : data.repeatedResponses)
        if (response.question == question) {
            repeated[presentationOf(response)] = &response;
            seconds[inAnySession(response)].push_back(&response);
        }
    for (const StudyResponse& response : data.responses)
        if (response.question == question) firsts[inAnySession(response)].push_back(&response);
    const auto secondOf = [&](const StudyResponse& response) -> const StudyResponse* {
        if (const auto again = repeated.find(presentationOf(response)); again != repeated.end()) return again->second;
        const auto later = seconds.find(inAnySession(response));
        const bool isOne = later != seconds.end() && later->second.size() == 1 && firsts[inAnySession(response)].size() == 1;
        return isOne ? later->second.front() : nullptr;
    };
    std::map<std::string, std::vector<AnswersTwice>> pairs;
    for (const StudyResponse& response : data.responses) {
        if (response.question != question) continue;
        const StudyResponse* again = secondOf(response);
        if (again == nullptr) continue;
        AnswersTwice pair{&response, again};
        if (pair.first->trial && pair.second->trial && *pair.second->trial < *pair.first->trial)
            std::swap(pair.first, pair.second);
        pairs[response.participant].push_back(pair);
    }
    // Sums must not depend on the order of the rows.
    for (auto& [participant, own] : pairs)
        std::ranges::sort(own, {}, [](const AnswersTwice& pair) { return presentationOf(*pair.first); });
    return pairs;
}

bool agreesByOutcome(const StudyData& data, const QuestionInfo& question)
{
    const Scoring scoring = scoringOf(question.kind);
    const auto* choice = std::get_if<RightOrWrong>(&scoring);
    return data.choicesRepeatedAnew.contains(question.id) && choice != nullptr && !choice->isSameDifferent;
}

stats::ChoicesCompared comparedBy(const StudyData& data, const QuestionInfo& question)
{
    const Scoring scoring = scoringOf(question.kind);
    const auto* choice = std::get_if<RightOrWrong>(&scoring);
    if (choice != nullptr && choice->isSameDifferent) return stats::ChoicesCompared::Words;
    return agreesByOutcome(data, question) ? stats::ChoicesCompared::Outcomes : stats::ChoicesCompared::Answers;
}

std::vector<QuestionAnchors> anchorsOf(const StudyData& data, const AnswerCells& cells)
{
    std::vector<QuestionAnchors> all;
    if (data.mismatchedResponses.empty() && data.repeatedResponses.empty()) return all;
    for (const QuestionInfo& question : data.questions) {
        QuestionAnchors anchors{.question = question.id, .compared = comparedBy(data, question)};
        std::visit(protocols::Overloaded{
                       [&](const RightOrWrong& choice) {
                           anchors.alternatives = choice.alternatives;
                           compareChoices(data, question, anchors);
                       },
                       [&](const NumberOnScale& scale) {
                           anchors.floor = floorOf(data, cells, question.id);
                           anchors.ratings = ratingsTwice(data, question, scale);
                           if (!anchors.ratings) anchors.noPairs = withoutFirst(data, question.id);
                       },
                       [](const OpenWords&) {},
                   },
                   scoringOf(question.kind));
        if (anchors.floor || anchors.ratings || anchors.choices || !anchors.noPairs.empty()) all.push_back(std::move(anchors));
    }
    return all;
}

const QuestionAnchors* anchorsOf(const std::vector<QuestionAnchors>& anchors, const std::string& question)
{
    const auto found = std::ranges::find(anchors, question, &QuestionAnchors::question);
    return found == anchors.end() ? nullptr : &*found;
}

const stats::Estimate* ceilingOf(const QuestionAnchors& anchors)
{
    if (anchors.ratings) return &anchors.ratings->meanCeiling;
    return anchors.choices ? &anchors.choices->shareCeiling : nullptr;
}

const stats::Estimate* reliabilityOf(const QuestionAnchors& anchors)
{
    if (anchors.ratings) return &anchors.ratings->icc;
    return anchors.choices ? &anchors.choices->kappa : nullptr;
}

}  // namespace reports
