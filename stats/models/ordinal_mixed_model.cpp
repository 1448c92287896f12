#include "stats/models/ordinal_mixed_model.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "stats/models/laplace_fit.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

constexpr Curvature curvature = Curvature::AtTheMode;

std::string valueText(double value)
{
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// The lowest and the highest category.
struct CategoryRange {
    std::uint32_t low = UINT32_MAX;
    std::uint32_t high = 0;

    void add(std::uint32_t category)
    {
        low = std::min(low, category);
        high = std::max(high, category);
    }
    bool isAll(std::uint32_t category) const { return low == category && high == category; }
};

/// The ratings that are not missing.
struct Ratings {
    std::size_t missing = 0;
    std::vector<double> levels;
    std::vector<std::uint32_t> category;
    Factor condition;
    std::vector<Factor> groups;
    std::vector<CategoryRange> ranges;  ///< of each condition
};

Ratings presentRatings(const OrdinalData& data)
{
    Ratings result;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < data.values.size(); ++row) {
        if (std::isnan(data.values[row])) continue;
        rows.push_back(row);
        result.levels.push_back(data.values[row]);
    }
    result.missing = data.values.size() - rows.size();
    std::sort(result.levels.begin(), result.levels.end());
    result.levels.erase(std::unique(result.levels.begin(), result.levels.end()), result.levels.end());
    result.condition = rowsOf(data.condition, rows);
    for (const Factor& group : data.groups) result.groups.push_back(rowsOf(group, rows));
    result.ranges.resize(result.condition.levels.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto place = std::lower_bound(result.levels.begin(), result.levels.end(), data.values[rows[i]]);
        result.category.push_back(static_cast<std::uint32_t>(place - result.levels.begin()));
        result.ranges[result.condition.of[i]].add(result.category.back());
    }
    return result;
}

std::string faultOf(const Ratings& data)
{
    if (data.category.empty()) return "there are no ratings";
    if (data.levels.size() == 1) return "every rating is " + valueText(data.levels.front());
    if (data.levels.size() > mostOrdinalCategories)
        return "there are " + std::to_string(data.levels.size()) + " different ratings; at most " +
               std::to_string(mostOrdinalCategories) + " are fitted";
    if (data.condition.levels.size() < 2) return "there is one condition only";
    for (const Factor& group : data.groups)
        if (group.levels.size() < 2) return "all ratings belong to one " + group.name + ": its variance cannot be estimated";
    return {};
}

/// The conditions with a finite effect, and the categories of their ratings.
struct Estimable {
    std::vector<bool> conditions;
    CategoryRange categories;
};

/// Takes away conditions with all ratings in the lowest or the highest category. A category that no other condition has goes
/// with them, so that the next one may become the lowest.
Estimable estimableOf(const Ratings& data)
{
    Estimable result{std::vector<bool>(data.ranges.size(), true), {}};
    while (true) {
        result.categories = {};
        for (std::size_t c = 0; c < data.ranges.size(); ++c) {
            if (!result.conditions[c]) continue;
            result.categories.add(data.ranges[c].low);
            result.categories.add(data.ranges[c].high);
        }
        bool isFinal = true;
        for (std::size_t c = 0; c < data.ranges.size(); ++c) {
            const CategoryRange& range = data.ranges[c];
            if (!result.conditions[c] || !(range.isAll(result.categories.low) || range.isAll(result.categories.high))) continue;
            result.conditions[c] = false;
            isFinal = false;
        }
        if (isFinal) return result;
    }
}

/// Neighbouring thresholds have a finite distance only where some condition has ratings on both sides of the category
/// between them.
std::string gapIn(const Ratings& data, const Estimable& estimable)
{
    for (std::uint32_t j = estimable.categories.low + 1; j < estimable.categories.high; ++j) {
        bool isSpanned = false;
        for (std::size_t c = 0; c < data.ranges.size(); ++c)
            isSpanned = isSpanned || (estimable.conditions[c] && data.ranges[c].low < j && data.ranges[c].high > j);
        if (!isSpanned)
            return "no condition has ratings both below and above " + valueText(data.levels[j]) +
                   ": the difference of the conditions on its two sides has no finite estimate";
    }
    return {};
}

void putSeparation(OrdinalMixedModel& model, const Ratings& data, const Estimable& estimable)
{
    std::string names;
    for (std::size_t c = 0; c < data.ranges.size(); ++c)
        if (!estimable.conditions[c])
            names += (names.empty() ? "" : ", ") + data.condition.levels[c] + " (always " +
                     valueText(data.levels[data.ranges[c].low]) + ")";
    if (names.empty()) return;
    const bool isAny = std::find(estimable.conditions.begin(), estimable.conditions.end(), true) != estimable.conditions.end();
    model.separation = isAny ? Separation::Quasi : Separation::Complete;
    model.separationWhy = (isAny ? "quasi-complete separation: " : "complete separation: ") + names;
}

/// Ratings of the estimable conditions. In the limit, the others contribute nothing to the log likelihood.
OrderedAnswers estimableAnswers(const Ratings& data, const Estimable& estimable)
{
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < data.category.size(); ++row)
        if (estimable.conditions[data.condition.of[row]]) rows.push_back(row);
    OrderedAnswers answers{estimable.categories.high - estimable.categories.low + 1, {}, rowsOf(data.condition, rows), {}};
    for (const std::size_t row : rows) answers.category.push_back(data.category[row] - estimable.categories.low);
    for (const Factor& group : data.groups) answers.groups.push_back(rowsOf(group, rows));
    return answers;
}

