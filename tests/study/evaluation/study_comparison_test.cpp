// Generated signals of a study beside the controls: what the controls may know, weak pairs, and data sets that lack something.
#include "study/evaluation/study_comparison.h"

#include <QTemporaryDir>
#include <QTest>
#include <map>
#include <set>

#include "protocols/files/errors.h"
#include "rendering/fabrics/location_split.h"
#include "rendering/fabrics/procedural/procedural_fabrics.h"
#include "study/evaluation/measured_signals.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering::fabrics;
using namespace study::evaluation;
using rendering::models::GeneratedSignals;
using rendering::models::InputPhotograph;

namespace {

const ComparedSource& sourceNamed(const StudyComparison& comparison, const std::string& id)
{
    for (const ComparedSource& source : comparison.sources)
        if (source.result.predictor.id == id) return source;
    throw std::runtime_error("no source " + id);
}

double mean(const StudyComparison& comparison, const std::string& id, Measure measure)
{
    return *at(sourceNamed(comparison, id).result.mean, measure);
}

std::string whyNone(const StudyComparison& comparison, const std::string& id, Measure measure)
{
    return at(sourceNamed(comparison, id).result.mean, measure).why();
}

/// A flat map and a constant trace, as an L1-only control tends to answer.
std::vector<GeneratedSignals> flatAnswers(std::span<const InputPhotograph> photographs,
                                          const rendering::models::GenerationOptions&)
{
    return std::vector<GeneratedSignals>(
        photographs.size(),
        {cv::Mat(256, 256, CV_32FC1, cv::Scalar(0.1)), 0.05, {}, std::vector<double>(480, 0.3), 1.0 / 12, 0.3, {}, {}});
}

}  // namespace

class StudyComparisonTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        m_root = pathOf(m_folder);
        ProceduralOptions options;
        options.fabrics = 3;
        options.samples = 10;
        options.seed = 5;
        m_dataset = makeProceduralFabrics(m_root / "weak", options);
    }

    void controlsNeverKnowWhatTheStudyShows()
    {
        KnownSamplesRequest request;
        request.shown = {{FabricId("F01"), 2, 5, 7}, {FabricId("F03"), 0, 1, {}}};
        const TestPlan plan = planOfStudy(m_dataset, request);
        QCOMPARE(plan.pairs.size(), std::size_t(2));
        QCOMPARE(plan.pairs[0].press->index, 5);
        QVERIFY(!plan.pairs[1].stroke);
        std::map<std::tuple<std::string, Modality, int>, Part> parts;
        std::map<std::tuple<std::string, Modality, int>, SamplePlace> places;
        for (const auto& [place, part] : splitByLocation(m_dataset, 1)) {
            parts[{place.fabric.value, place.modality, place.index}] = part;
            places[{place.fabric.value, place.modality, place.index}] = place;
        }
        int known = 0;
        for (const PlannedFabric& fabric : plan.fabrics)
            for (const auto& [modality, samples] : fabric.training)
                for (const PlannedSample& sample : samples) {
                    ++known;
                    QCOMPARE(parts.at({sample.fabric.value, modality, sample.index}), Part::Training);
                    const auto footprint = footprintOf(m_dataset, places.at({sample.fabric.value, modality, sample.index}));
                    for (const TestPair& pair : plan.pairs)
                        for (const auto& shown : {std::optional(pair.photograph), pair.press, pair.stroke}) {
                            if (!shown || shown->fabric != sample.fabric || shown->modality != modality) continue;
                            QVERIFY(shown->index != sample.index);
                            const auto other = footprintOf(m_dataset, places.at({shown->fabric.value, modality, shown->index}));
                            QVERIFY(footprint && other && !overlap(*footprint, *other));
                        }
                }
        QVERIFY(known > 40);
    }

    void knownSamplesAreBounded()
    {
        const TestPlan plan = planOfStudy(m_dataset, {});
        for (const PlannedFabric& fabric : plan.fabrics)
            for (const auto& [modality, samples] : fabric.training) QVERIFY(samples.size() <= mostKnownSamples);
        QVERIFY(plan.pairs.empty());
    }

    /// The generator answers with another press and stroke of the fabric, so its texture is right and its place is wrong.
    void registrationShowsTheRightTextureAtAnotherPlace()
    {
        const StudyComparison comparison = compareStudy(m_dataset, request(m_dataset), {}, flatAnswers);
        QVERIFY(!comparison.aligned);
        QCOMPARE(comparison.sources.size(), std::size_t(7));
        const double plain = mean(comparison, "generated", Measure::Ssim),
                     registered = mean(comparison, "generated", Measure::SsimRegistered);
        QVERIFY2(registered > plain + 0.3, qPrintable(QString("%1 %2").arg(plain).arg(registered)));
        QVERIFY(registered > mean(comparison, "fabric_mean", Measure::SsimRegistered) + 0.2);
        QVERIFY(mean(comparison, "generated", Measure::HeightSpectrum) < 4);
        QVERIFY(mean(comparison, "global_constant", Measure::HeightSpectrum) > 10);
        QVERIFY(mean(comparison, "fabric_mean", Measure::MeanFrictionError) <
                mean(comparison, "global_constant", Measure::MeanFrictionError));
    }

    void differencesArePairedOverFabrics()
    {
        const StudyComparison comparison = compareStudy(m_dataset, request(m_dataset), {}, flatAnswers);
        const auto& generated = sourceNamed(comparison, "generated");
        const auto& control = sourceNamed(comparison, "fabric_mean");
        QVERIFY(generated.differences.empty());
        for (const MeasureDifference& one : control.differences) {
            if (one.measure != Measure::SsimRegistered) continue;
            QCOMPARE(one.test.n, std::size_t(3));
            double sum = 0;
            for (std::size_t i = 0; i < 3; ++i)
                sum += *at(generated.result.fabrics[i].values, one.measure) - *at(control.result.fabrics[i].values, one.measure);
            QVERIFY(std::abs(*one.test.estimate - sum / 3) < 1e-12);
            QVERIFY(*one.pHolm >= *one.test.p);
        }
    }

    void controlWithOtherStepsHasNumbersAndNoDifferences()
    {
        StudyComparisonRequest asked = request(m_dataset);
        asked.control = card("l1", 800);
        const StudyComparison unfair = compareStudy(m_dataset, asked, {}, flatAnswers);
        const ComparedSource& control = sourceNamed(unfair, "l1_only");
        QCOMPARE(control.steps, std::optional(800));
        QCOMPARE(control.whyUnfair, std::string("trained with 800 steps (the model: 6,000)"));
        QVERIFY(control.differences.empty() && at(control.result.mean, Measure::Ssim).exists());
        asked.control = card("fair", 6000);
        const StudyComparison fair = compareStudy(m_dataset, asked, {}, flatAnswers);
        QVERIFY(sourceNamed(fair, "l1_only").whyUnfair.empty() && !sourceNamed(fair, "l1_only").differences.empty());
    }

    void missingControlHasItsReason()
    {
        QVERIFY(contains(whyNone(compareStudy(m_dataset, request(m_dataset), {}, flatAnswers), "l1_only", Measure::Ssim),
                         "no weights of an L1-only control"));
        StudyComparisonRequest asked = request(m_dataset);
        asked.control = m_root / "absent.safetensors";
        QVERIFY(contains(whyNone(compareStudy(m_dataset, asked, {}, flatAnswers), "l1_only", Measure::Ssim),
                         "the L1-only control could not be used"));
    }

    void fabricsHeldOutFromTheModelHaveNoMean()
    {
        StudyComparisonRequest asked = request(m_dataset);
        asked.model.heldOut = {"F02"};
        asked.datasetSha256 = asked.model.datasetHash = "same";
        const StudyComparison comparison = compareStudy(m_dataset, asked, {}, flatAnswers);
        const auto& fabrics = sourceNamed(comparison, "fabric_mean").result.fabrics;
        QVERIFY(at(fabrics[0].values, Measure::FrictionMae).exists());
        QVERIFY(contains(at(fabrics[1].values, Measure::FrictionMae).why(), "held out"));
        QCOMPARE(comparison.notes.size(), std::size_t(0));
        asked.model.datasetHash = "other";
        const StudyComparison foreign = compareStudy(m_dataset, asked, {}, flatAnswers);
        QVERIFY(contains(foreign.notes.front(), "not trained on this data set"));
        QVERIFY(at(sourceNamed(foreign, "fabric_mean").result.fabrics[1].values, Measure::FrictionMae).exists());
    }

    void oneFabricWithOneSampleGivesReasons()
    {
        Dataset one = copyOf("single");
        one.fabrics.resize(1);
        for (const Modality modality : allModalities)
            for (const int index : sampleIndices(one, FabricId("F01"), modality))
                if (index > 0) fs::remove(samplePath(one, FabricId("F01"), modality, index));
        StudyComparisonRequest asked = request(m_dataset);
        asked.shown = {{FabricId("F01"), 0, 0, 0}};
        asked.generated.resize(1);
        const StudyComparison comparison = compareStudy(one, asked, {}, flatAnswers);
        QVERIFY(at(sourceNamed(comparison, "generated").result.mean, Measure::SsimRegistered).exists());
        QVERIFY(contains(whyNone(comparison, "fabric_mean", Measure::SsimRegistered), "no press"));
        QVERIFY(contains(whyNone(comparison, "retrieval", Measure::SsimRegistered), "no photograph"));
        QVERIFY(contains(whyNone(comparison, "another_place", Measure::FrictionMae), "no second sample"));
        for (const MeasureDifference& difference : sourceNamed(comparison, "fabric_mean").differences)
            QVERIFY(!difference.test.p.exists() && !difference.test.why.empty());
    }

    void missingSignalsGiveReasons()
    {
        StudyComparisonRequest asked = request(m_dataset);
        for (GeneratedSignals& one : asked.generated) one.heightMm.release();
        QVERIFY(contains(whyNone(compareStudy(m_dataset, asked, {}, flatAnswers), "generated", Measure::SsimRegistered),
                         "no height was generated"));
        asked = request(m_dataset);
        for (GeneratedSignals& one : asked.generated) one.trace.clear();
        const StudyComparison noFriction = compareStudy(m_dataset, asked, {}, flatAnswers);
        QVERIFY(contains(whyNone(noFriction, "generated", Measure::FrictionMae), "no friction was generated"));
        QVERIFY(contains(whyNone(noFriction, "generated_mean", Measure::FrictionMae), "no friction was generated"));
        asked = request(m_dataset);
        for (ShownSamples& one : asked.shown) one.press.reset();
        QVERIFY(
            contains(whyNone(compareStudy(m_dataset, asked, {}, flatAnswers), "generated", Measure::Ssim), "no measured press"));

        const Dataset photographs = copyOf("photographs");
        for (const char* fabric : {"F01", "F02", "F03"}) {
            fs::remove_all(photographs.folder / fabric / "tactile");
            fs::remove_all(photographs.folder / fabric / "friction");
        }
        const StudyComparison none = compareStudy(photographs, request(m_dataset), {}, flatAnswers);
        QVERIFY(contains(whyNone(none, "generated", Measure::Ssim), "no tactile frames"));
        QVERIFY(contains(whyNone(none, "fabric_mean", Measure::FrictionMae), "no friction records"));
    }

    void alignedPairsAreNamed()
    {
        m_dataset.pairing = Pairing::Aligned;
        QVERIFY(compareStudy(m_dataset, request(m_dataset), {}, flatAnswers).aligned);
        m_dataset.pairing = Pairing::Weak;
    }

    void resultsDoNotDependOnTheNumberOfThreads()
    {
        StudyComparisonRequest asked = request(m_dataset);
        const StudyComparison once = compareStudy(m_dataset, asked, {}, flatAnswers);
        asked.threads = 1;
        const StudyComparison again = compareStudy(m_dataset, asked, {}, flatAnswers);
        for (std::size_t s = 0; s < once.sources.size(); ++s)
            for (const Measure measure : studyMeasures)
                QCOMPARE(at(again.sources[s].result.mean, measure), at(once.sources[s].result.mean, measure));
    }

