// The mean friction that a texture lets expect, for photographs like none in training.
#include "rendering/models/friction_prior.h"

#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/random.h"

using namespace rendering::models;

namespace {

constexpr int side = 128;

/// A cloth without a direction, of threads about so many px thick, more or less pronounced.
cv::Mat cloth(double threadPx, double contrast, std::uint64_t seed, int rows = 256, int columns = 256, double brightness = 150)
{
    protocols::Random random(seed);
    cv::Mat noise(rows, columns, CV_32F), rgb;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) noise.at<float>(row, column) = static_cast<float>(random.normal());
    cv::GaussianBlur(noise, noise, {}, threadPx / 3);
    cv::Scalar mean, deviation;
    cv::meanStdDev(noise, mean, deviation);
    noise = (noise - mean[0]) * (contrast / std::max(1e-9, deviation[0]));
    cv::Mat(brightness * (noise + 1)).convertTo(rgb, CV_8U);
    cv::cvtColor(rgb, rgb, cv::COLOR_GRAY2RGB);
    return rgb;
}

/// Fabrics whose friction grows with the contrast of their threads: 0.2 at 0.05, 0.4 at 0.2.
double frictionOf(double contrast) { return 0.2 * std::sqrt(contrast / 0.05); }

FrictionPrior learnt()
{
    std::vector<KnownTexture> textures;
    std::uint64_t seed = 0;
    for (const double thread : {4.0, 6.0, 9.0})
        for (const double contrast : {0.05, 0.1, 0.15, 0.2})
            textures.push_back({textureCoefficients(cloth(thread, contrast, ++seed), side), std::log(frictionOf(contrast))});
    return fitFrictionPrior(textures);
}

}  // namespace

class FrictionPriorTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void fabricNeverSeenGetsTheFrictionOfItsTexture()
    {
        const FrictionPrior prior = learnt();
        for (const double thread : {5.0, 7.5})
            for (const double contrast : {0.07, 0.12, 0.18}) {
                const double expected = expectedFriction(prior, textureCoefficients(cloth(thread, contrast, 99), side));
                QVERIFY2(std::abs(expected / frictionOf(contrast) - 1) < 0.12, qPrintable(QString::number(expected)));
            }
    }

    void noAnswerLiesBeyondWhatWasTrainedOn()
    {
        const FrictionPrior prior = learnt();
        for (const cv::Mat& rgb :
             {cloth(6, 0.001, 1), cloth(6, 2, 2), cloth(1, 0.5, 3), cv::Mat(256, 256, CV_8UC3, cv::Scalar::all(0))}) {
            const double expected = expectedFriction(prior, textureCoefficients(rgb, side));
            QVERIFY(expected >= 0.2 * 0.999 && expected <= 0.4 * 1.001);
        }
    }

    void beyondAllKnownThingsTheTypicalFrictionIsExpected()
    {
        QCOMPARE(reachOfRegression(3.9, 1), 1.0);
        QVERIFY(std::abs(reachOfRegression(10, 2) - 0.5) < 1e-12);
        QCOMPARE(reachOfRegression(7, 1), 0.0);
        const FrictionPrior prior = learnt();
        const std::vector<double> smooth = textureCoefficients(cloth(5, 0.06, 11), side);
        const double typical = std::exp(prior.logFriction);
        QVERIFY(expectedFriction(prior, smooth) < 0.9 * typical);
        QVERIFY(std::abs(expectedFriction(prior, smooth, 0) - typical) < 1e-12);
        const double half = expectedFriction(prior, smooth, 0.5);
        QVERIFY(half > expectedFriction(prior, smooth) && half < typical);
    }

    void brightnessOfTheLampDoesNotCount()
    {
        const std::vector<double> bright = textureCoefficients(cloth(6, 0.1, 4), side);
        const std::vector<double> dark = textureCoefficients(cloth(6, 0.1, 4, 256, 256, 70), side);
        for (int i = 0; i < textureCoefficientCount; ++i)
            QVERIFY2(std::abs(bright[static_cast<std::size_t>(i)] - dark[static_cast<std::size_t>(i)]) < 0.1,
                     qPrintable(QString::number(i)));
    }

    void anyPictureHasCoefficients()
    {
        for (const cv::Mat& rgb : {cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(255)), cv::Mat(300, 2, CV_8UC3, cv::Scalar::all(0)),
                                   cloth(6, 0.2, 5, 130, 700)})
            for (const double coefficient : textureCoefficients(rgb, side)) QVERIFY(std::isfinite(coefficient));
    }

    void fabricPhotographedTenTimesCountsAsMuchAsOneOfOnePhotograph()
    {
        const std::vector<double> coarse = textureCoefficients(cloth(9, 0.2, 1), side),
                                  fine = textureCoefficients(cloth(4, 0.05, 2), side);
        std::vector<KnownTexture> textures(10, {coarse, std::log(0.4), 0.1});
        textures.push_back({fine, std::log(0.2), 1});
        const FrictionPrior equal = fitFrictionPrior(std::vector<KnownTexture>{{coarse, std::log(0.4)}, {fine, std::log(0.2)}});
        const FrictionPrior many = fitFrictionPrior(textures);
        QVERIFY(std::abs(many.logFriction - equal.logFriction) < 1e-9);
        for (std::size_t i = 0; i < equal.slope.size(); ++i) QVERIFY(std::abs(many.slope[i] - equal.slope[i]) < 1e-9);
    }

    void oneFabricAnswersWithItsOwnFriction()
    {
        const FrictionPrior prior =
            fitFrictionPrior(std::vector<KnownTexture>{{textureCoefficients(cloth(6, 0.1, 6), side), std::log(0.33)}});
        QVERIFY(std::abs(expectedFriction(prior, textureCoefficients(cloth(9, 0.2, 7), side)) - 0.33) < 1e-9);
        for (const double slope : prior.slope) QCOMPARE(slope, 0.0);
        QVERIFY_THROWS_EXCEPTION(protocols::Error, fitFrictionPrior({}));
    }

    void writtenIsReadBackAndNonsenseRefused()
    {
        const FrictionPrior prior = learnt();
        auto json = frictionPriorJson(prior);
        const FrictionPrior again = frictionPriorFrom(nlohmann::ordered_json::parse(json.dump()));
        const std::vector<double> texture = textureCoefficients(cloth(5, 0.1, 8), side);
        QCOMPARE(expectedFriction(again, texture), expectedFriction(prior, texture));
        json["slope"].erase(0);
        QVERIFY_THROWS_EXCEPTION(protocols::Error, frictionPriorFrom(json));
        json = frictionPriorJson(prior);
        json["lowest"] = 1;
        json["highest"] = -1;
        QVERIFY_THROWS_EXCEPTION(protocols::Error, frictionPriorFrom(json));
        json = frictionPriorJson(prior);
        json["coefficients_sd"][1] = 0;
        QVERIFY_THROWS_EXCEPTION(protocols::Error, frictionPriorFrom(json));
    }
};

QTEST_APPLESS_MAIN(FrictionPriorTest)
#include "friction_prior_test.moc"
