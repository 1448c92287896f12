// A patch over the whole screen: measurements of seams, direction and roughness.
#include "rendering/composition/screen_extension.h"

#include <QTest>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "rendering/composition/friction_image.h"

using namespace rendering;

namespace {

/// A twill at 30 degrees; its period divides no patch.
cv::Mat twill(int rows, int columns, double period = 11.3)
{
    cv::Mat patch(rows, columns, CV_32FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            patch.at<float>(i, j) = static_cast<float>(std::sin(2 * std::numbers::pi * (0.866 * j + 0.5 * i) / period));
    return patch;
}

/// Blobs of about four pixels without repetition.
cv::Mat felt(int rows, int columns, std::uint64_t seed)
{
    protocols::Random random(seed);
    cv::Mat patch(rows, columns, CV_32FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) patch.at<float>(i, j) = static_cast<float>(random.normal());
    cv::GaussianBlur(patch, patch, {}, 2);
    return patch;
}

double largestStep(const cv::Mat& values)
{
    double along = cv::norm(values.colRange(1, values.cols), values.colRange(0, values.cols - 1), cv::NORM_INF);
    if (values.rows > 1)
        along = std::max(along, cv::norm(values.rowRange(1, values.rows), values.rowRange(0, values.rows - 1), cv::NORM_INF));
    return along;
}

double spread(const cv::Mat& values)
{
    cv::Scalar mean, sd;
    cv::meanStdDev(values, mean, sd);
    return sd[0];
}

/// Share of the power, over blocks of 64, that differs in direction or period.
double spectrumMoved(const cv::Mat& a, const cv::Mat& b)
{
    const auto spectrum = [](const cv::Mat& values) {
        cv::Mat window, sum = cv::Mat::zeros(64, 64, CV_32FC1);
        cv::createHanningWindow(window, {64, 64}, CV_32F);
        for (int i = 0; i + 64 <= values.rows; i += 32)
            for (int j = 0; j + 64 <= values.cols; j += 32) {
                cv::Mat block = values(cv::Rect(j, i, 64, 64)).clone(), transformed;
                block -= cv::mean(block)[0];
                cv::dft(block.mul(window), transformed, cv::DFT_COMPLEX_OUTPUT);
                cv::Mat parts[2];
                cv::split(transformed, parts);
                sum += parts[0].mul(parts[0]) + parts[1].mul(parts[1]);
            }
        return cv::Mat(sum / cv::sum(sum)[0]);
    };
    return cv::norm(spectrum(a), spectrum(b), cv::NORM_L1) / 2;
}

cv::Rect middle(const cv::Mat& patch) { return {(1280 - patch.cols) / 2, (800 - patch.rows) / 2, patch.cols, patch.rows}; }

}  // namespace

class ScreenExtensionTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void theDirectionOfATwillStays_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::newRow("GelSight") << 240 << 320;
        QTest::newRow("photograph") << 512 << 512;
        QTest::newRow("physical scale") << 90 << 120;
        QTest::newRow("wider than the screen") << 240 << 1500;
        QTest::newRow("higher than the screen") << 900 << 200;
    }
    void theDirectionOfATwillStays()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const cv::Mat patch = twill(rows, columns);
        const auto laid = extendToScreen(patch, Extension::Tile), reflected = extendToScreen(patch, Extension::Mirror);
        QCOMPARE(laid.values.size(), cv::Size(1280, 800));
        QCOMPARE(laid.how, std::string("tile"));
        QCOMPARE(reflected.how, std::string("mirror"));
        const double moved = spectrumMoved(laid.values, patch), turned = spectrumMoved(reflected.values, patch);
        qInfo("spectrum moved: tile %.3f, mirror %.3f; agreement %.3f", moved, turned, laid.agreement);
        QVERIFY(moved < 0.05);
        QVERIFY(turned > 0.2);
        QVERIFY(laid.agreement > 0.9);
    }

    void noSeamIsSteeperThanTheTexture_data()
    {
        QTest::addColumn<QString>("kind");
        for (const char* kind : {"twill", "felt", "tilted twill", "folded felt"}) QTest::newRow(kind) << QString(kind);
    }
    void noSeamIsSteeperThanTheTexture()
    {
        QFETCH(QString, kind);
        for (const cv::Size size : {cv::Size(320, 240), cv::Size(97, 131), cv::Size(40, 30)}) {
            cv::Mat patch = kind.contains("twill") ? twill(size.height, size.width) : felt(size.height, size.width, 3);
            for (int i = 0; i < patch.rows; ++i)
                for (int j = 0; j < patch.cols; ++j) {
                    const double x = static_cast<double>(j) / patch.cols, y = static_cast<double>(i) / patch.rows;
                    if (kind.startsWith("tilted")) patch.at<float>(i, j) += static_cast<float>(5 * x - 3 * y);
                    if (kind.startsWith("folded")) patch.at<float>(i, j) += static_cast<float>(std::sin(4 * x + 2 * y));
                }
            const auto laid = extendToScreen(patch, Extension::Tile);
            QCOMPARE(laid.how, std::string("tile"));
            QVERIFY2(largestStep(laid.values) < 1.5 * largestStep(patch),
                     qPrintable(QString("%1 against %2").arg(largestStep(laid.values)).arg(largestStep(patch))));
        }
    }

    void theMiddleIsTheSourceItself()
    {
        const cv::Mat patch = twill(240, 320);
        const cv::Mat laid = extendToScreen(patch, Extension::Tile).values(middle(patch));
        const cv::Rect heart(150, 110, 60, 40);  // Inside all parts that are cut away or blended.
        QCOMPARE(cv::norm(laid(heart), patch(heart), cv::NORM_INF), 0.0);
    }

    /// The mean of two uncorrelated strips has half their variance.
    void aTextureThatNeverRepeatsKeepsItsRoughness()
    {
        double screen = 0, patches = 0;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const cv::Mat patch = felt(120, 160, seed);
            screen += spread(extendToScreen(patch, Extension::Tile).values);
            patches += spread(patch);
        }
        qInfo("roughness of the screen over that of the patches: %.3f", screen / patches);
        QVERIFY(std::abs(screen / patches - 1) < 0.045);  // 0.940 without the restored variance.
    }

    /// A weave with high contrast in the light and low contrast in the shade, as on photographs of satin.
    void changingContrastContinuesBesideThePatch()
    {
        cv::Mat patch = felt(256, 256, 9);
        for (int i = 0; i < patch.rows; ++i) patch.row(i) *= 0.15 + 0.85 * i / 255.0;
        const cv::Mat laid = extendToScreen(patch, Extension::Tile).values;
        double furthest = 1;
        for (int row = 0; row + 12 <= patch.rows; row += 12) {
            const double ratio = spread(laid.rowRange(272 + row, 284 + row)) / spread(patch.rowRange(row, row + 12));
            furthest = std::max({furthest, ratio, 1 / ratio});
        }
        qInfo("beside the patch, a strip's roughness differs from the patch's own by a factor of %.2f at most", furthest);
        QVERIFY(furthest < 2);  // 3.6 if the texture keeps its own contrast.
    }

    void nothingLeavesTheRangeOfTheSource()
    {
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const cv::Mat patch = felt(60, 60, seed);
            double low = 0, high = 0, least = 0, most = 0;
            cv::minMaxLoc(patch, &low, &high);
            cv::minMaxLoc(extendToScreen(patch, Extension::Tile).values, &least, &most);
            QVERIFY(least >= low && most <= high);
        }
    }

    void aTraceContinuesWithoutAJump()
    {
        protocols::Random random(4);
        cv::Mat trace(1, 480, CV_32FC1);
        for (int i = 0; i < 480; ++i)  // Drifts, so that its end differs from its beginning.
            trace.at<float>(i) = static_cast<float>(0.5 + 0.001 * i + 0.05 * std::sin(0.7 * i) + 0.005 * random.normal());
        const auto laid = extendToScreen(trace, Extension::Tile);
        QCOMPARE(laid.values.size(), cv::Size(1280, 800));
        QCOMPARE(laid.how, std::string("tile"));
        QCOMPARE(cv::norm(laid.values.row(0), laid.values.row(799), cv::NORM_INF), 0.0);
        QVERIFY(largestStep(laid.values) < 1.3 * largestStep(trace));
    }

    void whatCannotBeTiledIsMirroredWithAReason_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::newRow("one pixel") << 1 << 1;
        QTest::newRow("a row") << 1 << 9;
        QTest::newRow("a column") << 300 << 1;
        QTest::newRow("a few pixels") << 15 << 15;
        QTest::newRow("constant") << 200 << 200;
    }
    void whatCannotBeTiledIsMirroredWithAReason()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const cv::Mat patch = rows == 200 ? cv::Mat(rows, columns, CV_32FC1, cv::Scalar(0.4)) : twill(rows, columns);
        const auto laid = extendToScreen(patch, Extension::Tile);
        QCOMPARE(laid.how, std::string("mirror (too small or constant to tile)"));
        QCOMPARE(cv::norm(laid.values, extendToScreen(patch, Extension::Mirror).values, cv::NORM_INF), 0.0);
    }

    void heightsOfANanometreAndAKilometreGiveTheSamePattern()
    {
        const cv::Mat patch = twill(100, 130);
        const cv::Mat laid = extendToScreen(patch, Extension::Tile).values;
        for (const double gain : {1e-6, 1e6}) {
            const cv::Mat scaled = extendToScreen(patch * gain, Extension::Tile).values;
            QVERIFY(cv::checkRange(scaled));
            QVERIFY(cv::norm(scaled / gain, laid, cv::NORM_INF) < 1e-4);
        }
    }
};

QTEST_GUILESS_MAIN(ScreenExtensionTest)
#include "screen_extension_test.moc"
