// The procedural data set. One seed gives the same bytes for any number of threads, and the fabrics differ. The simulated
// sensor and rig follow the models in their headers.
#include "rendering/fabrics/procedural/procedural_fabrics.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <set>

#include "rendering/fabrics/dataset_check.h"
#include "rendering/fabrics/procedural/lattice_noise.h"
#include "rendering/fabrics/procedural/photograph.h"
#include "rendering/fabrics/procedural/stroke_rig.h"
#include "rendering/fabrics/procedural/structures.h"
#include "rendering/fabrics/procedural/tactile_press.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering;
using namespace rendering::fabrics;
using protocols::Random;

namespace {

double meanCoefficient(const ForceRecord& record)
{
    double sum = 0;
    for (std::size_t i = 0; i < record.timeS.size(); ++i) sum += record.tangentialN[i] / record.normalN[i];
    return sum / double(record.timeS.size());
}

/// Smooth bump whose steepest slope is about 0.5.
cv::Mat smoothBump()
{
    cv::Mat_<float> height(tactileHeightPx, tactileWidthPx);
    for (int y = 0; y < height.rows; ++y)
        for (int x = 0; x < height.cols; ++x) {
            const float dx = (float(x) - 150) * 0.05f, dy = (float(y) - 110) * 0.05f;
            height(y, x) = 1.2f * std::exp(-(dx * dx + dy * dy) / (2 * 1.5f * 1.5f));
        }
    return height;
}

struct GradientErrors {
    double rmsX, rmsY, biasX, biasY;
};

/// Differences between the gradients of the linear calibration and the central differences of the height.
GradientErrors gradientErrors(const cv::Mat& frame, const cv::Mat& reference, const cv::Mat& height,
                              const nlohmann::json& calibration)
{
    const auto& map = calibration.at("gradient_from_rgb");
    const double pitch = calibration.at("mm_per_pixel");
    double sums[4] = {};
    int count = 0;
    for (int y = 2; y < height.rows - 2; ++y)
        for (int x = 2; x < height.cols - 2; ++x) {
            double slopes[2] = {calibration.at("offset")[0], calibration.at("offset")[1]};
            for (int axis = 0; axis < 2; ++axis)
                for (int c = 0; c < 3; ++c)
                    slopes[axis] += map[std::size_t(axis)][std::size_t(c)].get<double>() *
                                    (double(frame.at<cv::Vec3b>(y, x)[c]) - double(reference.at<cv::Vec3b>(y, x)[c])) / 255;
            const double ex = slopes[0] - (height.at<float>(y, x + 1) - height.at<float>(y, x - 1)) / (2 * pitch);
            const double ey = slopes[1] - (height.at<float>(y + 1, x) - height.at<float>(y - 1, x)) / (2 * pitch);
            sums[0] += ex * ex, sums[1] += ey * ey, sums[2] += ex, sums[3] += ey;
            ++count;
        }
    return {std::sqrt(sums[0] / count), std::sqrt(sums[1] / count), sums[2] / count, sums[3] / count};
}

}  // namespace

class ProceduralFabricsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void sameSeedGivesTheSameBytesWithOneThreadAndWithTwo()
    {
        QTemporaryDir folder;
        ProceduralOptions options{3, 3, 42, Pairing::Weak, 1};
        makeProceduralFabrics(pathOf(folder) / "one", options);
        options.threads = 2;
        makeProceduralFabrics(pathOf(folder) / "two", options);
        makeProceduralFabrics(pathOf(folder) / "again", options);
        const auto one = contentOf(pathOf(folder) / "one");
        QCOMPARE(one.size(), std::size_t(3 * 3 * 4 + 4));
        QVERIFY(contentOf(pathOf(folder) / "two") == one);
        QVERIFY(contentOf(pathOf(folder) / "again") == one);
        QCOMPARE(hashOf(readDataset(pathOf(folder) / "one")), hashOf(readDataset(pathOf(folder) / "two")));
        options.seed = 43;
        makeProceduralFabrics(pathOf(folder) / "other", options);
        const auto other = contentOf(pathOf(folder) / "other");
        for (const char* sample : {"F01/visual/000.png", "F02/tactile/001.png", "F03/friction/002.csv"})
            QVERIFY(other.at(sample) != one.at(sample));
        QVERIFY(faultsOfDataset(pathOf(folder) / "one").empty());
    }

    void integersOfTheLatticeAreFrozen()
    {
        // python3: the same mixing with whole numbers modulo 2^64.
        QCOMPARE(hashAt(42, -3, 7), 0x6770884265c6a646ull);
    }

    void weakSamplesLieApartAndAlignedOnesTogether()
    {
        QTemporaryDir folder;
        const auto placesWith = [&](Pairing pairing, const char* name) {
            makeProceduralFabrics(pathOf(folder) / name, {1, 2, 5, pairing, 2});
            return readSamplePlaces(readDataset(pathOf(folder) / name));
        };
        std::set<std::string> groups;
        std::set<double> places;
        for (const SamplePlace& place : placesWith(Pairing::Weak, "weak")) {
            groups.insert(place.group);
            places.insert(place.xMm.value());
        }
        QCOMPARE(groups.size(), std::size_t(6));
        QCOMPARE(places.size(), std::size_t(6));
        std::map<std::string, std::set<std::tuple<double, double, double>>> placesOfGroup;
        for (const SamplePlace& place : placesWith(Pairing::Aligned, "aligned"))
            placesOfGroup[place.group].insert({place.xMm.value(), place.yMm.value(), place.rotationDeg.value()});
        QCOMPARE(placesOfGroup.size(), std::size_t(2));
        for (const auto& [group, where] : placesOfGroup) QCOMPARE(where.size(), std::size_t(1));
        QVERIFY(readDataset(pathOf(folder) / "aligned").pairing == Pairing::Aligned);
    }

    void alignedPressesShowThePhotographedPlace()
    {
        // Press and photograph share their middle, so both samplings give the same relief there.
        const FabricSurface surface(allStructures()[6], 11);
        const FabricPlace place{12.5, 80.25, 31};
        const cv::Mat press = surface.sample(place, {tactileWidthPx, tactileHeightPx}, tactileMmPerPixel).heightMm;
        const cv::Mat photo = surface.sample(place, {photographSizePx, photographSizePx}, photographMmPerPixel).heightMm;
        QCOMPARE(cv::norm(press(cv::Rect(60, 20, 200, 200)), photo(cv::Rect(28, 28, 200, 200)), cv::NORM_INF), 0.0);
    }

    void fifteenFabricsDifferInFrictionAndReliefAsTheTableSays()
    {
        QCOMPARE(allStructures().size(), std::size_t(15));
        const FrictionRecording recording;
        std::vector<double> means;
        std::set<std::string_view> names;
        for (const Structure& structure : allStructures()) {
            names.insert(structure.name);
            const FabricSurface surface(structure, 3);
            const double mean = meanFriction(surface, recording);
            double sum = 0, squares = 0;
            constexpr int strokes = 6;
            for (int i = 0; i < strokes; ++i) {
                Random random = Random::stream(9, std::string(structure.name) + std::to_string(i));
                const double measured = meanCoefficient(strokeFabric(surface, mean, {100.0 * i, 50, 0}, recording, random));
                sum += measured / strokes;
                squares += measured * measured / strokes;
            }
            QVERIFY2(std::abs(sum / mean - 1) < 0.06, qPrintable(QString("%1 %2").arg(sum).arg(mean)));
            QVERIFY2(std::sqrt(std::max(0.0, squares - sum * sum)) / mean < 0.09, structure.name.data());
            means.push_back(sum);
        }
        QCOMPARE(names.size(), std::size_t(15));
        const auto [low, high] = std::minmax_element(means.begin(), means.end());
        QVERIFY2(*low > 0.1 && *low < 0.16, qPrintable(QString::number(*low)));
        QVERIFY2(*high > 0.45 && *high < 0.65, qPrintable(QString::number(*high)));
        // Silk satin slides easily, corduroy does not; a sateen is smoother than a canvas.
        QVERIFY(means[5] < means[4] && means[4] < means[11] && means[11] < means[10]);
    }

    void frictionFollowsFibreReliefAndSpeed()
    {
        Structure cloth = allStructures()[11];
        const double before = meanFriction(FabricSurface(cloth, 3), {});
        FrictionRecording fast;
        fast.speedMmPerS = 50;
        QVERIFY(meanFriction(FabricSurface(cloth, 3), fast) > 1.1 * before);
        cloth.fibreFriction += 0.1;
        QVERIFY(std::abs(meanFriction(FabricSurface(cloth, 3), {}) - before - 0.1) < 1e-9);
        cloth.fibreFriction -= 0.1;
        cloth.warp.flatness = cloth.weft.flatness = 0.2;
        QVERIFY(meanFriction(FabricSurface(cloth, 3), {}) < 0.9 * before);
    }

    void aStrokeIsRecordedAsStated()
    {
        QTemporaryDir folder;
        const Dataset dataset = makeProceduralFabrics(pathOf(folder) / "set", {1, 1, 8, Pairing::Weak, 1});
        QVERIFY(read(pathOf(folder) / "set/F01/friction/000.csv").starts_with("t_s,normal_n,tangential_n\n0.000000,"));
        const FrictionRecord record = readFriction(dataset, FabricId("F01"), 0);
        QCOMPARE(record.values.size(), std::size_t(480));
        QVERIFY(std::abs(record.sampleRateHz - 60) < 1e-3);
        QCOMPARE(record.speedMmPerS, 5.0);
        Random random(1);
        const ForceRecord forces = strokeFabric(FabricSurface(allStructures()[0], 1), 0.25, {}, {}, random);
        const double load = std::accumulate(forces.normalN.begin(), forces.normalN.end(), 0.0) / 480;
        QVERIFY2(std::abs(load - 15) < 0.4, qPrintable(QString::number(load)));
    }

    void theCalibrationInvertsTheSensor()
    {
        const cv::Mat height = smoothBump();
        Random random(4);
        const cv::Mat frame = tactileFrame(height, random);
        const auto calibration = nlohmann::json::parse(tactileCalibrationJson());
        const GradientErrors errors = gradientErrors(frame, tactileReference(), height, calibration);
        // One step of 8 bits is 1/255 / 0.33 = 0.012 in slope. Noise and rounding stay below it, a bias far below.
        QVERIFY2(errors.rmsX < 0.012 && errors.rmsY < 0.012, qPrintable(QString("%1 %2").arg(errors.rmsX).arg(errors.rmsY)));
        QVERIFY2(std::abs(errors.biasX) < 5e-4 && std::abs(errors.biasY) < 5e-4, qPrintable(QString::number(errors.biasX)));
    }

    void pressedFabricsAreMeasuredWithinTheSensorsRange()
    {
        for (const int fabric : {0, 3, 5, 11, 13}) {
            Random random = Random::stream(2, std::to_string(fabric));
            const Press press = pressSensor(FabricSurface(allStructures()[std::size_t(fabric)], 2), {40, 40, 2}, random);
            double low = 0, high = 0;
            cv::minMaxLoc(press.heightMm, &low, &high);
            QVERIFY2(low == 0 && high > 0.03 && high < 0.8, qPrintable(QString("%1: %2").arg(fabric).arg(high)));
            const float packed = press.heightMm.at<float>(100, 100) * 8192;
            QCOMPARE(packed, std::round(packed));
            const auto calibration = nlohmann::json::parse(tactileCalibrationJson());
            const GradientErrors errors = gradientErrors(press.frame, tactileReference(), press.heightMm, calibration);
            QVERIFY2(errors.rmsX < 0.06 && errors.rmsY < 0.06,
                     qPrintable(QString("%1: %2 %3").arg(fabric).arg(errors.rmsX).arg(errors.rmsY)));
        }
    }

    void photographsTurnWithTheCamera()
    {
        // The lamp moves with the camera, so only the relief can be compared: a turn of 90 degrees turns the picture.
        const FabricSurface surface(allStructures()[10], 6);
        const cv::Mat straight = surface.sample({30, 30, 0}, {101, 101}, 0.05).heightMm;
        const cv::Mat turned = surface.sample({30, 30, 90}, {101, 101}, 0.05).heightMm;
        cv::Mat back;
        cv::rotate(turned, back, cv::ROTATE_90_CLOCKWISE);
        QVERIFY(cv::norm(straight, back, cv::NORM_INF) < 0.02);
        QVERIFY(cv::norm(straight, turned, cv::NORM_INF) > 0.1);
    }

    void impossibleRequestsAreRefusedAndLeaveNothing()
    {
        QTemporaryDir folder;
        const fs::path target = pathOf(folder) / "set";
        QVERIFY(contains(refusalOf([&] { makeProceduralFabrics(target, {16, 1, 1, Pairing::Weak, 1}); }), "1 to 15"));
        QVERIFY(contains(refusalOf([&] { makeProceduralFabrics(target, {1, 0, 1, Pairing::Weak, 1}); }), "samples"));
        QVERIFY(fs::is_empty(pathOf(folder)));
        write(target / "mine.txt", "keep");
        QVERIFY(contains(refusalOf([&] { makeProceduralFabrics(target, {1, 1, 1, Pairing::Weak, 1}); }), target.string()));
        QCOMPARE(read(target / "mine.txt"), std::string("keep"));
        const auto refused = refusalOf(
            [&] {
                makeProceduralFabrics("/proc/no/such", {1, 1, 1, Pairing::Weak, 1});
            },
            protocols::ExitCode::Environment);
        QVERIFY2(contains(refused, "/proc") && !contains(refused, "wrong exit code"), refused.c_str());
    }

    void progressCountsEverySample()
    {
        QTemporaryDir folder;
        std::vector<int> steps;
        makeProceduralFabrics(pathOf(folder) / "set", {2, 1, 1, Pairing::Weak, 2}, [&](int done, int total) {
            QCOMPARE(total, 6);
            steps.push_back(done);
        });
        QCOMPARE(steps, (std::vector<int>{1, 2, 3, 4, 5, 6}));
    }
};

QTEST_GUILESS_MAIN(ProceduralFabricsTest)
#include "procedural_fabrics_test.moc"
