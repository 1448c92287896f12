// What the networks that see are told: textures, batches of cloth with known relief, and the losses of relief.
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "protocols/files/sha256.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_io.h"
#include "rendering/models/seeing/cloth_batches.h"
#include "rendering/models/seeing/friction_target.h"
#include "rendering/models/seeing/relief_losses.h"
#include "rendering/models/seeing/seeing_weights.h"
#include "rendering/models/seeing/seen_signals.h"
#include "rendering/models/seeing/seen_texture.h"
#include "rendering/models/seeing/shared_batch_norm.h"
#include "rendering/models/seeing/told_lamp.h"
#include "rendering/models/seeing/told_shading.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using namespace rendering::models;

namespace {

double number(const torch::Tensor& tensor) { return tensor.item<double>(); }

/// Map [1, 1, 128, 128] with one wave along the rows.
torch::Tensor wave(double periodPx, double amplitude)
{
    const torch::Tensor place = torch::arange(128).to(torch::kFloat).view({1, 1, 1, 128}).expand({1, 1, 128, 128});
    return amplitude * torch::sin(2 * std::numbers::pi / periodPx * place);
}

torch::Tensor photograph()
{
    torch::manual_seed(4);
    return 0.3 + 0.25 * torch::avg_pool2d(torch::randn({1, 3, 132, 132}), 5, 1);
}

/// A scan: a wave of 12 px and 0.1 mm, coloured evenly.
cv::Mat scannedHeight(int side)
{
    cv::Mat height(side, side, CV_32F);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) height.at<float>(y, x) = static_cast<float>(0.1 * std::sin(2 * std::numbers::pi * x / 12));
    return height;
}

struct FacingCounts {
    int told = 0, facing = 0;
};

/// Pictures whose lamp is told, and how many of them are brighter where the cloth faces it.
FacingCounts facingTheirLamp(const ClothBatch& batch)
{
    const auto pixels = static_cast<std::size_t>(batch.side * batch.side);
    FacingCounts counts;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.size); ++i) {
        if (batch.lamps[2 * i] == 0) continue;
        ++counts.told;
        const double angle = (112.5 + 22.5 * static_cast<double>(batch.lamps[2 * i + 1])) * std::numbers::pi / 180;
        const cv::Mat relief(batch.side, batch.side, CV_32F, const_cast<float*>(&batch.reliefs[pixels * i])),
            green(batch.side, batch.side, CV_32F, const_cast<float*>(&batch.photographs[3 * pixels * i + pixels]));
        cv::Mat right, down, light;
        cv::Sobel(relief, right, CV_32F, 1, 0);
        cv::Sobel(relief, down, CV_32F, 0, 1);
        // Cloth that faces the lamp falls towards it.
        cv::Mat facingLamp = down * std::sin(angle) - right * std::cos(angle);
        facingLamp -= cv::mean(facingLamp);
        cv::subtract(green, cv::mean(green), light);
        counts.facing += facingLamp.dot(light) > 0 ? 1 : 0;
    }
    return counts;
}

/// Slopes of cloth with bumps of several sizes, and its brightness under a lamp at the top with dye as strong as the shading.
struct BumpyCloth {
    cv::Mat height, contrast;
};

BumpyCloth bumpyCloth(int side)
{
    const auto bumps = [side](int seed) {
        cv::Mat noise(side, side, CV_32F), slow;
        cv::setRNGSeed(seed);
        cv::randn(noise, 0, 1);
        cv::GaussianBlur(noise, noise, {}, 2.5);
        cv::GaussianBlur(noise, slow, {}, 12);
        return cv::Mat(8 * (noise - slow));
    };
    BumpyCloth cloth{bumps(1), {}};
    cv::Sobel(cloth.height, cloth.contrast, CV_32F, 0, 1, 1, 0.5);
    cloth.contrast += 0.3 * bumps(2);
    return cloth;
}

/// The scan under a lamp at the lower right (315 degrees).
cv::Mat litFromLowerRight(const cv::Mat& height)
{
    cv::Mat right, lit;
    cv::Sobel(height, right, CV_32F, 1, 0);
    cv::Mat(128 - 100 * right).convertTo(right, CV_8U);  // It is bright where it falls to the right.
    cv::merge(std::vector<cv::Mat>{right, right, right}, lit);
    return lit;
}

