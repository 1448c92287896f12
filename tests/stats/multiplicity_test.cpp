// Adjusted p values against R's p.adjust.
#include "stats/tests/multiplicity.h"

#include <QTest>
#include <vector>

#include "tests/stats/exact_numbers.h"

namespace {

using stats::Adjustment;
using Numbers = std::vector<double>;

}  // namespace

class MultiplicityTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // All numbers: Rscript tests/stats/reference/counts.R; p.adjust(c(.012, .04, NA, .0009, .04, .31, .02, .86, .0051))
    void everyMethodAsInR_data()
    {
        QTest::addColumn<Adjustment>("method");
        QTest::addColumn<Numbers>("expected");
        QTest::addColumn<Numbers>("ofThree");
        QTest::newRow("holm") << Adjustment::Holm << Numbers{0.072, 0.16, 0.0072, 0.16, 0.62, 0.1, 0.86, 0.0357}
                              << Numbers{0.06, 0.06, 0.06};
        QTest::newRow("hochberg") << Adjustment::Hochberg << Numbers{0.072, 0.12, 0.0072, 0.12, 0.62, 0.1, 0.86, 0.0357}
                                  << Numbers{0.031, 0.031, 0.031};
        QTest::newRow("bonferroni") << Adjustment::Bonferroni << Numbers{0.096, 0.32, 0.0072, 0.32, 1.0, 0.16, 1.0, 0.0408}
                                    << Numbers{0.09, 0.06, 0.093};
        QTest::newRow("BH") << Adjustment::BenjaminiHochberg
                            << Numbers{0.032, 0.0533333333333333, 0.0072, 0.0533333333333333, 0.354285714285714, 0.04, 0.86,
                                       0.0204}
                            << Numbers{0.031, 0.031, 0.031};
        QTest::newRow("BY") << Adjustment::BenjaminiYekutieli << Numbers{0.0869714285714286,
                                                                         0.144952380952381,
                                                                         0.0195685714285714,
                                                                         0.144952380952381,
                                                                         0.962897959183673,
                                                                         0.108714285714286,
                                                                         1.0,
                                                                         0.0554442857142857}
                            << Numbers{0.031 * 11 / 6, 0.031 * 11 / 6, 0.031 * 11 / 6};
    }

    void everyMethodAsInR()
    {
        QFETCH(Adjustment, method);
        QFETCH(Numbers, expected);
        QFETCH(Numbers, ofThree);
        const std::vector<stats::Value> p{0.012, 0.04,  stats::Value::undefined("no variation"), 0.0009, 0.04, 0.31, 0.02,
                                          0.86,  0.0051};
        const auto found = stats::adjusted(p, method);
        compareNumbers({{"1", found[0], expected[0]},
                        {"2", found[1], expected[1]},
                        {"4", found[3], expected[2]},
                        {"5, tied with 2", found[4], expected[3]},
                        {"6", found[5], expected[4]},
                        {"7", found[6], expected[5]},
                        {"8", found[7], expected[6]},
                        {"9", found[8], expected[7]}});
        compareReasons({{"3", found[2], "no variation"}});
        const auto three = stats::adjusted(std::vector<stats::Value>{0.03, 0.02, 0.031}, method);
        compareNumbers({{"first of three", three[0], ofThree[0]},
                        {"second of three", three[1], ofThree[1]},
                        {"third of three", three[2], ofThree[2]}});
        QVERIFY(*stats::adjusted(std::vector<stats::Value>{0.04}, method).front() == 0.04);
        QVERIFY(stats::adjusted({}, method).empty());
    }
};

QTEST_GUILESS_MAIN(MultiplicityTest)
#include "multiplicity_test.moc"
