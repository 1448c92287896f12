// Losses of the networks: distances with known results, and finite losses at the extremes.
#include "rendering/models/networks/losses.h"

#include <QTest>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "rendering/models/ring_spectrum.h"
#include "rendering/models/seeing/ring_tensors.h"
#include "stats/metrics/image_metrics.h"

using namespace rendering::models;

namespace {

torch::Tensor texture(std::int64_t side, int seed)
{
    torch::manual_seed(static_cast<std::uint64_t>(seed));
    const torch::Tensor noise = torch::randn({1, 1, side + 4, side + 4});
    return torch::avg_pool2d(noise, 5, 1) + 1;
}

double number(const torch::Tensor& tensor) { return tensor.item<double>(); }

}  // namespace

class LossesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void shiftedMapIsFoundInItsWindow()
    {
        const torch::Tensor window = texture(96, 1);
        for (const auto& [down, right] : {std::pair{0, 0}, std::pair{5, 29}, std::pair{32, 32}}) {
            const torch::Tensor map = window.narrow(2, down, 64).narrow(3, right, 64) * 0.7 + 3;
            const Registered found = registered(map, window);
            QVERIFY(torch::equal(found.maps, window.narrow(2, down, 64).narrow(3, right, 64)));
            QVERIFY(std::abs(number(found.correlation) - 1) < 1e-3);
        }
    }

    void windowWithoutMarginIsTakenAsItIs()
    {
        const torch::Tensor map = texture(64, 2), other = texture(64, 3);
        QVERIFY(torch::equal(registered(map, other).maps, other));
    }

    void flatMapIsRegisteredSomewhere()
    {
        const Registered found = registered(torch::ones({2, 1, 32, 32}), texture(48, 4).expand({2, 1, 48, 48}));
        QCOMPARE(found.maps.size(3), std::int64_t{32});
        QVERIFY(torch::isfinite(found.correlation).all().item<bool>());
    }

    void ssimEqualsThatOfTheStatistics()
    {
        const torch::Tensor a = texture(64, 5), b = a * 0.8 + texture(64, 6) * 0.3;
        std::vector<double> left(64 * 64), right(64 * 64);
        for (int i = 0; i < 64 * 64; ++i) {
            left[static_cast<std::size_t>(i)] = number(a.flatten()[i]);
            right[static_cast<std::size_t>(i)] = number(b.flatten()[i]);
        }
        const stats::ImageView first{left, 64, 64}, second{right, 64, 64};
        const double expected = *stats::ssim(first, second, 2.0).mean;
        QVERIFY2(std::abs(number(ssim(a, b, 2)) - expected) < 1e-4, qPrintable(QString::number(expected)));
    }

    void placeFreeDistancesIgnoreAHalfTurnOfTheTexture()
    {
        const torch::Tensor a = texture(64, 7), turned = a.flip({2, 3});
        QVERIFY(number(sortedDistance(a, turned)) < 1e-6);
        QVERIFY(number(spectrumDistance(a, turned)) < 0.02);
        QVERIFY(number(radialDistance(a, turned)) < 0.1);
        QVERIFY(number((a - turned).abs().mean()) > 0.1);
        QVERIFY(number(radialDistance(a, a * 2 - 1)) > 1);
    }

    void lossesAreFiniteWhereTheDiscriminatorIsCertain()
    {
        for (const double certain : {-1e4, -100.0, 0.0, 100.0, 1e4}) {
            const torch::Tensor logits = torch::full({2, 1, 3, 3}, certain);
            for (const Adversary adversary : {Adversary::Paper, Adversary::Hinge}) {
                QVERIFY(std::isfinite(number(adversarialLoss(logits, adversary))));
                QVERIFY(std::isfinite(number(discriminatorLoss(logits, -logits, adversary))));
                QVERIFY(std::isfinite(number(discriminatorLoss(-logits, logits, adversary))));
            }
        }
    }

    void paperLossesFollowItsEquations()
    {
        const torch::Tensor real = torch::tensor({0.5, -1.0}), fake = torch::tensor({0.2, 2.0});
        const auto probability = [](double logit) { return 1 / (1 + std::exp(-logit)); };
        const double discriminator = -(std::log(probability(0.5)) + std::log(probability(-1.0))) / 2 -
                                     (std::log(1 - probability(0.2)) + std::log(1 - probability(2.0))) / 2;
        const double generators = -(std::log(probability(0.2)) + std::log(probability(2.0))) / 2;
        QVERIFY(std::abs(number(discriminatorLoss(real, fake, Adversary::Paper)) - discriminator) < 1e-6);
        QVERIFY(std::abs(number(adversarialLoss(fake, Adversary::Paper)) - generators) < 1e-6);
    }

    void ringsOfTensorsAreThoseOfMaps()
    {
        for (const int side : {32, 48, 128}) {
            const torch::Tensor maps = torch::cat({texture(side, 8), texture(side, 9)}, 0).contiguous();
            const torch::Tensor means = ringMeans(maps);
            for (int i = 0; i < 2; ++i) {
                const std::vector<float> powers = ringPowers(cv::Mat(side, side, CV_32F, maps[i].data_ptr<float>()), side);
                for (int ring = 0; ring < ringCount; ++ring)
                    QVERIFY(std::abs(std::log(means[i][ring].item<double>() + ringFloorMm2) -
                                     static_cast<double>(powers[static_cast<std::size_t>(ring)])) < 1e-3);
            }
        }
    }

    void distancesAreFiniteAndLearnableAtZeroAndFullHeight()
    {
        for (const double level : {0.0, 1.0}) {
            const torch::Tensor height = torch::full({2, 1, 64, 64}, level).requires_grad_();
            const FrictionOutput friction{torch::full({2, 1, 9, 7}, -9.0), torch::full({2, 1}, 1e-4)};
            const torch::Tensor rings = torch::zeros({2, ringCount});
            const BatchSignals generated{height, rings, friction},
                measured{texture(64, 8).expand({2, 1, 64, 64}), rings, friction};
            const torch::Tensor apart = distance(generated, measured, defaultWeights(), {});
            QVERIFY(std::isfinite(number(apart)));
            apart.backward();
            QVERIFY(torch::isfinite(height.grad()).all().item<bool>());
        }
    }

    void boundedConvolutionHasAGainOfOne()
    {
        torch::manual_seed(3);
        BoundedConvolution layer(6, 8, std::vector<std::int64_t>{1, 1}, 1, true);
        const torch::NoGradGuard still;
        for (torch::Tensor& parameter : layer->parameters()) parameter.mul_(parameter.dim() == 4 ? 20 : 0);
        const torch::Tensor input = torch::randn({64, 6, 1, 1});
        for (int i = 0; i < 50; ++i) layer->forward(input);
        const torch::Tensor gains = layer->forward(input).flatten(1).norm(2, 1) / input.flatten(1).norm(2, 1);
        QVERIFY2(number(gains.max()) < 1.001 && number(gains.max()) > 0.6, qPrintable(QString::number(number(gains.max()))));
    }
};

QTEST_APPLESS_MAIN(LossesTest)
#include "losses_test.moc"
