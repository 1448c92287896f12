#include "stats/models/logistic_mixed_model.h"

#include <algorithm>
#include <cmath>

#include "stats/models/laplace_fit.h"
#include "stats/models/mixed_model_rows.h"

namespace stats {
namespace {

/// The choices that are not missing, and the conditions that are separated.
struct Prepared {
    std::string why;
    std::size_t missing = 0;
    std::vector<double> right;
    Factor condition;
    std::vector<Factor> groups;
    std::vector<bool> separated;  ///< one for each condition
};

std::vector<std::size_t> presentRows(const std::vector<double>& right)
{
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < right.size(); ++row)
        if (!std::isnan(right[row])) rows.push_back(row);
    return rows;
}

std::vector<bool> separatedLevels(const std::vector<double>& right, const Factor& condition)
{
    std::vector<std::size_t> all(condition.levels.size());
    std::vector<std::size_t> ones(condition.levels.size());
    for (std::size_t row = 0; row < right.size(); ++row) {
        ++all[condition.of[row]];
        ones[condition.of[row]] += right[row] == 1 ? 1 : 0;
    }
    std::vector<bool> separated;
    for (std::size_t c = 0; c < all.size(); ++c) separated.push_back(ones[c] == 0 || ones[c] == all[c]);
    return separated;
}

std::string faultOf(const Prepared& data)
{
    const auto& right = data.right;
    if (right.empty()) return "there are no choices";
    if (std::any_of(right.begin(), right.end(), [](double x) { return x != 0 && x != 1; }))
        return "a choice is neither right (1) nor wrong (0)";
    if (data.condition.levels.size() < 2) return "there is one condition only";
    const auto sum = std::count(right.begin(), right.end(), 1.0);
    if (sum == 0) return "every choice was wrong";
    if (sum == static_cast<std::ptrdiff_t>(right.size())) return "every choice was right";
    for (const Factor& group : data.groups)
        if (group.levels.size() < 2) return "all choices belong to one " + group.name + ": its variance cannot be estimated";
    return {};
}

Prepared prepared(const LogisticData& data)
{
    Prepared result;
    const auto rows = presentRows(data.right);
    result.missing = data.right.size() - rows.size();
    for (const std::size_t row : rows) result.right.push_back(data.right[row]);
    result.condition = rowsOf(data.condition, rows);
    for (const Factor& group : data.groups) result.groups.push_back(rowsOf(group, rows));
    result.separated = separatedLevels(result.right, result.condition);
    result.why = faultOf(result);
    return result;
}

std::string named(const Prepared& data, std::size_t level)
{
    for (std::size_t row = 0; row < data.right.size(); ++row)
        if (data.condition.of[row] == level)
            return data.condition.levels[level] + (data.right[row] == 1 ? " (always right)" : " (always wrong)");
    return data.condition.levels[level];
}

void putSeparation(LogisticMixedModel& model, const Prepared& data)
{
    std::size_t count = 0;
    for (std::size_t level = 0; level < data.separated.size(); ++level) {
        if (!data.separated[level]) continue;
        model.separationWhy += (count++ == 0 ? "" : ", ") + named(data, level);
    }
    if (count == 0) return;
    const bool all = count == data.separated.size();
    model.separation = all ? Separation::Complete : Separation::Quasi;
    model.separationWhy = (all ? "complete separation: " : "quasi-complete separation: ") + model.separationWhy;
}

/// `cellOf`: cell of the fit for each condition.
void putFixed(LogisticMixedModel& model, const Prepared& data, const LaplaceFit& fit, const std::vector<std::size_t>& cellOf,
              double confidence)
{
    const auto& levels = data.condition.levels;
    for (std::size_t level = 0; level < levels.size(); ++level) {
        const std::string name = level == 0 ? "(Intercept)" : data.condition.name + levels[level];
        if (data.separated[level] || data.separated[0]) {
            model.fixed.push_back(undefinedLogOdds(name, "has no finite estimate: " + model.separationWhy));
            continue;
        }
        const std::size_t a = cellOf[level];
        const std::size_t reference = cellOf[0];
        const Matrix& c = fit.covariance;
        model.fixed.push_back(level == 0 ? logOddsOf(name, fit.means[a], c(a, a), confidence)
                                         : logOddsOf(name, fit.means[a] - fit.means[reference],
                                                     c(a, a) + c(reference, reference) - 2 * c(a, reference), confidence));
    }
}

/// Covariance of the treatment-coded effects, from the covariance of the means of the cells.
Matrix treatmentCovariance(const Matrix& c, std::size_t cells)
{
    const auto effect = [&](std::size_t i, std::size_t j) {  // cov(mean_i - mean_0, mean_j)
        return c(i, j) - (i == 0 ? 0 : c(0, j));
    };
    Matrix result(cells, cells);
    for (std::size_t i = 0; i < cells; ++i)
        for (std::size_t j = 0; j < cells; ++j) result(i, j) = effect(i, j) - (j == 0 ? 0 : effect(i, 0));
    return result;
}

void putTest(LogisticMixedModel& model, const LaplaceFit& full, const LaplaceFit& null, std::size_t conditions)
{
    model.logLikelihood = -full.criterion / 2;
    if (!null.why.empty()) {
        model.logLikelihoodNull = model.chiSquared = model.df = model.p = model.logP = Value::undefined(null.why);
        return;
    }
    model.logLikelihoodNull = -null.criterion / 2;
    const LikelihoodRatio test = likelihoodRatioOf(full.criterion, null.criterion, conditions - 1);
    model.chiSquared = test.chiSquared;
    model.df = test.df;
    model.p = test.p;
    model.logP = test.logP;
}

void refuse(LogisticMixedModel& model, const Prepared& data, const std::string& why)
{
    model.why = why;
    const Value none = Value::undefined(why);
    model.logLikelihood = model.logLikelihoodNull = model.chiSquared = model.df = model.p = model.logP = none;
    for (std::size_t level = 0; level < data.condition.levels.size(); ++level)
        model.fixed.push_back(
            undefinedLogOdds(level == 0 ? "(Intercept)" : data.condition.name + data.condition.levels[level], why));
    for (const Factor& group : data.groups) model.random.push_back({group.name, none, false});
}

/// Fits the conditions that are not separated. In the limit, the others contribute nothing to the log likelihood.
/// `cellOf` receives the cell of each condition.
LaplaceFit fitUnseparated(const Prepared& data, Curvature curvature, std::vector<std::size_t>& cellOf)
{
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < data.right.size(); ++row)
        if (!data.separated[data.condition.of[row]]) rows.push_back(row);
    std::size_t cell = 0;
    for (const bool separated : data.separated) cellOf.push_back(separated ? 0 : cell++);
    if (rows.empty()) {
        LaplaceFit fit;  // every probability is 0 or 1, so that the likelihood is 1 for any groups
        fit.sd.assign(data.groups.size(), 0);
        return fit;
    }
    OrderedAnswers answers{2, {}, rowsOf(data.condition, rows), {}};
    for (const std::size_t row : rows) answers.category.push_back(data.right[row] == 1 ? 1 : 0);
    for (const Factor& group : data.groups) answers.groups.push_back(rowsOf(group, rows));
    return laplaceFit(answers, curvature);
}

