// Runs work on many items in several threads. Each thread has a fixed share, so the results do not depend on the number of
// threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace study::evaluation {

/// Reports the progress of long work; called by one thread at a time.
using Report = std::function<void(const std::string& stage, int done, int total)>;

/// Calls work(i) for every i < count; thread k takes the items k, k + threads, … Rethrows the first exception.
template <class Work>
void onThreads(std::size_t count, int threads, const Work& work, const std::function<void(int done)>& report = {})
{
    const auto step = static_cast<std::size_t>(threads < 1 ? 1 : threads);
    std::mutex reporting;
    std::exception_ptr failure;
    std::atomic<bool> failed{false};
    int done = 0;
    const auto share = [&](std::size_t first) {
        for (std::size_t i = first; i < count && !failed; i += step) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(reporting);
                if (!failure) failure = std::current_exception();
                failed = true;
                return;
            }
            const std::lock_guard lock(reporting);
            ++done;
            if (report) report(done);
        }
    };
    std::vector<std::thread> others;
    for (std::size_t k = 1; k < step; ++k) others.emplace_back(share, k);
    share(0);
    for (std::thread& other : others) other.join();
    if (failure) std::rethrow_exception(failure);
}

}  // namespace study::evaluation
