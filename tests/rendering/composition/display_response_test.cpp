// The response of a display, against glasses whose law is known: a threshold, growth with the square of the voltage, saturation.
#include "rendering/response/display_response.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/files/sha256.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"
#include "rendering/composition/display_mapping.h"
#include "rendering/response/response_drawing.h"
#include "rendering/response/response_file.h"
#include "rendering/response/response_fit.h"
#include "rendering/response/response_table.h"
#include "tests/rendering/refusal.h"

using namespace rendering;

namespace {

/// 0.25 below level 40; then quadratic; 0.75 from level 210 on.
double glass(double level)
{
    const double driven = std::clamp((level - 40) / 170, 0.0, 1.0);
    return 0.25 + 0.5 * driven * driven;
}

/// A draw of the standard normal distribution (Box and Muller).
double normalFrom(protocols::Random& random)
{
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform()));
    return radius * std::cos(2 * std::numbers::pi * random.uniform());
}

struct Bench {
    int step = 15;             ///< between levels
    int sweeps = 3;            ///< each up and down
    double noise = 0.02;       ///< of one measurement
    double hysteresis = 0.01;  ///< added while the levels fall
};

/// What a laboratory measures on a glass.
std::vector<FrictionAtLevel> measured(const std::function<double(double)>& law, const Bench& bench, std::uint64_t seed = 1)
{
    auto random = protocols::Random::stream(seed, "glass");
    std::vector<FrictionAtLevel> all;
    const auto take = [&](int level, SweepDirection direction) {
        const double shift = direction == SweepDirection::Down ? bench.hysteresis : 0;
        all.push_back({level, std::max(0.0, law(level) + shift + bench.noise * normalFrom(random)), direction});
    };
    for (int sweep = 0; sweep < bench.sweeps; ++sweep) {
        for (int level = 0; level <= 255; level += bench.step) take(level, SweepDirection::Up);
        for (int level = 255 / bench.step * bench.step; level >= 0; level -= bench.step) take(level, SweepDirection::Down);
    }
    return all;
}

DisplayResponse fitted(const std::vector<FrictionAtLevel>& measurements)
{
    DisplayResponse response = fitResponse(measurements, "table.csv");
    response.setting = {"Our display", "index finger, dry", "2026-05-04", 0.5, 20};
    response.source = "table.csv";
    response.sourceSha256 = protocols::sha256("table");
    return response;
}

DisplayResponse whole(const DisplayResponse& response) { return responseFromJson(responseJson(response), "response.json"); }

ScaledMap ramp()
{
    cv::Mat values(8, 1000, CV_32FC1);
    for (int i = 0; i < values.rows; ++i)
        for (int j = 0; j < values.cols; ++j) values.at<float>(i, j) = static_cast<float>(j);
    return {values};
}

MapRange rangeOf(const ScaledMap& map)
{
    MapRange range;
    range.include(map);
    return range;
}

/// RMS error of the friction on the glass against friction that is linear in the map, in percent of the glass's range.
double errorPercent(const std::function<double(double)>& law, const cv::Mat& levels, const ScaledMap& map)
{
    const double low = law(0), high = law(255);
    double squares = 0;
    for (int j = 0; j < levels.cols; ++j) {
        const double wanted = static_cast<double>(map.values.at<float>(0, j)) / (map.values.cols - 1);
        const double got = (law(levels.at<std::uint8_t>(0, j)) - low) / (high - low);
        squares += (got - wanted) * (got - wanted);
    }
    return 100 * std::sqrt(squares / levels.cols);
}

double errorThrough(const std::function<double(double)>& law, const DisplayResponse& response)
{
    const ScaledMap map = ramp();
    DisplayMapping mapping;
    mapping.response = std::make_shared<DisplayResponse>(response);
    return errorPercent(law, mapToDisplay(map, rangeOf(map), mapping), map);
}

double errorWithout(const std::function<double(double)>& law)
{
    const ScaledMap map = ramp();
    return errorPercent(law, mapToDisplay(map, rangeOf(map)), map);
}

