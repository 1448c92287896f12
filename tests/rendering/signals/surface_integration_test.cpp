// Surfaces with slopes from a formula, including odd sizes, single rows and single columns.
#include "rendering/signals/surface_integration.h"

#include <QTest>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <tuple>

#include "protocols/random.h"
#include "rendering/images/true_map.h"
#include "rendering/signals/cosine_transform.h"
#include "rendering/signals/gap_multigrid.h"
#include "rendering/signals/mirrored_columns.h"
#include "tests/rendering/refusal.h"
#include "tests/rendering/shared_data.h"
#include "tests/rendering/signals/direct_surface.h"

using namespace rendering::signals;
using rendering::readTrueMap;

namespace {

cv::Mat randomImage(int rows, int columns)
{
    protocols::Random random(static_cast<std::uint64_t>(rows * 1000 + columns));
    cv::Mat image(rows, columns, CV_64FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) image.at<double>(i, j) = random.normal();
    return image;
}

double largestDifference(const cv::Mat& a, const cv::Mat& b)
{
    cv::Mat x, y;
    a.convertTo(x, CV_64F);
    b.convertTo(y, CV_64F);
    return cv::norm(x, y, cv::NORM_INF);
}

cv::Mat centred(const cv::Mat& values)
{
    cv::Mat result;
    values.convertTo(result, CV_64F);
    return result - cv::mean(result)[0];
}

/// Rises to the right and lower neighbours; the last column and row have none and hold arbitrary values.
Slopes forwardSlopes(const cv::Mat& height, const Pitch& pitch)
{
    Slopes slopes{cv::Mat(height.size(), CV_64FC1, 1e3), cv::Mat(height.size(), CV_64FC1, -1e3)};
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            if (j + 1 < height.cols)
                slopes.x.at<double>(i, j) = (height.at<double>(i, j + 1) - height.at<double>(i, j)) / pitch.x;
            if (i + 1 < height.rows)
                slopes.y.at<double>(i, j) = (height.at<double>(i + 1, j) - height.at<double>(i, j)) / pitch.y;
        }
    return slopes;
}

/// The dense system of one column of second differences with mirrored borders.
cv::Mat denseColumn(int rows, double stiffness)
{
    cv::Mat system = cv::Mat::zeros(rows, rows, CV_64FC1);
    for (int i = 0; i < rows; ++i) {
        system.at<double>(i, i) += 2 + stiffness;
        system.at<double>(i, std::max(i - 1, 0)) -= 1;
        system.at<double>(i, std::min(i + 1, rows - 1)) -= 1;
    }
    return system;
}

/// numpy.gradient: central differences, one-sided at the borders.
cv::Mat gradientAlongX(const cv::Mat& height, double pitch)
{
    cv::Mat result(height.size(), CV_64FC1);
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            const int a = std::max(0, j - 1), b = std::min(height.cols - 1, j + 1);
            result.at<double>(i, j) = (height.at<double>(i, b) - height.at<double>(i, a)) / (std::max(1, b - a) * pitch);
        }
    return result;
}

/// Waves with a little noise, and slopes of its kind.
cv::Mat roughSurface(int rows, int columns)
{
    cv::Mat height = 0.02 * randomImage(rows, columns);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) height.at<double>(i, j) += std::sin(0.2 * i + 1) * std::cos(0.15 * j);
    return height;
}

Slopes slopesOf(const cv::Mat& height, const Pitch& pitch, SlopeKind kind)
{
    if (kind == SlopeKind::Forward) return forwardSlopes(height, pitch);
    return {gradientAlongX(height, pitch.x), gradientAlongX(height.t(), pitch.y).t()};
}

cv::Mat placesWithout(double missing, cv::Size size, std::uint64_t seed)
{
    protocols::Random random(seed);
    cv::Mat known(size, CV_8UC1);
    for (int i = 0; i < size.height; ++i)
        for (int j = 0; j < size.width; ++j) known.at<uchar>(i, j) = random.uniform() < missing ? 0 : 255;
    return known;
}

double shareOfSq(const cv::Mat& found, const cv::Mat& wanted) { return cv::norm(found, wanted) / cv::norm(wanted); }