private:
    /// Three fabrics; what is generated is the measured press and stroke of sample 9, what is shown is sample 0.
    StudyComparisonRequest request(const Dataset& dataset)
    {
        const MeasuredSignals measured(dataset, 0.05);
        StudyComparisonRequest asked;
        std::map<std::string, std::optional<double>> turns;
        for (const SamplePlace& place : readSamplePlaces(dataset))
            turns[place.fabric.value + nameOf(place.modality) + std::to_string(place.index)] = place.rotationDeg;
        for (const FabricInfo& fabric : dataset.fabrics) {
            // A photograph whose rotation is nearest to that of press 9, because registration trusts the photograph's rotation.
            const double turn = turns.at(fabric.id.value + "tactile9").value();
            int best = 0;
            const auto off = [&](int index) {
                return std::abs(turns.at(fabric.id.value + "visual" + std::to_string(index)).value() - turn);
            };
            for (int index = 1; index < 10; ++index)
                if (off(index) < off(best)) best = index;
            asked.shown.push_back({fabric.id, best, 0, 0});
            const auto trace = measured.trace(fabric.id, 9);
            asked.generated.push_back(
                {measured.height(fabric.id, 9), 0.05, {}, trace.values, trace.mmPerSample, trace.mean, {}, {}});
        }
        asked.model.steps = 6000;
        asked.model.splitSeed = 1;
        asked.model.architecture.mmPerPixel = 0.05;
        return asked;
    }

    Dataset copyOf(const std::string& name)
    {
        fs::copy(m_dataset.folder, m_root / name, fs::copy_options::recursive);
        return readDataset(m_root / name);
    }

    /// The card of a control without weights, which these tests never open.
    fs::path card(const std::string& name, int steps)
    {
        rendering::models::ModelCardFields fields;
        fields.summary.name = name;
        fields.steps = steps;
        fields.splitSeed = 1;
        fields.objective = "l1-only";
        fields.validationJson = "{}";
        const fs::path model = m_root / (name + ".safetensors");
        write(rendering::models::cardOf(model), rendering::models::cardText(fields));
        return model;
    }

    QTemporaryDir m_folder;
    fs::path m_root;
    Dataset m_dataset;
};

QTEST_GUILESS_MAIN(StudyComparisonTest)
#include "study_comparison_test.moc"
