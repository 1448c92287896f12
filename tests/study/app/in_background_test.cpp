// The one worker of the window: results and faults come back to the window's thread, dropped work does not.
#include "study/app/state/in_background.h"

#include <QTest>
#include <QThread>
#include <stdexcept>

using study::app::InBackground;

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
