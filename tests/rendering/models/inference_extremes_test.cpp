// Unusual photographs from a laboratory: very large, very long, grey, many at once, of unknown objects.
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/whole_file.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/fabrics/recordings/import.h"
#include "rendering/images/image_png.h"
#include "rendering/models/generation.h"
#include "rendering/models/model_card_fields.h"
#include "rendering/models/photograph_at_pitch.h"

using namespace rendering;
using models::GeneratedSignals;
using models::GenerationOptions;
using models::InputPhotograph;
namespace fs = std::filesystem;

namespace {

GenerationOptions fast()
{
    GenerationOptions options;
    options.quality = models::Quality::Fast;
    return options;
}

std::vector<GeneratedSignals> generated(const std::vector<InputPhotograph>& photographs,
                                        const GenerationOptions& options = fast())
{
    return models::generate(photographs, options);
}

void verifyEqual(const GeneratedSignals& a, const GeneratedSignals& b)
{
    QCOMPARE(a.heightMm.size(), b.heightMm.size());
    QCOMPARE(cv::norm(a.heightMm, b.heightMm, cv::NORM_INF), 0.0);
    QCOMPARE(cv::norm(a.spectrogram, b.spectrogram, cv::NORM_INF), 0.0);
    QCOMPARE(a.trace, b.trace);
    QCOMPARE(a.meanFriction, b.meanFriction);
    QCOMPARE(a.photograph, b.photograph);
}

void verifyFinite(const GeneratedSignals& signals)
{
    QVERIFY(cv::checkRange(signals.heightMm, true, nullptr, 0, 100));
    QVERIFY(cv::checkRange(signals.spectrogram, true, nullptr, 0, 1e6));
    QVERIFY(std::isfinite(signals.meanFriction) && signals.meanFriction > 0);
    for (const double value : signals.trace) QVERIFY(std::isfinite(value));
}

}  // namespace

class InferenceExtremesTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fabrics::Dataset m_dataset;

    InputPhotograph photograph(std::size_t fabric, int index = 0) const
    {
        return {fabrics::readPhotograph(m_dataset, m_dataset.fabrics[fabric].id, index), m_dataset.cameraMmPerPixel};
    }

    /// Texture, so that a part from another place gives another map.
    cv::Mat large(int width, int height) const
    {
        cv::Mat picture(height, width, CV_8UC3);
        const cv::Mat tile = photograph(1).photograph;
        for (int y = 0; y < height; y += tile.rows)
            for (int x = 0; x < width; x += tile.cols) {
                const cv::Rect part(x, y, std::min(tile.cols, width - x), std::min(tile.rows, height - y));
                cv::Mat(tile({0, 0, part.width, part.height}) * (0.5 + 0.5 * x / width)).copyTo(picture(part));
            }
        return picture;
    }

    /// The weights of the program with a changed card.

private Q_SLOTS:
    void initTestCase()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 4;
        options.samples = 3;
        options.seed = 21;
        m_dataset = fabrics::makeProceduralFabrics(m_folder.filePath("fabrics").toStdString(), options);
    }

    void manyAtOnceEqualEachByItself()
    {
        const cv::Mat odd = large(300, 77);
        const std::vector<InputPhotograph> photographs{
            photograph(0), {odd, std::nullopt}, photograph(2), {odd, 0.1}, photograph(0)};
        GenerationOptions balanced;
        const auto together = generated(photographs, balanced);
        for (std::size_t i = 0; i < photographs.size(); ++i)
            verifyEqual(generated({photographs[i]}, balanced).front(), together[i]);
        verifyEqual(together[0], together[4]);
    }

    void largePhotographsAreCutToTheirMiddle_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<int>("height");
        QTest::newRow("long") << 5000 << 1;
        QTest::newRow("high") << 3 << 5000;
        QTest::newRow("wide") << 2600 << 130;
        QTest::newRow("8000 x 8000") << 8000 << 8000;
    }

    void largePhotographsAreCutToTheirMiddle()
    {
        QFETCH(int, width);
        QFETCH(int, height);
        const cv::Mat whole = large(width, height);
        const cv::Size shown(std::min(width, models::largestSidePx), std::min(height, models::largestSidePx));
        const cv::Mat middle = whole({(width - shown.width) / 2, (height - shown.height) / 2, shown.width, shown.height});
        const bool isHuge = shown.area() > 1000000;  // A single pass is slow enough.
        const auto answers =
            isHuge ? generated({{whole, std::nullopt}}) : generated({{whole, std::nullopt}, {middle, std::nullopt}});
        QCOMPARE(answers[0].heightMm.cols, shown.width);
        QCOMPARE(answers[0].heightMm.rows, shown.height);
        QVERIFY(answers[0].photograph.middleOnly);
        verifyFinite(answers[0]);
        if (isHuge) return;
        QVERIFY(!answers[1].photograph.middleOnly);
        QCOMPARE(cv::norm(answers[0].heightMm, answers[1].heightMm, cv::NORM_INF), 0.0);
        QCOMPARE(answers[0].trace, answers[1].trace);
    }

    void pitchIsScaledBeforeTheCut()
    {
        const cv::Mat fine = large(3000, 200);
        const auto seen = models::photographAtPitch({fine, 0.025}, 0.05);
        QCOMPARE(seen.rgb.size(), cv::Size(1500, 100));
        QVERIFY(!seen.middleOnly);
        const auto coarse = models::photographAtPitch({fine, 0.1}, 0.05);
        QCOMPARE(coarse.rgb.size(), cv::Size(2048, 400));
        QVERIFY(coarse.middleOnly);
        cv::Mat expected;
        cv::resize(fine.colRange(988, 2012), expected, {2048, 400}, 0, 0, cv::INTER_CUBIC);
        QCOMPARE(cv::norm(coarse.rgb, expected, cv::NORM_INF), 0.0);
        for (const double extreme : {2e-5, 99.0}) {
            const auto some = models::photographAtPitch({fine, extreme}, 0.05);
            QVERIFY(some.rgb.cols >= 1 && some.rgb.cols <= models::largestSidePx && some.rgb.rows >= 1);
        }
    }

    void greyPhotographsAreAccepted()
    {
        const fs::path photos = m_folder.filePath("grey").toStdString();
        fs::create_directories(photos);
        cv::Mat grey, colour;
        cv::cvtColor(photograph(1).photograph, grey, cv::COLOR_RGB2GRAY);
        cv::cvtColor(grey, colour, cv::COLOR_GRAY2RGB);
        writePng(photos / "drill_1.png", grey);  // A file with one channel.
        fabrics::ImportRequest request;
        request.from = {photos};
        request.out = m_folder.filePath("imported").toStdString();
        fabrics::importRecordings(request);
        const auto imported = fabrics::readDataset(request.out);
        const auto answers =
            generated({{colour, std::nullopt}, {fabrics::readPhotograph(imported, imported.fabrics[0].id, 0), std::nullopt}});
        verifyFinite(answers[0]);
        QCOMPARE(cv::norm(answers[0].heightMm, answers[1].heightMm, cv::NORM_INF), 0.0);
        const auto coloured = generated({photograph(1)}).front();
        QVERIFY(std::abs(answers[0].meanFriction / coloured.meanFriction - 1) < 0.5);
    }
};

QTEST_GUILESS_MAIN(InferenceExtremesTest)
#include "inference_extremes_test.moc"
