#include "reports/analysis/model_contrasts.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>

#include "reports/data/design_limits.h"

namespace reports {
namespace {

using Pair = std::pair<std::string, std::string>;

constexpr std::size_t mostLeftOutAnswers = 5000;  // of a question: each fabric takes a fit of the whole model

std::string lettersAndDigits(const std::string& condition)
{
    std::string letters;
    for (const char c : condition)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) letters += c;
    return letters;
}

std::optional<Pair> contrastOf(const StudyData& data)
{
    if (!data.planned.empty()) return data.planned.front();
    Pair pair;
    for (const std::string& condition : data.conditions) {
        if (lettersAndDigits(condition) == "hgfg") pair.first = condition;
        if (lettersAndDigits(condition) == "hf") pair.second = condition;
    }
    return pair.first.empty() || pair.second.empty() ? std::nullopt : std::optional(pair);
}

std::size_t levelOf(const stats::RatingModel& model, const std::string& condition)
{
    return static_cast<std::size_t>(std::find(model.conditions.begin(), model.conditions.end(), condition) -
                                    model.conditions.begin());
}

stats::CrossedMean meanOf(const stats::RatingModel& model, std::size_t a, std::size_t b, stats::StudentQuantiles& quantiles)
{
    const bool isThere = a < model.conditions.size() && b < model.conditions.size();
    stats::CrossedMean mean = isThere ? stats::crossedMean(stats::levelDifference(model.model, a, b, 0.95, quantiles), quantiles)
                                      : stats::crossedMean(stats::ContrastTest{});
    mean.values = model.model.rows;
    mean.singular = model.model.singular;
    return mean;
}

stats::CrossedMean meanOf(const stats::RatingModel& model, const Pair& pair)
{
    stats::StudentQuantiles quantiles;
    return meanOf(model, levelOf(model, pair.first), levelOf(model, pair.second), quantiles);
}

stats::CrossedStudy without(stats::CrossedStudy answers, std::size_t fabric)
{
    for (std::size_t row = 0; row < answers.values.size(); ++row)
        if (answers.fabric.of[row] == fabric) answers.values[row] = std::numeric_limits<double>::quiet_NaN();
    return answers;
}

}  // namespace

std::vector<ModelContrast> modelContrasts(const StudyData& data, const stats::RatingModel& model)
{
    std::vector<ModelContrast> contrasts;
    if (!comparesAllPairs(data)) return contrasts;
    stats::StudentQuantiles quantiles;
    for (std::size_t a = 0; a < model.conditions.size(); ++a)
        for (std::size_t b = a + 1; b < model.conditions.size(); ++b)
            contrasts.push_back({model.conditions[a], model.conditions[b], meanOf(model, a, b, quantiles)});
    return contrasts;
}

LeaveOneFabricOut leaveOneFabricOut(const StudyData& data, const stats::CrossedStudy& answers, const stats::RatingModel& model,
                                    Depth depth)
{
    LeaveOneFabricOut result;
    const std::optional<Pair> pair = contrastOf(data);
    if (depth == Depth::Quick)
        result.why = "left out by --quick";
    else if (!pair)
        result.why = "no contrast is planned";
    else if (answers.fabric.levels.size() < 2)
        result.why = "there is one fabric only";
    else if (answers.values.size() > mostLeftOutAnswers)
        result.why = "left out for more than " + std::to_string(mostLeftOutAnswers) + " answers";
    if (!result.why.empty()) return result;
    result.a = pair->first;
    result.b = pair->second;
    result.all = meanOf(model, *pair);
    // The model drops conditions without answers, so each fit looks up its own levels.
    for (std::size_t f = 0; f < answers.fabric.levels.size(); ++f)
        result.without.push_back({answers.fabric.levels[f], meanOf(stats::fitRatings(without(answers, f)), *pair)});
    std::sort(result.without.begin(), result.without.end(), [&](const FabricLeftOut& x, const FabricLeftOut& y) {
        const auto placeOf = [&](const std::string& id) { return std::find(data.fabrics.begin(), data.fabrics.end(), id); };
        return placeOf(x.fabric) < placeOf(y.fabric);
    });
    return result;
}

}  // namespace reports
