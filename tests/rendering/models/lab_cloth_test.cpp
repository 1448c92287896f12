// A laboratory's own cloth: what serves, what is held out, how measurements come to the pixels of photographs, and the losses and
// figures that follow from them.
#include "rendering/models/lab/lab_cloth.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "protocols/files/sha256.h"
#include "rendering/images/sensor_appearance.h"
#include "rendering/models/lab/lab_figures.h"
#include "rendering/models/lab/lab_heights.h"
#include "rendering/models/lab/lab_losses.h"
#include "rendering/models/seeing/cloth_tensors.h"
#include "rendering/models/seeing/relief_losses.h"
#include "tests/rendering/fabric_files.h"

using namespace rendering;
using namespace rendering::models;
using fabric_files::contains;
using fabric_files::refusalOf;
using protocols::FabricId;

namespace {

constexpr float missing = std::numeric_limits<float>::quiet_NaN();
constexpr int photographPx = 80;

/// What a small lab has recorded.
struct LabSet {
    int fabrics = 6, photographs = 3;
    bool strokes = true, surfaces = false, presses = false;
    fabrics::Pairing pairing = fabrics::Pairing::Weak;
    std::string quantity = "mu";
};

FabricId idOf(int number) { return FabricId("F0" + std::to_string(number)); }

/// Waves of 8 px and 0.05 mm; the upper left quarter was not measured.
cv::Mat wavesWithGap(int side)
{
    cv::Mat height(side, side, CV_32F);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            height.at<float>(y, x) =
                x < side / 2 && y < side / 2 ? missing : static_cast<float>(0.05 * std::sin(2 * std::numbers::pi * x / 8));
    return height;
}

/// Friction 0.2 for F01, 0.25 for F02 and so on, with a wave of 2 mm.
std::string strokeCsv(int fabric, const std::string& quantity)
{
    std::string text = "t_s," + quantity + "\n";
    for (int i = 0; i < 480; ++i)
        text +=
            std::to_string(i / 60.0) + "," + std::to_string((0.15 + 0.05 * fabric) * (1 + 0.1 * std::sin(2.5 * i / 12.0))) + "\n";
    return text;
}

fabrics::Dataset labSet(const QTemporaryDir& folder, const LabSet& wanted)
{
    namespace fs = std::filesystem;
    fabrics::Dataset dataset;
    dataset.folder = fabric_files::pathOf(folder);
    dataset.name = "lab";
    dataset.cameraMmPerPixel = 0.05;
    dataset.pairing = wanted.pairing;
    if (wanted.presses) {
        dataset.tactileMmPerPixel = 0.05;
        dataset.tactileCalibration = "known";
    }
    for (int fabric = 1; fabric <= wanted.fabrics; ++fabric) {
        const fs::path own = dataset.folder / idOf(fabric).value;
        dataset.fabrics.push_back({idOf(fabric), "cloth", ""});
        for (const char* kind : {"visual", "surface", "tactile", "height"}) fs::create_directories(own / kind);
        for (int i = 0; i < wanted.photographs; ++i) {
            const std::string name = "00" + std::to_string(i);
            writePng(own / "visual" / (name + ".png"),
                     fabric_files::speckled(photographPx, photographPx, CV_8UC3, 10 * fabric + i));
            if (wanted.surfaces) writeTiff(own / "surface" / (name + ".tiff"), wavesWithGap(photographPx));
            if (wanted.presses) {
                writePng(own / "tactile" / (name + ".png"), fabric_files::speckled(96, 96, CV_8UC3, i));
                writeTiff(own / "height" / (name + ".tiff"), wavesWithGap(96));
            }
            if (wanted.strokes) fabric_files::write(own / "friction" / (name + ".csv"), strokeCsv(fabric, wanted.quantity));
        }
    }
    fabrics::writeDatasetJson(dataset);
    return dataset;
}

Architecture smallNetworks()
{
    Architecture architecture;
    architecture.sees = true;
    architecture.crop = 48;
    setSpectrogramShape(architecture);
    return architecture;
}

LabCloth read(const fabrics::Dataset& dataset, const LabOptions& options = {})
{
    return readLabCloth(dataset, smallNetworks(), options);
}

double number(const torch::Tensor& tensor) { return tensor.item<double>(); }

torch::Tensor noise(std::int64_t count, std::int64_t side, int seed)
{
    torch::manual_seed(static_cast<std::uint64_t>(seed));
    return torch::avg_pool2d(torch::randn({count, 1, side + 2, side + 2}), 3, 1);
}

PressWindows windowsFrom(const torch::Tensor& maps)
{
    PressWindows windows;
    windows.side = static_cast<int>(maps.size(3));
    windows.count = static_cast<int>(maps.size(0));
    const torch::Tensor flat = withoutSlowPart(maps).contiguous();
    windows.reliefs.assign(flat.data_ptr<float>(), flat.data_ptr<float>() + flat.numel());
    return windows;
}

SeenLabPhotograph seenFriction(std::size_t fabric, double logError)
{
    SeenLabPhotograph seen;
    seen.fabric = fabric;
    seen.logFrictionError = logError;
    return seen;
}

}  // namespace

class LabClothTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void photographsWithoutMeasurementsAreRefused()
    {
        const QTemporaryDir folder;
        const std::string refusal = refusalOf([&] { read(labSet(folder, {.strokes = false})); });
        QVERIFY2(contains(refusal, "nothing to learn from") && contains(refusal, "strokes"), refusal.c_str());
        QVERIFY2(contains(refusal, folder.path().toStdString()), refusal.c_str());
    }

    void countsOfASensorAreNoFriction()
    {
        const QTemporaryDir folder;
        QVERIFY(contains(refusalOf([&] { read(labSet(folder, {.quantity = "taxel_counts"})); }), "nothing to learn from"));
    }

    void tenPhotographsServeAndNineDoNot()
    {
        const QTemporaryDir nine, ten;
        const std::string refusal = refusalOf([&] { read(labSet(nine, {.fabrics = 3, .photographs = 3})); });
        QVERIFY2(contains(refusal, "only 9 photographs") && contains(refusal, "at least 10"), refusal.c_str());
        const LabCloth lab = read(labSet(ten, {.fabrics = 1, .photographs = 10}));
        QCOMPARE(lab.photographs.size(), std::size_t{10});
        QCOMPARE(lab.photographsOf(LabPart::HeldOutPlace).size(), std::size_t{2});
    }

    void placesAndOneFabricInFiveStayUnseen()
    {
        const QTemporaryDir folder;
        const fabrics::Dataset dataset = labSet(folder, {});
        const LabCloth lab = read(dataset);
        std::map<LabPart, std::set<std::size_t>> fabricsOf;
        for (const LabPhotograph& photograph : lab.photographs) fabricsOf[photograph.part].insert(photograph.fabric);
        QCOMPARE(fabricsOf[LabPart::HeldOutFabric].size(), std::size_t{1});
        QCOMPARE(lab.photographsOf(LabPart::HeldOutFabric).size(), std::size_t{3});
        QCOMPARE(lab.photographsOf(LabPart::HeldOutPlace).size(), std::size_t{5});
        QVERIFY(!fabricsOf[LabPart::Training].contains(*fabricsOf[LabPart::HeldOutFabric].begin()));
        for (const LabPhotograph& photograph : lab.photographs) {
            const std::string hash = protocols::sha256OfFile(
                fabrics::samplePath(dataset, lab.fabrics[photograph.fabric].id, fabrics::Modality::Visual, photograph.index));
            QCOMPARE(std::ranges::binary_search(lab.trainingHashes, hash), photograph.part == LabPart::Training);
        }
        QCOMPARE(read(dataset).trainingHashes, lab.trainingHashes);
        QVERIFY(read(dataset, {.splitSeed = 2}).trainingHashes != lab.trainingHashes);
    }

    void namedFabricsAreHeldOut()
    {
        const QTemporaryDir folder;
        const LabCloth lab = read(labSet(folder, {.fabrics = 4}), {.heldOut = {FabricId("F02"), FabricId("F04")}});
        for (const LabFabric& fabric : lab.fabrics)
            QCOMPARE(fabric.heldOut, fabric.id == FabricId("F02") || fabric.id == FabricId("F04"));
        const QTemporaryDir other;
        QVERIFY(contains(refusalOf([&] { read(labSet(other, {.fabrics = 4}), {.heldOut = {FabricId("F09")}}); }), "F09"));
    }

    void scansOfHeldOutPlacesAndFabricsAreFoundByTheirFiles()
    {
        const QTemporaryDir folder, other;
        const fabrics::Dataset dataset = labSet(folder, {});
        const LabCloth lab = read(dataset);
        QCOMPARE(lab.heldOutPlaces.size(), std::size_t{5});
        QCOMPARE(lab.heldOutFabrics.size(), std::size_t{3});
        fabrics::Dataset scans;
        scans.folder = fabric_files::pathOf(other);
        scans.cameraMmPerPixel = 0.05;  // 4 mm a photograph
        std::vector<fabrics::SamplePlace> places;
        const auto add = [&](int fabric, int index, double xMm, const std::string& group) {
            places.push_back({idOf(fabric), fabrics::Modality::Visual, index, xMm, 0, 0, group});
            const auto file = fabrics::samplePath(scans, idOf(fabric), fabrics::Modality::Visual, index);
            std::filesystem::create_directories(file.parent_path());
            writePng(file, fabric_files::speckled(photographPx, photographPx, CV_8UC3, 100 + 10 * fabric + index));
            return file;
        };
        const auto addCopy = [&](int fabric, LabPart part) {
            const LabPhotograph& from = lab.photographs[lab.photographsOf(part).front()];
            std::filesystem::copy_file(
                fabrics::samplePath(dataset, lab.fabrics[from.fabric].id, fabrics::Modality::Visual, from.index),
                add(fabric, 0, 0, "a"), std::filesystem::copy_options::overwrite_existing);
        };
        addCopy(1, LabPart::HeldOutFabric);
        add(1, 1, 50, "b");
        addCopy(2, LabPart::HeldOutPlace);
        add(2, 1, 50, "a");
        add(2, 2, 3, "c");
        add(2, 3, 5, "d");
        addCopy(3, LabPart::Training);
        add(3, 1, 3, "a");
        fabrics::writeSamplePlaces(scans, places);
        QCOMPARE(scansOfHeldOut(scans, lab), (PictureSet{{idOf(1), 0}, {idOf(1), 1}, {idOf(2), 0}, {idOf(2), 1}, {idOf(2), 2}}));
        QVERIFY(scansOfHeldOut(scans, LabCloth()).empty());
    }

    void trainingNeverTakesHeldOutStrokes()
    {
        LabFabric fabric{FabricId("F01"), false, {}, {}};
        for (const auto& [mean, part] : {std::pair{0.2F, LabPart::Training}, {0.4F, LabPart::HeldOutPlace}})
            fabric.strokes.push_back({{{}, mean}, part});
        QVERIFY(std::abs(fabric.logFriction(LabPart::Training) - std::log(0.2)) < 1e-6);
        QVERIFY(std::abs(fabric.logFriction(LabPart::HeldOutPlace) - std::log(0.4)) < 1e-6);
        fabric.strokes.erase(fabric.strokes.begin());
        QVERIFY(std::isnan(fabric.logFriction(LabPart::Training)));
        QVERIFY(std::abs(fabric.logFriction(LabPart::HeldOutFabric) - std::log(0.4)) < 1e-6);
    }

    void networksLearnWhatAToldFibreTurnsIntoTheMeasuredFriction()
    {
        const QTemporaryDir folder;
        LabCloth lab = read(labSet(folder, {}));
        LabBatchOptions options;
        options.side = 48;
        Architecture architecture = smallNetworks();
        architecture.fibres[std::size_t(fabrics::Fibre::Wool)] = FibreReading{0.02, 0.8, 0.6};
        const std::vector<float> measured = drawLabBatch(lab, architecture, options, 1, 0).cloth.logFrictions;
        for (LabPhotograph& photograph : lab.photographs) photograph.fibre = fabrics::Fibre::Wool;
        const std::vector<float> wanted = drawLabBatch(lab, architecture, options, 1, 0).cloth.logFrictions;
        for (std::size_t i = 0; i < measured.size(); ++i) {
            const ReadFriction told = withToldFibre({double(wanted[i]), 1}, architecture.fibres, fabrics::Fibre::Wool);
            QVERIFY(wanted[i] != measured[i] && std::abs(told.logMean - double(measured[i])) < 1e-5);
        }
    }

    void missingHeightsStayMissingAndTheRestIsLearned()
    {
        const QTemporaryDir folder;
        const LabCloth lab = read(labSet(folder, {.strokes = false, .surfaces = true}));
        LabBatchOptions options;
        options.side = 48;
        options.size = 12;
        const LabBatch batch = drawLabBatch(lab, smallNetworks(), options, 1, 0);
        const ClothTensors tensors = clothTensors(batch.cloth);
        const torch::Tensor measured = torch::isfinite(tensors.reliefs);
        const double share = number(measured.to(torch::kFloat).mean());
        QVERIFY2(share > 0.5 && share < 0.95, qPrintable(QString::number(share)));
        QVERIFY(torch::isnan(tensors.logFrictions).all().item<bool>());
        torch::Tensor generated = noise(12, 48, 1).set_requires_grad(true);
        const torch::Tensor loss = labReliefLoss(generated, tensors.reliefs, batch);
        loss.backward();
        QVERIFY(number(loss) > 0.1 && torch::isfinite(generated.grad()).all().item<bool>());
        // What the network says of a missing point costs nothing.
        const torch::Tensor elsewhere =
            labReliefLoss(torch::where(measured, generated, 7 * torch::ones_like(generated)), tensors.reliefs, batch);
        QVERIFY(std::abs(number(elsewhere) - number(loss)) < 1e-5);
        // The known relief has no loss.
        QVERIFY(number(labReliefLoss(torch::nan_to_num(tensors.reliefs, 0.0), tensors.reliefs, batch)) < 1e-3);
    }

    void allPointsMeasuredIsTheUsualLoss()
    {
        const torch::Tensor generated = noise(3, 64, 2), known = noise(3, 64, 3);
        QVERIFY(std::abs(number(measuredReliefLoss(generated, known, {})) - number(reliefLoss(generated, known, {}))) < 1e-5);
    }

    void pressOfAnAlignedSetLiesOnItsPhotograph()
    {
        // A ramp along x, 0 in the middle of the press; the photograph has half its resolution and shows less.
        cv::Mat ramp(100, 140, CV_32F);
        for (int y = 0; y < ramp.rows; ++y)
            for (int x = 0; x < ramp.cols; ++x) ramp.at<float>(y, x) = static_cast<float>((x - 69.5) * 0.05);
        const cv::Mat straight = onPhotograph(ramp, 0.05, {{40, 40}, 0.1, 0});
        const cv::Mat turned = onPhotograph(ramp, 0.05, {{40, 40}, 0.1, 90});
        const cv::Mat wide = onPhotograph(ramp, 0.05, {{100, 40}, 0.1, 0});
        for (const int at : {5, 20, 34}) {
            QVERIFY(std::abs(straight.at<float>(10, at) - (at - 19.5) * 0.1) < 1e-3);
            QVERIFY(std::abs(turned.at<float>(at, 10) + (at - 19.5) * 0.1) < 1e-3);
        }
        QVERIFY(std::isnan(wide.at<float>(20, 2)) && std::abs(wide.at<float>(20, 50) - 0.05F) < 1e-3F);
    }

    void alignedPressesAreRegisteredAndOthersAreNot()
    {
        const QTemporaryDir aligned, weak;
        const LabCloth together = read(labSet(aligned, {.presses = true, .pairing = fabrics::Pairing::Aligned}));
        const LabCloth apart = read(labSet(weak, {.presses = true}));
        for (const LabPhotograph& photograph : together.photographs) {
            QCOMPARE(photograph.reliefMm.size(), photograph.rgb.size());
            QVERIFY(measuredShare(photograph.reliefMm) > 0.6 && measuredShare(photograph.reliefMm) < 0.85);
        }
        LabBatchOptions options;
        options.side = 48;
        const LabBatch batch = drawLabBatch(apart, smallNetworks(), options, 1, 0);
        for (const PressWindows& windows : batch.presses) QVERIFY(windows.side == 48 && windows.measured < 0.99);
        QVERIFY(torch::isnan(clothTensors(batch.cloth).reliefs).all().item<bool>());
    }

    /// Its heights would have another scale, as `fabrics check` says.
    void calibrationOfAnotherSensorOrPitchIsRefused()
    {
        const QTemporaryDir folder;
        fabrics::Dataset dataset = labSet(folder, {.presses = true});
        dataset.tactileCalibration = "sensor.json";
        writePng(dataset.folder / "tactile-reference.png", fabric_files::speckled(96, 96, CV_8UC3, 7));
        const auto calibrated = [&](const std::string& mmPerPixel, const std::string& sensor) {
            fabric_files::write(dataset.folder / "sensor.json",
                                R"({"schema":"vis2hap.calibration/1","kind":"linear","gradient_from_rgb":[[1,0,0],[0,1,0]],)"
                                R"("offset":[0,0],"high_pass_cutoff_mm":null,"zero_percentile":2,"mm_per_pixel":)" +
                                    mmPerPixel + sensor + "}");
            return refusalOf([&] { read(dataset); });
        };
        const std::string pitch = calibrated("0.1", "");
        QVERIFY2(contains(pitch, "0.05 mm per pixel") && contains(pitch, "for 0.1"), pitch.c_str());
        std::string colours = "0";
        for (int i = 1; i < 3 * SensorAppearance::columns * SensorAppearance::rows; ++i) colours += ",0";
        const std::string sensor =
            calibrated("0.05", R"(,"sensor":{"width":3280,"height":96,"columns":)" + std::to_string(SensorAppearance::columns) +
                                   R"(,"rows":)" + std::to_string(SensorAppearance::rows) + R"(,"colours":[)" + colours + "]}");
        QVERIFY2(contains(sensor, "not of the calibrated sensor"), sensor.c_str());
        QCOMPARE(calibrated("0.05", ""), std::string());
    }

    void spectrumOfPressesDecidesWhereNothingIsRegistered()
    {
        const torch::Tensor generated = noise(1, 64, 5);
        const double same = number(pressLoss(generated, windowsFrom(noise(4, 64, 6))));
        const double higher = number(pressLoss(generated, windowsFrom(2 * noise(4, 64, 6))));
        const double coarser = number(pressLoss(generated, windowsFrom(1.8 * torch::avg_pool2d(noise(4, 68, 6), 5, 1))));
        QVERIFY2(same < 0.15 && higher > 4 * same && coarser > 2 * same,
                 qPrintable(QString("%1 %2 %3").arg(same).arg(higher).arg(coarser)));
        // Waves that the presses do not resolve do not count.
        PressWindows blurred = windowsFrom(noise(4, 64, 6));
        blurred.highestFrequency = 0.1;
        const torch::Tensor fine = 0.5 * torch::randn({1, 1, 64, 64});
        QVERIFY(number(pressLoss(generated + (fine - torch::avg_pool2d(fine, 9, 1, 4)), blurred)) < 2 * same + 0.2);
    }

    void strokesOfAnotherSpacingKeepTheirWaves()
    {
        std::vector<double> dense;
        for (int i = 0; i < 4000; ++i) dense.push_back(0.3 + 0.1 * std::sin(2 * std::numbers::pi * i * 0.01 / 2));
        const std::vector<double> even = atSpacing(dense, 0.01, 0.08), back = atSpacing(even, 0.08, 0.04);
        QCOMPARE(even.size(), std::size_t{500});
        for (const std::size_t i : {100U, 333U, 420U})
            QVERIFY(std::abs(even[i] - (0.3 + 0.1 * std::sin(2 * std::numbers::pi * static_cast<double>(i) * 0.08 / 2))) < 0.004);
        QVERIFY(std::abs(back[600] - even[300]) < 1e-9 && back.size() > 990);
        // A slow record tells nothing of fast waves.
        const QTemporaryDir folder;
        fabrics::Dataset slow = labSet(folder, {});
        slow.friction.speedMmPerS = 20;
        const cv::Mat ratio = read(slow).fabrics.front().strokes.front().target.logRatio;
        QVERIFY(std::isfinite(ratio.at<float>(7, 3)) && std::isnan(ratio.at<float>(12, 3)));
    }

    void factorsOfALabAreFoundAndFewFabricsAreBelievedLess()
    {
        std::vector<SeenLabPhotograph> many;
        for (std::size_t fabric = 0; fabric < 12; ++fabric)
            for (int i = 0; i < 3; ++i) many.push_back(seenFriction(fabric, -std::log(1.5) + 0.02 * (i - 1)));
        const LabFactors found = labFactors(many), alone = labFactors({many.front()});
        QVERIFY2(std::abs(found.friction - 1.5) < 0.02, qPrintable(QString::number(found.friction)));
        QVERIFY(alone.friction > 1.3 && alone.friction < found.friction);
        QCOMPARE(found.relief, 1.0);
    }

    void figuresAreMeansOverPhotographs()
    {
        std::vector<SeenLabPhotograph> seen{seenFriction(0, std::log(1.2)), seenFriction(3, std::log(0.9))};
        seen[0].intervalShare = 0.5;
        seen[1].intervalShare = 1.5;
        seen[1].logSqRatio = std::log(2.0);
        seen[1].correlation = 0.25;
        const LabFigures figures = labFigures(seen);
        QCOMPARE(figures.fabrics, 2);
        QCOMPARE(figures.insideInterval, 1);
        QVERIFY(std::abs(*figures.frictionError - 0.15) < 1e-9 && std::abs(*figures.sqRatio - 2) < 1e-9);
        QCOMPARE(*figures.correlation, 0.25);
        LabFigures better = figures;
        better.frictionError = 0.05;
        QVERIFY(labScore({figures}, {better}) < 0.9 && labScore({figures}, {figures}) == 1 && labScore({{}}, {{}}) == 1);
    }

    void lossOfShippedAbilitiesComesWithItsBound()
    {
        std::vector<SeenPatch> before(50), after(50);
        for (std::size_t i = 0; i < before.size(); ++i) {
            before[i].correlation = 0.6;
            after[i].correlation = 0.6 - (i % 2 == 0 ? 0.06 : 0);
            before[i].logError = std::log(1.2);
            after[i].logError = std::log(1.1);
        }
        const ShippedAbilities abilities = shippedAbilities(before, after);
        QVERIFY(std::abs(abilities.relief.worsePercent - 5) < 1e-6);
        // Half of the fabrics lost 10 %: 5 + 1.645 x 5.051 / sqrt(50).
        QVERIFY2(std::abs(abilities.relief.atMostPercent - 6.175) < 0.01,
                 qPrintable(QString::number(abilities.relief.atMostPercent)));
        QVERIFY(std::abs(abilities.friction.worsePercent + 50) < 1e-6);
        QCOMPARE(abilities.worst(), abilities.relief.worsePercent);
    }
};

QTEST_GUILESS_MAIN(LabClothTest)
#include "lab_cloth_test.moc"
