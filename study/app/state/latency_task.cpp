#include "study/app/state/latency_task.h"

#include <algorithm>
#include <cmath>

namespace study::app {

namespace {

/// Quantile of type 7 of sorted values.
double quantileOf(const std::vector<double>& sorted, double share)
{
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

}  // namespace

LatencyTask::LatencyTask(std::int64_t startNs, std::uint64_t seed)
    : m_random(protocols::Random::stream(seed, "signals of the latency task")), m_endNs(startNs + durationNs)
{
    waitFrom(startNs);
}

void LatencyTask::waitFrom(std::int64_t nowNs)
{
    m_givenNs.reset();
    m_nextNs = nowNs + shortestWaitNs +
               static_cast<std::int64_t>(m_random.below(static_cast<std::uint64_t>(longestWaitNs - shortestWaitNs)));
}

LatencyTask::Step LatencyTask::advance(std::int64_t nowNs)
{
    if (m_givenNs && nowNs - *m_givenNs >= missedAfterNs) {
        ++m_misses;
        waitFrom(nowNs);
        return Step::Missed;
    }
    if (m_givenNs) return Step::Wait;
    if (nowNs >= m_endNs) return Step::Done;
    return nowNs >= m_nextNs ? Step::GiveSignal : Step::Wait;
}

bool LatencyTask::tap(std::int64_t atNs)
{
    const bool isAnswer = m_givenNs && atNs - *m_givenNs >= anticipatedBeforeNs;
    if (isAnswer)
        m_latenciesMs.push_back(static_cast<double>(atNs - *m_givenNs) / 1e6);
    else
        ++m_anticipations;
    waitFrom(atNs);
    return isAnswer;
}

double LatencyTask::secondsLeft(std::int64_t nowNs) const
{
    return static_cast<double>(std::max<std::int64_t>(0, m_endNs - nowNs)) / 1e9;
}

database::OperatorLatency LatencyTask::result() const
{
    database::OperatorLatency run;
    run.seconds = static_cast<double>(durationNs) / 1e9;
    run.taps = taps();
    run.misses = m_misses;
    run.anticipations = m_anticipations;
    if (m_latenciesMs.empty()) return run;
    std::vector<double> sorted = m_latenciesMs;
    std::ranges::sort(sorted);
    run.medianMs = quantileOf(sorted, 0.5);
    run.q1Ms = quantileOf(sorted, 0.25);
    run.q3Ms = quantileOf(sorted, 0.75);
    return run;
}

}  // namespace study::app
