// Bits per second over participants against the formulas in R.
#include "stats/claims/information_rate.h"

#include <QTest>
#include <cmath>

using stats::ParticipantChoices;

namespace {

const std::vector<ParticipantChoices> six{{3, 7, 35.2, 7}, {5, 7, 28.4, 7}, {4, 7, 41.9, 7},
                                          {6, 7, 30.1, 7}, {2, 6, 22.8, 6}, {7, 7, 38.5, 7}};

bool isNear(const stats::Value& value, double expected)
{
    return value.exists() && std::fabs(*value - expected) <= 1e-12 * std::max(1.0, std::fabs(expected));
}

}  // namespace

class InformationRateTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // R: m <- 3; correct <- c(3, 5, 4, 6, 2, 7); choices <- c(7, 7, 7, 7, 6, 7); timed <- choices
    //    seconds <- c(35.2, 28.4, 41.9, 30.1, 22.8, 38.5)
    //    bits <- function(p) ifelse(p <= 1/m, 0, log2(m) + ifelse(p > 0, p * log2(p), 0) +
    //                                            ifelse(p < 1, (1 - p) * log2((1 - p) / (m - 1)), 0))
    //    ps <- t.test(correct / choices)$conf.int; ts <- t.test(seconds / timed)$conf.int
    //    a <- bits(sum(correct) / sum(choices)); b <- sum(seconds) / sum(timed); l <- bits(max(0, ps[1])); u <- bits(min(1,
    //    ps[2])) L <- (a * b - sqrt((a * b)^2 - l * ts[2] * (2 * a - l) * (2 * b - ts[2]))) / (ts[2] * (2 * b - ts[2])) U <- (a *
    //    b + sqrt((a * b)^2 - u * ts[1] * (2 * a - u) * (2 * b - ts[1]))) / (ts[1] * (2 * b - ts[1])) print(c(a / b, L, U),
    //    digits = 15)
    void intervalIsThatOfARatio()
    {
        const stats::InformationRate rate = stats::informationRate(six, 3);
        QVERIFY(isNear(rate.rate, 0.06606786088088412));
        QVERIFY(isNear(rate.ci95.low, 0.00164460266858203));
        QVERIFY(isNear(rate.ci95.high, 0.23435420912074009));
    }

    // R: rate <- function(k) bits(sum(correct[k]) / sum(choices[k])) / (sum(seconds[k]) / sum(timed[k]))
    //    print(sapply(1:6, function(i) 6 * rate(1:6) - 5 * rate((1:6)[-i])), digits = 15)
    void pseudoValuesAreThoseOfTheJackknife()
    {
        const std::vector<double> expected{-0.04185410212932544, 0.09842395933034404,  0.00896648088758428,
                                           0.14882411264154188,  -0.04197501809804915, 0.18628976539384423};
        const std::vector<stats::Value> values = stats::ratePseudoValues(six, 3);
        for (std::size_t i = 0; i < expected.size(); ++i) QVERIFY(isNear(values[i], expected[i]));
    }

    void constantParticipantsHaveNoInterval()
    {
        const std::vector<ParticipantChoices> allRight{{7, 7, 30, 7}, {7, 7, 35, 7}, {7, 7, 28, 7}};
        const stats::InformationRate rate = stats::informationRate(allRight, 3);
        QVERIFY(isNear(rate.rate, std::log2(3.0) / (93.0 / 21)));
        QVERIFY(!rate.ci95.low.exists() && rate.ci95.low.why().starts_with("share correct: "));
        const std::vector<ParticipantChoices> allWrong{{0, 7, 30, 7}, {0, 7, 35, 7}};
        QCOMPARE(*stats::informationRate(allWrong, 3).rate, 0.0);
        QVERIFY(!stats::informationRate(allWrong, 3).ci95.high.exists());
    }

    void belowChanceTheRateIsZeroAndTheIntervalBeginsThere()
    {
        const std::vector<ParticipantChoices> low{{2, 7, 30, 7}, {3, 7, 35, 7}, {1, 7, 28, 7}, {2, 7, 30, 7}};
        const stats::InformationRate rate = stats::informationRate(low, 3);
        QCOMPARE(*rate.rate, 0.0);
        QCOMPARE(*rate.ci95.low, 0.0);
        QVERIFY(*rate.ci95.high > 0);
    }

    void missingTimesHaveReasons()
    {
        const std::vector<ParticipantChoices> timeless{{3, 7, 0, 0}, {4, 7, 0, 0}};
        QCOMPARE(stats::informationRate(timeless, 3).rate.why(), std::string("there are no response times"));
        QCOMPARE(stats::informationRate({}, 3).rate.why(), std::string("there are no choices"));
        QCOMPARE(stats::ratePseudoValues(timeless, 3)[0].why(), std::string("there are no response times"));
        const std::vector<ParticipantChoices> one{{3, 7, 30, 7}, {4, 7, 0, 0}};
        QCOMPARE(stats::ratePseudoValues(one, 3)[0].why(), std::string("needs at least 2 participants"));
        QCOMPARE(stats::ratePseudoValues(one, 3)[1].why(), std::string("no timed choice"));
    }
};

QTEST_GUILESS_MAIN(InformationRateTest)
#include "information_rate_test.moc"
