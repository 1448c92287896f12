// The name of a fibre corrects the friction that the networks read.
#include "rendering/models/told_fibre.h"

#include <QTest>
#include <cmath>
#include <vector>

#include "protocols/random.h"

using namespace rendering;
using namespace rendering::models;
using fabrics::Fibre;

namespace {

/// Fabrics whose friction is a line of what is read, with an error.
std::vector<DrawnReading> drawn(Fibre fibre, int count, double constant, double gain, double error)
{
    protocols::Random random(5);
    std::vector<DrawnReading> all;
    for (int i = 0; i < count; ++i) {
        const double read = random.uniform(0.1, 0.6);
        all.push_back({fibre, {std::log(read), 0.5}, std::log(constant + gain * read) + error * random.normal()});
    }
    return all;
}

}  // namespace

class ToldFibreTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void theLineOfEachFibreIsFound()
    {
        std::vector<DrawnReading> all = drawn(Fibre::Wool, 60, 0.15, 0.8, 0);
        for (const DrawnReading& one : drawn(Fibre::Silk, 60, -0.02, 0.9, 0)) all.push_back(one);
        const FibreReadings readings = fibreReadings(all);
        const FibreReading wool = readings[std::size_t(Fibre::Wool)].value(), silk = readings[std::size_t(Fibre::Silk)].value();
        QVERIFY(std::abs(wool.constant - 0.15) < 1e-9 && std::abs(wool.gain - 0.8) < 1e-9);
        QVERIFY(std::abs(silk.constant + 0.02) < 1e-9 && std::abs(silk.gain - 0.9) < 1e-9);
        const ReadFriction told = withToldFibre({std::log(0.3), 0.5}, readings, Fibre::Wool);
        QVERIFY(std::abs(std::exp(told.logMean) - 0.39) < 1e-9);
    }

    void intervalsHoldNineOfTenNewFabrics()
    {
        const FibreReadings readings = fibreReadings(drawn(Fibre::Cotton, 2000, 0.1, 0.7, 0.12));
        int held = 0;
        const std::vector<DrawnReading> fresh = drawn(Fibre::Cotton, 1000, 0.1, 0.7, 0.12);
        for (const DrawnReading& one : fresh) {
            const ReadFriction told = withToldFibre(one.read, readings, Fibre::Cotton);
            held += std::abs(told.logMean - one.logFriction) <= told.halfWidth ? 1 : 0;
        }
        QVERIFY2(held > 860 && held < 940, qPrintable(QString::number(held)));
        QVERIFY(readings[std::size_t(Fibre::Cotton)]->narrowing < 0.5);  // 1.645 x 0.12 over 0.5.
    }

    void unknownFibresChangeNothing()
    {
        const FibreReadings readings = fibreReadings(drawn(Fibre::Jute, 39, 0.1, 0.7, 0));  // one too few
        const ReadFriction read{std::log(0.3), 0.5};
        for (const std::optional<Fibre> fibre :
             {std::optional(Fibre::Jute), std::optional(Fibre::Wool), std::optional<Fibre>()}) {
            const ReadFriction told = withToldFibre(read, readings, fibre);
            QCOMPARE(told.logMean, read.logMean);
            QCOMPARE(told.halfWidth, read.halfWidth);
        }
    }

    void aLabTrainsWhatTheToldFibreTurnsIntoItsFriction()
    {
        FibreReadings readings;
        readings[std::size_t(Fibre::Wool)] = FibreReading{0.18, 0.8, 0.6};
        const double read = logMeanToRead(std::log(0.4), readings, Fibre::Wool);
        QVERIFY(std::abs(withToldFibre({read, 0.5}, readings, Fibre::Wool).logMean - std::log(0.4)) < 1e-12);
        QCOMPARE(logMeanToRead(std::log(0.4), readings, std::nullopt), std::log(0.4));
        QCOMPARE(std::exp(logMeanToRead(std::log(0.1), readings, Fibre::Wool)), 0.025);  // No wool of the line is as smooth.
        QVERIFY(std::isnan(logMeanToRead(std::nan(""), readings, Fibre::Wool)));
    }

    void frictionStaysPositiveFarFromTheDrawnFabrics()
    {
        FibreReadings readings;
        readings[std::size_t(Fibre::Silk)] = FibreReading{-0.05, 1, 1};
        QVERIFY(std::isfinite(withToldFibre({std::log(0.01), 0.5}, readings, Fibre::Silk).logMean));
    }

    void namesAreReadAsTheyAreWritten()
    {
        for (std::size_t i = 0; i < fabrics::fibreCount; ++i)
            QVERIFY(fabrics::fibreFrom(nameOf(Fibre(i))) == Fibre(i) &&
                    fabrics::fibreNames().find(nameOf(Fibre(i))) != std::string::npos);
        QVERIFY(fabrics::fibreFrom("Cotton") == Fibre::Cotton && !fabrics::fibreFrom("cotton 100 %") && !fabrics::fibreFrom(""));
    }
};

QTEST_APPLESS_MAIN(ToldFibreTest)
#include "told_fibre_test.moc"
