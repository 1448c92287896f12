// Whether a photograph shows cloth: drawn cloth that the check never saw, drawn pictures of other things, and one cloth under
// changes of its photograph. Real pictures: `vis2hap evaluate DIR --cloth-check`.
#include "rendering/models/cloth/cloth_check.h"

#include <QTemporaryDir>
#include <QTest>
#include <filesystem>
#include <opencv2/imgproc.hpp>

#include "protocols/files/whole_file.h"
#include "rendering/fabrics/drawn/jpeg_loss.h"
#include "rendering/images/image_io.h"
#include "rendering/models/cloth/other_pictures.h"
#include "tests/rendering/refusal.h"

using namespace rendering;
using namespace rendering::models;

namespace {

constexpr std::uint64_t freshFamily = 4711;
constexpr int clothCount = 80, othersCount = 80;

cv::Mat plain(int red, int green, int blue) { return cv::Mat(240, 320, CV_8UC3, cv::Scalar(red, green, blue)); }

/// The picture after dye, half exposure, blur, noise, gamma, an uneven lamp, JPEG, half the scale.
std::vector<cv::Mat> changed(const cv::Mat& rgb)
{
    std::vector<cv::Mat> all(8);
    cv::Mat wide;
    rgb.convertTo(wide, CV_32F, 1.0 / 255);
    const auto back = [](const cv::Mat& values, cv::Mat& out) { values.convertTo(out, CV_8U, 255); };
    back(wide.mul(cv::Mat(wide.size(), CV_32FC3, cv::Scalar(0.9, 0.25, 0.3))), all[0]);
    back(wide * 0.5, all[1]);
    cv::GaussianBlur(rgb, all[2], {}, 1);
    cv::Mat noise(rgb.size(), CV_32FC3), bent;
    cv::RNG(3).fill(noise, cv::RNG::NORMAL, 0, 8.0 / 255);
    back(wide + noise, all[3]);
    cv::pow(wide, 1.4, bent);
    back(bent, all[4]);
    cv::Mat lamp = wide.clone();
    for (int x = 0; x < lamp.cols; ++x) lamp.col(x) *= 0.6 + 0.4 * x / lamp.cols;
    back(lamp, all[5]);
    all[6] = fabrics::afterJpeg(rgb, 60);
    cv::resize(rgb, all[7], {}, 0.5, 0.5, cv::INTER_AREA);
    return all;
}

}  // namespace

class ClothCheckTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void drawnClothIsTakenAndOtherThingsAreRefused()
    {
        const ClothCheckFigures figures = clothCheckFigures(shippedClothCheck(), freshFamily, clothCount);
        QVERIFY2(figures.clothRefused <= 0.03, qPrintable(QString::number(figures.clothRefused)));
        QVERIFY2(figures.othersRefused >= 0.85, qPrintable(QString::number(figures.othersRefused)));
    }

    void plainColoursAndTextAreNoCloth()
    {
        cv::Mat page = plain(250, 250, 245);
        cv::putText(page, "Of cloth", {110, 40}, cv::FONT_HERSHEY_COMPLEX, 1, cv::Scalar::all(20), 2, cv::LINE_AA);
        for (int line = 0; line < 6; ++line)
            cv::putText(page, line == 5 ? "and weft." : "Warp, weft and their", {40, 90 + 24 * line}, cv::FONT_HERSHEY_COMPLEX,
                        0.6, cv::Scalar::all(20), 1, cv::LINE_AA);
        for (const cv::Mat& picture : {plain(0, 0, 0), plain(255, 255, 255), plain(30, 60, 200), page})
            QCOMPARE(shippedClothCheck().judge(picture), ClothLikeness::NotCloth);
        QCOMPARE(shippedClothCheck().judge(cv::Mat(1, 1, CV_8UC3, cv::Scalar::all(90))), ClothLikeness::NotCloth);
    }

    /// Reduced to 1,536 px, such a photograph would have no row left.
    void aNarrowStripIsJudged()
    {
        for (const cv::Size size : {cv::Size(60'000, 16), cv::Size(1, 4000), cv::Size(2000, 40)})
            QCOMPARE(shippedClothCheck().judge(cv::Mat(size, CV_8UC3, cv::Scalar::all(90))), ClothLikeness::NotCloth);
    }

    void dyeExposureFocusAndScaleDecideNothing()
    {
        int refused = 0, all = 0;
        for (std::uint64_t i = 0; i < 20; ++i)
            for (const cv::Mat& picture : changed(drawnClothPicture(freshFamily, 500 + i))) {
                ++all;
                refused += shippedClothCheck().judge(picture) == ClothLikeness::NotCloth ? 1 : 0;
            }
        QVERIFY2(refused <= 0.03 * all, qPrintable(QString("%1 of %2").arg(refused).arg(all)));
    }

    void realTwillsAndSatinsAreTaken()
    {
        const QString shared = qEnvironmentVariable("VIS2HAP_SHARED", "../shared");
        const auto folder = std::filesystem::path(shared.toStdString()) / "data" / "fabricbtdf_photos";
        if (!std::filesystem::exists(folder)) QSKIP("the photographs of VIS2HAP_SHARED are not here");
        int taken = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".png")
                taken += shippedClothCheck().judge(readPng(entry.path())) != ClothLikeness::NotCloth ? 1 : 0;
        QCOMPARE(taken, 12);
    }

    void aCheckIsReadAsItWasWritten()
    {
        QTemporaryDir folder;
        const std::filesystem::path file = folder.filePath("check.json").toStdString();
        writeClothCheck(file, shippedClothCheck());
        const cv::Mat picture = drawnClothPicture(freshFamily, 3);
        QCOMPARE(readClothCheck(file).score(picture), shippedClothCheck().score(picture));
        protocols::writeWholeFile(file, "{\"schema\":\"vis2hap.cloth_check/1\"}");
        QVERIFY(refusalOf([&] { readClothCheck(file); }).contains("check.json"));
        protocols::writeWholeFile(file, "[");
        QVERIFY(refusalOf([&] { readClothCheck(file); }).contains("line 1, column 2: malformed JSON"));
        QVERIFY(refusalOf([&] { fitClothCheck(1, 5, 1); }).contains("too few"));
    }

    /// Before, a count beyond 32 bits was cut to another one.
    void countsOfACheckAreWhole()
    {
        QTemporaryDir folder;
        const std::filesystem::path file = folder.filePath("check.json").toStdString();
        writeClothCheck(file, shippedClothCheck());
        const QString sound = QString::fromStdString(protocols::readWholeFile(file));
        for (const char* altered : {"\"pictures\": 1200.9", "\"pictures\": 4294968496", "\"pictures\": 1e300", "\"seed\": -1"}) {
            const QString name = QString(altered).section(':', 0, 0);
            const QString from = name + (name.contains("seed") ? ": 1" : ": 1200");
            QVERIFY(sound.contains(from));
            protocols::writeWholeFile(file, QString(sound).replace(from, altered).toStdString());
            QVERIFY2(refusalOf([&] { readClothCheck(file); }).contains("is no whole number from 0"), altered);
        }
    }
};

QTEST_GUILESS_MAIN(ClothCheckTest)
#include "cloth_check_test.moc"
