// The univariate data sets of NIST's Statistical Reference Datasets: certified mean, standard deviation
// and lag-1 autocorrelation. NumAcc2 to 4 are made here from their published recipe; the others are read
// where the shared oracle is present.
#include <QtTest>

#include "stats/descriptive.h"
#include "tests/stats/oracle_cases.h"

namespace {

std::vector<double> numAcc(double first, double low, double high)
{
    std::vector<double> x{first};
    for (int i = 0; i < 500; ++i) {
        x.push_back(low);
        x.push_back(high);
    }
    return x;
}

/// The numbers of a .dat file: what follows its line "Data: Y" and is a number.
std::vector<double> readDat(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    std::vector<double> x;
    std::string line;
    bool isData = false;
    while (std::getline(stream, line)) {
        const QString text = QString::fromStdString(line).trimmed();
        bool isNumber = false;
        text.toDouble(&isNumber);
        if (isData && isNumber) x.push_back(oracle::number(text.toStdString()));
        isData = isData || text.startsWith("Data: Y");
    }
    return x;
}

}  // namespace

class NistTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // Certified values: https://www.itl.nist.gov/div898/strd/univ/homepage.html. A double cannot hold the
    // decimals of NumAcc3 and 4: digits are what is attainable, less 0.3.
    void recipesReachTheAttainableDigits_data()
    {
        QTest::addColumn<double>("first");
        QTest::addColumn<double>("low");
        QTest::addColumn<double>("high");
        QTest::addColumn<double>("mean");
        QTest::addColumn<double>("sdDigits");
        QTest::addColumn<double>("lagDigits");
        QTest::newRow("NumAcc2") << 1.2 << 1.1 << 1.3 << 1.2 << 14.7 << 14.7;
        QTest::newRow("NumAcc3") << 1000000.2 << 1000000.1 << 1000000.3 << 1000000.2 << 9.16 << 11.93;
        QTest::newRow("NumAcc4") << 10000000.2 << 10000000.1 << 10000000.3 << 10000000.2 << 7.95 << 10.73;
    }

    void recipesReachTheAttainableDigits()
    {
        QFETCH(double, first);
        QFETCH(double, low);
        QFETCH(double, high);
        QFETCH(double, mean);
        QFETCH(double, sdDigits);
        QFETCH(double, lagDigits);
        const auto description = stats::describe(numAcc(first, low, high));
        QCOMPARE(description.n, std::size_t{1001});
        QVERIFY(oracle::digits(*description.mean, mean) >= 14.7);
        QVERIFY(oracle::digits(*description.sd, 0.1) >= sdDigits);
        QVERIFY(oracle::digits(*description.autocorrelationLag1, -0.999) >= lagDigits);
    }

    void certifiedFilesReachTheAttainableDigits()
    {
        const auto folder = oracle::sharedFolder() / "oracle" / "nist";
        if (!std::filesystem::exists(folder / "certified.json"))
            QSKIP("the shared NIST files are not here: only the recipes were checked");
        std::ifstream stream(folder / "certified.json");
        const auto certified = oracle::Json::parse(stream);
        for (const auto& [name, set] : certified["univariate"].items()) {
            const auto x = readDat(folder / set["file"].get<std::string>());
            QCOMPARE(x.size(), set["n"].get<std::size_t>());
            const auto description = stats::describe(x);
            const std::map<std::string, stats::Value> answers{
                {"mean", description.mean}, {"sd", description.sd}, {"autocorr1", description.autocorrelationLag1}};
            for (const auto& [field, value] : answers) {
                const double reached = oracle::digits(*value, oracle::number(set["certified"][field]));
                const double attainable = set["ceiling_lre"][field].get<double>();
                QVERIFY2(reached >= attainable - 0.3,
                         qPrintable(QString("%1 %2: %3 of %4").arg(name.c_str(), field.c_str()).arg(reached).arg(attainable)));
            }
        }
    }
};

QTEST_GUILESS_MAIN(NistTest)
#include "nist_test.moc"
