#include "study/bench/extremes/extreme_case.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "study/bench/extremes/extreme_images.h"
#include "study/bench/extremes/extreme_peers.h"
#include "study/bench/extremes/extreme_samples.h"
#include "study/bench/extremes/extreme_signals.h"
#include "study/bench/extremes/extreme_studies.h"
#include "study/bench/median_time.h"

namespace study::bench {

namespace {

constexpr double mostDigits = 16;
constexpr double longMs = 20;

/// 80-bit numbers reach 1e4932, so that truths beyond double can be compared.
std::optional<long double> wide(const std::string& text)
{
    long double number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
}

}  // namespace

ExtremeAnswer numberAnswer(double number) { return {protocols::shortest(number), ""}; }

ExtremeAnswer answerOf(const stats::Value& value)
{
    if (value.exists()) return numberAnswer(*value);
    if (!value.decimal().empty()) return {value.decimal(), ""};
    return {"", value.why()};
}

ExtremeAnswer answerOrFault(const std::function<double()>& work)
{
    try {
        return numberAnswer(work());
    } catch (const protocols::Error& fault) {
        return {"", fault.what()};
    }
}

std::optional<double> correctDigits(const std::string& answer, const std::string& truth)
{
    const auto found = wide(answer), known = wide(truth);
    if (!found || !known) return std::nullopt;
    // The truth is rounded to 17 digits or more; a double that is nearest to it is right.
    const auto nearest = static_cast<double>(*known);
    if (static_cast<double>(*found) == nearest && std::isfinite(nearest)) return mostDigits;
    const long double error = std::fabs(*found - *known) / (*known == 0 ? 1.0L : std::fabs(*known));
    if (error == 0) return mostDigits;
    return std::min(mostDigits, std::max(0.0, static_cast<double>(-std::log10(error))) + 0.0);  // no -0
}

bool isRight(const ExtremeAnswer& answer, const ExtremeCase& asked, double leastDigits)
{
    if (asked.mustRefuse()) return answer.decimal.empty() && !answer.refusal.empty();
    return correctDigits(answer.decimal, asked.truth).value_or(-1) >= leastDigits;
}

bool ExtremeResult::isReached() const { return isRight(ours, asked, asked.leastDigits); }

std::vector<ExtremeCase> extremeCases()
{
    std::vector<ExtremeCase> all;
    for (auto part : {extremeSamples, extremeImages, extremeSignals, extremeStudies})
        for (ExtremeCase& one : part()) all.push_back(std::move(one));
    return all;
}

ExtremeResult resultOf(const ExtremeCase& asked)
{
    ExtremeResult result{asked, {}, 0, {}};
    result.milliseconds = millisecondsOf([&] { result.ours = asked.ours(); });
    if (result.milliseconds < longMs) result.milliseconds = medianMilliseconds(5, [&] { asked.ours(); });
    return result;
}

std::vector<ExtremeResult> runExtremes(bool peers, const std::function<void(const std::string&)>& begins)
{
    std::vector<ExtremeResult> results;
    for (const ExtremeCase& one : extremeCases()) {
        if (begins && (results.empty() || results.back().asked.room != one.room)) begins("extremes: " + one.room);
        results.push_back(resultOf(one));
    }
    if (peers) {
        if (begins) begins("extremes: other programs");
        addPeerAnswers(results);
    }
    return results;
}

bool allReached(const std::vector<ExtremeResult>& results)
{
    return std::all_of(results.begin(), results.end(), [](const ExtremeResult& one) { return one.isReached(); });
}

}  // namespace study::bench
