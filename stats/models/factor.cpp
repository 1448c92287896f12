#include "stats/models/factor.h"

#include <map>
#include <utility>

namespace stats {

Factor factorOf(std::string name, std::span<const std::string> values)
{
    Factor factor{std::move(name), {}, {}};
    std::map<std::string, std::size_t> known;
    for (const std::string& value : values) {
        const auto [place, isNew] = known.emplace(value, factor.levels.size());
        if (isNew) factor.levels.push_back(value);
        factor.of.push_back(place->second);
    }
    return factor;
}

Factor interactionOf(const Factor& a, const Factor& b)
{
    Factor factor{a.name + ":" + b.name, {}, {}};
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> known;
    for (std::size_t row = 0; row < a.of.size(); ++row) {
        const auto [place, isNew] = known.emplace(std::pair(a.of[row], b.of[row]), factor.levels.size());
        if (isNew) factor.levels.push_back(a.levels[a.of[row]] + ":" + b.levels[b.of[row]]);
        factor.of.push_back(place->second);
    }
    return factor;
}

Factor rowsOf(const Factor& factor, std::span<const std::size_t> rows)
{
    std::vector<bool> occurs(factor.levels.size());
    for (const std::size_t row : rows) occurs[factor.of[row]] = true;
    Factor result{factor.name, {}, {}};
    std::vector<std::size_t> renumbered(factor.levels.size());
    for (std::size_t level = 0; level < occurs.size(); ++level) {
        if (!occurs[level]) continue;
        renumbered[level] = result.levels.size();
        result.levels.push_back(factor.levels[level]);
    }
    for (const std::size_t row : rows) result.of.push_back(renumbered[factor.of[row]]);
    return result;
}

Factor oneLevel(std::size_t rows) { return {"all", {"all"}, std::vector<std::size_t>(rows)}; }

FixedEffects treatmentCoded(const Factor& factor)
{
    FixedEffects effects = interceptOnly(factor.of.size());
    for (std::size_t level = 1; level < factor.levels.size(); ++level) {
        effects.names.push_back(factor.name + factor.levels[level]);
        std::vector<double> column(factor.of.size());
        for (std::size_t row = 0; row < column.size(); ++row) column[row] = factor.of[row] == level ? 1 : 0;
        effects.columns.push_back(std::move(column));
    }
    return effects;
}

FixedEffects interceptOnly(std::size_t rows) { return {{"(Intercept)"}, {std::vector<double>(rows, 1.0)}}; }

}  // namespace stats
