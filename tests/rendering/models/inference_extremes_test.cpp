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
#include "rendering/models/photograph_features.h"
#include "rendering/models/ring_spectrum.h"

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
    fs::path withCard(const char* name, const std::function<void(models::ModelCardFields&)>& change) const
    {
        const fs::path model = m_folder.filePath(name).toStdString();
        fs::copy_file(models::shippedModel(), model, fs::copy_options::overwrite_existing);
        auto card = models::readModelCardFields(models::shippedModel());
        change(card);
        protocols::writeWholeFile(models::cardOf(model), models::cardText(card));
        return model;
    }

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

    void cardsWithPhotographsRecogniseUnfamiliarOnes()
    {
        const fs::path model = m_folder.filePath("model.safetensors").toStdString();
        fs::copy_file(models::shippedModel(), model);
        auto card = models::readModelCardFields(models::shippedModel());
        std::vector<std::vector<float>> known;
        for (std::size_t fabric = 0; fabric < 3; ++fabric)
            for (int index = 0; index < 3; ++index)
                known.push_back(models::photographFeatures(photograph(fabric, index).photograph));
        card.photographs = models::fitFamiliarity(known, {});
        protocols::writeWholeFile(models::cardOf(model), models::cardText(card));
        QCOMPARE(models::readModelCardFields(model).photographs, card.photographs);

        GenerationOptions options = fast();
        options.model = model;
        const cv::Mat black(300, 200, CV_8UC3, cv::Scalar::all(0));
        const auto answers = generated({photograph(0), {black, std::nullopt}}, options);
        QVERIFY(!answers[0].photograph.unfamiliar() && *answers[0].photograph.distance < 0.1);
        QVERIFY(answers[1].photograph.unfamiliar());
        QCOMPARE(answers[1].photograph.usualDistance, card.photographs->threshold);
        const cv::Mat seen = models::photographAtPitch(photograph(0), card.architecture.mmPerPixel).rgb;
        QCOMPARE(*answers[0].photograph.distance,
                 models::recognised(*card.photographs, models::photographFeatures(seen)).distance);
    }

    void knownFabricDeterminesTheRoughnessOfAKnownPhotograph()
    {
        // One fabric is known; its waves have four times the power (twice the height) in one of two cards.
        const auto shipped = models::readModelCardFields(models::shippedModel());
        const std::vector<std::vector<float>> known{models::photographFeatures(photograph(0).photograph)};
        const std::vector<double> rings = models::recognised(*shipped.photographs, known[0]).rings;
        const auto reliefAt = [&](double strength) {
            GenerationOptions options = fast();
            options.model = withCard("remembering.safetensors", [&](models::ModelCardFields& card) {
                std::vector<double> stronger = rings;
                for (double& ring : stronger) ring += std::log(strength);
                card.photographs = models::fitFamiliarity(known, {}, {{0}, {stronger}});
            });
            cv::Scalar mean, deviation;
            cv::meanStdDev(generated({photograph(0)}, options).front().heightMm, mean, deviation);
            return deviation[0];
        };
        const double ratio = reliefAt(1) / reliefAt(0.25);
        QVERIFY2(ratio > 1.8 && ratio < 2.2, qPrintable(QString::number(ratio)));
    }

    void frictionOfAnUnfamiliarPhotographFollowsItsTexture()
    {
        models::FrictionPrior always;  // 0.77 for every texture.
        const auto count = static_cast<std::size_t>(models::textureCoefficientCount);
        always.mean = always.slope = std::vector<double>(count, 0);
        always.deviation = std::vector<double>(count, 1);
        always.logFriction = always.lowest = always.highest = std::log(0.77);
        GenerationOptions options = fast();
        options.model = withCard("expecting.safetensors", [&](models::ModelCardFields& card) {
            card.photographs =
                models::fitFamiliarity(std::vector<std::vector<float>>{models::photographFeatures(photograph(0).photograph)}, {});
            card.frictionByTexture = always;
        });
        cv::Mat noise(256, 256, CV_8UC3);
        cv::theRNG().state = 8;
        cv::randu(noise, 0, 256);
        const auto answers = generated({photograph(0), {noise, photograph(0).mmPerPixel}}, options);
        QVERIFY(*answers[1].photograph.distance > 2 * answers[1].photograph.usualDistance);
        QVERIFY(std::abs(answers[1].meanFriction - 0.77) < 1e-5);
        QVERIFY2(std::abs(answers[0].meanFriction - 0.77) > 0.1, "the network must decide for a known photograph");
        // The network alone gives another value; at half unfamiliarity the result lies half-way (in logarithms).
        const double farAway = *answers[1].photograph.distance;
        const auto meanAt = [&](double strangeness) {
            options.model = withCard("half-way.safetensors", [&](models::ModelCardFields& card) {
                card.photographs = models::fitFamiliarity(
                    std::vector<std::vector<float>>{models::photographFeatures(photograph(0).photograph)}, {});
                card.photographs->threshold = farAway / (1 + strangeness);
                card.frictionByTexture = always;
            });
            return generated({{noise, photograph(0).mmPerPixel}}, options).front().meanFriction;
        };
        const double alone = meanAt(0);
        QVERIFY(std::abs(std::log(alone / 0.77)) > 0.1);
        QVERIFY(std::abs(meanAt(0.5) / std::sqrt(alone * 0.77) - 1) < 1e-3);
    }

    void knownFabricsDoNotAffectAnUnfamiliarPhotograph()
    {
        cv::Mat noise(256, 256, CV_8UC3);
        cv::theRNG().state = 8;
        cv::randu(noise, 0, 256);
        const auto deviationWith = [&](double strangeness, bool remembering) {
            GenerationOptions options = fast();
            options.model = withCard("stranger.safetensors", [&](models::ModelCardFields& card) {
                const std::vector<std::vector<float>> known{models::photographFeatures(photograph(0).photograph)};
                const models::KnownFabrics flat{{0}, {std::vector<double>(models::ringCount, -13)}};
                card.photographs = models::fitFamiliarity(known, {}, remembering ? flat : models::KnownFabrics{});
                card.photographs->threshold =
                    models::recognised(*card.photographs, models::photographFeatures(noise)).distance / (1 + strangeness);
            });
            cv::Scalar mean, deviation;
            cv::meanStdDev(generated({{noise, photograph(0).mmPerPixel}}, options).front().heightMm, mean, deviation);
            return deviation[0];
        };
        const double network = deviationWith(1.2, false), half = deviationWith(0.5, true), memory = deviationWith(0, true);
        QVERIFY(std::abs(deviationWith(1.2, true) / network - 1) < 1e-5);
        QVERIFY2(memory < 0.8 * half && half < 0.8 * network, qPrintable(QString("%1 %2 %3").arg(memory).arg(half).arg(network)));
    }

    void unevenLightIsDividedOut()
    {
        cv::Mat even(400, 600, CV_8UC3), lamp(400, 600, CV_8UC3);
        cv::theRNG().state = 3;
        cv::randu(even, 90, 150);
        for (int row = 0; row < lamp.rows; ++row)
            for (int column = 0; column < lamp.cols; ++column)
                for (int channel = 0; channel < 3; ++channel)
                    lamp.at<cv::Vec3b>(row, column)[channel] = cv::saturate_cast<uchar>(
                        even.at<cv::Vec3b>(row, column)[channel] * (1.2 - 0.8 * std::hypot(column - 300.0, row - 200.0) / 360));
        const auto edgeOverMiddle = [](const cv::Mat& rgb) {
            return cv::mean(rgb({0, 0, 100, 100}))[1] / cv::mean(rgb({250, 150, 100, 100}))[1];
        };
        QVERIFY(edgeOverMiddle(lamp) < 0.6);
        const cv::Mat lit = models::evenlyLit(lamp);
        QVERIFY2(edgeOverMiddle(lit) > 0.75 && edgeOverMiddle(lit) < 1.1, qPrintable(QString::number(edgeOverMiddle(lit))));
        QVERIFY(std::abs(cv::mean(lit)[0] / cv::mean(lamp)[0] - 1) < 0.1);
        cv::absdiff(models::evenlyLit(even), even, even);
        QVERIFY(cv::mean(even)[0] < 3);
    }

    void unknownPhotographsAreSeenAtTheModelsPitch()
    {
        // The same cloth at twice the resolution is equally familiar if its pitch is known.
        const auto card = models::readModelCardFields(models::shippedModel());
        cv::Mat fine;
        cv::resize(photograph(0).photograph, fine, {}, 2, 2, cv::INTER_CUBIC);
        const auto familiarity =
            models::fitFamiliarity(std::vector<std::vector<float>>{models::photographFeatures(photograph(0).photograph),
                                                                   models::photographFeatures(photograph(1).photograph)},
                                   {});
        const auto distance = [&](std::optional<double> mmPerPixel) {
            return models::recognised(familiarity,
                                      models::photographFeatures(
                                          models::photographAtPitch({fine, mmPerPixel}, card.architecture.mmPerPixel).rgb))
                .distance;
        };
        QVERIFY(distance(card.architecture.mmPerPixel / 2) < 0.5 * distance(std::nullopt));
    }
};

QTEST_GUILESS_MAIN(InferenceExtremesTest)
#include "inference_extremes_test.moc"
