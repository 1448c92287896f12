// Plan of `vis2hap evaluate`: pairs, splits and their leaks.
#include <algorithm>
#include <memory>

#include "protocols/files/sha256.h"
#include "study/evaluation/test_plan.h"
#include "tests/rendering/fabric_files.h"

using namespace fabric_files;
using namespace rendering::fabrics;
using namespace study::evaluation;

namespace {

constexpr Modality all[] = {Modality::Visual, Modality::Tactile, Modality::Friction};

/// Two fabrics with `count` samples of each signal, 100 mm apart. All files differ.
Dataset scattered(const fs::path& folder, int count, Pairing pairing = Pairing::Weak)
{
    Dataset dataset;
    dataset.folder = folder;
    dataset.name = "scattered";
    dataset.fabrics = {{FabricId("F01"), "A", ""}, {FabricId("F02"), "B", ""}};
    dataset.cameraMmPerPixel = dataset.tactileMmPerPixel = 0.1;
    dataset.pairing = pairing;
    std::vector<SamplePlace> places;
    for (const FabricInfo& fabric : dataset.fabrics)
        for (const Modality modality : all)
            for (int i = 0; i < count; ++i) {
                const fs::path file = samplePath(dataset, fabric.id, modality, i);
                fs::create_directories(file.parent_path());
                if (modality == Modality::Friction)
                    write(file, "t_s,mu\n0,0." + std::to_string(i + 1) + "\n1,0." + std::to_string(fabric.id == FabricId("F01")) +
                                    "\n");
                else
                    rendering::writePng(
                        file,
                        speckled(10, 10, CV_8UC3, i * 4 + (modality == Modality::Tactile) * 2 + (fabric.id == FabricId("F01"))));
                const std::string group = pairing == Pairing::Aligned ? fabric.id.value + "-" + std::to_string(i) : "";
                places.push_back({fabric.id, modality, i, 100.0 * i, 0.0, 0.0, group});
            }
    writeDatasetJson(dataset);
    writeSamplePlaces(dataset, places);
    return dataset;
}

std::vector<int> testedPhotographs(const TestPlan& plan, std::size_t fabric = 0)
{
    std::vector<int> indices;
    for (const TestPair& pair : plan.pairs)
        if (pair.fabric == fabric) indices.push_back(pair.photograph.index);
    return indices;
}

/// Moves a sample to the place of another one.
void moveBeside(const Dataset& dataset, Modality modality, int moved, int to)
{
    auto places = readSamplePlaces(dataset);
    for (SamplePlace& place : places)
        if (place.fabric == FabricId("F01") && place.modality == modality && place.index == moved) place.xMm = 100.0 * to + 0.5;
    writeSamplePlaces(dataset, places);
}

int notTested(const TestPlan& plan)
{
    const auto tested = testedPhotographs(plan);
    int index = 0;
    while (std::find(tested.begin(), tested.end(), index) != tested.end()) ++index;
    return index;
}

}  // namespace

class EvaluationPlanTest : public QObject {
    Q_OBJECT

private Q_SLOTS:
    void init()
    {
        m_folder = std::make_unique<QTemporaryDir>();
        m_dataset = scattered(pathOf(*m_folder), 30);
    }

    void weakPairsTakeAnyPressAndStrokeOfTheFabricInTurn()
    {
        const TestPlan plan = testPlan(m_dataset, {});
        QCOMPARE(plan.pairs.size(), std::size_t(6));  // a tenth of 30 from each of two fabrics
        std::vector<int> presses;
        for (const TestPair& pair : plan.pairs) {
            QCOMPARE(pair.press->fabric, pair.photograph.fabric);
            QVERIFY(pair.otherPress->index != pair.press->index && pair.otherStroke->index != pair.stroke->index);
            if (pair.fabric == 0) presses.push_back(pair.press->index);
        }
        std::sort(presses.begin(), presses.end());
        QVERIFY(std::adjacent_find(presses.begin(), presses.end()) == presses.end());
    }

    void alignedPairsTakeTheSameIndex()
    {
        const Dataset aligned = scattered(pathOf(*m_folder) / "aligned", 30, Pairing::Aligned);
        const TestPlan plan = testPlan(aligned, {});
        QCOMPARE(plan.pairs.size(), std::size_t(6));
        for (const TestPair& pair : plan.pairs) {
            QCOMPARE(pair.press->index, pair.photograph.index);
            QCOMPARE(pair.stroke->index, pair.photograph.index);
            QVERIFY(pair.otherPress->index != pair.photograph.index);
        }
        PlanRequest request;
        request.trainedOn = {plan.pairs[0].press->sha256};
        const TestPlan without = testPlan(aligned, request);
        QVERIFY(!without.pairs[0].press && without.pairs[0].stroke);  // no other press replaces it
        QCOMPARE(without.pairs[1].press->index, without.pairs[1].photograph.index);
    }

    void samplesTrainedOnAreLeftOutAndCounted()
    {
        const TestPlan before = testPlan(m_dataset, {});
        PlanRequest request;
        request.trainedOn = {before.pairs[0].photograph.sha256, before.pairs[1].press->sha256};
        const TestPlan after = testPlan(m_dataset, request);
        QCOMPARE(after.leaks.trainedOn.at(Modality::Visual), 1);
        QCOMPARE(after.leaks.trainedOn.at(Modality::Tactile), 1);
        QCOMPARE(after.pairs.size(), std::size_t(5));
        for (const TestPair& pair : after.pairs) {
            QVERIFY(!request.trainedOn.contains(pair.photograph.sha256));
            QVERIFY(!request.trainedOn.contains(pair.press->sha256) && !request.trainedOn.contains(pair.otherPress->sha256));
        }
    }

