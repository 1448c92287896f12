#include "tests/promises/promise.h"

#include <algorithm>

namespace tests::promises {

namespace {

std::string verdictOf(const Promise& promise)
{
    if (!promise.holds) return "shown";
    return *promise.holds ? "yes" : "NO";
}

}  // namespace

std::string tableOf(const std::vector<Promise>& promises)
{
    std::string text = "| promise | done | asked | found | holds |\n|---|---|---|---|---|\n";
    for (const Promise& promise : promises)
        text += "| " + promise.name + " | " + promise.done + " | " + promise.asked + " | " + promise.found + " | " +
                verdictOf(promise) + " |\n";
    return text;
}

bool allHold(const std::vector<Promise>& promises)
{
    return std::ranges::all_of(promises, [](const Promise& promise) { return promise.holds.value_or(true); });
}

std::string withCommas(long number)
{
    std::string digits = std::to_string(number);
    for (int place = static_cast<int>(digits.size()) - 3; place > 0; place -= 3)
        digits.insert(static_cast<std::size_t>(place), ",");
    return digits;
}

}  // namespace tests::promises
