// Signals and ranges are kept by content: nothing is computed twice, nothing is read that is not used, and every input counts.
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/process/opened_files.h"
#include "rendering/cache/packed_result.h"
#include "rendering/cache/result_cache.h"
#include "rendering/composition/render_fabrics.h"
#include "rendering/composition/render_json.h"
#include "rendering/images/image_png.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/signals/tactile/photometric_stereo.h"

using namespace rendering;
using protocols::FabricId;

namespace {

namespace fs = std::filesystem;

cv::Mat weave(int rows, int columns, double period, double contrast)
{
    cv::Mat image(rows, columns, CV_8UC3);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            image.at<cv::Vec3b>(i, j) = cv::Vec3b::all(
                cv::saturate_cast<unsigned char>(120 + contrast * std::sin(i * 6.28 / period) * std::cos(j * 6.28 / period)));
    return image;
}

/// Three fabrics with one sample of each signal.
struct SmallDataset {
    SmallDataset()
    {
        dataset.folder = fs::path(temporary.path().toStdString()) / "fabrics";
        fs::create_directory(dataset.folder);
        dataset.name = "small";
        dataset.cameraMmPerPixel = 0.1;
        dataset.tactileMmPerPixel = 0.05;
        dataset.tactileCalibration = "calibration.json";
        writeCalibration(1);
        writePng(dataset.folder / "tactile-reference.png", cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(120)));
        for (int number = 1; number <= 3; ++number) {
            const FabricId id("F0" + std::to_string(number));
            dataset.fabrics.push_back({id, "fabric", ""});
            for (const char* kind : {"visual", "tactile", "friction"}) fs::create_directories(dataset.folder / id.value / kind);
            writePng(file(number, "visual/000.png"), weave(60, 70, 8.0 + number, 20.0 * number));
            writePng(file(number, "tactile/000.png"), weave(48, 64, 10.0, 15.0 * number));
            std::ofstream record(file(number, "friction/000.csv"));
            record << "t_s,mu\n";
            for (int i = 0; i < 100; ++i)
                record << std::to_string(i / 60.0) << "," << std::to_string(0.2 * number + 0.02 * std::sin(0.5 * i)) << "\n";
        }
        fabrics::writeDatasetJson(dataset);
    }

    fs::path file(int number, const char* name) const { return dataset.folder / ("F0" + std::to_string(number)) / name; }

    void writeCalibration(double gain) const
    {
        signals::Calibration calibration;
        calibration.map = signals::LinearMap{{{{gain, 0, 0}, {0, gain, 0}}}, {}};
        calibration.mmPerPixel = 0.05;
        std::ofstream(dataset.folder / "calibration.json") << signals::toJson(calibration);
    }

    QTemporaryDir temporary;
    fabrics::Dataset dataset;
};

struct Rendered {
    RenderedFabrics fabrics;
    int photographsGenerated = 0;
    std::string json;
};

}  // namespace

class CachedRenderTest : public QObject {
    Q_OBJECT
private:
    SmallDataset m_small;
    QTemporaryDir m_temporary;

    fs::path cacheFolder() const { return fs::path(m_temporary.path().toStdString()) / QTest::currentTestFunction(); }

    /// Each call is a process of its own, as far as the cache knows.
    Rendered render(const char* conditions, std::vector<FabricId> ids,
                    const std::function<void(RenderRequest&)>& change = {}) const
    {
        Rendered rendered;
        RenderRequest request;
        request.fabrics = std::move(ids);
        request.conditions = protocols::conditionList(conditions);
        request.cache = std::make_shared<cache::ResultCache>(cacheFolder());
        request.generate = [&](std::span<const models::InputPhotograph> photographs, const models::GenerationOptions& options) {
            rendered.photographsGenerated += static_cast<int>(photographs.size());
            std::vector<models::GeneratedSignals> generated(photographs.size());
            for (std::size_t i = 0; i < generated.size(); ++i) {
                if (options.height) {
                    cv::extractChannel(photographs[i].photograph, generated[i].heightMm, 0);
                    generated[i].heightMm.convertTo(generated[i].heightMm, CV_32F, 0.001);
                    generated[i].heightMmPerPixel = 0.1;
                }
                if (!options.friction) continue;
                generated[i].spectrogram = cv::Mat::ones(33, 7, CV_32FC1);
                generated[i].meanFriction = cv::mean(photographs[i].photograph)[0] / 200;
                for (int k = 0; k < 100; ++k) generated[i].trace.push_back(generated[i].meanFriction + 0.01 * std::sin(k));
                generated[i].traceMmPerSample = 5.0 / 60;
                generated[i].photograph.meanFriction = models::FrictionInterval{0.4, 0.6};
            }
            return generated;
        };
        if (change) change(request);
        rendered.fabrics = renderFabrics(m_small.dataset, request);
        rendered.json = renderJson(m_small.dataset, request, rendered.fabrics);
        return rendered;
    }

