#include "study/bench/bench_turns.h"

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "study/bench/median_time.h"

namespace study::bench {

namespace {

/// A line of /proc/self/status, "VmHWM:" or "VmRSS:", MB.
double statusMb(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name)) return std::strtod(line.c_str() + name.size(), nullptr) * 1024 / 1e6;
    return 0;
}

double quantileOf(std::vector<double> times, double share)
{
    std::sort(times.begin(), times.end());
    const double place = share * static_cast<double>(times.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double next = times[std::min(below + 1, times.size() - 1)];
    return times[below] + (place - static_cast<double>(below)) * (next - times[below]);
}

}  // namespace

std::optional<double> megabytesOf(const std::function<void()>& work)
{
    ::malloc_trim(0);
    {
        std::ofstream reset("/proc/self/clear_refs");  // 5 resets VmHWM to the memory in use
        reset << "5";
        reset.flush();
        if (!reset) {
            work();
            return std::nullopt;
        }
    }
    const double before = statusMb("VmRSS:");
    work();
    return std::max(0.0, statusMb("VmHWM:") - before);
}

std::vector<BenchRow> benchInTurns(const std::vector<TimedSetting>& settings, const Rounds& rounds)
{
    std::vector<BenchRow> rows;
    double roundMs = 0;
    for (const TimedSetting& one : settings) {
        rows.push_back(one.row);
        double ms = 0;
        rows.back().megabytes = megabytesOf([&] { ms = millisecondsOf(one.work); });
        roundMs += ms;
        if (one.error) rows.back().error = one.error();
    }
    const int affordable = static_cast<int>(std::min(1e6, rounds.wantedMs / std::max(roundMs, 1e-3)));
    const int count = std::clamp(affordable, rounds.least, std::max(rounds.least, rounds.most));
    std::vector<std::vector<double>> times(settings.size());
    for (int round = 0; round < count; ++round)
        for (std::size_t k = 0; k < settings.size(); ++k) {
            const std::size_t i = (k + static_cast<std::size_t>(round)) % settings.size();
            times[i].push_back(millisecondsOf(settings[i].work));
        }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].milliseconds = quantileOf(times[i], 0.5);
        rows[i].quartiles = Quartiles{quantileOf(times[i], 0.25), quantileOf(times[i], 0.75)};
    }
    markFronts(rows);
    return rows;
}

}  // namespace study::bench
