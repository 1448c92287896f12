// Criteria of an evaluation, and its output as text tables and as JSON.
#include <QTest>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/evaluation/criteria.h"
#include "study/evaluation/evaluation_json.h"
#include "study/evaluation/evaluation_text.h"

using namespace study::evaluation;

namespace {

PredictorResult predictor(PredictorKind kind, const std::string& name, double badness)
{
    PredictorResult result{{kind, name, name, kind == PredictorKind::Against ? 1u : 0u}, {}, {}, {}, {}, {}};
    for (int i = 1; i <= 3; ++i) result.fabrics.push_back({protocols::FabricId("F0" + std::to_string(i)), 4, {}});
    for (const MeasureRow& row : measureTable()) {
        const bool larger = row.better == Better::Larger;
        at(result.mean, row.measure) = larger ? 1 - badness : badness;
        for (FabricValues& fabric : result.fabrics) at(fabric.values, row.measure) = at(result.mean, row.measure);
    }
    for (FabricValues& fabric : result.fabrics) at(fabric.values, Measure::SqRatio) = 1.1;
    at(result.mean, Measure::SqRatio) = 1.1;
    return result;
}

/// Evaluation of a generator that meets every criterion.
Evaluation good(SplitKind split = SplitKind::Sample, bool aligned = false)
{
    Evaluation evaluation;
    evaluation.dataset = "cloths";
    evaluation.split = split;
    evaluation.aligned = aligned;
    evaluation.models = {{"ours", "ours.safetensors", "00", "default", {}, 6000, {}},
                         {"l1", "l1.safetensors", "01", "l1-only", {}, 6000, {}}};
    evaluation.pairs = 12;
    evaluation.fabrics = 3;
    evaluation.rangeMm = 0.5;
    evaluation.noiseFloor = 0.06;
    evaluation.predictors = {predictor(PredictorKind::Generated, "generated", 0.04),
                             predictor(PredictorKind::Against, "against: l1", 0.06),
                             predictor(PredictorKind::GeneratedMean, "generated, mean alone", 0.045),
                             predictor(PredictorKind::GlobalConstant, "one constant for all", 0.3),
                             predictor(PredictorKind::FabricMean, "the fabric's mean", 0.05),
                             predictor(PredictorKind::Retrieval, "nearest photograph", 0.08),
                             predictor(PredictorKind::AnotherPlace, "fabric, another place", 0.07),
                             predictor(PredictorKind::Measured, "measured itself", 0.01)};
    return evaluation;
}

PredictorResult& of(Evaluation& evaluation, PredictorKind kind)
{
    return *std::find_if(evaluation.predictors.begin(), evaluation.predictors.end(),
                         [&](const auto& one) { return one.predictor.kind == kind; });
}

int countOf(const std::vector<Criterion>& criteria, std::optional<bool> reached)
{
    return static_cast<int>(
        std::count_if(criteria.begin(), criteria.end(), [&](const Criterion& one) { return one.reached == reached; }));
}

Criterion named(const std::vector<Criterion>& criteria, const std::string& what, const std::string& required)
{
    const auto found = std::find_if(criteria.begin(), criteria.end(), [&](const Criterion& one) {
        return one.what.find(what) != std::string::npos && one.required.find(required) != std::string::npos;
    });
    if (found == criteria.end()) qFatal("no such criterion: %s, %s", what.c_str(), required.c_str());
    return *found;
}

}  // namespace

class EvaluationCriteriaTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void goodGeneratorMeetsEveryCriterion_data()
    {
        QTest::addColumn<int>("split");
        QTest::addColumn<bool>("aligned");
        QTest::addColumn<int>("count");
        QTest::newRow("by sample") << int(SplitKind::Sample) << false << 12;
        QTest::newRow("by location") << int(SplitKind::Location) << false << 12;
        QTest::newRow("by sample, aligned") << int(SplitKind::Sample) << true << 13;
        QTest::newRow("by fabric") << int(SplitKind::Fabric) << false << 9;
    }

    void goodGeneratorMeetsEveryCriterion()
    {
        QFETCH(int, split);
        QFETCH(bool, aligned);
        QFETCH(int, count);
        const auto criteria = criteriaOf(good(SplitKind(split), aligned));
        QCOMPARE(int(criteria.size()), count);
        QCOMPARE(countOf(criteria, true), count);
    }

    void everyUnmetCriterionIsReported_data()
    {
        QTest::addColumn<int>("split");
        QTest::addColumn<int>("measure");
        QTest::addColumn<double>("found");
        QTest::addColumn<QString>("required");
        const auto row = [](const char* name, SplitKind split, Measure measure, double found, const char* required) {
            QTest::newRow(name) << int(split) << int(measure) << found << required;
        };
        row("mean friction", SplitKind::Sample, Measure::MeanFrictionError, 0.051, "at most 5.0 %");
        row("friction error", SplitKind::Sample, Measure::FrictionMaeOverMean, 0.081, "at most 8.0 %");
        row("friction above the mean and the floor", SplitKind::Sample, Measure::FrictionMaeOverMean, 0.072,
            "below the fabric's mean");
        row("similarity below the mean", SplitKind::Location, Measure::SsimRegistered, 0.949, "the fabric's mean");
        row("similarity below retrieval", SplitKind::Location, Measure::SsimRegistered, 0.919, "nearest photograph");
        row("similarity below the other model", SplitKind::Location, Measure::SsimRegistered, 0.939, "against: l1");
        row("spectrum above retrieval", SplitKind::Sample, Measure::HeightSpectrum, 0.081, "nearest photograph");
        row("not identified", SplitKind::Sample, Measure::IdentifiedByBoth, 0.899, "at least 90.0 %");
        row("unknown fabric's friction", SplitKind::Fabric, Measure::MeanFrictionError, 0.151, "at most 15.0 %");
        row("no better than a constant", SplitKind::Fabric, Measure::FrictionMaeOverMean, 0.31, "one constant");
    }

    void everyUnmetCriterionIsReported()
    {
        QFETCH(int, split);
        QFETCH(int, measure);
        QFETCH(double, found);
        QFETCH(QString, required);
        Evaluation evaluation = good(SplitKind(split));
        at(of(evaluation, PredictorKind::Generated).mean, Measure(measure)) = found;
        const auto criteria = criteriaOf(evaluation);
        QCOMPARE(named(criteria, std::string(rowOf(Measure(measure)).heading), required.toStdString()).reached,
                 std::optional(false));
    }

    void frictionAtTheNoiseFloorMeetsTheCriterion()
    {
        Evaluation evaluation = good();
        at(of(evaluation, PredictorKind::Generated).mean, Measure::FrictionMaeOverMean) = 0.065;
        const auto one = named(criteriaOf(evaluation), "MAE/mean", "below the fabric's mean");
        QCOMPARE(one.reached, std::optional(true));
        QVERIFY(one.found.find("noise floor") != std::string::npos);
    }

    /// A fabric that the control cannot predict, and that the generator finds hard.
    void meansAreComparedOverTheFabricsThatBothHave()
    {
        Evaluation evaluation = good(SplitKind::Fabric);
        PredictorResult &ours = of(evaluation, PredictorKind::Generated), &retrieval = of(evaluation, PredictorKind::Retrieval);
        const auto measure = Measure::MeanFrictionError;
        at(ours.fabrics[0].values, measure) = 0.3;
        at(ours.mean, measure) = (0.3 + 0.04 + 0.04) / 3;
        at(retrieval.fabrics[0].values, measure) = stats::Value::undefined("no photograph is near");
        const auto shared = named(criteriaOf(evaluation), "mean off by", "nearest photograph");
        QCOMPARE(shared.reached, std::optional(true));
        QVERIFY2(shared.found.find("4.0 % to 8.0 % (over the 2 of 3 fabrics that have both)") != std::string::npos,
                 shared.found.c_str());
        for (std::size_t i : {1U, 2U}) at(ours.fabrics[i].values, measure) = stats::Value::undefined("no stroke");
        const auto none = named(criteriaOf(evaluation), "mean off by", "nearest photograph");
        QVERIFY2(!none.reached && none.found.find("on no fabric that both have") != std::string::npos, none.found.c_str());
    }

    void worstFabricDecidesTheRoughness()
    {
        Evaluation evaluation = good();
        at(of(evaluation, PredictorKind::Generated).fabrics[1].values, Measure::SqRatio) = 0.79;
        const auto one = named(criteriaOf(evaluation), "Sq", "every fabric");
        QCOMPARE(one.reached, std::optional(false));
        QVERIFY(one.found.find("F02: 0.790") != std::string::npos);
        at(of(evaluation, PredictorKind::Generated).fabrics[1].values, Measure::SqRatio) = 1.26;
        QCOMPARE(named(criteriaOf(evaluation), "Sq", "every fabric").reached, std::optional(false));
    }

    void missingValuesLeaveACriterionUndecided()
    {
        Evaluation evaluation = good();
        at(of(evaluation, PredictorKind::Generated).mean, Measure::MeanFrictionError) =
            stats::Value::undefined("no friction here");
        at(of(evaluation, PredictorKind::Retrieval).mean, Measure::SsimRegistered) = stats::Value::undefined("nothing retrieved");
        const auto criteria = criteriaOf(evaluation);
        QCOMPARE(countOf(criteria, std::nullopt), 2);
        QVERIFY(named(criteria, "mean off by", "at most").found.find("no friction here") != std::string::npos);
    }

    void controlTrainedOtherwiseDecidesNoCriterion()
    {
        Evaluation evaluation = good();
        evaluation.models[1].steps = 800;
        evaluation.models[1].differences = {"800 steps (the model: 6,000)"};
        const auto criteria = criteriaOf(evaluation);
        QCOMPARE(countOf(criteria, std::nullopt), 2);  // registered SSIM and height spectrum
        const auto one = named(criteria, "SSIM, registered", "against: l1");
        QCOMPARE(one.found, std::string("0.9600 to 0.9400; not a fair control: trained with 800 steps (the model: 6,000)"));
        const auto json = evaluationJson(evaluation)["against"][0];
        QCOMPARE(json["steps"].get<int>(), 800);
        QCOMPARE(json["fair_control"].get<bool>(), false);
        QCOMPARE(evaluationJson(good())["against"][0]["fair_control"].get<bool>(), true);
    }

    void tablesNameSplitAndPairing()
    {
        const std::string text = evaluationText(good(SplitKind::Location));
        const QString shown = QString::fromStdString(text);
        QCOMPARE(shown.count("(by location, weak pairs)"), 6);  // four sections, equal means, criteria
        QVERIFY(shown.contains("model \"ours\" on \"cloths\""));
        for (const QString& line : shown.split('\n')) QVERIFY2(line.size() < 200, qPrintable(line));
    }

    void jsonHasEveryMeasureAndTheReasonForAMissingOne()
    {
        Evaluation evaluation = good();
        at(of(evaluation, PredictorKind::Retrieval).mean, Measure::Ssim) = stats::Value::undefined("nothing retrieved");
        const auto json = evaluationJson(evaluation);
        QCOMPARE(json.begin().key(), std::string("schema"));
        QCOMPARE(json["schema"].get<std::string>(), std::string("vis2hap.evaluation/1"));
        QCOMPARE(json["speakers"].size(), std::size_t(8));
        for (const MeasureRow& row : measureTable()) QVERIFY(json["speakers"][0].contains(std::string(row.field)));
        QVERIFY(json["speakers"][5]["ssim"].is_null());
        QCOMPARE(json["speakers"][5]["why"]["ssim"].get<std::string>(), std::string("nothing retrieved"));
        QCOMPARE(json["speakers"][0]["fabrics"][2]["fabric"].get<std::string>(), std::string("F03"));
        QCOMPARE(json["criteria"].size(), criteriaOf(evaluation).size());
        QCOMPARE(json["split"]["by"].get<std::string>(), std::string("sample"));
    }
};

QTEST_GUILESS_MAIN(EvaluationCriteriaTest)
#include "evaluation_criteria_test.moc"
