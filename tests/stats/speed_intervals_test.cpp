// Intervals of the speed-accuracy table: the median response time by its formula, and the measured coverage of all three.
#include <QTest>
#include <cmath>

#include "stats/claims/information_rate.h"
#include "stats/claims/median_time.h"
#include "stats/claims/speed_contrasts.h"
#include "stats/kernels/draws.h"
#include "stats/tests/speed_accuracy.h"
#include "stats/tests/t_tests.h"

namespace {

constexpr int studies = 4000, choicesOfACell = 7;

/// How the times of a person scatter around the person's own time.
enum class Times { LogNormal, Wald };

struct Population {
    int participants = 10;
    Times times = Times::LogNormal;
    double personSd = 0.3;  ///< of the log time, and of the log odds of a right choice
};

/// First passage of drift v at bound a, by steps of the formula of Michael, Schucany and Haas (1976).
double waldTime(double drift, double bound, stats::Draws& draws)
{
    const double mean = bound / drift, shape = bound * bound, z = draws.normal();
    const double y = mean * z * z;
    const double root = mean + mean * (y - std::sqrt(y * (4 * shape + y))) / (2 * shape);
    return draws.uniform() * (mean + root) <= mean ? root : mean * mean / root;
}

double timeOf(const Population& population, double person, stats::Draws& draws)
{
    if (population.times == Times::LogNormal) return 5 * std::exp(person + draws.normal(0.5));
    return 1 + waldTime(0.6 * std::exp(-person), 2.2, draws);
}

/// Median of the times of all persons together, from many draws.
double trueMedian(const Population& population)
{
    std::vector<double> times;
    stats::Draws draws(7, 0);
    for (int i = 0; i < 400'000; ++i) times.push_back(timeOf(population, draws.normal(population.personSd), draws));
    return *stats::responseTimes(times).median;
}

struct Coverage {
    int covered = 0, existing = 0;
    void count(const stats::Interval& interval, double truth)
    {
        if (!interval.low.exists()) return;
        ++existing;
        covered += *interval.low <= truth && truth <= *interval.high;
    }
    double share() const { return static_cast<double>(covered) / existing; }
};

}  // namespace

class SpeedIntervalsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // R: x <- list(c(2, 3, 7), c(4, 5), c(6)); m <- log(sapply(x, median))
    //    exp(log(median(unlist(x))) + c(-1, 1) * qt(0.975, 2) * sd(m) / sqrt(3))
    void medianHasTheIntervalOfTheLogarithms()
    {
        const std::vector<std::vector<double>> seconds{{2, 3, 7}, {4, 5}, {6}, {}};
        const stats::Interval interval = stats::medianTimeCi95(seconds);
        QVERIFY(std::fabs(*interval.low - 1.89459975810714) < 1e-12);
        QVERIFY(std::fabs(*interval.high - 10.68827329537478) < 1e-11);
    }

    /// Two conditions and three participants; of the second participant only the first choice of each is compared.
    void pairsAreScoredAmongAllCells()
    {
        const auto cell = [](std::vector<double> correct, std::vector<double> seconds) {
            return stats::speedCell(correct, seconds);
        };
        const stats::ConditionSpeedCells a{cell({1, 0}, {2, 3}), cell({1, 1}, {4, 20}), cell({0, 1}, {5, 6})},
            b{cell({1, 1}, {3, 3}), cell({0}, {4}), cell({0, 0}, {6, 7})};
        const std::vector<stats::ConditionSpeedCells> conditions{a, b};
        const auto scores = stats::scoresOf(conditions);
        const auto whole = stats::speedPair(conditions, scores, {0, 1}, a, b);
        for (std::size_t k = 0; k < 3; ++k) QCOMPARE(*whole.scoresOfA[k], *scores[0][k]);
        stats::ConditionSpeedCells some = a;
        some[1] = cell({1}, {4});
        const auto pair = stats::speedPair(conditions, scores, {0, 1}, some, b);
        const auto expected = stats::scoresOf(std::vector<stats::ConditionSpeedCells>{some, b});
        for (std::size_t k = 0; k < 3; ++k) {
            QCOMPARE(*pair.scoresOfA[k], *expected[0][k]);
            QCOMPARE(*pair.scoresOfB[k], *expected[1][k]);
        }
        const auto tests = stats::speedContrasts(std::vector{pair, whole}, 3);
        QVERIFY(*tests[0].logSeconds.test.estimate < *tests[1].logSeconds.test.estimate);
        const auto asBefore = stats::speedContrasts(conditions, scores, std::vector{stats::ContrastPair(0, 1)}, 3);
        QCOMPARE(*tests[1].score.test.p, *asBefore[0].score.test.p);
        QCOMPARE(*tests[1].bitsPerSecond.test.p, *asBefore[0].bitsPerSecond.test.p);
    }

