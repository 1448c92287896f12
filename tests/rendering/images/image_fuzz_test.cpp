// Feeds mutated files to the readers of PNG, TIFF, .npy, PGM, TrueMap and calibrations. Each reader must return a whole
// image or refuse the file by name. A run takes a few seconds with a fixed seed; VIS2HAP_FUZZ_SECONDS=600 makes it longer.
#include <QElapsedTimer>
#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/random.h"
#include "rendering/images/image_io.h"
#include "rendering/images/true_map.h"
#include "rendering/signals/tactile/calibration.h"
#include "tests/support/mutated_files.h"
#include "tests/support/true_map_bytes.h"

namespace {

namespace fs = std::filesystem;

cv::Mat noise(int rows, int columns, int type)
{
    protocols::Random random(6);
    cv::Mat image(rows, columns, type);
    for (int i = 0; i < rows; ++i)
        for (std::size_t byte = 0; byte < image.cols * image.elemSize(); ++byte)
            image.ptr<uchar>(i)[byte] = static_cast<uchar>(random.below(256));
    return image;
}

cv::Mat heights(int rows, int columns)
{
    protocols::Random random(8);
    cv::Mat image(rows, columns, CV_32FC1);
    for (float& value : cv::Mat_<float>(image)) value = static_cast<float>(random.normal());
    return image;
}

std::string bytesIn(const fs::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

const char* const sensorJson =
    "{\"schema\":\"vis2hap.calibration/1\",\"kind\":\"network\",\"light\":\"own\",\"channels\":1,"
    "\"by_place\":false,\"light_scale\":2,\"sizes\":[1,2,2],\"weights\":[[1,2,3,4],[5,6,7,8,9,10]],"
    "\"mm_per_pixel\":0.1,\"high_pass_cutoff_mm\":null,\"zero_percentile\":2}";

/// Reads every byte of an image, so that a sanitizer checks them.
void use(const cv::Mat& image)
{
    if (image.empty()) throw std::runtime_error("an image without pixels was read");
    volatile double sum = 0;
    for (int i = 0; i < image.rows; ++i)
        for (std::size_t byte = 0; byte < static_cast<std::size_t>(image.cols) * image.elemSize(); ++byte)
            sum = sum + image.ptr<uchar>(i)[byte];
}

}  // namespace

class ImageFuzzTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void spoiltImagesAreReadWholeOrRefusedByName_data()
    {
        QTest::addColumn<QString>("name");
        for (const char* name :
             {"grey.png", "colour.png", "deep.png", "height.tiff", "array.npy", "image.pgm", "map.tmd", "sensor.json"})
            QTest::newRow(name) << QString(name);
    }
    void spoiltImagesAreReadWholeOrRefusedByName()
    {
        QFETCH(QString, name);
        const fs::path file = fs::path(m_folder.path().toStdString()) / name.toStdString();
        const std::string sound = soundBytes(file);
        QVERIFY(!sound.empty());
        protocols::Random random(21);
        int read = 0, refused = 0;
        QElapsedTimer clock;
        const double seconds = mutated_files::fuzzSeconds(0.6);
        for (clock.start(); clock.elapsed() < 1000 * seconds;) {
            const std::string spoilt = mutated_files::mutated(sound, random);
            std::ofstream(file, std::ios::binary | std::ios::trunc) << spoilt;
            try {
                readAndUse(file);
                ++read;
            } catch (const protocols::Error& refusal) {
                QVERIFY2(QString(refusal.what()).contains(name), refusal.what());
                ++refused;
            } catch (const std::exception& fault) {
                std::ofstream(m_folder.filePath("found").toStdString(), std::ios::binary) << spoilt;
                QFAIL(qPrintable(QString("%1 (the file, base64: %2)")
                                     .arg(fault.what(), QString(QByteArray::fromStdString(spoilt).toBase64()).left(2000))));
            }
        }
        qInfo("%d read, %d refused", read, refused);
        QVERIFY(refused > 0);
    }

private:
    static void readAndUse(const fs::path& file)
    {
        if (file.extension() == ".tmd")
            use(rendering::readTrueMap(file).heightMm);
        else if (file.extension() == ".json")
            rendering::signals::readCalibration(file);
        else
            use(rendering::readImage(file));
    }

    static std::string soundBytes(const fs::path& file)
    {
        const std::string name = file.filename().string();
        if (name == "map.tmd") return tests::support::trueMapBytes(heights(7, 9));
        if (name == "sensor.json") return sensorJson;
        if (name == "height.tiff") rendering::writeTiff(file, heights(11, 13));
        if (name == "array.npy") rendering::writeNpy(file, heights(11, 13));
        if (name == "image.pgm") rendering::writePgm(file, noise(11, 13, CV_8UC1));
        if (name == "grey.png") rendering::writePng(file, noise(11, 13, CV_8UC1));
        if (name == "colour.png") rendering::writePng(file, noise(11, 13, CV_8UC3));
        if (name == "deep.png") rendering::writePng(file, noise(11, 13, CV_16UC3));
        return bytesIn(file);
    }

    QTemporaryDir m_folder;
};

QTEST_GUILESS_MAIN(ImageFuzzTest)
#include "image_fuzz_test.moc"
