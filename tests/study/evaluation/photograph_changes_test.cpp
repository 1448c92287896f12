// Changed photographs of the same cloth: what changes in the generated signals, with simulated generators.
#include "study/evaluation/photograph_changes.h"

#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/fabrics/procedural/procedural_fabrics.h"

namespace fabrics = rendering::fabrics;
namespace models = rendering::models;
using namespace study::evaluation;

namespace {

/// Relief is brightness over its mean; friction is `frictionOf` the photograph, with an interval of 10 % on each side.
Generate generator(double (*frictionOf)(const cv::Mat& rgb))
{
    return [=](std::span<const models::InputPhotograph> photographs, const models::GenerationOptions&) {
        std::vector<models::GeneratedSignals> answers;
        for (const models::InputPhotograph& one : photographs) {
            models::GeneratedSignals signals;
            cv::cvtColor(one.photograph, signals.heightMm, cv::COLOR_RGB2GRAY);
            signals.heightMm.convertTo(signals.heightMm, CV_32F, 1 / (1 + cv::mean(signals.heightMm)[0]));
            signals.meanFriction = frictionOf(one.photograph);
            signals.photograph.meanFriction = models::FrictionInterval{0.9 * signals.meanFriction, 1.1 * signals.meanFriction};
            answers.push_back(signals);
        }
        return answers;
    };
}

double constant(const cv::Mat&) { return 0.3; }
double byBrightness(const cv::Mat& rgb) { return 0.1 + cv::mean(rgb)[1] / 255; }

const ChangeRow& rowNamed(const ChangeReport& changes, const char* name)
{
    return *std::ranges::find(changes.rows, name, &ChangeRow::name);
}

}  // namespace

class PhotographChangesTest : public QObject {
    Q_OBJECT

private:
    QTemporaryDir m_folder;
    fabrics::Dataset m_dataset;

private Q_SLOTS:
    void initTestCase()
    {
        fabrics::ProceduralOptions options;
        options.fabrics = 2;
        options.samples = 2;
        m_dataset = fabrics::makeProceduralFabrics(m_folder.filePath("fabrics").toStdString(), options);
    }

    void everyChangeLeavesAPictureOfTheSameSize()
    {
        const cv::Mat photograph = fabrics::readPhotograph(m_dataset, m_dataset.fabrics[0].id, 0);
        for (const PhotographChange& change : photographChanges()) {
            const cv::Mat changed = change.of(photograph);
            QVERIFY2(changed.type() == CV_8UC3 && changed.size() == photograph.size(), change.name.c_str());
            QVERIFY2(cv::norm(changed, photograph, cv::NORM_INF) > 0, change.name.c_str());
        }
        const cv::Scalar red = cv::mean(photographChanges()[0].of(photograph));
        QVERIFY(red[0] > 1.5 * red[2]);
    }

    void frictionThatFollowsTheBrightnessIsFound()
    {
        const ChangeReport steady = evaluateChanges(m_dataset, {}, {}, generator(constant)),
                           fickle = evaluateChanges(m_dataset, {}, {}, generator(byBrightness));
        QCOMPARE(steady.photographs, 2);
        QCOMPARE(steady.rows.size(), photographChanges().size());
        for (const ChangeRow& row : steady.rows) QVERIFY2(row.friction == 0 && row.covered == 1.0, row.name.c_str());
        const ChangeRow& half = rowNamed(fickle, "half exposure");
        QVERIFY2(half.friction > 0.15 && half.covered == 0.0 && !half.met(), qPrintable(QString::number(half.friction)));
        QVERIFY(half.worstFriction >= half.friction);
        QVERIFY(QString::fromStdString(changesText(fickle)).contains("TOO MUCH"));
    }

    void reliefThatFollowsTheSharpnessIsFound()
    {
        const ChangeReport changes = evaluateChanges(m_dataset, {}, {}, generator(constant));
        const ChangeRow &blurred = rowNamed(changes, "blurred by 1 px"), &grey = rowNamed(changes, "grey");
        QVERIFY2(grey.correlation > 0.999, qPrintable(QString::number(grey.correlation)));
        QVERIFY2(blurred.correlation < grey.correlation && blurred.worstCorrelation <= blurred.correlation,
                 qPrintable(QString::number(blurred.correlation)));
        const auto json = changesJson(changes);
        QCOMPARE(json.at("changes").at(2).at("relief_correlation").get<double>(), blurred.correlation);
    }

    void moreSamplesOfAFabricAreTakenWhereTheyAreWanted()
    {
        EvaluationRequest request;
        request.samplesPerFabric = 2;
        QCOMPARE(evaluateChanges(m_dataset, request, {}, generator(constant)).photographs, 4);
    }
};

QTEST_GUILESS_MAIN(PhotographChangesTest)
#include "photograph_changes_test.moc"
