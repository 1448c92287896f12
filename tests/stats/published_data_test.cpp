// Small published data sets give the published results.
#include <QTest>

#include "stats/tests/rank_tests.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"

class PublishedDataTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void sleepOfStudent()
    {
        // R: with(sleep, t.test(extra[group == 1], extra[group == 2], paired = TRUE)); data of Student (1908), Biometrika 6.
        const std::vector<double> drug1{0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
        const std::vector<double> drug2{1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
        const stats::TTest test = stats::pairedTTest(drug1, drug2);
        QVERIFY(std::abs(*test.t + 4.06212768338) < 1e-10);
        QCOMPARE(*test.df, 9.0);
        QVERIFY(std::abs(*test.p - 0.00283289019738) < 1e-13);
        QVERIFY(std::abs(*test.ci.low + 2.45988576328) < 1e-10);
        QVERIFY(std::abs(*test.ci.high + 0.700114236723) < 1e-10);
    }

    void timesOfRoundingFirstBase()
    {
        // R: example(friedman.test); Hollander and Wolfe (1973), p. 140.
        const std::vector<double> times{5.40, 5.50, 5.55, 5.85, 5.70, 5.75, 5.20, 5.60, 5.50, 5.55, 5.50, 5.40, 5.90, 5.85,
                                        5.70, 5.45, 5.55, 5.60, 5.40, 5.40, 5.35, 5.45, 5.50, 5.35, 5.25, 5.15, 5.00, 5.85,
                                        5.80, 5.70, 5.25, 5.20, 5.10, 5.65, 5.55, 5.45, 5.60, 5.35, 5.45, 5.05, 5.00, 4.95,
                                        5.50, 5.50, 5.40, 5.45, 5.55, 5.50, 5.55, 5.55, 5.35, 5.45, 5.50, 5.55, 5.50, 5.45,
                                        5.25, 5.65, 5.60, 5.40, 5.70, 5.65, 5.55, 6.30, 6.30, 6.25};
        const stats::FriedmanTest test = stats::friedmanTest(stats::BlockTable{22, 3, times});
        QVERIFY(std::abs(*test.q - 11.1428571429) < 1e-9);
        QCOMPARE(*test.df, 2.0);
        QVERIFY(std::abs(*test.p - 0.00380504077551) < 1e-13);
    }
};

QTEST_APPLESS_MAIN(PublishedDataTest)
#include "published_data_test.moc"
