// Drawn fabrics: equal arguments give equal pictures on any thread, windows of one fabric agree, a photograph and its height lie
// on each other, and friction follows its stated law with a spread that nobody can see.
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>
#include <thread>

#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/drawn/drawn_dataset.h"
#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/drawn/drawn_friction.h"
#include "rendering/fabrics/drawn/drawn_patch.h"
#include "rendering/fabrics/drawn/jpeg_loss.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering::fabrics;
using protocols::Random;

namespace {

bool sameBits(const DrawnPatch& a, const DrawnPatch& b)
{
    return cv::norm(a.rgb, b.rgb, cv::NORM_INF) == 0 && cv::norm(a.heightMm, b.heightMm, cv::NORM_INF) == 0 &&
           a.mmPerPixel == b.mmPerPixel && a.meanFriction == b.meanFriction;
}

cv::Mat grey(const cv::Mat& rgb)
{
    cv::Mat result;
    cv::cvtColor(rgb, result, cv::COLOR_RGB2GRAY);
    result.convertTo(result, CV_32F);
    return result;
}

cv::Mat withoutSlowChange(const cv::Mat& map)
{
    cv::Mat slow;
    cv::GaussianBlur(map, slow, {}, 8);
    return map - slow;
}

double correlation(cv::Mat a, cv::Mat b)
{
    a = a - cv::mean(a)[0];
    b = b - cv::mean(b)[0];
    return a.dot(b) / std::sqrt(a.dot(a) * b.dot(b));
}

/// The first construction of a kind, with the index at which it was drawn.
DrawnFabric firstOf(ClothKind kind, std::uint64_t seed = 1)
{
    for (std::uint64_t index = 0;; ++index) {
        DrawnFabric fabric = drawFabric(seed, index);
        if (fabric.kind == kind) return fabric;
    }
}

/// Share of the power of a height map at the waves of `periodPx` along `degrees`, within 8 % and 8 degrees.
double powerShareAt(const cv::Mat& heightMm, double periodPx, double degrees)
{
    cv::Mat map = withoutSlowChange(heightMm), window, spectrum;
    cv::createHanningWindow(window, map.size(), CV_32F);
    cv::dft(map.mul(window), spectrum, cv::DFT_COMPLEX_OUTPUT);
    double near = 0, all = 0;
    for (int y = 0; y < map.rows; ++y)
        for (int x = 0; x < map.cols; ++x) {
            const double fx = (x <= map.cols / 2 ? x : x - map.cols) / double(map.cols);
            const double fy = (y <= map.rows / 2 ? y : y - map.rows) / double(map.rows);
            const auto& wave = spectrum.at<cv::Vec2f>(y, x);
            const double power = double(wave[0]) * double(wave[0]) + double(wave[1]) * double(wave[1]);
            all += power;
            const double angle = std::remainder(std::atan2(fy, fx) * 180 / CV_PI - degrees, 180);
            if (std::abs(std::hypot(fx, fy) * periodPx - 1) < 0.08 && std::abs(angle) < 8) near += power;
        }
    return near / all;
}

/// A round hill of 1 mm in the middle of a plain white sheet.
cv::Mat roundHill(int pixels)
{
    cv::Mat_<float> hill(pixels, pixels);
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x) {
            const double dx = x - pixels / 2, dy = y - pixels / 2;
            hill(y, x) = float(std::exp(-(dx * dx + dy * dy) / (2 * 12.0 * 12.0)));
        }
    return hill;
}

ClothCamera plainCamera()
{
    ClothCamera camera;
    ClothLamp lamp;
    lamp.distance = 30;
    camera.lamps = {lamp};
    camera.photonNoise = camera.readNoise = 0;
    return camera;
}

}  // namespace

class DrawnFabricsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void samePatchOnAnyThreadAndAnotherForAnotherNumber()
    {
        std::vector<DrawnPatch> alone(6), together(6);
        for (std::size_t i = 0; i < alone.size(); ++i) alone[i] = drawPatch(3, i, {48, 0.5});
        std::thread first([&] {
            for (std::size_t i = 0; i < 3; ++i) together[i] = drawPatch(3, i, {48, 0.5});
        });
        std::thread second([&] {
            for (std::size_t i = 3; i < 6; ++i) together[i] = drawPatch(3, i, {48, 0.5});
        });
        first.join();
        second.join();
        for (std::size_t i = 0; i < alone.size(); ++i) {
            QVERIFY(sameBits(alone[i], together[i]));
            QCOMPARE(alone[i].rgb.size(), cv::Size(48, 48));
            QVERIFY(cv::checkRange(alone[i].heightMm));
            for (std::size_t j = 0; j < i; ++j) QVERIFY(!sameBits(alone[i], alone[j]));
        }
        QVERIFY(!sameBits(alone[0], drawPatch(4, 0, {48, 0.5})));
    }

    void everyKindIsDrawnAndEveryFabricHasItsOwnWords()
    {
        std::set<ClothKind> kinds;
        std::set<std::string> words;
        std::set<Fibre> fibres;
        for (std::uint64_t index = 0; index < 400; ++index) {
            const DrawnFabric fabric = drawFabric(1, index);
            kinds.insert(fabric.kind);
            fibres.insert(fabric.fibre);
            words.insert(inWords(fabric));
            for (const DrawnYarns& yarns : {fabric.warp, fabric.weft}) QVERIFY(yarns.spacingMm >= 0.15 && yarns.spacingMm <= 3);
        }
        QCOMPARE(kinds.size(), std::size_t(9));
        QCOMPARE(fibres.size(), std::size_t(8));
        QVERIFY2(words.size() > 380, qPrintable(QString::number(words.size())));
    }

    void noDraftHasALongFloatOrAnUnboundYarn()
    {
        Random random(17);
        std::set<std::string> names;
        for (int i = 0; i < 500; ++i) {
            const NamedDraft drawn = drawDraft(random);
            names.insert(drawn.name);
            for (const bool ofWarp : {true, false})
                for (const FloatPlace& place : floatPlaces(drawn.draft, ofWarp)) QVERIFY2(place.length <= 12, drawn.name.c_str());
        }
        QVERIFY2(names.size() > 60, qPrintable(QString::number(names.size())));
        const Draft twill{4, 4, {1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 1}};
        for (const FloatPlace& place : floatPlaces(twill, true)) QCOMPARE(place.length, 2.f);
        const Draft unbound{2, 2, {1, 0, 1, 1}};
        QVERIFY(floatPlaces(unbound, true).front().length > 12);
    }

    void windowsOfOneFabricAgreeWhereTheyOverlap()
    {
        for (const ClothKind kind :
             {ClothKind::Weave, ClothKind::Jersey, ClothKind::Terry, ClothKind::Corduroy, ClothKind::Fleece}) {
            const DrawnFabric fabric = firstOf(kind);
            const double pitch = threadPeriod(fabric).mm / 10;
            DrawnFabric straight = fabric;
            straight.slack.skewDegrees = 0;  // A window is skewed around its own middle.
            const cv::Mat left = clothWindow(straight, {100, 200, 0}, {96, 96}, pitch, SlackShown::No).heightMm;
            const cv::Mat right = clothWindow(straight, {100 + 32 * pitch, 200, 0}, {96, 96}, pitch, SlackShown::No).heightMm;
            const cv::Mat a = left(cv::Rect(32, 0, 64, 96)), b = right(cv::Rect(0, 0, 64, 96));
            QVERIFY2(correlation(a.clone(), b.clone()) > 0.98,
                     qPrintable(QString("%1: %2").arg(nameOf(kind).c_str()).arg(correlation(a.clone(), b.clone()))));
        }
    }

    void heightHasThePeriodAndDirectionOfItsThreads()
    {
        for (const ClothKind kind : {ClothKind::Jersey, ClothKind::Corduroy}) {
            const DrawnFabric fabric = firstOf(kind);
            const ThreadPeriod period = threadPeriod(fabric);
            const double pitch = period.mm / 8, turned = 25;
            const cv::Mat height = clothWindow(fabric, {10, 20, turned}, {192, 192}, pitch, SlackShown::No).heightMm;
            const double there = powerShareAt(height, 8, period.degrees - turned);
            const double elsewhere = powerShareAt(height, 8 * 1.31, period.degrees - turned + 40);
            QVERIFY2(there > 0.01 && there > 5 * elsewhere,
                     qPrintable(QString("%1: %2 against %3").arg(nameOf(kind).c_str()).arg(there).arg(elsewhere)));
        }
    }

    void theSideTowardsTheLampIsBrighter()
    {
        const cv::Mat hill = roundHill(96);
        const cv::Mat white(hill.size(), CV_32FC3, cv::Scalar::all(0.7));
        ClothCamera camera = plainCamera();
        camera.lamps.front().elevationDegrees = 35;
        for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
            camera.lamps.front().azimuthDegrees = azimuth;
            Random random(1);
            const cv::Mat picture = grey(photographWindow(windowOf(hill, white), 0.1, 8, camera, random).rgb);
            const double dx = 12 * std::cos(azimuth * CV_PI / 180), dy = 12 * std::sin(azimuth * CV_PI / 180);
            const auto at = [&](double side) {
                return picture.at<float>(40 + int(std::lround(side * dy)), 40 + int(std::lround(side * dx)));
            };
            QVERIFY2(at(1) > at(-1) + 20, qPrintable(QString("%1: %2 and %3").arg(azimuth).arg(at(1)).arg(at(-1))));
        }
    }

    void aLowLampCastsAShadowBehindTheHill()
    {
        const cv::Mat hill = 1.5 * roundHill(128);
        const cv::Mat white(hill.size(), CV_32FC3, cv::Scalar::all(0.7));
        ClothCamera camera = plainCamera();
        camera.ambient = 0.05;
        camera.lamps.front().azimuthDegrees = 0;
        camera.lamps.front().softness = 0;
        const auto behind = [&](double elevation) {
            camera.lamps.front().elevationDegrees = elevation;
            Random random(1);
            const cv::Mat picture = grey(photographWindow(windowOf(hill, white), 0.05, 8, camera, random).rgb);
            return picture.at<float>(56, 20) / picture.at<float>(4, 56);  // Flat ground behind the hill, and beside it.
        };
        QVERIFY2(behind(12) < 0.75 * behind(70), qPrintable(QString("%1 %2").arg(behind(12)).arg(behind(70))));
    }

    void coloursOfScansFollowTheHeightToAVaryingDegree()
    {
        // Nine published scans have 0.02 to 0.82.
        std::vector<double> found;
        for (std::uint64_t index = 0; index < 40; ++index) {
            const DrawnPatch patch = drawPatch(8, index, {96, 1.0});
            QVERIFY(patch.isFlat);
            found.push_back(correlation(withoutSlowChange(grey(patch.rgb)), withoutSlowChange(patch.heightMm)));
        }
        std::sort(found.begin(), found.end());
        QVERIFY2(found[4] < 0.4 && found[20] > 0.2 && found[35] > 0.6,
                 qPrintable(QString("%1 %2 %3").arg(found[4]).arg(found[20]).arg(found[35])));
    }

    void aConstantMissesTheFrictionOfDrawnFabrics()
    {
        std::vector<double> friction;
        for (std::uint64_t index = 0; index < 40; ++index) friction.push_back(meanFriction(drawFabric(2, index)));
        double best = 1e9;
        for (double constant = 0.05; constant < 1; constant += 0.005) {
            double error = 0;
            for (const double mu : friction) error += std::abs(constant / mu - 1) / 40;
            best = std::min(best, error);
        }
        QVERIFY2(best >= 0.30, qPrintable(QString::number(best)));
    }

    void frictionFollowsReliefHairLoadAndFinish()
    {
        DrawnFabric fabric = firstOf(ClothKind::Jersey);
        const double usual = meanFriction(fabric);
        QVERIFY(std::abs(meanFriction(fabric, 5) / usual - std::pow(3, 0.08)) < 1e-9);
        DrawnFabric other = fabric;
        other.looseness *= 1.5;
        QVERIFY(meanFriction(other) > 1.01 * usual);
        other = fabric;
        other.hairiness += 0.5;
        QVERIFY(std::abs(meanFriction(other) - usual - 0.10 * fabric.unseen) < 1e-9);
        other = fabric;
        other.unseen *= 1.1;
        QVERIFY(std::abs(meanFriction(other) / usual - 1.1) < 1e-9);
        double squares = 0;
        for (std::uint64_t index = 0; index < 1000; ++index) squares += std::pow(std::log(drawFabric(5, index).unseen), 2) / 1000;
        QVERIFY2(std::abs(std::sqrt(squares) - unseenFrictionSpread) < 0.006, qPrintable(QString::number(std::sqrt(squares))));
        QVERIFY(frictionLaw().find("6 %") != std::string::npos);
    }

    void jpegLosesMoreAtLowerQuality()
    {
        cv::Mat picture(77, 77, CV_8UC3);  // No multiple of 16.
        cv::RNG numbers(5);
        numbers.fill(picture, cv::RNG::UNIFORM, 20, 235);
        cv::GaussianBlur(picture, picture, {}, 1);
        double last = 0;
        for (const int quality : {98, 80, 40, 10}) {
            const cv::Mat after = afterJpeg(picture, quality);
            QCOMPARE(after.size(), picture.size());
            const double loss = cv::norm(after, picture, cv::NORM_L1) / double(picture.total() * 3);
            QVERIFY2(loss > last, qPrintable(QString("%1: %2").arg(quality).arg(loss)));
            last = loss;
        }
        const cv::Mat even(32, 32, CV_8UC3, cv::Scalar(90, 120, 60));
        QVERIFY(cv::norm(afterJpeg(even, 90), even, cv::NORM_INF) <= 3);
    }

    void dataSetHoldsSurfacesWordsAndScalesAndTheSameBytesForAnyThreads()
    {
        QTemporaryDir folder;
        DrawnOptions options{3, 2, 7, Pairing::Weak, 1};
        makeDrawnFabrics(pathOf(folder) / "one", options);
        options.threads = 2;
        makeDrawnFabrics(pathOf(folder) / "two", options);
        QVERIFY(contentOf(pathOf(folder) / "one") == contentOf(pathOf(folder) / "two"));
        QCOMPARE(faultsOfDataset(pathOf(folder) / "one"), std::vector<std::string>{});
        const Dataset dataset = readDataset(pathOf(folder) / "one");
        QVERIFY(dataset.surfaceIsFree);
        const PhotographViews views(dataset);
        for (std::size_t i = 0; i < 3; ++i) {
            QCOMPARE(dataset.fabrics[i].structure, inWords(drawFabric(7, i)));
            for (const int index : {0, 1}) {
                QCOMPARE(readSurface(dataset, dataset.fabrics[i].id, index)->size(),
                         readPhotograph(dataset, dataset.fabrics[i].id, index).size());
                QVERIFY(views.mmPerPixel(dataset.fabrics[i].id, index) >= 0.008);
            }
            const auto record = readFriction(dataset, dataset.fabrics[i].id, 0);
            double mean = 0;
            for (const double mu : record.values) mean += mu / double(record.values.size());
            QVERIFY(std::abs(mean / meanFriction(drawFabric(7, i)) - 1) < 0.15);
        }
    }

    void surfaceIsTheHeightOfTheSameWindow()
    {
        QTemporaryDir folder;
        const Dataset dataset = makeDrawnFabrics(pathOf(folder) / "set", {1, 1, 7, Pairing::Aligned, 1});
        for (const SamplePlace& place : readSamplePlaces(dataset)) {
            QCOMPARE(place.group, std::string("F01/place/0"));
            if (place.modality != Modality::Visual) continue;
            QVERIFY(place.light.ends_with("lamp") || place.light.ends_with("lamps"));
            const cv::Mat stored = *readSurface(dataset, place.fabric, 0);
            const cv::Mat again = clothWindow(drawFabric(7, 0), {*place.xMm, *place.yMm, *place.rotationDeg},
                                              {drawnPhotographPx, drawnPhotographPx}, *place.mmPerPixel)
                                      .heightMm;
            QVERIFY(correlation(stored.clone(), again) > 0.9);
        }
    }

    void impossibleNumbersAndFullFoldersAreRefused()
    {
        QTemporaryDir folder;
        for (const int fabrics : {0, -1, 10001, 1000000})
            QVERIFY(refusalOf([&] {
                        makeDrawnFabrics(pathOf(folder) / "new", {fabrics, 1, 1, Pairing::Weak, 1});
                    }).find("expected 1 to 10000") != std::string::npos);
        QVERIFY(refusalOf([&] {
                    makeDrawnFabrics(pathOf(folder) / "new", {1, 0, 1, Pairing::Weak, 1});
                }).find("--samples") != std::string::npos);
        QVERIFY(!fs::exists(pathOf(folder) / "new"));
        write(pathOf(folder) / "full" / "file", "mine");
        QVERIFY(refusalOf([&] {
                    makeDrawnFabrics(pathOf(folder) / "full", {1, 1, 1, Pairing::Weak, 1});
                }).find("is not empty") != std::string::npos);
        QCOMPARE(read(pathOf(folder) / "full" / "file"), std::string("mine"));
    }
};

QTEST_GUILESS_MAIN(DrawnFabricsTest)
#include "drawn_fabrics_test.moc"