fabrics::Dataset scans(const std::filesystem::path& folder)
{
    fabrics::Dataset dataset;
    dataset.folder = folder;
    dataset.name = "two scans";
    dataset.surfaceIsFree = true;
    std::vector<fabrics::SamplePlace> places;
    for (const char* id : {"F01", "F02"}) {
        fabrics::FabricInfo fabric;
        fabric.id = protocols::FabricId(id);
        fabric.name = id;
        dataset.fabrics.push_back(fabric);
        for (const int index : {0, 1}) {
            const auto photo = fabrics::samplePath(dataset, fabric.id, fabrics::Modality::Visual, index);
            const auto surface = fabrics::surfacePath(dataset, fabric.id, index);
            std::filesystem::create_directories(photo.parent_path());
            std::filesystem::create_directories(surface.parent_path());
            const cv::Mat height = scannedHeight(300);
            writePng(photo, index == 0 ? cv::Mat(300, 300, CV_8UC3, cv::Scalar(128, 90, 60)) : litFromLowerRight(height));
            writeTiff(surface, height);
            fabrics::SamplePlace place;
            place.fabric = fabric.id;
            place.index = index;
            place.mmPerPixel = 0.1;
            place.light = index == 0 ? "colour" : "one_lamp";
            if (index == 1) place.lightDeg = 315;
            places.push_back(place);
        }
    }
    fabrics::writeDatasetJson(dataset);
    fabrics::writeSamplePlaces(dataset, places);
    return fabrics::readDataset(folder);
}

}  // namespace

class SeeingTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void exposureWhiteBalanceAndPlainDyeAreNotSeen()
    {
        const torch::Tensor seen = seenTexture(photograph());
        QCOMPARE(seen.size(1), std::int64_t{seenChannels});
        const torch::Tensor gains = torch::tensor({0.5F, 0.2F, 1.8F}).view({1, 3, 1, 1});
        QVERIFY(number((seenTexture(photograph() * gains) - seen).abs().max()) < 2e-3);
        QVERIFY2(number((seenTexture(photograph().pow(1.5)) - seen).narrow(1, 0, 1).abs().max()) < 0.05,
                 "gamma moves the first channel");
        QVERIFY(number(seen.narrow(1, 0, 1).abs().mean()) > 0.3);
    }

    void blackAndWhitePicturesGiveFiniteTextures()
    {
        for (const double grey : {0.0, 1.0})
            QVERIFY(torch::isfinite(seenTexture(torch::full({1, 3, 48, 48}, grey))).all().item<bool>());
    }

    void slowWavesAreFreeAndFastOnesCount()
    {
        QVERIFY(number(withoutSlowPart(wave(8, 1)).square().mean()) > 0.45);
        QVERIFY(number(withoutSlowPart(wave(640, 1)).narrow(3, 32, 64).square().mean()) < 1e-3);
        torch::manual_seed(8);
        const torch::Tensor map = torch::randn({1, 1, 96, 128}).contiguous();
        cv::Mat slow, known(96, 128, CV_32F, map.data_ptr<float>());
        cv::GaussianBlur(known, slow, {81, 81}, slowSigmaPx, slowSigmaPx, cv::BORDER_REPLICATE);
        slow = known - slow;
        QVERIFY(torch::allclose(withoutSlowPart(map), torch::from_blob(slow.data, {1, 1, 96, 128}), 1e-3, 1e-4));
        QVERIFY(number(reliefCorrelation(wave(8, 1), wave(8, 0.2) + wave(640, 2))) > 0.97);
        QVERIFY(number(reliefCorrelation(wave(8, 1), -wave(8, 1))) < -0.999);
    }

    void reliefLossPrefersTheKnownReliefToWrongOnes()
    {
        const torch::Tensor known = wave(8, 0.5);
        QVERIFY(number(reliefLoss(known, known, {})) < 1e-3);
        const double half = number(reliefLoss(0.5 * known, known, {})), none = number(reliefLoss(0 * known, known, {})),
                     turned = number(reliefLoss(-known, known, {}));
        QVERIFY2(0.05 < half && 5 * half < none && 5 * half < turned,
                 qPrintable(QString("%1 %2 %3").arg(half).arg(none).arg(turned)));
        QVERIFY(std::isfinite(number(reliefLoss(0 * known, 0 * known, {}))));
    }

    void reliefThatIsHardToSeeIsNotDrawnFlat()
    {
        // A map with a little of the truth: the smallest distance pixel by pixel would be reached by a flat one.
        torch::manual_seed(9);
        const torch::Tensor known = wave(8, 0.5), noise = torch::randn({1, 1, 128, 128});
        const torch::Tensor guess = 0.3 * known + 0.95 * 0.5 / std::numbers::sqrt2 * noise / noise.std();
        const auto lossAt = [&](double factor) { return number(reliefLoss(factor * guess, known, {})); };
        QVERIFY2(lossAt(1) < lossAt(0.5) && lossAt(0.5) < lossAt(0.2) && lossAt(1) < lossAt(2),
                 qPrintable(QString("%1 %2 %3 %4").arg(lossAt(0.2)).arg(lossAt(0.5)).arg(lossAt(1)).arg(lossAt(2))));
    }

    void batchesOfDrawnClothAreRepeatableAndNeverShowAFabricTwice()
    {
        const ClothBatchOptions options{2, 64, 0};
        const ClothBatch first = drawClothBatch({}, options, 7, 0), again = drawClothBatch({}, options, 7, 0);
        QCOMPARE(first.photographs, again.photographs);
        QCOMPARE(first.reliefs, again.reliefs);
        QVERIFY(drawClothBatch({}, options, 7, 1).photographs != first.photographs);
        QVERIFY(drawClothBatch({}, options, 8, 0).photographs != first.photographs);
        QCOMPARE(first.photographs.size(), std::size_t{2 * 3 * 64 * 64});
        for (const float friction : first.logFrictions) QVERIFY(std::exp(friction) > 0.05F && std::exp(friction) < 1.5F);
        for (const float value : first.photographs) QVERIFY(value >= 0 && value <= 1);
        for (const float value : first.logRatios) QVERIFY(std::isfinite(value));
        QVERIFY(!first.logRatios.empty());
    }

    void turnedPicturesComeBack()
    {
        cv::Mat picture(3, 5, CV_32F);
        cv::randu(picture, 0, 1);
        for (int turn = 0; turn < 8; ++turn) QCOMPARE(cv::norm(turnedBack(turned(picture, turn), turn), picture), 0.0);
    }

    void anyLampIsTurnedBetweenTopAndUpperLeft_data()
    {
        QTest::addColumn<double>("side");
        for (const double side : {0.0, 20.0, 45.0, 90.0, 100.0, 135.0, 170.0, 180.0, 250.0, 315.0, 359.0, -45.0})
            QTest::newRow(qPrintable(QString::number(side))) << side;
    }
    void anyLampIsTurnedBetweenTopAndUpperLeft()
    {
        QFETCH(double, side);
        // A ramp that grows towards the lamp must grow towards the side that the networks are told.
        const double angle = side * std::numbers::pi / 180;
        cv::Mat ramp(32, 32, CV_32F);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x) ramp.at<float>(y, x) = static_cast<float>(x * std::cos(angle) - y * std::sin(angle));
        const ToldLamp lamp = toldLamp(side);
        const cv::Mat seen = turned(ramp, lamp.turn);
        const double right = seen.at<float>(9, 10) - seen.at<float>(9, 9), up = seen.at<float>(9, 9) - seen.at<float>(10, 9);
        const double told = 112.5 + 22.5 * static_cast<double>(lamp.numbers[1]);
        QCOMPARE(lamp.numbers[0], 1.0F);
        QVERIFY(told >= 90 - 1e-6 && told <= 135 + 1e-6);
        QVERIFY2(std::abs(std::atan2(up, right) * 180 / std::numbers::pi - told) < 0.01, "the lamp stands elsewhere");
        QVERIFY(std::abs(lamp.sideDeg().value() - told) < 1e-4);
        QCOMPARE(toldLamp(std::nullopt).numbers, (std::array<float, lampNumbers>{0, 0}));
        QVERIFY(!toldLamp(std::nullopt).sideDeg());
    }

    void clothIsBrighterWhereItFacesAToldLamp()
    {
        ClothBatchOptions options{24, 64, 0, 0, 1};
        const ClothBatch batch = drawClothBatch({}, options, 11, 0);
        const auto [told, facing] = facingTheirLamp(batch);
        QVERIFY2(told >= 8 && facing >= 0.8 * told, qPrintable(QString("%1 of %2").arg(facing).arg(told)));
    }

    void shadingOfAToldLampIsAdded()
    {
        const auto [height, contrast] = bumpyCloth(192);
        // Networks that take dark for low and bright for high see nothing of slopes.
        cv::Mat seen = 0.7 * contrast;
        seen += 3;
        const cv::Mat joined = withToldShading(seen, contrast, 90), opposite = withToldShading(seen, contrast, 270);
        const auto fastOf = [](const cv::Mat& map) {
            cv::Mat slow;
            cv::GaussianBlur(map, slow, {}, 16, 16, cv::BORDER_REPLICATE);
            return cv::Mat(map - slow);
        };
        const auto match = [&](const cv::Mat& map) {
            const cv::Mat a = fastOf(map), b = fastOf(height);
            return a.dot(b) / (cv::norm(a) * cv::norm(b));
        };
        QVERIFY2(match(joined) > match(seen) + 0.2, qPrintable(QString("%1, %2").arg(match(joined)).arg(match(seen))));
        QVERIFY2(match(opposite) < match(seen) - 0.2, qPrintable(QString::number(match(opposite))));
        QVERIFY2(std::abs(cv::norm(fastOf(joined)) / cv::norm(fastOf(seen)) - 1) < 0.02, "the deviation of the networks changed");
        QVERIFY(std::abs(cv::mean(joined)[0] - cv::mean(seen)[0]) < 0.05);
        const cv::Rect small(0, 0, 63, 100);
        QCOMPARE(cv::norm(withToldShading(seen(small), contrast(small), 90), seen(small)), 0.0);
        // Faint contrast is not made high.
        const cv::Mat faint = withToldShading(1000 * seen, contrast, 90);
        QVERIFY(cv::norm(faint - 1000 * seen) < 0.05 * cv::norm(fastOf(1000 * seen)));
        // What lies beside a part of a picture does not count.
        const cv::Rect part(10, 12, 176, 170);
        QCOMPARE(cv::norm(withToldShading(seen(part), contrast(part), 90),
                          withToldShading(seen(part).clone(), contrast(part).clone(), 90)),
                 0.0);
        const cv::Mat even = cv::Mat::zeros(192, 192, CV_32F);
        QCOMPARE(cv::norm(withToldShading(seen, even, 90), seen), 0.0);
        QCOMPARE(cv::norm(withToldShading(even, contrast, 90), even), 0.0);
    }

    void reliefOfAPhotographHoldsTheShadingOfItsLamp_data()
    {
        QTest::addColumn<double>("light");
        QTest::addColumn<int>("width");
        for (const double light : {20.0, 110.0, 200.0, 290.0}) QTest::addRow("lamp at %g", light) << light << 256;
        QTest::newRow("two tiles") << 110.0 << 1040;
    }

    void reliefOfAPhotographHoldsTheShadingOfItsLamp()
    {
        QFETCH(double, light);
        QFETCH(int, width);
        // Networks without training see nothing. So what correlates with the relief comes from the shading.
        torch::manual_seed(6);
        Architecture architecture;
        architecture.sees = true;
        setSpectrogramShape(architecture);
        SeeingNetworks networks = makeSeeingNetworks(architecture);
        setTraining(networks, false);
        const cv::Mat height = bumpyCloth(width).height(cv::Rect(0, 0, width, 256));
        cv::Mat right, down;
        cv::Sobel(height, right, CV_32F, 1, 0, 1, 0.5);
        cv::Sobel(height, down, CV_32F, 0, 1, 1, 0.5);
        const double angle = light * std::numbers::pi / 180;
        cv::Mat lit = 110 - 90 * (right * std::cos(angle) - down * std::sin(angle)), rgb;
        lit.convertTo(lit, CV_8U);
        cv::merge(std::vector<cv::Mat>{lit, lit, lit}, rgb);
        InputPhotograph photograph{rgb, 0.05};
        GenerationOptions options;
        options.quality = Quality::Fast;
        options.friction = false;
        const auto match = [&](double lightDeg) {
            photograph.lightDeg = lightDeg;
            cv::Mat table;
            cv::matchTemplate(seenSignals(networks, architecture, photograph, options).heightMm, height, table,
                              cv::TM_CCOEFF_NORMED);
            return table.at<float>(0);
        };
        const float here = match(light), opposite = match(light + 180);
        QVERIFY2(here > 0.15F && here > opposite + 0.3F, qPrintable(QString("%1, %2").arg(here).arg(opposite)));
    }

    void aToldFibreMovesFrictionAndItsIntervalOnly()
    {
        torch::manual_seed(6);
        Architecture architecture;
        architecture.sees = true;
        setSpectrogramShape(architecture);
        architecture.fibres[std::size_t(fabrics::Fibre::Silk)] = FibreReading{0.02, 0.5, 0.6};
        architecture.frictionFactor = 3;
        SeeingNetworks networks = makeSeeingNetworks(architecture);
        setTraining(networks, false);
        cv::Mat rgb(128, 128, CV_8UC3);
        cv::randu(rgb, 0, 255);
        const auto seen = [&](std::optional<fabrics::Fibre> fibre) {
            return seenSignals(networks, architecture, {rgb, 0.05, {}, fibre}, {});
        };
        const GeneratedSignals untold = seen({}), silk = seen(fabrics::Fibre::Silk), wool = seen(fabrics::Fibre::Wool);
        QCOMPARE(wool.meanFriction, untold.meanFriction);  // The model knows nothing of wool.
        QVERIFY(std::abs(silk.meanFriction / (3 * (0.02 + 0.5 * untold.meanFriction / 3)) - 1) < 1e-5);
        QVERIFY(std::abs(cv::mean(silk.trace)[0] / silk.meanFriction - 1) < 1e-5);
        const auto width = [](const GeneratedSignals& signals) {
            return std::log(signals.photograph.meanFriction->high / signals.photograph.meanFriction->low);
        };
        QVERIFY(std::abs(width(silk) / width(untold) - 0.6) < 1e-5);
        QCOMPARE(cv::norm(silk.heightMm, untold.heightMm, cv::NORM_INF), 0.0);
    }

    void scansArePhotographedAnewWithTheirSlopesAndWithoutFriction()
    {
        QTemporaryDir folder;
        const fabrics::Dataset dataset = scans(folder.path().toStdString());
        const std::vector<ScannedCloth> cloth = readScannedCloth(dataset, {});
        QCOMPARE(cloth.size(), std::size_t{4});
        QVERIFY(cloth[0].isFlat && !cloth[0].lightDeg && !cloth[1].isFlat && cloth[1].lightDeg == 315.0);
        QCOMPARE(readScannedCloth(dataset, {protocols::FabricId("F02")}).front().fabric, std::string("F01"));
        const ClothBatch batch = drawClothBatch(cloth, {4, 64, 1, 0.3, 0.6, 1}, 1, 0);
        double steepest = 0;
        for (int i = 0; i < 4; ++i) {
            QVERIFY(std::isnan(batch.logFrictions[static_cast<std::size_t>(i)]));
            const cv::Mat relief(64, 64, CV_32F, const_cast<float*>(batch.reliefs.data()) + 64 * 64 * i);
            for (int y = 1; y < 64; ++y)
                for (int x = 1; x < 64; ++x)
                    steepest = std::max(
                        steepest, static_cast<double>(std::max(std::abs(relief.at<float>(y, x) - relief.at<float>(y, x - 1)),
                                                               std::abs(relief.at<float>(y, x) - relief.at<float>(y - 1, x)))));
        }
        // A zoom keeps slopes: 0.1 mm times 2 pi over 1.2 mm.
        QVERIFY2(std::abs(steepest - 0.524) < 0.06, qPrintable(QString::number(steepest)));
        QVERIFY(refusalOf([&] {
                    readScannedCloth(dataset, {protocols::FabricId("F01"), protocols::FabricId("F02")});
                }).contains("no scanned cloth remains"));
    }

    void scansKnowTheirFilesAndNamedPicturesAreLeftOut()
    {
        QTemporaryDir folder;
        const fabrics::Dataset dataset = scans(folder.path().toStdString());
        const protocols::FabricId first("F01");
        std::vector<std::string> files;
        for (const int index : {0, 1})
            files.push_back(protocols::sha256OfFile(fabrics::samplePath(dataset, first, fabrics::Modality::Visual, index)));
        QCOMPARE(hashesOf(readScannedCloth(dataset, {protocols::FabricId("F02")})), files);
        QCOMPARE(hashesOf(readScannedCloth(dataset, {protocols::FabricId("F02")}, {{first, 1}})),
                 std::vector<std::string>{files[0]});
        const QString refused = refusalOf([&] { readScannedCloth(dataset, {protocols::FabricId("F02")}, {{first, 0}}); });
        QVERIFY2(refused.contains("no scanned cloth remains") && refused.contains("leave --scans out"), qPrintable(refused));
    }

    void aSurfaceThatDoesNotFitItsPictureIsRefused()
    {
        QTemporaryDir folder;
        const fabrics::Dataset dataset = scans(folder.path().toStdString());
        const std::filesystem::path surface = fabrics::surfacePath(dataset, protocols::FabricId("F01"), 0);
        cv::Mat height = readTiff(surface);
        height.at<float>(5, 5) = std::numeric_limits<float>::quiet_NaN();
        writeTiff(surface, height);
        const QString gap = refusalOf([&] { readScannedCloth(dataset, {}); });
        QVERIFY2(gap.contains("not finite") && gap.contains(QString::fromStdString(surface.string())), qPrintable(gap));
        writeTiff(surface, cv::Mat(20, 30, CV_32FC1, cv::Scalar(0.1)));
        const QString size = refusalOf([&] { readScannedCloth(dataset, {}); });
        QVERIFY2(size.contains("30 x 20 px") && size.contains(QString::fromStdString(surface.string())), qPrintable(size));
    }

    void foldedNetworksGiveTheSameSignals()
    {
        torch::manual_seed(5);
        SeeingNetworks networks = makeSeeingNetworks({.sees = true});
        const torch::NoGradGuard noGradient;
        const torch::Tensor texture = seenTexture(torch::rand({2, 3, 128, 128})), lamp = torch::zeros({2, 2}),
                            logPitch = torch::zeros({2, 1});
        networks.relief->forward(texture, lamp);  // In training: the running statistics become other than 0 and 1.
        networks.friction->forward(texture, torch::rand({2, 1, 128, 128}), logPitch);
        setTraining(networks, false);
        const torch::Tensor relief = networks.relief->forward(texture, lamp);
        const SeenFriction friction = networks.friction->forward(texture, relief, logPitch);
        foldBatchNorms(*networks.relief);
        foldBatchNorms(*networks.friction);
        const torch::Tensor folded = networks.relief->forward(texture, lamp);
        const SeenFriction ofFolded = networks.friction->forward(texture, relief, logPitch);
        QVERIFY(relief.std().item<double>() > 1e-3);
        QVERIFY(torch::allclose(folded, relief, 1e-4, 1e-5));
        QVERIFY(torch::allclose(ofFolded.logMean, friction.logMean, 1e-4, 1e-5));
        QVERIFY(torch::allclose(ofFolded.logSpread, friction.logSpread, 1e-4, 1e-5));
        QVERIFY(torch::allclose(ofFolded.logRatio, friction.logRatio, 1e-4, 1e-5));
    }

    void scansAreAlsoShownAsTheyAreUnderTheirOwnLamp()
    {
        QTemporaryDir folder;
        const std::vector<ScannedCloth> cloth = readScannedCloth(scans(folder.path().toStdString()), {});
        ClothBatchOptions options{24, 64, 1, 0, 1, 0};
        const auto [told, facing] = facingTheirLamp(drawClothBatch(cloth, options, 3, 0));
        QVERIFY2(told >= 6 && told <= 18, qPrintable(QString::number(told)));  // Plain colour has no lamp.
        QCOMPARE(facing, told);
    }
};

QTEST_GUILESS_MAIN(SeeingTest)
#include "seeing_test.moc"
