// Tail probabilities, quantiles, d' and Bayes factors against 60 digits.
#include "stats/kernels/distributions.h"

#include <QTest>
#include <limits>
#include <numbers>

#include "stats/kernels/noncentral.h"
#include "stats/tests/bayes_factor.h"
#include "stats/tests/forced_choice.h"
#include "tests/stats/exact_numbers.h"

namespace {

using stats::TailProbability;

struct Expected {
    double p, logP;
};

}  // namespace

class DistributionsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // All numbers of this file: /usr/bin/python3 tests/stats/reference/distributions.py
    void tailsAsIn60Digits_data()
    {
        QTest::addColumn<TailProbability>("found");
        QTest::addColumn<Expected>("expected");
        QTest::newRow("t") << stats::studentUpper(2.5, 7) << Expected{0.020496109292876448, -3.8875202014416807};
        QTest::newRow("t, broken df") << stats::studentUpper(0.3, 2.25) << Expected{0.39483076888752266, -0.92929803908088425};
        QTest::newRow("t below 0") << stats::studentUpper(-1.75, 4) << Expected{0.92249189442891648, -0.080676689632976355};
        QTest::newRow("t below the smallest double")
            << stats::studentUpper(200, 300) << Expected{1.3678250608008527e-321, -738.81659291959713};
        QTest::newRow("t of 1e7") << stats::studentUpper(1e7, 9) << Expected{2.5458970371060805e-60, -137.22062252136768};
        QTest::newRow("both sides of t") << stats::studentTwoSided(-2.5, 7)
                                         << Expected{0.040992218585752897, -3.1943730208817354};
        QTest::newRow("both sides of a small t")
            << stats::studentTwoSided(-0.25, 7) << Expected{0.80976558584785182, -0.2110104733878053};
        QTest::newRow("F") << stats::fisherUpper(3.7, 2, 11) << Expected{0.059042092633061573, -2.8295046549911317};
        QTest::newRow("F, p near 1") << stats::fisherUpper(0.2, 3.5, 8.25)
                                     << Expected{0.91526688861612444, -0.088539574689731288};
        QTest::newRow("F below the smallest double") << stats::fisherUpper(5000, 40, 300) << Expected{0, -918.51937316645523};
        QTest::newRow("F = 0") << stats::fisherUpper(0, 2, 11) << Expected{1, 0};
        QTest::newRow("chi-squared") << stats::chiSquaredUpper(7.5, 3) << Expected{0.057558451972636407, -2.8549542914761807};
        QTest::newRow("chi-squared, p near 1")
            << stats::chiSquaredUpper(0.5, 5) << Expected{0.99212329323262959, -0.0079078918874270282};
        QTest::newRow("chi-squared below the smallest double")
            << stats::chiSquaredUpper(1500, 4) << Expected{1.4281654075697298e-323, -743.37859434823587};
        QTest::newRow("chi-squared = 0") << stats::chiSquaredUpper(0, 5) << Expected{1, 0};
        QTest::newRow("z") << stats::normalUpper(1.96) << Expected{0.024997895148220434, -3.6889636517296387};
        QTest::newRow("z below 0") << stats::normalUpper(-0.7) << Expected{0.75803634777692699, -0.27702394227713124};
        QTest::newRow("z below the smallest double") << stats::normalUpper(40) << Expected{0, -804.60844201375379};
        QTest::newRow("twice") << stats::twice({0.25, std::log(0.25)}) << Expected{0.5, std::log(0.5)};
        QTest::newRow("twice, at most 1") << stats::twice({0.75, std::log(0.75)}) << Expected{1, 0};
        QTest::newRow("complement") << stats::complementOf({0.25, 0}) << Expected{0.75, std::log(0.75)};
    }

    void tailsAsIn60Digits()
    {
        QFETCH(TailProbability, found);
        QFETCH(Expected, expected);
        // A denormal has few digits.
        compareNumbers({{"p", found.p, expected.p, expected.p < 1e-300 ? 1e-2 : 1e-12}, {"log p", found.logP, expected.logP}});
    }

    void quantilesAsIn60Digits()
    {
        compareNumbers({{"lower beta", stats::betaLower(3.5, 2, 0.4), 0.12547917755548129},
                        {"upper beta", stats::betaUpper(3.5, 2, 0.4), 0.87452082244451871},
                        {"beta quantile", stats::betaQuantile(3.5, 2, 0.3), 0.53870441406236204},
                        {"t quantile", stats::studentQuantile(0.025, 6.5), 2.4020020079102777},
                        {"z quantile", stats::normalQuantile(0.01), 2.3263478740408411},
                        {"F quantile", stats::fisherQuantile(0.05, 3, 14), 3.3438886781189135},
                        {"chi-squared quantile", stats::chiSquaredQuantile(0.1, 5), 9.2363568997811185},
                        {"Hedges 2", stats::hedgesCorrection(2), 0.56418958354775629},
                        {"Hedges 5", stats::hedgesCorrection(5), 0.8407486824596893},
                        {"Hedges 40", stats::hedgesCorrection(40), 0.98111219443669506}});
    }

    void noncentralTailsAsTheirIntegrals()
    {
        compareNumbers({{"t", stats::noncentralStudentUpper(2.262157, 9, 3), 0.76115530749580001},
                        {"t, negative", stats::noncentralStudentUpper(2.1, 5, -0.7), 0.010504454852077356, 1e-10},
                        {"F", stats::noncentralFisherUpper(2, 8, 72, 10), 0.56319172881961351},
                        {"F, small", stats::noncentralFisherUpper(4.5, 3, 11, 3.25), 0.14242455090073772},
                        {"F, central", stats::noncentralFisherUpper(3.7, 2, 11, 0), 0.059042092633061573},
                        {"chi-squared", stats::noncentralChiSquaredUpper(15.507, 8, 10), 0.58775176467243334},
                        {"chi-squared, small", stats::noncentralChiSquaredUpper(4, 3, 2.5), 0.56853850081303683},
                        {"chi-squared, central", stats::noncentralChiSquaredUpper(7.5, 3, 0), 0.057558451972636407}});
    }

    // exp(ln 4.2 - 400 ln 10) and others; a mantissa that rounds up to 10 is written as 1.
    void decimalsOfLogarithms()
    {
        using std::numbers::ln10;
        QCOMPARE(stats::decimalOfLogarithm(std::log(4.2) - 400 * ln10).substr(0, 10), std::string("4.20000000"));
        QVERIFY(stats::decimalOfLogarithm(std::log(4.2) - 400 * ln10).ends_with("e-400"));
        QCOMPARE(stats::decimalOfLogarithm(std::log(4.2)), std::string("4.2000000000e+0"));
        QCOMPARE(stats::decimalOfLogarithm(std::log(9.99999999999)), std::string("1.0000000000e+1"));
        QVERIFY(stats::exponential(std::numeric_limits<double>::infinity()).exists());
        compareNumbers({{"e^-2", stats::exponential(-2), std::exp(-2.0)}});
    }

    void sensitivityAsItsIntegral_data()
    {
        QTest::addColumn<int>("correct");
        QTest::addColumn<int>("alternatives");
        QTest::addColumn<Expected>("expected");  // d' and its standard error
        QTest::newRow("27 of 70 among 3") << 27 << 3 << Expected{0.18087343679681839, 0.19637495032363041};
        QTest::newRow("50 of 70 among 4") << 50 << 4 << Expected{1.5455094585675106, 0.19985741276441651};
        QTest::newRow("69 of 70 among 2") << 69 << 2 << Expected{3.0962081170375517, 0.55236218739220246};
        QTest::newRow("24 of 70 among 3") << 24 << 3 << Expected{0.033580551724586708, 0.19899415152621633};
    }

    void sensitivityAsItsIntegral()
    {
        QFETCH(int, correct);
        QFETCH(int, alternatives);
        QFETCH(Expected, expected);
        const auto found = stats::forcedChoice(correct, 70, alternatives);
        const double chance = 1.0 / alternatives;
        compareNumbers({{"d'", found.dPrime, expected.p},
                        {"standard error", found.seDPrime, expected.logP},
                        {"proportion", found.proportionCorrect, correct / 70.0},
                        {"discriminators", found.discriminators, (correct / 70.0 - chance) / (1 - chance)},
                        {"d' of the proportion", stats::dPrimeAt(correct / 70.0, alternatives), expected.p},
                        {"d' of 0.59…", stats::dPrimeAt(0.59090283056806994, 5), 1.3}});
    }

    void bayesFactorsAsTheirIntegral()
    {
        compareNumbers({{"t 2.03", stats::jzsBayesFactor(2.03, 80).bf10, 0.86118512527380087},
                        {"t -1.5", stats::jzsBayesFactor(-1.5, 24, 1).bf10, 0.44401656850563034},
                        {"t 8", stats::jzsBayesFactor(8, 30, std::numbers::sqrt2).bf10, 1.9607775456442562e+6},
                        {"t 0, two values", stats::jzsBayesFactor(0, 2, 0.3).bf10, 0.73459933456765514},
                        {"narrow prior", stats::jzsBayesFactor(0.4, 12, 0.05).bf10, 0.88535228693016733},
                        {"logarithm", stats::jzsBayesFactor(2.03, 80).logBf10, std::log(0.86118512527380087), 1e-11}});
        compareReasons({{"one value", stats::jzsBayesFactor(2, 1).bf10, "at least 2 values"},
                        {"no t", stats::jzsBayesFactor(std::nan(""), 5).logBf10, "finite"},
                        {"no width", stats::jzsBayesFactor(2, 5, 0).bf10, "width"}});
    }

    void largeNoncentralitiesAsTheirApproximations()
    {
        compareNumbers({{"chi-squared", stats::noncentralChiSquaredUpper(10000, 8, 10001), 0.51529143961316789, 1e-11},
                        {"F", stats::noncentralFisherUpper(1200, 8, 72, 10001), 0.61960148227264044, 1e-11},
                        {"t", stats::noncentralStudentUpper(3100, 9, 3001), 0.50896444031362158, 1e-11},
                        {"t below 0", stats::noncentralStudentUpper(-3100, 9, -3001), 1 - 0.50896444031362158, 1e-11},
                        {"t of the other sign", stats::noncentralStudentUpper(-3100, 9, 3001), 1, 0},
                        {"t of the other sign", stats::noncentralStudentUpper(3100, 9, -3001), 0, 0}});
    }
};

QTEST_GUILESS_MAIN(DistributionsTest)
#include "distributions_test.moc"
