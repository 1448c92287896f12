// Work on many items by several threads. The result never depends on the number of threads, because each item writes only
// what belongs to it: give every item a place of its own and, where it draws, a stream of random numbers of its own.
#pragma once

#include <cstddef>
#include <functional>

namespace stats {

/// Number of threads to use: `wanted`, or the number of the machine's processors where it is 0. At least 1.
unsigned threadCount(unsigned wanted);

/// Calls work(i) once for every i < count. With one thread, the caller does all work in order. `progress` gets the number of
/// finished items; it is called on one thread at a time, which need not be the caller's. The first exception of `work` or
/// `progress` is thrown to the caller after all threads have ended; items that have not begun are then left out.
void onThreads(std::size_t count, unsigned threads, const std::function<void(std::size_t i)>& work,
               const std::function<void(std::size_t done)>& progress = {});

}  // namespace stats
