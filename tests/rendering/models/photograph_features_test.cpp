// Features of a photograph identify its fabric, independent of place, rotation and size.
#include "rendering/models/photograph_features.h"

#include <QTemporaryDir>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"

using namespace rendering;
using models::photographFeatures;

namespace {

double apart(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
    return std::sqrt(sum);
}

}  // namespace

class PhotographFeaturesTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fabrics::Dataset m_dataset;

    cv::Mat photograph(std::size_t fabric, int index) const
    {
        return fabrics::readPhotograph(m_dataset, m_dataset.fabrics[fabric].id, index);
    }

    double nearestOther(const std::vector<float>& features, std::size_t fabric) const
    {
        double nearest = 1e9;
        for (std::size_t other = 0; other < m_dataset.fabrics.size(); ++other)
            if (other != fabric) nearest = std::min(nearest, apart(features, photographFeatures(photograph(other, 1))));
        return nearest;
    }

private Q_SLOTS:
    void initTestCase()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 6;
        options.samples = 3;
        options.seed = 11;
        m_dataset = fabrics::makeProceduralFabrics(m_folder.filePath("fabrics").toStdString(), options);
    }

    void sameFabricElsewhereIsNearerThanAnyOther()
    {
        for (std::size_t fabric = 0; fabric < m_dataset.fabrics.size(); ++fabric) {
            const std::vector<float> features = photographFeatures(photograph(fabric, 0));
            const double same = apart(features, photographFeatures(photograph(fabric, 1)));
            QVERIFY2(same < nearestOther(features, fabric), m_dataset.fabrics[fabric].name.c_str());
        }
    }

    void dyeAndLampCountLessThanTheWeave()
    {
        const std::vector<float> features = photographFeatures(photograph(2, 0));
        cv::Mat darker;
        cv::multiply(photograph(2, 1), cv::Scalar(0.7, 0.6, 0.5), darker);
        QVERIFY2(apart(features, photographFeatures(darker)) < nearestOther(features, 2),
                 qPrintable(QString("%1 %2").arg(apart(features, photographFeatures(darker))).arg(nearestOther(features, 2))));
    }

    void quarterTurnsAndMirrorsChangeNothing()
    {
        const cv::Mat whole = photograph(3, 0), patch = whole({3, 7, 200, 90});
        for (const cv::Mat& picture : {whole, patch}) {
            const std::vector<float> features = photographFeatures(picture);
            for (const int turn : {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180, cv::ROTATE_90_COUNTERCLOCKWISE}) {
                cv::Mat turned;
                cv::rotate(picture, turned, turn);
                QVERIFY2(apart(features, photographFeatures(turned)) < 0.02,
                         qPrintable(QString::number(apart(features, photographFeatures(turned)))));
            }
            cv::Mat mirrored;
            cv::flip(picture, mirrored, 1);
            QVERIFY(apart(features, photographFeatures(mirrored)) < 0.02);
        }
    }

    void anyRotationStaysWithItsFabric()
    {
        const cv::Mat whole = photograph(3, 0);
        cv::Mat slanted;
        cv::warpAffine(whole, slanted, cv::getRotationMatrix2D({128, 128}, 33, 1), {256, 256}, cv::INTER_CUBIC,
                       cv::BORDER_REFLECT);
        const std::vector<float> features = photographFeatures(slanted({48, 48, 160, 160}));
        QVERIFY(apart(features, photographFeatures(whole)) < nearestOther(features, 3));
    }

    void anyPictureGivesFiniteNumbers_data()
    {
        QTest::addColumn<int>("width");
        QTest::addColumn<int>("height");
        QTest::addColumn<int>("value");
        QTest::newRow("black") << 256 << 256 << 0;
        QTest::newRow("white") << 256 << 256 << 255;
        QTest::newRow("grey") << 130 << 500 << 128;
        QTest::newRow("one pixel") << 1 << 1 << 77;
        QTest::newRow("a line") << 1 << 5000 << 200;
        QTest::newRow("wide line") << 40000 << 2 << 200;
        QTest::newRow("large") << 8000 << 8000 << 90;
        QTest::newRow("noise") << 300 << 200 << -1;
    }

    void anyPictureGivesFiniteNumbers()
    {
        QFETCH(int, width);
        QFETCH(int, height);
        QFETCH(int, value);
        cv::Mat picture(height, width, CV_8UC3, cv::Scalar::all(std::max(0, value)));
        if (value < 0) cv::randu(picture, 0, 256);
        const std::vector<float> features = photographFeatures(picture);
        QCOMPARE(features.size(), std::size_t{22});
        for (const float feature : features) QVERIFY(std::isfinite(feature) && std::abs(feature) < 20);
    }

    void onlyColourPicturesAreAccepted()
    {
        QVERIFY_THROWS_EXCEPTION(protocols::Error, photographFeatures(cv::Mat()));
        QVERIFY_THROWS_EXCEPTION(protocols::Error, photographFeatures(cv::Mat(9, 9, CV_8UC1, cv::Scalar(3))));
    }
};

QTEST_GUILESS_MAIN(PhotographFeaturesTest)
#include "photograph_features_test.moc"
