#include "reports/cells/chance_level.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace reports {
namespace {

struct PairHalves {
    long long same = 0, different = 0;

    long long excess() const { return std::abs(same - different); }
    long long pairs() const { return same + different; }
};

}  // namespace

std::string whyNoChance(const RightOrWrong& scoring, const std::vector<const StudyResponse*>& responses)
{
    if (!scoring.isSameDifferent) return {};
    PairHalves all;
    std::map<std::pair<std::string_view, std::string_view>, PairHalves> lists;  // of one condition and instruction
    for (const StudyResponse* response : responses) {
        const auto* choice = std::get_if<ChosenAnswer>(&response->content);
        if (choice == nullptr || !choice->answer) continue;
        const bool wasSame = (*choice->answer == "same") == choice->correct;
        for (PairHalves* halves : {&all, &lists[{response->condition, response->instruction}]})
            ++(wasSame ? halves->same : halves->different);
    }
    const auto isHalved = [](const auto& list) { return list.second.excess() <= 1; };
    if (std::ranges::all_of(lists, isHalved) || 16 * all.excess() * all.excess() <= all.pairs()) return {};
    return "guessing is not right in half of the answers: " + std::to_string(all.same) + " of " + std::to_string(all.pairs()) +
           " pairs were the same";
}

}  // namespace reports
