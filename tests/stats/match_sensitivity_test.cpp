// Sensitivity of a same-different task: numbers of an independent program, freedom from the criterion, and coverage of intervals.
#include "stats/claims/match_sensitivity.h"

#include <QTest>
#include <cmath>

#include "stats/kernels/distributions.h"
#include "tests/stats/stream.h"

using stats::ClusteredIndex;
using stats::MatchAnswer;

namespace {

bool isNear(const stats::Value& value, double expected)
{
    return value.exists() && std::fabs(*value - expected) <= 1e-12 * std::max(1.0, std::fabs(expected));
}

bool isNear(const stats::Interval& interval, double low, double high)
{
    return isNear(interval.low, low) && isNear(interval.high, high);
}

std::vector<MatchAnswer> counted(std::size_t hits, std::size_t same, std::size_t falseAlarms, std::size_t different)
{
    std::vector<MatchAnswer> answers;
    for (std::size_t i = 0; i < same; ++i) answers.push_back({0, 0, true, i < hits});
    for (std::size_t i = 0; i < different; ++i) answers.push_back({0, 0, false, i < falseAlarms});
    return answers;
}

/// "s" and "d" are what each participant said of the fabrics in turn; half of the pairs were the same.
std::vector<MatchAnswer> sixParticipants()
{
    const std::vector<std::string> said{"sdsd", "sssd", "dsds", "sdsd", "sdss", "dssd"};
    std::vector<MatchAnswer> answers;
    for (std::size_t p = 0; p < said.size(); ++p)
        for (std::size_t f = 0; f < 4; ++f) answers.push_back({p, f, (p + f) % 2 == 0, said[p][f] == 's'});
    return answers;
}

double normal(Stream& stream) { return -stats::normalQuantile(std::max(1e-12, stream.next())); }

struct Spread {
    double criterion = 0, fabrics = 0;
};

/// Observers with these criteria and fabrics that differ from their renderings more or less.
std::vector<MatchAnswer> observed(Stream& stream, std::size_t participants, std::size_t fabrics, double dPrime, double criterion,
                                  const Spread& spread)
{
    std::vector<double> ease;
    for (std::size_t f = 0; f < fabrics; ++f) ease.push_back(dPrime + spread.fabrics * normal(stream));
    std::vector<MatchAnswer> answers;
    for (std::size_t p = 0; p < participants; ++p) {
        const double own = criterion + spread.criterion * normal(stream);
        for (std::size_t f = 0; f < fabrics; ++f) {
            const bool wasSame = (p + f) % 2 == 0;
            answers.push_back({p, f, wasSame, (wasSame ? 1 : -1) * ease[f] / 2 + normal(stream) > own});
        }
    }
    return answers;
}

bool holds(const stats::Interval& interval, double value) { return *interval.low <= value && value <= *interval.high; }

}  // namespace

class MatchSensitivityTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // python3 tests/stats/reference/match_sensitivity.py
    void indicesAreThoseOfTheStandardLibrary()
    {
        const auto result = stats::matchSensitivity(counted(40, 50, 15, 50));
        QVERIFY(isNear(result.dPrime.estimate, 1.33394675059833));
        QVERIFY(isNear(result.criterion.estimate, -0.153818713033214));
        QVERIFY(isNear(result.hitRate, 0.8));
        QVERIFY(isNear(result.falseAlarmRate, 0.3));
        QCOMPARE(result.counts, (stats::MatchCounts{40, 50, 15, 50}));
    }

    void intervalsAreThoseOfAJackknifeWrittenApart()
    {
        const auto result = stats::matchSensitivity(sixParticipants());
        QVERIFY(isNear(result.dPrime.estimate, -0.395725295814487));
        QVERIFY(isNear(result.dPrime.overParticipants, -2.46764686311004, 1.67619627148106));
        QVERIFY(isNear(result.dPrime.overBoth, -2.97005275054198, 2.178602158913));
        QVERIFY(isNear(result.criterion.overParticipants, -0.529580825236685, 0.133855529422198));
        QVERIFY(isNear(result.criterion.overBoth, -1.00034006792989, 0.604614772115405));
        QVERIFY(isNear(result.seDPrime, 0.49876447452826));
    }

    void sensitivityDoesNotDependOnTheTendencyToSaySame()
    {
        // The share correct falls from .69 to .59 between these criteria; d' stays.
        Stream stream(7);
        for (const double criterion : {0.0, -0.6, -1.2, 1.2}) {
            const auto result = stats::matchSensitivity(observed(stream, 4000, 10, 1, criterion, {}));
            QVERIFY2(std::fabs(*result.dPrime.estimate - 1) < 0.06, qPrintable(QString::number(*result.dPrime.estimate)));
            QVERIFY(std::fabs(*result.criterion.estimate - criterion) < 0.04);
        }
    }

    void intervalsHoldTheTruth_data()
    {
        QTest::addColumn<double>("dPrime");
        QTest::addColumn<double>("criterion");
        QTest::addColumn<double>("spreadOfCriteria");
        QTest::addColumn<double>("spreadOfFabrics");
        QTest::newRow("no sensitivity") << 0.0 << 0.0 << 0.0 << 0.0;
        QTest::newRow("no sensitivity, criteria differ") << 0.0 << -0.5 << 0.5 << 0.0;
        QTest::newRow("sensitivity, criteria differ") << 1.5 << -0.5 << 0.5 << 0.0;
        QTest::newRow("fabrics differ") << 1.0 << -0.3 << 0.3 << 0.5;
    }
    void intervalsHoldTheTruth()
    {
        QFETCH(double, dPrime);
        QFETCH(double, criterion);
        QFETCH(double, spreadOfCriteria);
        QFETCH(double, spreadOfFabrics);
        constexpr int studies = 2000;
        // Pooled answers show the d' of the mixture of criteria: rates of a normal mixture are those of one normal variable.
        const double pooled = dPrime / std::sqrt(1 + spreadOfCriteria * spreadOfCriteria + spreadOfFabrics * spreadOfFabrics / 4);
        Stream stream(20261125);
        int overParticipants = 0, overBoth = 0;
        for (int study = 0; study < studies; ++study) {
            const auto answers = observed(stream, 12, 12, dPrime, criterion, {spreadOfCriteria, spreadOfFabrics});
            const ClusteredIndex index = stats::matchSensitivity(answers).dPrime;
            overParticipants += holds(index.overParticipants, pooled) ? 1 : 0;
            overBoth += holds(index.overBoth, pooled) ? 1 : 0;
        }
        qInfo("of %d intervals over participants %d hold the true d', over both %d", studies, overParticipants, overBoth);
        if (spreadOfFabrics == 0) {
            QVERIFY(overParticipants > 0.93 * studies);
            QVERIFY(overParticipants < 0.98 * studies);
        }
        QVERIFY(overBoth > 0.93 * studies);
    }

    void extremeAnswersHaveFiniteIndices()
    {
        const auto perfect = stats::matchSensitivity(counted(50, 50, 0, 50));
        QVERIFY(*perfect.dPrime.estimate > 4 && std::isfinite(*perfect.dPrime.estimate));
        QVERIFY(!perfect.dPrime.overParticipants.low.exists());
        QCOMPARE(perfect.dPrime.overParticipants.low.why(), std::string("an interval needs two participants"));
        const auto always = stats::matchSensitivity(counted(50, 50, 50, 50));
        QVERIFY(std::fabs(*always.dPrime.estimate) < 1e-12);
        QVERIFY(*always.criterion.estimate < -2);
    }

    /// Six participants who say the same do not show that all others would: an interval without width is none.
    void equalRatesHaveNoInterval()
    {
        std::vector<MatchAnswer> answers;
        for (std::size_t p = 0; p < 6; ++p)
            for (std::size_t f = 0; f < 4; ++f) answers.push_back({p, f, f % 2 == 0, f != 1});
        const auto result = stats::matchSensitivity(answers);
        for (const ClusteredIndex& index : {result.dPrime, result.criterion}) {
            QVERIFY(index.estimate.exists());
            QVERIFY(!index.overParticipants.low.exists() && !index.overParticipants.high.exists());
            QVERIFY(QString::fromStdString(index.overParticipants.low.why()).startsWith("no variation"));
            QVERIFY(index.overBoth.low.exists());  // the fabrics differ
        }
    }

    void pairsOfOneKindAreRefused()
    {
        const auto none = stats::matchSensitivity({});
        QCOMPARE(none.why, std::string("no answer says \"same\" or \"different\""));
        QVERIFY(!none.dPrime.estimate.exists() && !none.dPrime.overBoth.high.exists() && !none.seDPrime.exists());
        QCOMPARE(stats::matchSensitivity(counted(3, 5, 0, 0)).why, std::string("no pair differed"));
        QCOMPARE(stats::matchSensitivity(counted(0, 0, 3, 5)).why, std::string("no pair was the same"));
    }
};

QTEST_APPLESS_MAIN(MatchSensitivityTest)
#include "match_sensitivity_test.moc"