/// A step of 1 between the halves, two pulls across a weak column, and no noise.
WeightedRises oneStep()
{
    WeightedRises rises{{cv::Mat::ones(16, 16, CV_32FC1), cv::Mat::ones(16, 16, CV_32FC1)}, cv::Mat::zeros(16, 16, CV_32FC1)};
    rises.weights.x.col(3) = 1e-3F;
    rises.sources.col(7) = -1;
    rises.sources.col(8) = 1;
    rises.sources.at<float>(2, 2) -= 1;
    rises.sources.at<float>(12, 12) += 1;
    return rises;
}

/// One row has measured rises; all other rises are continued ones of little weight, which no surface has exactly.
WeightedRises oneMeasuredRow(int side)
{
    const cv::Mat height = roughSurface(side, side), misfit = 0.1 * randomImage(side, side + 1);
    const auto square = [side](int type, double value) { return cv::Mat(side, side, type, cv::Scalar(value)); };
    WeightedRises rises{{square(CV_32FC1, 1e-5), square(CV_32FC1, 1e-5)}, square(CV_64FC1, 0)};
    rises.weights.x.row(side / 2) = 1;
    rises.weights.x.col(side - 1) = 0;
    rises.weights.y.row(side - 1) = 0;
    const auto add = [&](const cv::Mat& weights, int i, int j, int down, int right) {
        const double rise = height.at<double>(i + down, j + right) - height.at<double>(i, j) + misfit.at<double>(i, j);
        const double pull = static_cast<double>(weights.at<float>(i, j)) * rise;
        rises.sources.at<double>(i, j) -= pull;
        rises.sources.at<double>(i + down, j + right) += pull;
    };
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j) {
            if (j + 1 < side) add(rises.weights.x, i, j, 0, 1);
            if (i + 1 < side) add(rises.weights.y, i, j, 1, 0);
        }
    return rises;
}

const Pitch surfacePitch{0.05, 0.05};

struct FormulaSurface {
    cv::Mat heightMm;
    Slopes slopes;
};

/// 240 x 320 heights and their exact slopes at the centres of the pixels; `at(x, y)` gives height, dh/dx and dh/dy at mm.
template <class At>
FormulaSurface surfaceFrom(At at)
{
    FormulaSurface known{cv::Mat(240, 320, CV_64FC1), {cv::Mat(240, 320, CV_64FC1), cv::Mat(240, 320, CV_64FC1)}};
    for (int i = 0; i < 240; ++i)
        for (int j = 0; j < 320; ++j)
            std::tie(known.heightMm.at<double>(i, j), known.slopes.x.at<double>(i, j), known.slopes.y.at<double>(i, j)) =
                at(j * surfacePitch.x, i * surfacePitch.y);
    return known;
}

FormulaSurface tiltedPlane()
{
    return surfaceFrom([](double x, double y) { return std::tuple{0.3 * x - 0.2 * y, 0.3, -0.2}; });
}

FormulaSurface weave(double pixels)
{
    const double w = 2 * std::numbers::pi / (pixels * surfacePitch.x);
    return surfaceFrom([w](double x, double y) {
        const double a = w * x + 0.7, b = w * y + 1.1;
        return std::tuple{0.05 * std::cos(a) * std::cos(b), -0.05 * w * std::sin(a) * std::cos(b),
                          -0.05 * w * std::cos(a) * std::sin(b)};
    });
}

/// Part of a ball that stands out of a plane.
FormulaSurface ballCap(double radiusMm, double heightMm)
{
    return surfaceFrom([=](double x, double y) {
        const double dx = x - 8.01, dy = y - 5.98, below = radiusMm - heightMm, square = radiusMm * radiusMm - dx * dx - dy * dy;
        if (square <= below * below) return std::tuple{0.0, 0.0, 0.0};
        const double z = std::sqrt(square);
        return std::tuple{z - below, -dx / z, -dy / z};
    });
}

/// RMS difference after subtraction of the means, in percent of the range of the true surface.
double errorInPercentOfRange(const cv::Mat& found, const cv::Mat& known)
{
    double low = 0, high = 0;
    cv::minMaxLoc(known, &low, &high);
    return 100 * cv::norm(centred(found), centred(known)) / std::sqrt(static_cast<double>(known.total())) / (high - low);
}

void addSizes()
{
    QTest::addColumn<int>("rows");
    QTest::addColumn<int>("columns");
    for (const auto& [rows, columns] : {std::pair{8, 8},
                                        {7, 9},
                                        {7, 8},
                                        {8, 7},
                                        {1, 12},
                                        {1, 13},
                                        {11, 1},
                                        {12, 1},
                                        {1, 1},
                                        {2, 2},
                                        {2, 3},
                                        {31, 37},
                                        {60, 81}})
        QTest::addRow("%dx%d", rows, columns) << rows << columns;
}

}  // namespace