    void duplicateFilesAreCounted()
    {
        const TestPlan before = testPlan(m_dataset, {});
        QCOMPARE(before.leaks.duplicates.at(Modality::Visual), 0);
        fs::copy_file(samplePath(m_dataset, FabricId("F01"), Modality::Visual, testedPhotographs(before).front()),
                      samplePath(m_dataset, FabricId("F01"), Modality::Visual, notTested(before)),
                      fs::copy_options::overwrite_existing);
        const TestPlan after = testPlan(m_dataset, {});
        QCOMPARE(after.leaks.duplicates.at(Modality::Visual), 1);
        QCOMPARE(after.leaks.duplicates.at(Modality::Tactile), 0);
    }

    void overlapsAreCountedBySampleAndAvoidedByLocation()
    {
        const TestPlan before = testPlan(m_dataset, {});
        QCOMPARE(before.leaks.overlaps.at(Modality::Visual), 0);
        moveBeside(m_dataset, Modality::Visual, notTested(before), testedPhotographs(before).front());
        QCOMPARE(testPlan(m_dataset, {}).leaks.overlaps.at(Modality::Visual), 1);
        PlanRequest byLocation;
        byLocation.split = SplitKind::Location;
        QCOMPARE(testPlan(m_dataset, byLocation).leaks.overlaps.at(Modality::Visual), 0);
    }

    void splitByLocationLeavesOutPlacesOfTrainingSamples()
    {
        moveBeside(m_dataset, Modality::Visual, 4, 17);  // now both are one place, so in one part
        PlanRequest request;
        request.split = SplitKind::Location;
        request.trainedOn = {protocols::sha256OfFile(samplePath(m_dataset, FabricId("F01"), Modality::Visual, 4))};
        for (request.seed = 1; request.seed < 60; ++request.seed) {
            const TestPlan plan = testPlan(m_dataset, request);
            const auto indices = testedPhotographs(plan);
            QVERIFY(std::find(indices.begin(), indices.end(), 4) == indices.end());
            QVERIFY(std::find(indices.begin(), indices.end(), 17) == indices.end());
            if (plan.leaks.placeTrainedOn.at(Modality::Visual) == 1 && plan.leaks.trainedOn.at(Modality::Visual) == 1) return;
        }
        QFAIL("no seed put the place into the test");
    }

    void heldOutFabricsAreTestedAndHiddenFromTheControls()
    {
        PlanRequest request;
        request.split = SplitKind::Fabric;
        request.heldOut = {FabricId("F02")};
        const TestPlan plan = testPlan(m_dataset, request);
        QCOMPARE(plan.pairs.size(), std::size_t(3));
        for (const TestPair& pair : plan.pairs) QCOMPARE(pair.photograph.fabric, FabricId("F02"));
        QVERIFY(plan.fabrics[1].heldOut && !plan.fabrics[0].heldOut);
        QVERIFY(!plan.fabrics[1].training.at(Modality::Tactile).empty());  // for the identifiers
    }

    void numberOfPhotographsCanBeLimited()
    {
        PlanRequest request;
        request.samplesPerFabric = 2;
        const TestPlan plan = testPlan(m_dataset, request);
        QCOMPARE(plan.pairs.size(), std::size_t(4));
        QCOMPARE(testedPhotographs(testPlan(m_dataset, request)), testedPhotographs(plan));
    }

    void missingSignalsLeaveNoPartner()
    {
        fs::remove_all(pathOf(*m_folder) / "F01" / "friction");
        const TestPlan plan = testPlan(m_dataset, {});
        QVERIFY(!plan.pairs.front().stroke && plan.pairs.front().press);
        QVERIFY(plan.pairs.back().stroke);
    }

    void planWithoutTestPhotographsIsRefused()
    {
        fs::remove_all(pathOf(*m_folder) / "F01" / "visual");
        QVERIFY(!testPlan(m_dataset, {}).notes.empty());  // notes that one fabric is missing
        PlanRequest trained;
        for (const TestPair& pair : testPlan(m_dataset, {}).pairs) trained.trainedOn.insert(pair.photograph.sha256);
        QVERIFY(contains(refusalOf([&] { testPlan(m_dataset, trained); }), "trained on every photograph"));
        fs::remove_all(pathOf(*m_folder) / "F02" / "visual");
        QVERIFY(contains(refusalOf([&] { testPlan(m_dataset, {}); }), "has no photographs"));
    }

    void oneSampleIsTooFewForASplit()
    {
        const Dataset small = scattered(pathOf(*m_folder) / "one", 1);
        QVERIFY(contains(refusalOf([&] { testPlan(small, {}); }), "fewer than three places"));
    }

    void unknownPlacesAreNoted()
    {
        fs::remove(m_dataset.folder / "samples.csv");
        const TestPlan plan = testPlan(m_dataset, {});
        QVERIFY(!plan.leaks.placesKnown && contains(plan.notes.front(), "samples.csv"));
    }

private:
    std::unique_ptr<QTemporaryDir> m_folder;
    Dataset m_dataset;
};

QTEST_GUILESS_MAIN(EvaluationPlanTest)
#include "evaluation_plan_test.moc"
