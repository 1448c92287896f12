// Unfamiliar photographs are distinguished from other places on known fabrics.
#include "rendering/models/familiarity.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/images/image_png.h"
#include "rendering/models/photograph_features.h"
#include "rendering/models/ring_spectrum.h"
#include "tests/rendering/shared_data.h"

using namespace rendering;
using models::Familiarity;
using Features = std::vector<float>;

namespace {

Features plain(float value) { return Features(static_cast<std::size_t>(models::photographFeatureCount), value); }

}  // namespace

class FamiliarityTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    std::vector<Features> m_training, m_validation, m_elsewhere;
    Familiarity m_familiarity;

private Q_SLOTS:
    void initTestCase()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 6;
        options.samples = 12;
        options.seed = 12;
        const auto dataset = fabrics::makeProceduralFabrics(m_folder.filePath("fabrics").toStdString(), options);
        for (const fabrics::FabricInfo& fabric : dataset.fabrics)
            for (int index = 0; index < 12; ++index)
                (index < 7    ? m_training
                 : index < 10 ? m_validation
                              : m_elsewhere)
                    .push_back(models::photographFeatures(fabrics::readPhotograph(dataset, fabric.id, index)));
        m_familiarity = models::fitFamiliarity(m_training, m_validation);
    }

    void trainingPhotographsLieAtDistanceZero()
    {
        for (const Features& features : m_training)
            QVERIFY(models::recognised(m_familiarity, features).distance < 0.01);  // Four digits are kept.
    }

    void otherPlacesOnKnownFabricsAreFamiliar()
    {
        int strange = 0;
        for (const Features& features : m_elsewhere)
            strange += models::recognised(m_familiarity, features).distance > m_familiarity.threshold ? 1 : 0;
        QVERIFY2(strange <= 1, qPrintable(QString::number(strange)));
        for (const Features& features : m_validation)
            QVERIFY(models::recognised(m_familiarity, features).distance <= m_familiarity.threshold * 1.001);
    }

    void picturesOfOtherThingsAreNot()
    {
        cv::Mat noise(256, 256, CV_8UC3), halves(256, 256, CV_8UC3, cv::Scalar::all(30));
        cv::theRNG().state = 5;
        cv::randu(noise, 0, 256);
        halves.colRange(128, 256).setTo(cv::Scalar::all(220));
        for (const cv::Mat& picture : {noise, halves, cv::Mat(256, 256, CV_8UC3, cv::Scalar::all(0))}) {
            const double distance = models::recognised(m_familiarity, models::photographFeatures(picture)).distance;
            QVERIFY2(std::isfinite(distance) && distance > 1.5 * m_familiarity.threshold, qPrintable(QString::number(distance)));
        }
    }

    void realFabricsDifferFromProceduralOnes()
    {
        const auto folder = sharedData("fabricbtdf_photos");
        if (!std::filesystem::exists(folder)) QSKIP("the shared data do not exist");
        for (const char* name : {"twill1_R.png", "twill3_R.png", "satin1_R.png", "satin2_R.png"})
            QVERIFY(models::recognised(m_familiarity, models::photographFeatures(readPng(folder / name))).distance >
                    m_familiarity.threshold);
    }

    void aFewHundredAreKeptAndTheRareAmongThem()
    {
        std::vector<Features> many;
        for (int i = 0; i < 1000; ++i) {
            Features features = plain(static_cast<float>(i % 500) * 0.01F);
            features[3] = static_cast<float>(i % 7);
            many.push_back(features);
        }
        Features rare = plain(1);
        rare[0] = 90;
        many[777] = rare;
        const Familiarity kept = models::fitFamiliarity(many, {});
        QCOMPARE(static_cast<int>(kept.nearest.size()), models::mostPhotographsKept);
        QVERIFY(models::recognised(kept, rare).distance < 0.01);
        QCOMPARE(models::fitFamiliarity(many, {}), kept);
        QCOMPARE(models::fitFamiliarity(many, std::span(many).first(1)).nearest, kept.nearest);
    }

    void ninetyNineOfAHundredLieBelowTheThreshold()
    {
        const std::vector<Features> training{plain(-1), plain(1)};  // Mean 0 and deviation 1 of each feature.
        std::vector<Features> validation;
        for (int i = 1; i <= 200; ++i) {
            validation.push_back(plain(1));
            validation.back()[0] = 1 + static_cast<float>(i);
        }
        QCOMPARE(models::fitFamiliarity(training, validation).threshold, 198.0);
    }

    void onePhotographIsEnough()
    {
        const std::vector<Features> one{plain(0.5F)};
        const Familiarity familiarity = models::fitFamiliarity(one, {});
        QCOMPARE(familiarity.nearest.size(), std::size_t{1});
        QVERIFY(familiarity.threshold > 0);
        QCOMPARE(models::recognised(familiarity, one[0]).distance, 0.0);
        QVERIFY(std::isfinite(models::recognised(familiarity, plain(7)).distance));
    }

    void similarPhotographGetsTheRingsOfItsFabric()
    {
        // Two fabrics far apart; the second one has two photographs.
        const std::vector<Features> training{plain(-1), plain(1), plain(1.02F)};
        const models::KnownFabrics fabrics{
            {0, 1, 1}, {std::vector<double>(models::ringCount, -4), std::vector<double>(models::ringCount, -9)}};
        const Familiarity familiarity = models::fitFamiliarity(training, training, fabrics);
        const models::Recognised first = models::recognised(familiarity, plain(-0.99F)),
                                 second = models::recognised(familiarity, plain(1.01F));
        QCOMPARE(first.unfamiliarity, 0.0);
        QCOMPARE(first.rings.size(), std::size_t{models::ringCount});
        for (int ring = 0; ring < models::ringCount; ++ring) {
            QVERIFY(std::abs(first.rings[static_cast<std::size_t>(ring)] + 4) < 1e-3);
            QVERIFY(std::abs(second.rings[static_cast<std::size_t>(ring)] + 9) < 1e-3);
        }
        // A photograph at equal distance from both gets the mean of both.
        const models::Recognised neither = models::recognised(familiarity, plain(0));
        QVERIFY(neither.rings[0] < -4 && neither.rings[0] > -9);
        QVERIFY(models::recognised(models::fitFamiliarity(training, {}), plain(1)).rings.empty());
    }

    void unfamiliarityGrowsFromTheUsualDistanceToTwiceIt()
    {
        const std::vector<Features> training{plain(-1), plain(1)};
        const Familiarity familiarity = models::fitFamiliarity(training, training);  // The threshold is its minimum, 1.
        const auto strangenessAt = [&](double distance) {
            Features features = plain(1);
            features[4] += static_cast<float>(distance);
            return models::recognised(familiarity, features).unfamiliarity;
        };
        QCOMPARE(familiarity.threshold, 1.0);
        QCOMPARE(strangenessAt(0.9), 0.0);
        QVERIFY(std::abs(strangenessAt(1.5) - 0.5) < 0.01);
        QCOMPARE(strangenessAt(2.5), 1.0);
    }

    void ringsAreReadBackAndNonsenseIsRefused()
    {
        const std::vector<Features> training{plain(-1), plain(1)};
        const models::KnownFabrics fabrics{
            {0, 1}, {std::vector<double>(models::ringCount, -4), std::vector<double>(models::ringCount, -9)}};
        const Familiarity familiarity = models::fitFamiliarity(training, {}, fabrics);
        auto json = models::familiarityJson(familiarity);
        QCOMPARE(models::familiarityFrom(json), familiarity);
        const auto harmed = [&](const char* key, const nlohmann::ordered_json& value) {
            auto other = json;
            other[key] = value;
            return other;
        };
        QVERIFY_THROWS_EXCEPTION(protocols::Error, models::familiarityFrom(harmed("fabric_of", {0, 2})));
        QVERIFY_THROWS_EXCEPTION(protocols::Error, models::familiarityFrom(harmed("fabric_of", {0})));
        QVERIFY_THROWS_EXCEPTION(protocols::Error, models::familiarityFrom(harmed("fabric_rings", {{1, 2}, {3, 4}})));
    }

    void writtenIsReadBack()
    {
        const auto text = models::familiarityJson(m_familiarity).dump();
        QCOMPARE(models::familiarityFrom(nlohmann::ordered_json::parse(text)), m_familiarity);
        QVERIFY(text.size() / m_familiarity.nearest.size() < 22 * 12);  // A card of a few hundred photographs stays small.
    }

    void nonsenseIsRefused_data()
    {
        QTest::addColumn<QString>("harm");
        for (const char* harm :
             {"features_mean short", "features_sd zero", "nearest none", "nearest short", "threshold negative"})
            QTest::newRow(harm) << harm;
    }

    void nonsenseIsRefused()
    {
        QFETCH(QString, harm);
        auto json = models::familiarityJson(m_familiarity);
        if (harm == "features_mean short") json["features_mean"].erase(0);
        if (harm == "features_sd zero") json["features_sd"][3] = 0;
        if (harm == "nearest none") json["nearest"].clear();
        if (harm == "nearest short") json["nearest"][1].erase(0);
        if (harm == "threshold negative") json["threshold"] = -1;
        QVERIFY_THROWS_EXCEPTION(protocols::Error, models::familiarityFrom(json));
    }

    void wrongFeaturesAreRefused()
    {
        QVERIFY_THROWS_EXCEPTION(protocols::Error, models::fitFamiliarity({}, {}));
        QVERIFY_THROWS_EXCEPTION(protocols::Error, models::recognised(m_familiarity, Features(3)).distance);
    }
};

QTEST_GUILESS_MAIN(FamiliarityTest)
#include "familiarity_test.moc"