LaplaceFit fitEstimable(const Ratings& data, const Estimable& estimable)
{
    if (std::find(estimable.conditions.begin(), estimable.conditions.end(), true) != estimable.conditions.end())
        return laplaceFit(estimableAnswers(data, estimable), curvature);
    LaplaceFit fit;  // every probability is 0 or 1, so that the likelihood is 1 for any groups
    fit.sd.assign(data.groups.size(), 0);
    return fit;
}

/// Variance of the difference of two elements.
double differenceVariance(const Matrix& c, std::size_t a, std::size_t b) { return c(a, a) + c(b, b) - 2 * c(a, b); }

void putEffects(OrdinalMixedModel& model, const Ratings& data, const Estimable& estimable, const LaplaceFit& fit,
                double confidence)
{
    const Value infinite = Value::undefined("has no finite estimate: " + model.separationWhy);
    std::size_t cell = 0;
    for (std::size_t c = 0; c < data.ranges.size(); ++c) {
        const bool isFitted = estimable.conditions[c] && estimable.conditions[0];
        const std::string name = data.condition.name + data.condition.levels[c];
        if (c > 0 && isFitted)
            model.fixed.push_back(
                logOddsOf(name, fit.means[cell] - fit.means[0], differenceVariance(fit.covariance, cell, 0), confidence));
        else if (c > 0)
            model.fixed.push_back(undefinedLogOdds(name, infinite.why()));
        cell += estimable.conditions[c] ? 1 : 0;
    }
    for (std::uint32_t j = 0; j + 1 < data.levels.size(); ++j) {
        Threshold threshold{data.levels[j], data.levels[j + 1], infinite, infinite};
        if (estimable.conditions[0] && j >= estimable.categories.low && j < estimable.categories.high) {
            const std::size_t place = j - estimable.categories.low;
            threshold.estimate = fit.thresholds[place] - fit.means[0];
            threshold.se = std::sqrt(differenceVariance(fit.covariance, fit.means.size() + place, 0));
        }
        model.thresholds.push_back(threshold);
    }
}

void putRandom(OrdinalMixedModel& model, const Ratings& data, const LaplaceFit& fit)
{
    for (std::size_t t = 0; t < data.groups.size(); ++t) {
        const std::string why = model.separation == Separation::Complete ? model.separationWhy
                                : std::isnan(fit.sd[t])                  ? sharedVariance
                                                                         : "";
        const bool isZero = why.empty() && fit.sd[t] == 0;
        model.random.push_back({data.groups[t].name, why.empty() ? Value(fit.sd[t]) : Value::undefined(why), isZero});
        model.singular = model.singular || isZero;
    }
}

void putTest(OrdinalMixedModel& model, const Ratings& data, const LaplaceFit& full)
{
    const OrderedAnswers answers{data.levels.size(), data.category, oneLevel(data.category.size()), data.groups};
    const LaplaceFit null = laplaceFit(answers, curvature);
    model.evaluations += null.evaluations;
    if (!null.why.empty()) {
        const Value none = Value::undefined(null.why);
        model.logLikelihoodNull = none;
        model.test = {none, none, none, none};
        return;
    }
    model.logLikelihoodNull = -null.criterion / 2;
    model.test = likelihoodRatioOf(full.criterion, null.criterion, data.condition.levels.size() - 1);
}

void refuse(OrdinalMixedModel& model, const Ratings& data, const std::string& why)
{
    model.why = why;
    const Value none = Value::undefined(why);
    model.logLikelihood = model.logLikelihoodNull = none;
    model.test = {none, none, none, none};
    for (std::size_t c = 1; c < data.condition.levels.size(); ++c)
        model.fixed.push_back(undefinedLogOdds(data.condition.name + data.condition.levels[c], why));
    for (std::size_t j = 0; j + 1 < data.levels.size(); ++j)
        model.thresholds.push_back({data.levels[j], data.levels[j + 1], none, none});
    for (const Factor& group : data.groups) model.random.push_back({group.name, none, false});
}

}  // namespace

OrdinalMixedModel fitOrdinalMixedModel(const OrdinalData& data, const OrdinalOptions& options)
{
    const Ratings ratings = presentRatings(data);
    OrdinalMixedModel model;
    model.rows = ratings.category.size();
    model.missing = ratings.missing;
    model.levels = ratings.levels;
    model.counts.resize(ratings.levels.size());
    for (const std::uint32_t category : ratings.category) ++model.counts[category];
    const Estimable estimable = estimableOf(ratings);
    std::string fault = faultOf(ratings);
    if (fault.empty()) fault = gapIn(ratings, estimable);
    if (!fault.empty()) {
        refuse(model, ratings, fault);
        return model;
    }
    const LaplaceFit full = fitEstimable(ratings, estimable);
    if (!full.why.empty()) {
        refuse(model, ratings, full.why);
        return model;
    }
    model.evaluations = full.evaluations;
    putSeparation(model, ratings, estimable);
    putEffects(model, ratings, estimable, full, options.confidence);
    putRandom(model, ratings, full);
    model.logLikelihood = -full.criterion / 2;
    if (options.likelihoodRatio) putTest(model, ratings, full);
    return model;
}

}  // namespace stats
