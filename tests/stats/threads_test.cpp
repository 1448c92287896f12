// Work on several threads: every item runs once, one thread keeps the order, and faults reach the caller.
#include "stats/kernels/threads.h"

#include <QTest>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

class ThreadsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void everyItemIsDoneOnce_data()
    {
        QTest::addColumn<unsigned>("threads");
        QTest::addColumn<int>("count");
        QTest::newRow("one thread") << 1U << 100;
        QTest::newRow("more threads than items") << 8U << 3;
        QTest::newRow("as many as the machine has") << 0U << 1000;
        QTest::newRow("nothing to do") << 4U << 0;
    }
    void everyItemIsDoneOnce()
    {
        QFETCH(unsigned, threads);
        QFETCH(int, count);
        std::vector<std::atomic<int>> times(static_cast<std::size_t>(count));
        std::vector<std::size_t> shown;
        stats::onThreads(
            times.size(), threads, [&](std::size_t i) { ++times[i]; }, [&](std::size_t done) { shown.push_back(done); });
        for (const auto& one : times) QCOMPARE(one.load(), 1);
        std::vector<std::size_t> rising(times.size());
        std::iota(rising.begin(), rising.end(), std::size_t{1});
        QCOMPARE(shown, rising);
    }

    void oneThreadIsTheCallersAndWorksInOrder()
    {
        std::vector<std::size_t> order;
        stats::onThreads(5, 1, [&](std::size_t i) {
            QCOMPARE(std::this_thread::get_id(), m_caller);
            order.push_back(i);
        });
        QCOMPARE(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    }

    void severalThreadsWorkAtATime()
    {
        std::atomic<int> begun{0}, met{0};
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        stats::onThreads(2, 2, [&](std::size_t) {
            ++begun;
            while (begun < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
            if (begun == 2) ++met;
        });
        QCOMPARE(met.load(), 2);
    }

    void aFaultReachesTheCallerAndEndsTheWork_data()
    {
        QTest::addColumn<unsigned>("threads");
        QTest::newRow("1") << 1U;
        QTest::newRow("3") << 3U;
    }
    void aFaultReachesTheCallerAndEndsTheWork()
    {
        QFETCH(unsigned, threads);
        std::atomic<int> begun{0};
        const auto run = [&] {
            stats::onThreads(20000, threads, [&](std::size_t i) {
                ++begun;
                if (i == 5) throw std::runtime_error("item 5");
                if (i > 5) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // so the fault comes before the end
            });
        };
        QVERIFY_EXCEPTION_THROWN(run(), std::runtime_error);
        if (threads == 1) QCOMPARE(begun.load(), 6);
        QVERIFY(begun < 20000);
    }

    void aFaultOfTheProgressReachesTheCaller()
    {
        const auto stop = [](std::size_t done) {
            if (done == 2) throw std::runtime_error("stopped");
        };
        QVERIFY_EXCEPTION_THROWN(stats::onThreads(
                                     50, 2, [](std::size_t) {}, stop),
                                 std::runtime_error);
    }

    void thereIsAlwaysOneThread()
    {
        QCOMPARE(stats::threadCount(3), 3U);
        QVERIFY(stats::threadCount(0) >= 1);
    }

private:
    const std::thread::id m_caller = std::this_thread::get_id();
};

QTEST_GUILESS_MAIN(ThreadsTest)
#include "threads_test.moc"
