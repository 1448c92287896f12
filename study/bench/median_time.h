// How long a piece of work takes on this machine, for benches.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

namespace study::bench {

template <class Work>
double millisecondsOf(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// `repeats`: odd, at least 1.
template <class Work>
double medianMilliseconds(int repeats, const Work& work)
{
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) times.push_back(millisecondsOf(work));
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[static_cast<std::size_t>(repeats / 2)];
}

}  // namespace study::bench
