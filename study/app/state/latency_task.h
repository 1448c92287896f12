// The latency task of an operator, as a value without a window: signals at random moments of two minutes, and a tap at each. Its
// median says how late a time is that a key of this operator stamps. Nothing is ever subtracted.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "database/evidence/operator_latency.h"
#include "protocols/random.h"

namespace study::app {

class LatencyTask {
public:
    static constexpr std::int64_t durationNs = 120'000'000'000;
    static constexpr std::int64_t shortestWaitNs = 1'500'000'000, longestWaitNs = 4'500'000'000;
    static constexpr std::int64_t missedAfterNs = 1'500'000'000;
    /// Nobody reacts faster, so that an earlier tap was not caused by the signal.
    static constexpr std::int64_t anticipatedBeforeNs = 100'000'000;

    enum class Step {
        Wait,
        GiveSignal,  ///< give it now, then call signalGiven()
        Missed,      ///< nobody tapped: take the signal away
        Done,
    };

    /// `seed`: draws the moments, which nobody may foresee.
    LatencyTask(std::int64_t startNs, std::uint64_t seed);

    Step advance(std::int64_t nowNs);
    void signalGiven(std::int64_t atNs) { m_givenNs = atNs; }
    /// True for a tap that answers a signal. One that comes before a signal, or too soon after it, is an anticipation, and the
    /// wait begins anew.
    bool tap(std::int64_t atNs);

    int taps() const { return static_cast<int>(m_latenciesMs.size()); }
    double secondsLeft(std::int64_t nowNs) const;
    /// Median and quartiles (type 7) of the taps, and the counts. Operator, signal and time are empty.
    database::OperatorLatency result() const;

private:
    void waitFrom(std::int64_t nowNs);

    protocols::Random m_random;
    std::int64_t m_endNs = 0, m_nextNs = 0;
    std::optional<std::int64_t> m_givenNs;  ///< the signal that waits for its tap
    std::vector<double> m_latenciesMs;
    int m_misses = 0, m_anticipations = 0;
};

}  // namespace study::app
