// SSIM and its variants against long double and scikit-image, its invariants, and registration.
#include "stats/metrics/image_metrics.h"

#include <QTest>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "stats/metrics/registered_ssim.h"
#include "tests/stats/exact_numbers.h"
#include "tests/stats/stream.h"

namespace {

struct Image {
    std::vector<double> values;
    std::size_t width = 0;
    std::size_t height = 0;
    stats::ImageView view() const { return {values, width, height}; }
    std::vector<float> floats() const { return {values.begin(), values.end()}; }
};

/// Deterministic noise between 0 and 1.
double noise(std::uint64_t k, std::uint64_t factor, std::uint64_t offset)
{
    return static_cast<double>((k * factor + offset) % 4294967296U) / 4294967296.0;
}

std::pair<Image, Image> recipe()
{
    Image a{std::vector<double>(800 * 1280), 1280, 800};
    Image b = a;
    for (std::size_t k = 0; k < a.values.size(); ++k) {
        a.values[k] = noise(k, 2654435761U, 12345);
        b.values[k] = 0.8 * a.values[k] + 0.2 * noise(k, 3266489917U, 99);
    }
    return {a, b};
}

Image patch(std::size_t width, std::size_t height, double offset, double scale, std::uint64_t seed)
{
    Image image{std::vector<double>(width * height), width, height};
    for (std::size_t k = 0; k < image.values.size(); ++k)
        image.values[k] = offset + scale * noise(k, 2654435761U + 1234567890U * seed, 12345 * seed);
    return image;
}

/// SSIM by its definition, window by window, in two passes of long double.
double directSsim(const Image& a, const Image& b, double range)
{
    std::array<long double, 11> w{};
    for (int i = 0; i < 11; ++i) w[static_cast<std::size_t>(i)] = std::exp(-(i - 5) * (i - 5) / 4.5L);
    long double whole = 0;
    for (const long double x : w)
        for (const long double y : w) whole += x * y;
    const long double c1 = 0.0001L * range * range;
    const long double c2 = 0.0009L * range * range;
    long double sum = 0;
    for (std::size_t top = 0; top + 11 <= a.height; ++top)
        for (std::size_t left = 0; left + 11 <= a.width; ++left) {
            long double meanA = 0, meanB = 0, varianceA = 0, varianceB = 0, covariance = 0;
            const auto visit = [&](const auto& add) {
                for (std::size_t y = 0; y < 11; ++y)
                    for (std::size_t x = 0; x < 11; ++x) {
                        const std::size_t k = (top + y) * a.width + left + x;
                        add(w[x] * w[y] / whole, static_cast<long double>(a.values[k]), static_cast<long double>(b.values[k]));
                    }
            };
            visit([&](long double weight, long double p, long double q) { meanA += weight * p, meanB += weight * q; });
            visit([&](long double weight, long double p, long double q) {
                varianceA += weight * (p - meanA) * (p - meanA);
                varianceB += weight * (q - meanB) * (q - meanB);
                covariance += weight * (p - meanA) * (q - meanB);
            });
            sum += (2 * meanA * meanB + c1) * (2 * covariance + c2) /
                   ((meanA * meanA + meanB * meanB + c1) * (varianceA + varianceB + c2));
        }
    return static_cast<double>(sum / ((a.height - 10) * (a.width - 10)));
}

}  // namespace

class ImageMetricsTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    // Reference: every window by itself in numpy's longdouble.
    void speedImageAgreesWithItsTruth()
    {
        const auto [a, b] = recipe();
        const auto result = stats::ssim(a.view(), b.view(), 1);
        QVERIFY(std::fabs(*result.mean - 0.9528596586430464) < 1e-12);
        QVERIFY(std::fabs(*result.smallest - 0.9364900298644718) < 1e-12);
        QVERIFY(std::fabs(*result.largest - 0.9706141016930597) < 1e-12);
    }

    void sameImageIsExactlyOne_data()
    {
        QTest::addColumn<double>("offset");
        QTest::addColumn<double>("range");
        QTest::newRow("plain") << 0.0 << 1.0;
        QTest::newRow("offset 1e8") << 1e8 << 1.0;
        QTest::newRow("8 bit") << 100.0 << 255.0;
        QTest::newRow("tiny range") << 0.0 << 1e-12;
    }

    void sameImageIsExactlyOne()
    {
        QFETCH(double, offset);
        QFETCH(double, range);
        const Image image = patch(90, 47, offset, range, 7);
        QVERIFY(*stats::ssim(image.view(), image.view(), range).mean == 1.0);
    }

    void orderOfTheImagesDoesNotMatter()
    {
        const Image a = patch(70, 40, 3, 1, 1);
        const Image b = patch(70, 40, 3, 1, 2);
        const auto ab = stats::ssim(a.view(), b.view(), 1);
        const auto ba = stats::ssim(b.view(), a.view(), 1);
        QVERIFY(*ab.mean == *ba.mean);
        QVERIFY(*ab.mean < 0.9 && *ab.smallest >= -1 && *ab.largest <= 1);
    }

    void scaleOfTwoChangesNoBit()
    {
        const Image a = patch(40, 30, 0, 1, 1);
        const Image b = patch(40, 30, 0, 1, 2);
        Image large = a;
        Image largeToo = b;
        for (double& x : large.values) x *= 1024;
        for (double& x : largeToo.values) x *= 1024;
        QVERIFY(*stats::ssim(large.view(), largeToo.view(), 1024).mean == *stats::ssim(a.view(), b.view(), 1).mean);
    }

    // A small texture on a ramp many ranges high: moments about one common shift would lose its digits.
    void steepRampCostsNoDigits()
    {
        Image a = patch(80, 45, 0, 1, 1);
        Image b = patch(80, 45, 0, 1, 2);
        for (std::size_t k = 0; k < a.values.size(); ++k) {
            a.values[k] += 5000 * static_cast<double>(k % a.width);
            b.values[k] += 5000 * static_cast<double>(k % a.width);
        }
        const double reference = directSsim(a, b, 1);
        const double fast = *stats::ssim(a.view(), b.view(), 1).mean;
        QVERIFY2(std::fabs(fast - reference) < 1e-12, qPrintable(QString::number(fast - reference)));
    }

    // python3 (scikit-image 0.19.3): structural_similarity(a, b, data_range=1.0, full=True, ...)[1], cut to the valid
    // windows, of a[i,j] = ((7i + 13j) mod 17)/17 and b[i,j] = ((7i + 13j + ij mod 3) mod 17)/17, 20 rows by 24 columns:
    //   gaussian_weights=True, sigma=1.5, use_sample_covariance=False   0.8039634442843878
    //   gaussian_weights=True, sigma=1.5, use_sample_covariance=True    0.8039547251122745
    //   (the default box of 7)                                          0.7948176917750218
    void variantsAgreeWithScikitImage()
    {
        Image a{std::vector<double>(20 * 24), 24, 20};
        Image b = a;
        for (std::size_t i = 0; i < 20; ++i)
            for (std::size_t j = 0; j < 24; ++j) {
                a.values[i * 24 + j] = static_cast<double>((7 * i + 13 * j) % 17) / 17;
                b.values[i * 24 + j] = static_cast<double>((7 * i + 13 * j + i * j % 3) % 17) / 17;
            }
        QVERIFY(std::fabs(*stats::ssim(a.view(), b.view(), 1).mean - 0.8039634442843878) < 1e-13);
        const stats::SsimOptions sample{.sampleMoments = true};
        QVERIFY(std::fabs(*stats::ssim(a.view(), b.view(), 1, sample).mean - 0.8039547251122745) < 1e-13);
        const stats::SsimOptions box{.window = stats::SsimWindow::Uniform7, .sampleMoments = true};
        const auto boxed = stats::ssim(a.view(), b.view(), 1, box);
        QVERIFY(std::fabs(*boxed.mean - 0.7948176917750218) < 1e-13);
        QCOMPARE(boxed.windowsAcross, std::size_t{18});
    }

    void floatStaysCloseToDouble_data()
    {
        QTest::addColumn<double>("offset");
        QTest::addColumn<double>("slope");
        QTest::addColumn<double>("most");
        QTest::newRow("plain") << 0.0 << 0.0 << 1e-6;
        QTest::newRow("sloping over the whole range") << 0.0 << 0.01 << 1e-5;
        // scikit-image answers 969.7 at this offset, where E[x^2] - E[x]^2 has no digits left.
        QTest::newRow("offset 1e4") << 1e4 << 0.0 << 1e-5;
    }

    void floatStaysCloseToDouble()
    {
        QFETCH(double, offset);
        QFETCH(double, slope);
        QFETCH(double, most);
        Image a = patch(150, 90, offset, 0.2, 1);
        Image b = patch(150, 90, offset, 0.2, 2);
        for (Image* image : {&a, &b})
            for (std::size_t k = 0; k < image->values.size(); ++k)
                image->values[k] = static_cast<float>(image->values[k] + slope * static_cast<double>(k % image->width));
        const auto floatA = a.floats(), floatB = b.floats();
        const auto found = stats::ssim(stats::FloatImageView{floatA, a.width, a.height}, {floatB, a.width, a.height}, 1);
        const double error = std::fabs(*found.mean - *stats::ssim(a.view(), b.view(), 1).mean);
        QVERIFY2(error < most, qPrintable(QString::number(error)));
        QVERIFY(*found.smallest >= -1 && *found.largest <= 1);
        QVERIFY(*stats::ssim(stats::FloatImageView{floatA, a.width, a.height}, {floatA, a.width, a.height}, 1).mean == 1.0);
    }

    void neverLeavesMinusOneToOne()
    {
        for (std::uint64_t seed = 0; seed < 60; ++seed) {
            Stream stream(seed);
            const double scale = std::pow(10.0, 12 * stream.next() - 6);
            const double offset = seed % 3 == 0 ? 0 : scale * std::pow(10.0, 12 * stream.next() - 3);
            Image a = patch(30, 20, offset, scale, seed + 1);
            Image b = patch(30, 20, offset, scale, seed + 2);
            if (seed % 5 == 0)
                for (std::size_t k = 0; k < a.values.size(); ++k) b.values[k] = 2 * offset + scale - a.values[k];
            const auto found = stats::ssim(a.view(), b.view(), scale);
            QVERIFY(*found.smallest >= -1 && *found.largest <= 1 && std::fabs(*found.mean) <= 1);
        }
    }

    // Constant images (c1 and c2 of range 1) have (2 a b + c1)/(a^2 + b^2 + c1), whatever their size.
    void constantImagesDifferByTheirMeansAlone()
    {
        const Image a{std::vector<double>(13 * 11, 0.25), 13, 11};
        const Image b{std::vector<double>(13 * 11, 0.75), 13, 11};
        QVERIFY(near(*stats::ssim(a.view(), b.view(), 1).mean, (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4), 1e-14));
        QVERIFY(*stats::ssim(a.view(), a.view(), 1).mean == 1.0);
    }

    void shiftedTextureIsFoundAgain()
    {
        const Image whole = patch(80, 60, 2, 1, 3);
        const auto cut = [&](std::size_t left, std::size_t top) {
            Image part{{}, 60, 40};
            for (std::size_t y = 0; y < 40; ++y)
                for (std::size_t x = 0; x < 60; ++x) part.values.push_back(whole.values[(top + y) * whole.width + left + x]);
            return part;
        };
        // a shows the whole from (7, 9), b from (11, 6): a point of b lies 4 pixels left of and 3 below the same point of a.
        const Image a = cut(7, 9), b = cut(11, 6);
        const auto found = stats::registeredSsim(a.view(), b.view(), 1, 6);
        QCOMPARE(found.right, -4);
        QCOMPARE(found.down, 3);
        QVERIFY(*found.ssim == 1.0);
        QVERIFY(*found.ssimUnregistered < 0.5);
        QCOMPARE(stats::registeredSsim(a.view(), a.view(), 1, 6).right, 0);
        QVERIFY(!stats::registeredSsim(a.view(), b.view(), 1, 30).why.empty());
        const Image flat{std::vector<double>(60 * 40, 1.0), 60, 40};
        QVERIFY(!stats::registeredSsim(a.view(), flat.view(), 1, 3).ssim.exists());
    }

    void refusalsSayWhat_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<double>("range");
        QTest::addColumn<double>("pixel");
        QTest::addColumn<QString>("why");
        const double nan = std::numeric_limits<double>::quiet_NaN();
        QTest::newRow("small") << 10 << 1.0 << 0.5 << "smaller than the 11x11 window";
        QTest::newRow("range 0") << 20 << 0.0 << 0.5 << "range";
        QTest::newRow("NaN") << 20 << 1.0 << nan << "pixel x 3, y 2 of the second image is not a number";
    }

    void refusalsSayWhat()
    {
        QFETCH(int, width);
        QFETCH(double, range);
        QFETCH(double, pixel);
        QFETCH(QString, why);
        const Image a = patch(static_cast<std::size_t>(width), 20, 0, 1, 1);
        Image b = a;
        b.values[2 * b.width + 3] = pixel;
        const auto result = stats::ssim(a.view(), b.view(), range);
        QVERIFY(!result.mean.exists());
        QVERIFY2(QString::fromStdString(result.why).contains(why), result.why.c_str());
    }

    // /usr/bin/python3 tests/stats/reference/image_metrics.py
    void everyVariantAsWindowByWindow_data()
    {
        QTest::addColumn<double>("range");
        QTest::addColumn<stats::SsimOptions>("options");
        QTest::addColumn<std::vector<double>>("expected");  // mean, smallest, largest
        using enum stats::SsimWindow;
        QTest::newRow("Gaussian") << 1.0 << stats::SsimOptions{}
                                  << std::vector<double>{0.77757164539625, 0.490462131180758, 0.978195066743845};
        QTest::newRow("sample moments") << 1.0 << stats::SsimOptions{.sampleMoments = true}
                                        << std::vector<double>{0.777562375838945, 0.490439219286847, 0.978194330173986};
        QTest::newRow("box") << 1.0 << stats::SsimOptions{.window = Uniform7}
                             << std::vector<double>{0.777382979304599, 0.568803252495609, 0.985585091256878};
        QTest::newRow("box, sample moments") << 1.0 << stats::SsimOptions{.window = Uniform7, .sampleMoments = true}
                                             << std::vector<double>{0.777360109583347, 0.568759111700787, 0.985583751408232};
        QTest::newRow("range 2.5") << 2.5 << stats::SsimOptions{}
                                   << std::vector<double>{0.783309155154383, 0.504608752854629, 0.978655621734232};
        QTest::newRow("K1 and K2") << 1.0 << stats::SsimOptions{.k1 = 0.02, .k2 = 0.05}
                                   << std::vector<double>{0.779553479914847, 0.495345248200142, 0.978355153465375};
    }

    void everyVariantAsWindowByWindow()
    {
        QFETCH(double, range);
        QFETCH(stats::SsimOptions, options);
        QFETCH(std::vector<double>, expected);
        Image a{{}, 90, 81}, b{{}, 90, 81};
        for (std::size_t i = 0; i < 81; ++i)
            for (std::size_t j = 0; j < 90; ++j) {
                a.values.push_back(static_cast<double>((7 * i + 13 * j) % 17) / 17);
                b.values.push_back(static_cast<double>((7 * i + 13 * j + i * j % 3) % 17) / 17 + 0.002 * static_cast<double>(i));
            }
        const auto found = stats::ssim(a.view(), b.view(), range, options);
        const std::size_t window = options.window == stats::SsimWindow::Uniform7 ? 7 : 11;
        QCOMPARE(found.windowsAcross, 91 - window);
        QCOMPARE(found.windowsDown, 82 - window);
        compareNumbers({{"mean", found.mean, expected[0]},
                        {"smallest", found.smallest, expected[1]},
                        {"largest", found.largest, expected[2]}});
        const auto floatA = a.floats(), floatB = b.floats();
        const auto quick = stats::ssim(stats::FloatImageView{floatA, 90, 81}, {floatB, 90, 81}, range, options);
        compareNumbers({{"mean of floats", quick.mean, expected[0], 1e-5},
                        {"smallest of floats", quick.smallest, expected[1], 1e-4},
                        {"largest of floats", quick.largest, expected[2], 1e-5}});
    }

    // /usr/bin/python3 tests/stats/reference/image_metrics.py
    void registrationAsByTryingAllShifts()
    {
        const auto texture = [](double i, double j) {
            return std::sin(0.7 * i + 0.3 * j) + std::cos(0.2 * i * i / 10 + 0.9 * j);
        };
        Image a{{}, 34, 30}, b{{}, 34, 30};
        for (int i = 0; i < 30; ++i)
            for (int j = 0; j < 34; ++j) {
                a.values.push_back(texture(i, j));
                b.values.push_back(texture(i + 2, j - 3) + 0.1 * ((5 * i + 3 * j) % 7));
            }
        const auto found = stats::registeredSsim(a.view(), b.view(), 2, 5);
        QCOMPARE(found.right, 3);
        QCOMPARE(found.down, -2);
        compareNumbers({{"correlation", found.correlation, 0.980631681783292},
                        {"registered", found.ssim, 0.398998940614083},
                        {"as they are", found.ssimUnregistered, 0.182380335435049}});
        compareReasons({{"shift below 0", stats::registeredSsim(a.view(), b.view(), 2, -1).ssim, "negative"},
                        {"shift of 20", stats::registeredSsim(a.view(), b.view(), 2, 20).correlation, "less than a window"}});
        QVERIFY(stats::registeredSsim(a.view(), b.view(), 2, 19).ssim.exists());
        // No shift allowed: the correlation of the images as they are.
        QVERIFY(*stats::registeredSsim(a.view(), b.view(), 2, 0).ssim == *found.ssimUnregistered);
    }

    // Vertical stripes of a period of 4: shifts by -4, 0 and 4 are equally good, and the shortest is taken.
    void ofEquallyGoodShiftsTheShortestIsTaken()
    {
        Image stripes{{}, 30, 20};
        for (std::size_t k = 0; k < 600; ++k) stripes.values.push_back(static_cast<double>(k % 30 % 4));
        const auto found = stats::registeredSsim(stripes.view(), stripes.view(), 3, 5);
        QCOMPARE(found.right, 0);
        QCOMPARE(found.down, 0);
        compareNumbers({{"correlation", found.correlation, 1}, {"registered", found.ssim, 1}});
    }
};

QTEST_GUILESS_MAIN(ImageMetricsTest)
#include "image_metrics_test.moc"
