// A row of the table "What is promised": what was done, what was asked, and what was found.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tests::promises {

struct Promise {
    std::string name;
    std::string done;           ///< how much was tried
    std::string asked;          ///< the requirement
    std::string found;          ///< the numbers
    std::optional<bool> holds;  ///< empty: a time, which a short run does not decide
};

/// How much each row tries. The defaults are the short form.
struct Effort {
    int kills = 12;
    int crashStates = 60;
    int faultPositions = 20;    ///< of one session, evenly spread; 0: every one
    int midSessionMoments = 2;  ///< of one session; 0: after every answer
    int answers = 2520;         ///< of the large study; the smaller one has a tenth of them
    int durableAnswers = 252;
    bool decidesTimes = false;  ///< times are limits, not only shown
    std::string studies;        ///< folder that keeps the large studies; empty: a temporary one
};

/// The table in Markdown.
std::string tableOf(const std::vector<Promise>& promises);

/// False where a promise is broken.
bool allHold(const std::vector<Promise>& promises);

/// "1,234"
std::string withCommas(long number);

}  // namespace tests::promises
