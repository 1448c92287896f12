// An extreme input with its known result. `vis2hap bench extremes` runs all cases, and bench_extremes_test asserts each of them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace study::bench {

/// A number as text, because it may lie beyond the range of double, or the reason why there is none.
struct ExtremeAnswer {
    std::string decimal;  ///< empty for a refusal
    std::string refusal;  ///< empty for a number
};
ExtremeAnswer numberAnswer(double number);
ExtremeAnswer answerOf(const stats::Value& value);
/// What `work` returns, or the message of the protocols::Error that it throws.
ExtremeAnswer answerOrFault(const std::function<double()>& work);

/// The same work for other programs (tests/study/bench/peers/extremes_peer.py and .R): an operation and rows of numbers.
struct PeerRequest {
    std::string operation;  ///< empty: no peer has this function
    std::vector<std::vector<double>> rows;
};

struct ExtremeCase {
    std::string room;    ///< "statistics", "SSIM", "signals", "generators", "orders", "store"
    std::string input;   ///< "{1, 2} x 2^600"
    std::string asked;   ///< "t"
    std::string truth;   ///< decimal; "refused" where no number exists
    std::string source;  ///< how the truth is known
    double leastDigits;  ///< correct digits that we promise; 0 for a refusal
    std::function<ExtremeAnswer()> ours;
    PeerRequest peer = {};

    bool mustRefuse() const { return truth == "refused"; }
    std::string name() const { return input + ": " + asked; }
};

/// Digits on which an answer agrees with the truth: -log10 of the relative error, of the error itself where the truth is 0;
/// at most 16. None for a refusal or a word such as "inf"; a truth of "refused" has none at all.
std::optional<double> correctDigits(const std::string& answer, const std::string& truth);

/// Every case of every room. The generators need vis2hap-nn.
std::vector<ExtremeCase> extremeCases();

struct PeerAnswer {
    ExtremeAnswer answer;
    double milliseconds = 0;
};

struct ExtremeResult {
    ExtremeCase asked;
    ExtremeAnswer ours;
    double milliseconds = 0;  ///< median of five runs; of one where it takes over 20 ms
    std::map<std::string, PeerAnswer> peers;

    std::optional<double> digits() const { return correctDigits(ours.decimal, asked.truth); }
    /// The promised digits, or the refusal.
    bool isReached() const;
};
bool isRight(const ExtremeAnswer& answer, const ExtremeCase& asked, double leastDigits);

/// Runs one case, without peers.
ExtremeResult resultOf(const ExtremeCase& asked);

/// Runs all cases, with the peers that are installed if `peers`. `begins` gets the name of each part.
std::vector<ExtremeResult> runExtremes(bool peers, const std::function<void(const std::string&)>& begins = {});

bool allReached(const std::vector<ExtremeResult>& results);

}  // namespace study::bench