    std::vector<FabricId> all() const { return {FabricId("F01"), FabricId("F02"), FabricId("F03")}; }

    static int costly(const Rendered& rendered)
    {
        int count = rendered.photographsGenerated;
        for (const Signal signal : {Signal::ShapeFromShading, Signal::PhotometricHeight})
            if (const auto found = rendered.fabrics.computed.find(signal); found != rendered.fabrics.computed.end())
                count += found->second;
        return count;
    }

    static void compareImages(const Rendered& a, const Rendered& b)
    {
        QCOMPARE(a.fabrics.conditions.size(), b.fabrics.conditions.size());
        for (std::size_t i = 0; i < a.fabrics.conditions.size(); ++i)
            for (const auto& [fabric, image] : b.fabrics.conditions[i].images)
                QCOMPARE(cv::norm(image, a.fabrics.conditions[i].images.at(fabric), cv::NORM_INF), 0.0);
    }

private Q_SLOTS:
    void initTestCase()
    {
        // The identity of the generators is that of their program and weights; the fake ones need a file.
        std::ofstream(fs::path(m_temporary.path().toStdString()) / "nn") << "program";
        qputenv("VIS2HAP_NN", (m_temporary.path() + "/nn").toUtf8());
        QTest::qSleep(2100);  // hashes of younger files are not remembered
    }

    void nothingIsComputedTwice()
    {
        const auto first = render("all", all());
        QCOMPARE(costly(first), 9);
        const auto second = render("all", all());
        QCOMPARE(costly(second), 0);
        QCOMPARE(second.fabrics.keptRanges, 27);
        compareImages(first, second);
        const auto without = render("all", all(), [](RenderRequest& request) { request.cache = nullptr; });
        QCOMPARE(costly(without), 9);
        compareImages(without, second);
    }

    void partsOfOneConditionServeOthers()
    {
        QCOMPARE(costly(render("h_g", all())), 3);
        const auto friction = render("h_g+f_g", all());
        QCOMPARE(friction.photographsGenerated, 3);  // for the friction alone
        QCOMPARE(costly(render("f_g,h_g,h_g+f_g", all())), 0);
    }

    void oneFabricNeedsNoRecordingOfTheOthers()
    {
        render("v_grey,v_shape,h,h+f", all());
        protocols::OpenedFiles opened({m_small.dataset.folder});
        const auto one = render("h+f", {FabricId("F02")});
        std::set<std::string> files;
        for (const auto& [file, count] : opened.counts()) files.insert(file.lexically_relative(m_small.dataset.folder).string());
        QVERIFY(opened.isComplete());
        QCOMPARE(files, (std::set<std::string>{"F02/friction/000.csv"}));  // the height is kept, the trace is cheap
        QCOMPARE(one.fabrics.conditions[0].rangeOver.size(), std::size_t{3});
        compareImages(render("h+f", all(), [](RenderRequest& request) { request.cache = nullptr; }), one);
        // What is written about the images does not depend on the cache, besides counts and times.
        for (const char* part :
             {"\"F01\": {\n      \"tactile\": 0,\n      \"friction\": 0", "\"measured_friction\": {\n    \"F02\""})
            QVERIFY2(one.json.find(part) != std::string::npos, one.json.c_str());
    }

