// Complete evaluations with simulated generators (a perfect one and a constant one), and unusual data sets. Without libtorch.
#include <QTemporaryDir>
#include <QTest>
#include <atomic>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "protocols/files/sha256.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/models/model_card_fields.h"
#include "study/evaluation/controls.h"
#include "study/evaluation/criteria.h"
#include "study/evaluation/evaluation_json.h"
#include "study/evaluation/evaluation_text.h"
#include "study/evaluation/measured_signals.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering::fabrics;
using namespace study::evaluation;
using rendering::models::GeneratedSignals;
using rendering::models::InputPhotograph;

namespace {

std::string bytesOf(const cv::Mat& image)
{
    return protocols::sha256({reinterpret_cast<const char*>(image.data), image.total() * image.elemSize()});
}

/// Returns for each photograph the signals measured at its index. This is perfect if the data set is aligned.
class PerfectGenerator {
public:
    explicit PerfectGenerator(const Dataset& dataset) : m_dataset(dataset), m_measured(dataset, 0.05)
    {
        for (const FabricInfo& fabric : dataset.fabrics)
            for (const int index : sampleIndices(dataset, fabric.id, Modality::Visual))
                m_known[bytesOf(readPhotograph(dataset, fabric.id, index))] = {fabric.id, index};
    }

    Generate asFunction() const
    {
        return [this](std::span<const InputPhotograph> photographs, const rendering::models::GenerationOptions&) {
            std::vector<GeneratedSignals> answers;
            for (const InputPhotograph& one : photographs) {
                const auto& [fabric, index] = m_known.at(bytesOf(one.photograph));
                const auto trace = m_measured.trace(fabric, index);
                answers.push_back(
                    {m_measured.height(fabric, index), 0.05, {}, trace.values, trace.mmPerSample, trace.mean, {}, {}});
            }
            return answers;
        };
    }

private:
    const Dataset& m_dataset;
    MeasuredSignals m_measured;
    std::map<std::string, std::pair<FabricId, int>> m_known;
};

std::vector<GeneratedSignals> flatAnswers(std::span<const InputPhotograph> photographs,
                                          const rendering::models::GenerationOptions&)
{
    return std::vector<GeneratedSignals>(
        photographs.size(),
        {cv::Mat(256, 256, CV_32FC1, cv::Scalar(0.1)), 0.05, {}, std::vector<double>(480, 0.3), 1.0 / 12, 0.3, {}, {}});
}

double mean(const Evaluation& evaluation, PredictorKind kind, Measure measure)
{
    return *at(evaluation.predictor(kind)->mean, measure);
}

}  // namespace

class EvaluationTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_root = pathOf(m_folder);
        ProceduralOptions options;
        options.fabrics = 3;
        options.samples = 12;
        options.seed = 5;
        options.pairing = Pairing::Aligned;
        m_dataset = makeProceduralFabrics(m_root / "aligned", options);
        m_dataset = readDataset(m_root / "aligned");
        m_request.model = card("plain", {});
        m_request.split = SplitKind::Sample;
    }

    void init() { m_dataset = readDataset(m_root / "aligned"); }

    void perfectGeneratorMeetsEveryCriterion()
    {
        const PerfectGenerator perfect(m_dataset);
        const Evaluation evaluation = evaluate(m_dataset, m_request, {}, perfect.asFunction());
        QCOMPARE(evaluation.pairs, 3);
        const auto generated = PredictorKind::Generated;
        QVERIFY(std::abs(mean(evaluation, generated, Measure::Ssim) - 1) < 1e-9);
        QVERIFY(mean(evaluation, generated, Measure::SsimRegistered) > 0.999);  // positions are rounded to 1/32 px
        QCOMPARE(mean(evaluation, generated, Measure::FrictionMae), 0.0);
        QCOMPARE(mean(evaluation, generated, Measure::IdentifiedByBoth),
                 mean(evaluation, PredictorKind::Measured, Measure::IdentifiedByBoth));
        QVERIFY(mean(evaluation, PredictorKind::AnotherPlace, Measure::SsimRegistered) < 0.98);
        for (const FabricValues& fabric : evaluation.predictor(generated)->fabrics)
            QCOMPARE(*at(fabric.values, Measure::MeanFrictionError), 0.0);
        for (const Criterion& one : criteriaOf(evaluation)) QVERIFY2(one.reached.value_or(false), one.what.c_str());
    }

    /// At ten times the rate, 64 samples spanned a tenth of the length: other places were 1.4 dB off instead of 3.5 dB.
    void frictionFiguresDoNotChangeWithTheSampleRateOfTheRecords()
    {
        const fs::path copy = m_root / "dense";
        fs::copy(m_root / "aligned", copy, fs::copy_options::recursive);
        const Dataset dense = readDataset(copy);
        for (const FabricInfo& fabric : dense.fabrics)
            for (const int index : sampleIndices(dense, fabric.id, Modality::Friction)) {
                const std::vector<double> values = readFriction(m_dataset, fabric.id, index).values;
                std::string text = "t_s,mu\n";
                for (std::size_t i = 0; i + 5 < 10 * values.size(); ++i)
                    text += std::to_string(static_cast<double>(i) / 600) + ',' + std::to_string(values[(i + 5) / 10]) + '\n';
                write(samplePath(dense, fabric.id, Modality::Friction, index), text);
            }
        const PerfectGenerator perfect(m_dataset);
        const Evaluation usual = evaluate(m_dataset, m_request, {}, perfect.asFunction()),
                         fast = evaluate(dense, m_request, {}, perfect.asFunction());
        for (const Measure measure : {Measure::FrictionSpectrum, Measure::FrictionMaeOverMean, Measure::MeanFriction}) {
            const double before = mean(usual, PredictorKind::AnotherPlace, measure),
                         now = mean(fast, PredictorKind::AnotherPlace, measure);
            QVERIFY2(std::abs(now / before - 1) < 0.1, qPrintable(QString("%1 %2").arg(before).arg(now)));
        }
        QVERIFY(mean(fast, PredictorKind::Generated, Measure::FrictionSpectrum) < 1);
        QCOMPARE(mean(fast, PredictorKind::Measured, Measure::IdentifiedByFriction),
                 mean(usual, PredictorKind::Measured, Measure::IdentifiedByFriction));
    }

    void flatGeneratorMeetsAlmostNoCriterion()
    {
        const Evaluation evaluation = evaluate(m_dataset, m_request, {}, flatAnswers);
        QVERIFY(!at(evaluation.predictor(PredictorKind::Generated)->mean, Measure::SqRatio).exists());
        QVERIFY(mean(evaluation, PredictorKind::Generated, Measure::IdentifiedByBoth) < 0.5);
        int reached = 0;
        for (const Criterion& one : criteriaOf(evaluation)) reached += one.reached.value_or(false);
        QVERIFY(reached <= 2);
    }

    void intervalsOfMeanFrictionAreCounted()
    {
        const PerfectGenerator perfect(m_dataset);
        const auto with = [&](double low, double high) {
            const Generate stated = [&, generate = perfect.asFunction()](auto photographs, const auto& options) {
                auto answers = generate(photographs, options);
                for (GeneratedSignals& one : answers)
                    one.photograph.meanFriction =
                        rendering::models::FrictionInterval{low * one.meanFriction, high * one.meanFriction};
                return answers;
            };
            return evaluate(m_dataset, m_request, {}, stated);
        };
        QCOMPARE(mean(with(0.9, 1.1), PredictorKind::Generated, Measure::FrictionCovered), 1.0);
        QCOMPARE(mean(with(1.1, 1.2), PredictorKind::Generated, Measure::FrictionCovered), 0.0);
        QCOMPARE(at(with(0.9, 1.1).predictor(PredictorKind::Retrieval)->mean, Measure::FrictionCovered).why(),
                 std::string("it gives no interval of its mean friction"));
    }

    void controlsComeFromTheTrainingPart()
    {
        const Evaluation evaluation = evaluate(m_dataset, m_request, {}, flatAnswers);
        // The mean of a fabric has a smaller error than a global constant. The nearest photograph is mostly of the same fabric.
        QVERIFY(mean(evaluation, PredictorKind::FabricMean, Measure::MeanFrictionError) <
                mean(evaluation, PredictorKind::GlobalConstant, Measure::MeanFrictionError));
        QVERIFY(mean(evaluation, PredictorKind::Retrieval, Measure::IdentifiedByHeight) > 0.6);
        QCOMPARE(evaluation.trainingPhotographs, 30);
        QCOMPARE(at(evaluation.predictor(PredictorKind::FabricMean)->mean, Measure::FrictionSpectrum).why(),
                 std::string("a constant has no texture"));
        QVERIFY(*evaluation.noiseFloor <= mean(evaluation, PredictorKind::FabricMean, Measure::FrictionMaeOverMean));
    }

    /// Photographs of F02 show a quarter of the others' cloth, so that all features come from as little.
    void featuresComeFromTheClothOfTheSmallestPhotograph()
    {
        const fs::path copy = m_root / "two pitches";
        fs::copy(m_root / "aligned", copy, fs::copy_options::recursive);
        const Dataset dataset = readDataset(copy);
        const MeasuredSignals measured(dataset, 0.05);
        const TestPlan plan = testPlan(dataset, {});
        const int side = fitControls(dataset, measured, plan, {}).featureSide;
        const cv::Mat photograph = readPhotograph(dataset, FabricId("F02"), 0);
        auto places = readSamplePlaces(dataset);
        for (SamplePlace& place : places)
            if (place.modality == Modality::Visual && place.fabric == FabricId("F02"))
                place.mmPerPixel = *dataset.cameraMmPerPixel / 4;
        writeSamplePlaces(dataset, places);
        const int quarter = static_cast<int>(std::lround(std::min(photograph.cols, photograph.rows) / 4.0));
        QVERIFY(quarter < side);
        QCOMPARE(fitControls(dataset, measured, plan, {}).featureSide, quarter);
    }

    void resultsDoNotDependOnTheNumberOfThreads()
    {
        const std::string once = evaluationJson(evaluate(m_dataset, m_request, {}, flatAnswers)).dump();
        m_request.threads = 1;
        QCOMPARE(evaluationJson(evaluate(m_dataset, m_request, {}, flatAnswers)).dump(), once);
        m_request.threads = 2;
    }

    void controlsDoNotUseHeldOutFabrics()
    {
        EvaluationRequest request = m_request;
        request.split = SplitKind::Fabric;
        request.model = card("held", {"F02", "F99"});
        const Evaluation evaluation = evaluate(m_dataset, request, {}, flatAnswers);
        QCOMPARE(evaluation.fabrics, 1);
        QCOMPARE(evaluation.predictors.front().fabrics.front().fabric, FabricId("F02"));
        QVERIFY(at(evaluation.predictor(PredictorKind::FabricMean)->mean, Measure::FrictionMae).why().find("held out") !=
                std::string::npos);
        QCOMPARE(mean(evaluation, PredictorKind::Retrieval, Measure::IdentifiedByBoth), 0.0);  // always another fabric
        QVERIFY(mean(evaluation, PredictorKind::Measured, Measure::IdentifiedByBoth) > 0.5);   // the classifiers use it
        QCOMPARE(evaluation.trainingPhotographs, 20);
    }

    void splitByFabricNeedsAModelWithHeldOutFabrics()
    {
        EvaluationRequest request = m_request;
        request.split = SplitKind::Fabric;
        QVERIFY(contains(refusalOf([&] { evaluate(m_dataset, request, {}, flatAnswers); }), "--hold-out"));
        request.model = card("elsewhere", {"F77"});
        QVERIFY(contains(refusalOf([&] { evaluate(m_dataset, request, {}, flatAnswers); }), "none of the fabrics"));
    }

    /// Another split than that of the training would test photographs whose validation chose the weights.
    void theSplitIsThatOfTheModelUnlessToldOtherwise()
    {
        EvaluationRequest request = m_request;
        request.model = card("located", {}, hashOf(m_dataset));
        const Evaluation other = evaluate(m_dataset, request, {}, flatAnswers);
        QVERIFY(contains(evaluationText(other), "located was trained with --split location and --split-seed 1"));
        EvaluationRequest beside = m_request;
        beside.against = {request.model};
        QVERIFY(contains(evaluationText(evaluate(m_dataset, beside, {}, flatAnswers)), "located was trained with --split"));
        beside.model = card("of another set", {}, std::string(64, 'a'));
        beside.against.clear();
        beside.split.reset();
        const Evaluation unknown = evaluate(m_dataset, beside, {}, flatAnswers);
        QVERIFY(unknown.split == SplitKind::Sample && !contains(evaluationText(unknown), "chosen its weights"));
        request.split.reset();
        const Evaluation usual = evaluate(m_dataset, request, {}, flatAnswers);
        QVERIFY(usual.split == SplitKind::Location && usual.splitSeed == 1);
        QVERIFY(!contains(evaluationText(usual), "chosen its weights"));
        request.model.clear();  // the shipped weights saw drawn fabrics
        QVERIFY(evaluate(m_dataset, request, {}, flatAnswers).split == SplitKind::Sample);
    }

    void otherModelsAreEvaluatedToo()
    {
        EvaluationRequest request = m_request;
        request.against = {card("l1", {})};
        const Evaluation evaluation = evaluate(m_dataset, request, {}, flatAnswers);
        QCOMPARE(evaluation.predictors.size(), std::size_t(8));
        QCOMPARE(evaluation.predictors[1].predictor.id, std::string("against:l1"));
        QVERIFY(contains(evaluationText(evaluation), "against: l1"));
    }

    void dataSetWithoutOneSignalIsEvaluatedByTheOther()
    {
        const fs::path copy = m_root / "no friction";
        fs::copy(m_root / "aligned", copy, fs::copy_options::recursive);
        for (const char* fabric : {"F01", "F02", "F03"}) fs::remove_all(copy / fabric / "friction");
        const Evaluation evaluation = evaluate(readDataset(copy), m_request, {}, flatAnswers);
        QVERIFY(at(evaluation.predictors[0].mean, Measure::Ssim).exists());
        QVERIFY(contains(at(evaluation.predictors[0].mean, Measure::FrictionMae).why(), "no friction records"));
        QVERIFY(contains(evaluationText(evaluation), "not measured: the data set has no friction records"));
        for (const char* fabric : {"F01", "F02", "F03"}) fs::remove_all(copy / fabric / "tactile");
        const Evaluation none = evaluate(readDataset(copy), m_request, {}, flatAnswers);
        QVERIFY(!none.rangeMm.exists() && !at(none.predictors[0].mean, Measure::Ssim).exists());
    }

    void knownHeightsServeAsMeasured()
    {
        m_dataset.tactileCalibration = "known";
        const Evaluation evaluation = evaluate(m_dataset, m_request, {}, flatAnswers);
        QVERIFY(at(evaluation.predictors[0].mean, Measure::Ssim).exists());
        m_dataset.tactileCalibration.clear();
        QVERIFY(
            contains(at(evaluate(m_dataset, m_request, {}, flatAnswers).predictors[0].mean, Measure::Ssim).why(), "calibration"));
    }

    void oneFabricWithBlackPhotographsHasDefinedResults()
    {
        const fs::path copy = m_root / "dark";
        fs::copy(m_root / "aligned", copy, fs::copy_options::recursive);
        Dataset dark = readDataset(copy);
        for (const int index : sampleIndices(dark, FabricId("F01"), Modality::Visual))
            rendering::writePng(samplePath(dark, FabricId("F01"), Modality::Visual, index), cv::Mat::zeros(256, 256, CV_8UC3));
        dark.fabrics.resize(1);
        const Evaluation evaluation = evaluate(dark, m_request, {}, flatAnswers);
        QCOMPARE(evaluation.fabrics, 1);
        QCOMPARE(evaluation.leaks.duplicates.at(Modality::Visual), 1);  // all photographs are identical
        QVERIFY(contains(at(evaluation.predictors[0].mean, Measure::IdentifiedByBoth).why(), "fewer than two fabrics"));
        QVERIFY(!evaluation.predictors[0].friction.equivalence.why.empty());
        QVERIFY(!contains(evaluationText(evaluation), "nan"));
        QVERIFY(contains(evaluationJson(evaluation).dump(), "vis2hap.evaluation/1"));
        // One fabric has no interval over fabrics; its place in table and JSON stays.
        QVERIFY(contains(evaluationText(evaluation), "95 % interval over fabrics"));
        const auto ci95 = evaluationJson(evaluation).at("speakers").at(0).at("ci95");
        QVERIFY(ci95.at("friction_mae").is_null() && !ci95.at("why").at("friction_mae").get<std::string>().empty());
    }

private:
    /// Writes the card of a model without weights, which these tests never open.
    fs::path card(const std::string& name, const std::vector<std::string>& heldOut, const std::string& datasetHash = {})
    {
        rendering::models::ModelCardFields fields;
        fields.summary.name = name;
        fields.splitSeed = 1;
        fields.heldOut = heldOut;
        fields.datasetHash = datasetHash;
        fields.validationJson = "{}";
        const fs::path model = m_root / (name + ".safetensors");
        write(rendering::models::cardOf(model), rendering::models::cardText(fields));
        return model;
    }

    QTemporaryDir m_folder;
    fs::path m_root;
    Dataset m_dataset;
    EvaluationRequest m_request;
};

QTEST_GUILESS_MAIN(EvaluationTest)
#include "evaluation_test.moc"
