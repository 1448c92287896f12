// Slopes and heights of tiles whose borders meet, the sign of slopes along y, and places that a tile shows twice.
#include "rendering/signals/periodic_slopes.h"

#include <QTest>

#include "rendering/signals/periodic_transform.h"
#include "rendering/signals/repeated_place.h"
#include "tests/rendering/fabric_files.h"
#include "tests/rendering/signals/oblique_waves.h"

using namespace rendering::signals;
using scan_folders::obliqueWaves;

namespace {

cv::Mat cloth(cv::Size size, std::uint64_t seed) { return scan_folders::unevenCloth(size, size.width, seed).heightMm; }

}  // namespace

class PeriodicSlopesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void transformsOfAnySizeComeBack_data()
    {
        QTest::addColumn<int>("columns");
        QTest::addColumn<int>("rows");
        QTest::newRow("powers of two") << 64 << 128;
        QTest::newRow("odd") << 33 << 17;
        QTest::newRow("a prime") << 101 << 50;
        QTest::newRow("one row") << 40 << 1;
    }

    void transformsOfAnySizeComeBack()
    {
        QFETCH(int, columns);
        QFETCH(int, rows);
        cv::Mat values(rows, columns, CV_32FC1);
        cv::randu(values, -1, 1);
        QVERIFY(cv::norm(inverseFourierTransform(fourierTransform(values), columns), values, cv::NORM_INF) < 1e-5);
        QCOMPARE(fourierTransform(values).at<cv::Vec2f>(0, 0)[0] / float(values.total()), float(cv::mean(values)[0]));
    }

    void aSurfaceComesBackFromItsSlopes_data()
    {
        QTest::addColumn<int>("columns");
        QTest::addColumn<int>("rows");
        QTest::newRow("powers of two") << 64 << 128;
        QTest::newRow("odd") << 97 << 61;
        QTest::newRow("a prime and an even number") << 101 << 50;
    }

    void aSurfaceComesBackFromItsSlopes()
    {
        QFETCH(int, columns);
        QFETCH(int, rows);
        const double tileMm = 20, pitch = tileMm / columns;
        const auto known = obliqueWaves({columns, rows}, tileMm);
        const cv::Mat height = integratePeriodic(known.slopes, {pitch, pitch});
        const double size = cv::norm(known.heightMm, cv::NORM_INF);
        QVERIFY2(cv::norm(height, known.heightMm, cv::NORM_INF) < 1e-4 * size, "height");
        const Slopes slopes = periodicSlopes(known.heightMm, {pitch, pitch});
        QVERIFY(cv::norm(slopes.x, known.slopes.x, cv::NORM_INF) < 1e-4 * cv::norm(known.slopes.x, cv::NORM_INF));
        QVERIFY(cv::norm(slopes.y, known.slopes.y, cv::NORM_INF) < 1e-4 * cv::norm(known.slopes.y, cv::NORM_INF));
    }

    /// The mean of a slope belongs to no periodic surface: 8 bits store level cloth as 127 or 128, never as 127.5.
    void aSlopeEverywhereIsIgnored()
    {
        auto known = obliqueWaves({96, 64}, 20);
        known.slopes.x += 0.02;
        const cv::Mat height = integratePeriodic(known.slopes, {20.0 / 96, 20.0 / 96});
        QVERIFY(cv::norm(height, known.heightMm, cv::NORM_INF) < 1e-4 * cv::norm(known.heightMm, cv::NORM_INF));
    }

    void theSignOfSlopesAlongYIsFound()
    {
        const cv::Mat surface = cloth({128, 96}, 3);
        Slopes slopes = periodicSlopes(surface, {1, 1});
        const SlopeAgreement right = slopeAgreement(slopes);
        QVERIFY2(right.agreement > 0.99 && right.isClear(), qPrintable(QString::number(right.agreement)));
        slopes.y *= -1;
        const SlopeAgreement wrong = slopeAgreement(slopes);
        QVERIFY2(wrong.agreement < -0.99 && wrong.isClear(), qPrintable(QString::number(wrong.agreement)));
        slopes.y = periodicSlopes(cloth({128, 96}, 4), {1, 1}).y;
        QVERIFY(!slopeAgreement(slopes).isClear());
        const SlopeAgreement flat = slopeAgreement({cv::Mat::zeros(32, 32, CV_32FC1), cv::Mat::zeros(32, 32, CV_32FC1)});
        QVERIFY(flat.agreement == 0 && !flat.isClear());
    }

    void slopesThatAreNotFiniteAreRefused()
    {
        Slopes slopes{cv::Mat::zeros(8, 8, CV_32FC1), cv::Mat::zeros(8, 8, CV_32FC1)};
        slopes.x.at<float>(2, 3) = std::numeric_limits<float>::quiet_NaN();
        QVERIFY(fabric_files::contains(fabric_files::refusalOf([&] { integratePeriodic(slopes, {1, 1}); }), "not finite"));
        QVERIFY(fabric_files::contains(fabric_files::refusalOf([&] {
                                           integratePeriodic({slopes.y, cv::Mat::zeros(8, 9, CV_32FC1)}, {1, 1});
                                       }),
                                       "differ in size"));
        QVERIFY(fabric_files::contains(fabric_files::refusalOf([&] {
                                           integratePeriodic({slopes.y, slopes.y}, {0, 1});
                                       }),
                                       "pitch"));
    }

    void aCopiedPatchIsFoundWhereItLies()
    {
        cv::Mat picture = cloth({300, 256}, 5);
        QVERIFY(!repeatedPlace(picture));
        const cv::Mat patch = picture(cv::Rect(20, 30, 90, 80)).clone();
        patch.copyTo(picture(cv::Rect(180, 140, 90, 80)));
        const auto found = repeatedPlace(picture);
        QVERIFY(found.has_value());
        QVERIFY2(found->match > 0.99 && found->match < 1.001, qPrintable(QString::number(found->match)));
        // The distance may be given from either of the two places.
        const bool isThere = (found->rightPx == 160 && found->downPx == 110) || (found->rightPx == 140 && found->downPx == 146);
        QVERIFY2(isThere, qPrintable(QStringLiteral("%1 %2").arg(found->rightPx).arg(found->downPx)));
    }

    void aFlatPictureRepeatsNothing() { QVERIFY(!repeatedPlace(cv::Mat(200, 200, CV_32FC1, cv::Scalar(0.5)))); }
};

QTEST_GUILESS_MAIN(PeriodicSlopesTest)
#include "periodic_slopes_test.moc"
