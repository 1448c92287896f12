// SSIM against arrays with long-double truth, and its invariants.
#include "stats/image_metrics.h"

#include <QtTest>
#include <array>
#include <cstring>

#include "stats/trace_error.h"
#include "tests/stats/oracle_cases.h"

namespace {

struct Image {
    std::vector<double> values;
    std::size_t width = 0;
    std::size_t height = 0;
    stats::ImageView view() const { return {values, width, height}; }
};

template <typename T>
std::vector<double> converted(const std::string& bytes)
{
    std::vector<T> raw(bytes.size() / sizeof(T));
    if (!raw.empty()) std::memcpy(raw.data(), bytes.data(), raw.size() * sizeof(T));
    return {raw.begin(), raw.end()};
}

/// NumPy's format, version 1, C order, little endian.
Image readNpy(const std::filesystem::path& file, const oracle::Json& shape)
{
    std::ifstream stream(file, std::ios::binary);
    std::string all((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    const std::size_t headerLength = static_cast<unsigned char>(all[8]) + 256U * static_cast<unsigned char>(all[9]);
    const std::string header = all.substr(10, headerLength);
    const std::string bytes = all.substr(10 + headerLength);
    Image image;
    image.height = shape[0].get<std::size_t>();
    image.width = shape[1].get<std::size_t>();
    if (header.find("<f8") != std::string::npos)
        image.values = converted<double>(bytes);
    else if (header.find("<f4") != std::string::npos)
        image.values = converted<float>(bytes);
    else if (header.find("<u2") != std::string::npos)
        image.values = converted<std::uint16_t>(bytes);
    else
        image.values = converted<std::uint8_t>(bytes);
    return image;
}

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

/// The definition, window by window in two passes of long double: slow and plain.
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
    void agreesWithTheReferenceArrays()
    {
        const auto folder = oracle::sharedFolder() / "oracle" / "ssim" / "public";
        if (!std::filesystem::exists(folder / "ssim.json"))
            QSKIP("the shared reference arrays are not here: nothing was compared");
        std::ifstream stream(folder / "ssim.json");
        const auto document = oracle::Json::parse(stream);
        for (const auto& one : document["cases"]) {
            Image a;
            Image b;
            if (one["inputs"].contains("recipe")) {
                std::tie(a, b) = recipe();
            } else {
                a = readNpy(folder / one["inputs"]["a"].get<std::string>(), one["inputs"]["shape"][0]);
                b = readNpy(folder / one["inputs"]["b"].get<std::string>(), one["inputs"]["shape"][1]);
            }
            const auto result = stats::ssim(a.view(), b.view(), oracle::number(one["options"]["data_range"]));
            oracle::Answer answer{{"ssim", result.mean}, {"map_min", result.smallest}, {"map_max", result.largest}};
            std::set<std::string> later{"ssim_uniform7_sample_cov", "mae", "rmse"};
            if (result.why.empty()) {
                const auto error = stats::traceError(a.values, b.values);
                answer["mae"] = error.mae;
                answer["rmse"] = error.rmse;
                // The tolerance of a case is about SSIM; errors of huge values are judged by digits.
                if (one["expected"].contains("mae"))
                    QVERIFY(oracle::digits(*error.mae, oracle::number(one["expected"]["mae"])) >= 12);
            }
            const QString fault = oracle::fault(one, answer, result.why, later);
            QVERIFY2(fault.isEmpty(), qPrintable(QString::fromStdString(one["id"].get<std::string>()) + ": " + fault));
        }
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

    // A ramp many ranges high under a small texture: moments about one common shift would lose it.
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
};

QTEST_GUILESS_MAIN(ImageMetricsTest)
#include "image_metrics_test.moc"