    void medianWithoutIntervalHasAReason()
    {
        using Times = std::vector<std::vector<double>>;
        QCOMPARE(stats::medianTimeCi95(Times{}).low.why(), std::string("there are no response times"));
        QVERIFY(!stats::medianTimeCi95(Times{{3, 4}}).low.exists());
        QVERIFY(!stats::medianTimeCi95(Times{{3, 4}, {3, 4}}).low.exists());
        QCOMPARE(stats::medianTimeCi95(Times{{0, 0}, {3, 4}}).low.why(), std::string("a median response time is not positive"));
    }

    void medianIsCoveredAsPromised_data()
    {
        QTest::addColumn<int>("participants");
        QTest::addColumn<bool>("wald");
        for (const int participants : {5, 10, 20})
            for (const bool wald : {false, true})
                QTest::addRow("%d participants, %s", participants, wald ? "Wald" : "log-normal") << participants << wald;
    }
    void medianIsCoveredAsPromised()
    {
        QFETCH(int, participants);
        QFETCH(bool, wald);
        const Population population{participants, wald ? Times::Wald : Times::LogNormal};
        const double truth = trueMedian(population);
        Coverage coverage;
        for (int study = 0; study < studies; ++study) {
            stats::Draws draws(11, static_cast<std::uint64_t>(study));
            std::vector<std::vector<double>> seconds;
            for (int k = 0; k < participants; ++k) {
                const double person = draws.normal(population.personSd);
                auto& own = seconds.emplace_back();
                for (int i = 0; i < choicesOfACell; ++i) own.push_back(timeOf(population, person, draws));
            }
            coverage.count(stats::medianTimeCi95(seconds), truth);
        }
        qInfo("median: %.1f %% of %d", 100 * coverage.share(), coverage.existing);
        QCOMPARE(coverage.existing, studies);
        QVERIFY2(coverage.share() > 0.93 && coverage.share() < 0.965, qPrintable(QString::number(coverage.share())));
    }

    /// Three conditions of 50, 70 and 85 % correct. The score's truth is its mean over all studies, because its scale is each
    /// study's own; the rate's is that of the whole population. The score's interval is wider than it need be: it holds the
    /// differences between persons, which standardising within the study takes out of the mean.
    void bitsAndScoreAreCoveredAsPromised()
    {
        constexpr int participants = 10, conditions = 3;
        const std::array<double, conditions> logOdds{0, 0.85, 1.73};
        std::array<std::vector<stats::Interval>, conditions> rates, scores;
        std::array<double, conditions> meanScore{}, meanShare{}, meanTime{};
        for (int study = 0; study < studies; ++study) {
            stats::Draws draws(13, static_cast<std::uint64_t>(study));
            std::array<double, participants> ability{}, pace{};
            for (int k = 0; k < participants; ++k) {
                ability[static_cast<std::size_t>(k)] = draws.normal(0.5);
                pace[static_cast<std::size_t>(k)] = draws.normal(0.3);
            }
            std::vector<stats::ConditionSpeedCells> cells(conditions);
            for (std::size_t c = 0; c < conditions; ++c)
                for (std::size_t k = 0; k < participants; ++k) {
                    std::vector<double> correct, seconds;
                    const double share = 1 / (1 + std::exp(-logOdds[c] - ability[k] - draws.normal(0.3)));
                    for (int i = 0; i < choicesOfACell; ++i) {
                        correct.push_back(draws.happens(share) ? 1.0 : 0.0);
                        seconds.push_back(5 * std::exp(pace[k] + draws.normal(0.5)));
                        meanTime[c] += seconds.back();
                        meanShare[c] += correct.back();
                    }
                    cells[c].push_back(stats::speedCell(correct, seconds));
                }
            const auto found = stats::scoresOf(cells);
            for (std::size_t c = 0; c < conditions; ++c) {
                std::vector<double> own;
                std::vector<stats::ParticipantChoices> choices;
                for (std::size_t k = 0; k < participants; ++k) {
                    own.push_back(*found[c][k]);
                    choices.push_back(cells[c][k].choices);
                }
                const auto test = stats::oneSampleTTest(own);
                scores[c].push_back(test.ci);
                meanScore[c] += *test.estimate / studies;
                rates[c].push_back(stats::informationRate(choices, 3).ci95);
            }
        }
        constexpr double answers = static_cast<double>(studies) * participants * choicesOfACell;
        for (std::size_t c = 0; c < conditions; ++c) {
            Coverage rate, score;
            const double trueRate = *stats::bitsPerSecond(meanShare[c] / answers, 3, meanTime[c] / answers);
            for (int study = 0; study < studies; ++study) {
                rate.count(rates[c][static_cast<std::size_t>(study)], trueRate);
                score.count(scores[c][static_cast<std::size_t>(study)], meanScore[c]);
            }
            qInfo("bits per second: %.1f %%, balanced integration score: %.1f %%", 100 * rate.share(), 100 * score.share());
            QVERIFY2(rate.share() > 0.93 && rate.share() < 0.98, qPrintable(QString::number(rate.share())));
            QVERIFY2(score.share() > 0.93, qPrintable(QString::number(score.share())));
        }
    }
};

QTEST_GUILESS_MAIN(SpeedIntervalsTest)
#include "speed_intervals_test.moc"
