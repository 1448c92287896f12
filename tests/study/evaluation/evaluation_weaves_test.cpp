// Evaluation on photographs without measurements: whether the relief keeps the weave. With simulated generators, and with the
// shipped weights on photographs of twills.
#include <QTemporaryDir>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "protocols/files/sha256.h"
#include "rendering/fabrics/dataset.h"
#include "rendering/images/image_io.h"
#include "rendering/models/model_card_fields.h"
#include "study/evaluation/weaves.h"
#include "tests/rendering/shared_data.h"

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;
using namespace study::evaluation;

namespace {

cv::Mat waves(double periodPx, double directionDeg, cv::Size size = {200, 200})
{
    cv::Mat picture(size, CV_8UC3);
    const double angle = directionDeg * std::numbers::pi / 180;
    for (int row = 0; row < picture.rows; ++row)
        for (int column = 0; column < picture.cols; ++column) {
            const double along = column * std::cos(angle) + row * std::sin(angle);
            picture.at<cv::Vec3b>(row, column) = cv::Vec3b::all(
                static_cast<unsigned char>(std::lround(120 + 40 * std::sin(2 * std::numbers::pi * along / periodPx))));
        }
    return picture;
}

/// Generator that takes brightness as height, enlarges the map by `zoom` and rotates it by 90° if `turned`.
Generate madeUp(double zoom, bool turned)
{
    return [=](std::span<const models::InputPhotograph> photographs, const models::GenerationOptions& options) {
        std::vector<models::GeneratedSignals> answers;
        for (const models::InputPhotograph& one : photographs) {
            cv::Mat grey;
            cv::cvtColor(one.photograph, grey, cv::COLOR_RGB2GRAY);
            const cv::Mat move = (cv::Mat_<double>(2, 3) << zoom, 0, 0, 0, zoom, 0);
            cv::warpAffine(grey, grey, move, grey.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT_101);
            if (turned) cv::rotate(grey, grey, cv::ROTATE_90_CLOCKWISE);
            models::GeneratedSignals signals;
            grey.convertTo(signals.heightMm, CV_32F, 0.001);
            signals.heightMmPerPixel = 0.05;
            answers.push_back(signals);
        }
        if (options.friction) qFatal("friction was requested, but this evaluation does not use it");
        return answers;
    };
}

}  // namespace

class EvaluationWeavesTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fabrics::Dataset m_dataset;

    void write(const char* fabric, const cv::Mat& photograph)
    {
        const std::filesystem::path file =
            fabrics::samplePath(m_dataset, protocols::FabricId(fabric), fabrics::Modality::Visual, 0);
        std::filesystem::create_directories(file.parent_path());
        rendering::writePng(file, photograph);
    }

