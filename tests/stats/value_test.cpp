// Reading an undefined value throws, and assertions are on in this build.
#include "stats/kernels/value.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <QTest>
#include <csignal>

#include "stats/models/mixed_model.h"

class ValueTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void readingAnUndefinedValueThrowsItsReason_data()
    {
        QTest::addColumn<stats::Value>("value");
        QTest::addColumn<QString>("why");
        QTest::newRow("undefined") << stats::Value::undefined("there are no values") << "there are no values";
        QTest::newRow("never set") << stats::Value() << "not computed";
        QTest::newRow("beyond double") << stats::Value::beyondDouble("1.8e+308") << "beyond the largest number";
    }

    void readingAnUndefinedValueThrowsItsReason()
    {
        QFETCH(stats::Value, value);
        QFETCH(QString, why);
        QVERIFY(!value.exists() && !static_cast<bool>(value));
        QCOMPARE(value.orElse(3), 3.0);
        double number = 7;
        try {
            number = *value;
            QFAIL("an undefined value gave a number");
        } catch (const stats::UndefinedValueRead& fault) {
            QVERIFY2(QString(fault.what()).contains(why), fault.what());
        }
        QCOMPARE(number, 7.0);
        QVERIFY_EXCEPTION_THROWN(*value, std::logic_error);
    }

    void aDefinedValueIsItsNumber()
    {
        const stats::Value value = 0.25;
        QVERIFY(value.exists() && static_cast<bool>(value));
        QCOMPARE(*value, 0.25);
        QCOMPARE(value.orElse(3), 0.25);
        QVERIFY(value == stats::Value(0.25) && !(value == stats::Value(0.5)) && !(value == stats::Value::undefined("")));
        QCOMPARE(stats::Value::beyondDouble("1.8e+308").decimal(), std::string("1.8e+308"));
    }

    void copiesShareTheReasonAndEqualReasonsAreEqual()
    {
        const stats::Value value = stats::Value::undefined("there are no values"), copy = value;
        QCOMPARE(&copy.why(), &value.why());
        QVERIFY(copy == value && value == stats::Value::undefined("there are no values"));
        QVERIFY(!(value == stats::Value::undefined("there is one value only")) && !(value == stats::Value()));
        QVERIFY(!(stats::Value::beyondDouble("1.8e+308") == stats::Value::beyondDouble("1.9e+308")));
        stats::Value other = value;
        other = 0.25;
        QVERIFY(other == stats::Value(0.25) && copy.why() == "there are no values");
    }

    // A report of 200 conditions holds some 6 million values.
    void aValueIsSmall() { QVERIFY(sizeof(stats::Value) <= 24); }

    void thisBuildChecksAssertions()
    {
#ifdef NDEBUG
        QFAIL("NDEBUG is defined: the invariants of the product are not checked in this build");
#endif
    }

    // The library is compiled with assertions as well: a contrast with too few weights aborts the child process.
    void theLibraryChecksItsInvariants()
    {
        stats::MixedModel model;
        model.estimates = {1, 2};
        const pid_t child = fork();
        QVERIFY(child >= 0);
        if (child == 0) {
            dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
            std::signal(SIGABRT, SIG_DFL);
            stats::contrastTest(model, std::vector<double>{1});
            _exit(0);
        }
        int status = 0;
        QCOMPARE(waitpid(child, &status, 0), child);
        QVERIFY2(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT, "assertions are off in the library");
    }
};

QTEST_GUILESS_MAIN(ValueTest)
#include "value_test.moc"
