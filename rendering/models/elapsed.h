// Time of a piece of work.
#pragma once

#include <chrono>

namespace rendering::models {

/// Milliseconds that `work` takes by the clock on the wall.
template <class Work>
double millisecondsOf(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace rendering::models
