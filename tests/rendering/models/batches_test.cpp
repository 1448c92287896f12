// Contents of a batch: crops at the expected places, and pairs that belong together.
#include "rendering/models/networks/batches.h"

#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/ring_spectrum.h"

using namespace rendering::models;

namespace {

/// Height and brightness decrease along one line, so that both reveal the place.
TrainingData slopes(bool aligned)
{
    TrainingData data;
    data.aligned = aligned;
    data.architecture.crop = 32;
    data.architecture.heightScaleMm = 1;
    TrainingFabric fabric;
    for (int index = 0; index < 2; ++index) {
        TrainingPhotograph photograph{index, cv::Mat(96, 96, CV_8UC3), 0};
        TrainingHeight height{index, cv::Mat(96, 96, CV_32F), 0, std::vector<float>(ringCount, -5)};
        for (int row = 0; row < 96; ++row)
            for (int column = 0; column < 96; ++column) {
                const int value = column + row;
                photograph.rgb.at<cv::Vec3b>(row, column) = cv::Vec3b::all(static_cast<unsigned char>(value));
                height.heightMm.at<float>(row, column) = static_cast<float>(value) / 255;
            }
        fabric.photographs.push_back(photograph);
        fabric.heights.push_back(height);
        fabric.strokes.push_back(
            {index, {cv::Mat(data.architecture.rows, data.architecture.frames, CV_32F, cv::Scalar(index)), 0.3F}});
    }
    data.training = data.validation = {fabric};
    return data;
}

}  // namespace

class BatchesTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void turnedCropCopiesWholePixels()
    {
        const TrainingData data = slopes(false);
        const cv::Mat& image = data.training[0].heights[0].heightMm;
        const cv::Mat crop = turnedCrop(image, {47.5, 47.5}, 0, 32);
        QVERIFY(cv::norm(crop, image({32, 32, 32, 32}), cv::NORM_INF) == 0);
    }

    void aPhotographIsScaledByItsOwnPitch()
    {
        namespace fabrics = rendering::fabrics;
        const QTemporaryDir folder;
        fabrics::ProceduralOptions procedural;
        procedural.fabrics = 1;
        procedural.samples = 3;
        const auto dataset = fabrics::makeProceduralFabrics(folder.filePath("set").toStdString(), procedural);
        const auto widths = [&] {
            std::map<int, int> widthOf;
            for (const TrainingPhotograph& one :
                 readTrainingData(dataset, {}, {.split = SplitBy::Augmented, .heldOut = {}}).training.at(0).photographs)
                widthOf[one.index] = one.rgb.cols;
            return widthOf;
        };
        const auto before = widths();
        QCOMPARE(before.size(), std::size_t{3});
        const int changed = std::next(before.begin())->first;
        auto places = fabrics::readSamplePlaces(dataset);
        for (fabrics::SamplePlace& place : places)
            if (place.modality == fabrics::Modality::Visual && place.index == changed)
                place.mmPerPixel = 2 * *dataset.tactileMmPerPixel;
        fabrics::writeSamplePlaces(dataset, places);
        const auto after = widths();
        for (const auto& [index, width] : before) QCOMPARE(after.at(index), index == changed ? 2 * width : width);
    }

    void zoomedCropShowsMoreOfTheImage()
    {
        const TrainingData data = slopes(false);
        const cv::Mat crop = turnedCrop(data.training[0].heights[0].heightMm, {47.5, 47.5}, 0, 32, 2);
        QVERIFY(std::abs(crop.at<float>(16, 31) - crop.at<float>(16, 0) - 31 * 2 / 255.0F) < 0.01F);
        QVERIFY(std::abs(cv::mean(crop)[0] - 95 / 255.0) < 0.01);
    }

    void alignedPairsShowOnePlace()
    {
        const TrainingData data = slopes(true);
        protocols::Random random(5);
        BatchOptions options;
        options.size = 6;
        options.augment = false;
        options.margin = 8;
        const Batch batch = drawBatch(data, data.validation, options, random);
        QCOMPARE(batch.margin, 0);
        const std::size_t plane = 32 * 32;
        for (std::size_t i = 0; i < 6; ++i)
            for (std::size_t pixel = 0; pixel < plane; ++pixel)
                QVERIFY(std::abs(batch.photographs[i * 3 * plane + pixel] - batch.heights[i * plane + pixel]) < 1e-3F);
    }

    void zoomKeepsSlopes()
    {
        const TrainingData data = slopes(true);
        protocols::Random random(6);
        BatchOptions options;
        options.size = 40;
        const Batch batch = drawBatch(data, data.training, options, random);
        const std::size_t plane = 32 * 32;
        for (std::size_t i = 0; i < 40; ++i) {
            const float* height = batch.heights.data() + i * plane;
            // The plane has the same slope in every crop and direction, away from mirrored borders.
            const float right = (height[16 * 32 + 22] - height[16 * 32 + 10]) / 12,
                        down = (height[22 * 32 + 16] - height[10 * 32 + 16]) / 12;
            QVERIFY2(std::abs(std::hypot(right, down) - std::sqrt(2.0F) / 255) < 0.1F / 255,
                     qPrintable(QString::number(std::hypot(right, down) * 255)));
        }
    }

    void strokesAloneComeWithoutHeights()
    {
        const TrainingData data = slopes(false);
        protocols::Random random(7);
        BatchOptions options;
        options.heights = false;
        const Batch batch = drawBatch(data, data.training, options, random);
        QVERIFY(batch.heights.empty() && batch.rings.empty());
        QCOMPARE(batch.means.size(), std::size_t{8});
    }

    void weakPairsHaveAMarginForRegistration()
    {
        const TrainingData data = slopes(false);
        protocols::Random random(8);
        BatchOptions options;
        options.size = 2;
        options.margin = 12;
        const Batch batch = drawBatch(data, data.training, options, random);
        QCOMPARE(batch.heights.size(), std::size_t{2 * 56 * 56});
    }
};

QTEST_APPLESS_MAIN(BatchesTest)
#include "batches_test.moc"