private Q_SLOTS:
    void initTestCase()
    {
        m_dataset.folder = m_folder.path().toStdString();
        m_dataset.name = "weaves";
        m_dataset.fabrics = {{protocols::FabricId("F01"), "oblique", ""},
                             {protocols::FabricId("F02"), "upright", ""},
                             {protocols::FabricId("F03"), "blank", ""}};
        write("F01", waves(7, 30));
        write("F02", waves(11, 90));
        write("F03", cv::Mat(200, 200, CV_8UC3, cv::Scalar::all(100)));
    }

    void faithfulReliefKeepsTheWeave()
    {
        const WeaveReport weaves = evaluateWeaves(m_dataset, {}, {}, madeUp(1, false));
        QCOMPARE(weaves.photographs.size(), std::size_t{3});
        QVERIFY(weaves.photographs[0].kept() && weaves.photographs[1].kept());
        QVERIFY(!weaves.photographs[2].photograph && !weaves.photographs[2].kept());
        QVERIFY(QString::fromStdString(weavesText(weaves)).contains("2 of 2 photographs"));
    }

    void photographsThatTheModelWasTrainedOnAreCounted()
    {
        QVERIFY(weavesText(evaluateWeaves(m_dataset, {}, {}, madeUp(1, false))).find("MEMORY") == std::string::npos);
        EvaluationRequest request;
        request.model = m_dataset.folder / "model.safetensors";
        models::ModelCardFields card = models::readModelCardFields(models::shippedModel());
        card.summary.trainingSampleHashes.push_back(
            protocols::sha256OfFile(fabrics::samplePath(m_dataset, protocols::FabricId("F02"), fabrics::Modality::Visual, 0)));
        std::ofstream(models::cardOf(request.model)) << models::cardText(card);
        const WeaveReport weaves = evaluateWeaves(m_dataset, request, {}, madeUp(1, false));
        QVERIFY(weavesText(weaves).find("trained on 1 of these 3 photographs") != std::string::npos);
        QCOMPARE(weavesJson(weaves).at("photographs_trained_on").get<int>(), 1);
    }

    /// The generators use the middle of a large photograph. The whole was squeezed onto its relief: +25 % and 11° here.
    void aLargePhotographIsComparedWhereItsReliefIs()
    {
        QTemporaryDir folder;
        fabrics::Dataset large;
        large.folder = folder.path().toStdString();
        large.name = "large";
        large.fabrics = {{protocols::FabricId("F01"), "oblique", ""}};
        const auto file = fabrics::samplePath(large, protocols::FabricId("F01"), fabrics::Modality::Visual, 0);
        std::filesystem::create_directories(file.parent_path());
        rendering::writePng(file, waves(8, 154, {3000, 2000}));
        const Generate middle = [](std::span<const models::InputPhotograph> photographs,
                                   const models::GenerationOptions& options) {
            std::vector<models::InputPhotograph> parts(photographs.begin(), photographs.end());
            for (models::InputPhotograph& one : parts) one.photograph = one.photograph(cv::Rect(476, 0, 2048, 2000));
            return madeUp(1, false)(parts, options);
        };
        const WeaveComparison one = evaluateWeaves(large, {}, {}, middle).photographs.front();
        QVERIFY2(one.comparable() && one.turnDeg < 1 && std::abs(one.periodChange) < 0.01,
                 qPrintable(QString("%1 %2").arg(one.periodChange).arg(one.turnDeg)));
    }

    void changedPeriodOrDirectionIsReported()
    {
        const WeaveReport coarser = evaluateWeaves(m_dataset, {}, {}, madeUp(1.08, false));
        QVERIFY(!coarser.photographs[0].kept() && coarser.photographs[0].turnDeg < 3);
        QVERIFY(std::abs(coarser.photographs[0].periodChange - 0.08) < 0.02);
        const WeaveReport turned = evaluateWeaves(m_dataset, {}, {}, madeUp(1, true));
        QVERIFY(!turned.photographs[1].kept() && turned.photographs[1].turnDeg > 85);
        QVERIFY(QString::fromStdString(weavesText(turned)).contains("NOT KEPT"));
    }

    void aTraceOfTheWeaveBeneathNoiseIsNotKept()
    {
        const Generate noisy = [](std::span<const models::InputPhotograph> photographs,
                                  const models::GenerationOptions& options) {
            auto answers = madeUp(1, false)(photographs, options);
            for (models::GeneratedSignals& one : answers) {
                cv::Mat noise(one.heightMm.size(), CV_32F);
                cv::theRNG().state = 9;
                cv::randn(noise, 0, 0.06);  // against a wave of 0.04 mm
                one.heightMm += noise;
            }
            return answers;
        };
        const WeaveReport weaves = evaluateWeaves(m_dataset, {}, {}, noisy);
        const WeaveComparison& one = weaves.photographs[0];
        QVERIFY2(one.comparable() && one.turnDeg < 1 && std::abs(one.periodChange) < 0.01, "the wave is still the strongest");
        QVERIFY2(one.shareOfPhotograph > 0.9 && one.shareOfRelief < 0.3, qPrintable(QString::number(one.shareOfRelief)));
        QVERIFY(!one.kept());
    }

    void jsonHasTheReasonForAMissingComparison()
    {
        const nlohmann::ordered_json json = weavesJson(evaluateWeaves(m_dataset, {}, {}, madeUp(1, false)));
        QCOMPARE(json.at("schema").get<std::string>(), std::string("vis2hap.evaluation/1"));
        QVERIFY(json.at("weaves").at(0).at("kept").get<bool>());
        QVERIFY(json.at("weaves").at(2).at("kept").is_null());
        QVERIFY(json.at("weaves").at(2).at("why").contains("period_change"));
    }

    void shippedWeightsKeepRealTwills()
    {
        const std::filesystem::path photographs = sharedData("fabricbtdf_photos");
        if (!std::filesystem::exists(photographs)) QSKIP("the shared photographs are missing (set VIS2HAP_SHARED)");
        QTemporaryDir folder;
        fabrics::Dataset dataset;
        dataset.folder = folder.path().toStdString();
        dataset.name = "twills";
        int number = 0;
        for (const char* name : {"twill1_R.png", "twill2_R.png", "twill3_R.png"}) {
            const std::string id = "F0" + std::to_string(++number);
            dataset.fabrics.push_back({protocols::FabricId(id), name, ""});
            const auto file = fabrics::samplePath(dataset, protocols::FabricId(id), fabrics::Modality::Visual, 0);
            std::filesystem::create_directories(file.parent_path());
            std::filesystem::copy_file(photographs / name, file);
        }
        EvaluationRequest request;
        request.quality = models::Quality::Fast;
        const WeaveReport weaves = evaluateWeaves(dataset, request);
        QVERIFY2(std::ranges::all_of(weaves.photographs, &WeaveComparison::kept), weavesText(weaves).c_str());
    }
};

QTEST_GUILESS_MAIN(EvaluationWeavesTest)
#include "evaluation_weaves_test.moc"
