// The one worker of the window: results and faults come back to the window's thread, dropped work does not. The work that nobody
// waits for: the end of the program waits for it, a moment.
#include "study/app/state/in_background.h"

#include <dlfcn.h>
#include <pthread.h>

#include <QTest>
#include <QThread>
#include <atomic>
#include <cerrno>
#include <stdexcept>

#include "database/server/server_link.h"
#include "database/server/server_progress.h"
#include "study/app/monitoring/unawaited_work.h"

using study::app::InBackground;
using study::app::UnawaitedWork;

namespace {

bool startsNoThread = false;

}  // namespace

// The linker prefers this definition to that of the C library.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* of) noexcept
{
    static const auto original = reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
    return startsNoThread ? EAGAIN : original(thread, attributes, run, of);
}

class InBackgroundTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theResultComesBackToTheWindowsThread()
    {
        InBackground background;
        QThread* worked = nullptr;
        QThread* handled = nullptr;
        background.run(
            [&](const std::atomic<bool>&) -> InBackground::Then {
                worked = QThread::currentThread();
                return [&] { handled = QThread::currentThread(); };
            },
            unexpected);
        QVERIFY(background.isBusy());
        QTRY_VERIFY(handled != nullptr);
        QVERIFY(!background.isBusy());
        QCOMPARE(handled, QThread::currentThread());
        QVERIFY(worked != handled);
    }

    void aFaultComesBackWithItsText()
    {
        InBackground background;
        QString why;
        background.run([](const std::atomic<bool>&) -> InBackground::Then { throw std::runtime_error("disk full"); },
                       [&](const QString& text) { why = text; });
        QTRY_COMPARE(why, QString("disk full"));
        QVERIFY(!background.isBusy());
    }

    void stoppedWorkIsDropped()
    {
        InBackground background;
        bool isHandled = false;
        background.run(untilStopped([&] { isHandled = true; }), unexpected);
        background.stop();
        QVERIFY(!background.isBusy());
        QTest::qWait(20);
        QVERIFY(!isHandled);
    }

    void workThatIsAskedToStopStillReports()
    {
        InBackground background;
        bool isHandled = false;
        background.run(untilStopped([&] { isHandled = true; }), unexpected);
        background.askToStop();
        QTRY_VERIFY(isHandled);
    }

    void onlyTheLastOfTwoResultsCounts()
    {
        InBackground background;
        QStringList results;
        background.run(untilStopped([&] { results << "first"; }), unexpected);
        background.run([&](const std::atomic<bool>&) -> InBackground::Then { return [&] { results << "second"; }; }, unexpected);
        QTRY_COMPARE(results, QStringList{"second"});
        QTest::qWait(20);
        QCOMPARE(results, QStringList{"second"});
    }

    void aThreadThatCannotBeginIsAFaultThatEndsTheWork()
    {
        InBackground background;
        UnawaitedWork unawaited;
        QString why, alsoWhy;
        startsNoThread = true;
        background.run(untilStopped([] {}), [&](const QString& text) { why = text; });
        unawaited.run([]() -> UnawaitedWork::Then { return [] {}; }, [&](const QString& text) { alsoWhy = text; });
        startsNoThread = false;
        QVERIFY(why.isEmpty());  // as every fault, after run()
        QTRY_VERIFY2(why.contains("close other programs"), qPrintable(why));
        QTRY_COMPARE(alsoWhy, why);
        QVERIFY(!background.isBusy() && !unawaited.isBusy());
        QVERIFY(database::haveLinksEnded(std::chrono::seconds(0)));
        bool isHandled = false;
        background.run([&](const std::atomic<bool>&) -> InBackground::Then { return [&] { isHandled = true; }; }, unexpected);
        QTRY_VERIFY(isHandled);
    }

    /// A timer of the window asks every two seconds.
    void aMonitorWithoutAThreadShowsWhyAndAsksAgain()
    {
        database::ProgressWatch watch(database::serverAddressFrom("postgresql://monitor@127.0.0.1:1/lab?study=pilot"));
        startsNoThread = true;
        watch.ask();
        startsNoThread = false;
        QVERIFY(watch.take());
        QVERIFY2(watch.fault().find("close other programs") != std::string::npos, watch.fault().c_str());
        QVERIFY(!watch.isAway());  // the server may be well
        QVERIFY(!watch.take());
        QVERIFY(database::haveLinksEnded(std::chrono::seconds(0)));
        watch.ask();
        bool isTaken = false;  // take() is true once
        QTRY_VERIFY_WITH_TIMEOUT(isTaken = isTaken || watch.take(), 30000);
        QVERIFY2(watch.fault().find("close other programs") == std::string::npos, watch.fault().c_str());
    }

    /// The end of the program must not destroy what such work uses.
    void workThatNobodyWaitsForIsKnownUntilItEnds()
    {
        std::atomic<bool> mayEnd = false;
        bool isHandled = false;
        const auto held = std::make_shared<int>(1);
        {
            UnawaitedWork work;
            work.run(
                [&mayEnd, &isHandled, held]() -> UnawaitedWork::Then {
                    while (!mayEnd) QThread::msleep(1);
                    return [&isHandled, held] { isHandled = true; };
                },
                unexpected);
        }
        QVERIFY(!database::haveLinksEnded(std::chrono::milliseconds(20)));
        mayEnd = true;
        QVERIFY(database::haveLinksEnded(std::chrono::seconds(30)));
        QCOMPARE(held.use_count(), 1L);
        QTest::qWait(20);
        QVERIFY(!isHandled);
    }

private:
    static void unexpected(const QString& why) { QFAIL(qPrintable(why)); }

    static InBackground::Work untilStopped(const InBackground::Then& then)
    {
        return [then](const std::atomic<bool>& isStopping) {
            while (!isStopping) QThread::msleep(1);
            return then;
        };
    }
};

QTEST_GUILESS_MAIN(InBackgroundTest)
#include "in_background_test.moc"
