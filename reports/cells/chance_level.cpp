#include "reports/cells/chance_level.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>
#include <tuple>

namespace reports {
namespace {

constexpr double mostDeviations = 1.5;

/// Variance of the excess among `pairs` of a list of `whole` pairs, whose halves are equal or differ by one. Which pairs are
/// left, and which half has one more, are draws.
double varianceOfExcess(long long pairs, long long whole)
{
    const auto left = static_cast<double>(pairs), all = static_cast<double>(whole);
    return whole % 2 == 0 ? left * (all - left) / (all - 1) : left * (all - left + 1) / all;
}

/// Whether each list differs by what it lacks at most, and all together by no more than draws do.
bool areDrawnHalves(const std::vector<PairList>& lists, double excess, double pairs)
{
    long long whole = 0;
    for (const PairList& list : lists) whole = std::max(whole, list.pairs());
    double variance = 0;
    for (const PairList& list : lists) {
        if (std::abs(list.excess()) > 1 + whole - list.pairs()) return false;
        variance += varianceOfExcess(list.pairs(), whole);
    }
    return excess * excess <= std::min(mostDeviations * mostDeviations * variance, pairs);
}

}  // namespace

std::string whyNotHalved(const std::vector<PairList>& lists)
{
    PairList all;
    for (const PairList& list : lists) {
        all.same += list.same;
        all.different += list.different;
    }
    const auto excess = static_cast<double>(std::abs(all.excess())), pairs = static_cast<double>(all.pairs());
    if (excess <= 1 || 16 * excess * excess <= pairs || areDrawnHalves(lists, excess, pairs)) return {};
    return "guessing is not right in half of the answers: " + std::to_string(all.same) + " of " + std::to_string(all.pairs()) +
           " pairs were the same";
}

std::string whyNoChance(const RightOrWrong& scoring, const std::vector<const StudyResponse*>& responses)
{
    if (!scoring.isSameDifferent) return {};
    std::map<std::tuple<std::string_view, std::string_view, std::string_view>, PairList> byName;
    for (const StudyResponse* response : responses) {
        const auto* choice = std::get_if<ChosenAnswer>(&response->content);
        if (choice == nullptr || !choice->answer) continue;
        const bool wasSame = (*choice->answer == "same") == choice->correct;
        PairList& list = byName[{response->participant, response->condition, response->instruction}];
        ++(wasSame ? list.same : list.different);
    }
    std::vector<PairList> lists;
    for (const auto& [names, list] : byName) lists.push_back(list);
    return whyNotHalved(lists);
}

}  // namespace reports