Q_DECLARE_METATYPE(FormulaSurface)

class SurfaceIntegrationTest : public QObject {
    Q_OBJECT
private Q_SLOTS:
    void cosineTransformIsTheSumOfItsDefinition_data() { addSizes(); }
    void cosineTransformIsTheSumOfItsDefinition()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        if (rows * columns > 2000) rows = columns = 25;
        const cv::Mat image = randomImage(rows, columns);
        cv::Mat expected(rows, columns, CV_64FC1);
        const auto basis = [](int k, int n, int length) {
            return std::sqrt((k == 0 ? 1.0 : 2.0) / length) * std::cos(std::numbers::pi * k * (2 * n + 1) / (2.0 * length));
        };
        for (int u = 0; u < rows; ++u)
            for (int v = 0; v < columns; ++v) {
                double sum = 0;
                for (int i = 0; i < rows; ++i)
                    for (int j = 0; j < columns; ++j) sum += basis(u, i, rows) * basis(v, j, columns) * image.at<double>(i, j);
                expected.at<double>(u, v) = sum;
            }
        const cv::Mat found = cosineTransform(image);
        QVERIFY(largestDifference(found, expected) < 1e-11);
        QVERIFY(largestDifference(inverseCosineTransform(found), image) < 1e-12);
    }

    void planeStaysAPlane_data() { addSizes(); }
    void planeStaysAPlane()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const Pitch pitch{0.05, 0.08};
        cv::Mat height(rows, columns, CV_64FC1);
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) height.at<double>(i, j) = 0.3 * j * pitch.x - 0.7 * i * pitch.y;
        const Slopes slopes{cv::Mat(rows, columns, CV_64FC1, 0.3), cv::Mat(rows, columns, CV_64FC1, -0.7)};
        QVERIFY(largestDifference(integrate(slopes, pitch), centred(height)) < 1e-12);
        QVERIFY(largestDifference(integrate(slopes, pitch, SlopeKind::Point, IntegrationQuality::Fast), centred(height)) < 2e-5);
    }

    void anySurfaceComesBackFromItsForwardSlopes_data() { addSizes(); }
    void anySurfaceComesBackFromItsForwardSlopes()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const Pitch pitch{0.05, 0.13};
        const cv::Mat height = randomImage(rows, columns);
        const cv::Mat found = integrate(forwardSlopes(height, pitch), pitch, SlopeKind::Forward);
        QVERIFY(largestDifference(found, centred(height)) < 1e-10);
    }

    void anySurfaceComesBackFromItsCentralSlopes_data() { addSizes(); }
    void anySurfaceComesBackFromItsCentralSlopes()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const Pitch pitch{0.05, 0.13};
        const cv::Mat height = randomImage(rows, columns);
        const Slopes slopes{gradientAlongX(height, pitch.x), gradientAlongX(height.t(), pitch.y).t()};
        QVERIFY(largestDifference(integrate(slopes, pitch, SlopeKind::Central), centred(height)) < 1e-9);
    }

    void pointSlopesComeBackWithinATenthOfAPercent_data()
    {
        QTest::addColumn<FormulaSurface>("surface");
        QTest::addColumn<double>("percentOfRange");
        QTest::newRow("tilted plane") << tiltedPlane() << 1e-9;
        QTest::newRow("weave of 6 pixels") << weave(6) << 0.15;
        QTest::newRow("weave of 12 pixels") << weave(12) << 0.005;
        // No rule knows the place where the slope jumps between two pixels: radius 35 pixels, height 0.3 mm.
        QTest::newRow("ball cap") << ballCap(5, 0.3) << 0.1;
    }
    void pointSlopesComeBackWithinATenthOfAPercent()
    {
        QFETCH(FormulaSurface, surface);
        QFETCH(double, percentOfRange);
        for (const auto quality : {IntegrationQuality::Full, IntegrationQuality::Fast}) {
            const cv::Mat found = integrate(surface.slopes, surfacePitch, SlopeKind::Point, quality);
            const double error = errorInPercentOfRange(found, surface.heightMm);
            qInfo("%.4f %% of the range", error);
            QVERIFY(error <= std::max(percentOfRange, quality == IntegrationQuality::Full ? 0.0 : 1e-3));
        }
    }

    void realMapComesBackFromCentralDifferences_data()
    {
        QTest::addColumn<QString>("file");
        QTest::addColumn<double>("asPointSlopes");
        QTest::newRow("Dime") << "Dime.tmd" << 1.92;
        QTest::newRow("StepHeight") << "StepHeight.tmd" << 2.11;
        QTest::newRow("paper") << "paper.tmd" << 12.4;
    }
    /// Declared as central differences, the map is recovered to rounding. Taken for point slopes, its error is the one that a
    /// second implementation prints (numpy, scipy.fft.dctn and quadrature of sixth order).
    void realMapComesBackFromCentralDifferences()
    {
        QFETCH(QString, file);
        QFETCH(double, asPointSlopes);
        const auto path = sharedData("truemap_heightmaps") / file.toStdString();
        if (!std::filesystem::exists(path)) QSKIP("the shared height maps do not exist");
        const auto map = readTrueMap(path);
        cv::Mat height;
        map.heightMm.convertTo(height, CV_64F);
        const Slopes slopes{gradientAlongX(height, map.xPitchMm), gradientAlongX(height.t(), map.yPitchMm).t()};
        const Pitch pitch{map.xPitchMm, map.yPitchMm};
        const auto percentOfSq = [&](SlopeKind kind) {
            return 100 * cv::norm(integrate(slopes, pitch, kind), centred(height)) / cv::norm(centred(height));
        };
        QVERIFY(percentOfSq(SlopeKind::Central) < 1e-8);
        const double taken = percentOfSq(SlopeKind::Point);
        QVERIFY2(std::abs(taken - asPointSlopes) < 0.05, qPrintable(QString::number(taken)));
    }

    void missingSlopesAreBridged()
    {
        const auto known = weave(24);
        Slopes holed{known.slopes.x.clone(), known.slopes.y.clone()};
        cv::Mat measured(known.heightMm.size(), CV_8UC1, cv::Scalar(255));
        holed.x(cv::Rect(100, 60, 6, 90)) = std::numeric_limits<double>::quiet_NaN();
        holed.y.at<double>(5, 5) = std::numeric_limits<double>::infinity();
        measured(cv::Rect(200, 100, 12, 12)) = 0;
        const cv::Mat found = integrateAround(holed, measured, surfacePitch);
        QVERIFY(cv::checkRange(found));
        cv::Mat places = measured & measuredPlaces(holed);
        cv::Mat difference = found - centred(known.heightMm);
        difference -= cv::mean(difference, places)[0];
        difference.setTo(0, places == 0);
        const double error = 100 * cv::norm(difference) / std::sqrt(cv::countNonZero(places)) / 0.1;
        qInfo("%.3f %% of the range outside the gaps", error);
        QVERIFY(error < 0.5);
        QVERIFY(largestDifference(integrateAround(known.slopes, {}, surfacePitch), integrate(known.slopes, surfacePitch)) < 1e-9);
    }

    void latticesOfCentralDifferencesStayTogetherAroundGaps_data()
    {
        QTest::addColumn<QString>("gaps");
        QTest::addColumn<double>("percentOfSq");
        QTest::newRow("border") << "border" << 0.01;
        QTest::newRow("hole") << "hole" << 0.01;
        QTest::newRow("a tenth of the points") << "points" << 0.05;
        QTest::newRow("checkerboard") << "checkerboard" << 0.3;  // Blocks of four pixels touch at their corners only.
    }
    /// Without the border, nothing joins the four lattices. Slopes are numpy.gradient's; those at missing points are missing.
    void latticesOfCentralDifferencesStayTogetherAroundGaps()
    {
        QFETCH(QString, gaps);
        QFETCH(double, percentOfSq);
        const auto path = sharedData("truemap_heightmaps") / "Dime.tmd";
        if (!std::filesystem::exists(path)) QSKIP("the shared height maps do not exist");
        const auto map = readTrueMap(path);
        cv::Mat height;
        map.heightMm.convertTo(height, CV_64F);
        const Pitch pitch{map.xPitchMm, map.yPitchMm};
        Slopes slopes{gradientAlongX(height, pitch.x), gradientAlongX(height.t(), pitch.y).t()};
        protocols::Random random(1);
        const auto missing = [&](int i, int j) {
            if (gaps == "border") return std::min({i, j, height.rows - 1 - i, height.cols - 1 - j}) < 24;  // 29 % of the points
            if (gaps == "hole") return std::abs(i - 150) < 80 && std::abs(j - 150) < 80;
            if (gaps == "points") return random.below(10) == 0;
            return (i / 4 + j / 4) % 2 == 1;
        };
        cv::Mat measured(height.size(), CV_8UC1, cv::Scalar(255));
        for (int i = 0; i < height.rows; ++i)
            for (int j = 0; j < height.cols; ++j)
                if (missing(i, j)) {
                    measured.at<uchar>(i, j) = 0;
                    slopes.x.at<double>(i, j) = slopes.y.at<double>(i, j) = std::numeric_limits<double>::quiet_NaN();
                }
        cv::Mat difference = integrateAround(slopes, {}, pitch, SlopeKind::Central) - height;
        difference -= cv::mean(difference, measured)[0];
        const double sq = cv::norm(height - cv::mean(height, measured)[0], cv::NORM_L2, measured);
        const double error = 100 * cv::norm(difference, cv::NORM_L2, measured) / sq;
        qInfo("%.4f %% of Sq", error);
        QVERIFY(error < percentOfSq);
    }

    void anIslandAmongGapsKeepsItsShape()
    {
        const auto known = weave(24);
        cv::Mat measured(known.heightMm.size(), CV_8UC1, cv::Scalar(0));
        measured(cv::Rect(40, 40, 60, 60)) = 255;
        measured(cv::Rect(150, 40, 60, 60)) = 255;
        for (const auto kind : {SlopeKind::Point, SlopeKind::Forward, SlopeKind::Central}) {
            const cv::Mat found = integrateAround(known.slopes, measured, surfacePitch, kind);
            const cv::Mat inside = found(cv::Rect(45, 45, 50, 50)), truth = known.heightMm(cv::Rect(45, 45, 50, 50));
            QVERIFY(cv::norm(centred(inside), centred(truth)) < 0.1 * cv::norm(centred(truth)));
        }
    }

    void mapsWithManyGapsFollowTheDirectSolution_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        QTest::addColumn<double>("xMm");
        QTest::addColumn<double>("yMm");
        QTest::addColumn<double>("missing");
        QTest::newRow("30 % missing, pitch 1:5") << 64 << 64 << 0.1 << 0.5 << 0.3;
        QTest::newRow("15 % missing, pitch 1:10") << 64 << 64 << 0.1 << 1.0 << 0.15;
        QTest::newRow("40 % missing, pitch 1:30") << 40 << 40 << 1.0 << 30.0 << 0.4;
        QTest::newRow("30 % missing, pitch 1000:1") << 40 << 40 << 1e3 << 1.0 << 0.3;
        QTest::newRow("half missing, 61 x 67") << 61 << 67 << 1.0 << 1.0 << 0.5;
        QTest::newRow("40 % missing, square pixels") << 64 << 64 << 1.0 << 1.0 << 0.4;
        QTest::newRow("30 % missing, three columns") << 120 << 3 << 1.0 << 10.0 << 0.3;
        QTest::newRow("40 % missing, two rows") << 2 << 100 << 1.0 << 5.0 << 0.4;
    }
    void mapsWithManyGapsFollowTheDirectSolution()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        QFETCH(double, xMm);
        QFETCH(double, yMm);
        QFETCH(double, missing);
        const Pitch pitch{xMm, yMm};
        for (const std::uint64_t seed : {1, 4, 6})
            for (const auto kind : {SlopeKind::Point, SlopeKind::Forward}) {
                const Slopes slopes = slopesOf(roughSurface(rows, columns), pitch, kind);
                const cv::Mat known = placesWithout(missing, slopes.x.size(), seed);
                const cv::Mat direct = DirectSolution(slopes, known, pitch, kind).height();
                const double error = shareOfSq(integrateAround(slopes, known, pitch, kind), direct);
                QVERIFY2(error < 1e-3, qPrintable(QString("%1 of Sq, seed %2").arg(error).arg(seed)));
            }
    }

    void centralDifferencesOfLongPixelsKeepTheHeights_data()
    {
        QTest::addColumn<QString>("gaps");
        QTest::addColumn<double>("xMm");
        QTest::addColumn<double>("yMm");
        QTest::addColumn<double>("ofSq");
        // With pulls in single precision, these errors were 2, 2.4, 2.8 and 1.7 of Sq.
        QTest::newRow("frame, pitch 1:10,000") << "frame" << 1.0 << 1e4 << 0.01;
        QTest::newRow("frame, pitch 10,000:1") << "frame" << 1e4 << 1.0 << 0.01;
        QTest::newRow("30 % missing, pitch 1:10,000") << "points" << 1.0 << 1e4 << 0.4;
        QTest::newRow("islands, pitch 1:30") << "islands" << 1.0 << 30.0 << 0.4;
    }
    void centralDifferencesOfLongPixelsKeepTheHeights()
    {
        QFETCH(QString, gaps);
        QFETCH(double, xMm);
        QFETCH(double, yMm);
        QFETCH(double, ofSq);
        const int side = 100;
        const cv::Mat height = centred(roughSurface(side, side));
        cv::Mat measured = placesWithout(gaps == "points" ? 0.3 : 0, height.size(), 4);
        for (int i = 0; i < side; ++i)
            for (int j = 0; j < side; ++j)
                if ((gaps == "frame" && std::min({i, j, side - 1 - i, side - 1 - j}) < 5) ||
                    (gaps == "islands" && (i % 40 >= 25 || j % 40 >= 25)))
                    measured.at<uchar>(i, j) = 0;
        const Pitch pitch{xMm, yMm};
        cv::Mat difference =
            integrateAround(slopesOf(height, pitch, SlopeKind::Central), measured, pitch, SlopeKind::Central) - height;
        difference -= cv::mean(difference, measured)[0];
        const double error = cv::norm(difference, cv::NORM_L2, measured) / cv::norm(height, cv::NORM_L2, measured);
        QVERIFY2(error < ofSq, qPrintable(QString("%1 of Sq").arg(error)));
    }

    /// Weights differ by 1e5, yet the pixels are square: multigrid solves it, which a transform alone does in hundreds of steps.
    void squarePixelsWithOneMeasuredRowAreNotTakenForLongOnes()
    {
        const cv::Mat quick = surfaceOfWeightedRises(oneMeasuredRow(100)),
                      slow = surfaceOfWeightedRises(oneMeasuredRow(100), {.mostIterations = 0});
        QVERIFY(shareOfSq(centred(quick), centred(slow)) < 1e-3);
        QVERIFY(largestDifference(quick, slow) > 0);  // They would be equal if both used the transform alone.
    }

    void profilesWithGapsAreSummed_data()
    {
        QTest::addColumn<int>("rows");
        QTest::addColumn<int>("columns");
        for (const auto& [rows, columns] : {std::pair{1, 200}, {64, 1}, {63, 1}, {1, 12}})
            QTest::addRow("%dx%d", rows, columns) << rows << columns;
    }
    void profilesWithGapsAreSummed()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const cv::Mat height = roughSurface(rows, columns);
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
            for (const auto kind : {SlopeKind::Point, SlopeKind::Forward}) {
                const Slopes slopes = slopesOf(height, surfacePitch, kind);
                const cv::Mat known = placesWithout(0.3, height.size(), seed);
                const cv::Mat direct = DirectSolution(slopes, known, surfacePitch, kind).height();
                QVERIFY(shareOfSq(integrateAround(slopes, known, surfacePitch, kind), direct) < 1e-6);
            }
    }

    /// The lattices of central differences end at every gap, and where their parts lie is an estimate.
    void profilesOfCentralDifferencesStayNearTheSurface_data() { profilesWithGapsAreSummed_data(); }
    void profilesOfCentralDifferencesStayNearTheSurface()
    {
        QFETCH(int, rows);
        QFETCH(int, columns);
        const cv::Mat height = roughSurface(rows, columns);
        const Slopes slopes = slopesOf(height, surfacePitch, SlopeKind::Central);
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const cv::Mat known = placesWithout(0.1, height.size(), seed);
            const cv::Mat found = integrateAround(slopes, known, surfacePitch, SlopeKind::Central);
            QVERIFY(shareOfSq(found, centred(height)) < 0.5);
        }
    }

    void unusedLastSlopesDoNotReachTheGaps()
    {
        const cv::Mat height = roughSurface(30, 40), known = placesWithout(0.3, height.size(), 2);
        const Slopes slopes = forwardSlopes(height, surfacePitch);  // They hold 1000 and -1000 in the last column and row.
        Slopes others{slopes.x.clone(), slopes.y.clone()};
        others.x.col(39) = 0;
        others.y.row(29) = 0;
        const auto found = [&](const Slopes& any) { return integrateAround(any, known, surfacePitch, SlopeKind::Forward); };
        QVERIFY(largestDifference(found(slopes), found(others)) == 0);
    }

    void withoutMultigridTheTransformSolvesTheSame()
    {
        const cv::Mat quick = surfaceOfWeightedRises(oneStep()),
                      direct = surfaceOfWeightedRises(oneStep(), {.mostIterations = 0});
        QVERIFY(cv::norm(direct) > 1);
        QVERIFY(shareOfSq(centred(quick), centred(direct)) < 1e-4);
    }

    void heightsThatAreNotFoundAreAFault()
    {
        WeightedRises broken = oneStep();
        broken.weights.x.at<float>(5, 5) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(refusalOf([&] { surfaceOfWeightedRises(broken); }).contains("a map of 16 x 16 pixels: the heights around"));
        for (const auto& [accepted, limit] : {std::pair{2e-6, "0.0001"}, {5e-4, "0.0005"}}) {
            const auto refusal = refusalOf([&] { surfaceOfWeightedRises(broken, {.residualToAccept = accepted}); });
            QVERIFY2(refusal.contains(QString("at most ") + limit), qPrintable(refusal));
        }
        Slopes steep{cv::Mat(16, 16, CV_64FC1, 1e300), cv::Mat::zeros(16, 16, CV_64FC1)};
        const cv::Mat known = placesWithout(0.3, steep.x.size(), 1);
        for (const auto kind : {SlopeKind::Point, SlopeKind::Central})
            QVERIFY(
                refusalOf([&] { integrateAround(steep, known, surfacePitch, kind); }).contains("the range of 32-bit numbers"));
    }

    void tiltIsRemovedByThePlacesOutside()
    {
        cv::Mat height(20, 30, CV_64FC1), outside(20, 30, CV_8UC1, cv::Scalar(255));
        for (int i = 0; i < 20; ++i)
            for (int j = 0; j < 30; ++j) height.at<double>(i, j) = 0.1 * j - 0.2 * i + 3;
        height(cv::Rect(10, 5, 8, 8)) += 1;
        outside(cv::Rect(10, 5, 8, 8)) = 0;
        const cv::Mat level = withoutTilt(height, outside);
        QVERIFY(std::abs(level.at<double>(7, 12) - 1) < 1e-12);
        QVERIFY(std::abs(level.at<double>(19, 0)) < 1e-12);
        QVERIFY(largestDifference(withoutTilt(height.row(0), {}), cv::Mat::zeros(1, 30, CV_64FC1)) < 1e-12);
        QVERIFY(refusalOf([&] { withoutTilt(height, cv::Mat::zeros(20, 30, CV_8UC1)); }).contains("too few places"));
    }

    void weaveOnABulgeComesBackAtTheStatedCutOff()
    {
        const auto known = weave(12);
        cv::Mat bulged = known.heightMm.clone();
        for (int i = 0; i < bulged.rows; ++i)
            for (int j = 0; j < bulged.cols; ++j) {
                const double x = (j - 160) / 160.0, y = (i - 120) / 120.0;
                bulged.at<double>(i, j) += 0.4 * std::exp(-(x * x + y * y));
            }
        const cv::Mat level = withoutLowFrequency(bulged, surfacePitch, 1.5);
        const double error = cv::norm(level, centred(known.heightMm)) / cv::norm(centred(known.heightMm));
        qInfo("%.2f %% of Sq is left of a bulge of 0.4 mm", 100 * error);
        QVERIFY(error < 0.06);
    }

    void everyFiniteHeightIsIntegrated_data()
    {
        QTest::addColumn<double>("mm");
        QTest::newRow("1 nm") << 1e-6;
        QTest::newRow("1 km") << 1e6;
    }
    void everyFiniteHeightIsIntegrated()
    {
        QFETCH(double, mm);
        const auto known = weave(12);
        const Slopes slopes{known.slopes.x * mm, known.slopes.y * mm};
        QVERIFY(errorInPercentOfRange(integrate(slopes, surfacePitch), known.heightMm * mm) < 0.005);
    }

    void noiseHasALargeCurlResidual()
    {
        const Slopes noise{randomImage(40, 50), randomImage(50, 40).t()};
        const auto residual = [](const Slopes& slopes, const Pitch& pitch) {
            return curlResidual(slopes, integrate(slopes, pitch), pitch);
        };
        QVERIFY(std::abs(residual(noise, {0.1, 0.1}) - 0.7) < 0.1);
        for (const double unit : {1e-300, 1e-30, 1e30, 1e300})  // their squares are no numbers any more
            QVERIFY(std::abs(residual({noise.x * unit, noise.y * unit}, {0.1, 0.1}) - residual(noise, {0.1, 0.1})) < 1e-9);
        const auto known = weave(12);
        QVERIFY(residual(known.slopes, surfacePitch) < 0.001);
        QVERIFY(residual({known.slopes.x, -known.slopes.y}, surfacePitch) > 0.3);
        QCOMPARE(residual({cv::Mat::zeros(4, 4, CV_64FC1), cv::Mat::zeros(4, 4, CV_64FC1)}, {}), 0.0);
        QVERIFY(residual({cv::Mat::ones(1, 9, CV_64FC1), cv::Mat::zeros(1, 9, CV_64FC1)}, {}) < 1e-12);
    }

    void columnsFollowTheirDenseSystem()
    {
        const std::vector<double> stiffness{0, 0, 1e-5, 0.01, 1, 4, 1e6};
        for (const int rows : {1, 2, 3, 40, 300}) {
            const cv::Mat values = randomImage(rows, static_cast<int>(stiffness.size()));
            cv::Mat found = values.clone(), single;
            values.convertTo(single, CV_32F);
            solveMirroredColumns(found, stiffness);
            solveMirroredColumns(single, stiffness);
            for (int j = 0; j < values.cols; ++j) {
                const double free = stiffness[static_cast<std::size_t>(j)] > 0 ? 0 : 1;
                const cv::Mat wanted = values.col(j) - free * cv::mean(values.col(j))[0];
                const cv::Mat reached = denseColumn(rows, stiffness[static_cast<std::size_t>(j)]) * found.col(j);
                const double size = std::max(1.0, cv::norm(found.col(j), cv::NORM_INF));
                QVERIFY(largestDifference(reached, wanted) < 1e-12 * size);
                QVERIFY(free == 0 || std::abs(cv::mean(found.col(j))[0]) < 1e-12 * size);
                QVERIFY(largestDifference(single.col(j), found.col(j)) < 1e-5 * size);  // sums of 300 rounded values
            }
        }
    }

    void stretchedPixelsKeepTheirDigits_data()
    {
        QTest::addColumn<double>("ratio");
        for (const double ratio : {1e-3, 0.01, 0.1, 1.0, 15.9, 16.1, 100.0, 1e3}) QTest::addRow("%g", ratio) << ratio;
    }

    void stretchedPixelsKeepTheirDigits()
    {
        QFETCH(double, ratio);
        // Least squares weigh the two directions by the square of the ratio, and rounding with them.
        const double limit = 1e-12 + 1e-14 * std::pow(std::max(ratio, 1 / ratio), 2);
        const Pitch pitch{0.01 * ratio, 0.01};
        const cv::Mat height = centred(randomImage(37, 41));
        QVERIFY(largestDifference(integrate(forwardSlopes(height, pitch), pitch, SlopeKind::Forward), height) < limit);
    }

    void highPassHalvesAWaveOfTheCutOff()
    {
        const int columns = 81, k = 6;
        const Pitch pitch{0.1, 0.1};
        cv::Mat wave(5, columns, CV_64FC1);
        for (int i = 0; i < 5; ++i)
            for (int j = 0; j < columns; ++j) wave.at<double>(i, j) = std::cos(std::numbers::pi * k * (j + 0.5) / columns);
        const double wavelength = 2.0 * columns * pitch.x / k;
        QVERIFY(largestDifference(withoutLowFrequency(wave + 5, pitch, wavelength), 0.5 * wave) < 1e-12);
        QVERIFY(largestDifference(withoutLowFrequency(wave, pitch, 10 * wavelength), wave) < 1e-12);
    }

    void unusableSlopesAreRefused()
    {
        const cv::Mat even = cv::Mat::zeros(4, 4, CV_32FC1);
        cv::Mat broken = even.clone();
        broken.at<float>(2, 1) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(refusalOf([&] { integrate({even, broken}, {}); }).contains("not finite"));
        QVERIFY(refusalOf([&] { integrate({even, cv::Mat::zeros(4, 5, CV_32FC1)}, {}); }).contains("5 x 4"));
        QVERIFY(refusalOf([&] { integrate({even, even}, {0, 1}); }).contains("pitch"));
        QVERIFY(refusalOf([&] { integrate({}, {}); }).contains("0 x 0"));
    }
};

QTEST_GUILESS_MAIN(SurfaceIntegrationTest)
#include "surface_integration_test.moc"