QString refusalOfTable(const QByteArray& text, const std::map<std::string, std::string>& columns = {},
                       std::optional<double> loadN = 0.5)
{
    const QTemporaryDir folder;
    const std::string file = folder.filePath("table.csv").toStdString();
    protocols::writeWholeFile(file, text.toStdString());
    return refusalOf([&] { fitResponse(readResponseTable(file, columns, loadN).measurements, file); });
}

QByteArray rows(const QList<QPair<QByteArray, QByteArray>>& cells, const QByteArray& head = "level,mu")
{
    QByteArray text = head + "\n";
    for (const auto& [level, friction] : cells) text += level + "," + friction + "\n";
    return text;
}

/// The friction of all 256 levels, where only the last differs, by one unit of rounding.
QString flatFriction()
{
    QStringList values(255, "0.5");
    return "[" + (values << "0.5000000000000001").join(',') + "]";
}

}  // namespace

class DisplayResponseTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void aKnownGlassIsLinearised_data()
    {
        QTest::addColumn<int>("step");
        QTest::addColumn<int>("sweeps");
        QTest::addColumn<double>("noise");
        QTest::addColumn<double>("hysteresis");
        QTest::addColumn<double>("mostPercent");
        QTest::newRow("every level, no noise") << 1 << 1 << 0.0 << 0.0 << 0.4;
        QTest::newRow("18 levels, no noise") << 15 << 1 << 0.0 << 0.0 << 1.0;
        QTest::newRow("18 levels, 3 sweeps, noise 4 %") << 15 << 3 << 0.02 << 0.01 << 3.0;
        QTest::newRow("18 levels, 1 sweep, noise 4 %") << 15 << 1 << 0.02 << 0.01 << 5.0;
        QTest::newRow("6 levels, no noise") << 51 << 1 << 0.0 << 0.0 << 5.0;
    }
    void aKnownGlassIsLinearised()
    {
        QFETCH(int, step);
        QFETCH(int, sweeps);
        QFETCH(double, noise);
        QFETCH(double, hysteresis);
        QFETCH(double, mostPercent);
        double sum = 0, worst = 0;
        constexpr int seeds = 20;
        for (int seed = 1; seed <= seeds; ++seed) {
            const double error =
                errorThrough(glass, fitted(measured(glass, {step, sweeps, noise, hysteresis}, static_cast<std::uint64_t>(seed))));
            sum += error;
            worst = std::max(worst, error);
        }
        qInfo("%s: friction misses a linear ramp by %.2f %% of its range (worst of %d: %.2f %%); without the response %.2f %%",
              QTest::currentDataTag(), sum / seeds, seeds, worst, errorWithout(glass));
        QVERIFY2(worst < mostPercent, qPrintable(QString::number(worst)));
        QVERIFY(errorWithout(glass) > 15);
    }

    void thresholdAndSaturationAreFound()
    {
        const auto response = fitted(measured(glass, {5, 4, 0.002, 0}));
        // Friction rises by 2 % of its range at 40 + 170 * sqrt(0.02) = 64 and lacks as much at 40 + 170 * sqrt(0.98) = 208.
        QVERIFY2(std::abs(response.deadUpTo - 64) <= 2, qPrintable(QString::number(response.deadUpTo)));
        QVERIFY2(std::abs(response.saturatedFrom - 208) <= 2, qPrintable(QString::number(response.saturatedFrom)));
        QVERIFY(std::abs(*response.noise - 0.002) < 0.0005);
    }

    void hysteresisIsMeasured()
    {
        const auto response = fitted(measured(glass, {15, 6, 0.002, 0.08}));
        QVERIFY2(std::abs(*response.hysteresis - 0.08) < 0.003, qPrintable(QString::number(*response.hysteresis)));
        const auto remarks = remarksOn(response);
        QVERIFY(std::any_of(remarks.begin(), remarks.end(),
                            [](const auto& one) { return one.find("hysteresis") != std::string::npos; }));
    }

    void intervalsHoldTheTruth()
    {
        int held = 0, all = 0;
        for (std::uint64_t seed = 1; seed <= 40; ++seed)
            for (const auto& level : fitted(measured(glass, {15, 2, 0.02, 0}, seed)).measured) {
                held += std::abs(level.mean - glass(level.level)) <= *level.halfWidth ? 1 : 0;
                ++all;
            }
        const double share = static_cast<double>(held) / all;
        QVERIFY2(share > 0.92 && share < 0.98, qPrintable(QString::number(share)));
    }

    /// A step has no level between its ends: the image says so.
    void aStepIsOutOfReach()
    {
        const auto step = [](double level) { return level < 128 ? 0.3 : 0.6; };
        const auto response = fitted(measured(step, {1, 2, 0.001, 0}));
        const ScaledMap map = ramp();
        const double share = shareOutOfReach(map, rangeOf(map), response);
        QVERIFY2(share > 0.9 && share <= 1, qPrintable(QString::number(share)));
        QCOMPARE(shareOutOfReach(map, rangeOf(map), fitted(measured(glass, {1, 1, 0, 0}))), 0.0);
        const auto coarse = remarksOn(fitted(measured(step, {15, 2, 0.001, 0})));
        QVERIFY(std::any_of(coarse.begin(), coarse.end(),
                            [](const auto& one) { return one.find("measure levels between") != std::string::npos; }));
    }

    void onlyMeasuredLevelsAreUsed()
    {
        auto measurements = measured(glass, {15, 2, 0, 0});
        std::erase_if(measurements, [](const auto& one) { return one.level < 30 || one.level > 195; });
        DisplayMapping mapping;
        mapping.response = std::make_shared<DisplayResponse>(fitted(measurements));
        for (const bool dither : {false, true}) {
            mapping.dither = dither;
            const ScaledMap map = ramp();
            double least = 0, most = 0;
            cv::minMaxLoc(mapToDisplay(map, rangeOf(map), mapping), &least, &most);
            QVERIFY(least >= 30 && most <= 195);
            QVERIFY(most >= 194);
        }
    }

    /// What is felt of a mapped image is what was wanted.
    void theMappedImageFeelsLinear()
    {
        const auto response = fitted(measured(glass, {1, 1, 0, 0}));
        DisplayMapping mapping;
        mapping.response = std::make_shared<DisplayResponse>(response);
        const ScaledMap map = ramp();
        const cv::Mat felt = frictionOnDisplay(mapToDisplay(map, rangeOf(map), mapping), response);
        for (int j = 0; j < felt.cols; ++j)
            QVERIFY(std::abs(felt.at<std::uint16_t>(0, j) - 65535.0 * j / (felt.cols - 1)) < 0.01 * 65535);
    }

    /// Dithering gives the wanted friction on average also where levels are coarse.
    void ditheringKeepsTheMean()
    {
        const auto linear = [](double level) { return 0.2 + 0.001 * level; };
        DisplayMapping mapping{.dither = true};
        mapping.response = std::make_shared<DisplayResponse>(fitted(measured(linear, {15, 1, 0, 0})));
        cv::Mat values(200, 200, CV_32FC1, cv::Scalar(0.3012));
        MapRange range;
        range.include(0, 1);
        const double mean = cv::mean(mapToDisplay({values}, range, mapping))[0];
        QVERIFY2(std::abs(mean - 0.3012 * 255) < 0.02, qPrintable(QString::number(mean)));
    }

    /// Between a plateau and the next level, dithering once gave the plateau alone: 0 of the range instead of 0.25.
    void ditheringKeepsTheMeanBesideAPlateau_data()
    {
        QTest::addColumn<double>("plateauFrom");
        QTest::addColumn<double>("share");
        for (const double share : {0.02, 0.251, 0.313, 0.332, 0.7})
            QTest::newRow(qPrintable(QString("the lowest levels, %1").arg(share))) << 0.0 << share;
        for (const double share : {0.1, 0.251, 0.4, 0.7})
            QTest::newRow(qPrintable(QString("levels within, %1").arg(share))) << 20.0 << share;
    }
    void ditheringKeepsTheMeanBesideAPlateau()
    {
        QFETCH(double, plateauFrom);
        QFETCH(double, share);
        const auto glassWithPlateau = [&](double level) {
            return level <= 40 ? 0.2 + 0.001 * std::min(level, plateauFrom) : 0.3 + 0.2 * (level - 41) / 214;
        };
        const DisplayResponse response = fitted(measured(glassWithPlateau, {1, 1, 0, 0}));
        DisplayMapping mapping{.dither = true};
        mapping.response = std::make_shared<DisplayResponse>(response);
        MapRange range;
        range.include(0, 1);
        const cv::Mat levels = mapToDisplay({cv::Mat(200, 200, CV_32FC1, cv::Scalar(share))}, range, mapping);
        const double felt = cv::mean(frictionOnDisplay(levels, response))[0] / 65535;
        QVERIFY2(std::abs(felt - share) < 0.005, qPrintable(QString::number(felt)));
    }

    void withoutAResponseNothingChanges()
    {
        const ScaledMap map = ramp();
        cv::Mat expected(map.values.size(), CV_8UC1);
        for (int i = 0; i < expected.rows; ++i)
            for (int j = 0; j < expected.cols; ++j)
                expected.at<std::uint8_t>(i, j) = static_cast<std::uint8_t>(j / 999.0 * 255 + 0.5);
        QCOMPARE(cv::norm(mapToDisplay(map, rangeOf(map)), expected, cv::NORM_INF), 0.0);
    }

    void theFileGivesTheSameResponse()
    {
        for (const Bench& bench : {Bench{15, 3, 0.02, 0.01}, Bench{1, 1, 0, 0}}) {
            const auto response = fitted(measured(glass, bench));
            auto read = whole(response);
            QVERIFY(!read.sha256.empty());
            read.sha256.clear();
            QVERIFY(read == response);
        }
    }

    void alteredFilesAreRefused_data()
    {
        QTest::addColumn<QString>("from");
        QTest::addColumn<QString>("to");
        QTest::addColumn<QString>("told");
        QTest::newRow("load") << "\"load_n\": 0.5"
                              << "\"load_n\": 5.0"
                              << "was altered";
        QTest::newRow("schema") << "display-response/1"
                                << "display-response/9"
                                << "no response of a display";
        QTest::newRow("cut") << "\"friction\""
                             << "\"fric"
                             << "line ";
        QTest::newRow("no hash") << "\"sha256\""
                                 << "\"sha\""
                                 << "no \"sha256\"";
    }
    void alteredFilesAreRefused()
    {
        QFETCH(QString, from);
        QFETCH(QString, to);
        QFETCH(QString, told);
        QString text = QString::fromStdString(responseJson(fitted(measured(glass, {}))));
        QVERIFY(text.contains(from));
        text.replace(from, to);
        const QString fault = refusalOf([&] { responseFromJson(text.toStdString(), "response.json"); });
        QVERIFY2(fault.contains(told) && fault.contains("response.json"), qPrintable(fault));
    }

    /// Somebody may compute the hash again: the curve is still checked.
    void wrongCurvesWithTheRightHashAreRefused_data()
    {
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("value");
        QTest::newRow("falls") << "/friction/3"
                               << "0.9";
        QTest::newRow("flat but for rounding") << "/friction" << flatFriction();
        QTest::newRow("no number") << "/friction/3"
                                   << "\"x\"";
        QTest::newRow("negative") << "/friction/0"
                                  << "-1";
        QTest::newRow("one too many") << "/friction/-"
                                      << "0.9";
        QTest::newRow("level 300") << "/measured/2/level"
                                   << "300";
        QTest::newRow("levels in disorder") << "/measured/2/level"
                                            << "0";
        QTest::newRow("no load") << "/load_n"
                                 << "0";
        QTest::newRow("finger of two lines") << "/finger"
                                             << "\"a\\nb\"";
        QTest::newRow("list as object") << "/measured"
                                        << "{}";
    }
    void wrongCurvesWithTheRightHashAreRefused()
    {
        QFETCH(QString, pointer);
        QFETCH(QString, value);
        auto json = nlohmann::ordered_json::parse(responseJson(fitted(measured(glass, {}))));
        json[nlohmann::ordered_json::json_pointer(pointer.toStdString())] = nlohmann::ordered_json::parse(value.toStdString());
        json.erase("sha256");
        json["sha256"] = protocols::sha256(json.dump());
        const QString fault = refusalOf([&] { responseFromJson(json.dump(), "response.json"); });
        QVERIFY2(fault.contains("response.json") && fault.contains("display calibrate"), qPrintable(fault));
    }

    /// Bytes changed at random, with a hash that fits again: a response or a refusal, and a response keeps its promises.
    void damagedFilesAreRefusedOrSound()
    {
        auto json = nlohmann::ordered_json::parse(responseJson(fitted(measured(glass, {51, 1, 0, 0}))));
        json.erase("sha256");
        const std::string sound = json.dump();
        auto random = protocols::Random::stream(1, "damage");
        int read = 0, refused = 0;
        for (int i = 0; i < 3000; ++i) {
            std::string text = sound;
            for (int changes = 1 + static_cast<int>(random.below(3)); changes > 0; --changes)
                text[random.below(text.size())] = "0123456789-.eE,:\"[]{}nulx"[random.below(25)];
            auto damaged = nlohmann::ordered_json::parse(text, nullptr, false);
            if (damaged.is_object()) {
                damaged["sha256"] = protocols::sha256(damaged.dump());
                text = damaged.dump();
            }
            const QString fault = refusalOf([&] {
                const auto response = responseFromJson(text, "response.json");
                const LevelsOfFriction levels(response);
                for (const double share : {0.0, 0.3, 1.0})
                    QVERIFY(levels.nearest(share) >= response.lowestLevel() && levels.nearest(share) <= response.highestLevel());
                ++read;
            });
            refused += fault.isEmpty() ? 0 : 1;
        }
        QCOMPARE(read + refused, 3000);
        QVERIFY2(read > 100 && refused > 100, qPrintable(QString("%1 read").arg(read)));
    }

    void tablesOfOtherLabsAreRead()
    {
        const QTemporaryDir folder;
        const std::string file = folder.filePath("messung.csv").toStdString();
        protocols::writeWholeFile(
            file,
            "Lauf;Grauwert;Reibkraft;Normalkraft\n1;0;0,10;0,50\n1;64;0,15;0,50\n1;128;0,20;0,50\n1;192;0,25;0,50\n"
            "1;255;0,30;0,50\n2;255;0,31;0,50\n2;192;0,26;0,50\n2;128;0,21;0,50\n2;64;0,16;0,50\n2;0;0,11;0,50\n");
        const auto table = readResponseTable(
            file, {{"level", "Grauwert"}, {"force", "Reibkraft"}, {"load", "Normalkraft"}, {"sweep", "Lauf"}}, {});
        QCOMPARE(table.loadN, 0.5);
        QVERIFY(table.taken.find("semicolons") != std::string::npos);
        const auto response = fitResponse(table.measurements, file);
        QVERIFY(std::abs(response.friction.front() - 0.21) < 1e-12);  // (0.10 + 0.11) / 2 / 0.5
        QVERIFY(std::abs(*response.hysteresis - 0.02) < 1e-12);
        QVERIFY(*response.measured.front().up < *response.measured.front().down);
    }

    void badTablesAreOneClearLine_data()
    {
        QTest::addColumn<QByteArray>("table");
        QTest::addColumn<QString>("told");
        const QList<QPair<QByteArray, QByteArray>> good{
            {"0", "0.2"}, {"64", "0.3"}, {"128", "0.4"}, {"192", "0.5"}, {"255", "0.6"}};
        const auto with = [&](int row, const QByteArray& level, const QByteArray& friction) {
            auto changed = good;
            changed[row] = {level, friction};
            return rows(changed);
        };
        QTest::newRow("two levels") << rows({{"0", "0.2"}, {"255", "0.6"}}) << "2 grey levels were measured";
        QTest::newRow("no rows") << QByteArray("level,mu\n") << "0 grey levels were measured";
        QTest::newRow("level 256") << with(4, "256", "0.6") << "row 5 (line 6), column level";
        QTest::newRow("level -1") << with(0, "-1", "0.2") << "a whole number from 0 to 255";
        QTest::newRow("level 12.5") << with(1, "12.5", "0.2") << "a whole number from 0 to 255";
        QTest::newRow("negative friction") << with(2, "128", "-0.4") << "friction that is not negative";
        QTest::newRow("friction in millinewtons") << with(2, "128", "400") << "--map force=COLUMN";
        QTest::newRow("empty cell") << with(2, "128", "") << "row 3 (line 4)";
        QTest::newRow("falls") << with(4, "255", "0.3") << "friction falls from 0.5000 at level 192 to 0.3000 at level 255";
        QTest::newRow("flat") << rows({{"0", "0.3"}, {"64", "0.3"}, {"128", "0.3"}, {"192", "0.3"}, {"255", "0.3"}})
                              << "friction does not change";
        const QList<QPair<QByteArray, QByteArray>> rounded{
            {"0", "0.5"}, {"64", "0.5"}, {"128", "0.5"}, {"192", "0.5"}, {"255", "0.5000000000000001"}};
        QTest::newRow("changes by rounding, measured twice") << rows(rounded + rounded) << "a millionth of the mean friction";
        QTest::newRow("no level") << rows(good, "volt,mu") << "no column of grey levels";
        QTest::newRow("no friction") << rows(good, "level,volt") << "no column of friction";
    }
    void badTablesAreOneClearLine()
    {
        QFETCH(QByteArray, table);
        QFETCH(QString, told);
        const QString fault = refusalOfTable(table);
        QVERIFY2(fault.contains(told) && fault.contains("table.csv") && !fault.contains('\n'), qPrintable(fault));
    }

    void theLoadIsStatedOnce()
    {
        const QByteArray table = rows({{"0", "0.2"}, {"64", "0.3"}, {"128", "0.4"}, {"192", "0.5"}, {"255", "0.6"}});
        QVERIFY(refusalOfTable(table, {}, {}).contains("the load of the finger is not stated"));
        QVERIFY(refusalOfTable(table, {{"load", "mu"}}, 0.5).contains("stated twice"));
        QVERIFY(refusalOfTable(table, {{"weight", "mu"}}).contains("is no meaning of a column"));
        QVERIFY(refusalOfTable(table, {{"level", "grau"}}).contains("no column \"grau\""));
    }

    /// Noise alone must not refuse a sound glass, and a glass that falls must be refused through noise.
    void noiseIsNoFault()
    {
        int refused = 0;
        for (std::uint64_t seed = 1; seed <= 200; ++seed)
            refused += refusalOf([&] { fitted(measured(glass, {15, 2, 0.05, 0}, seed)); }).isEmpty() ? 0 : 1;
        QVERIFY2(refused <= 2, qPrintable(QString::number(refused)));
        const auto falling = [](double level) { return glass(level) - (level > 220 ? 0.3 : 0); };
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            QVERIFY(refusalOf([&] { fitted(measured(falling, {15, 2, 0.02, 0}, seed)); }).contains("friction falls"));
        const auto flat = [](double) { return 0.4; };
        int taken = 0;
        for (std::uint64_t seed = 1; seed <= 200; ++seed)
            taken += refusalOf([&] { fitted(measured(flat, {15, 2, 0.05, 0}, seed)); }).isEmpty() ? 1 : 0;
        QVERIFY2(taken <= 4, qPrintable(QString::number(taken)));
    }

    void thePictureShowsTheSetting()
    {
        const std::string svg = responseDrawing(fitted(measured(glass, {15, 3, 0.02, 0.02})));
        for (const char* text : {"Response of Our display", "0.5 N, 20 mm/s, index finger, dry", "levels falling", "grey level"})
            QVERIFY2(svg.find(text) != std::string::npos, text);
        if (const QString folder = qEnvironmentVariable("VIS2HAP_SCREENSHOTS"); !folder.isEmpty())
            protocols::writeWholeFile((folder + "/response.svg").toStdString(), svg);
    }
};

QTEST_GUILESS_MAIN(DisplayResponseTest)
#include "display_response_test.moc"