    void everyInputCounts()
    {
        const auto changes = std::vector<std::pair<const char*, std::function<void(RenderRequest&)>>>{
            {"quality", [](RenderRequest& request) { request.generation.quality = models::Quality::Fast; }},
            {"shading", [](RenderRequest& request) { request.shading.lightFromBelow = true; }},
        };
        render("all", all());
        for (const auto& [name, change] : changes) QVERIFY2(costly(render("all", all(), change)) > 0, name);
        m_small.writeCalibration(2);
        QCOMPARE(costly(render("all", all())), 3);
        m_small.writeCalibration(1);
        QCOMPARE(costly(render("all", all())), 0);
        m_small.dataset.tactileMmPerPixel = 0.06;  // which is not that of the calibration
        QVERIFY_EXCEPTION_THROWN(render("h", all()), protocols::Error);
        m_small.dataset.tactileMmPerPixel = 0.05;
        writePng(m_small.file(1, "visual/000.png"), weave(60, 70, 12, 50));
        QCOMPARE(costly(render("all", all())), 2);  // shape from shading, and one photograph for the generators
        m_small.dataset.fabrics.front().fibre = fabrics::Fibre::Wool;
        QCOMPARE(costly(render("all", all())), 1);
        m_small.dataset.fabrics.front().fibre.reset();
        std::ofstream(fs::path(m_temporary.path().toStdString()) / "nn") << "another program";
        QCOMPARE(costly(render("all", all())), 3);
        // A lab's model may have the weights of the program and factors of its own: they stand in the card.
        const fs::path model = fs::path(m_temporary.path().toStdString()) / "lab.safetensors";
        fs::copy_file(models::shippedModel(), model);
        fs::copy_file(models::cardOf(models::shippedModel()), models::cardOf(model));
        const auto byLab = [&](RenderRequest& request) { request.generation.model = model; };
        QCOMPARE(costly(render("all", all(), byLab)), 0);
        std::ofstream(models::cardOf(model), std::ios::app) << "\n";
        QCOMPARE(costly(render("all", all(), byLab)), 3);
    }

    void damagedEntriesAreComputedAgain()
    {
        const auto first = render("all", all());
        for (const auto& entry : fs::directory_iterator(cacheFolder())) {
            std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
            file.seekp(-1, std::ios::end);
            file.put('~');
        }
        const auto again = render("all", all());
        QCOMPARE(costly(again), 9);
        compareImages(first, again);
        QCOMPARE(costly(render("all", all())), 0);
    }

    /// Entries with sound checksums whose arrays hold bytes in place of numbers: read as numbers, they would end too early.
    void arraysOfOtherTypesAreComputedAgain()
    {
        const auto first = render("all", all());
        std::vector<std::string> keys;
        for (const auto& entry : fs::directory_iterator(cacheFolder())) keys.push_back(entry.path().filename().string());
        cache::ResultCache cache(cacheFolder());
        int changed = 0;
        for (const std::string& key : keys) {
            const auto bytes = cache.find(key);
            auto result = bytes ? cache::unpacked(*bytes) : std::nullopt;
            if (!result || result->arrays.empty()) continue;
            for (cv::Mat& array : result->arrays) array = cv::Mat::ones(array.size(), CV_8UC1);
            cache.keep(key, cache::packed(*result));
            ++changed;
        }
        QCOMPARE(changed, 12);  // of 3 fabrics: generated height and friction, relief, photometric height
        const auto again = render("all", all());
        QCOMPARE(costly(again), 9);
        compareImages(first, again);
        QCOMPARE(costly(render("all", all())), 0);
    }

    void percentilesAreThoseOfAllPixelsTogether()
    {
        render("v_grey", all());
        const auto change = [](RenderRequest& request) { request.percentiles = {1, 99}; };
        const auto robust = render("v_grey", {FabricId("F01")}, change);
        QCOMPARE(robust.fabrics.keptRanges, 0);
        compareImages(render("v_grey", {FabricId("F01")},
                             [&](RenderRequest& request) {
                                 change(request);
                                 request.cache = nullptr;
                             }),
                      robust);
    }
};

QTEST_GUILESS_MAIN(CachedRenderTest)
#include "cached_render_test.moc"