LaplaceFit fitWithoutCondition(const Prepared& data, Curvature curvature)
{
    OrderedAnswers answers{2, {}, oneLevel(data.right.size()), data.groups};
    for (const double right : data.right) answers.category.push_back(right == 1 ? 1 : 0);
    return laplaceFit(answers, curvature);
}

}  // namespace

LogisticMixedModel fitLogisticMixedModel(const LogisticData& data, const LogisticOptions& options)
{
    const Prepared ready = prepared(data);
    LogisticMixedModel model;
    model.rows = ready.right.size();
    model.missing = ready.missing;
    if (!ready.why.empty()) {
        refuse(model, ready, ready.why);
        return model;
    }
    putSeparation(model, ready);
    std::vector<std::size_t> cellOf;
    const LaplaceFit full = fitUnseparated(ready, options.curvature, cellOf);
    if (!full.why.empty()) {
        refuse(model, ready, full.why);
        return model;
    }
    const LaplaceFit null = fitWithoutCondition(ready, options.curvature);
    model.evaluations = full.evaluations + null.evaluations;
    putFixed(model, ready, full, cellOf, options.confidence);
    for (std::size_t t = 0; t < ready.groups.size(); ++t) {
        const std::string why = model.separation == Separation::Complete ? model.separationWhy
                                : std::isnan(full.sd[t])                 ? sharedVariance
                                                                         : "";
        const bool isZero = why.empty() && full.sd[t] == 0;
        model.random.push_back({ready.groups[t].name, why.empty() ? Value(full.sd[t]) : Value::undefined(why), isZero});
        model.singular = model.singular || isZero;
    }
    if (model.separation == Separation::None) model.covariance = treatmentCovariance(full.covariance, full.means.size());
    putTest(model, full, null, ready.condition.levels.size());
    return model;
}

}  // namespace stats
