// A small data set on disk, rendered with generators that only record their calls.
#include "rendering/composition/render_fabrics.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "rendering/composition/image_warnings.h"
#include "rendering/composition/photograph_warnings.h"
#include "rendering/composition/render_json.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"
#include "rendering/signals/tactile/photometric_stereo.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using protocols::ConditionId;
using protocols::FabricId;

namespace {

namespace fs = std::filesystem;

cv::Mat picture(int rows, int columns, double period, double contrast)
{
    cv::Mat image(rows, columns, CV_8UC3);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const auto level =
                cv::saturate_cast<unsigned char>(120 + contrast * std::sin(i * 6.28 / period) * std::cos(j * 6.28 / period));
            image.at<cv::Vec3b>(i, j) = {level, static_cast<unsigned char>(level / 2 + 60), 120};
        }
    return image;
}

/// Three fabrics with two samples of each signal; the friction of fabric n is about 0.2 n.
struct SmallDataset {
    SmallDataset()
    {
        dataset.folder = folder.path().toStdString();
        dataset.name = "small";
        dataset.cameraMmPerPixel = 0.1;
        dataset.tactileMmPerPixel = 0.05;
        dataset.tactileCalibration = "tactile-calibration.json";
        signals::Calibration calibration;
        calibration.map = signals::LinearMap{{{{1, 0, 0}, {0, 1, 0}}}, {}};
        calibration.mmPerPixel = 0.05;
        std::ofstream(dataset.folder / dataset.tactileCalibration) << signals::toJson(calibration);
        writePng(dataset.folder / "tactile-reference.png", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(120)));
        for (int i = 1; i <= 3; ++i) addFabric(i);
        fabrics::writeDatasetJson(dataset);
    }

    void addFabric(int number)
    {
        const FabricId id("F0" + std::to_string(number));
        dataset.fabrics.push_back({id, "fabric " + std::to_string(number), ""});
        for (const auto* kind : {"visual", "tactile", "friction"}) fs::create_directories(dataset.folder / id.value / kind);
        for (int sample = 0; sample < 2; ++sample) {
            const auto name = "00" + std::to_string(sample);
            writePng(dataset.folder / id.value / "visual" / (name + ".png"), picture(60, 70, 8.0 + number, 20.0 * number));
            writePng(dataset.folder / id.value / "tactile" / (name + ".png"), picture(48, 64, 10.0 + sample, 15.0 * number));
            writeFriction(id, name, "mu", 0.2 * number + 0.01 * sample);
        }
    }

    void writeFriction(const FabricId& id, const std::string& name, const std::string& quantity, double mean)
    {
        std::ofstream file(dataset.folder / id.value / "friction" / (name + ".csv"));
        file << "t_s," << quantity << "\n";
        for (int i = 0; i < 100; ++i)
            file << std::to_string(i / 60.0) << "," << std::to_string(mean + mean * 0.1 * std::sin(0.5 * i)) << "\n";
    }

    QTemporaryDir folder;
    fabrics::Dataset dataset;
};

/// Record of the calls of the generators.
struct GeneratorCalls {
    int calls = 0, photographs = 0;
    bool height = false, friction = false;
};

RenderRequest requestFor(const SmallDataset& small, const char* conditions, GeneratorCalls& asked)
{
    RenderRequest request;
    for (const auto& fabric : small.dataset.fabrics) request.fabrics.push_back(fabric.id);
    request.conditions = protocols::conditionList(conditions);
    request.generate = [&asked](std::span<const models::InputPhotograph> photographs, const models::GenerationOptions& options) {
        ++asked.calls;
        asked.photographs += static_cast<int>(photographs.size());
        asked.height = options.height;
        asked.friction = options.friction;
        std::vector<models::GeneratedSignals> generated(photographs.size());
        for (std::size_t i = 0; i < generated.size(); ++i) {
            cv::extractChannel(photographs[i].photograph, generated[i].heightMm, 0);
            generated[i].heightMm.convertTo(generated[i].heightMm, CV_32F, 0.001);
            generated[i].heightMmPerPixel = 0.1;
            generated[i].spectrogram = cv::Mat::ones(33, 7, CV_32FC1);
            generated[i].meanFriction = 0.1 * static_cast<double>(i + 1);
            for (int k = 0; k < 100; ++k) generated[i].trace.push_back(generated[i].meanFriction + 0.01 * std::sin(k));
            generated[i].traceMmPerSample = 5.0 / 60;
        }
        return generated;
    };
    return request;
}

