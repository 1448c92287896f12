#include "stats/kernels/threads.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace stats {

unsigned threadCount(unsigned wanted) { return wanted > 0 ? wanted : std::max(1U, std::thread::hardware_concurrency()); }

void onThreads(std::size_t count, unsigned threads, const std::function<void(std::size_t i)>& work,
               const std::function<void(std::size_t done)>& progress)
{
    std::atomic<std::size_t> next{0};
    std::mutex reporting;
    std::size_t done = 0;
    std::exception_ptr failure;
    const auto takeItems = [&] {
        try {
            for (std::size_t i = next++; i < count; i = next++) {
                work(i);
                if (!progress) continue;
                const std::lock_guard lock(reporting);
                progress(++done);
            }
        } catch (...) {
            const std::lock_guard lock(reporting);
            if (!failure) failure = std::current_exception();
            next = count;
        }
    };
    std::vector<std::jthread> others;
    for (std::size_t k = 1; k < std::min<std::size_t>(threadCount(threads), count); ++k) others.emplace_back(takeItems);
    takeItems();
    others.clear();  // joins
    if (failure) std::rethrow_exception(failure);
}

}  // namespace stats