QString countsOf(const RenderedFabrics& rendering)
{
    QStringList counts;
    for (const auto& [signal, count] : rendering.computed)
        counts << QString::fromStdString(nameOf(signal)) + " " + QString::number(count);
    return counts.join(", ");
}

double meanLevel(const RenderedFabrics& rendering, std::size_t condition, const char* fabric)
{
    return cv::mean(rendering.conditions.at(condition).images.at(FabricId(fabric)))[0];
}

}  // namespace

class RenderFabricsTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void conditionComputesItsSignalsOnceForEachFabricAndNoOthers_data()
    {
        QTest::addColumn<QString>("conditions");
        QTest::addColumn<QString>("counts");
        QTest::addColumn<int>("calls");
        QTest::newRow("v_grey") << "v_grey"
                                << "photograph 3, grey photograph 3" << 0;
        QTest::newRow("v_shape") << "v_shape"
                                 << "photograph 3, shape from shading 3" << 0;
        QTest::newRow("f_g") << "f_g"
                             << "photograph 3, generated spectrogram 3, generated trace 3" << 1;
        QTest::newRow("h_g") << "h_g"
                             << "photograph 3, generated height 3" << 1;
        QTest::newRow("h_g&f_g") << "h_g&f_g"
                                 << "photograph 3, generated height 3, generated spectrogram 3, generated trace 3" << 1;
        QTest::newRow("t_grey") << "t_grey"
                                << "tactile frame 3, grey tactile frame 3" << 0;
        QTest::newRow("f") << "f"
                           << "friction record 3, measured trace 3" << 0;
        QTest::newRow("h") << "h"
                           << "tactile frame 3, photometric height 3" << 0;
        QTest::newRow("h&f") << "h&f"
                             << "tactile frame 3, friction record 3, photometric height 3, measured trace 3" << 0;
        QTest::newRow("gradient") << "gradient"
                                  << "tactile frame 3, photometric height 3, gradient of the height 3" << 0;
        QTest::newRow("shared ones once") << "v_grey,h,h&f,f"
                                          << "photograph 3, tactile frame 3, friction record 3, "
                                             "grey photograph 3, photometric height 3, measured trace 3"
                                          << 0;
        QTest::newRow("each quality once") << "v_grey,h_g@fast,h_g@accurate,h_g,h_g@balanced,f"
                                           << "photograph 3, friction record 3, grey photograph 3, generated height 9, "
                                              "measured trace 3"
                                           << 3;
        QTest::newRow("all") << "all"
                             << "photograph 3, tactile frame 3, friction record 3, grey photograph 3, shape from shading 3, "
                                "grey tactile frame 3, photometric height 3, generated height 3, measured trace 3, "
                                "generated spectrogram 3, generated trace 3"
                             << 1;
    }
    void conditionComputesItsSignalsOnceForEachFabricAndNoOthers()
    {
        QFETCH(QString, conditions);
        QFETCH(QString, counts);
        QFETCH(int, calls);
        const SmallDataset small;
        GeneratorCalls asked;
        const auto request = requestFor(small, qPrintable(conditions), asked);
        const auto rendering = renderFabrics(small.dataset, request);
        QCOMPARE(countsOf(rendering), counts);
        QCOMPARE(asked.calls, calls);
        QCOMPARE(asked.photographs, 3 * calls);
        QCOMPARE(asked.height, counts.contains("generated height"));
        QCOMPARE(asked.friction, counts.contains("generated trace"));
        QCOMPARE(rendering.conditions.size(), request.conditions.size());
        for (const auto& rendered : rendering.conditions) {
            QCOMPARE(rendered.images.size(), std::size_t(3));
            int low = 255, high = 0;
            for (const auto& [fabric, image] : rendered.images) {
                QCOMPARE(image.size(), cv::Size(1280, 800));
                QCOMPARE(image.type(), CV_8UC1);
                double least = 0, most = 0;
                cv::minMaxLoc(image, &least, &most);
                low = std::min(low, static_cast<int>(least));
                high = std::max(high, static_cast<int>(most));
            }
            QVERIFY(low == 0 && high == 255);
        }
    }

    void slipperyFabricIsWeakerThanARoughOneOfTheSameRelief()
    {
        const SmallDataset small;
        for (const char* fabric : {"F01", "F03"})
            fs::copy_file(small.dataset.folder / "F02/tactile/000.png", small.dataset.folder / fabric / "tactile/000.png",
                          fs::copy_options::overwrite_existing);
        GeneratorCalls asked;
        const auto rendering = renderFabrics(small.dataset, requestFor(small, "h,h&f", asked));
        QCOMPARE(meanLevel(rendering, 0, "F01"), meanLevel(rendering, 0, "F03"));
        QVERIFY(std::abs(meanLevel(rendering, 1, "F01") / meanLevel(rendering, 1, "F03") - 1.0 / 3) < 0.02);
    }

    void rangeIsThatOfTheDataSetWhenOneFabricIsWritten()
    {
        const SmallDataset small;
        GeneratorCalls asked;
        auto request = requestFor(small, "v_grey,f", asked);
        const auto all = renderFabrics(small.dataset, request);
        request.fabrics = {FabricId("F01")};
        const auto one = renderFabrics(small.dataset, request);
        for (std::size_t i = 0; i < 2; ++i) {
            QCOMPARE(one.conditions[i].images.size(), std::size_t(1));
            QCOMPARE(one.conditions[i].range.max, all.conditions[i].range.max);
            QCOMPARE(cv::norm(one.conditions[i].images.at(FabricId("F01")), all.conditions[i].images.at(FabricId("F01")),
                              cv::NORM_INF),
                     0.0);
        }
        request.rangeOver = {FabricId("F03"), FabricId("F01")};  // The widest first, because a range must not shrink again.
        QCOMPARE(renderFabrics(small.dataset, request).conditions[1].range.max, all.conditions[1].range.max);
        QCOMPARE(renderFabrics(small.dataset, request).conditions[1].range.min, all.conditions[1].range.min);
        request.rangeOver = {FabricId("F01"), FabricId("F02")};
        QVERIFY(renderFabrics(small.dataset, request).conditions[1].range.max < all.conditions[1].range.max);
    }

    void chosenSampleIsRead()
    {
        const SmallDataset small;
        GeneratorCalls asked;
        auto request = requestFor(small, "f", asked);
        request.samples[FabricId("F02")] = {.visual = 0, .tactile = 0, .friction = 1};
        const auto rendering = renderFabrics(small.dataset, request);
        QVERIFY(std::abs(*rendering.signals.at(FabricId("F02")).measuredMeanFriction - 0.41) < 0.01);
        QCOMPARE(rendering.samples.at(FabricId("F02")).friction, 1);
        request.samples[FabricId("F02")].friction = 7;
        QVERIFY(refusalOf([&] { renderFabrics(small.dataset, request); }).contains("sample 7"));
    }

    void missingSignalIsRefusedByFabricAndNameBeforeAnyWork_data()
    {
        QTest::addColumn<QString>("removed");
        QTest::addColumn<QString>("conditions");
        QTest::addColumn<QString>("said");
        QTest::newRow("photographs") << "visual"
                                     << "f,v_grey"
                                     << "photographs";
        QTest::newRow("photographs for the generators") << "visual"
                                                        << "h,f_g"
                                                        << "photographs";
        QTest::newRow("tactile frames") << "tactile"
                                        << "v_grey,h"
                                        << "tactile frames";
        QTest::newRow("friction records") << "friction"
                                          << "v_grey,h&f"
                                          << "friction records";
    }
    void missingSignalIsRefusedByFabricAndNameBeforeAnyWork()
    {
        QFETCH(QString, removed);
        QFETCH(QString, conditions);
        QFETCH(QString, said);
        const SmallDataset small;
        fs::remove_all(small.dataset.folder / "F02" / removed.toStdString());
        GeneratorCalls asked;
        int steps = 0;
        const auto request = requestFor(small, qPrintable(conditions), asked);
        const auto refusal =
            refusalOf([&] { renderFabrics(small.dataset, request, [&](int, int, const std::string&) { ++steps; }); });
        QVERIFY2(refusal.contains(said) && refusal.contains("F02"), qPrintable(refusal));
        QCOMPARE(steps, 0);
        QCOMPARE(asked.calls, 0);
    }

    void fabricThatLacksASignalIsLeftOutOfTheRangeOfOthers()
    {
        const SmallDataset small;
        fs::remove_all(small.dataset.folder / "F03" / "visual");
        GeneratorCalls asked;
        auto request = requestFor(small, "v_grey,f", asked);
        request.fabrics = {FabricId("F01")};
        const auto rendering = renderFabrics(small.dataset, request);
        QCOMPARE(rendering.conditions[0].rangeOver.size(), std::size_t(2));
        QCOMPARE(rendering.conditions[1].rangeOver.size(), std::size_t(3));
    }

    void heightWithoutCalibrationIsRefused()
    {
        SmallDataset small;
        small.dataset.tactileCalibration.clear();
        GeneratorCalls asked;
        QVERIFY(refusalOf([&] { renderFabrics(small.dataset, requestFor(small, "h", asked)); }).contains("no calibration"));
        QVERIFY(refusalOf([&] { renderFabrics(small.dataset, requestFor(small, "t_grey", asked)); }).isEmpty());
    }

    void knownHeightIsTakenAsItIs()
    {
        SmallDataset small;
        small.dataset.tactileCalibration = "known";
        GeneratorCalls asked;
        auto request = requestFor(small, "h", asked);
        QVERIFY(refusalOf([&] { renderFabrics(small.dataset, request); }).contains("F01"));
        for (const auto& fabric : request.fabrics) {
            fs::create_directories(small.dataset.folder / fabric.value / "height");
            writeTiff(small.dataset.folder / fabric.value / "height" / "000.tiff", cv::Mat(48, 64, CV_32FC1, cv::Scalar(0.25)));
        }
        const auto rendering = renderFabrics(small.dataset, request);
        QCOMPARE(rendering.conditions[0].range.max, 0.25);
        QCOMPARE(cv::countNonZero(rendering.conditions[0].images.at(FabricId("F01"))), 0);  // Constant, so no relief.
    }

    void physicalScaleNeedsThePitchOfItsSource()
    {
        SmallDataset small;
        small.dataset.cameraMmPerPixel.reset();
        GeneratorCalls asked;
        auto request = requestFor(small, "v_grey", asked);
        request.scale = DisplayScale::Physical;
        QVERIFY(refusalOf([&] { renderFabrics(small.dataset, request); }).contains("scale"));
        request.conditions = protocols::conditionList("h,f");
        QCOMPARE(renderFabrics(small.dataset, request).conditions.size(), std::size_t(2));
    }

    void otherQuantitiesAreRenderedInARangeOfTheirOwn()
    {
        SmallDataset small;
        small.writeFriction(FabricId("F03"), "000", "taxel_sum_counts", 4000);
        GeneratorCalls asked;
        const auto rendering = renderFabrics(small.dataset, requestFor(small, "f,h&f", asked));
        const auto& f = rendering.conditions[0];
        QCOMPARE(f.ranges.size(), std::size_t(2));
        QVERIFY(f.ranges.at("mu").max < 1);
        QVERIFY(f.ranges.at("taxel_sum_counts").min > 3000);
        QCOMPARE(rendering.signals.at(FabricId("F03")).measuredQuantity, std::string("taxel_sum_counts"));
        double high = 0;
        cv::minMaxLoc(f.images.at(FabricId("F02")), nullptr, &high);
        QCOMPARE(high, 255.0);  // The counts do not flatten the coefficients.
        const auto lines = mixedQuantities(rendering);
        QCOMPARE(lines.size(), std::size_t(2));
        QVERIFY2(lines[0].starts_with("condition f: the friction records hold 2 quantities (mu, taxel_sum_counts)"),
                 lines[0].c_str());
        auto some = requestFor(small, "f,h&f", asked);
        some.fabrics = {FabricId("F01"), FabricId("F02")};
        const auto shown = renderFabrics(small.dataset, some);
        QCOMPARE(shown.conditions[0].ranges.size(), std::size_t(2));
        QVERIFY(mixedQuantities(shown).empty());  // F03 sets a range, but no finger feels it.
        some.fabrics.push_back(FabricId("F03"));
        some.conditions = protocols::conditionList("h");
        QVERIFY(mixedQuantities(renderFabrics(small.dataset, some)).empty());
        small.writeFriction(FabricId("F03"), "000", "CoF", 0.7);
        QVERIFY(mixedQuantities(renderFabrics(small.dataset, requestFor(small, "f,h&f", asked))).empty());
    }

    void gradientNeedsThePitchOfTheTactileFrames()
    {
        SmallDataset small;
        small.dataset.tactileMmPerPixel.reset();
        GeneratorCalls asked;
        const auto refusal = refusalOf([&] { renderFabrics(small.dataset, requestFor(small, "gradient", asked)); });
        QVERIFY2(refusal.contains("pitch") && refusal.contains("gradient"), qPrintable(refusal));
    }

    void robustPercentilesKeepASpeckFromFlatteningTheRest()
    {
        const SmallDataset small;
        cv::Mat speck = picture(60, 70, 9, 20);
        speck.at<cv::Vec3b>(30, 35) = {255, 255, 255};
        writePng(small.dataset.folder / "F01/visual/000.png", speck);
        GeneratorCalls asked;
        auto request = requestFor(small, "v_grey", asked);
        request.fabrics = {FabricId("F01")};
        request.rangeOver = {FabricId("F01")};
        const auto whole = renderFabrics(small.dataset, request);
        QCOMPARE(whole.conditions[0].maps.at(FabricId("F01")).outsideRange, 0.0);
        request.percentiles = {0.5, 99.5};
        const auto robust = renderFabrics(small.dataset, request);
        QVERIFY(whole.conditions[0].range.max > 250);
        QVERIFY(robust.conditions[0].range.max < 150 && robust.conditions[0].range.min >= whole.conditions[0].range.min);
        const double outside = robust.conditions[0].maps.at(FabricId("F01")).outsideRange;
        QVERIFY2(outside > 0 && outside < 0.01, qPrintable(QString::number(outside)));
        const auto text = QString::fromStdString(renderJson(small.dataset, request, robust));
        QVERIFY(text.contains("outside_range") && text.contains("99.5"));
        for (const auto& wrong : {Percentiles{50, 50}, Percentiles{-1, 100}, Percentiles{0, 101}, Percentiles{90, 10}}) {
            request.percentiles = wrong;
            QVERIFY(refusalOf([&] { renderFabrics(small.dataset, request); }).contains("percentiles"));
        }
    }

    void conversionOfEachSourceIsDescribed()
    {
        const SmallDataset small;
        writePng(small.dataset.folder / "F02/visual/000.png", picture(1000, 1400, 8, 40));
        GeneratorCalls asked;
        auto request = requestFor(small, "v_grey,t_grey,h", asked);
        const auto lines = describeMaps(renderFabrics(small.dataset, request));
        QCOMPARE(lines.size(), std::size_t(3));
        QVERIFY2(lines[0].starts_with("F01: v_grey, t_grey, h: tile, 0.0 % of its variance lost"), lines[0].c_str());
        QVERIFY2(lines[1].starts_with("F02: v_grey: none (cropped), 2"), lines[1].c_str());
        request.scale = DisplayScale::Physical;
        const auto physical = renderFabrics(small.dataset, request);
        QVERIFY(*physical.conditions[2].maps.at(FabricId("F01")).varianceLost > 0.01);
    }

    void photographsOfWhichOnlyTheMiddleIsUsedAreNamed()
    {
        SmallDataset small;
        GeneratorCalls asked;
        auto request = requestFor(small, "h_g", asked);
        request.generate = [inner = request.generate](auto photographs, const auto& options) {
            auto generated = inner(photographs, options);
            generated[0].photograph.middleOnly = true;
            return generated;
        };
        const auto rendering = renderFabrics(small.dataset, request);
        const auto lines = cutPhotographs(rendering);
        QCOMPARE(lines.size(), std::size_t{1});
        QVERIFY(QString::fromStdString(lines[0]).startsWith("photograph 0 of F01 is too large"));
        const auto json = nlohmann::json::parse(renderJson(small.dataset, request, rendering))["photographs"];
        QCOMPARE(json["F01"]["middle_only"].get<bool>(), true);
        QCOMPARE(json["F02"]["middle_only"].get<bool>(), false);
    }

    void photographsThatTellLittleOfTheirFrictionAreNamed()
    {
        SmallDataset small;
        GeneratorCalls asked;
        auto request = requestFor(small, "h_g+f_g", asked);
        request.generate = [inner = request.generate](auto photographs, const auto& options) {
            auto generated = inner(photographs, options);
            generated[0].photograph.meanFriction = models::FrictionInterval{0.15, 0.6};
            generated[1].photograph.meanFriction = models::FrictionInterval{0.25, 0.35};
            return generated;
        };
        const auto rendering = renderFabrics(small.dataset, request);
        const auto lines = uncertainFriction(rendering);
        QCOMPARE(lines.size(), std::size_t{1});
        QCOMPARE(QString::fromStdString(lines[0]),
                 "photograph 0 of F01 tells little of its friction (90 % interval 0.15 to 0.60). "
                 "Its generated friction is that of an ordinary cloth. "
                 "If its label names one fibre, state it (\"fibre\" in dataset.json)");
        small.dataset.fabrics[0].fibre = fabrics::Fibre::Wool;
        const auto told = renderFabrics(small.dataset, request);
        QVERIFY(uncertainFriction(told)[0].ends_with("that of an ordinary cloth of wool"));
        QCOMPARE(
            nlohmann::json::parse(renderJson(small.dataset, request, told))["photographs"]["F01"]["fibre"].get<std::string>(),
            std::string("wool"));
        const auto json = nlohmann::json::parse(renderJson(small.dataset, request, rendering))["photographs"];
        QCOMPARE(json["F02"]["mean_friction"]["interval_90"][1].get<double>(), 0.35);
        QCOMPARE(json["F01"]["mean_friction"]["tells_little"].get<bool>(), true);
        QVERIFY(!json["F03"].contains("mean_friction"));
    }

    /// Stripes of 20 levels about the middle; a shift moves them along.
    static cv::Mat stripes(int shift, double depth, double period = 9)
    {
        cv::Mat image(800, 1280, CV_8UC1);
        for (int i = 0; i < image.rows; ++i)
            for (int j = 0; j < image.cols; ++j)
                image.at<uchar>(i, j) = cv::saturate_cast<uchar>(128 + depth * std::sin(2 * CV_PI * (j + shift) / period));
        return image;
    }

    void imagesThatNobodyCanTellApartAreNamed()
    {
        RenderedFabrics rendering;
        const FabricId f01("F01"), f02("F02"), f03("F03"), f04("F04");
        RenderedCondition plain, scaled;
        plain.condition = protocols::ConditionId("h_g");
        scaled.condition = protocols::ConditionId("h_g&f_g");
        plain.rangeSetBy = scaled.rangeSetBy = {f02, f03};
        plain.images = {{f01, stripes(0, 100)}, {f02, stripes(0, 100)}, {f03, stripes(0, 100)}, {f04, stripes(0, 8)}};
        scaled.images = {{f01, stripes(0, 101)}, {f02, stripes(4, 100)}, {f03, stripes(0, 60)}, {f04, stripes(0, 40, 14)}};
        rendering.conditions = {plain, scaled};
        const auto faults = imageFaults(rendering);
        QCOMPARE(faults.same.size(), std::size_t{2});  // Nearly the same, and the same pattern elsewhere.
        QCOMPARE(faults.same[0].fabric, f01);
        QVERIFY(faults.same[0].distance.greyLevels < 1);
        QCOMPARE(faults.same[1].fabric, f02);
        QVERIFY(faults.same[1].distance.greyLevels > 50 && faults.same[1].distance.decibels < 0.5);
        const auto weaker = distanceOf(plain.images.at(f03), scaled.images.at(f03));
        QVERIFY2(weaker.decibels > 1 && weaker.greyLevels > 20, "a weaker relief is another image");
        QCOMPARE(faults.flat.size(), std::size_t{1});
        QCOMPARE(faults.flat[0].fabric, f04);
        QVERIFY(std::abs(faults.flat[0].rangeUsed - 16.0 / 255) < 0.01);
        const auto lines = describe(faults, rendering);
        QCOMPARE(lines.size(), std::size_t{2});
        QVERIFY2(lines[0].starts_with("conditions h_g and h_g&f_g give the same image for F01, F02 (at most"), lines[0].c_str());
        QVERIFY2(lines[1].find("is used by F04 (6.3 %); F02 sets the lower end of the range, F03 the upper") != std::string::npos,
                 lines[1].c_str());
        QCOMPARE(jsonOf(faults)["same"].size(), std::size_t{2});
    }

    /// Fast generators give stripes of another period.
    static RenderRequest requestWithFastStripes(const SmallDataset& small, const char* conditions, GeneratorCalls& asked)
    {
        auto request = requestFor(small, conditions, asked);
        request.generate = [usual = request.generate](std::span<const models::InputPhotograph> photographs,
                                                      const models::GenerationOptions& options) {
            auto generated = usual(photographs, options);
            for (auto& one : generated) {
                one.heightMilliseconds = options.quality == models::Quality::Fast ? 5 : 50;
                if (options.quality == models::Quality::Fast) stripes(0, 100, 4).convertTo(one.heightMm, CV_32F, 0.001);
            }
            return generated;
        };
        return request;
    }

    void aConditionIsTheSameImageAsItsUsualQuality()
    {
        const SmallDataset small;
        GeneratorCalls asked;
        const auto request = requestWithFastStripes(small, "h_g,h_g@balanced,h_g@fast", asked);
        const auto rendering = renderFabrics(small.dataset, request);
        QCOMPARE(asked.calls, 2);
        const auto faults = imageFaults(rendering);
        QCOMPARE(faults.same.size(), std::size_t{3});
        for (const auto& same : faults.same) {
            QCOMPARE(same.first, ConditionId("h_g"));
            QCOMPARE(same.second, ConditionId("h_g@balanced"));
        }
        QVERIFY(describe(faults, rendering)[0].starts_with("conditions h_g and h_g@balanced give the same image"));
        const auto json = nlohmann::json::parse(renderJson(small.dataset, request, rendering));
        QCOMPARE(json["conditions"]["h_g@fast"]["quality"].get<std::string>(), std::string("fast"));
        QCOMPARE(json["conditions"]["h_g"]["quality"].get<std::string>(), std::string("balanced"));
    }

    void everyQualityKeepsItsTime()
    {
        const SmallDataset small;
        GeneratorCalls asked;
        const auto rendering = renderFabrics(small.dataset, requestWithFastStripes(small, "h_g@fast,h_g@accurate", asked));
        const FabricId f02("F02");
        QCOMPARE(rendering.signalsAt.at(models::Quality::Fast).at(f02).milliseconds.at(Signal::GeneratedHeight), 5.0);
        QCOMPARE(rendering.signalsAt.at(models::Quality::Accurate).at(f02).milliseconds.at(Signal::GeneratedHeight), 50.0);
        // Nothing has the usual quality, so the accurate signals describe the fabric.
        QCOMPARE(rendering.signals.at(f02).milliseconds.at(Signal::GeneratedHeight), 50.0);
        QVERIFY(rendering.signals.at(f02).images.at(Signal::Photograph).data ==
                rendering.signalsAt.at(models::Quality::Fast).at(f02).images.at(Signal::Photograph).data);
    }

    void fabricsThatSetTheRangeAreStated()
    {
        const SmallDataset small;
        GeneratorCalls asked;
        const auto request = requestFor(small, "v_grey", asked);
        const auto rendering = renderFabrics(small.dataset, request);
        const auto json = nlohmann::json::parse(renderJson(small.dataset, request, rendering));
        const auto& set = rendering.conditions.front().rangeSetBy;
        double low = 0, high = 0;
        cv::minMaxLoc(rendering.conditions.front().images.at(set.lowest), &low);
        cv::minMaxLoc(rendering.conditions.front().images.at(set.highest), nullptr, &high);
        QCOMPARE(low, 0.0);
        QCOMPARE(high, 255.0);
        QCOMPARE(json["conditions"]["v_grey"]["range_set_by"]["highest"].get<std::string>(), set.highest.value);
        QVERIFY(json["image_faults"]["same"].is_array());
    }

    void jsonContainsRangeSamplesAndSignals()
    {
        const SmallDataset small;
        GeneratorCalls asked;
        const auto request = requestFor(small, "v_grey,h&f", asked);
        const auto text = renderJson(small.dataset, request, renderFabrics(small.dataset, request));
        QVERIFY(text.starts_with("{\n  \"schema\": \"vis2hap.render/1\""));
        const auto json = QJsonDocument::fromJson(QByteArray::fromStdString(text)).object();
        const auto condition = json["conditions"].toObject()["h&f"].toObject();
        QVERIFY(condition["range"].toObject()["max"].toDouble() > 0);
        QCOMPARE(condition["range_over"].toArray().size(), 3);
        QCOMPARE(condition["extension"].toObject()["F01"].toString(), "tile");
        QCOMPARE(condition["stroke_axis"].toString(), "x");
        QCOMPARE(condition["images"].toArray().size(), 3);
        QCOMPARE(condition["variance_lost"].toObject()["F01"].toDouble(-1), 0.0);
        QCOMPARE(condition["mapping"].toObject()["percentiles"].toArray()[1].toDouble(), 100.0);
        QCOMPARE(json["signals_computed"].toObject()["photometric height"].toInt(), 3);
        QCOMPARE(json["samples"].toObject()["F03"].toObject()["tactile"].toInt(-1), 0);
        QVERIFY(condition["ms"].isDouble());
    }
};

QTEST_GUILESS_MAIN(RenderFabricsTest)
#include "render_fabrics_test.moc"
